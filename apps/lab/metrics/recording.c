#include "recording.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../run/predict.h"

enum { TAPE_T, TAPE_U, TAPE_P, TAPE_X, TAPE_MASS_IN, TAPE_COLUMNS };
static const double longest_step = 0.01; /* [s] between samples of a simulation */
static const double most_rows = 200000;

static double *column(const lab_recording *recording, int i)
{
  return recording->memory + (size_t)i * recording->room;
}

/* ---- Memory ---- */

static void describe(const lab_rig *rig, const pneu_model *model, lab_record *r)
{
  const pneu_params *p = &rig->params;
  pneu_input input;
  pneu_input_default(model, &input);
  r->command = rig->laws.pressure_input           ? LAB_COMMAND_PRESSURE
               : (double)p->proportional_band > 0 ? LAB_COMMAND_SET_PRESSURE
                                                  : LAB_COMMAND_OPENING;
  r->unfit = rig->laws.position_input ? "position is an input: nothing answers with a movement" : NULL;
  r->stroke = (double)p->stroke;
  r->area = (double)p->area;
  r->signal_low = (double)pneu_balance_pressure(model, 0, &input, 0);
  r->signal_high = (double)pneu_balance_pressure(model, p->stroke, &input, 0);
  r->supply = (double)p->supply_pressure;
  r->gas_constant = (double)p->gas_constant;
}

int lab_recording_open(const lab_rig *rig, size_t rows, size_t runs, lab_recording *recording, lab_error *error)
{
  lab_record *r = &recording->record;
  pneu_model model;
  memset(recording, 0, sizeof *recording);
  if (lab_rig_model(rig, &model, error))
    return error->status;
  describe(rig, &model, r);
  recording->room = rows + 1;
  recording->memory = malloc(TAPE_COLUMNS * recording->room * sizeof *recording->memory);
  recording->first = calloc(runs + 1, sizeof *recording->first);
  if (!recording->memory || !recording->first)
    return lab_fail_memory(error, "a record");
  r->first = recording->first;
  r->t = column(recording, TAPE_T);
  return LAB_OK;
}

void lab_recording_close(lab_recording *recording)
{
  free(recording->memory);
  free(recording->first);
  memset(recording, 0, sizeof *recording);
}

/* ---- Runs ---- */

/* Append one run; a channel that is NULL is a gap in it. */
static void add_run(lab_recording *recording, size_t n, const double *const value[TAPE_COLUMNS])
{
  lab_record *r = &recording->record;
  const double **const shown[TAPE_COLUMNS] = {&r->t, &r->u, &r->p, &r->x, &r->mass_in};
  size_t i;
  int c;
  for (c = 0; c < TAPE_COLUMNS; c++) {
    double *to = column(recording, c) + r->n;
    for (i = 0; i < n; i++)
      to[i] = value[c] ? value[c][i] : (double)NAN;
    if (value[c])
      *shown[c] = column(recording, c);
  }
  r->n += n;
  recording->first[++r->n_runs] = r->n;
}

/* A log without a command u may have a set position in its place. */
static void take_command(const lab_log *log, lab_recording *recording)
{
  lab_record *r = &recording->record;
  if (r->command == LAB_COMMAND_PRESSURE || lab_log_command(log) != LAB_CHANNEL_SP)
    return;
  r->command = LAB_COMMAND_SET_POSITION;
  r->signal_low = 0;
  r->signal_high = 1;
}

/* The command is an opening or a set value; where pressure is the input, there is none. */
static const double *command_of(const lab_recording *recording, const double *u)
{
  return recording->record.command == LAB_COMMAND_PRESSURE ? NULL : u;
}

void lab_recording_add_response(lab_recording *recording, const lab_response *response)
{
  const double *const value[] = {response->t, command_of(recording, response->u), response->p, response->x,
                                 response->mass_in};
  add_run(recording, response->n, value);
}

/* ---- Simulated ---- */

/* The times of a run, and between them as many as it takes.
 * Out:     t  NULL: only count
 * Returns: how many */
static size_t fill_times(const lab_log *log, size_t run, double step, double *t)
{
  const double *own = log->value[LAB_CHANNEL_TIME];
  size_t i, n = 0;
  for (i = log->run[run]; i + 1 < log->run[run + 1]; i++) {
    const size_t parts = (size_t)fmax(ceil((own[i + 1] - own[i]) / step - 1e-6), 1);
    size_t k;
    for (k = 0; k < parts; k++, n++)
      if (t)
        t[n] = own[i] + (own[i + 1] - own[i]) * (double)k / (double)parts;
  }
  if (t)
    t[n] = own[i];
  return n + 1;
}

static double total_time(const lab_log *log)
{
  const double *t = log->value[LAB_CHANNEL_TIME];
  double total = 0;
  size_t run;
  for (run = 0; run < log->n_runs; run++)
    total += t[log->run[run + 1] - 1] - t[log->run[run]];
  return total;
}

