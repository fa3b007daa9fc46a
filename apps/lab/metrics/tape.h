/* Records for the figures of merit, with their memory: of a simulation, or of what a bench has measured.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TAPE_H
#define LAB_TAPE_H

#include "metrics.h"
#include "../run/response.h"
#include "../fit/unknowns.h"

typedef struct lab_tape {
  lab_record record;
  size_t room, room_runs;
  double *memory;
  size_t *first;
} lab_tape;

/* An empty tape for so many rows and runs, with what the rig says of its actuator.
 * Out:     tape  to be closed, also after an error
 * Returns: LAB_OK, LAB_WORLD. */
int lab_tape_open(const lab_rig *rig, size_t rows, size_t runs, lab_tape *tape, lab_error *error);
void lab_tape_close(lab_tape *tape);

/* Append a response as one run. */
void lab_tape_add_trace(lab_tape *tape, const lab_trace *trace);

/* What a model does when the commands of a log drive it, sampled at least every 10 ms (or 200 000 times in all).
 * Out:     tape  to be closed, also after an error
 * Returns: as lab_follow. */
int lab_tape_simulate(const pneu_model *model, const lab_rig *rig, const lab_log *log,
                      const lab_response_options *options, lab_tape *tape, lab_error *error);

/* What was measured in the runs of a fit.  Out: tape, to be closed, also after an error.  Returns: LAB_OK, LAB_WORLD.
 */
int lab_tape_measured(const lab_unknowns *u, lab_tape *tape, lab_error *error);

/* What the fitted model does in the same runs, at the same times; commands act at the rows that show them.
 * Out:     tape  to be closed, also after an error
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_tape_predicted(const lab_unknowns *u, lab_tape *tape, lab_error *error);

#endif
