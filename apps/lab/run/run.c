#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/noise.h"
#include "../rig/tolerance.h"
#include "response.h"
#include "start.h"

static const int most_steps = 20000; /* in ten seconds under one command: a model that takes more chatters */
static const double pi = 3.141592653589793;

static int is_predicted(int channel)
{
  return channel == LAB_CHANNEL_P || channel == LAB_CHANNEL_X || channel == LAB_CHANNEL_T ||
         channel == LAB_CHANNEL_FORCE;
}

/* Variance of the error that all values share which noise of deviation sigma is rounded to, as long as what is measured
 * stays where it is; over all places, over q squared (the harmonics of the rounding error; Widrow 1961). */
static double shared(double sigma, double q)
{
  double sum = 0;
  int k;
  for (k = 1; k <= 20; k++)
    sum += exp(-pow(2 * pi * k * sigma / q, 2)) / (2 * pi * pi * k * k);
  return sum;
}

/* Rows from i on that stay within one step q of each other. */
static size_t rows_within(const double *value, size_t i, size_t n, double q)
{
  double low = value[i], high = value[i];
  size_t k = i + 1;
  for (; k < n && !(fmax(high, value[k]) - fmin(low, value[k]) > 1.01 * q); k++) {
    low = fmin(low, value[k]);
    high = fmax(high, value[k]);
  }
  return k - i;
}

/* Weights of rows that share their error of rounding.
 * In:      inner  deviation of the noise before it is rounded */
static void weigh_steps(const double *value, size_t n, double sigma, double inner, double q, double *weight)
{
  const double together = q > 0 ? shared(inner, q) * q * q : 0;
  size_t i, k, rows;
  for (i = 0; i < n; i += rows) {
    rows = rows_within(value, i, n, q);
    for (k = i; k < i + rows; k++)
      weight[k] = sigma / sqrt(sigma * sigma + together * (double)(rows - 1));
  }
}

/* How far an input may be off the line from a row to the next: a quarter of what the line bends by at either end. */
static double off_line(const double *t, const double *y, size_t i, size_t n)
{
  double before, after;
  if (i == 0 || i + 1 >= n)
    return 0;
  before = (y[i] - y[i - 1]) / (t[i] - t[i - 1]);
  after = (y[i + 1] - y[i]) / (t[i + 1] - t[i]);
  return isnan(after - before) ? 0 : fabs(after - before) * fmin(t[i] - t[i - 1], t[i + 1] - t[i]) / 4;
}

/* The error of the pressure that drives a stem, at row i of a run. */
static double input_error(const lab_run *e, size_t i)
{
  const double *t = e->log->value[LAB_CHANNEL_TIME] + e->first, *p = e->log->value[LAB_CHANNEL_P] + e->first;
  const double here = off_line(t, p, i, e->n), before = i > 0 ? off_line(t, p, i - 1, e->n) : 0;
  return hypot(e->log->smoothed[LAB_CHANNEL_P], fmax(here, before));
}

/* A stem follows the error of the pressure that drives it, by its area over its spring, and where it comes to rest it
 * keeps it: all rows of the rest share one. What is left of the noise after smoothing is less, but lasts as many rows
 * as it was smoothed over: it counts as if each row had its own. */
static void weigh_input(const lab_run *e, double sigma, double *weight)
{
  static const double at_rest = 6; /* deviations of the noise */
  const double *x = e->log->value[LAB_CHANNEL_X] + e->first;
  const double gain = (double)(e->rig->params.area / e->rig->params.spring_rate);
  size_t i, k, rows;
  for (i = 0; i < e->n; i += rows) {
    rows = rows_within(x, i, e->n, at_rest * sigma);
    for (k = i; k < i + rows; k++)
      weight[k] *= sigma / hypot(sigma, gain * input_error(e, k) * sqrt((double)rows));
  }
}

/* Whether a stem on its spring is driven by a measured pressure, with noise. */
static int follows_pressure(const lab_run *e, int channel)
{
  return channel == LAB_CHANNEL_X && e->rig->laws.pressure_input && e->log->smoothed[LAB_CHANNEL_P] > 0 &&
         e->rig->params.spring_rate > 0;
}

