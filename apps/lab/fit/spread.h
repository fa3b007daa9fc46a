/* What the data say about each unknown of a fit: intervals, covariance, and in words what they do not determine. The
 * residuals are in units of the noise; where more than noise is left, intervals are wider by its root mean square, or
 * by what its stretches of one sign ask for, if that is more (Liang and Zeger 1986, Biometrika 73:13).
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SPREAD_H
#define LAB_SPREAD_H

#include "fit.h"

enum { LAB_FIT_UNDETERMINED_TEXT = 640 };

/* An unknown, in words and size. */
typedef struct lab_fit_param {
  const char *name;
  double scale; /* a change that matters; 0: |value|, or a hundredth of the range if that is 0 */
  int silent;   /* not 0: nothing is said of it in words */
} lab_fit_param;

enum lab_fit_state {
  LAB_STATE_FREE,     /* found inside its bounds */
  LAB_STATE_AT_LOWER, /* the data pull it against a bound: the interval begins there */
  LAB_STATE_AT_UPPER,
  LAB_STATE_UNDETERMINED /* the data say nothing of it, or only of a combination: the interval is the bounds */
};

/* Plain data; no memory to free. */
typedef struct lab_fit_result {
  int n;
  int state[LAB_FIT_MAX];                       /* enum lab_fit_state */
  double low[LAB_FIT_MAX], high[LAB_FIT_MAX];   /* 95 % interval */
  double deviation[LAB_FIT_MAX];                /* standard deviation; infinite where undetermined, 0 at a bound */
  double covariance[LAB_FIT_MAX][LAB_FIT_MAX];  /* of theta; rows and columns of unknowns not free are 0 */
  double chi2;                                  /* sum of squares */
  double reduced_chi2;                          /* chi2 over degrees of freedom; NaN without any */
  char undetermined[LAB_FIT_UNDETERMINED_TEXT]; /* what the data cannot determine; "" where all is well */
} lab_fit_result;

/* Look at a fit where it ended.
 * In:      problem  as it was fitted
 *          param    of each unknown
 *          theta    n values within the bounds
 * Returns: as problem->residuals. */
int lab_fit_spread(const lab_fit_problem *problem, const lab_fit_param *param, const double *theta,
                   lab_fit_result *result, lab_error *error);

/* Words for enum lab_fit_state. */
const char *lab_fit_state_text(int state);

#endif
