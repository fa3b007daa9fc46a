/* Commands that come late: the schedule of what acts.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LATE_H
#define LAB_LATE_H

#include "response.h"

/* What acts when, and the model of each row. */
typedef struct lab_late {
  lab_schedule schedule; /* points into the arrays below */
  const pneu_model **rows;
  double *t;
  pneu_input *input;
} lab_late;

/* Delay each command by the command_delay of the model at the time when it is given, and none before one given earlier;
 * the first has been acting, and begins to run that much later if it does. What else drives the model comes on time.
 * In:      task  schedule and models; `rows` may be NULL
 *          model the one that acts where it is
 * Out:     late  to be closed, also after an error
 * Returns: LAB_OK, LAB_WORLD. */
int lab_late_open(const lab_simulation *task, const pneu_model *model, lab_late *late, lab_error *error);
void lab_late_close(lab_late *late);

#endif
