#include "interrupt.h"

#include <signal.h>
#include <string.h>

static volatile sig_atomic_t held, pending; /* pending: number of the signal that waits, or 0 */

static void end_by(int number)
{
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
