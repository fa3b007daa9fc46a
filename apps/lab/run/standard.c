#include "standard.h"

enum { ROWS = 3051, PERIOD_MS = 10 };

static const double phase_time[] = {0, 0.5, 15.5}; /* [s] */
static const double phase_command[] = {0, 1, -1};
enum { PHASES = sizeof phase_time / sizeof phase_time[0] };

/* A transducer that regulates pressure is asked for the supply, then for ambient. */
static double command_for(const pneu_model *model, double opening)
{
  if (model->p.proportional_band > 0)
    return opening > 0 ? (double)model->p.supply_pressure : 0;
  return opening;
}

int lab_standard_experiment(const pneu_model *model, const lab_response_options *options, lab_response *response,
                            lab_error *error)
{
  pneu_input input[PHASES];
  lab_schedule schedule = {PHASES, phase_time, input};
  pneu_state start;
  double t[ROWS];
  const lab_simulation task = {.start = &start, .schedule = &schedule, .t = t, .n = ROWS, .options = *options};
  int i, status;
  for (i = 0; i < PHASES; i++) {
    pneu_input_default(model, &input[i]);
    input[i].u = (pneu_real)command_for(model, phase_command[i]);
  }
  for (i = 0; i < ROWS; i++)
    t[i] = i * PERIOD_MS / 1000.0;
  status = pneu_state_rest(model, 0, model->p.ambient_temperature, 0, &input[0], &start);
  if (status != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "no state at rest to start from: %s", pneu_status_text(status));
  return lab_response_run(model, &task, response, error);
}
