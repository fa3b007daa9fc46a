/* Runs that are followed to first order: what a fit left of them, and what its unknowns move there. A fit to other runs
 * beside these simulates only the others.
 * Left out: what is not first order. Where a fit ends far from where these were simulated, they have to be again.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LINEAR_H
#define LAB_LINEAR_H

#include "unknowns.h"

typedef struct lab_linear {
  int n_runs, n;             /* runs and unknowns, the first of those that a fit has; instants of commands stay */
  size_t rows;               /* of all runs, times channels */
  double theta[LAB_FIT_MAX]; /* where they were simulated */
  double *error;             /* measured less predicted, SI; 0 at a gap */
  double *slope;             /* of that in each unknown, `rows` after `rows` */
} lab_linear;

/* Simulate the runs of u at its present values; u->window is 0. The unknowns are those of u without its instants.
 * Out:     l  to be closed, also after an error
 * Returns: as lab_unknowns_residuals; LAB_NUMERIC without time */
int lab_linear_open(const lab_unknowns *u, lab_linear *l, lab_error *error);
void lab_linear_close(lab_linear *l);

/* Whether run e of u is followed so. */
int lab_linear_has(const lab_unknowns *u, int e);

/* Errors of run e over its noise, row by row, at theta; what they change from theta to another.
 * In:  u  whose run e is followed so */
void lab_linear_errors(const lab_unknowns *u, int e, const double *theta, double *r);
void lab_linear_change(const lab_unknowns *u, int e, const double *theta, const double *other, double *change);

#endif
