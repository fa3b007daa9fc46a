/* Every effect: its record, its neutral value, the channel it acts on, and the direction. */
#include "fixture.h"
#include "../lib/internal.h"

enum { SAMPLES = 320 };

static const char *const names[] = {
#define PNEU_EFFECT(name, n_param, n_state) #name,
#include "../lib/effects.def"
#undef PNEU_EFFECT
    NULL};

static int has_text(const char *s)
{
  return s && s[0];
}

/* ---- records ---- */

static void test_pneu_effect_at__each__has_a_complete_record(void **state)
{
  static const char *const equations[] = {"mass", "energy", "force", "command", "sensor"};
  int e, i, known;
  (void)state;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const pneu_effect *effect = pneu_effect_at(e);
    check_note("%s", names[e]);
    assert_string_equal(effect->name, names[e]);
    assert_true(has_text(effect->what) && has_text(effect->source) && has_text(effect->footprint));
    for (i = known = 0; i < COUNT(equations); i++)
      known += strcmp(effect->equation, equations[i]) == 0;
    assert_int_equal(known, 1);
    assert_in_range(effect->stage, PNEU_STAGE_GEOMETRY, PNEU_STAGE_BRISTLE);
    assert_non_null(effect->add);
    assert_non_null(effect->param);
  }
}

static void test_pneu_effect_at__parameters__start_off_neutral_and_within_bounds(void **state)
{
  int e, k, count;
  (void)state;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    pneu_effect_params(e, &count);
    for (k = 0; k < count; k++) {
      const pneu_param_info *info = &pneu_effect_at(e)->param[k];
      check_note("%s.%s", names[e], info->name);
      assert_true(has_text(info->name) && has_text(info->unit) && has_text(info->meaning));
      assert_between(info->value, info->lower, info->upper);
      assert_between(info->neutral, info->lower, info->upper);
      assert_true(info->shape || info->value != info->neutral);
    }
    assert_false(pneu_effect_at(e)->param[0].shape);
  }
}

/* ---- neutral ---- */

static int standard(const pneu_params *p, int gas, int flow, double tol, fixture_sample *out)
{
  const pneu_model m = fixture_model(p, gas, flow);
  fixture_stretch stretch[3];
  pneu_state s;
  fixture_standard(&m, stretch);
  s = fixture_rest(&m, 0, 0, &stretch[0].input);
  memset(out, 0, SAMPLES * sizeof *out);
  return fixture_trace(&m, &s, stretch, 3, 0.1, tol, out, SAMPLES);
}

/* Base parameters with the forms of effect e changed, which must not matter while it is neutral. */
static pneu_params neutral_with_odd_shape(int e)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int k, count;
  const int first = pneu_effect_params(e, &count);
  for (k = 0; k < count; k++) {
    pneu_param_info info;
    pneu_param_describe(first + k, &info);
    *pneu_param_at(&p, first + k) = info.shape ? (info.lower + info.upper) / 2 : info.neutral;
  }
  return p;
}

static void test_pneu_run__each_effect_neutral__is_the_base_model_bit_for_bit(void **state)
{
  static fixture_sample base[SAMPLES], neutral[SAMPLES];
  int e, gas, flow;
  (void)state;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (flow = 0; flow < PNEU_FLOW_COUNT; flow++) {
      const pneu_params p = fixture_params(FIXTURE_R1_400);
      assert_int_equal(standard(&p, gas, flow, 1e-5, base) >= 305, 1);
      for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
        const pneu_params q = neutral_with_odd_shape(e);
        standard(&q, gas, flow, 1e-5, neutral);
        check_note("%s, %s, %s", names[e], pneu_gas_key(gas), pneu_flow_key(flow));
        assert_memory_equal(base, neutral, sizeof base);
      }
    }
}

#ifndef PNEU_SINGLE /* a millionth of an effect is below the rounding of float */
static double largest_difference(const fixture_sample *a, const fixture_sample *b, int n)
{
  double most = 0;
  int i;
  for (i = 0; i < n; i++)
    most = fmax(most, fmax(fabs(a[i].x - b[i].x) / 0.02, fabs(a[i].p - b[i].p) / 4e5));
  return most;
}

