/* The stem: forces, modes and events against closed forms. */
#include "../fixture.h"

/* A stem without spring and viscous terms, its pressure given. */
static pneu_params bare(void)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.spring_rate = p.viscous_friction = p.damping = 0;
  p.stroke = (pneu_real)0.1;
  return p;
}

/* ---- motion ---- */

/* From v_0 under pressure and friction: t = v_0/a, travel v_0^2/(2 a), a = (F - p A sgn v)/M. */
static void check_slide(double v0, double pressure)
{
  const pneu_params p = bare();
  const pneu_model m = fixture_pressed(&p);
  const pneu_input input = fixture_input(&m, 0);
  const double sign = v0 > 0 ? 1 : -1, a = (480 - sign * pressure * 0.04) / 2;
  pneu_state s = fixture_rest(&m, pressure, 0.05, &input);
  fixture_events e;
  s.v = (pneu_real)v0;
  fixture_run(&m, &s, &input, 0.1, FIXTURE_TOL, &e);
  check_note("v0 = %g m/s, p = %g Pa", v0, pressure);
  assert_int_equal(e.n, 1);
  assert_int_equal(e.before[0], v0 > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN);
  assert_int_equal(e.after[0], PNEU_MODE_STUCK);
  assert_close(e.t[0], fabs(v0) / a, TOL(1e-9, 3e-6), 0);
  assert_close(s.x, 0.05 + v0 * fabs(v0) / (2 * a), TOL(1e-10, 1e-6), 0);
  assert_true(s.v == 0 && s.mode == PNEU_MODE_STUCK);
}

TEST(test_pneu_run__coulomb_slide__stops_at_the_known_time_and_place)
{
  check_slide(0.5, 0);
  check_slide(-0.5, 0);
  check_slide(0.8, 6000);
  check_slide(-0.8, 6000);
  check_slide(0.01, -3000);
}

static void check_fall(double from, double to, double force)
{
  pneu_params p = bare();
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_events e;
  p.dry_friction = 0;
  p.external_force = (pneu_real)(force / 2);
  m = fixture_pressed(&p);
  input = fixture_input(&m, 0);
  input.force = (pneu_real)(force / 2);
  s = fixture_rest(&m, 0, from, &input);
  fixture_run(&m, &s, &input, 0.5, FIXTURE_TOL, &e);
  check_note("from %g m to %g m", from, to);
  assert_int_equal(e.n, 1);
  assert_int_equal(e.after[0], to > 0 ? PNEU_MODE_UPPER : PNEU_MODE_LOWER);
  assert_close(e.t[0], sqrt(2 * fabs(to - from) * 2 / fabs(force)), TOL(1e-9, 3e-5), 0);
  assert_true(s.x == (pneu_real)to && s.v == 0);
}

TEST(test_pneu_run__free_fall__reaches_the_stop_at_the_known_time)
{
  check_fall(0.1, 0, 2 * 9.80665);
  check_fall(0.03, 0, 2 * 9.80665);
  check_fall(0, 0.1, -2 * 9.80665);
  check_fall(0.06, 0.1, -2 * 9.80665);
}

/* M x'' = p A - k (x + x_0), undamped: a cosine about the balance. */
TEST(test_pneu_run__spring_and_mass__oscillates_at_its_natural_frequency)
{
  pneu_params p = bare();
  fixture_rig rig;
  const double w = sqrt(8e4 / 2);
  p.spring_rate = (pneu_real)8e4;
  p.spring_preload = (pneu_real)0.005;
  p.dry_friction = 0;
  rig = fixture_at(fixture_pressed(&p), 0, 8e4 * (0.05 + 0.005) / 0.04, 0.06);
  fixture_go(&rig, 0.1, FIXTURE_TOL, NULL);
  assert_close(rig.s.x, 0.05 + 0.01 * cos(w * 0.1), TOL(2e-8, 2e-3), 0);
  assert_close(rig.s.v, -0.01 * w * sin(w * 0.1), TOL(2e-6, 2e-1), 0);
}

