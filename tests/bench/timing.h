/* Times of repeated runs, of several contenders in turn.
 * SPDX-License-Identifier: MIT */
#ifndef BENCH_TIMING_H
#define BENCH_TIMING_H

enum { BENCH_REPEATS_MAX = 101, BENCH_FEWEST = 5 };

/* Median and quartiles [s]; NaN where a run has failed. */
typedef struct bench_spread {
  double low, median, high;
  int n;
} bench_spread;

/* One who runs. */
typedef struct bench_lane {
  double (*run)(void *context); /* Returns: seconds; NaN on failure */
  void *context;
  bench_spread spread;
} bench_lane;

/* [s] of a clock that only goes forward. */
double bench_seconds(void);

/* Let all run in turn, again and again, so that what disturbs the machine disturbs all of them.
 * In:      repeats  of each, at most BENCH_REPEATS_MAX
 *          budget   [s] after which a lane rests, once it has run BENCH_FEWEST times
 * In/out:  lane     n */
void bench_race(bench_lane *lane, int n, int repeats, double budget);

#endif
