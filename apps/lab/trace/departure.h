/* Where a run leaves the model that explains its beginning.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DEPARTURE_H
#define LAB_DEPARTURE_H

#include "candidate.h"

/* Steps of a fit from the values of a shorter beginning: these are near, unless something begins. By judgement. */
enum { LAB_STEPS_ONWARD = 12 };

/* Fit ever longer beginnings of the only run, to the longest that leaves only noise.
 * In:      known    rows that do, with the values of c; 0: none are known to
 * In/out:  c        the declared model with its values held; then fitted to that beginning
 * Out:     between  rows between which the run leaves the model; from 0: there is no such beginning; from the end of
 *                   the run to beyond: it does not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_departure_find(lab_candidate *c, size_t known, size_t between[2], lab_error *error);

/* The row from which a model of the first rows no longer follows the run.
 * In:      c      fitted to these
 *          known  how many
 * Out:     row  0: it cannot be simulated; the end of the run: it follows
 * Returns: LAB_OK, LAB_WORLD. */
int lab_departure_row(const lab_candidate *c, size_t known, size_t *row, lab_error *error);

#endif
