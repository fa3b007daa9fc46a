/* Fills an R1-400 for 20 s with and without the relief valve, and prints the pressure it comes to.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "pneu.h"

static double final_pressure(double slope)
{
  const pneu_laws law = {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 0};
  static pneu_model model;
  static pneu_workspace work;
  pneu_params p;
  pneu_options options;
  pneu_input input;
  pneu_state state;
  int count;
  const int first = pneu_effect_params(PNEU_EFFECT_relief_valve, &count);
  pneu_params_default(&p);
  *pneu_param_at(&p, first) = slope;
  pneu_model_init(&model, &p, &law, NULL);
  pneu_input_default(&model, &input);
  pneu_state_rest(&model, 0, p.ambient_temperature, 0, &input, &state);
  pneu_options_default(&options);
  input.u = 1;
  pneu_run(&model, &state, &input, 20, &options, NULL, &work);
  return state.p;
}

int main(void)
{
  printf("without: %.1f kPa\n", final_pressure(0) / 1e3);
  printf("with:    %.1f kPa\n", final_pressure(2e-12) / 1e3);
  return 0;
}
