#include "logs.h"

#include <math.h>
#include <stdlib.h>

#include "mend.h"
#include "../base/text.h"
#include "../run/schedule.h"

/* A set position with gaps is shown, and cannot drive. */
static void leave_out_u(const lab_rig *rig, lab_log *log, lab_logs *b)
{
  size_t i;
  if (!log->value[LAB_CHANNEL_U] || !log->value[LAB_CHANNEL_SP] || !lab_rig_has_positioner(rig))
    return;
  for (i = 0; i < log->n; i++)
    if (isnan(log->value[LAB_CHANNEL_SP][i]))
      return;
  free(log->value[LAB_CHANNEL_U]);
  log->value[LAB_CHANNEL_U] = NULL;
  b->n_without_u++;
}

static int read_log(const lab_rig *rig, const char *path, lab_logs *b, lab_error *error)
{
  lab_log *log = &b->log[b->n_logs];
  if (b->n_logs == LAB_LOGS_MAX)
    return lab_fail(error, LAB_DATA, "%s: more than %d logs", path, (int)LAB_LOGS_MAX);
  if (lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, log, error))
    return error->status;
  b->n_logs++;
  if (b->by_set_position)
    leave_out_u(rig, log, b);
  if (lab_positioner_check(rig, log, error))
    return error->status;
  if (*log->read_as)
    lab_limitation(&b->limitations, "%s: %s.", lab_file_name(path), log->read_as);
  lab_log_even_stamps(log, &b->limitations);
  if (lab_log_remove_hum(log, &b->limitations, error))
    return error->status;
  if (!b->is_whole)
    lab_log_thin(log, LAB_THIN_ROWS, &b->limitations);
  if (lab_log_clean(rig, log, &b->limitations, error) || lab_plausible(rig, log, &b->limitations, &b->content, error))
    return error->status;
  return lab_log_smooth_inputs(rig, log, &b->limitations, error);
}

int lab_logs_add(lab_logs *b, const lab_rig *rig, const char *path, lab_error *error)
{
  lab_log *log = &b->log[b->n_logs];
  size_t run;
  if (read_log(rig, path, b, error))
    return error->status;
  if (log->dropped > 0)
    lab_limitation(&b->limitations, "%s: %zu damaged rows of %zu are left out, as log.damaged asks.",
                   lab_file_name(log->path), log->dropped, log->dropped + log->outside + log->n);
  if (log->repeated > 0)
    lab_limitation(&b->limitations,
                   "%s: rows with the time of the row before, spread over the step of the clock: %zu; "
                   "log.damaged = \"drop\" leaves them out.",
                   lab_file_name(log->path), log->repeated);
  for (run = 0; run < log->n_runs; run++) {
    if (b->n == LAB_RUNS_MAX)
      return lab_fail(error, LAB_DATA, "%s: more than %d runs in all", path, (int)LAB_RUNS_MAX);
    if (lab_run_open(rig, log, run, &b->run[b->n++], error))
      return error->status;
  }
  return LAB_OK;
}

void lab_logs_close(lab_logs *b)
{
  while (b->n > 0)
    lab_run_close(&b->run[--b->n]);
  while (b->n_logs > 0)
    lab_log_free(&b->log[--b->n_logs]);
}
