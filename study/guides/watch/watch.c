/* Watches an actuator as firmware would: steps the fitted model with the command, a millisecond at a time, and says where
 * the measured pressure leaves it. Reads "t [ms] u p [Pa]" from standard input.
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "model.h" /* by closeloop */
#include "pneu.h"

static pneu_model model;
static pneu_workspace work; /* static: no heap, and little stack */

int main(void)
{
  const pneu_params params = MODEL_PARAMS;
  const pneu_laws law = MODEL_LAWS;
  const pneu_real noise = (pneu_real)320; /* [Pa] of the sensor */
  pneu_input input;
  pneu_state state;
  double worst = 0;
  long t, now = 0;
  double u, p;
  if (pneu_model_init(&model, &params, &law, NULL) != PNEU_OK)
    return 1;
  pneu_input_default(&model, &input);
  if (pneu_state_rest(&model, 0, params.ambient_temperature, 0, &input, &state) != PNEU_OK)
    return 1;
  while (scanf("%ld %lf %lf", &t, &u, &p) == 3) {
    const double off = p;
    for (; now < t; now++)
      if (pneu_step(&model, &state, &input, (pneu_real)1e-3, &work) != PNEU_OK)
        return 1;
    input.u = (pneu_real)u;
    if (off - (double)state.p > worst)
      worst = off - (double)state.p;
    if ((double)state.p - off > worst)
      worst = (double)state.p - off;
  }
  printf("%ld ms, pressure off by at most %.0f times the noise\n", now, worst / (double)noise);
  return 0;
}
