/* Residuals and their slopes at a point. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit_private.h"

/* ---- Coordinates ---- */

static double to_z(const lab_fit_param *p, double unit, double theta)
{
  return p->log_scaled ? log(theta / p->start) : (theta - p->start) / unit;
}

static double linear_unit(const lab_fit_param *p)
{
  if (p->scale > 0)
    return p->scale;
  if (p->start != 0)
    return fabs(p->start);
  return isfinite(p->upper - p->lower) ? 0.01 * (p->upper - p->lower) : 1;
}

int fit_open(fit_run *run, const lab_fit_problem *problem, const lab_fit_options *options, lab_error *error)
{
  int j;
  memset(run, 0, sizeof *run);
  run->problem = problem;
  run->options = options;
  run->best = (double)INFINITY;
  for (j = 0; j < problem->n; j++) {
    const lab_fit_param *p = &problem->param[j];
    run->unit[j] = linear_unit(p);
    run->lower[j] = to_z(p, run->unit[j], p->lower);
    run->upper[j] = to_z(p, run->unit[j], p->upper);
    run->step[j] = cbrt(options->precision);
  }
  run->r = calloc(problem->m, sizeof(double));
  run->slope = calloc(problem->m * (size_t)problem->n, sizeof(double));
  if (run->r && run->slope)
    return LAB_OK;
  fit_close(run);
  return lab_fail_memory(error, "a fit");
}

void fit_close(fit_run *run)
{
  free(run->r);
  free(run->slope);
  run->r = run->slope = NULL;
}

static double clip(double value, double lower, double upper)
{
  return value < lower ? lower : value > upper ? upper : value;
}

void fit_theta(const fit_run *run, const double *z, double *theta)
{
  int j;
  for (j = 0; j < run->problem->n; j++) {
    const lab_fit_param *p = &run->problem->param[j];
    theta[j] = clip(p->log_scaled ? p->start * exp(z[j]) : p->start + run->unit[j] * z[j], p->lower, p->upper);
  }
}

/* ---- Residuals ---- */

/* A point at which the model fails: remembered, so that a fit without any good point can say why. */
static int bad_point(fit_run *run)
{
  run->failed++;
  return FIT_BAD;
}

static int ended(fit_run *run, int status)
{
  run->status = status;
  return FIT_END;
}

/* Weigh the residuals.  Out: sum of squares.  Returns: the first that is not finite, or m. */
static size_t weigh(fit_run *run, double *sum)
{
  const lab_fit_problem *p = run->problem;
  size_t i;
  *sum = 0;
  for (i = 0; i < p->m && isfinite(run->r[i]); i++) {
    if (p->sigma)
      run->r[i] /= p->sigma[i];
    *sum += run->r[i] * run->r[i];
  }
  return i;
}

static void keep_best(fit_run *run, const double *z, double sum)
{
  int j;
  if (!(sum < run->best))
    return;
  run->best = sum;
  for (j = 0; j < run->problem->n; j++)
    run->best_z[j] = clip(z[j], run->lower[j], run->upper[j]);
}

int fit_evaluate(fit_run *run, const double *z, double *sum)
{
  const lab_fit_problem *p = run->problem;
  double theta[LAB_FIT_MAX];
  size_t bad;
  int status;
  *sum = (double)INFINITY;
  fit_theta(run, z, theta);
  run->evaluations++;
  status = p->residuals(p->context, theta, run->r, &run->error);
  if (status != LAB_OK)
    return status == LAB_NUMERIC ? bad_point(run) : ended(run, status);
  bad = weigh(run, sum);
  if (bad == p->m && isfinite(*sum)) {
    keep_best(run, z, *sum);
    return FIT_GOOD;
  }
  *sum = (double)INFINITY;
  lab_fail(&run->error, LAB_NUMERIC, "residual %zu of %zu is not finite", bad < p->m ? bad + 1 : bad, p->m);
  return bad_point(run);
}

