/* The four-parameter fit: orifices, dry friction, spring rate and preload from 450 rows of pressure and position.
 * SPDX-License-Identifier: MIT */
#ifndef BENCH_FITTING_H
#define BENCH_FITTING_H

#include "contender.h"

/* Rows made by the independent rig of tests/second, whose parameters are off by 5 to 10 %, with noise.
 * Out:     fit  at the declared values; its rows stay
 * Returns: 0, or -1 on failure */
int bench_fit_open(bench_fit *fit);

/* Make the model for factors on the declared values.  Returns: 0, or -1 where they are out of bounds */
int bench_fit_apply(bench_fit *fit, const double *theta);

/* What is simulated for a fit. */
const bench_case *bench_fit_task(const bench_fit *fit);

/* Sum of squares, weighted by the noise, of a simulation.  In: p, x, fit->task.rows each.  Out: r, twice as many */
double bench_fit_residuals(const bench_fit *fit, const double *p, const double *x, double *r);

double bench_fit_stepper(bench_fit *fit, double tol, double *theta);
double bench_fit_cvode(bench_fit *fit, double tol, double *theta);

#endif
