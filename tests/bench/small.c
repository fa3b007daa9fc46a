/* The right-hand side, and a step of 1 ms as firmware takes it: two seconds of filling, in steps. */
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { STEPS = 2000, LAW = 1 /* isothermal, choked */ };

static const double dt = 1e-3, budget = 3; /* [s] */

typedef struct rates_entry {
  const bench_contender *by;
  const bench_case *task;
} rates_entry;

static double rates(void *context)
{
  const rates_entry *e = context;
  return e->by->rates(e->task);
}

static void right_hand_side(bench *b, const bench_case *task)
{
  rates_entry e[BENCH_CONTENDERS_MAX];
  bench_lane lane[BENCH_CONTENDERS_MAX];
  int k, n = 0;
  for (k = 0; k < b->n; k++) {
    e[n] = (rates_entry){&b->contender[k], task};
    lane[n] = (bench_lane){.run = rates, .context = &e[n]};
    n += e[n].by->rates != NULL;
  }
  bench_race(lane, n, bench_repeats(b, 41), budget);
  for (k = 0; k < n; k++)
    bench_item(b, "right-hand side", "isothermal choked", e[k].by->name, (double)NAN, (double)NAN, &lane[k].spread,
               lane[0].spread.median);
}

/* Steps of the length that a firmware loop has.  Out: x  at their ends, may be NULL */
static double in_steps(const bench_case *task, double *x)
{
  pneu_input input;
  pneu_state state;
  pneu_workspace work;
  double started;
  int i, status = PNEU_OK;
  memset(&work, 0, sizeof work);
  pneu_input_default(task->model, &input);
  pneu_state_rest(task->model, 0, task->model->p.ambient_temperature, 0, &input, &state);
  input.u = 1;
  started = bench_seconds();
  for (i = 0; i < STEPS && status == PNEU_OK; i++) {
    status = pneu_step(task->model, &state, &input, (pneu_real)dt, &work);
    if (x)
      x[i + 1] = (double)state.x;
  }
  return status == PNEU_OK ? (bench_seconds() - started) / STEPS : (double)NAN;
}

static double step_of_stepper(void *context)
{
  return in_steps(context, NULL);
}

typedef struct restart {
  const bench_case *task;
  double tol;
} restart;

/* CVODE started anew every millisecond: a command may have changed. */
static double step_of_cvode(void *context)
{
  const restart *r = context;
  return bench_own[BENCH_CVODE].simulate(r->task, r->tol, NULL, NULL) / STEPS;
}

static double gap(const double *x, const double *y, double stroke)
{
  double most = 0;
  int i;
  for (i = 1; i <= STEPS; i++)
    most = fmax(most, fabs(x[i] - y[i]));
  return most / stroke;
}

/* CVODE's loosest tolerance that is as exact as pneu_step.  Returns: its error */
static double as_exact(const bench_case *task, const double *reference, double error, double *tol)
{
  static double p[STEPS + 1], x[STEPS + 1];
  const double stroke = (double)task->model->p.stroke;
  double reached = HUGE_VAL;
  for (*tol = 1e-2; *tol > 1e-11 && !(reached <= error); *tol /= 2)
    if (!isnan(bench_own[BENCH_CVODE].simulate(task, *tol, p, x)))
      reached = gap(x, reference, stroke);
  *tol *= 2;
  return reached;
}

static int steps(bench *b, const pneu_model *model, lab_error *error)
{
  static double duration[STEPS], command[STEPS], p[STEPS + 1], x[STEPS + 1], reference[STEPS + 1];
  const double whole = STEPS * dt, fill = 1;
  bench_case apart = {model, STEPS, duration, command, STEPS + 1, dt};
  const bench_case at_once = {model, 1, &whole, &fill, STEPS + 1, dt};
  restart r = {&apart, 0};
  bench_lane lane[BENCH_OWN] = {{step_of_stepper, &apart, {0, 0, 0, 0}}, {step_of_cvode, &r, {0, 0, 0, 0}}};
  double own, theirs;
  int i;
  for (i = 0; i < STEPS; i++) {
    duration[i] = dt;
    command[i] = 1;
  }
  if (bench_reference(&at_once, p, reference) || isnan(in_steps(&apart, x)))
    return lab_fail(error, LAB_NUMERIC, "two seconds of filling fail");
  own = gap(x, reference, (double)model->p.stroke);
  theirs = as_exact(&apart, reference, own, &r.tol);
  bench_race(lane, BENCH_OWN, bench_repeats(b, 41), budget);
  bench_item(b, "step of 1 ms", "isothermal choked", bench_own[0].name, (double)NAN, own, &lane[0].spread,
             lane[0].spread.median);
  bench_item(b, "step of 1 ms", "isothermal choked", bench_own[1].name, r.tol, theirs, &lane[1].spread,
             lane[0].spread.median);
  return LAB_OK;
}

int bench_small(bench *b, lab_error *error)
{
  pneu_model model;
  bench_case task;
  bench_model(LAW, &model);
  bench_fill_and_vent(&model, &task);
  right_hand_side(b, &task);
  return steps(b, &model, error);
}
