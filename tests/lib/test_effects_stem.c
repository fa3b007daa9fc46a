/* Effects on the force balance: what each does to break-away, to where the stem rests, to its acceleration. */
#include "../footprint.h"

/* ---- what the tests measure ---- */

/* Pressure at which a stem at rest at x first moves while pressure runs from `from` at the given slope. */
static double break_away_from(const pneu_params *p, double x, double from, double slope)
{
  fixture_rig rig = fixture_at(fixture_pressed(p), 0, from, x);
  fixture_events e;
  rig.input.pressure_rate = (pneu_real)slope;
  fixture_go(&rig, fabs(3e4 / slope), TOL(1e-7, 1e-5), &e);
  assert_true(e.n > 0);
  return e.p[0];
}

static double break_away(const pneu_params *p)
{
  return break_away_from(p, 0, 1e5, 1e4);
}

/* Where a stem without dry friction comes to rest under a held pressure. */
static pneu_state balance(const pneu_params *p, double pressure, double from)
{
  pneu_params smooth = *p;
  fixture_rig rig;
  smooth.dry_friction = 0;
  rig = fixture_at(fixture_pressed(&smooth), 0, pressure, from);
  fixture_go(&rig, 2, TOL(1e-9, 1e-5), NULL);
  return rig.s;
}

/* Acceleration of a sliding stem. */
static double acceleration(const pneu_model *m, double pressure, double x, double v, double z)
{
  const pneu_input input = fixture_input(m, 0);
  pneu_state s = fixture_rest(m, pressure, 0.01, &input);
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  int n;
  s.x = (pneu_real)x;
  s.v = (pneu_real)v;
  s.extra[0] = (pneu_real)z;
  s.mode = v > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN;
  n = pneu_pack(m, &s, y);
  assert_int_equal(pneu_rhs(m, &s, &input, y, f), PNEU_OK);
  return (double)f[n - 1];
}

/* ---- friction ---- */

FOOTPRINT(stribeck_friction, at_rest_and_sliding__raises_the_level_as_declared)
{
  static const double v[] = {1e-4, -1e-3, 3e-3, 0.1};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  int i;
  fixture_set(&p, "stribeck_excess", 0.25);
  fixture_set(&p, "stribeck_velocity", 2e-3);
  assert_close(break_away(&p), (4e5 * 0.01 + 480 * 1.25) / 0.04, TOL(1e-4, 20), 0);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 2e5, 0.01);
  for (i = 0; i < COUNT(v); i++) {
    rig.s.v = (pneu_real)v[i];
    rig.s.mode = v[i] > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN;
    assert_close(fixture_see(&rig).friction, 480 * (1 + 0.25 * exp(-v[i] * v[i] / 4e-6)), 0, TOL(1e-13, 1e-6));
  }
}

/* Level F (1 + a x/stroke) wherever the stem stands; at the upper stop it lets go at k (x + x0) - F (1 + a). */
FOOTPRINT(friction_position, level_and_break_away__depend_on_position)
{
  static const double x[] = {0, 0.004, 0.02};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int i;
  fixture_set(&p, "friction_slope", 0.8);
  for (i = 0; i < COUNT(x); i++) {
    const fixture_rig rig =
        fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 4e5 * (x[i] + 0.01) / 0.04, x[i]);
    assert_close(fixture_see(&rig).friction, 480 * (1 + 0.8 * x[i] / 0.02), 0, TOL(1e-13, 1e-6));
  }
  assert_close(break_away(&p), (4e5 * 0.01 + 480) / 0.04, TOL(1e-4, 20), 0);
  assert_close(break_away_from(&p, 0.02, 2.9e5, -1e4), (4e5 * 0.03 - 480 * 1.8) / 0.04, TOL(1e-4, 20), 0);
  fixture_set(&p, "friction_slope", -1); /* none at the upper stop, nor beyond it */
  {
    fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 3e5, 0.02);
    rig.s.x = (pneu_real)0.0201;
    assert_close(fixture_see(&rig).friction, 0, 0, 0);
  }
  assert_close(break_away_from(&p, 0.02, 3.1e5, -1e4), 4e5 * 0.03 / 0.04, TOL(1e-4, 20), 0);
}

