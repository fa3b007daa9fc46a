#include "forecast.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "testplan.h"

const int lab_forecast_channels[LAB_FORECAST_CHANNELS] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_T, LAB_CHANNEL_PS};

static const double tolerance = 1e-6; /* of the stepper: with the step below, slopes to a few thousandths */
static const double narrowest = 0.1;  /* of its area: an orifice */
const double lab_forecast_step = 5e-3;

int lab_forecast_open(const lab_rig *rig, const lab_schedule *schedule, double settle, double duration, double spacing,
                      lab_forecast *forecast, lab_error *error)
{
  enum { ROWS = 1500 };
  const double step = fmax(spacing, duration / ROWS);
  pneu_model model;
  int i;
  memset(forecast, 0, sizeof *forecast);
  if (lab_rig_model(rig, &model, error) ||
      lab_test_plan_start(&model, &schedule->input[0], settle, &forecast->start, error))
    return error->status;
  forecast->rig = rig;
  forecast->schedule = schedule;
  forecast->n = (int)(duration / step * (1 + 1e-12)) + 1;
  forecast->t = malloc((size_t)forecast->n * sizeof *forecast->t);
  if (!forecast->t)
    return lab_fail_memory(error, "a schedule");
  for (i = 0; i < forecast->n; i++)
    forecast->t[i] = schedule->t[0] + fmin(i * step, duration);
  return LAB_OK;
}

void lab_forecast_close(lab_forecast *forecast)
{
  free(forecast->t);
  memset(forecast, 0, sizeof *forecast);
}

int lab_forecast_run(const lab_forecast *forecast, const pneu_params *params, double *y, long *steps, lab_error *error)
{
  const size_t n = (size_t)forecast->n;
  lab_rig rig = *forecast->rig;
  lab_response response;
  pneu_model model;
  pneu_state start;
  pneu_stats stats;
  const lab_simulation task = {.start = &start,
                               .schedule = forecast->schedule,
                               .t = forecast->t,
                               .n = n,
                               .options = {.tol = tolerance},
                               .stats = &stats};
  rig.params = *params;
  if (lab_rig_model(&rig, &model, error))
    return error->status = LAB_NUMERIC;
  if (pneu_state_rest(&model, forecast->start.p, model.p.ambient_temperature, forecast->start.x,
                      &forecast->schedule->input[0], &start) != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "no state at rest to start from");
  if (lab_response_run(&model, &task, &response, error))
    return error->status;
  if (steps)
    *steps = stats.steps;
  memcpy(y, response.p, n * sizeof *y);
  memcpy(y + n, response.x, n * sizeof *y);
  memcpy(y + 2 * n, response.T, n * sizeof *y);
  memcpy(y + 3 * n, response.ps, n * sizeof *y);
  lab_response_free(&response);
  return LAB_OK;
}

static double value_of(const pneu_params *params, int param)
{
  pneu_params copy = *params;
  return (double)(param == LAB_PARAM_ORIFICE_AREA ? copy.fill_area : *pneu_param_at(&copy, param));
}

double lab_forecast_scale(const pneu_params *params, int param)
{
  const double value = fabs(value_of(params, param));
  const pneu_param_info info = lab_param_info(param);
  if (param == LAB_PARAM_ORIFICE_AREA)
    return value;
  if (param >= PNEU_PARAM_BASE_COUNT && !info.shape)
    return fabs((double)(info.value - info.neutral));
  return value != 0 ? value : info.value != 0 ? fabs((double)info.value) : 1;
}

/* How far a parameter is from one model to another, over scale. */
static double change_of(const pneu_params *from, const pneu_params *to, int param, double scale)
{
  return (value_of(to, param) - value_of(from, param)) / scale;
}

void lab_forecast_bounds(const pneu_params *params, int param, double scale, double *lower, double *upper)
{
  const double value = value_of(params, param);
  const pneu_param_info info = lab_param_info(param);
  if (param == LAB_PARAM_ORIFICE_AREA) {
    *lower = (narrowest - 1) * value / scale;
    *upper = (double)INFINITY;
    return;
  }
  *lower = ((double)info.lower - value) / scale;
  *upper = ((double)info.upper - value) / scale;
}

void lab_forecast_shift(pneu_params *params, int param, double change, double scale)
{
  const double value = value_of(params, param) + change * scale;
  const pneu_param_info info = lab_param_info(param);
  if (param == LAB_PARAM_ORIFICE_AREA) {
    const double factor = fmax(value / (double)params->fill_area, narrowest);
    params->fill_area *= (pneu_real)factor;
    params->vent_area *= (pneu_real)factor;
    return;
  }
  *pneu_param_at(params, param) = (pneu_real)fmin(fmax(value, (double)info.lower), (double)info.upper);
}

/* A model one step away, on the side where there is room.  Returns: the step */
static double step_aside(pneu_params *params, int param, double scale)
{
  const pneu_params before = *params;
  lab_forecast_shift(params, param, lab_forecast_step, scale);
  if (change_of(&before, params, param, scale) < lab_forecast_step / 2) {
    *params = before;
    lab_forecast_shift(params, param, -lab_forecast_step, scale);
  }
  return change_of(&before, params, param, scale);
}

int lab_forecast_slopes(const lab_forecast *forecast, const lab_forecast_model *model, const double *y, double *slope,
                        lab_error *error)
{
  const int m = LAB_FORECAST_CHANNELS * forecast->n;
  int k, i;
  for (k = 0; k < model->n; k++) {
    double *column = slope + (size_t)k * (size_t)m;
    pneu_params at = model->params;
    const double step = step_aside(&at, model->param[k], model->scale[k]);
    if (lab_forecast_run(forecast, &at, column, NULL, error))
      return error->status;
    for (i = 0; i < m; i++)
      column[i] = (column[i] - y[i]) / step;
  }
  return LAB_OK;
}
