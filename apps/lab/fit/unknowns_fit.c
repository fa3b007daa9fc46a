/* Slopes, fits and intervals of the unknowns. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "unknowns.h"

static const double slope_step = 1e-3;   /* of a slope's difference, over what matters */
static const double instant_step = 0.15; /* the same of an instant, which dry friction makes rough within a row: half
                                            of what is known of it */
static const double coarse_step = 0.05;  /* the same where slips come and go on shorter ones */
static const double held_step = 0.25;    /* of what is held, over its tolerance: it moves little else */

/* Of the steps for an interval, over what matters or over a spread, and the tolerance of the stepper for them: where
 * only a prior tells values apart (area, spring, orifices and volume may all be larger) their slopes have to cancel,
 * and one row that a stop or a breakaway passes by within the step seems to tell them apart. */
static const double close_step = 1e-5, known_step = 5e-4, exact = 1e-10;

double lab_unknowns_slope_step(const lab_unknowns *u, const double *theta, int j)
{
  const lab_unknown *x = &u->unknown[j];
  const double share = u->window ? coarse_step : x->kind == LAB_UNKNOWN_INSTANT ? instant_step : slope_step;
  const double step = lab_unknown_is_held(x) ? held_step * x->spread : share * (x->scale > 0 ? x->scale : 1);
  return theta[j] + step > x->upper ? -step : step;
}

/* Where a run begins in no state of the rig because of the values that a fit tries, the data are not at fault. */
static int avoided(lab_error *error)
{
  return error->status = error->status == LAB_DATA ? LAB_NUMERIC : error->status;
}

int lab_unknowns_difference(const lab_unknowns *u, const double *theta, const double *r, int j, double step,
                            double *column, lab_error *error)
{
  double at[LAB_FIT_MAX];
  size_t i;
  memcpy(at, theta, (size_t)u->n * sizeof *at);
  at[j] = theta[j] + step;
  if (lab_unknowns_change(u, at, j, r, column, error))
    return avoided(error);
  for (i = 0; i < u->m; i++)
    column[i] /= at[j] - theta[j];
  return LAB_OK;
}

/* A change is seen along a long valley, where what several of them do cancels but for a hundredth: the mean of both
 * sides, whose error is of second order.  In: there  room for u->m values */
static int slope_of_change(const lab_unknowns *u, const double *theta, const double *r, int j, double step,
                           double *column, double *there, lab_error *error)
{
  size_t i;
  if (lab_unknowns_difference(u, theta, r, j, step, column, error) ||
      lab_unknowns_difference(u, theta, r, j, -step, there, error))
    return error->status;
  for (i = 0; i < u->m; i++)
    column[i] = (column[i] + there[i]) / 2;
  return LAB_OK;
}

/* A step that is small beside what matters. */
int lab_unknowns_slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const lab_unknowns *u = context;
  const lab_unknown *x = &u->unknown[j];
  const double step = lab_unknowns_slope_step(u, theta, j);
  double *there;
  int status;
  if (x->kind != LAB_UNKNOWN_CHANGE || theta[j] + step > x->upper || theta[j] - step < x->lower)
    return lab_unknowns_difference(u, theta, r, j, step, column, error);
  there = malloc(u->m * sizeof *there);
  status = there ? slope_of_change(u, theta, r, j, step, column, there, error) : lab_fail_memory(error, "a slope");
  free(there);
  return status;
}

/* The same with a step so small that it passes no kink, where the model can be followed that closely. */
static int close_slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const lab_unknowns *u = context;
  const lab_unknown *x = &u->unknown[j];
  const double size = lab_unknown_is_known(x) ? known_step * x->spread : close_step * (x->scale > 0 ? x->scale : 1);
  const double step = theta[j] + size > x->upper ? -size : size;
  const int status = u->window ? (int)LAB_NUMERIC : lab_unknowns_difference(u, theta, r, j, step, column, error);
  return status == LAB_NUMERIC ? lab_unknowns_slope(context, theta, r, j, column, error) : status;
}

/* Residuals for a fit, which begins at the present values. */
static int residuals_to_fit(void *context, const double *theta, double *r, lab_error *error)
{
  const lab_unknowns *u = context;
  int j, is_start = 1;
  for (j = 0; j < u->n; j++)
    is_start &= theta[j] == u->unknown[j].value;
  if (lab_unknowns_residuals(context, theta, r, error))
    return is_start ? error->status : avoided(error);
  return LAB_OK;
}

/* The problem that the unknowns pose, and its memory. */
typedef struct posed {
  double theta[LAB_FIT_MAX], lower[LAB_FIT_MAX], upper[LAB_FIT_MAX];
  lab_fit_problem problem;
} posed;

static int any_slope(const lab_unknowns *u)
{
  int j, any = 0;
  for (j = 0; j < u->n; j++)
    any |= u->has_slope[j];
  return any;
}

static void pose(lab_unknowns *u, posed *p)
{
  int j;
  lab_unknowns_count(u);
  for (j = 0; j < u->n; j++) {
    p->theta[j] = u->unknown[j].value;
    p->lower[j] = u->unknown[j].lower;
    p->upper[j] = u->unknown[j].upper;
  }
  p->problem = (lab_fit_problem){.n = u->n,
                                 .m = u->m,
                                 .lower = p->lower,
                                 .upper = p->upper,
                                 .context = u,
                                 .residuals = residuals_to_fit,
                                 .slope = lab_unknowns_slope,
                                 .together = lab_unknowns_slopes_together,
                                 .slopes = u->slopes,
                                 .is_known = u->slopes && any_slope(u) ? u->has_slope : NULL,
                                 .is_rough = u->window > 0};
}

