#include "experiment.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/noise.h"
#include "response.h"
#include "start.h"

static const int most_steps = 20000; /* from one change of input to the next: a model that takes more chatters */
static const double off = 6;         /* times the scatter at rest: a value so far off is no noise */

static int is_predicted(int channel)
{
  return channel == LAB_CHANNEL_P || channel == LAB_CHANNEL_X || channel == LAB_CHANNEL_T ||
         channel == LAB_CHANNEL_FORCE;
}

/* Rows before the command first changes. */
static size_t rows_at_rest(const lab_experiment *e)
{
  const double *u = e->log->value[LAB_CHANNEL_U];
  size_t n = 1;
  while (n < e->n && (!u || u[e->first + n] == u[e->first]))
    n++;
  return u ? n : 0;
}

/* Of these, those before the channel moves all the same: a sensor may be ahead of the command. Moving is what is far
 * beyond the scatter of the first half.
 * In:      n  rows before the command first changes */
static size_t rows_still(const double *value, size_t n)
{
  double sum = 0, sum2 = 0, count = 0, mean, scatter;
  size_t i;
  for (i = 0; i < n / 2; i++)
    if (!isnan(value[i])) {
      const double v = value[i] - value[0];
      sum += v;
      sum2 += v * v;
      count++;
    }
  if (!(count > 1))
    return 0;
  mean = sum / count;
  scatter = sqrt(fmax(sum2 / count - mean * mean, 0));
  for (i = 0; i < n && !(fabs(value[i] - value[0] - mean) > off * scatter); i++)
    ;
  return i;
}

/* Second differences of noise with memory r have the variance of white noise times 1 - 4 r/3 + r^2/3, and so has what
 * was estimated from them. */
static double for_memory(double sigma, double r)
{
  return sigma / sqrt(1 - 4 * r / 3 + r * r / 3);
}

static int add_channel(lab_experiment *e, int channel, lab_error *error)
{
  const double *value = e->log->value[channel] + e->first;
  const double memory = lab_noise_memory(value, rows_still(value, rows_at_rest(e)));
  double sigma = e->rig->noise[channel];
  if (isnan(sigma)) {
    if (lab_noise_estimate(value, e->n, &sigma, error))
      return error->status;
    sigma = for_memory(sigma, memory);
  }
  if (!(sigma > 0))
    return lab_fail(error, LAB_DATA,
                    "%s: channel %s does not change, or has too few values to tell its noise; declare it in the group "
                    "noise of the rig file",
                    e->log->path, lab_channels[channel].key);
  e->channel[e->n_channels] = channel;
  e->memory[e->n_channels] = memory;
  e->sigma[e->n_channels++] = sigma;
  return LAB_OK;
}

static int add_channels(lab_experiment *e, lab_error *error)
{
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (is_predicted(c) && e->log->value[c] && !e->rig->input[c] &&
        (c != LAB_CHANNEL_FORCE || e->rig->laws.position_input) && add_channel(e, c, error))
      return error->status;
  if (e->n_channels == 0)
    return lab_fail(error, LAB_DATA, "%s: expected a measured channel that is no input: p, x or T", e->log->path);
  return LAB_OK;
}

/* Whether the command is all that changes. */
static int only_command_changes(const lab_schedule *s)
{
  size_t i;
  for (i = 1; i < s->n; i++)
    if (s->input[i].supply_pressure != s->input[0].supply_pressure || s->input[i].force != s->input[0].force ||
        s->input[i].pressure_rate != 0 || s->input[i].position_rate != 0)
      return 0;
  return 1;
}

static size_t row_at(const double *t, size_t n, double at)
{
  size_t i = 0;
  while (i + 1 < n && t[i] < at)
    i++;
  return i;
}

