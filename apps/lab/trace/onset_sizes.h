/* Scores of what begins in a closed loop.
 *
 * There a slope says little: what begins is made up for, and from a change of a wrong size or at a wrong time on the
 * model falls out of step with the log. A simulation of a stretch costs little instead, so that each change is tried at
 * several sizes, and what comes nearest at several times as well.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ONSET_SIZES_H
#define LAB_ONSET_SIZES_H

#include "candidate.h"
#include "onset_score.h"

/* Simulate a model in which a parameter has another value.
 * In:      from   [s] of the log from when on it has; infinite: from the first row
 *          value  in its unit; of orifice_area a factor
 * Out:     chi2   infinite where that cannot be simulated
 * Returns: LAB_OK, LAB_WORLD. */
int lab_onset_try(const lab_unknowns *model, int param, double from, double value, double *chi2, lab_error *error);

/* Score all that may begin, by what the best size of each takes off chi-square.
 * In:      earliest, latest  rows of the only run between which it begins
 * In/out:  frozen            with the values of the rows before, no unknowns; quality: of these, where nothing begins
 * Out:     scores            with the row of each; p-values as of one size, `tests`: sizes and times
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_onset_sizes_find(lab_candidate *frozen, size_t earliest, size_t latest, lab_onset_scores *scores,
                         lab_error *error);

#endif
