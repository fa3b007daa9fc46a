/* Reading a log of a million rows, beside programs that only pass over its bytes. */
#include "bench.h"

#include <math.h>
#include <stdio.h>

#include "tasks.h"

enum { READERS = 3 };

static const double budget = 20; /* [s] */

int bench_readings(bench *b, lab_error *error)
{
  static const char *const name[READERS] = {"libpneu", "wc -l", "cat"};
  static bench_rig r;
  char count[2 * BENCH_PATH], copy[2 * BENCH_PATH];
  bench_lane lane[READERS] = {{bench_task_read, &r, {0, 0, 0, 0}},
                              {bench_task_command, count, {0, 0, 0, 0}},
                              {bench_task_command, copy, {0, 0, 0, 0}}};
  const double rows = b->quick ? 1e4 : 1e6;
  char words[64];
  int k;
  if (bench_rig_write(b, "long", rows, 0, &r, error) || bench_rig_open(&r, error))
    return error->status;
  bench_rig_close(&r);
  snprintf(count, sizeof count, "exec wc -l '%s/fit.csv' >/dev/null", r.folder);
  snprintf(copy, sizeof copy, "exec cat '%s/fit.csv' | cat >/dev/null", r.folder);
  snprintf(words, sizeof words, "%.0e rows of 4 columns", rows);
  bench_race(lane, READERS, bench_repeats(b, 21), budget);
  for (k = 0; k < READERS; k++)
    bench_item(b, "reading a log", words, name[k], (double)NAN, (double)NAN, &lane[k].spread, lane[0].spread.median);
  return LAB_OK;
}