/* The step of a channel's values: as declared, or what the log shows. */
static double resolution_of(const lab_run *e, int channel)
{
  const double declared = channel == LAB_CHANNEL_P   ? lab_tolerance(e->rig, LAB_PRESSURE_RESOLUTION)
                          : channel == LAB_CHANNEL_X ? lab_tolerance(e->rig, LAB_POSITION_RESOLUTION)
                                                     : 0;
  return declared > 0 ? declared : lab_resolution(e->log->value[channel] + e->first, e->n);
}

static int add_channel(lab_run *e, int channel, lab_error *error)
{
  const double *value = e->log->value[channel] + e->first;
  const double q = resolution_of(e, channel), rounding = q * q / 12;
  double sigma = e->rig->noise[channel], inner = sigma;
  if (isnan(sigma)) {
    if (lab_noise_estimate(value, e->n, &sigma, error))
      return error->status;
    sigma = fmax(sigma, sqrt(rounding));
    inner = sqrt(fmax(sigma * sigma - rounding, 0));
  } else if (sigma > 0)
    sigma = sqrt(sigma * sigma + rounding);
  if (!(sigma > 0))
    return lab_fail(error, LAB_DATA,
                    "%s: channel %s does not change, or has too few values to tell its noise; declare it in the group "
                    "noise of the rig file",
                    e->log->path, lab_channels[channel].key);
  e->channel[e->n_channels] = channel;
  e->resolution[e->n_channels] = q;
  weigh_steps(value, e->n, sigma, inner, q, e->weight + (size_t)e->n_channels * e->n);
  if (follows_pressure(e, channel))
    weigh_input(e, sigma, e->weight + (size_t)e->n_channels * e->n);
  e->sigma[e->n_channels++] = sigma;
  return LAB_OK;
}

static int add_channels(lab_run *e, lab_error *error)
{
  int c;
  e->weight = malloc((LAB_CHANNEL_COUNT * e->n + 1) * sizeof *e->weight);
  if (!e->weight)
    return lab_fail_memory(error, "a run");
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (is_predicted(c) && e->log->value[c] && !e->rig->input[c] &&
        (c != LAB_CHANNEL_FORCE || e->rig->laws.position_input) && add_channel(e, c, error))
      return error->status;
  if (e->n_channels == 0)
    return lab_fail(error, LAB_DATA,
                    "%s: expected a measured channel that is no input: p, x or T; say which column has it, as by "
                    "log = { map = { p = \"PT-101\"; }; }",
                    e->log->path);
  return LAB_OK;
}

static int only_command_changes(const lab_schedule *s)
{
  size_t i;
  for (i = 1; i < s->n; i++)
    if (s->input[i].supply_pressure != s->input[0].supply_pressure || s->input[i].force != s->input[0].force ||
        s->input[i].pressure_rate != 0 || s->input[i].position_rate != 0)
      return 0;
  return 1;
}

static int bracket_switches(lab_run *e, lab_error *error)
{
  const double *t = e->log->value[LAB_CHANNEL_TIME] + e->first, *at = e->inputs.t;
  size_t k, row = 0;
  if (e->inputs.schedule.n < 2 || !only_command_changes(&e->inputs.schedule))
    return LAB_OK;
  e->n_instants = e->inputs.schedule.n - 1;
  e->bracket = calloc(e->n_instants, sizeof *e->bracket);
  if (!e->bracket)
    return lab_fail_memory(error, "an experiment");
  for (k = 0; k < e->n_instants; k++) {
    const pneu_input *next = &e->inputs.input[k + 1];
    while (row + 1 < e->n && t[row] < at[k + 1])
      row++;
    if (row > 0 && next->u_rate == 0 && lab_input_jumps(&e->inputs.input[k], at[k + 1] - at[k], next))
      e->bracket[k] = t[row] - t[row - 1];
  }
  return LAB_OK;
}