/* The stem leaves the lower stop at p A = k x0 + F + f p; below ambient pressure friction is F. */
FOOTPRINT(friction_pressure, break_away__depends_on_pressure)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double f = 2e-3;
  fixture_rig rig;
  fixture_set(&p, "friction_per_pressure", f);
  assert_close(break_away(&p), (4e5 * 0.01 + 480) / (0.04 - f), TOL(1e-4, 20), 0);
  assert_close(break_away_from(&p, 0.02, 2.9e5, -1e4), (4e5 * 0.03 - 480) / (0.04 + f), TOL(1e-4, 20), 0);
  rig = fixture_at(fixture_pressed(&p), 0, -2e4, 0);
  assert_close(fixture_see(&rig).friction, 480, 0, 0);
}

/* Canudas de Wit 1995: z' = v - |v| z F/F(v) over d, friction F z + s1 d z', here with Stribeck's F(v). */
static void check_bristle(double v, double z)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double F = 480, d = 2e-5, s1 = 800, excess = pneu_effect_find("stribeck_friction") < 0 ? 0 : 0.4;
  const double level = F * (1 + excess * exp(-v * v / 1e-4)), slip = v - fabs(v) * z * F / level;
  fixture_rig rig;
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  fixture_set(&p, "presliding_length", d);
  fixture_set(&p, "bristle_damping", s1);
  if (excess > 0) {
    fixture_set(&p, "stribeck_excess", excess);
    fixture_set(&p, "stribeck_velocity", 1e-2);
  }
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 2e5, 0.012);
  rig.s.v = (pneu_real)v;
  rig.s.extra[0] = (pneu_real)z;
  rig.s.mode = v < 0 ? PNEU_MODE_DOWN : PNEU_MODE_UP;
  assert_int_equal(pneu_pack(&rig.m, &rig.s, y), 4);
  assert_int_equal(pneu_rhs(&rig.m, &rig.s, &rig.input, y, f), PNEU_OK);
  check_note("v = %g, z = %g", v, z);
  assert_close(f[1], slip / d, 1e-9, TOL(1e-12, 1e-5));
  assert_close(f[3], (2e5 * 0.04 - 4e5 * 0.022 - 1500 * v - F * z - s1 * slip) / 2, TOL(1e-9, 1e-2), TOL(1e-12, 1e-5));
}

TEST(test_presliding__moving__friction_is_that_of_lugre)
{
  fixture_need("presliding");
  check_bristle(3e-3, 0.3);
  check_bristle(-3e-3, 0.3);
  check_bristle(0.05, -0.8);
  check_bristle(0, 0.5);
}

/* Bristles that carry no force bend as the others do: z ends at 1 where the stem goes on in one direction. */
TEST(test_presliding__no_friction__bristles_bend_all_the_way)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_need("presliding");
  p.dry_friction = 0;
  fixture_set(&p, "presliding_length", 2e-5);
  m = fixture_pressed(&p);
  input = fixture_input(&m, 0);
  input.pressure_rate = (pneu_real)1e4;
  s = fixture_rest(&m, 1.5e5, 0.005, &input);
  fixture_run(&m, &s, &input, 2, TOL(1e-7, 1e-4), NULL);
  assert_true((double)s.x > 0.006);
  assert_close(s.extra[0], 1, TOL(1e-5, 1e-3), 0);
}

/* Bristles bent on the way down help the stem up from the lower stop: it leaves at k x_0 - F. */
TEST(test_presliding__at_a_stop__bristles_stay_bent)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  fixture_events e;
  fixture_need("presliding");
  fixture_set(&p, "presliding_length", 2e-5);
  rig = fixture_at(fixture_pressed(&p), 0, 1.5e5, 0.004);
  rig.input.pressure_rate = (pneu_real)-1e5;
  fixture_go(&rig, 1, TOL(1e-7, 1e-4), NULL);
  assert_int_equal(rig.s.mode, PNEU_MODE_LOWER);
  rig.input.pressure_rate = (pneu_real)1e5;
  fixture_go(&rig, 0.6, TOL(1e-7, 1e-4), &e);
  assert_true(e.n > 0 && e.before[0] == PNEU_MODE_LOWER);
  assert_close(e.p[0], (4e5 * 0.01 - 480) / 0.04, 100, 0);
}