int lab_unknowns_slopes(lab_unknowns *u, const double *r, char *done, double *J, lab_error *error)
{
  posed p;
  pose(u, &p);
  p.problem.until = u->until;
  return lab_fit_other_slopes(&p.problem, p.theta, r, J, done, error);
}

int lab_unknowns_keep_slopes(lab_unknowns *u, lab_error *error)
{
  static const size_t most = 4000000; /* values */
  size_t size;
  lab_unknowns_count(u);
  size = (size_t)u->n * u->m;
  memset(u->has_slope, 0, sizeof u->has_slope);
  u->slopes = NULL;
  if (size >= most || u->window)
    return LAB_OK;
  u->slopes = malloc((size + 1) * sizeof *u->slopes);
  return u->slopes ? LAB_OK : lab_fail_memory(error, "slopes");
}

void lab_unknowns_forget_slopes(lab_unknowns *u)
{
  free(u->slopes);
  u->slopes = NULL;
}

int lab_unknowns_find_slopes(lab_unknowns *u, lab_error *error)
{
  char done[LAB_FIT_MAX] = {0};
  double *r;
  int status;
  if (!u->slopes)
    return LAB_OK;
  lab_unknowns_count(u);
  r = malloc((u->m + 1) * sizeof *r);
  status = r ? lab_unknowns_residuals(u, NULL, r, error) : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    status = lab_unknowns_slopes(u, r, done, u->slopes, error);
  memset(u->has_slope, status == LAB_OK, (size_t)u->n);
  free(r);
  return status;
}

/* The column of an unknown of that name, NULL: it has none. */
static const double *slope_of(const lab_unknowns *u, const char *name)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->has_slope[j] && strcmp(u->unknown[j].name, name) == 0)
      return u->slopes + (size_t)j * u->m;
  return NULL;
}

void lab_unknowns_begin_with(lab_unknowns *u, const lab_unknowns *base)
{
  const size_t before = lab_unknowns_before_priors(u);
  int j;
  lab_unknowns_count(u);
  memset(u->has_slope, 0, sizeof u->has_slope);
  for (j = 0; j < u->n && u->slopes && base->slopes && u->nuisance == base->nuisance; j++) {
    const double *from = slope_of(base, u->unknown[j].name);
    double *to = u->slopes + (size_t)j * u->m;
    if (!from)
      continue;
    memset(to, 0, u->m * sizeof *to);
    memcpy(to, from, before * sizeof *to);
    lab_unknowns_slope_of_prior(u, j, to);
    u->has_slope[j] = 1;
  }
}

static int fit_as_weighed(lab_unknowns *u, int steps, double *chi2, lab_error *error)
{
  posed p;
  int j, status;
  pose(u, &p);
  p.problem.steps = steps;
  p.problem.is_brief = steps != LAB_ROUNDS_ALL;
  p.problem.until = u->until;
  status = lab_fit(&p.problem, p.theta, chi2, error);
  if (status != LAB_OK)
    return status;
  for (j = 0; j < u->n; j++)
    u->unknown[j].value = p.theta[j];
  memset(u->has_slope, u->slopes != NULL, (size_t)u->n);
  lab_unknowns_apply(u, p.theta, LAB_ALL_RUNS, &u->rig);
  return LAB_OK;
}

int lab_unknowns_fit(lab_unknowns *u, int steps, double *chi2, lab_error *error)
{
  double before, own;
  int status = lab_unknowns_weigh_own(u, error);
  do {
    before = u->own_misfit;
    if (status == LAB_OK)
      status = fit_as_weighed(u, steps, chi2 ? chi2 : &own, error);
    if (status == LAB_OK)
      status = lab_unknowns_weigh_own(u, error);
  } while (status == LAB_OK && lab_misfit_has_fallen(before, u->own_misfit));
  return status;
}

static int find_intervals(lab_unknowns *u, lab_fit_result *result, lab_error *error)
{
  const int in_time = !lab_cpu_is_spent(u->until);
  lab_fit_param param[LAB_FIT_MAX];
  const double tol = u->tol;
  posed p;
  int j, status = LAB_NUMERIC;
  pose(u, &p);
  for (j = 0; j < u->n; j++)
    param[j] = (lab_fit_param){u->unknown[j].name, u->unknown[j].scale, lab_unknown_is_held(&u->unknown[j])};
  p.problem.until = 0; /* they belong to the answer */
  if (in_time) {
    p.problem.slope = close_slope;
    if (lab_rig_has_positioner(&u->rig)) /* to first order the jump at the edge of its dead band has no width */
      p.problem.together = NULL;
    u->tol = fmin(u->tol, exact);
    status = lab_fit_spread(&p.problem, param, p.theta, result, error);
    u->tol = tol;
  }
  if (status == LAB_NUMERIC) {
    p.problem.together = lab_unknowns_slopes_together;
    p.problem.slope = lab_unknowns_slope; /* no time, or a model too stiff to be followed so closely */
    status = lab_fit_spread(&p.problem, param, p.theta, result, error);
  }
  return status;
}

/* An unknown that rests may be anything that its bounds allow. */
int lab_unknowns_intervals(lab_unknowns *u, lab_fit_result *result, lab_error *error)
{
  char rests[LAB_FIT_MAX];
  int j, status;
  for (j = 0; j < u->n; j++) {
    lab_unknown *x = &u->unknown[j];
    rests[j] = (char)lab_unknown_rests(x);
    if (!rests[j])
      continue;
    x->lower = (double)lab_param_info(x->index).lower;
    x->upper = (double)lab_param_info(x->index).upper;
  }
  status = find_intervals(u, result, error);
  for (j = 0; j < u->n; j++)
    if (rests[j])
      u->unknown[j].lower = u->unknown[j].upper = u->unknown[j].value;
  return status;
}
