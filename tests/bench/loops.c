/* Scan, closeloop and study: what has no rival. */
#include "bench.h"

#include <math.h>
#include <stdio.h>

#include "tasks.h"

static const double rows = 5000, budget = 30; /* [1], [s] */

static void alone(bench *b, const char *item, const char *on, double (*run)(void *), void *context, int repeats)
{
  bench_lane lane = {run, context, {0, 0, 0, 0}};
  bench_race(&lane, 1, bench_repeats(b, repeats), budget);
  bench_item(b, item, on, "libpneu", (double)NAN, (double)NAN, &lane.spread, lane.spread.median);
}

static int scan(bench *b, bench_rig *r, lab_error *error)
{
  static bench_scan s;
  int status = bench_rig_open(r, error);
  if (status == LAB_OK)
    status = bench_scan_fit(r, &s, error);
  if (status == LAB_OK)
    alone(b, "scan of all effects", "5000 rows on one thread", bench_task_scan, &s, 41);
  bench_rig_close(r);
  return status;
}

int bench_loops(bench *b, lab_error *error)
{
  static bench_rig healthy, leaky;
  char line[BENCH_LINE];
  if (bench_rig_write(b, "healthy", rows, 0, &healthy, error) || bench_rig_write(b, "leaky", rows, 1, &leaky, error) ||
      scan(b, &leaky, error))
    return error->status;
  bench_closeloop_line(b, &healthy, line);
  alone(b, "closeloop on a sound rig", "5000 rows", bench_task_command, line, 11);
  bench_closeloop_line(b, &leaky, line);
  alone(b, "closeloop with a leak missing", "5000 rows", bench_task_command, line, 11);
  if (b->quick)
    return LAB_OK;
  snprintf(line, sizeof line, "exec '%s/sweep' hypotheses.cfg --force --quiet --results '%s/study' >/dev/null",
           b->programs, b->scratch);
  alone(b, "study with figures", "all", bench_task_command, line, BENCH_FEWEST);
  return LAB_OK;
}
