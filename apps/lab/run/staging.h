/* Which model acts when: the schedule of a run, cut where another model begins.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STAGING_H
#define LAB_STAGING_H

#include "schedule.h"

/* A model, and the time of the log from which it acts [s]. What begins in its rig while it does is cut there. */
typedef struct lab_episode {
  double from;
  const lab_rig *rig;
} lab_episode;

/* A schedule with a model for each of its rows, and their memory. */
typedef struct lab_staging {
  lab_schedule schedule; /* points into the arrays below */
  const pneu_model **of; /* each row */
  double *t;
  pneu_input *input;
  int n;
  lab_rig *rig; /* n of them, and the models that use them */
  pneu_model *model;
  double *from; /* [s] when each begins */
} lab_staging;

/* Put a schedule together.
 * In:      log      says whether the supply was measured
 *          logged   its inputs
 *          early    [s] how much before its row each change of command happened, after the first; NULL: not at all
 *          n_early  how many of them there are
 *          episode  n >= 1 of them, in the order of time; the first acts from the beginning, whatever its time
 * Out:     staging   to be closed, also after an error
 * Returns: LAB_OK, LAB_DATA naming the parameter at fault, LAB_WORLD. */
int lab_staging_open(const lab_log *log, const lab_schedule *logged, const double *early, size_t n_early,
                     const lab_episode *episode, int n, lab_staging *staging, lab_error *error);
void lab_staging_close(lab_staging *stage);

#endif