/* Under a constant force against c v the velocity settles at force/c with time M/c. */
TEST(test_pneu_run__viscous_terms__add_up_and_set_the_final_velocity)
{
  pneu_params p = bare();
  fixture_rig rig;
  const double c = 30 + 70, F = (2e4 * 0.04 - 480), t = 0.03;
  p.viscous_friction = 30;
  p.damping = 70;
  p.stroke = 2;
  rig = fixture_at(fixture_pressed(&p), 0, 2e4, 0);
  fixture_go(&rig, t, FIXTURE_TOL, NULL);
  assert_close(rig.s.v, F / c * (1 - exp(-c * t / 2)), 0, TOL(1e-8, 1e-4));
  assert_close(rig.s.x, F / c * (t - 2 / c * (1 - exp(-c * t / 2))), 0, TOL(1e-8, 1e-4));
}

/* ---- break-away ---- */

/* Pressure at which the stem leaves x while pressure runs at `rate`. */
static double leaves_at(const pneu_params *p, double from, double x, double rate, double force)
{
  const pneu_model m = fixture_pressed(p);
  pneu_input input = fixture_input(&m, 0);
  pneu_state s;
  fixture_events e;
  input.pressure_rate = (pneu_real)rate;
  input.force = (pneu_real)force;
  s = fixture_rest(&m, from, x, &input);
  fixture_run(&m, &s, &input, (rate > 0 ? 4e5 : from) / fabs(rate), TOL(1e-8, 1e-5), &e);
  assert_true(e.n > 0);
  assert_int_equal(e.after[0], rate > 0 ? PNEU_MODE_UP : PNEU_MODE_DOWN);
  /* single: time is compensated, pressure is not, so that the ramp's rounding shows */
  assert_close(e.p[0], from + rate * e.t[0], TOL(1e-6, 3), TOL(0, 1e-6));
  return e.p[0];
}

TEST(test_pneu_run__pressure_ramp__breaks_away_at_the_exact_pressure)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const double k = 4e5, F = 480, A = 0.04, x0 = 0.01, tol = TOL(1e-4, 20);
  assert_close(leaves_at(&p, 0, 0, 1e4, 0), (k * x0 + F) / A, tol, 0);
  assert_close(leaves_at(&p, 2e5, 0.01, 1e4, 0), (k * (0.01 + x0) + F) / A, tol, 0);
  assert_close(leaves_at(&p, 2e5, 0.01, -1e4, 0), (k * (0.01 + x0) - F) / A, tol, 0);
  assert_close(leaves_at(&p, 4e5, 0.02, -1e4, 0), (k * (0.02 + x0) - F) / A, tol, 0);
}

TEST(test_pneu_run__pressure_ramp__hysteresis_is_twice_friction_over_area)
{
  static const double friction[] = {20, 100, 480};
  int i;
  for (i = 0; i < COUNT(friction); i++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    p.dry_friction = (pneu_real)friction[i];
    check_note("F = %g", friction[i]);
    assert_close(leaves_at(&p, 2e5 - 1, 0.01, 1e4, 0) - leaves_at(&p, 2e5 + 1, 0.01, -1e4, 0), 2 * friction[i] / 0.04,
                 TOL(1e-4, 40), 0);
  }
}

TEST(test_pneu_run__forces__are_positive_against_the_air)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const double base = leaves_at(&p, 0, 0, 1e4, 0);
  assert_close(leaves_at(&p, 0, 0, 1e4, 200) - base, 200 / 0.04, TOL(1e-3, 20), 0);
  p.external_force = 300;
  assert_close(leaves_at(&p, 0, 0, 1e4, 200) - base, 500 / 0.04, TOL(1e-3, 20), 0);
  p.external_force = -300;
  assert_close(leaves_at(&p, 0, 0, 1e4, 0) - base, -300 / 0.04, TOL(1e-3, 20), 0);
}

