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

/* Inputs of one run of a log. A command holds until it changes; where it ramps over several rows that are far apart, it
 * goes from row to row in small steps about a straight line; measured channels that are inputs run along
 * straight lines between their values, over gaps as well; a measured supply or force holds.
 * In:      model  of `rig`
 *          rig    says which channels are inputs
 *          run    0 <= run < log->n_runs
 * Out:     drive  to be freed with lab_inputs_free
 * Returns: LAB_OK; LAB_DATA if a channel that drives the model is not in the log; LAB_WORLD. */
int lab_inputs_from_log(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, lab_inputs *inputs,
                        lab_error *error);

void lab_inputs_free(lab_inputs *inputs);

#endif
