#include "follow.h"

#include "schedule.h"
#include "start.h"

int lab_follow(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, const double *t, size_t n,
               const lab_response_options *options, lab_trace *trace, lab_error *error)
{
  lab_response_options own = *options;
  lab_drive drive;
  pneu_state start;
  int status;
  if (lab_drive_from_log(model, rig, log, run, &drive, error))
    return error->status;
  own.t_end = log->value[LAB_CHANNEL_TIME][log->run[run + 1] - 1];
  status = lab_start_from_log(model, drive.input, log, run, &start, error);
  if (status == LAB_OK)
    status = lab_respond(model, &start, &drive.schedule, t, n, &own, trace, NULL, error);
  lab_drive_free(&drive);
  return status;
}