/* Quasi-static: p A = k (x + x_0) +- F + c v with v = A rate/k once the start has died out. */
TEST(test_pneu_run__slow_ramp_up_and_down__draws_the_static_loop)
{
  static fixture_sample s[801];
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_model m = fixture_pressed(&p);
  const double rate = 1e4, v = 0.04 * rate / 4e5;
  fixture_stretch stretch[2];
  pneu_state at;
  int i, n, sliding[2] = {0, 0};
  stretch[0].duration = stretch[1].duration = 40;
  stretch[0].input = stretch[1].input = fixture_input(&m, 0);
  stretch[0].input.pressure_rate = (pneu_real)rate;
  stretch[1].input.pressure_rate = (pneu_real)-rate;
  at = fixture_rest(&m, 0, 0, &stretch[0].input);
  n = fixture_trace(&m, &at, stretch, 2, 0.1, TOL(1e-9, 1e-5), s, 801);
  for (i = 0; i < n; i++) {
    const int down = s[i].t > 40;
    const double dry = down ? -480 - 1500 * v : 480 + 1500 * v, x = (s[i].p * 0.04 - dry) / 4e5 - 0.01;
    check_note("t = %g s", s[i].t);
    if (x < 1e-4 || x > 0.0199 || fabs(s[i].t - 40) < 1e-9)
      continue;
    assert_close(s[i].x, x, TOL(1e-9, 1e-5), 0);
    sliding[down]++;
  }
  assert_true(sliding[0] > 150 && sliding[1] > 150);
  assert_true(at.x == 0 && at.v == 0 && at.mode == PNEU_MODE_LOWER);
}

/* ---- other ends of the model ---- */

TEST(test_pneu_run__no_stroke__is_a_vessel)
{
  const pneu_params p = fixture_vessel(1e-4);
  fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER), 1, 0, 0);
  pneu_real g[PNEU_EVENT_MAX], y[PNEU_STATE_MAX];
  fixture_events e;
  assert_int_equal(rig.s.mode, PNEU_MODE_FIXED);
  assert_int_equal(pneu_dimension(&rig.m, rig.s.mode), 2);
  assert_int_equal(pneu_pack(&rig.m, &rig.s, y), 2);
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 0);
  fixture_go(&rig, 5, 1e-5, &e);
  assert_true(e.n == 0 && rig.s.x == 0 && rig.s.v == 0 && rig.s.mode == PNEU_MODE_FIXED);
}

TEST(test_pneu_run__regulator__brings_a_vessel_to_its_set_point)
{
  static const double from[] = {-5e4, 0, 1.5e5, 3.9e5};
  pneu_params p = fixture_vessel(1e-3);
  int i, gas;
  p.proportional_band = (pneu_real)2e4;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (i = 0; i < COUNT(from); i++) {
      fixture_rig rig = fixture_at(fixture_model(&p, gas, PNEU_FLOW_CHOKED), 2e5, from[i], 0);
      fixture_go(&rig, 30, TOL(1e-8, 1e-5), NULL);
      check_note("%s from %g Pa", pneu_gas_key(gas), from[i]);
      assert_close(rig.s.p, 2e5, TOL(1, 50), 0);
    }
}

#ifndef PNEU_SINGLE
/* A stem that is pushed beyond friction by no more than the rounding of the balance, 64 units in the last place of the
 * largest force, stays: the pressure at which it leaves is found by halving. */
TEST(test_pneu_settle__push_within_rounding__stem_stays)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  const double balanced = (4e5 * 0.02 + 480) / 0.04;
  const double largest = (4e5 + p.ambient_pressure) * 0.04 + 4e5 * 0.03;
  double stays = 0, leaves = 1e-6; /* [Pa] beyond balance */
  int i;
  for (i = 0; i < 40; i++) {
    const double middle = (stays + leaves) / 2;
    const pneu_state s = fixture_rest(&m, balanced + middle, 0.01, &input);
    assert_true(s.mode == PNEU_MODE_STUCK || s.mode == PNEU_MODE_UP);
    *(s.mode == PNEU_MODE_STUCK ? &stays : &leaves) = middle;
  }
  assert_close(leaves * 0.04, 64 * 2.22e-16 * largest, 0, 0.1);
}
#endif

/* The opening is the distance from the set point over the band, and no more than wide open either way. */
TEST(test_pneu_observe__regulator_away_from_its_set_point__is_open_in_proportion_up_to_the_band)
{
  static const double over[][2] = {{-0.5, 0.5}, {0.25, -0.25}, {-1.005, 1}, {1.005, -1}, {-3, 1}, {3, -1}};
  pneu_params p = fixture_vessel(1e-4);
  int i;
  p.proportional_band = (pneu_real)2e4;
  for (i = 0; i < COUNT(over); i++) {
    const fixture_rig rig =
        fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED), 2e5, 2e5 + over[i][0] * 2e4, 0);
    check_note("%g bands above", over[i][0]);
    assert_close(fixture_see(&rig).opening, over[i][1], TOL(1e-10, 1e-4), 0);
  }
}

