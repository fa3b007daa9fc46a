/* When does the stem of an R1-400 leave one stop and arrive at the other, filling and venting? The stepper says, by its
 * events.  Build: make
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include <pneu.h>

/* Print each change of mode; `context` is the time at which the run began. */
static int tell(void *context, pneu_real t, const pneu_state *state, int mode_before)
{
  printf("%7.3f s  %-12s -> %-12s  x = %5.2f mm, p = %5.1f kPa\n", *(double *)context + t, pneu_mode_text(mode_before),
         pneu_mode_text(state->mode), 1e3 * state->x, 1e-3 * state->p);
  return 0;
}

int main(void)
{
  const double command[] = {1, -1}, duration = 15;
  const pneu_laws law = {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 0};
  static pneu_model model;
  static pneu_workspace work;
  double begin = 0;
  const pneu_observer observer = {NULL, tell, &begin};
  pneu_params params;
  pneu_options options;
  pneu_input input;
  pneu_state state;
  int i, status, top_reached = 0;
  pneu_params_default(&params);
  pneu_options_default(&options);
  status = pneu_model_init(&model, &params, &law, NULL);
  if (status != PNEU_OK) {
    fprintf(stderr, "%s\n", pneu_status_text(status));
    return 1;
  }
  pneu_input_default(&model, &input);
  status = pneu_state_rest(&model, 0, params.ambient_temperature, 0, &input, &state);
  for (i = 0; i < 2 && status == PNEU_OK; i++) {
    input.u = command[i];
    pneu_settle(&model, &input, &state);
    status = pneu_run(&model, &state, &input, duration, &options, &observer, &work);
    top_reached |= state.mode == PNEU_MODE_UPPER;
    begin += duration;
  }
  printf("libpneu %s: %s after %ld steps\n", PNEU_VERSION, pneu_status_text(status), work.stats.steps);
  return status == PNEU_OK && top_reached && state.mode == PNEU_MODE_LOWER ? 0 : 1;
}
