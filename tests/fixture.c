#include "fixture.h"

#include <string.h>

pneu_params fixture_params(int actuator)
{
  pneu_params p;
  pneu_params_default(&p);
  if (actuator == FIXTURE_R1_400)
    return p;
  p.area = 0.0677;
  p.dead_volume = 4e-6;
  p.stroke = 38.1e-3;
  p.spring_rate = 120e3;
  p.spring_preload = 7.62e-3;
  p.fill_area = p.vent_area = 2.177e-6;
  p.supply_pressure = 140e3;
  return p;
}

pneu_params fixture_vessel(double volume)
{
  pneu_params p;
  pneu_params_default(&p);
  p.stroke = 0;
  p.dead_volume = volume;
  p.fill_area = p.vent_area = 1e-6;
  return p;
}

void fixture_need(const char *effect)
{
  if (pneu_effect_find(effect) < 0)
    skip();
}

void fixture_set(pneu_params *p, const char *name, double value)
{
  const int i = pneu_param_find(name);
  if (i < 0)
    fail_msg("no parameter %s", name);
  *pneu_param_at(p, i) = (pneu_real)value;
}

pneu_model fixture_quick(int gas, const char *name, double value)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.fill_area = p.vent_area = (pneu_real)4e-6;
  if (name)
    fixture_set(&p, name, value);
  return fixture_model(&p, gas, PNEU_FLOW_CHOKED);
}

pneu_model fixture_model_roles(const pneu_params *p, int gas, int flow, int pressure_input, int position_input)
{
  pneu_model model;
  pneu_laws law;
  memset(&law, 0, sizeof law);
  law.gas = gas;
  law.flow = flow;
  law.pressure_input = pressure_input;
  law.position_input = position_input;
  assert_int_equal(pneu_model_init(&model, p, &law, NULL), PNEU_OK);
  return model;
}

pneu_model fixture_pressed(const pneu_params *p)
{
  return fixture_model_roles(p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 0);
}

pneu_model fixture_model(const pneu_params *p, int gas, int flow)
{
  return fixture_model_roles(p, gas, flow, 0, 0);
}

pneu_model fixture_r1_400(int gas, int flow)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  return fixture_model(&p, gas, flow);
}

pneu_term fixture_cycle(int equation, double period, double cosine, double sine)
{
  pneu_term term;
  memset(&term, 0, sizeof term);
  term.equation = equation;
  term.argument = PNEU_TERM_OVER_CYCLE;
  term.n = 2;
  term.to = (pneu_real)period;
  term.value[0] = (pneu_real)cosine;
  term.value[1] = (pneu_real)sine;
  return term;
}

pneu_options fixture_options(double tol)
{
  pneu_options options;
  pneu_options_default(&options);
  options.tol = (pneu_real)tol;
  return options;
}

pneu_input fixture_input(const pneu_model *model, double u)
{
  pneu_input input;
  pneu_input_default(model, &input);
  input.u = (pneu_real)u;
  return input;
}

pneu_state fixture_rest(const pneu_model *model, double pressure, double position, const pneu_input *input)
{
  pneu_state state;
  assert_int_equal(
      pneu_state_rest(model, (pneu_real)pressure, model->p.ambient_temperature, (pneu_real)position, input, &state),
      PNEU_OK);
  return state;
}

fixture_sample fixture_look(const pneu_model *model, const pneu_state *state, const pneu_input *input)
{
  fixture_sample s;
  pneu_output out;
  assert_int_equal(pneu_observe(model, state, input, &out), PNEU_OK);
  s.t = 0;
  s.p = (double)out.pressure;
  s.T = (double)out.temperature;
  s.x = (double)out.position;
  s.v = (double)out.velocity;
  s.m = (double)out.mass;
  s.opening = (double)out.opening;
  s.in = (double)out.mass_in;
  s.out = (double)out.mass_out;
  s.heat = (double)out.heat;
  s.supply = (double)out.supply;
  s.friction = (double)out.friction;
  s.shown_p = (double)out.shown_pressure;
  s.shown_T = (double)out.shown_temperature;
  s.shown_x = (double)out.shown_position;
  s.mode = state->mode;
  s.choked = out.choked;
  return s;
}

fixture_rig fixture_at(pneu_model model, double u, double pressure, double position)
{
  fixture_rig rig = {.m = model, .input = fixture_input(&model, u)};
  rig.s = fixture_rest(&rig.m, pressure, position, &rig.input);
  return rig;
}

fixture_sample fixture_see(const fixture_rig *rig)
{
  return fixture_look(&rig->m, &rig->s, &rig->input);
}

