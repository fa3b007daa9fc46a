#include "response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cvode.h"
#include "late.h"
#include "sampler.h"
#include "schedule.h"

enum { COLUMNS = 13, SHOWN_COLUMNS = 5 };

static const double usual_tol = 1e-7;

/* Column i; what sensors show, and when, comes first. */
static double **trace_column(lab_response *response, int i)
{
  double **const column[COLUMNS] = {&response->t,       &response->p,        &response->x,    &response->T,
                                    &response->force,   &response->u,        &response->v,    &response->m,
                                    &response->mass_in, &response->mass_out, &response->heat, &response->ps,
                                    &response->opening};
  return column[i];
}

static int trace_allocate(lab_response *response, size_t n, int shown_only, lab_error *error)
{
  const int columns = shown_only ? SHOWN_COLUMNS : COLUMNS;
  int i;
  memset(response, 0, sizeof *response);
  response->n = n;
  if (!shown_only)
    response->mode = calloc(n ? n : 1, sizeof *response->mode);
  for (i = 0; i < columns; i++)
    if (!(*trace_column(response, i) = malloc((n ? n : 1) * sizeof(double))))
      break;
  if (i == columns && (response->mode || shown_only))
    return LAB_OK;
  lab_response_free(response);
  return lab_fail_memory(error, "a response");
}

void lab_response_free(lab_response *response)
{
  int i;
  for (i = 0; i < COLUMNS; i++)
    free(*trace_column(response, i));
  free(response->mode);
  memset(response, 0, sizeof *response);
}

/* What the sampler writes into. Where the position is skewed there are twice as many samples as rows. */
typedef struct recorder {
  lab_response *response;
  const pneu_model *const *model; /* the one that acts */
  double *t;                      /* [s] of the samples */
  size_t *row;                    /* of each sample, plus response->n where it is of the position; NULL: not skewed */
  void (*take)(void *context, size_t i, const pneu_state *state, const pneu_input *input); /* a row */
} recorder;

static void record(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  lab_response *response = r->response;
  pneu_output out;
  if (pneu_observe(*r->model, state, input, &out) != PNEU_OK)
    memset(&out, 0xff, sizeof out); /* every number NaN */
  response->opening[i] = out.opening;
  response->p[i] = out.shown_pressure;
  if (!r->row)
    response->x[i] = out.shown_position;
  response->v[i] = out.velocity;
  response->T[i] = out.shown_temperature;
  response->m[i] = out.mass;
  response->mass_in[i] = out.mass_in;
  response->mass_out[i] = out.mass_out;
  response->heat[i] = out.heat;
  response->force[i] = out.holding_force;
  response->ps[i] = out.supply;
  response->mode[i] = state->mode;
}

/* Commands as they were given. */
static void record_commands(const lab_schedule *s, lab_response *response)
{
  size_t i, row = 0;
  for (i = 0; i < response->n; i++) {
    while (row + 1 < s->n && s->t[row + 1] <= response->t[i])
      row++;
    response->u[i] = (double)lab_input_after(&s->input[row], response->t[i] - s->t[row]).u;
  }
}

static void record_shown(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  pneu_shown shown;
  if (pneu_show(*r->model, state, input, &shown) != PNEU_OK)
    memset(&shown, 0xff, sizeof shown); /* every number NaN */
  r->response->p[i] = (double)shown.pressure;
  if (!r->row)
    r->response->x[i] = (double)shown.position;
  r->response->T[i] = (double)shown.temperature;
  r->response->force[i] = (double)shown.force;
}

static void record_position(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  pneu_shown shown = {0, 0, 0, 0};
  pneu_show(*r->model, state, input, &shown);
  r->response->x[i] = (double)shown.position;
}

static void record_skewed(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  const size_t n = r->response->n, at = r->row[i];
  (at < n ? r->take : record_position)(r, at < n ? at : at - n, state, input);
}

/* Samples at the rows, and where the position is skewed, of it at t - skew, all in the order of time. */
static int recorder_open(recorder *r, double skew, lab_error *error)
{
  const size_t n = r->response->n;
  const double *t = r->response->t;
  size_t i = 0, j = 0;
  r->t = malloc((2 * n + 1) * sizeof *r->t);
  r->row = skew != 0 ? malloc((2 * n + 1) * sizeof *r->row) : NULL;
  if (!r->t || (skew != 0 && !r->row))
    return lab_fail_memory(error, "a response");
  if (skew == 0)
    memcpy(r->t, t, n * sizeof *t);
  while (skew != 0 && i + j < 2 * n) {
    const int is_position = i == n || (j < n && t[j] - skew < t[i]);
    r->t[i + j] = is_position ? t[j] - skew : t[i];
    r->row[i + j] = is_position ? n + j : i;
    *(is_position ? &j : &i) += 1;
  }
  return LAB_OK;
}

