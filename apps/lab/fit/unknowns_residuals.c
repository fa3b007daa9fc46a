/* What is left of the measured values for given unknowns, row by row or seen coarsely. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "drift.h"
#include "drive.h"
#include "linear.h"
#include "windowed.h"
#include "nuisance.h"

void lab_unknowns_apply(const lab_unknowns *u, const double *theta, int run, lab_rig *rig)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].run == LAB_ALL_RUNS || (run != LAB_ALL_RUNS && lab_unknown_acts(&u->unknown[j], run)))
      lab_unknown_apply(&u->unknown[j], theta[j], &u->declared, rig);
}

/* Turn predictions into errors over noise, in place. */
static void weigh(const lab_run *e, double *r)
{
  int c;
  size_t i;
  for (c = 0; c < e->n_channels; c++)
    for (i = 0; i < e->n; i++) {
      double *at = &r[(size_t)c * e->n + i];
      const double measured = lab_run_measured(e, c, i);
      *at = isnan(measured) ? 0 : (measured - *at) / e->sigma[c];
    }
}

/* Predictions of one experiment. */
static int predict(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, double *r, lab_error *error)
{
  lab_drive d;
  int status = lab_drive_open(u, model, theta, e, &d, error);
  if (status == LAB_OK)
    status = lab_run_predict(&u->run[e], d.episode, d.n, d.early, u->tol, r, error);
  lab_drive_close(&d);
  return status;
}

void lab_unknowns_weigh(const lab_unknowns *u, int e, double *r)
{
  const lab_run *x = &u->run[e];
  int c;
  for (c = 0; c < x->n_channels; c++)
    lab_run_weigh(x, c, r + (size_t)c * x->n);
  lab_drift_take_out(x, r);
}

/* Errors of one run over noise, row by row. */
static int errors_of(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, double *r,
                     lab_error *error)
{
  if (lab_linear_has(u, e)) {
    lab_linear_errors(u, e, theta, r);
    return LAB_OK;
  }
  if (predict(u, model, theta, e, r, error))
    return error->status;
  weigh(&u->run[e], r);
  return LAB_OK;
}

static int residuals_of(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, double *r,
                        lab_error *error)
{
  if (errors_of(u, model, theta, e, r, error))
    return error->status;
  lab_unknowns_weigh(u, e, r);
  return LAB_OK;
}

/* The same, seen coarsely. */
static int coarse_residuals_of(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, double *r,
                               lab_error *error)
{
  const lab_run *x = &u->run[e];
  double *predicted = malloc((x->n * (size_t)x->n_channels + 1) * sizeof *predicted);
  int c, status = predicted ? predict(u, model, theta, e, predicted, error) : lab_fail_memory(error, "a response");
  for (c = 0; c < x->n_channels && status == LAB_OK; c++) {
    lab_windowed_residuals(x->log->value[x->channel[c]] + x->first, predicted + (size_t)c * x->n, x->n, u->window,
                           x->sigma[c], r);
    r += 2 * lab_windowed_count(x->n, u->window);
  }
  free(predicted);
  return status;
}

size_t lab_unknowns_residuals_in(const lab_unknowns *u, int e)
{
  const lab_run *x = &u->run[e];
  return (u->window ? 2 * lab_windowed_count(x->n, u->window) : x->n) * (size_t)x->n_channels;
}

static size_t count_values(const lab_unknowns *u)
{
  size_t i, count = 0;
  int e, c;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++)
      for (i = 0; i < u->run[e].n; i++)
        count += !isnan(lab_run_measured(&u->run[e], c, i));
  return count;
}

void lab_unknowns_view(lab_unknowns *u, size_t window)
{
  int e;
  u->window = window;
  for (u->n_data = 0, e = 0; e < u->n_runs; e++)
    u->n_data += lab_unknowns_residuals_in(u, e);
  u->n_values = window ? u->n_data : count_values(u);
  lab_unknowns_count(u);
}

size_t lab_unknowns_before_priors(const lab_unknowns *u)
{
  return u->n_data + (size_t)(u->nuisance ? u->nuisance->n : 0);
}

void lab_unknowns_count(lab_unknowns *u)
{
  u->m = lab_unknowns_before_priors(u) + (size_t)u->n;
}

/* Residuals of the runs that have unknown `which`, or of all for -1; those of other runs are left as they are. */
static int residuals_at(const lab_unknowns *u, const lab_rig *model, const double *theta, int which, double *r,
                        lab_error *error)
{
  double *all = r;
  int e, j;
  for (e = 0; e < u->n_runs; r += lab_unknowns_residuals_in(u, e), e++)
    if ((which < 0 || lab_unknown_acts(&u->unknown[which], e)) &&
        (u->window ? coarse_residuals_of(u, model, theta, e, r, error) : residuals_of(u, model, theta, e, r, error)))
      return error->status;
  if (u->nuisance)
    lab_nuisance_apply(u->nuisance, all);
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    all[lab_unknowns_before_priors(u) + (size_t)j] =
        x->spread > 0 ? (x->prior - theta[j]) / lab_unknown_reach(u, x) : 0;
  }
  return LAB_OK;
}

