/* Fit a model to what another one predicts. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../fit/fit.h"
#include "discriminate_private.h"

static const double near_enough = 1e-3; /* [sigma^2] of chi-square, and as a share of it */

typedef struct pursuit {
  const lab_advice_request *request;
  const lab_forecast *forecast;
  const lab_forecast_model *model;
  size_t m;                                             /* values of a prediction */
  double *goal;                                         /* what it is fitted to */
  double known[LAB_NORMAL_MAX + 1][LAB_NORMAL_MAX + 1]; /* rows of the other records */
} pursuit;

/* The prediction beside its goal, over the noise, and what the other records say once the model has changed by theta,
 * which is in the units of its parameters. */
static int residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const pursuit *p = context;
  const int k = p->model->n, n = p->forecast->n;
  pneu_params params = p->model->params;
  int c, i, j;
  for (j = 0; j < k; j++)
    lab_forecast_shift(&params, p->model->param[j], theta[j], p->model->scale[j]);
  if (lab_forecast_run(p->forecast, &params, r, NULL, error))
    return error->status;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++) {
    const double root = sqrt(lab_design_weight(p->request, p->forecast, c));
    for (i = c * n; i < (c + 1) * n; i++)
      r[i] = root > 0 ? root * (p->goal[i] - r[i]) : 0;
  }
  for (i = 0; i <= k; i++) {
    double *row = &r[p->m + (size_t)i];
    *row = p->known[i][k];
    for (j = 0; j < k; j++)
      *row -= p->known[i][j] * theta[j];
  }
  return LAB_OK;
}

/* A model without a slope cannot be pursued with: its parameter would stand still. */
static int slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const pursuit *p = context;
  const size_t m = p->m + (size_t)p->model->n + 1;
  double at[LAB_NORMAL_MAX], least, most;
  size_t i;
  memcpy(at, theta, (size_t)p->model->n * sizeof *at);
  lab_forecast_bounds(&p->model->params, p->model->param[j], p->model->scale[j], &least, &most);
  at[j] += at[j] + lab_forecast_step > most ? -lab_forecast_step : lab_forecast_step;
  if (residuals(context, at, column, error))
    return error->status == LAB_NUMERIC ? (error->status = LAB_DATA) : error->status;
  for (i = 0; i < m; i++)
    column[i] = (column[i] - r[i]) / (at[j] - theta[j]);
  return LAB_OK;
}

static int run(pursuit *p, double *apart, lab_error *error)
{
  double theta[LAB_NORMAL_MAX] = {0}, lower[LAB_NORMAL_MAX], upper[LAB_NORMAL_MAX];
  const lab_fit_problem problem = {.n = p->model->n,
                                   .m = p->m + (size_t)p->model->n + 1,
                                   .lower = lower,
                                   .upper = upper,
                                   .context = p,
                                   .residuals = residuals,
                                   .slope = slope,
                                   .enough = near_enough,
                                   .enough_share = near_enough};
  double chi2;
  int j;
  for (j = 0; j < p->model->n; j++)
    lab_forecast_bounds(&p->model->params, p->model->param[j], p->model->scale[j], &lower[j], &upper[j]);
  if (lab_fit(&problem, theta, &chi2, error))
    return error->status;
  *apart = sqrt(chi2);
  return LAB_OK;
}

int lab_discrepancy(const lab_advice_request *q, const lab_forecast *o, const pneu_params *goal,
                    const lab_forecast_model *model, const lab_normal *known, double *apart, lab_error *error)
{
  pursuit p = {.request = q, .forecast = o, .model = model, .m = LAB_FORECAST_CHANNELS * (size_t)o->n};
  int status;
  lab_normal_rows(known, p.known);
  if (!(p.goal = malloc(p.m * sizeof *p.goal)))
    return lab_fail_memory(error, "a response");
  if ((status = lab_forecast_run(o, goal, p.goal, NULL, error)) == LAB_OK)
    status = run(&p, apart, error);
  free(p.goal);
  return status;
}
