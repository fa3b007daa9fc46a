#include "fitting.h"

#include <math.h>
#include <stdlib.h>

#include "../../apps/lab/fit/fit.h"
#include "../second/rig.h"
#include "timing.h"

enum { ROWS = 450, STRETCHES = 3 };

static const double slope_step = 1e-3; /* as in apps/lab/fit/unknowns_fit.c */
static const double duration[STRETCHES] = {0.5, 4.5, 3.98}, command[STRETCHES] = {0, 1, -1}, spacing = 0.02;
static double measured_p[ROWS], measured_x[ROWS];

/* What the bench has, against what is declared. */
static second_rig truth(void)
{
  second_rig g = second_rig_default_r1_400();
  g.flow = SECOND_CHOKED;
  g.fill_area = g.vent_area *= 1.08;
  g.dry_friction *= 0.9;
  g.spring_rate *= 0.95;
  g.spring_preload *= 1.05;
  g.pressure_noise = 320;
  g.position_noise = 2e-5;
  g.seed = 1;
  g.step = 1e-5;
  return g;
}

int bench_fit_apply(bench_fit *fit, const double *theta)
{
  pneu_params p;
  const pneu_laws law = {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 0};
  pneu_params_default(&p);
  p.fill_area *= (pneu_real)theta[0];
  p.vent_area *= (pneu_real)theta[0];
  p.dry_friction *= (pneu_real)theta[1];
  p.spring_rate *= (pneu_real)theta[2];
  p.spring_preload *= (pneu_real)theta[3];
  return pneu_model_init(&fit->model, &p, &law, NULL) == PNEU_OK ? 0 : -1;
}

int bench_fit_open(bench_fit *fit)
{
  static const double at[STRETCHES] = {0, 0.5, 5}, declared[BENCH_FITTED] = {1, 1, 1, 1};
  const second_rig g = truth();
  const bench_case task = {&fit->model, STRETCHES, duration, command, ROWS, spacing};
  second_log log = {0};
  log.p = measured_p;
  log.x = measured_x;
  fit->task = task;
  fit->p = measured_p;
  fit->x = measured_x;
  fit->sigma_p = g.pressure_noise;
  fit->sigma_x = g.position_noise;
  if (second_run(&g, at, command, STRETCHES, (ROWS - 1) * spacing, spacing, &log, NULL))
    return -1;
  return bench_fit_apply(fit, declared);
}

const bench_case *bench_fit_task(const bench_fit *fit)
{
  return &fit->task;
}

double bench_fit_residuals(const bench_fit *fit, const double *p, const double *x, double *r)
{
  double sum = 0;
  size_t i;
  for (i = 0; i < fit->task.rows; i++) {
    r[2 * i] = (p[i] - fit->p[i]) / fit->sigma_p;
    r[2 * i + 1] = (x[i] - fit->x[i]) / fit->sigma_x;
    sum += r[2 * i] * r[2 * i] + r[2 * i + 1] * r[2 * i + 1];
  }
  return sum;
}

/* ---- Levenberg and Marquardt, as closeloop does it, over either integrator ---- */

typedef struct job {
  bench_fit *fit;
  const bench_contender *by;
  double tol;
} job;

static int residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const job *j = context;
  double p[ROWS], x[ROWS];
  if (bench_fit_apply(j->fit, theta) || isnan(j->by->simulate(&j->fit->task, j->tol, p, x)))
    return lab_fail(error, LAB_NUMERIC, "no simulation at this point");
  bench_fit_residuals(j->fit, p, x, r);
  return LAB_OK;
}

static int slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  double moved[BENCH_FITTED];
  int i, status;
  for (i = 0; i < BENCH_FITTED; i++)
    moved[i] = theta[i];
  moved[j] += slope_step;
  status = residuals(context, moved, column, error);
  for (i = 0; i < 2 * ROWS && status == LAB_OK; i++)
    column[i] = (column[i] - r[i]) / slope_step;
  return status;
}

static double descend(bench_fit *fit, const bench_contender *by, double tol, double *theta)
{
  static const double lower[BENCH_FITTED] = {0.1, 0.1, 0.1, 0.1}, upper[BENCH_FITTED] = {10, 10, 10, 10};
  job j = {fit, by, tol};
  const lab_fit_problem problem = {.n = BENCH_FITTED,
                                   .m = 2 * ROWS,
                                   .lower = lower,
                                   .upper = upper,
                                   .context = &j,
                                   .residuals = residuals,
                                   .slope = slope};
  lab_error error;
  const double started = bench_seconds();
  double chi2;
  return lab_fit(&problem, theta, &chi2, &error) == LAB_OK ? bench_seconds() - started : (double)NAN;
}

double bench_fit_stepper(bench_fit *fit, double tol, double *theta)
{
  return descend(fit, &bench_own[BENCH_STEPPER], tol, theta);
}

double bench_fit_cvode(bench_fit *fit, double tol, double *theta)
{
  return descend(fit, &bench_own[BENCH_CVODE], tol, theta);
}