TEST(test_pneu_run__regulator_on_an_actuator__holds_pressure_and_leaves_the_stem_within_friction)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  p.proportional_band = (pneu_real)5e3;
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 2e5, 0, 0);
  fixture_go(&rig, 60, TOL(1e-8, 1e-5), NULL);
  assert_close(rig.s.p, 2e5, TOL(1, 50), 0);
  assert_int_equal(rig.s.mode, PNEU_MODE_STUCK);
  assert_between(4e5 * ((double)rig.s.x + 0.01), 2e5 * 0.04 - 481, 2e5 * 0.04 + 481);
}

TEST(test_pneu_stem_extension__normal_and_reverse__mirror_each_other)
{
  const pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  assert_close(pneu_stem_extension(&m, (pneu_real)0.005, 0), 0.005, 0, 1e-6);
  assert_close(pneu_stem_extension(&m, (pneu_real)0.005, 1), 0.015, 0, 1e-6);
}

/* Where a stem stops in equilibrium it must not chatter: set points that end in every place of the stroke. */
TEST(test_pneu_run__regulator_at_many_set_points__always_ends)
{
  double band, set;
  for (band = 2e4; band < 1.1e5; band += 4e4)
    for (set = 105e3; set < 320e3; set += 500) {
      pneu_params p = fixture_params(FIXTURE_R1_400);
      fixture_rig rig;
      p.dead_volume = (pneu_real)4e-5;
      p.proportional_band = (pneu_real)band;
      rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 0, 0);
      rig.input.u = (pneu_real)set;
      check_note("band %g, set %g", band, set);
      fixture_go(&rig, 60, TOL(1e-6, 1e-4), NULL);
      assert_close(rig.s.p, set, 50, 0);
    }
}

/* A lagging transducer that regulates starts shut where pressure is at its set point. */
TEST(test_pneu_state_rest__lag_and_regulator_in_equilibrium__stays)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  fixture_need("transducer_lag");
  p.proportional_band = (pneu_real)5e4;
  fixture_set(&p, "transducer_time", 0.05);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 2e5, 2e5, 0.01);
  fixture_go(&rig, 1, TOL(1e-8, 1e-5), NULL);
  assert_close(rig.s.p, 2e5, TOL(1, 100), 0);
}

TEST(test_pneu_regulator_opening__error_over_band__is_held_within_one)
{
  assert_close(pneu_regulator_opening(100, 90, 40), 0.25, 0, 0);
  assert_close(pneu_regulator_opening(90, 100, 40), -0.25, 0, 0);
  assert_close(pneu_regulator_opening(500, 90, 40), 1, 0, 0);
  assert_close(pneu_regulator_opening(0, 90, 40), -1, 0, 0);
}

/* ---- modes ---- */

TEST(test_pneu_settle__at_rest__mode_follows_the_balance_of_forces)
{
  static const struct {
    double p, x, v;
    int mode;
  } cases[] = {
      {0, 0, 0, PNEU_MODE_LOWER},        {111e3, 0, 0, PNEU_MODE_LOWER},    {113e3, 0, 0, PNEU_MODE_UP},
      {4e5, 0.02, 0, PNEU_MODE_UPPER},   {289e3, 0.02, 0, PNEU_MODE_UPPER}, {287e3, 0.02, 0, PNEU_MODE_DOWN},
      {200e3, 0.01, 0, PNEU_MODE_STUCK}, {211e3, 0.01, 0, PNEU_MODE_STUCK}, {213e3, 0.01, 0, PNEU_MODE_UP},
      {187e3, 0.01, 0, PNEU_MODE_DOWN},  {189e3, 0.01, 0, PNEU_MODE_STUCK}, {0, 0.01, 0.1, PNEU_MODE_UP},
      {4e5, 0.01, -0.1, PNEU_MODE_DOWN},
  };
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  int i;
  for (i = 0; i < COUNT(cases); i++) {
    pneu_state s = fixture_rest(&m, cases[i].p, cases[i].x, &input);
    s.v = (pneu_real)cases[i].v;
    s.mode = PNEU_MODE_STUCK;
    pneu_settle(&m, &input, &s);
    check_note("p = %g, x = %g, v = %g: %s", cases[i].p, cases[i].x, cases[i].v, pneu_mode_text(s.mode));
    assert_close(s.mode, cases[i].mode, 0, 0);
  }
}

