#include "response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cvode.h"
#include "sampler.h"

enum { COLUMNS = 12, SHOWN_COLUMNS = 5 };

/* Column i; what sensors show, and when, comes first. */
static double **trace_column(lab_trace *trace, int i)
{
  double **const column[COLUMNS] = {&trace->t, &trace->p, &trace->x,       &trace->T,        &trace->force, &trace->u,
                                    &trace->v, &trace->m, &trace->mass_in, &trace->mass_out, &trace->heat,  &trace->ps};
  return column[i];
}

static int trace_allocate(lab_trace *trace, size_t n, int shown_only, lab_error *error)
{
  const int columns = shown_only ? SHOWN_COLUMNS : COLUMNS;
  int i;
  memset(trace, 0, sizeof *trace);
  trace->n = n;
  if (!shown_only)
    trace->mode = calloc(n ? n : 1, sizeof *trace->mode);
  for (i = 0; i < columns; i++)
    if (!(*trace_column(trace, i) = malloc((n ? n : 1) * sizeof(double))))
      break;
  if (i == columns && (trace->mode || shown_only))
    return LAB_OK;
  lab_trace_free(trace);
  return lab_fail_memory(error, "a response");
}

void lab_trace_free(lab_trace *trace)
{
  int i;
  for (i = 0; i < COLUMNS; i++)
    free(*trace_column(trace, i));
  free(trace->mode);
  memset(trace, 0, sizeof *trace);
}

/* What the sampler writes into. */
typedef struct recorder {
  lab_trace *trace;
  const pneu_model *model;
} recorder;

static void record(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  lab_trace *trace = r->trace;
  pneu_output out;
  if (pneu_observe(r->model, state, input, &out) != PNEU_OK)
    memset(&out, 0xff, sizeof out); /* every number NaN */
  trace->u[i] = input->u;
  trace->p[i] = out.shown_pressure;
  trace->x[i] = out.shown_position;
  trace->v[i] = out.velocity;
  trace->T[i] = out.shown_temperature;
  trace->m[i] = out.mass;
  trace->mass_in[i] = out.mass_in;
  trace->mass_out[i] = out.mass_out;
  trace->heat[i] = out.heat;
  trace->force[i] = out.holding_force;
  trace->ps[i] = out.supply;
  trace->mode[i] = state->mode;
}

static void record_shown(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  pneu_shown shown;
  if (pneu_show(r->model, state, input, &shown) != PNEU_OK)
    memset(&shown, 0xff, sizeof shown); /* every number NaN */
  r->trace->p[i] = (double)shown.pressure;
  r->trace->x[i] = (double)shown.position;
  r->trace->T[i] = (double)shown.temperature;
  r->trace->force[i] = (double)shown.force;
}

static int sample_step(void *context, const pneu_step_view *view)
{
  lab_sampler *sampler = context;
  pneu_state at;
  double due;
  while ((due = lab_sampler_due(sampler)) <= view->t + view->h) {
    pneu_dense(view, (due - view->t) / view->h, &at);
    lab_sampler_take(sampler, &at);
  }
  return 0;
}

/* The two integrators behind one call. */
typedef struct engine {
  lab_cvode *cvode; /* NULL: the stepper */
  pneu_workspace work;
  double tol;
  int max_steps; /* 0: as usual */
} engine;

static int stretch(engine *e, const pneu_model *model, pneu_state *state, const pneu_input *input, double duration,
                   lab_sampler *sampler, lab_error *error)
{
  pneu_observer observer = {sample_step, NULL, sampler};
  pneu_options options;
  int status;
  if (e->cvode)
    return lab_cvode_run(e->cvode, model, state, input, duration, e->tol, sampler, &e->work.stats, error);
  pneu_options_default(&options);
  options.tol = e->tol;
  if (e->max_steps > 0)
    options.max_steps = e->max_steps;
  status = pneu_run(model, state, input, duration, &options, sampler->next < sampler->n ? &observer : NULL, &e->work);
  if (status == PNEU_OK)
    return LAB_OK;
  return lab_fail(error, LAB_NUMERIC,
                  "%s within %.9g s after t = %.9g s, %s, p = %.9g Pa, T = %.6g K, x = %.9g m, v = %.6g m/s",
                  pneu_status_text(status), duration, sampler->origin, pneu_mode_text(state->mode), state->p, state->T,
                  state->x, state->v);
}

/* Let the sampler take what lies in this stretch: a sample at a change of command belongs to what follows. */
static void limit_samples(lab_sampler *sampler, size_t n, double to, int last)
{
  sampler->n = sampler->next;
  while (sampler->n < n && (last || sampler->t[sampler->n] < to))
    sampler->n++;
}

static int run_schedule(engine *e, const pneu_model *model, const pneu_state *start, const lab_schedule *schedule,
                        double t_end, lab_sampler *sampler, lab_error *error)
{
  pneu_state state = *start;
  const size_t n = sampler->n;
  size_t i;
  int status = LAB_OK;
  if (model->clock >= 0)
    state.extra[model->clock] = (pneu_real)schedule->t[0];
  for (i = 0; i < schedule->n && schedule->t[i] < t_end && status == LAB_OK; i++) {
    const double to = i + 1 < schedule->n && schedule->t[i + 1] < t_end ? schedule->t[i + 1] : t_end;
    sampler->origin = schedule->t[i];
    sampler->input = &schedule->input[i];
    limit_samples(sampler, n, to, to >= t_end);
    pneu_settle(model, sampler->input, &state);
    while (lab_sampler_due(sampler) <= 0)
      lab_sampler_take(sampler, &state);
    status = stretch(e, model, &state, sampler->input, to - schedule->t[i], sampler, error);
    while (status == LAB_OK && sampler->next < sampler->n)
      lab_sampler_take(sampler, &state); /* the end, missed by rounding */
  }
  return status;
}

