/* residual.csv: every row fitted, beside what both models make of it. */
#include <math.h>
#include <stdio.h>

#include "residual_table.h"

static void put_head(FILE *file, const lab_residual_table *v)
{
  int c;
  fputs("run [1],t [s]", file);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const lab_channel_info *info = &lab_channels[c];
    if (lab_residual_table_channel(v, c))
      fprintf(file, ",%s [%s],%s_before [%s],%s_after [%s],%s_residual_before [1],%s_residual_after [1]", info->key,
              info->unit, info->key, info->unit, info->key, info->unit, info->key, info->key);
  }
  fputc('\n', file);
}

/* One row of one channel; empty where the run does not have it, and in a gap. */
static void put_cell(FILE *file, const lab_residual_channel *mine, size_t row)
{
  if (isnan(mine->measured[row]))
    fputs(",,,,,", file);
  else
    fprintf(file, ",%.9g,%.9g,%.9g,%.5g,%.5g", mine->measured[row], mine->predicted[LAB_STAGE_BEFORE][row],
            mine->predicted[LAB_STAGE_AFTER][row], mine->residual[LAB_STAGE_BEFORE][row],
            mine->residual[LAB_STAGE_AFTER][row]);
}

static void put_run(FILE *file, const lab_residual_table *v, int run, const lab_run *x)
{
  size_t i;
  int c;
  for (i = 0; i < x->n; i++) {
    fprintf(file, "%d,%.9g", run + 1, x->log->value[LAB_CHANNEL_TIME][x->first + i]);
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      if (lab_residual_table_channel(v, c))
        put_cell(file, lab_residual_table_channel(v, c), v->first[run] + i);
    fputc('\n', file);
  }
}

int lab_report_residual(FILE *file, const lab_sources *from, lab_error *error)
{
  int run;
  (void)error;
  put_head(file, from->table);
  for (run = 0; run < from->table->n_runs; run++)
    put_run(file, from->table, run, &from->report->completed->run[run]);
  return LAB_OK;
}
