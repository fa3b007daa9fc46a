/* A supply that fails and comes back within a log.
 *
 * It seldom fails at once and wholly: somebody shuts a valve, a line runs empty. Its course is followed in steps, each
 * with a level of its own from one row to another. A positioner hides what the supply does as long as there is enough
 * of it, so that slopes say nothing; every step is tried at several levels instead, and the best is taken up while it
 * explains much of what is left. SPDX-License-Identifier: MIT */
#ifndef LAB_COURSE_H
#define LAB_COURSE_H

#include "../trace/onset.h"

typedef struct lab_course {
  int n_free;           /* levels and instants that were fitted; 0: it does not fail */
  lab_onset begin, end; /* of its failing; the end as early as the log allows where it does not show it */
} lab_course;

/* Follow the supply pressure through the last run.
 * In:      u     fitted, row by row
 *          run   the last one
 * In/out:  u     with the steps as LAB_UNKNOWN_CHANGE, fitted again
 * Returns: as lab_unknowns_fit. */
int lab_course_follow(lab_unknowns *u, int run, lab_course *course, lab_error *error);

#endif
