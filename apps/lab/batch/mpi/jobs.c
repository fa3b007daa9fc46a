/* Jobs over the ranks of MPI, in the place of ../jobs.c where the program is built with MPI=1.
 *
 * A rank with an idle worker sends the first rank what it has finished, or nothing at first, and waits for the answer:
 * a job, or word that there is none left. The first rank looks for such messages while it waits for its own workers,
 * which takes next to no time of its core. All that is computed is computed in processes that know nothing of MPI. */
#include "../jobs.h"

#include <mpi.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../workers.h"
#include "../../base/interrupt.h"

enum { LEADER = 0, ASK, JOB, GO_HOME };
static const int glance = 2;   /* [ms] between two looks for messages */
static const int breath = 200; /* [ms] between two looks for signals */

static int sent_home; /* workers of other ranks */

int lab_jobs_usual(void)
{
  return 1; /* as many ranks as mpirun was told */
}

int lab_jobs_join(void)
{
  int rank;
  MPI_Init(NULL, NULL);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank == LEADER;
}

/* A signal ends all ranks; what was done is on the disk. */
static int interrupted(lab_error *error)
{
  return lab_interrupt_pending() ? lab_fail(error, LAB_WORLD, "interrupted") : LAB_OK;
}

/* ---- The leader ---- */

/* Take one message, if there is one: a job with its result, or nothing.
 * Out:     message  job_size + result_size bytes;  from  rank, -1 if there is none
 * Returns: its size */
static int take_message(const lab_jobs *jobs, char *message, int *from)
{
  MPI_Status status;
  int is_there, size = 0;
  *from = -1;
  MPI_Iprobe(MPI_ANY_SOURCE, ASK, MPI_COMM_WORLD, &is_there, &status);
  if (!is_there)
    return 0;
  *from = status.MPI_SOURCE;
  MPI_Recv(message, (int)(jobs->job_size + jobs->result_size), MPI_BYTE, *from, ASK, MPI_COMM_WORLD, &status);
  MPI_Get_count(&status, MPI_BYTE, &size);
  return size;
}

static void send_home(int rank)
{
  MPI_Send(NULL, 0, MPI_BYTE, rank, GO_HOME, MPI_COMM_WORLD);
  sent_home++;
}

/* Answer all that ask.  In/out: more  0: no job is left; away  jobs that other ranks have */
static int answer(const lab_jobs *jobs, char *message, int *more, int *away, lab_error *error)
{
  int rank, size, status = LAB_OK;
  while (size = take_message(jobs, message, &rank), rank >= 0) {
    *away -= size > 0;
    if (size > 0 && status == LAB_OK)
      status = jobs->done(jobs->context, message, message + jobs->job_size, error);
    *more = *more && status == LAB_OK && jobs->next(jobs->context, message);
    if (!*more) {
      send_home(rank);
      continue;
    }
    MPI_Send(message, (int)jobs->job_size, MPI_BYTE, rank, JOB, MPI_COMM_WORLD);
    ++*away;
  }
  return status;
}

/* One job more for the leader's own workers, one result of theirs. */
static int work_along(lab_workers *workers, int *more, lab_error *error)
{
  const lab_jobs *jobs = workers->jobs;
  lab_worker *worker = *more ? lab_workers_idle(workers) : NULL;
  if (worker && (*more = jobs->next(jobs->context, worker->job)) && lab_workers_start(workers, worker, error))
    return error->status;
  worker = lab_workers_wait(workers, glance);
  return worker ? jobs->done(jobs->context, worker->job, worker->result, error) : LAB_OK;
}

int lab_jobs_run(const lab_jobs *jobs, lab_error *error)
{
  char *message = malloc(jobs->job_size + jobs->result_size);
  lab_workers workers;
  int more = 1, away = 0, status = lab_workers_open(&workers, jobs, error);
  if (status == LAB_OK && !message)
    status = lab_fail_memory(error, "messages");
  while (status == LAB_OK && (more || away || lab_workers_busy(&workers))) {
    status = interrupted(error);
    if (status == LAB_OK)
      status = answer(jobs, message, &more, &away, error);
    if (status == LAB_OK)
      status = work_along(&workers, &more, error);
  }
  lab_workers_close(&workers);
  free(message);
  return status;
}

/* ---- The others ---- */

/* Tell the leader what is finished, if anything, and take what it answers.
 * In/out:  worker  its job
 * Returns: 0 if it is to go home */
static int ask(const lab_jobs *jobs, lab_worker *worker, int finished, char *message)
{
  const size_t size = finished ? jobs->job_size + jobs->result_size : 0;
  MPI_Status status;
  if (finished) {
    memcpy(message, worker->job, jobs->job_size);
    memcpy(message + jobs->job_size, worker->result, jobs->result_size);
  }
  MPI_Send(message, (int)size, MPI_BYTE, LEADER, ASK, MPI_COMM_WORLD);
  MPI_Recv(worker->job, (int)jobs->job_size, MPI_BYTE, LEADER, MPI_ANY_TAG, MPI_COMM_WORLD, &status);
  return status.MPI_TAG == JOB;
}

static int serve(lab_workers *workers, char *message, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; i < workers->n && status == LAB_OK; i++)
    if (ask(workers->jobs, &workers->worker[i], 0, message))
      status = lab_workers_start(workers, &workers->worker[i], error);
  while (status == LAB_OK && lab_workers_busy(workers)) {
    lab_worker *worker = lab_workers_wait(workers, breath);
    status = interrupted(error);
    if (status == LAB_OK && worker && ask(workers->jobs, worker, 1, message))
      status = lab_workers_start(workers, worker, error);
  }
  return status;
}

/* A rank that cannot work would be waited for: it ends them all. */
static void give_up(const lab_error *error)
{
  if (!lab_interrupt_pending())
    fprintf(stderr, "%s\n", error->text);
  MPI_Abort(MPI_COMM_WORLD, error->status);
}

void lab_jobs_serve(const lab_jobs *jobs)
{
  char *message = malloc(jobs->job_size + jobs->result_size);
  lab_error error;
  lab_workers workers;
  int status = lab_workers_open(&workers, jobs, &error);
  if (status == LAB_OK)
    status = message ? jobs->prepare(jobs->context, &error) : lab_fail_memory(&error, "messages");
  if (status == LAB_OK)
    status = serve(&workers, message, &error);
  lab_workers_close(&workers);
  free(message);
  if (status != LAB_OK)
    give_up(&error);
}

/* ---- The end ---- */

void lab_jobs_leave(const lab_jobs *jobs)
{
  char *message = malloc(jobs->job_size + jobs->result_size);
  int rank, ranks, from;
  if (!message || lab_interrupt_pending())
    MPI_Abort(MPI_COMM_WORLD, 128 + lab_interrupt_pending());
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  while (rank == LEADER && sent_home < (ranks - 1) * jobs->at_once) {
    take_message(jobs, message, &from);
    if (from >= 0)
      send_home(from);
    else
      poll(NULL, 0, glance);
  }
  free(message);
  MPI_Finalize();
}
