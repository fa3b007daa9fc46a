/* One fill-and-vent by every contender.
 *
 * Each runs at a ladder of tolerances; its error is the largest difference of position from the reference, over the
 * stroke, on the 10 ms grid. The diagram times the whole ladder; the table times, with many repeats, the loosest
 * tolerance with which each reaches an error, all in turn. Timed runs take no samples. */
#include "bench.h"

#include <math.h>
#include <stdio.h>

enum { RUNGS = 31, SHOWN = 3, ROOM = 4096, WANTED = 3 };

static const double wanted[WANTED] = {1e-4, 1e-6, 1e-8};
static const double budget = 2; /* [s] a lane and race */

typedef struct entry {
  const bench_contender *by;
  const bench_case *task;
  double tol;
} entry;

static double once(void *context)
{
  const entry *e = context;
  return e->by->simulate(e->task, e->tol, NULL, NULL);
}

static double rung(int i)
{
  return pow(10, -3 - 0.25 * i);
}

/* Largest error of position over the stroke; NaN where the run fails. */
static double error_of(const entry *e, const double *reference)
{
  static double p[ROOM], x[ROOM];
  double gap = 0;
  size_t i;
  if (isnan(e->by->simulate(e->task, e->tol, p, x)))
    return (double)NAN;
  for (i = 0; i < e->task->rows; i++)
    gap = fmax(gap, fabs(x[i] - reference[i]));
  return gap / (double)e->task->model->p.stroke;
}

/* Every third rung, all contenders in turn. */
static void draw(bench *b, int law, const bench_case *task, double (*error)[RUNGS])
{
  entry e[BENCH_CONTENDERS_MAX];
  bench_lane lane[BENCH_CONTENDERS_MAX];
  int i, k;
  for (i = 0; i < RUNGS; i += SHOWN) {
    for (k = 0; k < b->n; k++) {
      e[k] = (entry){&b->contender[k], task, rung(i)};
      lane[k] = (bench_lane){.run = once, .context = &e[k]};
    }
    bench_race(lane, b->n, bench_repeats(b, 21), budget / 10);
    for (k = 0; k < b->n; k++)
      table_row(&b->diagram, "sssggg", b->contender[k].name, pneu_gas_key(bench_laws[law].gas),
                pneu_flow_key(bench_laws[law].flow), rung(i), error[k][i], lane[k].spread.median * 1e6);
  }
}

/* The loosest rung with this error or less; -1 if there is none. */
static int loosest(const double *error, double most)
{
  int i;
  for (i = 0; i < RUNGS; i++)
    if (error[i] <= most)
      return i;
  return -1;
}

static void compare(bench *b, const bench_case *task, const char *words, double most, double (*error)[RUNGS])
{
  entry e[BENCH_CONTENDERS_MAX];
  bench_lane lane[BENCH_CONTENDERS_MAX];
  double reached[BENCH_CONTENDERS_MAX];
  char item[32];
  int k, n = 0;
  for (k = 0; k < b->n; k++) {
    const int i = loosest(error[k], most);
    if (i < 0)
      continue;
    reached[n] = error[k][i];
    e[n] = (entry){&b->contender[k], task, rung(i)};
    lane[n] = (bench_lane){.run = once, .context = &e[n]};
    n++;
  }
  bench_race(lane, n, bench_repeats(b, BENCH_REPEATS_MAX), budget);
  snprintf(item, sizeof item, "fill-and-vent at %.0e", most);
  for (k = 0; k < n; k++)
    bench_item(b, item, words, e[k].by->name, e[k].tol, reached[k], &lane[k].spread, lane[0].spread.median);
}

static int race_law(bench *b, int law, lab_error *error)
{
  static double reference[ROOM], unused[ROOM], reached[BENCH_CONTENDERS_MAX][RUNGS];
  const int of_fit = bench_laws[law].gas == PNEU_GAS_ISOTHERMAL && bench_laws[law].flow == PNEU_FLOW_CHOKED;
  pneu_model model;
  bench_case task;
  char words[64];
  int i, k;
  bench_model(law, &model);
  bench_fill_and_vent(&model, &task);
  if (bench_reference(&task, unused, reference))
    return lab_fail(error, LAB_NUMERIC, "the reference fails on a fill-and-vent");
  for (k = 0; k < b->n; k++)
    for (i = 0; i < RUNGS; i++) {
      const entry e = {&b->contender[k], &task, rung(i)};
      reached[k][i] = error_of(&e, reference);
    }
  draw(b, law, &task, reached);
  snprintf(words, sizeof words, "%s %s", pneu_gas_key(bench_laws[law].gas), pneu_flow_key(bench_laws[law].flow));
  for (i = 0; i < WANTED; i++)
    compare(b, &task, words, wanted[i], reached);
  for (k = 0; k < b->n && of_fit; k++)
    b->fit_tol[k] = loosest(reached[k], 1e-6) < 0 ? rung(RUNGS - 1) : rung(loosest(reached[k], 1e-6));
  return LAB_OK;
}

int bench_races(bench *b, lab_error *error)
{
  int law, status = LAB_OK;
  for (law = 0; law < BENCH_LAWS && status == LAB_OK; law++)
    status = race_law(b, law, error);
  return status;
}