/* The base model is the limit of the effect, not a case apart. */
static void test_pneu_run__each_effect_nearly_neutral__is_nearly_the_base_model(void **state)
{
  static fixture_sample base[SAMPLES], small[SAMPLES];
  int e;
  (void)state;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    const pneu_param_info *info = &pneu_effect_at(e)->param[0];
    double far, near;
    const int n = standard(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1e-7, base);
    fixture_set(&p, info->name, info->value);
    standard(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1e-7, small);
    far = largest_difference(base, small, n);
    fixture_set(&p, info->name, info->neutral + 1e-3 * (info->value - info->neutral));
    standard(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1e-7, small);
    near = largest_difference(base, small, n);
    check_note("%s: %g at full size, %g at a thousandth", names[e], far, near);
    assert_between(far, 1e-6, 2);
    assert_between(near, 0, 0.02 * far + 1e-5);
  }
}
#endif

/* ---- which channel ---- */

static int acts_on(int e, const char *equation)
{
  return strcmp(pneu_effect_at(e)->equation, equation) == 0;
}

static pneu_params switched_on(int e)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  *pneu_param_at(&p, pneu_effect_params(e, NULL)) = pneu_effect_at(e)->param[0].value;
  return p;
}

/* Run 1 s with one side of the model given. */
static pneu_state run_with_given(const pneu_params *p, int gas, int pressure, int position)
{
  const pneu_model m = fixture_model_roles(p, gas, PNEU_FLOW_PAPER, pressure, position);
  pneu_input input = fixture_input(&m, 0.5);
  pneu_state s = fixture_rest(&m, 1e5, 0.002, &input);
  input.pressure_rate = (pneu_real)1e5;
  input.position_rate = (pneu_real)0.01;
  fixture_run(&m, &s, &input, 1, TOL(1e-8, 1e-5), NULL);
  return s;
}

static void test_pneu_run__effect_of_mass_energy_or_command__leaves_the_force_balance(void **state)
{
  int e, gas;
  (void)state;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
      const pneu_params base = fixture_params(FIXTURE_R1_400), p = switched_on(e);
      const pneu_state a = run_with_given(&base, gas, 1, 0), b = run_with_given(&p, gas, 1, 0);
      if (acts_on(e, "force"))
        continue;
      check_note("%s, %s", names[e], pneu_gas_key(gas));
      assert_close(b.x, a.x, TOL(1e-9, 1e-6), 0);
      assert_int_equal(a.mode, b.mode);
    }
}

static void test_pneu_run__effect_of_force__leaves_the_balances_of_the_gas(void **state)
{
  int e, gas;
  (void)state;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
      const pneu_params base = fixture_params(FIXTURE_R1_400), p = switched_on(e);
      const pneu_state a = run_with_given(&base, gas, 0, 1), b = run_with_given(&p, gas, 0, 1);
      if (!acts_on(e, "force"))
        continue;
      check_note("%s, %s", names[e], pneu_gas_key(gas));
      assert_close(b.p, a.p, TOL(0.01, 10), 0);
      assert_close(b.T, a.T, TOL(1e-5, 0.01), 0);
    }
}

/* ---- footprints: closed forms where there are some ---- */

static pneu_state run_vessel(const pneu_params *p, int gas, int flow, double from, double u, double time)
{
  const pneu_model m = fixture_model(p, gas, flow);
  const pneu_input shut = fixture_input(&m, 0), input = fixture_input(&m, u);
  pneu_state s = fixture_rest(&m, from, 0, &shut);
  fixture_run(&m, &s, &input, time, FIXTURE_TOL, NULL);
  return s;
}

