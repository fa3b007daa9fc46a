/* residual.csv: every row fitted, beside what both models make of it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "loopfiles.h"

/* Whether any experiment measures a channel. */
static int is_measured(const lab_unknowns *u, int channel)
{
  int e, c, any = 0;
  for (e = 0; e < u->n_experiments; e++)
    for (c = 0; c < u->experiment[e].n_channels; c++)
      any |= u->experiment[e].channel[c] == channel;
  return any;
}

static void residual_head(FILE *file, const lab_unknowns *u)
{
  int c;
  fputs("run [1],t [s]", file);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const lab_channel_info *info = &lab_channels[c];
    if (is_measured(u, c))
      fprintf(file, ",%s [%s],%s_before [%s],%s_after [%s],%s_residual_before [1],%s_residual_after [1]", info->key,
              info->unit, info->key, info->unit, info->key, info->unit, info->key, info->key);
  }
  fputc('\n', file);
}

/* One row of one channel; empty where the experiment does not have it, and in a gap. */
static void residual_cell(FILE *file, const lab_experiment *x, int channel, size_t i, const double *before,
                          const double *after)
{
  int c = 0;
  size_t at;
  double y;
  while (c < x->n_channels && x->channel[c] != channel)
    c++;
  y = c < x->n_channels ? lab_experiment_measured(x, c, i) : (double)NAN;
  at = (size_t)c * x->n + i;
  if (isnan(y))
    fputs(",,,,,", file);
  else
    fprintf(file, ",%.9g,%.9g,%.9g,%.5g,%.5g", y, y - before[at] * x->sigma[c], y - after[at] * x->sigma[c], before[at],
            after[at]);
}

static void residual_rows(FILE *file, const lab_unknowns *u, const double *before, const double *after)
{
  int e, c;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    size_t i;
    for (i = 0; i < x->n; i++) {
      fprintf(file, "%d,%.9g", e + 1, x->log->value[LAB_CHANNEL_TIME][x->first + i]);
      for (c = 0; c < LAB_CHANNEL_COUNT; c++)
        if (is_measured(u, c))
          residual_cell(file, x, c, i, before, after);
      fputc('\n', file);
    }
    before += x->n * (size_t)x->n_channels;
    after += x->n * (size_t)x->n_channels;
  }
}

int lab_story_residual(const lab_story *story, const char *folder, lab_error *error)
{
  const lab_unknowns *u = story->completed;
  double *before = malloc((u->n_rows + 1) * sizeof *before);
  double *after = malloc((u->n_rows + 1) * sizeof *after);
  lab_outfile out;
  int status = before && after ? LAB_OK : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    status = lab_unknowns_errors(story->declared, before, error);
  if (status == LAB_OK)
    status = lab_unknowns_errors(u, after, error);
  if (status == LAB_OK)
    status = lab_report_open(folder, "residual.csv", &out, error);
  if (status == LAB_OK) {
    residual_head(out.file, u);
    residual_rows(out.file, u, before, after);
    status = lab_out_close(&out, error);
  }
  free(before);
  free(after);
  return status;
}
