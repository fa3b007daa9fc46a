/* Least squares within bounds, for models whose every evaluation is a simulation: Levenberg's method on the normal
 * equations, with two savings that a general package does not have. Slopes in what hardly bends the model (the instants
 * of commands) are kept from step to step for as long as they predict well, and a step that runs into bounds is
 * finished inside them instead of being started again.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DESCENT_H
#define LAB_DESCENT_H

#include <stddef.h>

#include "../base/message.h"

typedef struct lab_descent {
  int n;     /* unknowns, up to LAB_DESCENT_MAX */
  size_t m;  /* residuals */
  int steps; /* downhill, at most */
  const double *lower, *upper;
  const unsigned char *lasting; /* not 0: its slope is kept while it predicts well */
  void *context;
  /* Residuals at theta.  Returns: LAB_OK; LAB_NUMERIC where the model fails, which is avoided; else the end. */
  int (*residuals)(void *context, const double *theta, double *r, lab_error *error);
  /* Column j of the slopes, d r / d theta_j; called from several threads.  Returns: as above. */
  int (*slope)(void *context, const double *theta, const double *r, int j, double *column, lab_error *error);
} lab_descent;

enum { LAB_DESCENT_MAX = 96 };

/* Descend from theta to the nearest minimum. It ends where the linear model promises less than 0.02 of chi-square, or
 * a millionth of it if that is more.
 * In/out:  theta  n values within the bounds
 * Out:     chi2   sum of squares there
 * Returns: LAB_OK; LAB_NUMERIC if the model fails at the start; LAB_WORLD; or what ended it. */
int lab_descend(const lab_descent *problem, double *theta, double *chi2, lab_error *error);

/* Solve a x = b for a symmetric, positive matrix of rows `stride` apart; a becomes its Cholesky factor.
 * In/out:  b  becomes x
 * Returns: 0, or -1 if the matrix is not positive. */
int lab_solve_positive(int n, int stride, double *a, double *b);

#endif