/* Choked leak from a shut isothermal vessel: exponential at the rate of its area. */
static void footprint_chamber_leak(void)
{
  pneu_params p = fixture_vessel(1e-4);
  const double g = 1.4, R = (double)p.gas_constant, T = 298.15, pa = (double)p.ambient_pressure;
  const double c = sqrt(g / R) * pow(2 / (g + 1), (g + 1) / (2 * (g - 1)));
  pneu_state s;
  fixture_set(&p, "leak_area", 2e-8);
  s = run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 5e5, 0, 10);
  assert_close((double)s.p + pa, (5e5 + pa) * exp(-2e-8 * c * R * sqrt(T) / 1e-4 * 10), 0, TOL(1e-8, 1e-4));
  s = run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, -3e4, 0, 1);
  assert_between(s.p, -3e4 + 1, 0);
  {
    const pneu_model m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 1, 0);
    const pneu_input input = fixture_input(&m, 0);
    s = fixture_rest(&m, 2e5, 0, &input);
    assert_close(fixture_look(&m, &s, &input).out, 0, 0, 0);
  }
}

static double inflow(const pneu_params *p, int flow, double pressure)
{
  const pneu_model m = fixture_model(p, PNEU_GAS_ISOTHERMAL, flow);
  const pneu_input input = fixture_input(&m, 1);
  const pneu_state s = fixture_rest(&m, pressure, 0, &input);
  return fixture_look(&m, &s, &input).in;
}

static void footprint_choked_flow(void)
{
  static const double pressure[] = {0, 1.5e5, 3e5};
  const pneu_params base = fixture_vessel(1e-4);
  pneu_params p = base;
  int i;
  for (i = 0; i < COUNT(pressure); i++) {
    const double paper = inflow(&base, PNEU_FLOW_PAPER, pressure[i]);
    const double nozzle = inflow(&base, PNEU_FLOW_CHOKED, pressure[i]);
    fixture_set(&p, "choked_share", 1);
    assert_close(inflow(&p, PNEU_FLOW_PAPER, pressure[i]), nozzle, 0, TOL(1e-14, 1e-6));
    fixture_set(&p, "choked_share", 0.25);
    assert_close(inflow(&p, PNEU_FLOW_PAPER, pressure[i]), 0.75 * paper + 0.25 * nozzle, 0, TOL(1e-14, 1e-6));
    assert_true(nozzle < paper);
  }
  {
    const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    const pneu_input input = fixture_input(&m, 1);
    pneu_state s = fixture_rest(&m, 0, 0, &input);
    assert_true(fixture_look(&m, &s, &input).choked);
    s = fixture_rest(&m, 3e5, 0, &input);
    assert_false(fixture_look(&m, &s, &input).choked);
  }
}

static void footprint_supply_droop(void)
{
  const pneu_params base = fixture_vessel(1e-4);
  pneu_params p = base;
  const double resistance = 5e7, pa = (double)base.ambient_pressure;
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_sample look;
  pneu_flow flow;
  fixture_set(&p, "supply_resistance", resistance);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  input = fixture_input(&m, 1);
  s = fixture_rest(&m, 2e5, 0, &input);
  look = fixture_look(&m, &s, &input);
  pneu_orifice(&m, PNEU_FLOW_CHOKED, (pneu_real)1e-6, (pneu_real)(4e5 + pa - resistance * look.in),
               p.supply_temperature, (pneu_real)(2e5 + pa), &flow);
  assert_close(look.in, flow.q, 0, TOL(1e-9, 1e-4));
  assert_close(look.supply, 4e5 - resistance * look.in, TOL(1e-6, 1), 0);
  assert_true(look.in < 0.99 * inflow(&base, PNEU_FLOW_CHOKED, 2e5));
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 4e5, -1, 0.1).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 4e5, -1, 0.1).p, TOL(1e-3, 10), 0);
}