/* ---- Slopes ---- */

/* Slopes by the problem's own function, from d/dtheta to d/dz over sigma. */
static int given_slopes(fit_run *run, const double *z)
{
  const lab_fit_problem *p = run->problem;
  double theta[LAB_FIT_MAX];
  size_t i;
  int j, status;
  fit_theta(run, z, theta);
  status = p->slopes(p->context, theta, run->r, run->slope, &run->error);
  if (status != LAB_OK)
    return ended(run, status);
  for (j = 0; j < p->n; j++)
    for (i = 0; i < p->m; i++)
      run->slope[(size_t)j * p->m + i] *=
          (p->param[j].log_scaled ? theta[j] : run->unit[j]) / (p->sigma ? p->sigma[i] : 1);
  return FIT_GOOD;
}

/* A point beside z on axis j, inside the bounds; where the model fails there, z itself.
 * Out:     at  coordinate;  r  residuals */
static int beside(fit_run *run, const double *z, const double *r0, int j, double step, double *at, double *r)
{
  const size_t m = run->problem->m;
  double near[LAB_FIT_MAX], sum;
  int outcome;
  memcpy(near, z, (size_t)run->problem->n * sizeof *near);
  near[j] = *at = clip(z[j] + step, run->lower[j], run->upper[j]);
  outcome = fit_evaluate(run, near, &sum);
  if (outcome == FIT_BAD)
    *at = z[j];
  memcpy(r, outcome == FIT_BAD ? r0 : run->r, m * sizeof *r);
  return outcome == FIT_END ? FIT_END : FIT_GOOD;
}

/* Step for the next difference on axis j, from the length of the present column. */
static double next_step(const fit_run *run, double length)
{
  const double longest = cbrt(run->options->precision), shortest = sqrt(run->options->precision);
  const double tenth = 0.1 * sqrt(run->best / (double)run->problem->m) / length;
  return clip(isfinite(tenth) ? tenth : longest, shortest, longest);
}

/* Column j by central differences, one-sided at a bound. Twice m numbers of scratch. */
static int difference(fit_run *run, const double *z, const double *r0, int j, double *scratch)
{
  const size_t m = run->problem->m;
  const double h = run->step[j] * fmax(1, fabs(z[j]));
  double length = 0;
  double *above = scratch, *below = scratch + m, from, to;
  size_t i;
  if (beside(run, z, r0, j, h, &to, above) == FIT_END || beside(run, z, r0, j, -h, &from, below) == FIT_END)
    return FIT_END;
  if (!(to > from))
    return ended(run, lab_fail_in(&run->error, "the model fails on both sides of %s", run->problem->param[j].name));
  for (i = 0; i < m; i++) {
    const double slope = run->slope[(size_t)j * m + i] = (above[i] - below[i]) / (to - from);
    length += slope * slope;
  }
  run->step[j] = next_step(run, sqrt(length));
  return FIT_GOOD;
}

static int differences(fit_run *run, const double *z, const int *hold)
{
  const size_t m = run->problem->m;
  double *scratch = calloc(3 * m, sizeof *scratch), *r0;
  int j, outcome = FIT_GOOD;
  if (!scratch)
    return ended(run, lab_fail_memory(&run->error, "the slopes of a fit"));
  r0 = scratch + 2 * m;
  memcpy(r0, run->r, m * sizeof *r0);
  for (j = 0; j < run->problem->n && outcome == FIT_GOOD; j++) {
    if (hold && hold[j])
      memset(run->slope + (size_t)j * m, 0, m * sizeof *run->slope);
    else
      outcome = difference(run, z, r0, j, scratch);
  }
  memcpy(run->r, r0, m * sizeof *r0);
  free(scratch);
  return outcome;
}

int fit_differentiate(fit_run *run, const double *z, const int *hold)
{
  return run->problem->slopes ? given_slopes(run, z) : differences(run, z, hold);
}