static int simulate_run(const pneu_model *model, const lab_rig *rig, const lab_log *log, size_t run, double step,
                        lab_recording *recording, lab_error *error)
{
  const size_t n = fill_times(log, run, step, NULL);
  double *t = malloc(n * sizeof *t);
  const lab_prediction following = {.rig = rig, .log = log, .run = run, .t = t, .n = n};
  lab_response response;
  int status;
  if (!t)
    return lab_fail_memory(error, "a response");
  fill_times(log, run, step, t);
  status = lab_predict_log(model, &following, &response, error);
  free(t);
  if (status != LAB_OK)
    return status;
  lab_recording_add_response(recording, &response);
  lab_response_free(&response);
  return LAB_OK;
}

int lab_recording_simulate(const pneu_model *model, const lab_rig *rig, const lab_log *log, lab_recording *recording,
                           lab_error *error)
{
  const double step = fmax(longest_step, total_time(log) / most_rows);
  size_t run, rows = 0;
  for (run = 0; run < log->n_runs; run++)
    rows += fill_times(log, run, step, NULL);
  if (lab_recording_open(rig, rows, log->n_runs, recording, error))
    return error->status;
  take_command(log, recording);
  if (rig->laws.pressure_input && (!isnan(rig->noise[LAB_CHANNEL_P]) || rows < 2 * log->n))
    recording->record.noise_p = rig->noise[LAB_CHANNEL_P]; /* a measured one; a schedule of few rows has none */
  for (run = 0; run < log->n_runs; run++)
    if (simulate_run(model, rig, log, run, step, recording, error))
      return error->status;
  return LAB_OK;
}

/* ---- Runs of a bench ---- */

static const double *channel_of(const lab_run *e, int channel)
{
  const double *value = channel < 0 ? NULL : e->log->value[channel];
  return value ? value + e->first : NULL;
}

/* Noise of a channel in the first run that has it as an output; of an input, what is declared, or NaN. */
static double noise_of(const lab_unknowns *u, int channel)
{
  int e, c;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++)
      if (u->run[e].channel[c] == channel)
        return u->run[e].sigma[c];
  return u->rig.noise[channel];
}

/* The model of one run: what it has for itself in the place of what all share. */
static void rig_of(const lab_unknowns *u, int run, lab_rig *rig)
{
  double theta[LAB_FIT_MAX];
  lab_unknowns_values(u, theta);
  *rig = u->rig;
  lab_unknowns_apply(u, theta, LAB_ALL_RUNS, rig);
  lab_unknowns_apply(u, theta, run, rig);
}

int lab_run_respond(const lab_unknowns *u, int run, lab_response *response, lab_error *error)
{
  const lab_run *x = &u->run[run];
  pneu_model model;
  lab_rig rig;
  const lab_prediction following = {.rig = &rig, .log = x->log, .run = x->run, .options = {.tol = u->tol}};
  rig_of(u, run, &rig);
  return lab_rig_model(&rig, &model, error) || lab_predict_log(&model, &following, response, error) ? error->status
                                                                                                    : LAB_OK;
}

/* Append a run as it was measured. */
static void add_measured(const lab_run *x, lab_recording *recording)
{
  const double *const value[] = {channel_of(x, LAB_CHANNEL_TIME),
                                 command_of(recording, channel_of(x, lab_log_command(x->log))),
                                 channel_of(x, LAB_CHANNEL_P), channel_of(x, LAB_CHANNEL_X), NULL};
  add_run(recording, x->n, value);
}

/* All runs, as they were measured or as the model does them. */
static int record(const lab_unknowns *u, int predicted, lab_recording *recording, lab_error *error)
{
  size_t rows = 0;
  int e;
  for (e = 0; e < u->n_runs; e++)
    rows += u->run[e].n;
  if (lab_recording_open(&u->rig, rows, (size_t)u->n_runs, recording, error))
    return error->status;
  take_command(u->run[0].log, recording);
  recording->record.bracketed = !predicted;
  if (!predicted || u->rig.laws.pressure_input) /* that pressure is the measured one */
    recording->record.noise_p = noise_of(u, LAB_CHANNEL_P);
  if (!predicted)
    recording->record.noise_x = noise_of(u, LAB_CHANNEL_X);
  for (e = 0; e < u->n_runs; e++) {
    lab_response response;
    if (!predicted) {
      add_measured(&u->run[e], recording);
      continue;
    }
    if (lab_run_respond(u, e, &response, error))
      return error->status;
    lab_recording_add_response(recording, &response);
    lab_response_free(&response);
  }
  return LAB_OK;
}

static int measure(const lab_unknowns *u, int predicted, lab_metrics *metrics, lab_error *error)
{
  lab_recording recording;
  int status = record(u, predicted, &recording, error);
  if (status == LAB_OK)
    status = lab_metrics_measure(&recording.record, metrics, error);
  lab_recording_close(&recording);
  return status;
}

int lab_metrics_compare(const lab_unknowns *u, lab_metrics *measured, lab_metrics *predicted, lab_error *error)
{
  lab_record none = {0};
  int status = measure(u, 0, measured, error);
  if (status != LAB_OK)
    return status;
  status = measure(u, 1, predicted, error);
  if (status == LAB_OK || status == LAB_WORLD)
    return status;
  none.command = measured->command;
  none.unfit = error->text;
  return lab_metrics_measure(&none, predicted, error);
}
