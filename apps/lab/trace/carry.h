/* What carries over: an effect that helps on the runs it was fitted to, and harms on the others, stands in for
 * something else.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CARRY_H
#define LAB_CARRY_H

#include "candidate.h"

/* Whether models are to be compared by that: there are three runs or more (CARRY_RUNS), and more than noise is left. */
int lab_carry_is_asked(const lab_candidate *c);

/* Error of a model on each run when it is fitted to the others (leave-one-out cross-validation: Stone 1974, J. R. Stat.
 * Soc. B 36:111). Of a run left out only what it has for itself is fitted: its start, the instants of its commands, its
 * own value of what differs from log to log. Each fit takes a few steps from that to all runs.
 * In:      c       fitted, seen row by row; two runs or more
 * Out:     of_run  for each run the sum of squares of its errors over the noise; infinite where it cannot be followed
 * Returns: LAB_OK, LAB_WORLD. */
int lab_carry_over(const lab_candidate *c, double *of_run, lab_error *error);

/* Whether another model errs less on runs left out, by more than the standard error of the sum of differences (Breiman
 * et al. 1984, Classification and Regression Trees, 3.4.3).
 * In:      other, present  errors of each of n runs, 2 or more; one that is infinite is worse than any that is not */
int lab_carry_is_better(const double *other, const double *present, int n);

/* Take out again, last first, each effect without which that error is smaller, where that is asked, until the time is
 * spent.
 * In/out:  c    fitted
 * Out:     any  whether one was taken out
 * Returns: LAB_OK, LAB_WORLD. */
int lab_carry_prune(lab_candidate *c, int *any, lab_error *error);

#endif
