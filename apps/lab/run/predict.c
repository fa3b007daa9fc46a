#include "predict.h"

#include "staging.h"
#include "start.h"

/* From the state in which a run begins. */
static int respond(const lab_prediction *f, const lab_staging *staging, lab_response *response, lab_error *error)
{
  const size_t first = f->log->run[f->run], end = f->log->run[f->run + 1];
  const double *rows = f->log->value[LAB_CHANNEL_TIME];
  pneu_state start;
  const lab_simulation task = {.start = &start,
                               .schedule = &staging->schedule,
                               .rows = staging->of,
                               .t = f->t ? f->t : rows + first,
                               .n = f->t ? f->n : end - first,
                               .t_end = rows[end - 1],
                               .options = f->options};
  if (lab_run_initial_state(staging->of[0], staging->input, f->log, f->run, &start, error))
    return error->status;
  return lab_response_run(staging->of[0], &task, response, error);
}

int lab_predict_log(const pneu_model *model, const lab_prediction *f, lab_response *response, lab_error *error)
{
  const lab_episode whole = {0, f->rig};
  lab_inputs inputs;
  lab_staging staging;
  int status;
  if (lab_inputs_from_log(model, f->rig, f->log, f->run, &inputs, error))
    return error->status;
  status = lab_staging_open(f->log, &inputs.schedule, NULL, 0, &whole, 1, &staging, error);
  if (status == LAB_OK)
    status = respond(f, &staging, response, error);
  lab_staging_close(&staging);
  lab_inputs_free(&inputs);
  return status;
}