static int bracket_switches(lab_experiment *e, lab_error *error)
{
  const double *t = e->log->value[LAB_CHANNEL_TIME] + e->first;
  size_t k;
  if (e->drive.schedule.n < 2 || !only_command_changes(&e->drive.schedule))
    return LAB_OK;
  e->n_switches = e->drive.schedule.n - 1;
  e->bracket = calloc(e->n_switches, sizeof *e->bracket);
  if (!e->bracket)
    return lab_fail_memory(error, "an experiment");
  for (k = 0; k < e->n_switches; k++) {
    const size_t row = row_at(t, e->n, e->drive.t[k + 1]);
    e->bracket[k] = row > 0 ? t[row] - t[row - 1] : 0;
  }
  return LAB_OK;
}

int lab_experiment_open(const lab_rig *rig, const lab_log *log, size_t run, lab_experiment *e, lab_error *error)
{
  pneu_model model;
  memset(e, 0, sizeof *e);
  e->rig = rig;
  e->log = log;
  e->run = run;
  e->first = log->run[run];
  e->n = log->run[run + 1] - e->first;
  if (lab_rig_model(rig, &model, error) || lab_drive_from_log(&model, rig, log, run, &e->drive, error) ||
      add_channels(e, error))
    return error->status;
  return bracket_switches(e, error);
}

void lab_experiment_close(lab_experiment *e)
{
  lab_drive_free(&e->drive);
  free(e->bracket);
  memset(e, 0, sizeof *e);
}

double lab_experiment_measured(const lab_experiment *e, int c, size_t i)
{
  return e->log->value[e->channel[c]][e->first + i];
}

static const double *column_of(const lab_trace *trace, int channel)
{
  return channel == LAB_CHANNEL_P   ? trace->p
         : channel == LAB_CHANNEL_X ? trace->x
         : channel == LAB_CHANNEL_T ? trace->T
                                    : trace->force;
}

/* The schedule with its changes at other instants, and the supply of the rig where it is not measured. */
static int shift(const lab_experiment *e, const lab_rig *rig, const double *early, lab_schedule *schedule,
                 lab_error *error)
{
  const size_t n = e->drive.schedule.n;
  double *t = malloc(n * sizeof *t);
  pneu_input *input = malloc(n * sizeof *input);
  size_t k;
  *schedule = e->drive.schedule;
  if (!t || !input) {
    free(t);
    free(input);
    return lab_fail_memory(error, "a schedule");
  }
  memcpy(t, e->drive.t, n * sizeof *t);
  memcpy(input, e->drive.input, n * sizeof *input);
  for (k = 0; early && k < e->n_switches; k++)
    t[k + 1] -= early[k];
  for (k = 0; k < n && !(rig->input[LAB_CHANNEL_PS] && e->log->value[LAB_CHANNEL_PS]); k++)
    input[k].supply_pressure = rig->params.supply_pressure;
  schedule->t = t;
  schedule->input = input;
  return LAB_OK;
}

int lab_experiment_predict(const lab_experiment *e, const lab_rig *rig, const double *early, double tol, double *y,
                           lab_error *error)
{
  const double *t = e->log->value[LAB_CHANNEL_TIME] + e->first;
  const lab_response_options options = {LAB_STEPPER, tol, t[e->n - 1], 0, 1, most_steps};
  lab_schedule schedule;
  lab_trace trace;
  pneu_model model;
  pneu_state start;
  int c, status;
  if (shift(e, rig, early, &schedule, error))
    return error->status;
  status = lab_rig_model(rig, &model, error);
  if (status == LAB_OK)
    status = lab_start_from_log(&model, schedule.input, e->log, e->run, &start, error);
  if (status == LAB_DATA)
    status = error->status = LAB_NUMERIC;
  if (status == LAB_OK)
    status = lab_respond(&model, &start, &schedule, t, e->n, &options, &trace, NULL, error);
  free((double *)schedule.t);
  free((pneu_input *)schedule.input);
  if (status != LAB_OK)
    return status;
  for (c = 0; c < e->n_channels; c++)
    memcpy(y + (size_t)c * e->n, column_of(&trace, e->channel[c]), e->n * sizeof *y);
  lab_trace_free(&trace);
  return LAB_OK;
}
