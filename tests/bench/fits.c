/* The four-parameter fit by every contender that can: same rows, same start, same weights. Its error is the largest
 * relative difference of a parameter from what CVODE finds at 1e-10. */
#include "bench.h"

#include <math.h>

#include "fitting.h"

static const double budget = 10; /* [s] */

typedef struct entry {
  const bench_contender *by;
  bench_fit *fit;
  double tol, theta[BENCH_FITTED];
} entry;

static double once(void *context)
{
  entry *e = context;
  int i;
  for (i = 0; i < BENCH_FITTED; i++)
    e->theta[i] = 1;
  return e->by->fit(e->fit, e->tol, e->theta);
}

int bench_fits(bench *b, lab_error *error)
{
  static bench_fit fit;
  entry e[BENCH_CONTENDERS_MAX], exact = {&bench_own[BENCH_CVODE], &fit, 1e-10, {0}};
  bench_lane lane[BENCH_CONTENDERS_MAX];
  int k, i, n = 0;
  if (bench_fit_open(&fit) || isnan(once(&exact)))
    return lab_fail(error, LAB_NUMERIC, "the rows to fit, or the fit of reference, fail");
  for (k = 0; k < b->n; k++) {
    e[n] = (entry){&b->contender[k], &fit, b->fit_tol[k], {0}};
    lane[n] = (bench_lane){.run = once, .context = &e[n]};
    n += e[n].by->fit != NULL;
  }
  bench_race(lane, n, bench_repeats(b, 41), budget);
  for (k = 0; k < n; k++) {
    double gap = 0;
    for (i = 0; i < BENCH_FITTED; i++)
      gap = fmax(gap, fabs(e[k].theta[i] / exact.theta[i] - 1));
    bench_item(b, "fit of 4 parameters", "isothermal choked", e[k].by->name, e[k].tol, gap, &lane[k].spread,
               lane[0].spread.median);
  }
  return LAB_OK;
}
