/* What the files of the fit share. Every parameter is searched as z, 0 at its start:
 * theta = start + unit z, or start exp(z) where it is log-scaled.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIT_PRIVATE_H
#define LAB_FIT_PRIVATE_H

#include "fit.h"

/* One start of a fit, from its first evaluation to its last; used by one thread. */
typedef struct fit_run {
  const lab_fit_problem *problem;
  const lab_fit_options *options;
  double unit[LAB_FIT_MAX];                      /* of linear parameters, in their unit */
  double lower[LAB_FIT_MAX], upper[LAB_FIT_MAX]; /* of z */
  double step[LAB_FIT_MAX];                      /* of the next difference, in z */
  double *r, *slope; /* m, and m * n column by column: of the latest fit_evaluate and fit_differentiate */
  double best;       /* least sum of squares seen; infinite before the first */
  double best_z[LAB_FIT_MAX];
  int held[LAB_FIT_MAX]; /* -1, 1: kept at its lower, upper bound by the polish; 0: free */
  int finish;            /* enum lab_fit_finish */
  long evaluations, failed;
  int status; /* LAB_OK, or what ended this start, with the error */
  lab_error error;
} fit_run;

/* Outcome of an evaluation. */
enum { FIT_GOOD = 0, FIT_BAD = 1 /* the model fails here */, FIT_END = 2 /* run->status says why */ };

/* Units and bounds of z; memory for the residuals.
 * Out:     run  to be freed with fit_close
 * Returns: LAB_OK, LAB_WORLD. */
int fit_open(fit_run *run, const lab_fit_problem *problem, const lab_fit_options *options, lab_error *error);
void fit_close(fit_run *run);

/* Parameters at z, clipped to their bounds. */
void fit_theta(const fit_run *run, const double *z, double *theta);

/* Residuals over sigma, at z clipped to its bounds, into run->r; keeps the best point.
 * Out:     sum  of squares; infinite unless FIT_GOOD
 * Returns: FIT_GOOD, FIT_BAD, FIT_END. */
int fit_evaluate(fit_run *run, const double *z, double *sum);

/* d(residual over sigma)/dz at z, which the bounds contain, into run->slope; run->r is what fit_evaluate gave there
 * and is kept.
 * Method:  the problem's own slopes, or central differences. Their step begins at the cube root of the precision and
 *          is from then on what moves the residuals by a tenth of their scatter: models with stops have kinks in
 *          their parameters, across which a longer step would average.
 * In:      hold  columns to leave at 0 where not 0; may be NULL
 * Returns: FIT_GOOD, or FIT_END. */
int fit_differentiate(fit_run *run, const double *z, const int *hold);

/* Stage 1: from z, the best point found is in the run. */
int fit_search(fit_run *run, const double *z, unsigned long seed);

/* Stage 2: from the best point to the nearest minimum, which becomes the best point; sets held and finish.
 * Returns: FIT_GOOD, FIT_END. */
int fit_polish(fit_run *run);

/* Covariance, intervals and remarks at the best point.  Returns: FIT_GOOD, FIT_END. */
int fit_spread(fit_run *run, lab_fit_result *result);

#endif
