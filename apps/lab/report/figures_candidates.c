/* The figure of the effects that the residual asks for. */
#include <math.h>

#include "../base/quantile.h"
#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/candidates.gp.inc"
    NULL};

enum { CANDIDATES = 14 };

static int is_found(const lab_loop_result *result, int effect)
{
  int i;
  for (i = 0; i < result->n_found; i++)
    if (result->found[i].effect == effect)
      return 1;
  return 0;
}

int figure_draw_candidates(const drawing *d)
{
  const lab_loop_result *result = d->story->result;
  const double least = 0.5;
  unsigned char seen[PNEU_EFFECT_COUNT + 1] = {0};
  double threshold;
  int i, n = 0;
  char name[LAB_SHOWN_TEXT];
  if (result->trace.n == 0 || !(result->level > 0))
    return 0;
  threshold = lab_chi2_threshold(result->level);
  figure_tell(d, "Statistic of each effect; the threshold is %.3g.", threshold);
  fputs("$candidates << EOD\nrow,statistic,kind,name\n", d->file);
  for (i = 0; i < result->trace.n && n < CANDIDATES; i++) {
    const lab_candidate *c = &result->trace.candidate[i];
    if (seen[c->effect] || !(c->statistic > least))
      continue;
    seen[c->effect] = 1;
    fprintf(d->file, "%d,%.5g,%d,\"%s%s\"\n", ++n, c->statistic,
            is_found(result, c->effect) ? 2 : c->statistic > threshold, is_found(result, c->effect) ? "added: " : "",
            figure_plain(pneu_effect_at(c->effect)->name, name));
    if (n <= 5)
      figure_tell(d, " %s: %.3g.", name, c->statistic);
  }
  fputs("EOD\n", d->file);
  if (n == 0)
    return 0;
  figure_entitle(d, "Which effect the residual of the declared model asks for");
  figure_put_head(d, 185 + 26 * n, 72,
                  "Blue: added. Orange: passes the threshold, but the refits preferred another. Grey: does not pass");
  fprintf(d->file, "N = %d\nT_MIN = %g\nT_MAX = %.4g\nTHRESHOLD = %.5g\n", n, least,
          2 * fmax(threshold, result->trace.candidate[0].statistic), threshold);
  figure_put_lines(d->file, script);
  return 1;
}
