#include "tape.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../run/follow.h"

enum { TAPE_T, TAPE_U, TAPE_P, TAPE_X, TAPE_MASS_IN, TAPE_COLUMNS };
static const double longest_step = 0.01; /* [s] between samples of a simulation */
static const double most_rows = 200000;

static double *column(const lab_tape *tape, int i)
{
  return tape->memory + (size_t)i * tape->room;
}

/* ---- Memory ---- */

/* The bench set follows from the spring, and a force that always acts. */
static void describe(const lab_rig *rig, lab_record *r)
{
  const pneu_params *p = &rig->params;
  const double force = (double)p->external_force + (double)p->spring_rate * (double)p->spring_preload;
  r->command = rig->laws.pressure_input           ? LAB_COMMAND_PRESSURE
               : (double)p->proportional_band > 0 ? LAB_COMMAND_SET_PRESSURE
                                                  : LAB_COMMAND_OPENING;
  r->unfit = rig->laws.position_input ? "position is an input: nothing answers with a movement" : NULL;
  r->stroke = (double)p->stroke;
  r->area = (double)p->area;
  r->signal_low = force / r->area;
  r->signal_high = (force + (double)p->spring_rate * r->stroke) / r->area;
  r->supply = (double)p->supply_pressure;
  r->gas_constant = (double)p->gas_constant;
}

int lab_tape_open(const lab_rig *rig, size_t rows, size_t runs, lab_tape *tape, lab_error *error)
{
  lab_record *r = &tape->record;
  memset(tape, 0, sizeof *tape);
  describe(rig, r);
  tape->room = rows + 1;
  tape->room_runs = runs;
  tape->memory = malloc(TAPE_COLUMNS * tape->room * sizeof *tape->memory);
  tape->first = calloc(runs + 1, sizeof *tape->first);
  if (!tape->memory || !tape->first)
    return lab_fail_memory(error, "a record");
  r->first = tape->first;
  r->t = column(tape, TAPE_T);
  return LAB_OK;
}

void lab_tape_close(lab_tape *tape)
{
  free(tape->memory);
  free(tape->first);
  memset(tape, 0, sizeof *tape);
}

/* ---- Runs ---- */

/* Append one run; a channel that is NULL is a gap in it. */
static void add_run(lab_tape *tape, size_t n, const double *const value[TAPE_COLUMNS])
{
  lab_record *r = &tape->record;
  const double **const shown[TAPE_COLUMNS] = {&r->t, &r->u, &r->p, &r->x, &r->mass_in};
  size_t i;
  int c;
  for (c = 0; c < TAPE_COLUMNS; c++) {
    double *to = column(tape, c) + r->n;
    for (i = 0; i < n; i++)
      to[i] = value[c] ? value[c][i] : (double)NAN;
    if (value[c])
      *shown[c] = column(tape, c);
  }
  r->n += n;
  tape->first[++r->n_runs] = r->n;
}

/* The command is an opening or a set pressure; where pressure is the input, there is none. */
static const double *command_of(const lab_tape *tape, const double *u)
{
  return tape->record.command == LAB_COMMAND_PRESSURE ? NULL : u;
}

void lab_tape_add_trace(lab_tape *tape, const lab_trace *trace)
{
  const double *const value[] = {trace->t, command_of(tape, trace->u), trace->p, trace->x, trace->mass_in};
  add_run(tape, trace->n, value);
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
                        const lab_response_options *options, lab_tape *tape, lab_error *error)
{
  const size_t n = fill_times(log, run, step, NULL);
  double *t = malloc(n * sizeof *t);
  lab_trace trace;
  int status;
  if (!t)
    return lab_fail_memory(error, "a response");
  fill_times(log, run, step, t);
  status = lab_follow(model, rig, log, run, t, n, options, &trace, error);
  free(t);
  if (status != LAB_OK)
    return status;
  lab_tape_add_trace(tape, &trace);
  lab_trace_free(&trace);
  return LAB_OK;
}

