/* A three-way valve that holds a position, at 1 kHz: C90, and nothing but a copy of lib/ beside this file.
 *
 *   for file in $(find lib -name '*.c'); do cc -std=c99 -c $file; done
 *   cc -std=c90 -pedantic -Ilib -c hold.c && cc *.o -lm -o hold
 *
 * SPDX-License-Identifier: MIT */
#include <stdio.h>

#include "pneu.h"

static pneu_model model;
static pneu_state state;
static pneu_workspace work;

/* Fill below the wanted position, vent above it, shut within the band. */
static pneu_real command(pneu_real wanted, pneu_real x)
{
  const pneu_real band = (pneu_real)0.2e-3;
  if (x < wanted - band)
    return 1;
  return x > wanted + band ? (pneu_real)-1 : 0;
}

int main(void)
{
  const pneu_laws law = {PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 0};
  const pneu_real wanted[] = {(pneu_real)12e-3, (pneu_real)5e-3, (pneu_real)16e-3}, dt = (pneu_real)1e-3;
  pneu_params params;
  pneu_input input;
  int i, k, held = 0;
  pneu_params_default(&params);
  if (pneu_model_init(&model, &params, &law, NULL) != PNEU_OK)
    return 2;
  pneu_input_default(&model, &input);
  if (pneu_state_rest(&model, 0, params.ambient_temperature, 0, &input, &state) != PNEU_OK)
    return 2;
  for (i = 0; i < 3; i++) {
    for (k = 0; k < 10000; k++) {
      input.u = command(wanted[i], state.x);
      if (pneu_step(&model, &state, &input, dt, &work) != PNEU_OK)
        return 2;
    }
    printf("wanted %5.2f mm, held %5.2f mm\n", 1e3 * (double)wanted[i], 1e3 * (double)state.x);
    held += command(wanted[i], state.x) == 0;
  }
  return held == 3 ? 0 : 1;
}