TEST(test_pneu_switch__each_event__leads_to_the_mode_that_physics_asks_for)
{
  static const struct {
    int before, which;
    double p, x;
    int after;
    double x_after;
  } cases[] = {
      {PNEU_MODE_LOWER, 0, 113e3, 0, PNEU_MODE_UP, 0},
      {PNEU_MODE_UPPER, 0, 287e3, 0.02, PNEU_MODE_DOWN, 0.02},
      {PNEU_MODE_STUCK, 0, 213e3, 0.01, PNEU_MODE_UP, 0.01},
      {PNEU_MODE_STUCK, 1, 187e3, 0.01, PNEU_MODE_DOWN, 0.01},
      {PNEU_MODE_UP, 0, 200e3, 0.01, PNEU_MODE_STUCK, 0.01},
      {PNEU_MODE_UP, 0, 150e3, 0.01, PNEU_MODE_DOWN, 0.01},
      {PNEU_MODE_UP, 1, 400e3, 0.0200001, PNEU_MODE_UPPER, 0.02},
      {PNEU_MODE_UP, 1, 100e3, 0.0200001, PNEU_MODE_DOWN, 0.02},
      {PNEU_MODE_DOWN, 0, 200e3, 0.01, PNEU_MODE_STUCK, 0.01},
      {PNEU_MODE_DOWN, 0, 250e3, 0.01, PNEU_MODE_UP, 0.01},
      {PNEU_MODE_DOWN, 1, 0, -1e-7, PNEU_MODE_LOWER, 0},
      {PNEU_MODE_DOWN, 1, 300e3, -1e-7, PNEU_MODE_UP, 0},
  };
  const pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  int i;
  for (i = 0; i < COUNT(cases); i++) {
    pneu_state s = fixture_rest(&m, cases[i].p, 0.01, &input);
    const int rests = cases[i].before != PNEU_MODE_UP && cases[i].before != PNEU_MODE_DOWN;
    s.mode = cases[i].before;
    s.x = (pneu_real)cases[i].x;
    s.v = (pneu_real)(rests ? 0 : cases[i].before == PNEU_MODE_UP ? 1e-9 : -1e-9);
    pneu_switch(&m, &input, cases[i].which, &s);
    check_note("case %d: %s", i, pneu_mode_text(s.mode));
    assert_close(s.mode, cases[i].after, 0, 0);
    assert_close(s.x, (pneu_real)cases[i].x_after, 0, 0);
    assert_close(s.v, 0, 0, 0);
  }
}

TEST(test_pneu_events__about_break_away__rise_through_zero_in_newtons)
{
  fixture_rig rig = fixture_at(fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 200e3, 0.01);
  pneu_real g[PNEU_EVENT_MAX], y[PNEU_STATE_MAX];
  pneu_pack(&rig.m, &rig.s, y);
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 2);
  assert_close(g[0], -480, TOL(1e-8, 0.5), 0);
  assert_close(g[1], -480, TOL(1e-8, 0.5), 0);
  y[0] = (pneu_real)213e3;
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 2);
  assert_close(g[0], 40, TOL(1e-8, 0.5), 0);
  assert_close(g[1], -1000, TOL(1e-8, 0.5), 0);
  rig.s = fixture_rest(&rig.m, 400e3, 0.02, &rig.input);
  pneu_pack(&rig.m, &rig.s, y);
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 1);
  assert_close(g[0], -(16000 - 12000 + 480), TOL(1e-8, 0.5), 0);
}

/* A chamber without air has no balance of forces: nothing to tell of the stem. */
TEST(test_pneu_settle__chamber_without_air__stem_stays)
{
  fixture_rig rig = fixture_at(fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 213e3, 0.01);
  pneu_real g[PNEU_EVENT_MAX], y[PNEU_STATE_MAX];
  assert_int_equal(rig.s.mode, PNEU_MODE_UP);
  rig.s.p = (pneu_real)-2e5;
  pneu_settle(&rig.m, &rig.input, &rig.s);
  assert_int_equal(rig.s.mode, PNEU_MODE_STUCK);
  pneu_pack(&rig.m, &rig.s, y);
  assert_int_equal(pneu_events(&rig.m, &rig.s, &rig.input, y, g), 0);
}