int lab_run_open(const lab_rig *rig, const lab_log *log, size_t run, lab_run *e, lab_error *error)
{
  pneu_model model;
  memset(e, 0, sizeof *e);
  e->rig = rig;
  e->log = log;
  e->run = run;
  e->first = log->run[run];
  e->n = log->run[run + 1] - e->first;
  if (lab_rig_model(rig, &model, error) || lab_inputs_from_log(&model, rig, log, run, &e->inputs, error) ||
      add_channels(e, error))
    return error->status;
  return bracket_switches(e, error);
}

void lab_run_close(lab_run *e)
{
  lab_inputs_free(&e->inputs);
  free(e->bracket);
  free(e->weight);
  free(e->drift);
  memset(e, 0, sizeof *e);
}

void lab_run_weigh(const lab_run *e, int c, double *v)
{
  const double *weight = e->weight + (size_t)c * e->n;
  size_t i;
  for (i = 0; i < e->n; i++)
    v[i] *= weight[i];
  if (e->colour[c].memory != 0)
    lab_colour_whiten(&e->colour[c], v, e->n);
}

double lab_run_measured(const lab_run *e, int c, size_t i)
{
  return e->log->value[e->channel[c]][e->first + i];
}

static const double *column_of(const lab_response *response, int channel)
{
  return channel == LAB_CHANNEL_P   ? response->p
         : channel == LAB_CHANNEL_X ? response->x
         : channel == LAB_CHANNEL_T ? response->T
                                    : response->force;
}

/* What is run of a case, from where it begins.
 * Out:     start, task
 * Returns: LAB_OK, LAB_NUMERIC where it begins in no state, LAB_WORLD */
static int pose(const lab_run *e, const lab_staging *s, double tol, pneu_state *start, lab_simulation *task,
                lab_error *error)
{
  *task = (lab_simulation){.start = start,
                           .schedule = &s->schedule,
                           .rows = s->of,
                           .t = e->log->value[LAB_CHANNEL_TIME] + e->first,
                           .n = e->n,
                           .options = {.tol = tol, .shown_only = 1, .max_steps = most_steps}};
  if (lab_run_initial_state(s->of[0], s->input, e->log, e->run, start, error))
    return error->status == LAB_DATA ? (error->status = LAB_NUMERIC) : error->status;
  return LAB_OK;
}

static int respond(const lab_run *e, const lab_staging *s, double tol, lab_response *response, lab_error *error)
{
  pneu_state start;
  lab_simulation task;
  if (pose(e, s, tol, &start, &task, error))
    return error->status;
  return lab_response_run(s->of[0], &task, response, error);
}

int lab_run_predict(const lab_run *e, const lab_episode *episode, int n, const double *early, double tol, double *y,
                    lab_error *error)
{
  lab_response response;
  lab_staging s;
  int c, status = lab_staging_open(e->log, &e->inputs.schedule, early, e->n_instants, episode, n, &s, error);
  if (status == LAB_OK)
    status = respond(e, &s, tol, &response, error);
  else if (status == LAB_DATA)
    status = error->status = LAB_NUMERIC;
  lab_staging_close(&s);
  if (status != LAB_OK)
    return status;
  for (c = 0; c < e->n_channels; c++)
    memcpy(y + (size_t)c * e->n, column_of(&response, e->channel[c]), e->n * sizeof *y);
  lab_response_free(&response);
  return LAB_OK;
}

/* Cases of a run, staged: the first is the one that is run. */
typedef struct cast {
  lab_staging *staging;
  pneu_state *start;
  lab_simulation *task;
  lab_response *change;
} cast;

static void cast_close(cast *c, int n)
{
  int i;
  for (i = 0; c->staging && i < n; i++)
    lab_staging_close(&c->staging[i]);
  for (i = 0; c->change && i < n; i++)
    lab_response_free(&c->change[i]);
  free(c->staging);
  free(c->start);
  free(c->task);
  free(c->change);
}

