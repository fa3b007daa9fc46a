/* The figure of what the fit made of what was declared. */
#include <math.h>

#include "figures_private.h"

static const char *const script[] = {
#include "apps/lab/report/page/parameters.gp.inc"
    NULL};

/* What was declared for an unknown of the base model.  Returns: NaN for any other. */
static double declared_of(const drawing *d, const lab_unknown *x)
{
  pneu_params declared = d->story->rig->params;
  if (x->kind != LAB_UNKNOWN_PARAM)
    return (double)NAN;
  if (x->index == LAB_FIT_ORIFICE_AREA)
    return 1;
  return x->index < PNEU_PARAM_BASE_COUNT ? (double)*pneu_param_at(&declared, x->index) : (double)NAN;
}

/* The same unknown before anything was added; NaN if it was not fitted then. */
static double fitted_before(const drawing *d, const lab_unknown *x)
{
  const lab_unknowns *u = d->story->declared;
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == x->kind && u->unknown[j].index == x->index)
      return u->unknown[j].value;
  return (double)NAN;
}

static double per_cent(double value, double declared)
{
  return 100 * (value - declared) / fabs(declared);
}

int figure_draw_parameters(const drawing *d)
{
  const lab_unknowns *u = d->story->completed;
  const lab_fit_result *fit = &d->story->result->fit;
  int j, n = 0;
  char name[LAB_SHOWN_TEXT];
  figure_tell(d, "Fitted less declared, in per cent of declared.");
  fputs("$parameters << EOD\nrow,before,after,low,high,name\n", d->file);
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    const double declared = declared_of(d, x);
    const int is_free = fit->state[j] == LAB_FIT_FREE;
    if (isnan(declared) || declared == 0)
      continue;
    fprintf(d->file, "%d,%.5g,%.5g,%.5g,%.5g,\"%s\"\n", ++n, per_cent(fitted_before(d, x), declared),
            per_cent(x->value, declared), per_cent(is_free ? fit->low[j] : x->value, declared),
            per_cent(is_free ? fit->high[j] : x->value, declared), figure_plain(x->name, name));
    figure_tell(d, " %s %+.2f %%.", name, per_cent(x->value, declared));
  }
  fputs("EOD\n", d->file);
  if (n == 0)
    return 0;
  figure_entitle(d, "What the fit made of what was declared");
  figure_put_head(d, 200 + 36 * n, 110,
                  "A parameter that bends to stand in for a missing effect springs back when the effect is there");
  fprintf(d->file, "N = %d\n", n);
  figure_put_lines(d->file, script);
  return 1;
}
