/* Refits of a model with a free term, where nothing that has a name would do.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_NAMELESS_H
#define LAB_NAMELESS_H

#include "attempt.h"

/* Refit the best slots, in parallel: briefly, then the best few of them to the end; a term that acts on a short stretch
 * gets its knots there.
 * In:      base  fitted
 *          slot  n of them, best first
 * Out:     best  fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_slots(const lab_attempt *base, const lab_slot *slot, int n, lab_attempt *best, lab_error *error);

#endif
