/* What a user of the library needs, and no more: one header, C90, an actuator a millisecond at a time.
 * Prints the position each half second of a fill; exit status 0 if the stem has arrived. */
#include <stdio.h>

#include "../lib/pneu.h"

static pneu_model model;
static pneu_state state;
static pneu_workspace work;

int main(void)
{
  pneu_laws law = {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 0};
  pneu_params params;
  pneu_input input;
  int i, status;

  pneu_params_default(&params);
  status = pneu_model_init(&model, &params, &law, NULL);
  pneu_input_default(&model, &input);
  if (status == PNEU_OK)
    status = pneu_state_rest(&model, 0, params.ambient_temperature, 0, &input, &state);

  input.u = 1;
  for (i = 1; i <= 6000 && status == PNEU_OK; i++) {
    status = pneu_step(&model, &state, &input, (pneu_real)1e-3, &work);
    if (i % 500 == 0)
      printf("%.1f s  %5.2f mm  %s\n", i * 1e-3, (double)state.x * 1e3, pneu_mode_text(state.mode));
  }
  if (status != PNEU_OK)
    printf("%s\n", pneu_status_text(status));
  return status != PNEU_OK || state.mode != PNEU_MODE_UPPER;
}
