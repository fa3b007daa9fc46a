#include "interrupt.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include "message.h"

static volatile sig_atomic_t held, pending; /* pending: number of the signal that waits, or 0 */

static char spent[160]; /* what is said when the CPU time that was given is spent */

static void end_by(int number)
{
  if (number == SIGXCPU && write(STDERR_FILENO, spent, strlen(spent)) > 0)
    _exit(LAB_WORLD);
  signal(number, SIG_DFL);
  raise(number);
}

static void on_signal(int number)
{
  if (held > 0 && pending == 0)
    pending = number;
  else
    end_by(number);
}

void lab_interrupt_catch(void)
{
  static const int numbers[] = {SIGINT, SIGTERM, SIGHUP};
  struct sigaction action, before;
  size_t i;
  memset(&action, 0, sizeof action);
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (i = 0; i < sizeof numbers / sizeof *numbers; i++)
    if (sigaction(numbers[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(numbers[i], &action, NULL);
}

int lab_interrupt_after(const char *program, int seconds)
{
  struct rlimit limit;
  if (getrlimit(RLIMIT_CPU, &limit))
    return 0;
  limit.rlim_cur = (rlim_t)seconds < limit.rlim_max ? (rlim_t)seconds : limit.rlim_max;
  snprintf(spent, sizeof spent, "%s: not done within %d s of CPU; give --budget more, or keep fewer rows (log.every)\n",
           program, seconds);
  signal(SIGXCPU, on_signal);
  return setrlimit(RLIMIT_CPU, &limit) == 0;
}

void lab_interrupt_hold(void)
{
#pragma omp atomic
  held++;
}

void lab_interrupt_release(void)
{
#pragma omp atomic
  held--;
  if (held == 0 && pending)
    end_by((int)pending);
}

int lab_interrupt_pending(void)
{
  return (int)pending;
}
