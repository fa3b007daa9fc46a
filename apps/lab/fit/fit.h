/* Weighted least squares for the parameters of a model: a rough search by NLopt from one or many starts, then
 * Levenberg-Marquardt (cminpack), then what the data say about each parameter.
 *
 * Bounds hold to the last bit. The best point ever seen is kept, whatever an optimiser returns. The result does not
 * depend on the number of threads.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FIT_H
#define LAB_FIT_H

#include <stddef.h>
#include <stdio.h>

#include "../base/message.h"

enum { LAB_FIT_MAX = 96, LAB_FIT_REMARK = 640 };

/* A parameter to be found. */
typedef struct lab_fit_param {
  const char *name, *unit;
  double start;
  double lower, upper; /* may be infinite where options.starts is 1 */
  int log_scaled;      /* not 0: searched, and its interval computed, on a logarithmic scale; needs lower > 0 */
  double scale;        /* a change that matters, in `unit`; 0: |start|, or a hundredth of the range if that is 0 */
} lab_fit_param;

/* Residuals, model minus data, at theta (n entries, within the bounds).
 * Out:     r  m entries
 * Returns: LAB_OK; LAB_NUMERIC if the model fails at this point, which the search then avoids; any other status
 *          ends the fit. A residual that is not finite counts as LAB_NUMERIC.
 * With options.threads > 1 it is called from several threads at once with the same context. */
typedef int lab_fit_residuals(void *context, const double *theta, double *r, lab_error *error);

/* Slopes of the residuals, column by column: slope[j * m + i] = d r_i / d theta_j.  Returns: as above. */
typedef int lab_fit_slopes(void *context, const double *theta, const double *r, double *slope, lab_error *error);

typedef struct lab_fit_problem {
  int n; /* 1 .. LAB_FIT_MAX */
  const lab_fit_param *param;
  size_t m;
  lab_fit_residuals *residuals;
  lab_fit_slopes *slopes; /* NULL: central differences */
  void *context;
  const double *sigma; /* m standard deviations, each > 0, in units of the residuals; NULL: all equal */
  int sigma_known;     /* not 0: sigma is the noise itself, so intervals are normal, and wider by the root of
                          reduced chi-square where more than noise is left; else the residuals set its size and
                          intervals are Student's t with m - n degrees of freedom */
} lab_fit_problem;

enum lab_fit_search {
  LAB_FIT_NONE,        /* the start is the answer: only intervals and remarks */
  LAB_FIT_POLISH_ONLY, /* Levenberg-Marquardt from the start */
  LAB_FIT_BOBYQA,      /* quadratic model; for smooth residuals */
  LAB_FIT_SBPLX,       /* simplex on subspaces; for kinks */
  LAB_FIT_CRS          /* controlled random search over the whole box, seeded by the number of the start */
};

typedef struct lab_fit_options {
  int search;        /* enum lab_fit_search */
  int starts;        /* 1: param.start alone; more: also points spread evenly over the box (Halton) */
  int threads;       /* 1 .. ; over starts */
  int search_count;  /* evaluations of the search per start and parameter */
  int polish_count;  /* evaluations of Levenberg-Marquardt per start and parameter */
  double chi2_exact; /* relative change of the sum of squares at which the polish ends */
  double precision;  /* relative precision of the residuals; the step of the differences is its cube root */
} lab_fit_options;

enum lab_fit_state {
  LAB_FIT_FREE,     /* found inside its bounds */
  LAB_FIT_AT_LOWER, /* the data pull it against a bound: the interval begins there */
  LAB_FIT_AT_UPPER,
  LAB_FIT_UNDETERMINED /* the data say nothing of it, or only of a combination: the interval is the bounds */
};

enum lab_fit_finish {
  LAB_FIT_CONVERGED,
  LAB_FIT_ROUNDOFF,     /* stopped where rounding is as large as the improvement: as good as it gets */
  LAB_FIT_COUNT_REACHED /* polish_count was reached; the point may still move */
};

/* Plain data; no memory to free. */
typedef struct lab_fit_result {
  int n;
  size_t m;
  double theta[LAB_FIT_MAX];
  int state[LAB_FIT_MAX];                      /* enum lab_fit_state */
  double low[LAB_FIT_MAX], high[LAB_FIT_MAX];  /* 95 % interval */
  double deviation[LAB_FIT_MAX];               /* standard deviation; infinite where undetermined, 0 at a bound */
  double covariance[LAB_FIT_MAX][LAB_FIT_MAX]; /* of theta; rows and columns of parameters not free are 0 */
  double singular[LAB_FIT_MAX]; /* of the Jacobian with columns of unit length, largest first; free ones only */
  int n_free;                   /* neither at a bound nor undetermined */
  double chi2;                  /* sum of squares of residual over sigma */
  double reduced_chi2;          /* chi2 over degrees of freedom; NaN without any */
  double rmse;                  /* root mean square of the residuals, in their units */
  double degrees;               /* of freedom: m less the free parameters */
  double quantile;              /* half width of the interval over the standard deviation */
  int finish;                   /* enum lab_fit_finish */
  int starts, agree;            /* starts that gave a point; those of them that ended at the best one */
  long evaluations, failed;     /* calls of the residuals; those that gave LAB_NUMERIC */
  char remark[LAB_FIT_REMARK];  /* what the data cannot determine, in words; "" where all is well */
} lab_fit_result;

/* BOBYQA from one start, one thread.  Out: options */
void lab_fit_options_default(lab_fit_options *options);

/* Fit.
 * In:      options  NULL: default
 * Out:     result
 * Returns: LAB_OK; LAB_DATA for a problem that is none (bounds, start, sizes), named; LAB_NUMERIC if the model fails
 *          at every start; LAB_WORLD; or what ended the fit from the callback. */
int lab_fit_run(const lab_fit_problem *problem, const lab_fit_options *options, lab_fit_result *result,
                lab_error *error);

/* Words for enum lab_fit_state. */
const char *lab_fit_state_text(int state);

#endif
