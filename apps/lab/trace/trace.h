/* Trace a residual to the effect that the model lacks: the score test with what was fitted projected out.
 *
 * With r the whitened residual of the fit, J its slopes in what was fitted and s its slope in the size of an effect at
 * neutral, s' = s with the span of J taken out, the statistic T = (s'.r)^2/(s'.s') is chi-square with one degree of
 * freedom when nothing is missing (Rao 1948). Where a small size says little about a large one, the slope is a secant
 * to the effect's usual size as well, and effects with a shape are tried with several; the largest T counts, and the
 * number of all that were tried goes into the level of the test (Bonferroni).
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TRACE_H
#define LAB_TRACE_H

#include "scan.h"

enum { LAB_TRACE_MAX = 64 };

/* One way in which something may be missing. */
typedef struct lab_candidate {
  int effect; /* index of the effect */
  int param;  /* its parameter that is not neutral, as in pneu_param_describe */
  int shape;  /* its shape parameter, -1 if none */
  double shape_value;
  double size;      /* by which the parameter would have to leave neutral, by the slope */
  double statistic; /* T; 0 where the sign is impossible or the log does not see it */
  double against;   /* the same where the sign is impossible: what a bent fit makes of an effect that is there */
  double p_value;   /* of T alone */
  double explained; /* share of the chi-square excess that the slope explains */
  double visible;   /* [1] length of s' over length of s: what fitting has left of it; 0: invisible */
} lab_candidate;

typedef struct lab_trace_result {
  int n; /* candidates, largest statistic first */
  lab_candidate candidate[LAB_TRACE_MAX];
  int tests; /* slopes tried in all */
} lab_trace_result;

/* Try every effect that the model does not have; one whose slope cannot be simulated is not seen.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_trace_effects(const lab_scan *scan, lab_trace_result *result, lab_error *error);

#endif