void lab_unknowns_values(const lab_unknowns *u, double *theta)
{
  int j;
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
}

int lab_unknowns_residuals_of(const lab_unknowns *u, const double *theta, int which, double *r, lab_error *error)
{
  lab_rig model = u->rig;
  lab_unknowns_apply(u, theta, LAB_ALL_RUNS, &model);
  return residuals_at(u, &model, theta, u->nuisance ? -1 : which, r, error);
}

/* Residuals of a model less those of the base, in which the runs that stay have no part. */
static int less_base(const lab_unknowns *u, const lab_rig *model, const double *theta, int which, const double *base,
                     double *change, lab_error *error)
{
  size_t i;
  memcpy(change, base, u->m * sizeof *change);
  if (residuals_at(u, model, theta, u->nuisance ? -1 : which, change, error))
    return error->status;
  for (i = 0; i < u->m; i++)
    change[i] -= base[i];
  return LAB_OK;
}

int lab_unknowns_change(const lab_unknowns *u, const double *theta, int which, const double *r, double *change,
                        lab_error *error)
{
  lab_rig model = u->rig;
  lab_unknowns_apply(u, theta, LAB_ALL_RUNS, &model);
  return less_base(u, &model, theta, which, r, change, error);
}

void lab_unknowns_take(lab_unknowns *u)
{
  double now[LAB_FIT_MAX];
  lab_unknowns_values(u, now);
  lab_unknowns_apply(u, now, LAB_ALL_RUNS, &u->rig);
}

void lab_unknowns_undo_fit(lab_unknowns *u)
{
  int j;
  for (j = 0; j < u->n; j++)
    u->unknown[j].value = u->unknown[j].first;
  lab_unknowns_take(u);
}

int lab_unknowns_residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const lab_unknowns *u = context;
  double now[LAB_FIT_MAX];
  if (!theta)
    lab_unknowns_values(u, now);
  return lab_unknowns_residuals_of(u, theta ? theta : now, -1, r, error);
}

int lab_unknowns_residuals_with(const lab_unknowns *u, const lab_rig *rig, double *r, lab_error *error)
{
  double now[LAB_FIT_MAX];
  lab_unknowns_values(u, now);
  return residuals_at(u, rig, now, -1, r, error);
}

int lab_unknowns_change_with(const lab_unknowns *u, const lab_rig *rig, const double *r, double *change,
                             lab_error *error)
{
  double now[LAB_FIT_MAX];
  lab_unknowns_values(u, now);
  return less_base(u, rig, now, -1, r, change, error);
}

int lab_unknowns_chi2(const lab_unknowns *u, double *chi2, lab_error *error)
{
  double *r = malloc((u->m + 1) * sizeof *r);
  const int status = r ? lab_unknowns_residuals((void *)u, NULL, r, error) : lab_fail_memory(error, "residuals");
  *chi2 = status == LAB_OK ? lab_dot(r, r, u->m) : 0;
  free(r);
  return status;
}

/* Times the noise that the present model leaves; 1 or more. */
static int measure_misfit(lab_unknowns *u, double *misfit, lab_error *error)
{
  double *r;
  int status;
  lab_unknowns_count(u);
  r = malloc((u->m + 1) * sizeof *r);
  status = r ? lab_unknowns_residuals(u, NULL, r, error) : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    *misfit = fmax(1, sqrt(lab_dot(r, r, u->n_data) / fmax((double)u->n_values, 1)));
  free(r);
  return status;
}

int lab_misfit_has_fallen(double before, double now)
{
  static const double less = 0.7; /* chosen by judgement */
  return now < less * before;
}

int lab_unknowns_weigh_held(lab_unknowns *u, lab_error *error)
{
  return measure_misfit(u, &u->misfit, error);
}

int lab_unknowns_weigh_own(lab_unknowns *u, lab_error *error)
{
  int j, any = 0;
  for (j = 0; j < u->n; j++)
    any |= lab_unknown_differs(&u->unknown[j]);
  return any ? measure_misfit(u, &u->own_misfit, error) : LAB_OK;
}

int lab_unknowns_errors(const lab_unknowns *u, double *r, lab_error *error)
{
  double now[LAB_FIT_MAX];
  int e;
  lab_unknowns_values(u, now);
  for (e = 0; e < u->n_runs; r += u->run[e].n * (size_t)u->run[e].n_channels, e++)
    if (errors_of(u, &u->rig, now, e, r, error))
      return error->status;
  return LAB_OK;
}

void lab_unknowns_slope_of_prior(const lab_unknowns *u, int j, double *column)
{
  const lab_unknown *x = &u->unknown[j];
  column[lab_unknowns_before_priors(u) + (size_t)j] = x->spread > 0 ? -1 / lab_unknown_reach(u, x) : 0;
}
