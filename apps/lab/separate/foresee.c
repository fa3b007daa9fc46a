#include "foresee.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "trial.h"

const int lab_foreseen[LAB_FORESEEN] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_T, LAB_CHANNEL_PS};

static const double tolerance = 1e-6; /* of the stepper: with the step below, slopes to a few thousandths */
static const double small = 5e-3;     /* step of the differences, of the scale */

int lab_outlook_open(const lab_rig *rig, const lab_schedule *schedule, double settle, double duration, double spacing,
                     lab_outlook *outlook, lab_error *error)
{
  enum { ROWS = 1500 };
  const double step = fmax(spacing, duration / ROWS);
  pneu_model model;
  int i;
  memset(outlook, 0, sizeof *outlook);
  if (lab_rig_model(rig, &model, error) || lab_trial_start(&model, &schedule->input[0], settle, &outlook->start, error))
    return error->status;
  outlook->rig = rig;
  outlook->schedule = schedule;
  outlook->n = (int)(duration / step * (1 + 1e-12)) + 1;
  outlook->t = malloc((size_t)outlook->n * sizeof *outlook->t);
  if (!outlook->t)
    return lab_fail_memory(error, "a schedule");
  for (i = 0; i < outlook->n; i++)
    outlook->t[i] = schedule->t[0] + fmin(i * step, duration);
  return LAB_OK;
}

void lab_outlook_close(lab_outlook *outlook)
{
  free(outlook->t);
  memset(outlook, 0, sizeof *outlook);
}

int lab_foresee(const lab_outlook *outlook, const pneu_params *params, double *y, long *steps, lab_error *error)
{
  const size_t n = (size_t)outlook->n;
  const lab_response_options options = {LAB_STEPPER, tolerance, outlook->t[n - 1], 0, 0, 0};
  lab_rig rig = *outlook->rig;
  lab_trace trace;
  pneu_model model;
  pneu_state start;
  pneu_stats stats;
  rig.params = *params;
  if (lab_rig_model(&rig, &model, error))
    return error->status = LAB_NUMERIC;
  if (pneu_state_rest(&model, outlook->start.p, model.p.ambient_temperature, outlook->start.x,
                      &outlook->schedule->input[0], &start) != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "no state at rest to start from");
  if (lab_respond(&model, &start, outlook->schedule, outlook->t, n, &options, &trace, &stats, error))
    return error->status;
  if (steps)
    *steps = stats.steps;
  memcpy(y, trace.p, n * sizeof *y);
  memcpy(y + n, trace.x, n * sizeof *y);
  memcpy(y + 2 * n, trace.T, n * sizeof *y);
  memcpy(y + 3 * n, trace.ps, n * sizeof *y);
  lab_trace_free(&trace);
  return LAB_OK;
}

static double value_of(const pneu_params *params, int param)
{
  pneu_params copy = *params;
  return (double)(param == LAB_FIT_ORIFICE_AREA ? copy.fill_area : *pneu_param_at(&copy, param));
}

double lab_foresee_scale(const pneu_params *params, int param)
{
  const double value = fabs(value_of(params, param));
  pneu_param_info info;
  if (param == LAB_FIT_ORIFICE_AREA)
    return value;
  pneu_param_describe(param, &info);
  if (param >= PNEU_PARAM_BASE_COUNT && !info.shape)
    return fabs((double)(info.value - info.neutral));
  return value != 0 ? value : info.value != 0 ? fabs((double)info.value) : 1;
}

double lab_foresee_change(const pneu_params *from, const pneu_params *to, int param, double scale)
{
  return (value_of(to, param) - value_of(from, param)) / scale;
}

void lab_foresee_shift(pneu_params *params, int param, double change, double scale)
{
  const double value = value_of(params, param) + change * scale, narrowest = 0.1;
  pneu_param_info info;
  if (param == LAB_FIT_ORIFICE_AREA) {
    const double factor = fmax(value / (double)params->fill_area, narrowest);
    params->fill_area *= (pneu_real)factor;
    params->vent_area *= (pneu_real)factor;
    return;
  }
  pneu_param_describe(param, &info);
  *pneu_param_at(params, param) = (pneu_real)fmin(fmax(value, (double)info.lower), (double)info.upper);
}

/* A model one step away, on the side where there is room.  Returns: the step */
static double step_aside(pneu_params *params, int param, double scale)
{
  const pneu_params before = *params;
  lab_foresee_shift(params, param, small, scale);
  if (lab_foresee_change(&before, params, param, scale) < small / 2) {
    *params = before;
    lab_foresee_shift(params, param, -small, scale);
  }
  return lab_foresee_change(&before, params, param, scale);
}

int lab_foresee_slopes(const lab_outlook *outlook, const pneu_params *params, int count, const int *param,
                       const double *scale, const double *y, double *slope, lab_error *error)
{
  const int m = LAB_FORESEEN * outlook->n;
  int k, i;
  for (k = 0; k < count; k++) {
    double *column = slope + (size_t)k * (size_t)m;
    pneu_params at = *params;
    const double step = step_aside(&at, param[k], scale[k]);
    if (lab_foresee(outlook, &at, column, NULL, error))
      return error->status;
    for (i = 0; i < m; i++)
      column[i] = (column[i] - y[i]) / step;
  }
  return LAB_OK;
}
