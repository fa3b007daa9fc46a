/* What refits of effects, of what begins and of free terms share. Private to these files.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REFIT_PRIVATE_H
#define LAB_REFIT_PRIVATE_H

#include "refit.h"

/* Fit one of many candidates, which fail for want of memory together; not at all when the time is spent. */
int lab_refit_one(lab_candidate *c, int steps, lab_error *all);

/* Candidates that begin at the same values of their unknowns begin with the same slopes in them, and each keeps its own
 * from fit to fit: slopes are what a refit costs. */
typedef struct lab_shared_slopes {
  lab_candidate base; /* with its slopes */
  int has_slopes;
} lab_shared_slopes;

/* Where extensions of one model begin: at its fit, and at the values that its unknowns had before any fit. */
typedef struct lab_refit_starts {
  lab_shared_slopes of[2];
  double until; /* [s] of CPU time: after it no more begin, so that there is time for those that did; 0: never */
} lab_refit_starts;

/* Returns: NULL for want of memory; else to be closed */
lab_refit_starts *lab_refit_open_starts(const lab_candidate *base, lab_error *error);

/* In/out:  c  n candidates that began there */
void lab_refit_close_starts(lab_refit_starts *s, lab_candidate *c, int n);

/* Find the slopes of a base, where there is room for them and they can be had. */
void lab_refit_share(lab_shared_slopes *s, lab_error *all);

/* Whether an extension of a base has a fit: it begins with the slopes of its base. */
int lab_refit_begin(const lab_candidate *base, int steps, lab_candidate *c, lab_error *all);

#endif
