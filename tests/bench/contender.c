#include "contender.h"

#include <math.h>
#include <string.h>

#include "../../apps/lab/run/cvode.h"
#include "fitting.h"
#include "timing.h"

static const double reference_tol = 1e-12;

const bench_law bench_laws[BENCH_LAWS] = {{PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER},
                                          {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED},
                                          {PNEU_GAS_POLYTROPIC, PNEU_FLOW_PAPER},
                                          {PNEU_GAS_POLYTROPIC, PNEU_FLOW_CHOKED}};

void bench_model(int law, pneu_model *model)
{
  pneu_params params;
  pneu_laws chosen = {0};
  pneu_params_default(&params);
  chosen.gas = bench_laws[law].gas;
  chosen.flow = bench_laws[law].flow;
  pneu_model_init(model, &params, &chosen, NULL);
}

void bench_fill_and_vent(const pneu_model *model, bench_case *task)
{
  static const double duration[3] = {0.5, 15, 15}, command[3] = {0, 1, -1};
  const bench_case standard = {model, 3, duration, command, 3051, 0.01};
  *task = standard;
}

/* ---- One stretch after another ---- */

typedef struct runner {
  lab_sampler sampler;
  double *p, *x;
  pneu_input input;
  pneu_state state;
  pneu_workspace work;
  double times[4096];
} runner;

static void take(void *context, size_t i, const pneu_state *state, const pneu_input *input)
{
  runner *r = context;
  (void)input;
  r->p[i] = (double)state->p;
  r->x[i] = (double)state->x;
}

static int observe(void *context, const pneu_step_view *view)
{
  runner *r = context;
  double due;
  while ((due = lab_sampler_due(&r->sampler)) <= (double)(view->t + view->h)) {
    pneu_state at;
    pneu_dense(view, (pneu_real)(due - (double)view->t) / view->h, &at);
    lab_sampler_take(&r->sampler, &at);
  }
  return 0;
}

static void start(runner *r, const bench_case *task, double *p, double *x)
{
  size_t i;
  memset(&r->work, 0, sizeof r->work);
  memset(&r->sampler, 0, sizeof r->sampler);
  pneu_input_default(task->model, &r->input);
  pneu_state_rest(task->model, 0, task->model->p.ambient_temperature, 0, &r->input, &r->state);
  r->p = p;
  r->x = x;
  r->sampler.t = r->times;
  r->sampler.input = &r->input;
  r->sampler.take = take;
  r->sampler.context = r;
  r->sampler.n = p && x ? task->rows : 0;
  for (i = 0; i < r->sampler.n; i++)
    r->times[i] = (double)i * task->spacing;
}

/* What the next stretch begins with; a sample that is due there is the state before its command acts. */
static void enter(runner *r, double command)
{
  r->input.u = (pneu_real)command;
  while (lab_sampler_due(&r->sampler) <= 0)
    lab_sampler_take(&r->sampler, &r->state);
}

static double leave(runner *r, double started)
{
  const double seconds = bench_seconds() - started;
  while (r->sampler.next < r->sampler.n) /* the end, missed by rounding */
    lab_sampler_take(&r->sampler, &r->state);
  return seconds;
}

static double by_stepper(const bench_case *task, double tol, double *p, double *x)
{
  static runner r;
  const pneu_observer observer = {observe, NULL, &r};
  pneu_options options;
  double started;
  int i, status = PNEU_OK;
  start(&r, task, p, x);
  pneu_options_default(&options);
  options.tol = (pneu_real)tol;
  started = bench_seconds();
  for (i = 0; i < task->n && status == PNEU_OK; i++) {
    enter(&r, task->command[i]);
    status = pneu_run(task->model, &r.state, &r.input, (pneu_real)task->duration[i], &options,
                      r.sampler.n ? &observer : NULL, &r.work);
    r.sampler.origin += task->duration[i];
  }
  return status == PNEU_OK ? leave(&r, started) : (double)NAN;
}

/* Solver memory stays from run to run. */
static lab_cvode *cvode(void)
{
  static lab_cvode *kept;
  if (!kept)
    kept = lab_cvode_new();
  return kept;
}

