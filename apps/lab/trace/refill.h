/* A leak that a positioner makes up for.
 *
 * It fills again and again, and how often depends on the leak. From no leak no slope tells that: leaks of many sizes
 * are simulated, and those that come nearest to the logs are fitted.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REFILL_H
#define LAB_REFILL_H

#include "rounds.h"

/* Whether there is one run, seen row by row, that a positioner follows by its set position. */
int lab_refill_loops(const lab_unknowns *u);

/* The same, if the model has no leak. */
int lab_refill_is_asked(const lab_unknowns *u);

/* Look for such a leak where values within their tolerances leave plainly more than noise, or are far beyond these, and
 * go on from it.
 * In:      u     the declared model, fitted
 * In/out:  f     with the errors of that; if done, what was found
 * Out:     done  whether a leak, with what is found beside it, leaves only noise; else f is as it was
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refill_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                      lab_error *error);

/* Fit to ever longer beginnings, from where something begins: over a long run a leak of a wrong size falls out of step.
 * Returns: LAB_OK, also where there is no fit, as quality.fitted says; LAB_WORLD. */
int lab_refill_fit(lab_candidate *c, lab_error *error);

/* Score a leak that begins at a row by the size that comes nearest, if that is more than any other score.
 * In:      base    without a leak, with what has been until then, not fitted to the rest; quality: chi2 of all of it
 * In/out:  begins  scores of what may begin
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refill_score(const lab_candidate *base, size_t row, lab_onset_scores *begins, lab_error *error);

#endif
