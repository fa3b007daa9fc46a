#include "clock.h"

#include <time.h>

static double seconds_of(clockid_t clock)
{
  struct timespec t;
  clock_gettime(clock, &t);
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
  return until > 0 && lab_cpu_time() >= until;
}