/* In a vessel time enters by the integral of the opening alone: t becomes t - tau (1 - exp(-t/tau)). */
static void footprint_transducer_lag(void)
{
  static const double at[] = {0.005, 0.02, 0.08};
  const pneu_params base = fixture_vessel(1e-3);
  pneu_params p = base;
  const double tau = 0.02;
  int i, vent;
  fixture_set(&p, "transducer_time", tau);
  for (i = 0; i < COUNT(at); i++)
    for (vent = 0; vent < 2; vent++) {
      const double t = at[i], start = vent ? 4e5 : 0, u = vent ? -1 : 1;
      const pneu_state late = run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, start, u, t);
      const pneu_state prompt =
          run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, start, u, t - tau * (1 - exp(-t / tau)));
      check_note("t = %g s, vent %d", t, vent);
      assert_close(late.p, prompt.p, TOL(0.01, 50), 0);
      assert_close(late.extra[0], u * (1 - exp(-t / tau)), TOL(1e-8, 1e-4), 0);
    }
  {
    const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    const pneu_input half = fixture_input(&m, 0.5);
    const pneu_state rest = fixture_rest(&m, 0, 0, &half);
    assert_close(fixture_look(&m, &rest, &half).opening, 0.5, 0, 0);
  }
}

/* Venting takes 1/(1 - r) of the time, filling what it took. */
static void footprint_vent_restriction(void)
{
  const pneu_params base = fixture_vessel(1e-3);
  pneu_params p = base;
  fixture_set(&p, "vent_restriction", 0.2);
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 4e5, -1, 0.5).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 4e5, -1, 0.4).p, TOL(0.01, 20), 0);
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1, 0.5).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1, 0.5).p, TOL(0.01, 20), 0);
}

static double break_away(const pneu_params *p)
{
  const pneu_model m = fixture_model_roles(p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 0);
  pneu_input input = fixture_input(&m, 0);
  pneu_state s;
  fixture_events e;
  input.pressure_rate = (pneu_real)1e4;
  s = fixture_rest(&m, 1e5, 0, &input);
  fixture_run(&m, &s, &input, 2.5, TOL(1e-7, 1e-5), &e);
  assert_true(e.n > 0);
  return e.p[0];
}

static void footprint_stribeck_friction(void)
{
  static const double v[] = {1e-4, -1e-3, 3e-3, 0.1};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  int i;
  fixture_set(&p, "stribeck_excess", 0.25);
  fixture_set(&p, "stribeck_velocity", 2e-3);
  assert_close(break_away(&p), (4e5 * 0.01 + 480 * 1.25) / 0.04, TOL(1e-4, 20), 0);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  input = fixture_input(&m, 0);
  s = fixture_rest(&m, 2e5, 0.01, &input);
  for (i = 0; i < COUNT(v); i++) {
    s.v = (pneu_real)v[i];
    s.mode = v[i] > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN;
    assert_close(fixture_look(&m, &s, &input).friction, 480 * (1 + 0.25 * exp(-v[i] * v[i] / 4e-6)), 0,
                 TOL(1e-13, 1e-6));
  }
}

/* A shut vessel off wall temperature: m c_v T' = G (T_w - T) + c (rho/rho_a)^(2/3) |T_w - T|^(4/3). */
static double warmed(const pneu_params *p, int gas, double T0, double t)
{
  const pneu_model m = fixture_model(p, gas, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  pneu_state s;
  assert_int_equal(pneu_state_rest(&m, (pneu_real)2e5, (pneu_real)T0, 0, &input, &s), PNEU_OK);
  fixture_run(&m, &s, &input, t, FIXTURE_TOL, NULL);
  return (double)s.T;
}

static void footprint_heat_transfer(void)
{
  const pneu_params base = fixture_vessel(1e-3);
  pneu_params p = base;
  const double R = (double)base.gas_constant, T0 = 250, dT = 298.15 - T0;
  const double density = (2e5 / (double)base.ambient_pressure + 1) * 298.15 / T0, c = 0.5 * pow(density, 2 / 3.);
  const double mcv = (2e5 + (double)base.ambient_pressure) * 1e-3 / (R * T0) * R / 0.4;
  const pneu_state fast = run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 4e5, -1, 1);
  pneu_state s;
  pneu_model m;
  pneu_input shut;
  p.polytropic_index = (pneu_real)1.2; /* must not matter */
  fixture_set(&p, "film_conductance", 2);
  assert_close(warmed(&p, PNEU_GAS_ENERGY, T0, 1), 298.15 - dT * exp(-2 / mcv), 0, TOL(1e-9, 1e-5));
  fixture_set(&p, "film_conductance", 0);
  fixture_set(&p, "film_resistance", 0.5);
  assert_close(warmed(&p, PNEU_GAS_ISOTHERMAL, T0, 1), 298.15 - dT * exp(-2 / mcv), 0, TOL(1e-9, 1e-5));
  fixture_set(&p, "film_resistance", 0);
  fixture_set(&p, "free_convection", 0.5);
  assert_close(warmed(&p, PNEU_GAS_ENERGY, T0, 1), 298.15 - pow(pow(dT, -1 / 3.) + c / (3 * mcv), -3), 0,
               TOL(1e-9, 1e-5));
  /* vent fast, shut: the cold gas warms and its pressure rises to p T_w/T */
  fixture_set(&p, "film_conductance", 2);
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  shut = fixture_input(&m, 0);
  s = fast;
  fixture_run(&m, &s, &shut, 30, FIXTURE_TOL, NULL);
  assert_true(fast.T < 280);
  assert_close((double)s.p + 101325, ((double)fast.p + 101325) * 298.15 / (double)fast.T, 0, TOL(1e-7, 1e-4));
}

