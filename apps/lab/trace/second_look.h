/* A log whose verdict hangs on a few values that are no measurement.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SECOND_LOOK_H
#define LAB_SECOND_LOOK_H

#include "../check/bench.h"
#include "loop.h"

/* Where the loop found something, or ended undecided, run it once more without the values that stand alone
 * (outliers.h). If that leaves less to explain or to doubt, the new answer takes the place of the old one, and
 * the bench's remarks say what was left out; else nothing changes. Nor does it where the log was seen coarsely.
 * In/out:  bench      its logs
 *          declared   fitted
 *          completed  model, and
 *          result     of the loop on it
 * Out:     left_out   how many values
 * Returns: as lab_loop_run; a failure to fit or to follow without the values is no error. */
int lab_second_look(const lab_loop_options *options, lab_bench *bench, lab_unknowns *declared, lab_unknowns *completed,
                    lab_loop_result *result, size_t *left_out, lab_error *error);

#endif