/* ---- Delays ---- */

static int same(const pneu_input *a, const pneu_input *b)
{
  return a->u == b->u && a->supply_pressure == b->supply_pressure && a->force == b->force &&
         a->pressure_rate == b->pressure_rate && a->position_rate == b->position_rate;
}

/* The schedule with commands that act late, the other inputs in time; what only rounding keeps apart happens at once.
 * Out: late, of 2 n rows at most */
static void delay_commands(const lab_schedule *s, double delay, double *t, pneu_input *input, lab_schedule *late)
{
  size_t prompt = 0, acting = 0, n = 0; /* the row whose inputs, and the one whose command hold */
  for (;;) {
    const double rounding = 1e-12 * (1 + fabs(s->t[prompt]));
    const double next = prompt + 1 < s->n ? s->t[prompt + 1] : (double)INFINITY;
    const double next_command = acting + 1 < s->n ? s->t[acting + 1] + delay : (double)INFINITY;
    input[n] = s->input[prompt];
    input[n].u = s->input[acting].u;
    if (n == 0 || !same(&input[n], &input[n - 1])) {
      t[n] = n == 0 ? s->t[0] : fmax(s->t[prompt], acting > 0 ? s->t[acting] + delay : s->t[0]);
      n++;
    }
    if (next == (double)INFINITY && next_command == (double)INFINITY)
      break;
    prompt += next <= next_command + rounding && next < (double)INFINITY;
    acting += next_command <= next + rounding && next_command < (double)INFINITY;
  }
  late->n = n;
  late->t = t;
  late->input = input;
}

/* Commands as given, over the samples. */
static void show_commands(const lab_schedule *s, lab_trace *trace)
{
  size_t i, row = 0;
  for (i = 0; i < trace->n; i++) {
    while (row + 1 < s->n && s->t[row + 1] <= trace->t[i])
      row++;
    trace->u[i] = (double)s->input[row].u;
  }
}

static void record_position(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  pneu_shown shown = {0, 0, 0, 0};
  pneu_show(r->model, state, input, &shown);
  r->trace->x[i] = (double)shown.position;
}

/* One pass through the schedule: samples at t - skew, handed to `take`. */
static int pass(engine *e, const pneu_model *model, const pneu_state *start, const lab_schedule *schedule, double t_end,
                double skew, void (*take)(void *, size_t, const pneu_state *, const pneu_input *), lab_trace *trace,
                lab_error *error)
{
  recorder r = {trace, model};
  lab_sampler sampler = {0};
  double *t = NULL;
  size_t i;
  int status;
  sampler.model = model;
  sampler.take = take;
  sampler.context = &r;
  if (trace) {
    if (!(t = malloc((trace->n ? trace->n : 1) * sizeof *t)))
      return lab_fail_memory(error, "a response");
    for (i = 0; i < trace->n; i++)
      t[i] = trace->t[i] - skew;
    sampler.t = t;
    sampler.n = trace->n;
  }
  status = run_schedule(e, model, start, schedule, t_end, &sampler, error);
  free(t);
  return status;
}

/* Pressure and the rest in one pass; position, where it is skewed, in another. */
static int passes(engine *e, const pneu_model *model, const pneu_state *start, const lab_schedule *schedule,
                  double t_end, lab_trace *trace, lab_error *error)
{
  const double skew = (double)model->position_skew;
  const int shown_only = trace && !trace->mode;
  int status = pass(e, model, start, schedule, t_end, 0, shown_only ? record_shown : record, trace, error);
  if (status == LAB_OK && trace && skew != 0)
    status = pass(e, model, start, schedule, skew < 0 ? t_end - skew : t_end, skew, record_position, trace, error);
  return status;
}

/* The passes with commands that act late. */
static int delayed_passes(engine *e, const pneu_model *model, const pneu_state *start, const lab_schedule *schedule,
                          double t_end, lab_trace *trace, lab_error *error)
{
  lab_schedule late;
  double *t = malloc(2 * schedule->n * sizeof *t);
  pneu_input *input = malloc(2 * schedule->n * sizeof *input);
  int status = LAB_OK;
  if (!t || !input) {
    status = lab_fail_memory(error, "a schedule");
  } else {
    delay_commands(schedule, (double)model->command_delay, t, input, &late);
    status = passes(e, model, start, &late, t_end, trace, error);
  }
  if (status == LAB_OK && trace && trace->u)
    show_commands(schedule, trace);
  free(t);
  free(input);
  return status;
}

int lab_respond(const pneu_model *model, const pneu_state *start, const lab_schedule *schedule, const double *t,
                size_t n, const lab_response_options *options, lab_trace *trace, pneu_stats *stats, lab_error *error)
{
  engine e;
  int status;
  if (options->count_only)
    trace = NULL;
  if (trace && trace_allocate(trace, n, options->shown_only, error))
    return error->status;
  memset(&e.work, 0, sizeof e.work);
  e.tol = options->tol;
  e.max_steps = options->max_steps;
  e.cvode = options->integrator == LAB_CVODE ? lab_cvode_new() : NULL;
  if (options->integrator == LAB_CVODE && !e.cvode)
    status = lab_fail_memory(error, "CVODE");
  else {
    if (trace)
      memcpy(trace->t, t, n * sizeof *t);
    status = (model->command_delay > 0 && schedule->n > 1 ? delayed_passes : passes)(&e, model, start, schedule,
                                                                                     options->t_end, trace, error);
  }
  lab_cvode_free(e.cvode);
  if (stats)
    *stats = e.work.stats;
  if (status != LAB_OK && trace)
    lab_trace_free(trace);
  return status;
}