/* Quasi-static from z = 0: dz/dx = (1 - z)/d, so that x = -d ln(1 - force/F) before break-away. */
FOOTPRINT(presliding, before_break_away__stem_moves_by_micrometres)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double d = 2e-5;
  pneu_model m;
  pneu_input input;
  pneu_state s;
  p.spring_rate = 0;
  fixture_set(&p, "presliding_length", d);
  m = fixture_pressed(&p);
  input = fixture_input(&m, 0);
  input.pressure_rate = 600;
  s = fixture_rest(&m, 0, 0.01, &input);
  fixture_run(&m, &s, &input, 10, TOL(1e-9, 1e-5), NULL);
  assert_int_equal(s.mode, PNEU_MODE_UP);
  assert_close((double)s.x - 0.01, -d * log(1 - 6000 * 0.04 / 480), 0, TOL(0.01, 0.05));
  fixture_run(&m, &s, &input, 15, TOL(1e-9, 1e-5), NULL);
  assert_true((double)s.x > 0.0105);
}

/* A stem on bristles that has come to rest turns round a few times and then takes few steps, however stiff they are:
 * friction that holds it is a stiff spring on one side of v = 0 and hardly any on the other. */
TEST(test_presliding__at_rest__takes_few_steps)
{
  static const double length[] = {4e-7, 2e-5, 2e-4};
  int i;
  fixture_need("presliding");
  for (i = 0; i < COUNT(length); i++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    const pneu_options options = fixture_options(TOL(1e-5, 1e-4));
    pneu_workspace work = {0};
    fixture_rig rig;
    fixture_set(&p, "presliding_length", length[i]);
    rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 1, 1.5e5, 0.003);
    fixture_go(&rig, 2, TOL(1e-6, 1e-4), NULL);
    assert_true((double)rig.s.x > 0.005 && (double)rig.s.v > 0);
    rig.input = fixture_input(&rig.m, 0);
    assert_int_equal(pneu_run(&rig.m, &rig.s, &rig.input, 20, &options, NULL, &work), PNEU_OK);
    check_note("length %g: %ld steps, %ld refused", length[i], work.stats.steps, work.stats.rejected);
    assert_between((double)work.stats.steps, 10, 400);
    assert_between((double)work.stats.rejected, 0, 100);
    assert_between(fabs((double)rig.s.v), 0, 1e-5);
  }
}

/* It turns round where it moves against its direction by what is resolved, and keeps its velocity. */
TEST(test_pneu_switch__bristles__turns_round)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_real y[PNEU_STATE_MAX], g[PNEU_EVENT_MAX];
  fixture_rig rig;
  fixture_need("presliding");
  fixture_set(&p, "presliding_length", 2e-5);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 2e5, 0.012);
  rig.s.mode = PNEU_MODE_UP;
  rig.s.v = -2 * rig.m.velocity_resolved;
  pneu_pack(&rig.m, &rig.s, y);
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 2);
  assert_close(g[0], rig.m.velocity_resolved, 0, 1e-6);
  pneu_switch(&rig.m, &rig.input, 0, &rig.s);
  assert_int_equal(rig.s.mode, PNEU_MODE_DOWN);
  assert_true(rig.s.v == -2 * rig.m.velocity_resolved);
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 2);
  assert_true(g[0] < 0);
}

/* ---- spring ---- */

/* At rest p A = k (x + x0) + k3 x^3. */
FOOTPRINT(spring_hardening, balance__bends_with_the_cube)
{
  static const double cubic[] = {1e8, -1e8};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int i;
  for (i = 0; i < 2; i++) {
    double x;
    fixture_set(&p, "spring_cubic", cubic[i]);
    x = (double)balance(&p, 2.5e5, 0.01).x;
    assert_close(4e5 * (x + 0.01) + cubic[i] * x * x * x, 2.5e5 * 0.04, 0, TOL(1e-9, 1e-4));
  }
  assert_close(break_away(&p), (4e5 * 0.01 + 480) / 0.04, TOL(1e-4, 20), 0);
}

/* Over a travel s from z0 on: z = 1 - (1 - z0) exp(-s/d) upwards, -1 + (1 + z0) exp(-s/d) downwards; at rest it stays.
 */
