/* How far a model is from logs that it has not seen.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_JUDGE_H
#define LAB_JUDGE_H

#include "../fit/errors.h"

/* Error of a model on runs that took no part in its fit. What each log has for itself (fit_per_log) is fitted to its
 * start, and the error is that of the rest. The start is a tenth of a run, or until all that is measured has moved by a
 * tenth of its range, half of the run at most.
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_judge(const lab_rig *model, const lab_run *run, int n, lab_errors *errors, lab_error *error);

#endif