static int record_event(void *context, pneu_real t, const pneu_state *state, int mode_before)
{
  fixture_events *e = context;
  if (e->n == FIXTURE_EVENTS)
    return 1;
  e->t[e->n] = (double)t;
  e->p[e->n] = (double)state->p;
  e->x[e->n] = (double)state->x;
  e->before[e->n] = mode_before;
  e->after[e->n++] = state->mode;
  return 0;
}

void fixture_run(const pneu_model *model, pneu_state *state, const pneu_input *input, double duration, double tol,
                 fixture_events *events)
{
  pneu_observer observer = {NULL, record_event, NULL};
  const pneu_options options = fixture_options(tol);
  pneu_workspace work = {0};
  pneu_delay late;
  pneu_input own = *input;
  observer.context = events;
  if (events)
    events->n = 0;
  pneu_delay_begin(&late, NULL, 0, input->u);
  if (!input->delay)
    own.delay = &late;
  assert_int_equal(pneu_run(model, state, &own, (pneu_real)duration, &options, events ? &observer : NULL, &work),
                   PNEU_OK);
}

void fixture_go(fixture_rig *rig, double duration, double tol, fixture_events *events)
{
  fixture_run(&rig->m, &rig->s, &rig->input, duration, tol, events);
}

/* Where the samples of a trace go. */
typedef struct recorder {
  fixture_sample *sample;
  int n, capacity;
  double dt, origin;
} recorder;

static int record_step(void *context, const pneu_step_view *view)
{
  recorder *r = context;
  while (r->n < r->capacity) {
    const double due = r->n * r->dt - r->origin, into = due - (double)view->t;
    pneu_state at;
    if (into > (double)view->h)
      break;
    pneu_dense(view, (pneu_real)(into / (double)view->h), &at);
    r->sample[r->n] = fixture_look(view->model, &at, view->input);
    r->sample[r->n].t = r->n * r->dt;
    r->n++;
  }
  return 0;
}

int fixture_trace(const pneu_model *model, pneu_state *state, const fixture_stretch *stretch, int n, double dt,
                  double tol, fixture_sample *sample, int capacity)
{
  recorder r = {NULL, 0, 0, 0, 0};
  pneu_observer observer = {record_step, NULL, NULL};
  const pneu_options options = fixture_options(tol);
  pneu_workspace work = {0};
  pneu_late slot[64];
  pneu_delay late;
  int i;
  observer.context = &r;
  r.sample = sample;
  r.capacity = capacity;
  r.dt = dt;
  pneu_delay_begin(&late, slot, COUNT(slot), stretch[0].input.u);
  for (i = 0; i < n; i++) {
    pneu_input input = stretch[i].input;
    input.delay = &late;
    assert_int_equal(pneu_run(model, state, &input, (pneu_real)stretch[i].duration, &options, &observer, &work),
                     PNEU_OK);
    r.origin += stretch[i].duration;
  }
  return r.n;
}

double fixture_apart(const fixture_sample *a, const fixture_sample *b, int n)
{
  double most = 0;
  int i;
  for (i = 0; i < n; i++) {
    most = fmax(most, fabs(a[i].shown_x - b[i].shown_x) / 0.02);
    most = fmax(most, fabs(a[i].shown_p - b[i].shown_p) / 4e5);
    most = fmax(most, fabs(a[i].shown_T - b[i].shown_T) / 298.15);
  }
  return most;
}

void fixture_standard(const pneu_model *model, fixture_stretch *stretch)
{
  static const double duration[3] = {0.5, 15, 15}, u[3] = {0, 1, -1};
  int i;
  for (i = 0; i < 3; i++) {
    stretch[i].duration = duration[i];
    stretch[i].input = fixture_input(model, u[i]);
  }
}

long fixture_steps(const pneu_model *model)
{
  fixture_stretch stretch[3];
  const pneu_options options = fixture_options(TOL(1e-6, 1e-4));
  pneu_workspace work = {0};
  pneu_state state;
  int i;
  fixture_standard(model, stretch);
  state = fixture_rest(model, 0, 0, &stretch[0].input);
  for (i = 0; i < 3; i++)
    assert_int_equal(pneu_run(model, &state, &stretch[i].input, (pneu_real)stretch[i].duration, &options, NULL, &work),
                     PNEU_OK);
  return work.stats.steps;
}

double fixture_random(uint64_t *seed, double lo, double hi)
{
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return lo + (hi - lo) * ((double)(*seed >> 11) / 9007199254740992.0);
}

double fixture_normal(uint64_t *seed)
{
  double sum = -6;
  int k;
  for (k = 0; k < 12; k++)
    sum += fixture_random(seed, 0, 1);
  return sum;
}

double fixture_order(double coarse, double fine)
{
  return log(coarse / fine) / log(2.0);
}