static double by_cvode(const bench_case *task, double tol, double *p, double *x)
{
  static runner r;
  lab_cvode *solver = cvode();
  lab_error error;
  double started;
  int i, status = solver ? LAB_OK : LAB_WORLD;
  start(&r, task, p, x);
  started = bench_seconds();
  for (i = 0; i < task->n && status == LAB_OK; i++) {
    enter(&r, task->command[i]);
    const lab_cvode_stretch stretch = {&r.input, task->duration[i], tol, r.sampler.n ? &r.sampler : NULL, NULL};
    enter(&r, task->command[i]);
    status = lab_cvode_run(solver, task->model, &stretch, &r.state, &error);
    r.sampler.origin += task->duration[i];
  }
  return status == LAB_OK ? leave(&r, started) : (double)NAN;
}

/* The right-hand side at states of the filling stroke, one after the other. */
static double own_rates(const bench_case *task)
{
  enum { CALLS = 20000 };
  const pneu_model *m = task->model;
  pneu_input input;
  pneu_state state;
  pneu_real y[PNEU_STATE_MAX], rate[PNEU_STATE_MAX];
  double started, sum = 0;
  int i, n;
  pneu_input_default(m, &input);
  pneu_state_rest(m, 0, m->p.ambient_temperature, m->p.stroke / 2, &input, &state);
  input.u = 1;
  state.mode = PNEU_MODE_UP;
  state.v = m->p.stroke;
  n = pneu_pack(m, &state, y);
  started = bench_seconds();
  for (i = 0; i < CALLS; i++) {
    y[0] = m->p.supply_pressure * (pneu_real)i / CALLS;
    pneu_rhs(m, &state, &input, y, rate);
    sum += (double)rate[n - 1];
  }
  return sum * 0 == 0 ? (bench_seconds() - started) / CALLS : (double)NAN;
}

const bench_contender bench_own[BENCH_OWN] = {{"libpneu", by_stepper, bench_fit_stepper, own_rates},
                                              {"CVODE", by_cvode, bench_fit_cvode, NULL}};

/* ---- The reference ---- */

int bench_reference(const bench_case *task, double *p, double *x)
{
  return isnan(by_cvode(task, reference_tol, p, x)) ? -1 : 0;
}

/* Modes are asked of the stepper, whose events have a callback, at a tolerance that dates them to 1e-9 s. */
typedef struct listener {
  double *time;
  int *mode;
  int n, room;
  double origin;
} listener;

static int heard(listener *l, double t, int mode)
{
  if (l->n == l->room)
    return -1;
  l->time[l->n] = l->origin + t;
  l->mode[l->n++] = mode;
  return 0;
}

static int on_event(void *context, pneu_real t, const pneu_state *state, int before)
{
  (void)before;
  return heard(context, (double)t, state->mode);
}

int bench_modes(const bench_case *task, int room, double *time, int *mode)
{
  static runner r;
  listener l = {time, mode, 0, room, 0};
  const pneu_observer observer = {NULL, on_event, &l};
  pneu_options options;
  int i, status = PNEU_OK;
  start(&r, task, NULL, NULL);
  pneu_options_default(&options);
  options.tol = (pneu_real)1e-10;
  for (i = 0; i < task->n && status == PNEU_OK; i++) {
    enter(&r, task->command[i]);
    pneu_settle(task->model, &r.input, &r.state);
    if (heard(&l, 0, r.state.mode))
      return -1;
    status = pneu_run(task->model, &r.state, &r.input, (pneu_real)task->duration[i], &options, &observer, &r.work);
    l.origin += task->duration[i];
  }
  return status == PNEU_OK ? l.n : -1;
}

/* ---- For rivals ---- */

double bench_value(const pneu_model *model, const char *name)
{
  pneu_params params = model->p;
  const int i = pneu_param_find(name);
  if (!strcmp(name, "gas") || !strcmp(name, "flow"))
    return *name == 'g' ? model->law.gas : model->law.flow;
  return i >= 0 ? (double)*pneu_param_at(&params, i) : (double)NAN;
}

int bench_stride(void)
{
  return PNEU_STATE_MAX;
}
