#include "alone.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../lab/check/logs.h"
#include "../lab/fit/errors.h"

/* Half of a 95 % interval, by the side that no bound cuts; 0 at a bound. */
static double half_of(const lab_fit_result *spread, int j, double value)
{
  return spread->state[j] == LAB_STATE_FREE           ? fmax(spread->high[j] - value, value - spread->low[j])
         : spread->state[j] == LAB_STATE_UNDETERMINED ? HUGE_VAL
                                                      : 0;
}

/* What is written of the values: those that the log tells to less than their size, or than a change that matters. */
static void take(const lab_unknowns *u, const lab_fit_result *spread, alone_fit *fit)
{
  int j;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    const double half = half_of(spread, j, x->value);
    alone_value *value = &fit->value[fit->n];
    if (x->kind != LAB_UNKNOWN_PARAM)
      continue;
    if (fit->n == ALONE_VALUES_MAX || !(half < fmax(fabs(x->value), x->scale))) {
      fit->undetermined++;
      continue;
    }
    fit->n++;
    snprintf(value->name, sizeof value->name, "%s", x->name);
    snprintf(value->unit, sizeof value->unit, "%s", x->unit);
    value->value = x->value;
    value->half = half;
  }
}

/* Begin with the values of other unknowns of the same log. */
static void begin_with(lab_unknowns *u, const lab_unknowns *own)
{
  int j, k;
  for (j = 0; j < own->n; j++)
    for (k = 0; k < u->n; k++)
      if (u->unknown[k].kind == own->unknown[j].kind && u->unknown[k].index == own->unknown[j].index &&
          u->unknown[k].run == own->unknown[j].run)
        u->unknown[k].value = own->unknown[j].value;
  lab_unknowns_take(u);
}

/* Fit what is on the fit list of a rig, and the instants of commands.  Out: errors  of the fit */
static int fit_list(const lab_rig *rig, const lab_logs *logs, const lab_unknowns *first, lab_unknowns *u,
                    lab_errors *errors, lab_error *error)
{
  if (lab_unknowns_open(rig, logs->run, logs->n, u, error))
    return error->status;
  if (first)
    begin_with(u, first);
  return lab_unknowns_fit(u, LAB_ROUNDS_ALL, NULL, error) ? error->status : lab_loop_errors(u, errors, error);
}

/* A rig whose common values are known: only what each log has for itself is fitted. */
static void keep_own(const lab_rig *rig, lab_rig *own)
{
  int i;
  *own = *rig;
  for (i = own->n_fit = 0; i < rig->n_fit; i++)
    if (rig->fit_per_log[i]) {
      own->fit_per_log[own->n_fit] = 1;
      own->fit[own->n_fit++] = rig->fit[i];
    }
}

typedef struct work {
  lab_rig own;
  lab_unknowns common, alone;
  lab_fit_result spread;
} work;

static int fit_runs(const lab_rig *rig, const lab_logs *logs, int channel, alone_fit *fit, lab_error *error)
{
  work *w = malloc(sizeof *w);
  lab_errors errors;
  int status;
  if (!w)
    return lab_fail_memory(error, "a fit to one log");
  keep_own(rig, &w->own);
  status = fit_list(&w->own, logs, NULL, &w->common, &errors, error);
  if (status == LAB_OK) {
    fit->common = errors.rmse[channel];
    fit->rows = errors.n;
    status = fit_list(rig, logs, &w->common, &w->alone, &errors, error);
  }
  if (status == LAB_OK) {
    fit->left = errors.rmse[channel];
    fit->in_noise = errors.in_noise[channel];
    status = lab_unknowns_intervals(&w->alone, &w->spread, error);
  }
  if (status == LAB_OK)
    take(&w->alone, &w->spread, fit);
  free(w);
  return status;
}

int alone_fit_log(const lab_rig *rig, const char *log, int channel, alone_fit *fit, lab_error *error)
{
  lab_logs *logs = calloc(1, sizeof *logs);
  int status = logs ? lab_logs_add(logs, rig, log, error) : lab_fail_memory(error, "a log");
  *fit = (alone_fit){.common = (double)NAN, .left = (double)NAN, .in_noise = (double)NAN};
  if (status == LAB_OK)
    status = fit_runs(rig, logs, channel, fit, error);
  if (logs)
    lab_logs_close(logs);
  free(logs);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

int alone_fit_sensor(const lab_rig *rig, const char *log, const char *name, int channel, alone_fit *fit,
                     lab_error *error)
{
  enum { PASSES = 3 };               /* without the sensor, with it, and with it for its interval */
  static const double unseen = 1e12; /* noise, SI */
  lab_rig *one = malloc(sizeof *one);
  const int param = pneu_param_find(name);
  int c, pass, status;
  if (!one)
    return lab_fail_memory(error, "a rig");
  *one = *rig;
  one->n_fit = 0;
  status = param < 0 ? lab_fail(error, LAB_DATA, "no parameter is called %s", name) : (int)LAB_OK;
  for (pass = 0; pass < PASSES && status == LAB_OK; pass++) {
    status = alone_fit_log(one, log, channel, fit, error);
    if (!(fit->left > 0))
      break;
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      one->noise[c] = c == channel ? fit->left : one->input[c] ? one->noise[c] : unseen;
    one->n_fit = 1;
    one->fit[0] = param;
    one->fit_per_log[0] = 0;
  }
  free(one);
  return status;
}
