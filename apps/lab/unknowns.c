#include "unknowns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double uniform_spread = 0.28867513459481287; /* standard deviation of a uniform distribution of width 1 */

static lab_unknown *append(lab_unknowns *u)
{
  lab_unknown *x = u->n < LAB_FIT_MAX ? &u->unknown[u->n++] : NULL;
  if (x)
    memset(x, 0, sizeof *x);
  return x;
}

static void describe_param(lab_unknown *x, int param)
{
  pneu_param_info info;
  x->kind = LAB_UNKNOWN_PARAM;
  x->index = param;
  lab_fit_name(param, x->name);
  if (param == LAB_FIT_ORIFICE_AREA) {
    snprintf(x->unit, sizeof x->unit, "1");
    x->lower = 1e-3;
    x->upper = 1e3;
    x->scale = 1;
    return;
  }
  pneu_param_describe(param, &info);
  snprintf(x->unit, sizeof x->unit, "%s", info.unit);
  x->lower = (double)info.lower;
  x->upper = (double)info.upper;
  x->scale = fabs((double)info.value - (param < PNEU_PARAM_BASE_COUNT ? 0 : (double)info.neutral));
}

int lab_unknowns_add(lab_unknowns *u, int param, double value, lab_error *error)
{
  lab_unknown *x = append(u);
  if (!x)
    return lab_fail(error, LAB_DATA, "more than %d things to fit at once", (int)LAB_FIT_MAX);
  describe_param(x, param);
  x->value = x->first = fmin(fmax(value, x->lower), x->upper);
  if (param < PNEU_PARAM_BASE_COUNT && x->value != 0)
    x->scale = fabs(x->value);
  if (param != LAB_FIT_ORIFICE_AREA)
    *pneu_param_at(&u->params, param) = (pneu_real)x->value;
  return LAB_OK;
}

void lab_unknowns_drop(lab_unknowns *u, int param)
{
  pneu_param_info info;
  int j, k;
  for (j = k = 0; j < u->n; j++)
    if (u->unknown[j].kind != LAB_UNKNOWN_PARAM || u->unknown[j].index != param)
      u->unknown[k++] = u->unknown[j];
  u->n = k;
  pneu_param_describe(param, &info);
  *pneu_param_at(&u->params, param) = info.shape ? info.value : info.neutral;
}

/* A change of command happened between the row before and the row that shows it: half the bracket, give or take what a
 * uniform distribution has. */
static void add_switches(lab_unknowns *u)
{
  int e, index = 0;
  for (e = 0; e < u->n_experiments; e++) {
    size_t k;
    for (k = 0; k < u->experiment[e].n_switches; k++, index++) {
      const double bracket = u->experiment[e].bracket[k];
      lab_unknown *x = bracket > 0 ? append(u) : NULL;
      if (!x)
        continue;
      x->kind = LAB_UNKNOWN_SWITCH;
      x->index = index;
      snprintf(x->name, sizeof x->name, "switch_%d", index + 1);
      snprintf(x->unit, sizeof x->unit, "s");
      x->value = x->first = x->prior = bracket / 2;
      x->upper = bracket;
      x->scale = bracket;
      x->spread = uniform_spread * bracket;
    }
  }
}

int lab_unknowns_open(const lab_rig *rig, const lab_experiment *experiment, int n_experiments, lab_unknowns *u,
                      lab_error *error)
{
  int j, e;
  memset(u, 0, sizeof *u);
  u->experiment = experiment;
  u->n_experiments = n_experiments;
  u->params = u->declared = rig->params;
  u->tol = 1e-7;
  for (e = 0; e < n_experiments; e++)
    u->n_data += experiment[e].n * (size_t)experiment[e].n_channels;
  for (j = 0; j < rig->n_fit; j++) {
    const int param = rig->fit[j];
    const double value =
        param == LAB_FIT_ORIFICE_AREA ? 1.0 : (double)*pneu_param_at((pneu_params *)&rig->params, param);
    if (lab_unknowns_add(u, param, value, error))
      return error->status;
  }
  add_switches(u);
  u->m = u->n_data + (size_t)u->n;
  return LAB_OK;
}

void lab_unknowns_params(const lab_unknowns *u, const double *theta, pneu_params *params)
{
  int j;
  *params = u->params;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    if (x->kind != LAB_UNKNOWN_PARAM)
      continue;
    if (x->index == LAB_FIT_ORIFICE_AREA) {
      params->fill_area = u->declared.fill_area * (pneu_real)theta[j];
      params->vent_area = u->declared.vent_area * (pneu_real)theta[j];
    } else {
      *pneu_param_at(params, x->index) = (pneu_real)theta[j];
    }
  }
}

