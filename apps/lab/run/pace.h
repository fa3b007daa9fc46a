/* The pace of a run: the steps that it took, for runs of nearly the same model to follow, so that their difference
 * shows the models and not the steps. SPDX-License-Identifier: MIT */
#ifndef LAB_PACE_H
#define LAB_PACE_H

#include <stddef.h>

#include "../../../lib/pneu.h"
#include "../base/message.h"

typedef struct lab_pace {
  pneu_paced_step *step;
  size_t *first; /* step of each row of the schedule, and behind the last */
  size_t n, rows;
  size_t step_room, row_room;
  double tol; /* of the stepper, for the run that sets it and for those that follow */
  int is_set; /* not 0: by a whole run */
  int lacks_memory;
} lab_pace;

/* A row of the schedule begins. */
void lab_pace_row(lab_pace *pace);

/* A step ends; the last one has ended on an event. */
void lab_pace_step(lab_pace *pace, double h);
void lab_pace_event(lab_pace *pace);

/* The run ends, and may be followed.  Returns: LAB_OK, LAB_WORLD */
int lab_pace_end(lab_pace *pace, lab_error *error);

/* Have a run follow in row i of its schedule. */
void lab_pace_follow(const lab_pace *pace, size_t i, pneu_options *options);

/* Let go of its memory: it is as at first, all 0. */
void lab_pace_close(lab_pace *pace);

#endif
