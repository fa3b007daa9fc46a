#include "response.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cvode.h"
#include "handover.h"
#include "late.h"
#include "sampler.h"
#include "schedule.h"
#include "variation.h"

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

int lab_response_allocate(lab_response *response, size_t n, int shown_only, lab_error *error)
{
  const int columns = shown_only ? SHOWN_COLUMNS : COLUMNS;
  int i;
  memset(response, 0, sizeof *response);
  response->n = n;
  if (!shown_only)
    response->mode = calloc(n ? n : 1, sizeof *response->mode);
  for (i = 0; i < columns; i++)
    if (!(*trace_column(response, i) = calloc(n ? n : 1, sizeof(double))))
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
  struct lab_variations *vary;    /* what nearby runs differ by; NULL: there are none */
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
  if (r->vary)
    lab_variations_take(r->vary, i, state, input, &shown, !r->row, 1);
}

static void record_position(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  recorder *r = context;
  pneu_shown shown = {0, 0, 0, 0};
  pneu_show(*r->model, state, input, &shown);
  r->response->x[i] = (double)shown.position;
  if (r->vary)
    lab_variations_take(r->vary, i, state, input, &shown, 1, 0);
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
  struct lab_variations *vary; /* what nearby runs differ by; NULL: there are none */
  size_t row;                  /* of the schedule */
  pneu_workspace work;
} engine;

/* Samples that are due by then; a few more than many do not matter. */
static int samples_until(const lab_sampler *s, double t)
{
  enum { MANY = 8 };
  int n = 0;
  while (n < MANY && s->next + (size_t)n < s->n && s->t[s->next + (size_t)n] - s->origin <= t)
    n++;
  return n;
}

static int sample_step(void *context, const pneu_step_view *view)
{
  const engine *e = context;
  double due, from, to;
  pneu_state at;
  for (from = 0; from < 1; from = to) {
    to = e->vary ? lab_variations_step(e->vary, view, from) : 1;
    if (e->vary)
      lab_variations_expect(e->vary, samples_until(e->sampler, view->t + to * view->h));
    while ((due = lab_sampler_due(e->sampler)) <= view->t + to * view->h) {
      pneu_dense(view, (due - view->t) / view->h, &at);
      if (e->vary)
        lab_variations_look(e->vary, (due - view->t) / view->h);
      lab_sampler_take(e->sampler, &at);
    }
    if (e->vary)
      lab_variations_pass(e->vary);
  }
  return 0;
}

static int mark_event(void *context, pneu_real t, const pneu_state *state, int before)
{
  const engine *e = context;
  (void)t, (void)before;
  if (e->vary)
    lab_variations_event(e->vary, state);
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
  options.max_steps = (int)fmin((max_steps > 0 ? max_steps : options.max_steps) * (1 + duration / 10), 1e9);
  status = pneu_run(e->model, state, sampler->input, duration, &options,
                    e->vary || sampler->next < sampler->n ? &observer : NULL, &e->work);
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

/* Under one row of a schedule, to a time. */
static int run_row(engine *e, pneu_input *input, double from, double to, const pneu_state *before, pneu_state *state,
                   lab_error *error)
{
  lab_sampler *sampler = e->sampler;
  pneu_delay acts; /* the schedule has the delay */
  pneu_delay_begin(&acts, NULL, 0, input->u);
  input->delay = &acts;
  sampler->origin = from;
  sampler->input = input;
  pneu_settle(e->model, input, state);
  if (e->vary)
    lab_variations_row(e->vary, e->row, before, state);
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
  if (model->clock >= 0)
    state.extra[model->clock] = (pneu_real)schedule->t[0];
  if (e->vary)
    lab_variations_begin(e->vary, schedule, late->rows);
  for (i = 0; i < schedule->n && schedule->t[i] < t_end && status == LAB_OK; i++) {
    const double to = i + 1 < schedule->n && schedule->t[i + 1] < t_end ? schedule->t[i + 1] : t_end;
    const pneu_state before = state;
    pneu_input input = schedule->input[i];
    limit_samples(sampler, n, to, to >= t_end);
    if (late->rows[i] != e->model && lab_hand_over(e->model, late->rows[i], &input, &state) != PNEU_OK)
      return lab_fail(error, LAB_NUMERIC, "no other model can go on from p = %.9g Pa, x = %.9g m", (double)state.p,
                      (double)state.x);
    e->model = late->rows[i];
    e->row = i;
    if (status == LAB_OK)
      status = run_row(e, &input, schedule->t[i], to, &before, &state, error);
  }
  return status;
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
  recorder r = {response, &e->model, NULL, NULL, e->vary, e->task->options.shown_only ? record_shown : record};
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
  int status = LAB_OK;
  if (e.t_end == 0 && task->n > 0)
    e.t_end = task->t[task->n - 1];
  if (e.tol == 0)
    e.tol = usual_tol;
  if (response && lab_response_allocate(response, task->n, o->shown_only, error))
    return error->status;
  if (response)
    memcpy(response->t, task->t, task->n * sizeof *task->t);
  if (o->integrator == LAB_CVODE && !(e.cvode = lab_cvode_new()))
    status = lab_fail_memory(error, "CVODE");
  else if (task->n_nearby > 0)
    status = lab_variations_open(task, task->nearby, task->n_nearby, task->change, &e.vary, error);
  if (status == LAB_OK)
    status = run_sampled(&e, response, error);
  lab_cvode_free(e.cvode);
  lab_variations_close(e.vary, status != LAB_OK);
  if (task->stats)
    *task->stats = e.work.stats;
  if (status != LAB_OK && response)
    lab_response_free(response);
  return status;
}