/* A film of the energy law does nothing under the other laws, a resistance nothing under any but the isothermal. */
static void test_heat_transfer__parameter_of_another_law__does_not_act(void **state)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  (void)state;
  if (fixture_effect("heat_transfer") < 0)
    skip();
  fixture_set(&p, "film_conductance", 2);
  fixture_set(&p, "free_convection", 2);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).n_active, 0);
  fixture_set(&p, "film_resistance", 0.5);
  assert_int_equal(fixture_model(&p, PNEU_GAS_POLYTROPIC, PNEU_FLOW_PAPER).n_active, 0);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).n_active, 1);
  p = fixture_params(FIXTURE_R1_400);
  fixture_set(&p, "film_resistance", 0.5);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER).n_active, 0);
}

/* Canudas de Wit 1995: z' = v - |v| z F/F(v) over d, friction F z + s1 d z', here with Stribeck's F(v). */
static void check_bristle(double v, double z)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double F = 480, d = 2e-5, s1 = 800, excess = fixture_effect("stribeck_friction") < 0 ? 0 : 0.4;
  const double level = F * (1 + excess * exp(-v * v / 1e-4)), slip = v - fabs(v) * z * F / level;
  pneu_model m;
  pneu_input input;
  pneu_state s;
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  fixture_set(&p, "presliding_length", d);
  fixture_set(&p, "bristle_damping", s1);
  if (excess > 0) {
    fixture_set(&p, "stribeck_excess", excess);
    fixture_set(&p, "stribeck_velocity", 1e-2);
  }
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  input = fixture_input(&m, 0);
  s = fixture_rest(&m, 2e5, 0.012, &input);
  s.v = (pneu_real)v;
  s.extra[0] = (pneu_real)z;
  s.mode = PNEU_MODE_FREE;
  assert_int_equal(pneu_pack(&m, &s, y), 4);
  assert_int_equal(pneu_rhs(&m, &s, &input, y, f), PNEU_OK);
  check_note("v = %g, z = %g", v, z);
  assert_close(f[1], slip / d, 1e-9, TOL(1e-12, 1e-5));
  assert_close(f[3], (2e5 * 0.04 - 4e5 * 0.022 - 1500 * v - F * z - s1 * slip) / 2, TOL(1e-9, 1e-2), TOL(1e-12, 1e-5));
}

static void test_presliding__moving__friction_is_that_of_lugre(void **state)
{
  (void)state;
  if (fixture_effect("presliding") < 0)
    skip();
  check_bristle(3e-3, 0.3);
  check_bristle(-3e-3, 0.3);
  check_bristle(0.05, -0.8);
  check_bristle(0, 0.5);
}

