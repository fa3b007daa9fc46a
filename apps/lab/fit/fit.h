/* Least squares within bounds, for models whose every evaluation is a simulation: where a fit may have more than one
 * basin, a search of the whole box by NLopt; then the method of Levenberg and Marquardt on the normal equations, with
 * two savings that a general package does not have. Slopes are kept for as long as they predict well, corrected by what
 * each step shows of them (Broyden 1965, Math. Comp. 19:577), and a step that runs into bounds is finished inside them
 * instead of being started again.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIT_H
#define LAB_FIT_H

#include <stddef.h>

#include "../base/message.h"

enum { LAB_FIT_MAX = 256 };

typedef struct lab_fit_problem {
  int n;    /* unknowns, 0 .. LAB_FIT_MAX */
  size_t m; /* residuals */
  const double *lower, *upper;
  void *context;
  /* Residuals at theta.  Returns: LAB_OK; LAB_NUMERIC where the model fails, which is avoided; else the end. */
  int (*residuals)(void *context, const double *theta, double *r, lab_error *error);
  /* Column j of the slopes, d r / d theta_j; called from several threads.  Returns: as above; where it is LAB_NUMERIC,
   * the unknown stays where it is. */
  int (*slope)(void *context, const double *theta, const double *r, int j, double *column, lab_error *error);
  /* 0 is the default of what follows. */
  /* Columns that come together more cheaply than one by one: J as of lab_fit_slopes; done: n, not 0 for those
   * that are there already, and then for these.
   * Returns: as above. */
  int (*together)(void *context, const double *theta, double *J, char *done, lab_error *error);
  /* Where the slopes are kept, m * n, column by column, so that the next fit can begin with those of this one; NULL:
   * they are forgotten. */
  double *slopes;
  const char *is_known; /* n: whether a column of them is known already, nearly; NULL: none is */
  int is_brief;         /* it may end on slopes that were kept, and at 1e-4 of what chi-square exceeds m by: where it
                           ends is not the answer */
  int is_rough;         /* its slopes change from place to place: they are taken anew at every step */
  int steps;            /* downhill, at most; 0: 40 */
  int search;           /* evaluations of the search, for which the bounds are finite; 0: there is none */
  double enough;        /* of chi-square: it ends where the linear model promises less; 0: 0.02 */
  double enough_share;  /* the same as a share of chi-square, if that is more; 0: 1e-6 */
  double until;         /* [s] of CPU time, after which it ends where it is; 0: there is no end */
} lab_fit_problem;

/* Fit from theta. However little time is left, the model is evaluated once.
 * In/out:  theta  n values within the bounds; as they were if it fails
 * Out:     chi2   sum of squares there
 * Returns: LAB_OK; LAB_NUMERIC if the model fails at the start; LAB_WORLD; or what ended it. */
int lab_fit(const lab_fit_problem *problem, double *theta, double *chi2, lab_error *error);

/* Sum of squares at theta.
 * Out:     r  m residuals
 * Returns: as problem->residuals; LAB_NUMERIC where one of them is not finite. */
int lab_fit_evaluate(const lab_fit_problem *problem, const double *theta, double *r, double *chi2, lab_error *error);

/* Columns of the slopes, in parallel; 0 where one is not to be had.
 * Out:     J  m * n, column by column */
int lab_fit_slopes(const lab_fit_problem *problem, const double *theta, const double *r, double *J, lab_error *error);

/* The same of those columns that are not done yet.
 * In/out:  done  n: not 0 for these */
int lab_fit_other_slopes(const lab_fit_problem *problem, const double *theta, const double *r, double *J, char *done,
                         lab_error *error);

/* The best point of problem->search evaluations in the box and of theta.  In/out: theta  Returns: as lab_fit. */
int lab_fit_search(const lab_fit_problem *problem, double *theta, lab_error *error);

#endif