static int cast_open(cast *c, int n, lab_error *error)
{
  c->staging = calloc((size_t)n, sizeof *c->staging);
  c->start = calloc((size_t)n, sizeof *c->start);
  c->task = calloc((size_t)n, sizeof *c->task);
  c->change = calloc((size_t)n, sizeof *c->change);
  return c->staging && c->start && c->task && c->change ? LAB_OK : lab_fail_memory(error, "cases of a run");
}

/* Whether two models are the same, but for where they lie in memory. */
static int are_alike(const pneu_model *a, const pneu_model *b)
{
  return memcmp(&a->p, &b->p, sizeof a->p) == 0 && memcmp(&a->law, &b->law, sizeof a->law) == 0 && a->n_terms == 0 &&
         b->n_terms == 0;
}

/* Give a case the models of the first where they are the same: what differs there are instants, and where these have
 * died out nothing is followed. */
static void share_models(const lab_staging *first, lab_staging *s)
{
  size_t i;
  for (i = 0; i < s->schedule.n && i < first->schedule.n; i++)
    if (are_alike(s->of[i], first->of[i]))
      s->of[i] = first->of[i];
}

/* Stage a case, in the scales of the first.  Returns: LAB_OK; LAB_NUMERIC where it begins in no state; LAB_WORLD */
static int stage(const lab_run *e, const lab_run_case *as, double tol, cast *c, int i, lab_error *error)
{
  lab_staging *s = &c->staging[i];
  int k, status = lab_staging_open(e->log, &e->inputs.schedule, as->early, e->n_instants, as->episode, as->n, s, error);
  for (k = 0; i > 0 && k < s->n && status == LAB_OK; k++)
    memcpy(s->model[k].scale, c->staging[0].model[0].scale, sizeof s->model[k].scale);
  if (status == LAB_OK)
    status = pose(e, s, tol, &c->start[i], &c->task[i], error);
  if (i > 0 && status == LAB_OK)
    share_models(&c->staging[0], s);
  return status == LAB_DATA ? (error->status = LAB_NUMERIC) : status;
}

/* Run the first case with those behind it nearby; `of` says which case each is. */
static int run_cast(const lab_run *e, cast *c, int n, const int *of, double *const *change, char *done,
                    lab_error *error)
{
  lab_response response;
  int i, k;
  c->task[0].nearby = c->task + 1;
  c->task[0].n_nearby = n - 1;
  c->task[0].change = c->change + 1;
  if (lab_response_run(c->staging[0].of[0], &c->task[0], &response, error))
    return error->status;
  lab_response_free(&response);
  for (i = 1; i < n; i++) {
    const int to = of[i];
    done[to] = c->change[i].p != NULL;
    for (k = 0; done[to] && k < e->n_channels; k++)
      memcpy(change[to] + (size_t)k * e->n, column_of(&c->change[i], e->channel[k]), e->n * sizeof **change);
  }
  return LAB_OK;
}

int lab_run_vary(const lab_run *e, const lab_run_case *base, const lab_run_case *nearby, int n_cases, double tol,
                 double *const *change, char *done, lab_error *error)
{
  cast c;
  int *of = malloc((size_t)(n_cases + 1) * sizeof *of);
  int i, n = 1, status = cast_open(&c, n_cases + 1, error);
  memset(done, 0, (size_t)n_cases);
  if (status == LAB_OK && !of)
    status = lab_fail_memory(error, "cases of a run");
  if (status == LAB_OK)
    status = stage(e, base, tol, &c, 0, error);
  for (i = 0; i < n_cases && status == LAB_OK; i++) {
    status = stage(e, &nearby[i], tol, &c, n, error);
    if (status == LAB_OK)
      of[n++] = i;
    else if (status == LAB_NUMERIC) {
      lab_staging_close(&c.staging[n]);
      status = LAB_OK;
    }
  }
  if (status == LAB_OK && n > 1)
    status = run_cast(e, &c, n, of, change, done, error);
  cast_close(&c, n_cases + 1);
  free(of);
  return status;
}
