/* How far a model is from logs: those that it was fitted to, on the way there, and those that it has not seen.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ANSWER_JUDGE_H
#define LAB_ANSWER_JUDGE_H

#include "answer.h"

/* Errors of the declared model, of the completed one and of each between them, on the logs fitted and on those
 * held out.
 * In:      left_out  values that stood alone in the logs fitted: not 0, and they are taken from those held out, too
 * In/out:  answer    with its models; its story gets the errors
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD; a model that cannot follow a held-out log is a remark. */
int lab_answer_judge(lab_answer *answer, size_t left_out, lab_error *error);

#endif
