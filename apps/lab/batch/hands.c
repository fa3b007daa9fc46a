#include "hands.h"

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

int lab_hands_open(lab_hands *hands, const lab_crew *crew, lab_error *error)
{
  int i;
  hands->crew = crew;
  hands->n = 0;
  hands->hand = calloc((size_t)crew->at_once, sizeof *hands->hand);
  if (!hands->hand)
    return lab_fail_memory(error, "the jobs at once");
  hands->n = crew->at_once;
  for (i = 0; i < hands->n; i++) {
    lab_hand *h = &hands->hand[i];
    h->job = malloc(crew->job_size);
    h->result = malloc(crew->result_size);
    if (!h->job || !h->result)
      return lab_fail_memory(error, "the jobs at once");
  }
  return LAB_OK;
}

lab_hand *lab_hands_idle(lab_hands *hands)
{
  int i;
  for (i = 0; i < hands->n; i++)
    if (!hands->hand[i].pid)
      return &hands->hand[i];
  return NULL;
}

int lab_hands_busy(const lab_hands *hands)
{
  int i, n = 0;
  for (i = 0; i < hands->n; i++)
    n += hands->hand[i].pid != 0;
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
static void work(const lab_crew *crew, lab_hand *hand, int file)
{
  lab_interrupt_release(); /* only the parent puts signals off */
#ifdef _OPENMP
  omp_set_num_threads(1);
#endif
  memset(hand->result, 0, crew->result_size);
  crew->work(crew->context, hand->job, hand->result);
  _exit(write_all(file, hand->result, crew->result_size));
}

int lab_hands_start(lab_hands *hands, lab_hand *hand, lab_error *error)
{
  int ends[2];
  pid_t pid;
  if (pipe(ends))
    return lab_fail(error, LAB_WORLD, "no pipe for another process: %s; try fewer --threads", strerror(errno));
  pid = fork();
  if (pid == 0) {
    close(ends[0]);
    work(hands->crew, hand, ends[1]);
  }
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    return lab_fail(error, LAB_WORLD, "no further process: %s; try fewer --threads", strerror(errno));
  }
  hand->pid = pid;
  hand->pipe = ends[0];
  hand->got = 0;
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
static void finish(const lab_crew *crew, lab_hand *hand)
{
  const int wait = wait_for(hand->pid);
  close(hand->pipe);
  hand->pid = 0;
  if (hand->got == crew->result_size && wait == 0)
    return;
  memset(hand->result, 0, crew->result_size);
  crew->lost(crew->context, hand->job, wait, hand->result);
}

/* Take what there is.  Returns: 1 at the end */
static int take(const lab_crew *crew, lab_hand *hand)
{
  char over[1];
  const size_t room = crew->result_size - hand->got;
  const ssize_t n = read(hand->pipe, room ? (char *)hand->result + hand->got : over, room ? room : 1);
  hand->got += n > 0 ? (size_t)n : 0;
  return n == 0 || (n < 0 && errno != EINTR);
}

lab_hand *lab_hands_wait(lab_hands *hands, int ms)
{
  struct pollfd *file = malloc((size_t)(hands->n + 1) * sizeof *file);
  lab_hand *finished = NULL;
  int i;
  if (!file)
    return NULL;
  for (i = 0; i < hands->n; i++) {
    file[i].fd = hands->hand[i].pid ? hands->hand[i].pipe : -1;
    file[i].events = POLLIN;
    file[i].revents = 0;
  }
  if (poll(file, (nfds_t)hands->n, ms) > 0)
    for (i = 0; i < hands->n && !finished; i++)
      if (file[i].revents && take(hands->crew, &hands->hand[i])) {
        finished = &hands->hand[i];
        finish(hands->crew, finished);
      }
  free(file);
  return finished;
}

void lab_hands_close(lab_hands *hands)
{
  int i;
  for (i = 0; i < hands->n; i++)
    if (hands->hand[i].pid)
      kill(hands->hand[i].pid, SIGTERM);
  for (i = 0; i < hands->n; i++) {
    lab_hand *h = &hands->hand[i];
    if (h->pid) {
      wait_for(h->pid);
      close(h->pipe);
    }
    free(h->job);
    free(h->result);
  }
  free(hands->hand);
  hands->n = 0;
}
