/* Jobs in processes of their own: whatever happens to one, it ends alone, and its memory is gone with it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_WORKERS_H
#define LAB_WORKERS_H

#include <sys/types.h>

#include "jobs.h"

typedef struct lab_worker {
  pid_t pid; /* 0: idle */
  int pipe;  /* its result comes here */
  size_t got;
  void *job, *result;
} lab_worker;

typedef struct lab_workers {
  const lab_jobs *jobs;
  int n;
  lab_worker *worker;
} lab_workers;

/* Out: workers  to be closed, also after an error.  Returns: LAB_OK, LAB_WORLD. */
int lab_workers_open(lab_workers *workers, const lab_jobs *jobs, lab_error *error);

/* One that is idle; put its job in worker->job and start it.  Returns: NULL if there is none */
lab_worker *lab_workers_idle(lab_workers *workers);
int lab_workers_start(lab_workers *workers, lab_worker *worker, lab_error *error);

/* Wait at most `ms` milliseconds (-1: for ever) for one to finish; its result is whole then, and it is idle.
 * Returns: NULL if none has, or if a signal came */
lab_worker *lab_workers_wait(lab_workers *workers, int ms);

/* How many are at work. */
int lab_workers_busy(const lab_workers *workers);

/* End those at work. */
void lab_workers_close(lab_workers *workers);

#endif
