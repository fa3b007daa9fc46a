/* Audit of mass and energy: what flows in and out over a run is what the ends of it differ by. */
#include "../fixture.h"

/* Integrals over a run. */
typedef struct audit {
  const pneu_model *model;
  const pneu_input *input;
  double T_in;                            /* [K] of all inflow of the run */
  double mass, mass_turned_over;          /* [kg] */
  double enthalpy_in, enthalpy_out, heat; /* [J] */
  double gas_work, spring_side_work;      /* [J] p_abs dV, p_gauge A dx */
  double dry, viscous, external, impact;  /* [J] */
  double supply_lost;                     /* [Pa s] of the supply pressure, on the way to the transducer */
  double v_end;                           /* [m/s] at the end of the last step */
} audit;

/* Rates at one instant, times dt. */
static void add(audit *a, const fixture_sample *s, double dt)
{
  const pneu_params *p = &a->model->p;
  const double g = (double)a->model->g, cp = g > 1 ? g / (g - 1) * (double)p->gas_constant : 0;
  const double pa = (double)p->ambient_pressure, area = (double)p->area;
  a->mass += (s->in - s->out) * dt;
  a->mass_turned_over += (s->in + s->out) * dt;
  a->enthalpy_in += cp * s->in * a->T_in * dt;
  a->enthalpy_out += cp * s->out * s->T * dt;
  a->heat += s->heat * dt;
  a->supply_lost += ((double)p->supply_pressure - s->supply) * dt;
  a->gas_work += (s->p + pa) * area * (double)p->swept_ratio * s->v * dt;
  a->spring_side_work += s->p * area * s->v * dt;
  a->dry += s->friction * fabs(s->v) * dt;
  a->viscous += ((double)p->viscous_friction + (double)p->damping) * s->v * s->v * dt;
  a->external += ((double)p->external_force + (double)a->input->force) * s->v * dt;
}

/* Gauss-Legendre of five points over the dense output of a step. */
static int at_step(void *context, const pneu_step_view *view)
{
  static const double node[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842, 0.953089922969332};
  static const double weight[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                   0.118463442528095};
  audit *a = context;
  pneu_state s;
  int i;
  for (i = 0; i < 5; i++) {
    fixture_sample look;
    pneu_dense(view, (pneu_real)node[i], &s);
    look = fixture_look(view->model, &s, view->input);
    add(a, &look, weight[i] * (double)view->h);
  }
  pneu_dense(view, 1, &s);
  a->v_end = (double)s.v;
  return 0;
}

static int at_event(void *context, pneu_real t, const pneu_state *s, int before)
{
  audit *a = context;
  (void)t;
  if ((before == PNEU_MODE_UP || before == PNEU_MODE_DOWN) && s->v == 0)
    a->impact += 0.5 * (double)a->model->p.moving_mass * a->v_end * a->v_end;
  return 0;
}

/* Fill, hold under a force, vent.  In/out: state */
static audit run(const pneu_model *m, pneu_state *s)
{
  static const double duration[] = {1.0, 0.5, 2.0, 0.7, 20}, u[] = {1, 0, 1, -0.3, -1}, force[] = {0, 700, 0, 0, -200};
  audit a;
  pneu_observer observer = {at_step, at_event, NULL};
  const pneu_options options = fixture_options(TOL(1e-9, 1e-5));
  pneu_workspace work = {0};
  int i;
  memset(&a, 0, sizeof a);
  a.model = m;
  a.T_in = (double)m->p.supply_temperature;
  observer.context = &a;
  for (i = 0; i < COUNT(u); i++) {
    pneu_input input = fixture_input(m, u[i]);
    input.force = (pneu_real)force[i];
    a.input = &input;
    assert_int_equal(pneu_run(m, s, &input, (pneu_real)duration[i], &options, &observer, &work), PNEU_OK);
  }
  return a;
}

static double inner_energy(const pneu_model *m, const pneu_state *s)
{
  return (double)pneu_mass(m, s) * (double)m->p.gas_constant / ((double)m->g - 1) * (double)s->T;
}

static double spring_energy(const pneu_params *p, double x)
{
  const double c = x + (double)p->spring_preload;
  return (double)p->spring_rate * c * c / 2;
}

static void check_gas(const audit *a, const pneu_state *start, const pneu_state *end)
{
  const pneu_model *m = a->model;
  const double turnover = a->enthalpy_in + a->enthalpy_out;
  const double rtol = TOL(3e-7, 2e-3);
  assert_close((double)pneu_mass(m, end) - (double)pneu_mass(m, start), a->mass, rtol * a->mass_turned_over, 0);
  if (!m->thermal)
    return;
  assert_close(inner_energy(m, end) - inner_energy(m, start), a->enthalpy_in - a->enthalpy_out + a->heat - a->gas_work,
               rtol * turnover, 0);
}

static void check_stem(const audit *a, const pneu_state *start, const pneu_state *end)
{
  const pneu_params *p = &a->model->p;
  const double kinetic = (double)p->moving_mass * (double)(end->v * end->v - start->v * start->v) / 2;
  const double spring = spring_energy(p, (double)end->x) - spring_energy(p, (double)start->x);
  const double spent = a->dry + a->viscous + a->impact;
  assert_true(a->dry > 1 && a->viscous > 1e-3 && a->impact > 0);
  assert_close(a->spring_side_work, kinetic + spring + a->external + spent, TOL(1e-6, 5e-3) * spent, 0);
}

static void check_model(const pneu_model *m)
{
  const pneu_input shut = fixture_input(m, 0);
  const pneu_state start = fixture_rest(m, 0, 0, &shut);
  pneu_state end = start;
  const audit a = run(m, &end);
  check_gas(&a, &start, &end);
  check_stem(&a, &start, &end);
}

