#include "clock.h"

#include <signal.h>
#include <time.h>

static volatile sig_atomic_t stopped;

/* Where the machine has no such clock, as in a browser, the one that only goes forward. */
static double seconds_of(clockid_t clock)
{
  struct timespec t;
  if (clock_gettime(clock, &t) != 0)
    clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double lab_clock(void)
{
  return seconds_of(CLOCK_MONOTONIC);
}

double lab_cpu_time(void)
{
  return seconds_of(CLOCK_PROCESS_CPUTIME_ID);
}

int lab_cpu_is_spent(double until)
{
  return stopped || (until > 0 && lab_cpu_time() >= until);
}

double lab_cpu_share(double until, double share)
{
  const double now = lab_cpu_time();
  return until > 0 ? now + share * (until - now) : 0;
}

void lab_cpu_stop(int stop)
{
  stopped = stop;
}

int lab_cpu_is_stopped(void)
{
  return stopped;
}
