/* How far a model is from logs: those that it was fitted to, and those that it has not seen.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_JUDGE_H
#define LAB_JUDGE_H

#include "../fit/errors.h"

/* Error of a model on runs.
 * In:      fitted  the final model of these runs: what each log has for itself (fit_per_log), and the instants of
 *                  commands, are fitted again, as far as its time goes; NULL: they are others, where what each log has
 *                  for itself is fitted to its first tenth, and the error is that of the rest
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_judge(const lab_rig *model, const lab_run *run, int n, const lab_unknowns *fitted, lab_errors *errors,
              lab_error *error);

#endif
