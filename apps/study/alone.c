#include "alone.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/check/logs.h"
#include "../lab/fit/errors.h"

static void take(const lab_unknowns *u, const lab_fit_result *spread, alone_fit *fit)
{
  int j;
  for (j = 0; j < u->n; j++) {
    alone_value *value = fit->n < ALONE_VALUES_MAX ? &fit->value[fit->n] : NULL;
    if (u->unknown[j].kind != LAB_UNKNOWN_PARAM)
      continue;
    fit->n++;
    if (!value)
      continue;
    snprintf(value->name, sizeof value->name, "%s", u->unknown[j].name);
    value->value = u->unknown[j].value;
    value->half = spread->state[j] == LAB_STATE_UNDETERMINED ? HUGE_VAL : 1.96 * spread->deviation[j];
  }
}

/* Begin with what the log has for itself, fitted while all else is as the model has it. */
static int begin(const lab_rig *rig, const lab_logs *logs, lab_unknowns *u, lab_error *error)
{
  lab_unknowns *own = malloc(sizeof *own);
  int j, k,
      status = own ? lab_unknowns_own(rig, logs->run, logs->n, own, error) : lab_fail_memory(error, "a fit to one log");
  if (status == LAB_OK && own->n > 0)
    status = lab_unknowns_fit(own, LAB_ROUNDS_ALL, NULL, error);
  if (status == LAB_OK)
    status = lab_unknowns_open(rig, logs->run, logs->n, u, error);
  for (j = 0; status == LAB_OK && j < own->n; j++)
    for (k = 0; k < u->n; k++)
      if (!strcmp(u->unknown[k].name, own->unknown[j].name))
        u->unknown[k].value = own->unknown[j].value;
  free(own);
  return status;
}

static int fit_runs(const lab_rig *rig, const lab_logs *logs, int channel, alone_fit *fit, lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  lab_fit_result *spread = malloc(sizeof *spread);
  lab_errors errors;
  int status = u && spread ? begin(rig, logs, u, error) : lab_fail_memory(error, "a fit to one log");
  *fit = (alone_fit){.left = (double)NAN};
  if (status == LAB_OK)
    status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, NULL, error);
  if (status == LAB_OK)
    status = lab_unknowns_intervals(u, spread, error);
  if (status == LAB_OK)
    status = lab_loop_errors(u, &errors, error);
  if (status == LAB_OK) {
    fit->left = errors.rmse[channel];
    take(u, spread, fit);
  }
  free(spread);
  free(u);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

int alone_fit_log(const lab_rig *rig, const char *log, int channel, alone_fit *fit, lab_error *error)
{
  lab_logs *logs = calloc(1, sizeof *logs);
  int status = logs ? lab_logs_add(logs, rig, log, error) : lab_fail_memory(error, "a log");
  if (status == LAB_OK)
    status = fit_runs(rig, logs, channel, fit, error);
  if (logs)
    lab_logs_close(logs);
  free(logs);
  return status;
}

int alone_fit_sensor(const lab_rig *rig, const char *log, const char *name, int channel, alone_fit *fit,
                     lab_error *error)
{
  static const double unseen = 1e12; /* noise, SI */
  lab_rig *one = malloc(sizeof *one);
  const int param = pneu_param_find(name);
  int c, status;
  if (!one)
    return lab_fail_memory(error, "a rig");
  *one = *rig;
  one->n_fit = 0;
  status = param < 0 ? lab_fail(error, LAB_DATA, "no parameter is called %s", name)
                     : alone_fit_log(one, log, channel, fit, error);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    one->noise[c] = c == channel ? fit->left : unseen; /* what is left without it is how well the channel is known */
  one->n_fit = 1;
  one->fit[0] = param;
  one->fit_per_log[0] = 0;
  if (status == LAB_OK)
    status = alone_fit_log(one, log, channel, fit, error);
  free(one);
  return status;
}