int lab_tape_simulate(const pneu_model *model, const lab_rig *rig, const lab_log *log,
                      const lab_response_options *options, lab_tape *tape, lab_error *error)
{
  const double step = fmax(longest_step, total_time(log) / most_rows);
  size_t run, rows = 0;
  for (run = 0; run < log->n_runs; run++)
    rows += fill_times(log, run, step, NULL);
  if (lab_tape_open(rig, rows, log->n_runs, tape, error))
    return error->status;
  if (rig->laws.pressure_input && (!isnan(rig->noise[LAB_CHANNEL_P]) || rows < 2 * log->n))
    tape->record.noise_p = rig->noise[LAB_CHANNEL_P]; /* a measured one; a schedule of few rows has none */
  for (run = 0; run < log->n_runs; run++)
    if (simulate_run(model, rig, log, run, step, options, tape, error))
      return error->status;
  return LAB_OK;
}

/* ---- Runs of a bench ---- */

static size_t rows_of(const lab_unknowns *u)
{
  size_t rows = 0;
  int e;
  for (e = 0; e < u->n_experiments; e++)
    rows += u->experiment[e].n;
  return rows;
}

static const double *channel_of(const lab_experiment *e, int channel)
{
  const double *value = e->log->value[channel];
  return value ? value + e->first : NULL;
}

/* Noise of a channel in the first run that has it as an output; of an input, what is declared, or NaN. */
static double noise_of(const lab_unknowns *u, int channel)
{
  int e, c;
  for (e = 0; e < u->n_experiments; e++)
    for (c = 0; c < u->experiment[e].n_channels; c++)
      if (u->experiment[e].channel[c] == channel)
        return u->experiment[e].sigma[c];
  return u->rig.noise[channel];
}

int lab_tape_measured(const lab_unknowns *u, lab_tape *tape, lab_error *error)
{
  int e;
  if (lab_tape_open(&u->rig, rows_of(u), (size_t)u->n_experiments, tape, error))
    return error->status;
  tape->record.bracketed = 1;
  tape->record.noise_p = noise_of(u, LAB_CHANNEL_P);
  tape->record.noise_x = noise_of(u, LAB_CHANNEL_X);
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    const double *const value[] = {channel_of(x, LAB_CHANNEL_TIME), command_of(tape, channel_of(x, LAB_CHANNEL_U)),
                                   channel_of(x, LAB_CHANNEL_P), channel_of(x, LAB_CHANNEL_X), NULL};
    add_run(tape, x->n, value);
  }
  return LAB_OK;
}

/* The model of one run: what it has for itself in the place of what all share. */
static void rig_of(const lab_unknowns *u, int experiment, lab_rig *rig)
{
  double theta[LAB_FIT_MAX];
  int j;
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
  *rig = u->rig;
  lab_unknowns_apply(u, theta, LAB_ALL_EXPERIMENTS, rig);
  lab_unknowns_apply(u, theta, experiment, rig);
}

static int predict_run(const lab_unknowns *u, int experiment, lab_tape *tape, lab_error *error)
{
  const lab_response_options options = {LAB_STEPPER, u->tol, 0, 0, 0, 0};
  const lab_experiment *x = &u->experiment[experiment];
  pneu_model model;
  lab_trace trace;
  lab_rig rig;
  rig_of(u, experiment, &rig);
  if (lab_rig_model(&rig, &model, error) ||
      lab_follow(&model, &rig, x->log, x->run, channel_of(x, LAB_CHANNEL_TIME), x->n, &options, &trace, error))
    return error->status;
  lab_tape_add_trace(tape, &trace);
  lab_trace_free(&trace);
  return LAB_OK;
}

int lab_tape_predicted(const lab_unknowns *u, lab_tape *tape, lab_error *error)
{
  int e;
  if (lab_tape_open(&u->rig, rows_of(u), (size_t)u->n_experiments, tape, error))
    return error->status;
  if (u->rig.laws.pressure_input) /* the pressure is the measured one */
    tape->record.noise_p = noise_of(u, LAB_CHANNEL_P);
  for (e = 0; e < u->n_experiments; e++)
    if (predict_run(u, e, tape, error))
      return error->status;
  return LAB_OK;
}
