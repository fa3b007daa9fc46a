#include "bench.h"

#include "mend.h"
#include "thin.h"

static int read_log(const lab_rig *rig, const char *path, lab_bench *b, lab_error *error)
{
  lab_log *log = &b->log[b->n_logs];
  if (b->n_logs == LAB_BENCH_LOGS)
    return lab_fail(error, LAB_DATA, "%s: more than %d logs", path, (int)LAB_BENCH_LOGS);
  if (lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, log, error))
    return error->status;
  b->n_logs++;
  lab_log_thin(log, LAB_THIN_ROWS, &b->remarks);
  if (lab_log_mend(rig, log, &b->remarks, error))
    return error->status;
  return lab_plausible(rig, log, &b->remarks, &b->content, error);
}

int lab_bench_add(lab_bench *b, const lab_rig *rig, const char *path, lab_error *error)
{
  lab_log *log = &b->log[b->n_logs];
  size_t run;
  if (read_log(rig, path, b, error))
    return error->status;
  for (run = 0; run < log->n_runs; run++) {
    if (b->n == LAB_BENCH_RUNS)
      return lab_fail(error, LAB_DATA, "%s: more than %d runs in all", path, (int)LAB_BENCH_RUNS);
    if (lab_experiment_open(rig, log, run, &b->experiment[b->n++], error))
      return error->status;
  }
  return LAB_OK;
}

void lab_bench_close(lab_bench *b)
{
  while (b->n > 0)
    lab_experiment_close(&b->experiment[--b->n]);
  while (b->n_logs > 0)
    lab_log_free(&b->log[--b->n_logs]);
}