/* ---- invariants under anything ---- */

/* What to check at every step of a run. */
static void check_modes(const pneu_state *s, double stroke, double v_scale)
{
  const double over = TOL(2e-9, 2e-6); /* [s] to which an event is located */
  assert_between(s->x, -over * v_scale, stroke + over * v_scale);
  if (s->mode == PNEU_MODE_UP)
    assert_between(s->v, -1e4 * over * v_scale, 1e3);
  else if (s->mode == PNEU_MODE_DOWN)
    assert_between(s->v, -1e3, 1e4 * over * v_scale);
  else
    assert_true(s->v == 0);
  if (s->mode == PNEU_MODE_LOWER)
    assert_true(s->x == 0);
  if (s->mode == PNEU_MODE_UPPER)
    assert_true(s->x == (pneu_real)stroke);
}

static int at_step(void *context, const pneu_step_view *view)
{
  static const double theta[] = {0, 0.25, 0.5, 0.75, 1};
  pneu_state s;
  int i;
  (void)context;
  for (i = 0; i < COUNT(theta); i++) {
    pneu_dense(view, (pneu_real)theta[i], &s);
    assert_true(s.mode == view->start->mode);
    check_modes(&s, (double)view->model->p.stroke, 1);
  }
  return 0;
}

static int at_event(void *context, pneu_real t, const pneu_state *s, int before)
{
  (void)t;
  assert_true(before != s->mode);
  check_modes(s, *(double *)context, 1);
  return 0;
}

static void run_at_random(const pneu_model *m, uint64_t seed)
{
  double stroke = (double)m->p.stroke;
  pneu_observer observer = {at_step, at_event, NULL};
  const pneu_options options = fixture_options(TOL(1e-7, 1e-5));
  pneu_workspace work = {0};
  pneu_input input = fixture_input(m, 0);
  pneu_state s = fixture_rest(m, 0, 0, &input);
  int i;
  observer.context = &stroke;
  for (i = 0; i < 60; i++) {
    const double u = fixture_random(&seed, -1.5, 1.5);
    input.u = (pneu_real)(u > 1 ? 1 : u < -1 ? -1 : u);
    input.force = (pneu_real)(i % 3 ? 0 : fixture_random(&seed, -3e3, 3e3));
    assert_int_equal(pneu_run(m, &s, &input, (pneu_real)fixture_random(&seed, 0.01, 3), &options, &observer, &work),
                     PNEU_OK);
    check_modes(&s, stroke, 1);
  }
  assert_true(work.stats.events > 10);
}

TEST(test_pneu_run__random_commands_and_forces__modes_mean_what_they_say)
{
  int actuator, gas, flow;
  for (actuator = 0; actuator < FIXTURE_ACTUATORS; actuator++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
      for (flow = 0; flow < PNEU_FLOW_COUNT; flow++) {
        const pneu_params p = fixture_params(actuator);
        const pneu_model m = fixture_model(&p, gas, flow);
        check_note("actuator %d, %s, %s", actuator, pneu_gas_key(gas), pneu_flow_key(flow));
        run_at_random(&m, 7);
      }
}

/* What holds a driven stem: p A - k (x + x_0) - external - c v - F sgn v, whatever force the input has. */
TEST(test_pneu_observe__driven_stem__shows_the_force_that_holds_it)
{
  static const double speed[] = {0.01, -0.02, 0};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int i;
  p.external_force = 30;
  for (i = 0; i < COUNT(speed); i++) {
    const pneu_model m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 1);
    const double v = speed[i], sense = (v > 0) - (v < 0);
    pneu_input input = fixture_input(&m, 0);
    pneu_output out;
    pneu_state s;
    input.position_rate = (pneu_real)v;
    input.force = 77;
    s = fixture_rest(&m, 2.5e5, 0.005, &input);
    assert_int_equal(pneu_observe(&m, &s, &input, &out), PNEU_OK);
    assert_close(out.holding_force, 2.5e5 * 0.04 - 4e5 * 0.015 - 30 - 1500 * v - 480 * sense, 0, TOL(1e-12, 1e-5));
  }
}
