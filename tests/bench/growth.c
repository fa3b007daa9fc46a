/* How the cost grows: over rows, effects, parameters and threads. Rows grow by denser sampling of the same strokes. */
#include "bench.h"

#include <stdio.h>
#include <string.h>

#include <omp.h>

#include "tasks.h"

static const double usual_rows = 5000, budget = 20; /* [1], [s] */

static void add(bench *b, const char *task, const char *grows, double value, double (*run)(void *), void *context,
                int repeats)
{
  bench_lane lane = {run, context, {0, 0, 0, 0}};
  bench_race(&lane, 1, bench_repeats(b, repeats), budget);
  bench_scale(b, task, grows, value, &lane.spread);
}

static int at_rows(bench *b, double rows, int repeats, lab_error *error)
{
  static bench_rig r;
  static bench_scan s;
  char line[BENCH_LINE];
  int status = bench_rig_write(b, "rows", rows, 1, &r, error);
  if (status == LAB_OK)
    status = bench_rig_open(&r, error);
  if (status == LAB_OK)
    status = bench_scan_fit(&r, &s, error);
  if (status == LAB_OK) {
    add(b, "read", "rows", rows, bench_task_read, &r, repeats);
    add(b, "fit", "rows", rows, bench_task_fit, &r, repeats);
    add(b, "scan", "rows", rows, bench_task_scan, &s, repeats);
    bench_closeloop_line(b, &r, line);
    add(b, "closeloop", "rows", rows, bench_task_command, line, repeats);
  }
  bench_rig_close(&r);
  return status;
}

static int over_rows(bench *b, lab_error *error)
{
  static const double rows[] = {1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6};
  const int n = b->quick ? 2 : (int)(sizeof rows / sizeof *rows);
  int i, status = LAB_OK;
  for (i = 0; i < n && status == LAB_OK; i++)
    status = at_rows(b, rows[i], rows[i] > 2e4 ? BENCH_FEWEST : 11, error);
  return status;
}

static void over_effects(bench *b, bench_scan *s)
{
  for (s->effects = 5; s->effects <= 25; s->effects += 5)
    add(b, "scan", "effects", s->effects, bench_task_scan, s, 21);
  s->effects = 0;
}

static void over_parameters(bench *b, bench_rig *r)
{
  static const char *const name[] = {"fill_area",   "vent_area", "dry_friction", "spring_preload", "spring_rate",
                                     "dead_volume", "stroke",    "damping",      "moving_mass",    "supply_pressure"};
  enum { NAMES = sizeof name / sizeof *name };
  const lab_rig declared = r->rig;
  int n;
  for (n = 2; n <= NAMES; n += 2) {
    for (r->rig.n_fit = 0; r->rig.n_fit < n; r->rig.n_fit++) {
      r->rig.fit[r->rig.n_fit] = pneu_param_find(name[r->rig.n_fit]);
      r->rig.fit_per_log[r->rig.n_fit] = 0;
    }
    add(b, "fit", "parameters", n, bench_task_fit, r, 11);
  }
  r->rig = declared;
}

static void over_threads(bench *b, bench_rig *r, bench_scan *s)
{
  const int most = omp_get_num_procs();
  int n;
  for (n = 1; n <= most; n *= 2) {
    omp_set_num_threads(n);
    add(b, "fit", "threads", n, bench_task_fit, r, 11);
    add(b, "scan", "threads", n, bench_task_scan, s, 21);
  }
  omp_set_num_threads(1);
}

int bench_growth(bench *b, lab_error *error)
{
  static bench_rig r;
  static bench_scan s;
  int status = bench_rig_write(b, "usual", usual_rows, 0, &r, error);
  if (status == LAB_OK)
    status = bench_rig_open(&r, error);
  if (status == LAB_OK)
    status = bench_scan_fit(&r, &s, error);
  if (status == LAB_OK) {
    over_effects(b, &s);
    over_parameters(b, &r);
    over_threads(b, &r, &s);
  }
  bench_rig_close(&r);
  return status == LAB_OK ? over_rows(b, error) : status;
}
