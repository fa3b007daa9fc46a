/* Jobs on this machine. */
#include "jobs.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include "workers.h"
#include "../base/interrupt.h"

static const int breath = 200; /* [ms] between two looks for signals */

int lab_jobs_usual(void)
{
#ifdef _OPENMP
  return omp_get_num_procs();
#else
  return 1;
#endif
}

int lab_jobs_join(void)
{
  return 1;
}

void lab_jobs_serve(const lab_jobs *jobs)
{
  (void)jobs;
}

void lab_jobs_leave(const lab_jobs *jobs)
{
  (void)jobs;
}

/* Give every idle worker a job.  In/out: more  0: none is left */
static int hand_out(lab_workers *workers, int *more, lab_error *error)
{
  const lab_jobs *jobs = workers->jobs;
  lab_worker *worker;
  while (*more && (worker = lab_workers_idle(workers))) {
    *more = jobs->next(jobs->context, worker->job);
    if (*more && lab_workers_start(workers, worker, error))
      return error->status;
  }
  return LAB_OK;
}

int lab_jobs_run(const lab_jobs *jobs, lab_error *error)
{
  lab_workers workers;
  int more = 1, status = lab_workers_open(&workers, jobs, error);
  while (status == LAB_OK && (more || lab_workers_busy(&workers))) {
    const lab_worker *finished;
    if (lab_interrupt_pending()) {
      status = lab_fail(error, LAB_WORLD, "interrupted");
      break;
    }
    status = hand_out(&workers, &more, error);
    finished = status == LAB_OK && lab_workers_busy(&workers) ? lab_workers_wait(&workers, breath) : NULL;
    if (finished)
      status = jobs->done(jobs->context, finished->job, finished->result, error);
  }
  lab_workers_close(&workers);
  return status;
}