/* Bristles bent on the way down help the stem up from the lower stop: it leaves at k x_0 - F. */
static void test_presliding__at_a_stop__bristles_stay_bent(void **state)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_events e;
  (void)state;
  if (fixture_effect("presliding") < 0)
    skip();
  fixture_set(&p, "presliding_length", 2e-5);
  m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 0);
  input = fixture_input(&m, 0);
  s = fixture_rest(&m, 1.5e5, 0.004, &input);
  input.pressure_rate = (pneu_real)-1e5;
  fixture_run(&m, &s, &input, 1, TOL(1e-7, 1e-4), NULL);
  assert_int_equal(s.mode, PNEU_MODE_LOWER);
  input.pressure_rate = (pneu_real)1e5;
  fixture_run(&m, &s, &input, 0.6, TOL(1e-7, 1e-4), &e);
  assert_true(e.n > 0 && e.before[0] == PNEU_MODE_LOWER);
  assert_close(e.p[0], (4e5 * 0.01 - 480) / 0.04, 100, 0);
}

static void test_pneu_run__two_effects_with_states__each_keeps_its_own(void **state)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  (void)state;
  if (fixture_effect("presliding") < 0 || fixture_effect("transducer_lag") < 0)
    skip();
  fixture_set(&p, "presliding_length", 2e-5);
  fixture_set(&p, "transducer_time", 0.5);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  input = fixture_input(&m, 0);
  s = fixture_rest(&m, 1.2e5, 0.001, &input);
  input.u = 1;
  fixture_run(&m, &s, &input, 0.4, TOL(1e-7, 1e-5), NULL);
  assert_int_equal(m.n_extra, 2);
  assert_close(fixture_look(&m, &s, &input).opening, 1 - exp(-0.4 / 0.5), TOL(1e-6, 1e-4), 0);
  assert_close(s.extra[m.state_of[fixture_effect("presliding")]], 1, 0.02, 0);
}

/* Quasi-static from z = 0: dz/dx = (1 - z)/d, so that x = -d ln(1 - force/F) before break-away. */
static void footprint_presliding(void)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double d = 2e-5;
  pneu_model m;
  pneu_input input;
  pneu_state s;
  p.spring_rate = 0;
  fixture_set(&p, "presliding_length", d);
  m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 0);
  input = fixture_input(&m, 0);
  input.pressure_rate = 600;
  s = fixture_rest(&m, 0, 0.01, &input);
  fixture_run(&m, &s, &input, 10, TOL(1e-9, 1e-5), NULL);
  assert_int_equal(s.mode, PNEU_MODE_FREE);
  assert_close((double)s.x - 0.01, -d * log(1 - 6000 * 0.04 / 480), 0, TOL(0.01, 0.05));
  fixture_run(&m, &s, &input, 15, TOL(1e-9, 1e-5), NULL);
  assert_true((double)s.x > 0.0105);
}

static const struct {
  const char *name;
  void (*check)(void);
} footprints[] = {
    {"chamber_leak", footprint_chamber_leak},           {"choked_flow", footprint_choked_flow},
    {"heat_transfer", footprint_heat_transfer},         {"presliding", footprint_presliding},
    {"stribeck_friction", footprint_stribeck_friction}, {"supply_droop", footprint_supply_droop},
    {"transducer_lag", footprint_transducer_lag},       {"vent_restriction", footprint_vent_restriction},
};

static void footprint(const char *name)
{
  int i;
  if (fixture_effect(name) < 0)
    skip();
  check_note("%s", name);
  for (i = 0; i < COUNT(footprints); i++)
    if (strcmp(footprints[i].name, name) == 0)
      footprints[i].check();
}

static void test_effects_def__each_effect__has_a_footprint_test(void **state)
{
  int e, i, found;
  (void)state;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    for (i = found = 0; i < COUNT(footprints); i++)
      found += strcmp(footprints[i].name, names[e]) == 0;
    if (!found)
      fail_msg("no footprint test for %s", names[e]);
  }
}

static void test_chamber_leak__shut_vessel__loses_pressure_as_a_choked_blowdown(void **state)
{
  (void)state;
  footprint("chamber_leak");
}

