/* Samples of a run at given times, whichever integrator makes the run.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SAMPLER_H
#define LAB_SAMPLER_H

#include <stddef.h>

#include "../../../lib/pneu.h"

typedef struct lab_sampler {
  const double *t;         /* [s] increasing */
  size_t n, next;          /* number of times; the first that is still to come */
  double origin;           /* [s] time at which the present stretch began */
  const pneu_input *input; /* then */
  void (*take)(void *context, size_t i, const pneu_state *state, const pneu_input *input);
  void *context;
} lab_sampler;

/* Hand over a sample that is due.  In: state at t[next] */
void lab_sampler_take(lab_sampler *sampler, const pneu_state *state);

/* Time of the next sample from the origin of the stretch [s]; infinite after the last. */
double lab_sampler_due(const lab_sampler *sampler);

#endif
