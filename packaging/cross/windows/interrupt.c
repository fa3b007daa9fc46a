/* apps/lab/base/interrupt.h on Windows. */
#include "../../../apps/lab/base/interrupt.h"

#include <io.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "../../../apps/lab/base/clock.h"
#include "../../../apps/lab/base/message.h"

static volatile sig_atomic_t held, pending; /* pending: number of the signal that waits, or 0 */

static char spent[160]; /* what is said when the CPU time that was given is spent */
static int most;        /* [s] of CPU */

static void on_signal(int number)
{
  if (held == 0)
    _exit(LAB_WORLD);
  pending = number;
}

void lab_interrupt_catch(void)
{
  signal(SIGINT, on_signal);
  signal(SIGTERM, on_signal);
}

static DWORD WINAPI watch(void *unused)
{
  const DWORD between = 200; /* [ms] */
  (void)unused;
  while (lab_cpu_time() < most || held > 0)
    Sleep(between);
  _write(2, spent, (unsigned)strlen(spent));
  _exit(LAB_WORLD);
}

int lab_interrupt_after(const char *program, int seconds)
{
  most = seconds;
  snprintf(spent, sizeof spent, "%s: not done within %d s of CPU; give --budget more, or keep fewer rows (log.every)\n",
           program, seconds);
  return CreateThread(NULL, 0, watch, NULL, 0, NULL) != NULL;
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
    _exit(LAB_WORLD);
}

int lab_interrupt_pending(void)
{
  return (int)pending;
}