static void test_choked_flow__share__mixes_the_laws(void **state)
{
  (void)state;
  footprint("choked_flow");
}

static void test_heat_transfer__shut_vessel__levels_temperature_and_pressure_recovers(void **state)
{
  (void)state;
  footprint("heat_transfer");
}

static void test_presliding__before_break_away__stem_moves_by_micrometres(void **state)
{
  (void)state;
  footprint("presliding");
}

static void test_stribeck_friction__at_rest_and_sliding__raises_the_level_as_declared(void **state)
{
  (void)state;
  footprint("stribeck_friction");
}

static void test_supply_droop__filling__is_slowed_and_venting_is_not(void **state)
{
  (void)state;
  footprint("supply_droop");
}

static void test_transducer_lag__vessel__runs_late_by_the_integral_of_the_lag(void **state)
{
  (void)state;
  footprint("transducer_lag");
}

static void test_vent_restriction__venting__takes_longer_and_filling_does_not(void **state)
{
  (void)state;
  footprint("vent_restriction");
}

/* ---- all at once ---- */

static void test_pneu_run__all_effects_together__stays_physical(void **state)
{
  static fixture_sample s[SAMPLES];
  int gas, i, e, n;
  (void)state;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    for (e = 0; e < PNEU_EFFECT_COUNT; e++)
      *pneu_param_at(&p, pneu_effect_params(e, NULL)) = pneu_effect_at(e)->param[0].value;
    n = standard(&p, gas, PNEU_FLOW_PAPER, TOL(1e-6, 1e-4), s);
    check_note("%s", pneu_gas_key(gas));
    assert_true(n >= 305);
    for (i = 0; i < n; i++) {
      assert_between(s[i].p, -1e3, 4.01e5);
      assert_between(s[i].x, -1e-6, 0.02 + 1e-6);
      assert_between(s[i].T, 150, 600);
    }
    assert_between(s[150].x, 0.015, 0.02 + 1e-6);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_pneu_effect_at__each__has_a_complete_record),
      cmocka_unit_test(test_pneu_effect_at__parameters__start_off_neutral_and_within_bounds),
      cmocka_unit_test(test_pneu_run__each_effect_neutral__is_the_base_model_bit_for_bit),
#ifndef PNEU_SINGLE
      cmocka_unit_test(test_pneu_run__each_effect_nearly_neutral__is_nearly_the_base_model),
#endif
      cmocka_unit_test(test_pneu_run__effect_of_mass_energy_or_command__leaves_the_force_balance),
      cmocka_unit_test(test_pneu_run__effect_of_force__leaves_the_balances_of_the_gas),
      cmocka_unit_test(test_effects_def__each_effect__has_a_footprint_test),
      cmocka_unit_test(test_chamber_leak__shut_vessel__loses_pressure_as_a_choked_blowdown),
      cmocka_unit_test(test_choked_flow__share__mixes_the_laws),
      cmocka_unit_test(test_heat_transfer__shut_vessel__levels_temperature_and_pressure_recovers),
      cmocka_unit_test(test_presliding__before_break_away__stem_moves_by_micrometres),
      cmocka_unit_test(test_stribeck_friction__at_rest_and_sliding__raises_the_level_as_declared),
      cmocka_unit_test(test_supply_droop__filling__is_slowed_and_venting_is_not),
      cmocka_unit_test(test_transducer_lag__vessel__runs_late_by_the_integral_of_the_lag),
      cmocka_unit_test(test_vent_restriction__venting__takes_longer_and_filling_does_not),
      cmocka_unit_test(test_heat_transfer__parameter_of_another_law__does_not_act),
      cmocka_unit_test(test_presliding__moving__friction_is_that_of_lugre),
      cmocka_unit_test(test_presliding__at_a_stop__bristles_stay_bent),
      cmocka_unit_test(test_pneu_run__two_effects_with_states__each_keeps_its_own),
      cmocka_unit_test(test_pneu_run__all_effects_together__stays_physical),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