static void recorder_close(recorder *r)
{
  free(r->t);
  free(r->row);
}

/* A simulation under way, by one of the two integrators. */
typedef struct engine {
  const pneu_model *model;
  const lab_simulation *task;
  double t_end;
  double tol;
  lab_cvode *cvode; /* NULL: the stepper */
  lab_sampler *sampler;
  lab_pace *taken;          /* the pace that is taken up, NULL: none */
  const lab_pace *followed; /* the pace that is followed, NULL: none */
  size_t row;               /* of the schedule */
  pneu_workspace work;
} engine;

static int sample_step(void *context, const pneu_step_view *view)
{
  const engine *e = context;
  pneu_state at;
  double due;
  while ((due = lab_sampler_due(e->sampler)) <= view->t + view->h) {
    pneu_dense(view, (due - view->t) / view->h, &at);
    lab_sampler_take(e->sampler, &at);
  }
  if (e->taken)
    lab_pace_step(e->taken, (double)view->h);
  return 0;
}

static int mark_event(void *context, pneu_real t, const pneu_state *state, int before)
{
  const engine *e = context;
  (void)t, (void)state, (void)before;
  if (e->taken)
    lab_pace_event(e->taken);
  return 0;
}

static int stretch(engine *e, pneu_state *state, double duration, lab_error *error)
{
  const int max_steps = e->task->options.max_steps;
  pneu_observer observer = {sample_step, mark_event, e};
  lab_sampler *sampler = e->sampler;
  pneu_options options;
  int status;
  if (e->cvode) {
    const lab_cvode_stretch under = {sampler->input, duration, e->tol, sampler, &e->work.stats};
    return lab_cvode_run(e->cvode, e->model, &under, state, error);
  }
  pneu_options_default(&options);
  options.tol = e->tol;
  if (max_steps > 0)
    options.max_steps = max_steps;
  if (e->taken)
    lab_pace_row(e->taken);
  if (e->followed)
    lab_pace_follow(e->followed, e->row, &options);
  status = pneu_run(e->model, state, sampler->input, duration, &options,
                    e->taken || sampler->next < sampler->n ? &observer : NULL, &e->work);
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

/* States of each effect. */
static const int states_of[] = {
#define PNEU_EFFECT(name, n_param, n_state) n_state,
#include "../../../lib/effects.def"
#undef PNEU_EFFECT
    0};

/* The place of an effect's states, -1 where it is off. */
static int place_of(const pneu_model *model, int effect)
{
  int i;
  for (i = 0; i < model->n_active; i++)
    if (model->active[i] == effect)
      return model->state_of[effect];
  return -1;
}

/* Go on with another model: what both have goes on, what is new begins as at rest; a stem that has sunk into a stop
 * touches it.  Returns: LAB_OK, LAB_NUMERIC */
static int hand_over(const pneu_model *from, const pneu_model *to, const pneu_input *input, pneu_state *state,
                     lab_error *error)
{
  const pneu_real x = state->x < 0 ? 0 : state->x > to->p.stroke ? to->p.stroke : state->x;
  pneu_state next;
  int effect, i;
  if (pneu_state_rest(to, state->p, state->T, x, input, &next) != PNEU_OK)
    return lab_fail(error, LAB_NUMERIC, "no other model can go on from p = %.9g Pa, x = %.9g m", (double)state->p,
                    (double)state->x);
  next.T = to->thermal ? state->T : next.T;
  for (effect = 0; effect < PNEU_EFFECT_COUNT; effect++) {
    const int before = place_of(from, effect), after = place_of(to, effect);
    for (i = 0; before >= 0 && after >= 0 && i < states_of[effect]; i++)
      next.extra[after + i] = state->extra[before + i];
  }
  if (from->clock >= 0 && to->clock >= 0)
    next.extra[to->clock] = state->extra[from->clock];
  if (state->v != 0 && state->x > to->lower_stop && state->x < to->upper_stop) {
    next.v = state->v;
    next.mode = state->v > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN;
  }
  *state = next;
  return LAB_OK;
}

/* Under one row of a schedule, to a time. */
static int run_row(engine *e, pneu_input *input, double from, double to, pneu_state *state, lab_error *error)
{
  lab_sampler *sampler = e->sampler;
  pneu_delay acts; /* the schedule has the delay */
  pneu_delay_begin(&acts, NULL, 0, input->u);
  input->delay = &acts;
  sampler->origin = from;
  sampler->input = input;
  pneu_settle(e->model, input, state);
  while (lab_sampler_due(sampler) <= 0)
    lab_sampler_take(sampler, state);
  if (stretch(e, state, to - from, error))
    return error->status;
  while (sampler->next < sampler->n)
    lab_sampler_take(sampler, state); /* the end, missed by rounding */
  return LAB_OK;
}

static int run_rows(engine *e, const lab_late *late, double t_end, lab_error *error)
{
  lab_sampler *sampler = e->sampler;
  const lab_schedule *schedule = &late->schedule;
  const pneu_model *model = e->model = late->rows[0];
  pneu_state state = *e->task->start;
  const size_t n = sampler->n;
  size_t i;
  int status = LAB_OK;
  if (e->followed && e->followed->rows != schedule->n)
    return lab_fail(error, LAB_NUMERIC, "a run of %zu stretches cannot follow one of %zu", schedule->n,
                    e->followed->rows);
  if (model->clock >= 0)
    state.extra[model->clock] = (pneu_real)schedule->t[0];
  for (i = 0; i < schedule->n && schedule->t[i] < t_end && status == LAB_OK; i++) {
    const double to = i + 1 < schedule->n && schedule->t[i + 1] < t_end ? schedule->t[i + 1] : t_end;
    pneu_input input = schedule->input[i];
    limit_samples(sampler, n, to, to >= t_end);
    if (late->rows[i] != e->model)
      status = hand_over(e->model, late->rows[i], &input, &state, error);
    e->model = late->rows[i];
    e->row = i;
    if (status == LAB_OK)
      status = run_row(e, &input, schedule->t[i], to, &state, error);
  }
  return status == LAB_OK && e->taken ? lab_pace_end(e->taken, error) : status;
}

static int run_schedule(engine *e, double t_end, lab_error *error)
{
  lab_late late;
  int status = lab_late_open(e->task, e->model, &late, error);
  if (status == LAB_OK)
    status = run_rows(e, &late, t_end, error);
  lab_late_close(&late);
  return status;
}

/* Through the schedule, with samples if there is a response. */
static int run_sampled(engine *e, lab_response *response, lab_error *error)
{
  const double skew = response ? (double)e->model->position_skew : 0;
  recorder r = {response, &e->model, NULL, NULL, e->task->options.shown_only ? record_shown : record};
  lab_sampler sampler = {.context = &r};
  int status = response ? recorder_open(&r, skew, error) : LAB_OK;
  if (response) {
    sampler.take = r.row ? record_skewed : r.take;
    sampler.t = r.t;
    sampler.n = r.row ? 2 * response->n : response->n;
  }
  e->sampler = &sampler;
  if (status == LAB_OK)
    status = run_schedule(e, fmax(e->t_end, e->t_end - skew), error);
  if (status == LAB_OK && response && response->u)
    record_commands(e->task->schedule, response);
  recorder_close(&r);
  return status;
}

int lab_response_run(const pneu_model *model, const lab_simulation *task, lab_response *response, lab_error *error)
{
  const lab_response_options *o = &task->options;
  engine e = {.model = model, .task = task, .t_end = task->t_end, .tol = o->tol};
  int status;
  if (task->pace && task->pace->is_set)
    e.followed = task->pace;
  else
    e.taken = task->pace;
  if (e.t_end == 0 && task->n > 0)
    e.t_end = task->t[task->n - 1];
  if (task->pace)
    e.tol = task->pace->tol;
  if (e.tol == 0)
    e.tol = usual_tol;
  if (response && trace_allocate(response, task->n, o->shown_only, error))
    return error->status;
  if (response)
    memcpy(response->t, task->t, task->n * sizeof *task->t);
  if (o->integrator == LAB_CVODE && !(e.cvode = lab_cvode_new()))
    status = lab_fail_memory(error, "CVODE");
  else
    status = run_sampled(&e, response, error);
  lab_cvode_free(e.cvode);
  if (task->stats)
    *task->stats = e.work.stats;
  if (status != LAB_OK && response)
    lab_response_free(response);
  return status;
}
