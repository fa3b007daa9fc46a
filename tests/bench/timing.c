#include "timing.h"

#include <math.h>
#include <time.h>

#include "../../apps/lab/base/array.h"

double bench_seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Value below which a share of the sorted samples lies. */
static double quantile(const double *sorted, int n, double share)
{
  const double at = share * (n - 1);
  const int i = (int)at;
  return i + 1 < n ? sorted[i] + (at - i) * (sorted[i + 1] - sorted[i]) : sorted[i];
}

static bench_spread spread_of(double *sample, int n)
{
  bench_spread spread = {(double)NAN, (double)NAN, (double)NAN, n};
  int i;
  for (i = 0; i < n; i++)
    if (isnan(sample[i]))
      return spread;
  lab_sort(sample, (size_t)n);
  spread.low = quantile(sample, n, 0.25);
  spread.median = quantile(sample, n, 0.5);
  spread.high = quantile(sample, n, 0.75);
  return spread;
}

void bench_race(bench_lane *lane, int n, int repeats, double budget)
{
  enum { LANES = 8 };
  static double sample[LANES][BENCH_REPEATS_MAX];
  double used[LANES] = {0};
  int count[LANES] = {0}, i, r;
  for (r = 0; r < repeats && r < BENCH_REPEATS_MAX; r++)
    for (i = 0; i < n && i < LANES; i++) {
      const int rests = count[i] >= BENCH_FEWEST && !(used[i] < budget);
      if (rests)
        continue;
      sample[i][count[i]] = lane[i].run(lane[i].context);
      used[i] += sample[i][count[i]++];
    }
  for (i = 0; i < n && i < LANES; i++)
    lane[i].spread = spread_of(sample[i], count[i]);
}