static void check_run(const pneu_params *p, int gas, int flow)
{
  const pneu_model m = fixture_model(p, gas, flow);
  check_model(&m);
}

TEST(test_pneu_run__each_actuator_and_law__keeps_mass_and_energy)
{
  int actuator, gas, flow;
  for (actuator = 0; actuator < FIXTURE_ACTUATORS; actuator++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
      for (flow = 0; flow < PNEU_FLOW_COUNT; flow++) {
        pneu_params p = fixture_params(actuator);
        p.supply_temperature = 320;
        p.external_force = 50;
        check_note("actuator %d, %s, %s", actuator, pneu_gas_key(gas), pneu_flow_key(flow));
        check_run(&p, gas, flow);
      }
}

TEST(test_pneu_run__swept_ratio_and_other_index__keeps_mass_and_energy)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.swept_ratio = (pneu_real)0.85;
  p.polytropic_index = (pneu_real)1.2;
  p.heat_ratio = (pneu_real)1.3;
  check_note("polytropic");
  check_run(&p, PNEU_GAS_POLYTROPIC, PNEU_FLOW_CHOKED);
  check_note("energy");
  check_run(&p, PNEU_GAS_ENERGY, PNEU_FLOW_ISO6358);
}

/* With one effect at its usual size, but for a parameter that is 0 (NULL: none), under every gas law. */
static void check_effect_without(const char *name, const char *param)
{
  const int e = pneu_effect_find(name);
  int gas, k, count;
  if (e < 0)
    skip();
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    for (pneu_effect_params(e, &count), k = 0; k < count; k++)
      *pneu_param_at(&p, pneu_effect_params(e, NULL) + k) = pneu_effect_at(e)->param[k].value;
    if (strcmp(name, "stribeck_friction") == 0)
      fixture_set(&p, "stribeck_velocity", 0.05); /* without stick-slip: that makes a thousand events */
    if (param)
      fixture_set(&p, param, 0);
    check_note("%s without %s, %s", name, param ? param : "nothing", pneu_gas_key(gas));
    check_run(&p, gas, PNEU_FLOW_PAPER);
  }
}

static void check_effect(const char *name)
{
  check_effect_without(name, NULL);
}

TEST(test_chamber_exponent__run__keeps_mass_and_energy)
{
  check_effect("chamber_exponent");
}

TEST(test_chamber_leak__run__keeps_mass_and_energy)
{
  check_effect("chamber_leak");
}

TEST(test_choked_flow__run__keeps_mass_and_energy)
{
  check_effect("choked_flow");
}

TEST(test_heat_transfer__run__keeps_mass_and_energy)
{
  check_effect("heat_transfer");
}

TEST(test_connecting_tube__run__keeps_mass_and_energy)
{
  check_effect("connecting_tube");
}

/* With a volume at the transducer, and in series with it. */
TEST(test_supply_droop__run__keeps_mass_and_energy)
{
  check_effect("supply_droop");
  check_effect_without("supply_droop", "supply_volume");
}

/* What a resistance lets into the volume behind it is there, in the chamber or gone through the vent. */
TEST(test_supply_droop__volume__keeps_mass)
{
  const double R = 2e8, V = 5e-5;
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int gas;
  fixture_need("supply_droop");
  fixture_set(&p, "supply_resistance", R);
  fixture_set(&p, "supply_volume", V);
  p.supply_temperature = 320;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    const pneu_model m = fixture_model(&p, gas, PNEU_FLOW_CHOKED);
    const double in_line = V * (double)m.scale[0] / ((double)p.gas_constant * 320);
    const pneu_input shut = fixture_input(&m, 0);
    pneu_state start = fixture_rest(&m, 0, 0, &shut), end;
    audit a;
    double gone, stored;
    start.extra[0] = (pneu_real)0.7;
    end = start;
    a = run(&m, &end);
    gone = (a.mass_turned_over - a.mass) / 2;
    stored = (double)(pneu_mass(&m, &end) - pneu_mass(&m, &start)) + in_line * (double)(end.extra[0] - start.extra[0]);
    check_note("%s", pneu_gas_key(gas));
    assert_true(gone > 1e-4 && stored > 1e-5);
    assert_close(stored, a.supply_lost / R - gone, TOL(1e-8, 2e-3) * a.mass_turned_over, 0);
  }
}

TEST(test_transducer_lag__run__keeps_mass_and_energy)
{
  check_effect("transducer_lag");
}

TEST(test_vent_restriction__run__keeps_mass_and_energy)
{
  check_effect("vent_restriction");
}

TEST(test_stribeck_friction__run__keeps_mass_and_energy)
{
  check_effect("stribeck_friction");
}

/* A force over position gives back at the lower stop what it took. */
TEST(test_free_terms__run__keep_mass_and_energy)
{
  static const pneu_term term[] = {
      {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 5, 0, (pneu_real)0.02, {0, 50, 300, -100, 0}},
      {PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, 4, 0, (pneu_real)0.02, {0, 200, -100, 400}},
      {PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 3, 0, 400000, {(pneu_real)1e-5, 0, (pneu_real)-2e-5}},
      {PNEU_TERM_HEAT, PNEU_TERM_OVER_OPENING, 3, -1, 1, {-3, 1, 2}}};
  int gas, n;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (n = 1; n <= COUNT(term); n++) {
      pneu_model m = fixture_r1_400(gas, PNEU_FLOW_CHOKED);
      assert_int_equal(pneu_model_terms(&m, term, n), PNEU_OK);
      check_note("%d terms, %s", n, pneu_gas_key(gas));
      check_model(&m);
    }
}
