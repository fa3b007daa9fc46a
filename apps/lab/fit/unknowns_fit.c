/* Slopes, fits and intervals of the unknowns. */
#include <string.h>

#include "descent.h"
#include "unknowns.h"

static const double slope_step = 1e-3;  /* of a slope's difference, over what matters */
static const double coarse_step = 0.05; /* the same where slips come and go on shorter ones */

/* A difference into the side where there is room, with a step that is small beside what matters. */
int lab_unknowns_slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const lab_unknowns *u = context;
  const lab_unknown *x = &u->unknown[j];
  double at[LAB_FIT_MAX], step = (u->window ? coarse_step : slope_step) * (x->scale > 0 ? x->scale : 1);
  size_t i;
  memcpy(at, theta, (size_t)u->n * sizeof *at);
  if (theta[j] + step > x->upper)
    step = -step;
  at[j] = theta[j] + step;
  if (lab_unknowns_residuals(context, at, column, error))
    return error->status;
  for (i = 0; i < u->m; i++)
    column[i] = (column[i] - r[i]) / (at[j] - theta[j]);
  return LAB_OK;
}

int lab_unknowns_fit(lab_unknowns *u, int steps, double *chi2, lab_error *error)
{
  double theta[LAB_FIT_MAX], lower[LAB_FIT_MAX], upper[LAB_FIT_MAX], own;
  unsigned char lasting[LAB_FIT_MAX];
  lab_descent problem = {u->n, 0, steps, lower, upper, lasting, u, lab_unknowns_residuals, lab_unknowns_slope};
  int j;
  u->m = problem.m = u->n_data + (size_t)u->n;
  for (j = 0; j < u->n; j++) {
    lower[j] = u->unknown[j].lower;
    upper[j] = u->unknown[j].upper;
    lasting[j] = u->unknown[j].kind == LAB_UNKNOWN_SWITCH;
    theta[j] = u->unknown[j].value;
  }
  if (lab_descend(&problem, theta, chi2 ? chi2 : &own, error))
    return error->status;
  for (j = 0; j < u->n; j++)
    u->unknown[j].value = theta[j];
  lab_unknowns_apply(u, theta, LAB_ALL_EXPERIMENTS, &u->rig);
  return LAB_OK;
}

/* All columns of the slopes, in parallel; 0 where the model fails. Signature of fit.h. */
static int slopes(void *context, const double *theta, const double *r, double *slope, lab_error *error)
{
  lab_unknowns *u = context;
  int j, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (j = 0; j < u->n; j++) {
    lab_error mine;
    double *column = slope + (size_t)j * u->m;
    const int at = lab_unknowns_slope(u, theta, r, j, column, &mine);
    if (at == LAB_NUMERIC)
      memset(column, 0, u->m * sizeof *column);
    else if (at != LAB_OK) {
#pragma omp critical(slope_error)
      *error = mine, status = at;
    }
  }
  return status;
}

int lab_unknowns_spread(lab_unknowns *u, lab_fit_result *result, lab_error *error)
{
  lab_fit_param param[LAB_FIT_MAX];
  lab_fit_problem problem = {u->n, param, 0, lab_unknowns_residuals, slopes, u, NULL, 1};
  lab_fit_options options;
  int j;
  memset(result, 0, sizeof *result);
  if (u->n == 0)
    return LAB_OK;
  u->m = problem.m = u->n_data + (size_t)u->n;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    param[j] = (lab_fit_param){x->name, x->unit, x->value, x->lower, x->upper, 0, x->scale};
  }
  lab_fit_options_default(&options);
  options.search = LAB_FIT_NONE;
  return lab_fit_run(&problem, &options, result, error);
}
