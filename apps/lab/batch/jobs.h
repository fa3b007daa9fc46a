/* Many jobs, some at once, each in a process of its own. Jobs and results are plain bytes. They are done on
 * this machine (jobs.c) or over the ranks of MPI (mpi/jobs.c), chosen when the program is built; there,
 * the first rank leads, hands out one job after the other to whoever is free, and works itself.
 *
 *   if (lab_jobs_join())
 *     lab_jobs_run(&jobs, &error);    the leader
 *   else
 *     lab_jobs_serve(&jobs);          the others
 *   lab_jobs_leave(&jobs);
 *
 * Signals are to be put off (lab_interrupt_hold) from before the first call to after the last one.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_JOBS_H
#define LAB_JOBS_H

#include <stddef.h>

#include "../base/message.h"

typedef struct lab_jobs {
  int at_once; /* jobs at once, in each rank */
  size_t job_size, result_size;
  int (*prepare)(void *context, lab_error *error);                      /* before any work, in ranks that serve */
  int (*next)(void *context, void *job);                                /* leader.  Returns: 0 if none is left */
  void (*work)(void *context, const void *job, void *result);           /* in a process of its own */
  void (*lost)(void *context, const void *job, int wait, void *result); /* it died, see waitpid; result: all 0 */
  int (*done)(void *context, const void *job, const void *result, lab_error *error); /* leader; not LAB_OK: stop */
  void *context;
} lab_jobs;

/* How many at once where nobody has said: what the machine has, or one a rank. */
int lab_jobs_usual(void);

/* Join.  Returns: 1 for the leader */
int lab_jobs_join(void);

/* Do all jobs.  Returns: LAB_OK; what `done` failed with; LAB_WORLD, also if a signal came, which then waits. */
int lab_jobs_run(const lab_jobs *jobs, lab_error *error);

/* Work for the leader until there is nothing left; where that cannot be, all ranks are ended. */
void lab_jobs_serve(const lab_jobs *jobs);

/* Leave; the leader sends home whoever still asks for work. */
void lab_jobs_leave(const lab_jobs *jobs);

#endif
