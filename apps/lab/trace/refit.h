/* Refits of a model with one more effect: those that the trace puts first, from several starts.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REFIT_H
#define LAB_REFIT_H

#include "attempt.h"

enum { LAB_REFIT_MAX = 40 };

/* Refit the leaders of a trace, in parallel; where none of them is any good beside the declared model, all that pass.
 * In:      base   fitted
 *          level  p-value that a candidate has to pass
 * Out:     a      LAB_REFIT_MAX at most, each with one more effect, fitted or not
 *          n      their number
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_effects(const lab_attempt *base, const lab_trace_result *trace, double level, lab_attempt *a, int *n,
                      lab_error *error);

/* Whether none of n attempts explains much of what the declared model leaves. */
int lab_refit_all_poor(const lab_attempt *declared, const lab_attempt *a, int n);

#endif
