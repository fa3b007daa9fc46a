#include "workers.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "../base/interrupt.h"

int lab_workers_open(lab_workers *workers, const lab_jobs *jobs, lab_error *error)
{
  int i;
  *workers = (lab_workers){.jobs = jobs, .worker = calloc((size_t)jobs->at_once, sizeof *workers->worker)};
  if (!workers->worker)
    return lab_fail_memory(error, "the jobs at once");
  for (i = 0; i < jobs->at_once; i++) {
    lab_worker *h = &workers->worker[workers->n++];
    h->job = malloc(jobs->job_size);
    h->result = malloc(jobs->result_size);
    if (!h->job || !h->result)
      return lab_fail_memory(error, "the jobs at once");
  }
  return LAB_OK;
}

lab_worker *lab_workers_idle(lab_workers *workers)
{
  int i;
  for (i = 0; i < workers->n; i++)
    if (!workers->worker[i].pid)
      return &workers->worker[i];
  return NULL;
}

int lab_workers_busy(const lab_workers *workers)
{
  int i, n = 0;
  for (i = 0; i < workers->n; i++)
    n += workers->worker[i].pid != 0;
  return n;
}

/* ---- The new process ---- */

static int write_all(int file, const char *data, size_t size)
{
  while (size > 0) {
    const ssize_t n = write(file, data, size);
    if (n < 0 && errno != EINTR)
      return 1;
    data += n > 0 ? n : 0;
    size -= n > 0 ? (size_t)n : 0;
  }
  return 0;
}

/* One job, one core; no file of the parent is touched on the way out. */
static void work(const lab_jobs *jobs, lab_worker *worker, int file)
{
  lab_interrupt_release(); /* only the parent puts signals off */
#ifdef _OPENMP
  omp_set_num_threads(1);
#endif
  memset(worker->result, 0, jobs->result_size);
  jobs->work(jobs->context, worker->job, worker->result);
  _exit(write_all(file, worker->result, jobs->result_size));
}

int lab_workers_start(lab_workers *workers, lab_worker *worker, lab_error *error)
{
  int ends[2];
  pid_t pid;
  if (pipe(ends))
    return lab_fail(error, LAB_WORLD, "no pipe for another process: %s; try fewer --threads", strerror(errno));
  pid = fork();
  if (pid == 0) {
    close(ends[0]);
    work(workers->jobs, worker, ends[1]);
  }
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    return lab_fail(error, LAB_WORLD, "no further process: %s; try fewer --threads", strerror(errno));
  }
  worker->pid = pid;
  worker->pipe = ends[0];
  worker->got = 0;
  return LAB_OK;
}

/* ---- Its end ---- */

static int wait_for(pid_t pid)
{
  int wait = 0;
  while (waitpid(pid, &wait, 0) < 0 && errno == EINTR)
    ;
  return wait;
}

/* Its pipe has come to an end. */
static void finish(const lab_jobs *jobs, lab_worker *worker)
{
  const int wait = wait_for(worker->pid);
  close(worker->pipe);
  worker->pid = 0;
  if (worker->got == jobs->result_size && wait == 0)
    return;
  memset(worker->result, 0, jobs->result_size);
  jobs->lost(jobs->context, worker->job, wait, worker->result);
}

/* Take what there is.  Returns: 1 at the end */
static int take(const lab_jobs *jobs, lab_worker *worker)
{
  char over[1];
  const size_t room = jobs->result_size - worker->got;
  const ssize_t n = read(worker->pipe, room ? (char *)worker->result + worker->got : over, room ? room : 1);
  worker->got += n > 0 ? (size_t)n : 0;
  return n == 0 || (n < 0 && errno != EINTR);
}

lab_worker *lab_workers_wait(lab_workers *workers, int ms)
{
  struct pollfd *file = malloc((size_t)(workers->n + 1) * sizeof *file);
  lab_worker *finished = NULL;
  int i;
  if (!file)
    return NULL;
  for (i = 0; i < workers->n; i++) {
    file[i].fd = workers->worker[i].pid ? workers->worker[i].pipe : -1;
    file[i].events = POLLIN;
    file[i].revents = 0;
  }
  if (poll(file, (nfds_t)workers->n, ms) > 0)
    for (i = 0; i < workers->n && !finished; i++)
      if (file[i].revents && take(workers->jobs, &workers->worker[i])) {
        finished = &workers->worker[i];
        finish(workers->jobs, finished);
      }
  free(file);
  return finished;
}

void lab_workers_close(lab_workers *workers)
{
  int i;
  for (i = 0; i < workers->n; i++)
    if (workers->worker[i].pid)
      kill(workers->worker[i].pid, SIGTERM);
  for (i = 0; i < workers->n; i++) {
    lab_worker *h = &workers->worker[i];
    if (h->pid) {
      wait_for(h->pid);
      close(h->pipe);
    }
    free(h->job);
    free(h->result);
  }
  free(workers->worker);
  workers->n = 0;
}