FOOTPRINT(spring_hysteresis, reversals__follow_the_closed_form)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double d = 2e-3, F = 300, up = 1 - exp(-0.005 / d);
  fixture_rig rig;
  fixture_set(&p, "hysteresis_force", F);
  fixture_set(&p, "hysteresis_length", d);
  rig = fixture_at(fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 1), 0, 1e5, 0);
  rig.input.position_rate = (pneu_real)0.01;
  fixture_go(&rig, 0.5, FIXTURE_TOL, NULL);
  assert_close(rig.s.extra[0], up, TOL(1e-8, 1e-4), 0);
  rig.input.position_rate = (pneu_real)-0.02;
  fixture_go(&rig, 0.1, FIXTURE_TOL, NULL);
  assert_close(rig.s.extra[0], -1 + (1 + up) * exp(-0.002 / d), TOL(1e-8, 1e-4), 0);
  rig = fixture_at(fixture_pressed(&p), 0, 2e5, 0.01);
  rig.s.extra[0] = (pneu_real)0.7;
  fixture_go(&rig, 1, FIXTURE_TOL, NULL);
  assert_int_equal(rig.s.mode, PNEU_MODE_STUCK);
  assert_close(rig.s.extra[0], 0.7, 0, TOL(1e-15, 1e-7));
  assert_close(acceleration(&rig.m, 2e5, 0.01, 0.01, 0.7) - acceleration(&rig.m, 2e5, 0.01, 0.01, 0), -F * 0.7 / 2, 0,
               TOL(1e-10, 1e-3));
}

/* Driven at a velocity v from rest, y stays behind by v tau (1 - exp(-t/tau)); held, it comes after. At rest in
 * equilibrium nothing of it is left. */
FOOTPRINT(spring_creep, driven_and_held__follows_by_the_closed_form)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double k = 8e4, tau = 0.4, v = 0.01, stroke = (double)p.stroke, behind = v * tau * (1 - exp(-0.5 / tau));
  fixture_rig rig;
  fixture_set(&p, "creep_stiffness", k);
  fixture_set(&p, "creep_time", tau);
  rig = fixture_at(fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 1), 0, 1e5, 0);
  rig.input.position_rate = (pneu_real)v;
  fixture_go(&rig, 0.5, FIXTURE_TOL, NULL);
  assert_close(rig.s.extra[0], (0.005 - behind) / stroke, TOL(1e-9, 1e-5), 0);
  rig.input.position_rate = 0;
  fixture_go(&rig, 0.2, FIXTURE_TOL, NULL);
  assert_close(rig.s.extra[0], (0.005 - behind * exp(-0.2 / tau)) / stroke, TOL(1e-9, 1e-5), 0);
  rig = fixture_at(fixture_pressed(&p), 0, 2e5, 0.01);
  assert_close(rig.s.extra[0], 0.01 / stroke, 0, TOL(1e-15, 1e-6));
  assert_close(acceleration(&rig.m, 2e5, 0.01, 0.01, 0) - acceleration(&rig.m, 2e5, 0.01, 0.01, 0.01 / stroke),
               -k * 0.01 / 2, 0, TOL(1e-10, 1e-3));
}

/* ---- geometry ---- */

/* At rest p A (1 - a x/stroke) = k (x + x0); sealed air follows the integral of the swept area. */
FOOTPRINT(area_variation, balance_and_sealed_air__follow_the_area)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double a = 0.1, pa = (double)p.ambient_pressure;
  double x, volume;
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_set(&p, "area_loss", a);
  x = (double)balance(&p, 2e5, 0.01).x;
  assert_close(2e5 * 0.04 * (1 - a * x / 0.02), 4e5 * (x + 0.01), 0, TOL(1e-9, 1e-4));
  assert_close(break_away(&p), (4e5 * 0.01 + 480) / 0.04, TOL(1e-4, 20), 0);
  p.swept_ratio = (pneu_real)0.7;
  p.dead_volume = (pneu_real)1e-4;
  m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 1);
  volume = 1e-4 + 0.7 * 0.04 * 0.015 * (1 - a * 0.015 / 0.04);
  assert_close(pneu_volume(&m, (pneu_real)0.015), volume, 0, TOL(1e-14, 1e-6));
  input = fixture_input(&m, 0);
  input.position_rate = (pneu_real)0.015;
  s = fixture_rest(&m, 3e5, 0, &input);
  fixture_run(&m, &s, &input, 1, FIXTURE_TOL, NULL);
  assert_close((double)s.p + pa, (3e5 + pa) * 1e-4 / volume, 0, TOL(1e-8, 1e-4));
  assert_close(pneu_mass(&m, &s), (3e5 + pa) * 1e-4 / ((double)p.gas_constant * 298.15), 0, TOL(1e-8, 1e-4));
}

