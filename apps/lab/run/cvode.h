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

/* Run with constant input, as pneu_run does, by BDF of variable order with a dense solver, the
 * analytic Jacobian and root finding for the events.
 * In:      duration  [s] >= 0;  tol  local error in units of full scale, 1e-4 .. 1e-13
 *          sampler   may be NULL
 * In/out:  state;  stats (added up; may be NULL)
 * Returns: LAB_OK, LAB_NUMERIC (named, with time and state), LAB_WORLD. */
int lab_cvode_run(lab_cvode *cvode, const pneu_model *model, pneu_state *state, const pneu_input *input,
                  double duration, double tol, lab_sampler *sampler, pneu_stats *stats, lab_error *error);

#endif
