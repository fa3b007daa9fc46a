/* What a model does when the commands of a log drive it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FOLLOW_H
#define LAB_FOLLOW_H

#include "../log/log.h"
#include "response.h"
#include "../rig/rig.h"

/* Respond to one run of a log, from where it begins.
 * In:      rig      of the model
 *          t, n     times of the samples [s], increasing, within the run
 *          options  t_end is not read
 * Out:     trace    free with lab_trace_free
 * Returns: LAB_OK, LAB_DATA (the log lacks an input, or begins in no state), LAB_NUMERIC, LAB_WORLD. */
int lab_follow(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, const double *t, size_t n,
               const lab_response_options *options, lab_trace *trace, lab_error *error);

#endif