FOOTPRINT(travel_limit, filling__ends_short)
{
  const pneu_params base = fixture_params(FIXTURE_R1_400);
  pneu_params p = base;
  pneu_model m;
  pneu_input input;
  fixture_set(&p, "travel_loss", 3e-3);
  assert_close(balance(&p, 3e5, 0.01).x, 0.017, 0, TOL(1e-12, 1e-6));
  assert_int_equal(balance(&p, 3e5, 0.01).mode, PNEU_MODE_UPPER);
  assert_close(balance(&p, 2e5, 0.005).x, balance(&base, 2e5, 0.005).x, TOL(1e-9, 1e-6), 0);
  m = fixture_pressed(&p);
  input = fixture_input(&m, 0);
  assert_close(fixture_rest(&m, 3e5, 0.02, &input).x, 0.017, 0, TOL(1e-12, 1e-6));
  fixture_set(&p, "travel_loss", 0.5); /* more than there is: hardly any travel, and sound */
  assert_close(balance(&p, 3e5, 0).x, 2e-5, 0, TOL(1e-9, 1e-5));
}

/* On the lower stop c (k x0 - p A) = -x (1 + k c), on the upper one likewise; the stem sticks and slides there. */
FOOTPRINT(stop_compliance, stem_on_a_stop__sinks_in_by_the_load)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double c = 2e-8, k = 4e5;
  fixture_rig rig;
  p.dead_volume = (pneu_real)1e-4;
  fixture_set(&p, "stop_compliance", c);
  fixture_set(&p, "stop_damping", 1e4);
  rig = fixture_at(fixture_pressed(&p), 0, 0, 0);
  assert_close(rig.s.x, -c * k * 0.01 / (1 + k * c), 0, TOL(1e-9, 1e-4));
  assert_int_equal(rig.s.mode, PNEU_MODE_STUCK);
  assert_close(fixture_rest(&rig.m, 4e5, 0, &rig.input).x, 0, 0, 0); /* pushed away from the stop, not into it */
  assert_close(fixture_rest(&rig.m, 0, 0.02, &rig.input).x, (pneu_real)0.02, 0, 0);
  rig.s = fixture_rest(&rig.m, 4e5, 0.02, &rig.input);
  assert_close((double)rig.s.x - 0.02, c * (4e5 * 0.04 - k * 0.03) / (1 + k * c), TOL(0, 3e-9), TOL(1e-9, 1e-3));
  assert_close(fixture_rest(&rig.m, 4e5, 0, &rig.input).x, 0, 0, 0); /* the air lifts it off */
  assert_close(fixture_rest(&rig.m, 0, 0.02, &rig.input).x, 0.02, 0, TOL(1e-15, 1e-7));
  assert_close(balance(&p, 0, 0.001).x, -c * k * 0.01 / (1 + k * c), 0, TOL(1e-6, 1e-3));
  assert_close((double)balance(&p, 4e5, 0.015).x - 0.02, c * (4e5 * 0.04 - k * 0.03) / (1 + k * c), TOL(0, 3e-9),
               TOL(1e-6, 1e-2));
  /* contact 1/c s + d v, never pulling */
  assert_close(acceleration(&rig.m, 2e5, 0.0201, 0.01, 0), (8e3 - k * 0.0301 - 1500 * 0.01 - 480 - 1e-4 / c - 100) / 2,
               TOL(1e-6, 5), 0);
  assert_close(acceleration(&rig.m, 2e5, 0.0201, -1, 0), (8e3 - k * 0.0301 + 1500 + 480) / 2, TOL(1e-6, 5), 0);
  assert_close(acceleration(&rig.m, 2e5, -1e-4, -0.01, 0), (8e3 - k * 0.0099 + 15 + 480 + 1e-4 / c + 100) / 2,
               TOL(1e-6, 5), 0);
}

/* A soft stop under a small dead volume would leave the gas no room: a rigid stop lies at a tenth of it. */
TEST(test_stop_compliance__hardly_any_dead_volume__keeps_a_tenth_of_it)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  fixture_need("stop_compliance");
  fixture_set(&p, "stop_compliance", 1e-6);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), -1, 0, 0);
  assert_int_equal(rig.s.mode, PNEU_MODE_LOWER);
  assert_close(pneu_volume(&rig.m, rig.s.x), 0.1 * (double)p.dead_volume, 0, TOL(1e-9, 1e-4));
  rig.input.u = 1;
  fixture_go(&rig, 8, TOL(1e-6, 1e-4), NULL);
  rig.input.u = -1;
  fixture_go(&rig, 8, TOL(1e-6, 1e-4), NULL);
  assert_int_equal(rig.s.mode, PNEU_MODE_LOWER);
}

