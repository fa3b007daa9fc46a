/* Periods that a residual shows: candidates for something that acts in cycles of time.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CYCLES_H
#define LAB_CYCLES_H

#include "../fit/unknowns.h"

enum { LAB_CYCLES_MAX = 24 };

/* Peaks of the periodograms of all channels, each over all logs; the highest over its surroundings first. Phases of the
 * logs do not count. Looked at are three cycles to a log at least, and eight rows to a cycle;
 * a peak counts where it is three times its surroundings at least.
 * In:      r       errors over noise, as from lab_unknowns_errors
 * Out:     period  [s] LAB_CYCLES_MAX at most
 *          n       their number
 * Returns: LAB_OK, LAB_WORLD. */
int lab_cycles_find(const lab_unknowns *u, const double *r, double *period, int *n, lab_error *error);

#endif
