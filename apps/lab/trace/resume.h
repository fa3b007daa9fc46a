/* The search from a model that was found before it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RESUME_H
#define LAB_RESUME_H

#include "rounds.h"

/* Drop what the model does not need, put each of its effects against those that may stand in its place, and go on.
 * In:      u      the declared model, fitted
 * In/out:  begun  declared, and best: the model, fitted to the runs of u; its `until` ends the search
 *          whole  with the errors of u; then what was found
 * Returns: as lab_rounds_run. */
int lab_resume(const lab_unknowns *u, const lab_search_options *options, lab_finding *begun, lab_finding *whole,
               lab_error *error);

#endif
