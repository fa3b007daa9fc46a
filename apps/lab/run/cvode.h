/* CVODE as the reference integrator. Every SUNDIALS call of the project is in cvode.c.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CVODE_H
#define LAB_CVODE_H

#include "../../../lib/pneu.h"
#include "../base/message.h"
#include "sampler.h"

/* Solver memory, reused from run to run. */
typedef struct lab_cvode lab_cvode;

/* Returns: NULL when out of memory. */
lab_cvode *lab_cvode_new(void);
void lab_cvode_free(lab_cvode *cvode);

/* A run under one input. */
typedef struct lab_cvode_stretch {
  const pneu_input *input;
  double duration;      /* [s] >= 0 */
  double tol;           /* local error in units of full scale, 1e-4 .. 1e-13 */
  lab_sampler *sampler; /* NULL: no samples */
  pneu_stats *stats;    /* added up, if not NULL */
} lab_cvode_stretch;

/* Run as pneu_run does, by BDF of variable order with a dense solver, the analytic Jacobian and root finding for the
 * events.
 * In/out:  state
 * Returns: LAB_OK, LAB_NUMERIC (named, with time and state), LAB_WORLD. */
int lab_cvode_run(lab_cvode *cvode, const pneu_model *model, const lab_cvode_stretch *stretch, pneu_state *state,
                  lab_error *error);

#endif
