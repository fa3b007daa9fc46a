/* Rivals of what was found: effects that might as well stand in its place.
 *
 * A search ranks effects by brief fits, which differ by less than a fit to the end gains. So each effect that was found
 * is put to the test once more: it is taken out of the final model, all others are scored, and those that score nearly
 * as high are fitted to the end in its place, with everything that varies: from its values, and from those declared,
 * for beside the wrong effect they are bent. The best one stays, or, where that is asked (carry.h), the one that carries
 * over best; those that the logs cannot tell from the best are noted.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RIVALS_H
#define LAB_RIVALS_H

#include "candidate.h"

/* In/out:  c        fitted, seen row by row, with what is held among its unknowns
 * Out:     changed  whether one of its effects gave way to another
 * Returns: LAB_OK, also where the time is spent; LAB_WORLD. */
int lab_rivals_try(lab_candidate *c, int *changed, lab_error *error);

#endif
