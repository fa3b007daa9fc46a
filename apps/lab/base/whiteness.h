/* Is a residual white? Its autocorrelation, and the test of Ljung and Box on all of it at once.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_WHITENESS_H
#define LAB_WHITENESS_H

#include <stddef.h>

enum { LAB_WHITENESS_LAGS = 60 };

/* Consecutive values; NaN is a gap. Pairs are never formed across two stretches. */
typedef struct lab_stretch {
  const double *value;
  size_t n;
} lab_stretch;

typedef struct lab_whiteness {
  size_t n;                                   /* values, gaps not counted */
  int lags;                                   /* 10 log10(n), as is usual, within n/4 and LAB_WHITENESS_LAGS */
  double correlation[LAB_WHITENESS_LAGS + 1]; /* [1] at lag 0 .. lags; lag 1 is the one to quote */
  double deviation[LAB_WHITENESS_LAGS + 1];   /* its standard deviation, were the values white; 0 without any pair */
  double statistic;                           /* Q; NaN where there are too few values */
  int degrees;                                /* lags that have pairs */
  double p_value;                             /* of Q: small means not white; NaN as Q */
} lab_whiteness;

/* Test stretches of whitened residual. The mean is taken to be 0, as that of a residual should be: one that is off by a
 * constant is not white. Lags count rows.
 * Method:  rho_k = sum_k r_i r_(i+k) / sum r_i^2 over the M_k pairs without a gap, of variance M_k/(n(n + 2)) for white
 *          normal values; Q = sum_k rho_k^2 n(n + 2)/M_k is chi-square, one degree of freedom a lag.
 * Source:  Ljung and Box 1978, Biometrika 65:297, where M_k = n - k; with gaps after Stoffer and Toloi 1992, Statistics
 *          and Probability Letters 13:391
 * Omits:   the parameters that were fitted to the same values, which matter only where they are many beside n. */
void lab_whiteness_test(const lab_stretch *stretch, int n_stretches, lab_whiteness *w);

/* Whether a residual counts as white: its p-value is at least 0.01; as coloured: it is below. Too few values are
 * neither. */
int lab_is_white(const lab_whiteness *w);
int lab_is_coloured(const lab_whiteness *w);

#endif
