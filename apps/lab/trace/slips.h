/* The search seen coarsely: no model follows each slip of a stem that sticks and slips.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SLIPS_H
#define LAB_SLIPS_H

#include "rounds.h"

/* It is made where the log is rougher than the model, values within tolerances do not explain it row by row, and
 * friction that falls with speed explains much (MUCH) of what the declared model leaves: a valve that is worn or set
 * otherwise is far from its declared model, but need not stick and slip.
 * In:      u     the declared model, fitted
 * Out:     done  1 if it found why stems slip and left only noise; else
 *          f     is as it was
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_slips_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                     lab_error *error);

#endif