/* Behind a stop that hardly resists, rigid ones: above at twice the stroke, below at the stroke or, where the gas would
 * have no room, at a tenth of the dead volume. */
TEST(test_stop_compliance__hardly_any_resistance__ends_at_rigid_stops)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  fixture_need("stop_compliance");
  fixture_set(&p, "stop_compliance", 1e-4);
  p.swept_ratio = (pneu_real)0.5;
  p.spring_rate = (pneu_real)1e3;
  p.external_force = 4000;
  m = fixture_pressed(&p);
  input = fixture_input(&m, 0);
  assert_close(fixture_rest(&m, 4e5, 0.02, &input).x, 0.04, 0, TOL(1e-12, 1e-6));
  assert_close(pneu_volume(&m, fixture_rest(&m, 0, 0, &input).x), 0.1 * (double)p.dead_volume, 0, TOL(1e-9, 1e-4));
  p.dead_volume = (pneu_real)1e-2;
  m = fixture_pressed(&p);
  assert_close(fixture_rest(&m, 0, 0, &input).x, -0.02, 0, TOL(1e-12, 1e-6));
  m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0,
                          1); /* whoever drives the stem says where it is */
  input = fixture_input(&m, 0);
  assert_close(fixture_rest(&m, 0, 0, &input).x, 0, 0, 0);
}

/* On a stop as stiff as a block of steel the rounding of the position alone makes a force: the stem must not mind. */
TEST(test_stop_compliance__very_stiff__stem_rests_quietly)
{
  static const double compliance[] = {1e-8, 1e-10, 1e-12};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int i;
  fixture_need("stop_compliance");
  for (i = 0; i < COUNT(compliance); i++) {
    pneu_model m;
    fixture_set(&p, "stop_compliance", compliance[i]);
    m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    check_note("%g m/N", compliance[i]);
    assert_between(fixture_steps(&m), 1, 3000);
  }
  p.dry_friction = 0;
  p.dead_volume = (pneu_real)8.68e-5;
  fixture_set(&p, "stop_compliance", 5.73e-11);
  {
    const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
    assert_between(fixture_steps(&m), 1, 3000);
  }
}

/* The force of a stiff stop is not that of the whole stroke: in single precision a stem stuck to it by 2 kN. */
TEST(test_stop_compliance__very_stiff__stem_leaves_at_its_balance)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double balance = ((double)p.spring_rate * (double)p.spring_preload + (double)p.dry_friction) / (double)p.area;
  fixture_rig rig;
  int i;
  fixture_need("stop_compliance");
  fixture_set(&p, "stop_compliance", 1e-9);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), (double)1e-3, 0.9 * balance, 0);
  for (i = 0; i < 1000 && rig.s.x < (pneu_real)1e-5; i++)
    fixture_go(&rig, 1e-3, TOL(1e-6, 1e-4), NULL);
  assert_true(rig.s.x >= (pneu_real)1e-5);
  assert_close(rig.s.p, balance, 0, 0.02);
}

/* A stem that creeps into a soft stop as the supply is reached comes to rest there for good. */
TEST(test_stop_compliance__creeping_in__does_not_chatter)
{
  static const struct creep {
    double compliance, supply, dead_volume;
    int gas, flow;
  } creep[] = {{60 * 1e-9, 51e4, 16 * 1e-5, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED},
               {84 * 1e-9, 41e4, 16 * 1e-5, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER},
               {9 * 1e-9, 33e4, 18 * 1e-5, PNEU_GAS_POLYTROPIC, PNEU_FLOW_ISO6358},
               {79 * 1e-9, 43e4, 12 * 1e-5, PNEU_GAS_POLYTROPIC, PNEU_FLOW_CHOKED}};
  int i;
  fixture_need("stop_compliance");
  for (i = 0; i < COUNT(creep); i++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    pneu_model m;
    p.supply_pressure = (pneu_real)creep[i].supply;
    p.dead_volume = (pneu_real)creep[i].dead_volume;
    fixture_set(&p, "stop_compliance", creep[i].compliance);
    m = fixture_model(&p, creep[i].gas, creep[i].flow);
    check_note("%g m/N", creep[i].compliance);
    assert_between(fixture_steps(&m), 1, TOL(1000, 5000));
  }
}

TEST(test_effects_def__each_effect_on_the_stem__has_a_footprint_test)
{
  footprint_complete("force");
}
