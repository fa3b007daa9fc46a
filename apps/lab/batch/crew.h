/* Many jobs, some at once, each in a process of its own. Jobs and results are plain bytes. There are two kinds of crew:
 * one on this machine (crew.c), and one over the ranks of MPI (mpi/crew.c), chosen when the program is built; there,
 * the first rank leads, hands out one job after the other to whoever is free, and works itself.
 *
 *   if (lab_crew_join())
 *     lab_crew_run(&crew, &error);    the leader
 *   else
 *     lab_crew_serve(&crew);          the others
 *   lab_crew_leave(&crew);
 *
 * Signals are to be put off (lab_interrupt_hold) from before the first call to after the last one.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CREW_H
#define LAB_CREW_H

#include <stddef.h>

#include "../base/message.h"

typedef struct lab_crew {
  int at_once; /* jobs at once, in each rank */
  size_t job_size, result_size;
  int (*prepare)(void *context, lab_error *error);                      /* before any work, in ranks that serve */
  int (*next)(void *context, void *job);                                /* leader.  Returns: 0 if none is left */
  void (*work)(void *context, const void *job, void *result);           /* in a process of its own */
  void (*lost)(void *context, const void *job, int wait, void *result); /* it died, see waitpid; result: all 0 */
  int (*done)(void *context, const void *job, const void *result, lab_error *error); /* leader; not LAB_OK: stop */
  void *context;
} lab_crew;

/* How many at once where nobody has said: what the machine has, or one a rank. */
int lab_crew_usual(void);

/* Join.  Returns: 1 for the leader */
int lab_crew_join(void);

/* Do all jobs.  Returns: LAB_OK; what `done` failed with; LAB_WORLD, also if a signal came, which then waits. */
int lab_crew_run(const lab_crew *crew, lab_error *error);

/* Work for the leader until there is nothing left; where that cannot be, the whole crew is ended. */
void lab_crew_serve(const lab_crew *crew);

/* Leave; the leader sends home whoever still asks for work. */
void lab_crew_leave(const lab_crew *crew);

#endif