/* How early each change of command of an experiment was, in its order. */
static void early_of(const lab_unknowns *u, const double *theta, int first, const lab_experiment *e, double *early)
{
  int j;
  memset(early, 0, e->n_switches * sizeof *early);
  for (j = 0; j < u->n; j++) {
    const int k = u->unknown[j].index - first;
    if (u->unknown[j].kind == LAB_UNKNOWN_SWITCH && k >= 0 && k < (int)e->n_switches)
      early[k] = theta[j];
  }
}

/* Turn predictions into residuals, in place. */
static void weigh(const lab_experiment *e, double *r)
{
  int c;
  size_t i;
  for (c = 0; c < e->n_channels; c++)
    for (i = 0; i < e->n; i++) {
      double *at = &r[(size_t)c * e->n + i];
      const double measured = lab_experiment_measured(e, c, i);
      *at = isnan(measured) ? 0 : (measured - *at) / e->sigma[c];
    }
}

static int residuals_at(const lab_unknowns *u, const pneu_params *params, const double *theta, double *r,
                        lab_error *error)
{
  int e, j, first = 0;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    double *early = calloc(x->n_switches + 1, sizeof *early);
    int status;
    if (!early)
      return lab_fail_memory(error, "a schedule");
    early_of(u, theta, first, x, early);
    status = lab_experiment_predict(x, params, early, u->tol, r, error);
    free(early);
    if (status != LAB_OK)
      return status;
    weigh(x, r);
    r += x->n * (size_t)x->n_channels;
    first += (int)x->n_switches;
  }
  for (j = 0; j < u->n; j++)
    r[j] = u->unknown[j].spread > 0 ? (u->unknown[j].prior - theta[j]) / u->unknown[j].spread : 0;
  return LAB_OK;
}

static void present(const lab_unknowns *u, double *theta)
{
  int j;
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
}

int lab_unknowns_residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const lab_unknowns *u = context;
  double now[LAB_FIT_MAX];
  pneu_params params;
  if (!theta) {
    present(u, now);
    theta = now;
  }
  lab_unknowns_params(u, theta, &params);
  return residuals_at(u, &params, theta, r, error);
}

int lab_unknowns_residuals_with(const lab_unknowns *u, const pneu_params *params, double *r, lab_error *error)
{
  double now[LAB_FIT_MAX];
  present(u, now);
  return residuals_at(u, params, now, r, error);
}

/* One column: a difference into the side where there is room, with a step that is small beside what matters. */
static int slope_column(lab_unknowns *u, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const lab_unknown *x = &u->unknown[j];
  double at[LAB_FIT_MAX], step = 1e-3 * (x->scale > 0 ? x->scale : 1);
  size_t i;
  memcpy(at, theta, (size_t)u->n * sizeof *at);
  if (theta[j] + step > x->upper)
    step = -step;
  at[j] = theta[j] + step;
  if (lab_unknowns_residuals(u, at, column, error))
    return error->status;
  for (i = 0; i < u->m; i++)
    column[i] = (column[i] - r[i]) / (at[j] - theta[j]);
  return LAB_OK;
}

int lab_unknowns_slopes(void *context, const double *theta, const double *r, double *slope, lab_error *error)
{
  lab_unknowns *u = context;
  int j, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (j = 0; j < u->n; j++) {
    lab_error mine;
    const int at = slope_column(u, theta, r, j, slope + (size_t)j * u->m, &mine);
    if (at != LAB_OK) {
#pragma omp critical(slope_error)
      *error = mine, status = at;
    }
  }
  return status;
}

int lab_unknowns_fit(lab_unknowns *u, lab_fit_result *result, lab_error *error)
{
  lab_fit_param param[LAB_FIT_MAX];
  lab_fit_problem problem = {u->n, param, 0, lab_unknowns_residuals, lab_unknowns_slopes, u, NULL, 1};
  lab_fit_options options;
  lab_fit_result own;
  int j;
  if (!result)
    result = &own;
  u->m = u->n_data + (size_t)u->n;
  problem.m = u->m;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    param[j] = (lab_fit_param){x->name, x->unit, x->value, x->lower, x->upper, 0, x->scale};
  }
  lab_fit_options_default(&options);
  options.search = LAB_FIT_POLISH_ONLY;
  options.chi2_exact = 1e-6; /* 0.01 of chi-square for ten thousand values: far below what decides anything */
  if (lab_fit_run(&problem, &options, result, error))
    return error->status;
  for (j = 0; j < u->n; j++)
    u->unknown[j].value = result->theta[j];
  lab_unknowns_params(u, result->theta, &u->params);
  return LAB_OK;
}
