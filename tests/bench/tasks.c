#include "tasks.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../apps/lab/trace/score.h"
#include "../../apps/lab/base/array.h"

double bench_task_fit(void *context)
{
  static lab_unknowns u;
  bench_rig *r = context;
  lab_error error;
  const double started = bench_seconds();
  if (lab_unknowns_open(&r->rig, &r->run, 1, &u, &error) || lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error))
    return (double)NAN;
  return bench_seconds() - started;
}

int bench_scan_fit(bench_rig *r, bench_scan *scan, lab_error *error)
{
  scan->effects = 0;
  if (lab_unknowns_open(&r->rig, &r->run, 1, &scan->u, error))
    return error->status;
  return lab_unknowns_fit(&scan->u, LAB_ROUNDS_ALL, NULL, error);
}

/* The score test of the first effects of the catalogue, each at its usual size alone. */
static double score_some(const lab_projection *s, int effects)
{
  double *slope = malloc(s->m * sizeof *slope), sum = 0;
  lab_error ignored;
  int e;
  for (e = 0; e < effects && e < PNEU_EFFECT_COUNT && slope; e++) {
    const int param = pneu_effect_params(e, NULL);
    lab_rig model = s->u->rig;
    pneu_param_info info;
    pneu_param_describe(param, &info);
    *pneu_param_at(&model.params, param) = info.value;
    if (lab_projection_slope(s, &model, slope, &ignored) == 0 && lab_projection_visible(s, slope) > 0)
      sum += lab_dot(slope, s->r, s->m);
  }
  free(slope);
  return sum;
}

double bench_task_scan(void *context)
{
  bench_scan *b = context;
  lab_scores result;
  lab_projection s;
  lab_error error;
  const double started = bench_seconds();
  int status = lab_projection_open(&b->u, &s, &error);
  if (status == LAB_OK && b->effects > 0)
    score_some(&s, b->effects);
  else if (status == LAB_OK)
    status = lab_score_effects(&s, &result, &error);
  lab_projection_close(&s);
  return status == LAB_OK ? bench_seconds() - started : (double)NAN;
}

double bench_task_read(void *context)
{
  const bench_rig *r = context;
  char path[BENCH_PATH + 16];
  lab_error error;
  lab_log log;
  double started, seconds;
  snprintf(path, sizeof path, "%s/fit.csv", r->folder);
  started = bench_seconds();
  if (lab_log_read(path, &r->rig.log, (double)r->rig.params.ambient_pressure, &log, &error))
    return (double)NAN;
  seconds = bench_seconds() - started;
  lab_log_free(&log);
  return seconds;
}

double bench_task_command(void *context)
{
  const double started = bench_seconds();
  return system(context) == 0 ? bench_seconds() - started : (double)NAN;
}

void bench_closeloop_line(const bench *b, const bench_rig *r, char *line)
{
  const char *f = r->folder;
  snprintf(line, BENCH_LINE,
           "exec '%s/closeloop' '%s/rig.cfg' '%s/fit.csv' --holdout '%s/holdout.csv' --out '%s/answer' --quiet "
           ">/dev/null",
           b->programs, f, f, f, f);
}
