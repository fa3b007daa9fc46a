#include "predict.h"

#include "schedule.h"
#include "start.h"

int lab_predict_log(const pneu_model *model, const lab_prediction *f, lab_response *response, lab_error *error)
{
  const size_t first = f->log->run[f->run], end = f->log->run[f->run + 1];
  const double *rows = f->log->value[LAB_CHANNEL_TIME];
  lab_simulation task = {.t = f->t ? f->t : rows + first, .n = f->t ? f->n : end - first};
  lab_inputs inputs;
  pneu_state start;
  int status;
  if (lab_inputs_from_log(model, f->rig, f->log, f->run, &inputs, error))
    return error->status;
  task.start = &start;
  task.schedule = &inputs.schedule;
  task.t_end = rows[end - 1];
  task.options = f->options;
  status = lab_run_initial_state(model, inputs.input, f->log, f->run, &start, error);
  if (status == LAB_OK)
    status = lab_response_run(model, &task, response, error);
  lab_inputs_free(&inputs);
  return status;
}
