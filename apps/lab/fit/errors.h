/* Errors of a model on its experiments.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ERRORS_H
#define LAB_ERRORS_H

#include "unknowns.h"

/* Root mean square per channel. */
typedef struct lab_errors {
  double rmse[LAB_CHANNEL_COUNT];     /* SI; NaN where not measured */
  double in_noise[LAB_CHANNEL_COUNT]; /* over the noise */
  double chi2;
  size_t n;
} lab_errors;

/* The errors of a model that cannot follow the logs: not a number. */
void lab_errors_none(lab_errors *errors);

/* Error of the present model of `u` on its experiments, row by row; rows of no weight are left out. */
int lab_loop_errors(const lab_unknowns *u, lab_errors *errors, lab_error *error);

/* The same without the drift of sensors that the residual shows: of a model that lacks nothing any more. */
int lab_errors_without_drift(const lab_unknowns *u, lab_errors *errors, lab_error *error);

#endif
