/* From a log to what drives the model: a schedule of inputs.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SCHEDULE_H
#define LAB_SCHEDULE_H

#include "../log/log.h"
#include "response.h"
#include "../rig/rig.h"

/* A schedule and its memory. */
typedef struct lab_inputs {
  lab_schedule schedule; /* points into the arrays below */
  double *t;
  pneu_input *input;
} lab_inputs;

/* Whether a rig as declared has what a set position drives; a fit may find that its positioner does nothing.
 * Returns: LAB_OK, LAB_DATA. */
int lab_positioner_check(const lab_rig *rig, const lab_log *log, lab_error *error);

/* What an input has become after a time [s] in which nothing was given. */
pneu_input lab_input_after(const pneu_input *before, double elapsed);

/* Whether the next command jumps away from what an input has become after a time [s]. */
int lab_input_jumps(const pneu_input *before, double elapsed, const pneu_input *next);

/* Inputs of one run of a log. A command holds until it changes; where it ramps over several rows, it runs along
 * straight lines that pass each row within the resolution, or 1e-4 of the range, and meet the levels before and after
 * them between two rows. Measured channels that are inputs run along straight lines between their values and bends,
 * over gaps as well; a measured supply or force holds.
 * In:      model  of `rig`
 *          rig    says which channels are inputs
 *          run    0 <= run < log->n_runs
 * Out:     drive  to be freed with lab_inputs_free
 * Returns: LAB_OK; LAB_DATA if a channel that drives the model is not in the log; LAB_WORLD. */
int lab_inputs_from_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, lab_inputs *inputs,
                        lab_error *error);

void lab_inputs_free(lab_inputs *inputs);

#endif
