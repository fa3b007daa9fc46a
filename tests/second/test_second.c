/* The virtual rig's base model against closed forms: a witness has to be sound itself.
 * SPDX-License-Identifier: MIT */
#include "../check.h"

#include "cases.h"

/* ---- gas ---- */

/* P' = -(Ca psi sqrt(R T)/V) P while the orifice is choked. */
TEST(test_second_run__choked_isothermal_blowdown__is_exponential)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.start_pressure = 9e5;
  double rate = g.vent_area * case_choked(&g) * sqrt(case_rt(&g)) / g.dead_volume;
  case_run(&g, -1.0, 5.0, 0.1);
  assert_true(case_last(got.p) > g.ambient); /* choked to the end */
  for (size_t i = 0; i < got.n; i++) {
    check_note("t = %g s", got.t[i]);
    assert_close(got.p[i] + g.ambient, 9e5 * exp(-rate * got.t[i]), 0, 1e-12);
    assert_close(got.T[i], g.ambient_temperature, 0, 1e-14);
  }
}

/* P/P0 = s^(-2 g/(g-1)), T/T0 = s^-2, s = 1 + (g-1)/2 Ca psi sqrt(R T0)/V t. */
TEST(test_second_run__choked_adiabatic_blowdown__follows_the_closed_form)
{
  second_rig g = case_vessel(SECOND_ENERGY, SECOND_CHOKED);
  g.start_pressure = 9e5;
  double rate = g.vent_area * case_choked(&g) * sqrt(case_rt(&g)) / g.dead_volume;
  case_run(&g, -1.0, 4.0, 0.1);
  for (size_t i = 0; i < got.n; i++) {
    double s = 1.0 + 0.5 * (g.gamma - 1.0) * rate * got.t[i];
    check_note("t = %g s", got.t[i]);
    assert_close(got.p[i] + g.ambient, 9e5 * pow(s, -2.0 * g.gamma / (g.gamma - 1.0)), 0, 1e-12);
    assert_close(got.T[i], g.ambient_temperature / (s * s), 0, 1e-12);
  }
}

/* Eq. (8), venting: P = Pa cosh^2 y makes y' = -(Ca/V) sqrt(R T/2). */
TEST(test_second_run__isothermal_blowdown_by_eq_8__is_a_squared_cosh)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_PAPER);
  g.start_pressure = 5e5;
  double y0 = acosh(sqrt(5e5 / g.ambient)), rate = g.vent_area / g.dead_volume * sqrt(0.5 * case_rt(&g));
  case_run(&g, -1.0, 7.0, 0.1);
  for (size_t i = 0; i < got.n; i++) {
    double c = cosh(y0 - rate * got.t[i]);
    check_note("t = %g s", got.t[i]);
    assert_close(got.p[i] + g.ambient, g.ambient * c * c, 0, 1e-12);
  }
}

/* Eq. (8), filling: sqrt(Ps - P) falls linearly, by Ca sqrt(2 R T Ps)/(2 V) a second. */
TEST(test_second_run__isothermal_fill_by_eq_8__is_a_parabola)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_PAPER);
  double Ps = g.supply + g.ambient, rate = g.fill_area * sqrt(0.5 * case_rt(&g) * Ps) / g.dead_volume;
  case_run(&g, 1.0, 4.0, 0.1);
  for (size_t i = 0; i < got.n; i++) {
    double s = sqrt(g.supply) - rate * got.t[i];
    check_note("t = %g s", got.t[i]);
    assert_close(got.p[i], g.supply - s * s, 1e-5, 0);
  }
}

/* Adiabatic fill: 1/T = P0/(P T0) + (1 - P0/P)/(g Ts); from vacuum T = g Ts. */
TEST(test_second_run__adiabatic_fill__heats_by_the_closed_form)
{
  static const double start[] = {1.0, 0.5e5, 101325.0, 2e5};
  for (size_t k = 0; k < 4; k++) {
    second_rig g = case_vessel(SECOND_ENERGY, SECOND_CHOKED);
    g.start_pressure = start[k];
    g.supply_temperature = 320.0;
    case_run(&g, 1.0, 2.0, 0.05);
    for (size_t i = 1; i < got.n; i++) {
      double r = start[k] / (got.p[i] + g.ambient);
      check_note("from %g Pa, t = %g s", start[k], got.t[i]);
      assert_close(got.T[i], 1.0 / (r / g.ambient_temperature + (1.0 - r) / (1.4 * 320.0)), 0, 1e-11);
    }
  }
}

/* Sonic conductance is derived so that the choked flows agree; below b they are the same number. */
TEST(test_second_run__iso_6358_choked__equals_the_nozzle)
{
  second_rig nozzle = case_vessel(SECOND_ENERGY, SECOND_CHOKED), iso = case_vessel(SECOND_ENERGY, SECOND_ISO6358);
  nozzle.start_pressure = iso.start_pressure = 3e5;
  case_run(&nozzle, -1.0, 1.0, 1.0);
  double want = case_last(got.m);
  case_run(&iso, -1.0, 1.0, 1.0);
  assert_close(case_last(got.m), want, 0, 1e-15);
}

/* Subsonic by ISO 6358 into a held pressure: m' = Ca psi P1/sqrt(R T) (1 - ((r - b)/(1 - b))^2)^m. */
TEST(test_second_run__iso_6358_subsonic__follows_the_ellipse)
{
  second_rig g = case_held(200e3);
  g.flow = SECOND_ISO6358;
  g.stroke = 0.0;
  g.iso_b = 0.3;
  g.iso_m = 0.58;
  double Ps = g.supply + g.ambient, s = ((g.ambient + 200e3) / Ps - 0.3) / 0.7;
  second_audit a = case_run(&g, 0.5, 1.0, 1.0);
  assert_close(a.mass_in, 0.5 * g.fill_area * case_choked(&g) * Ps / sqrt(case_rt(&g)) * pow(1.0 - s * s, 0.58), 0,
               1e-8);
}

/* Below linear_ratio the flow is proportional to the difference, which then decays exponentially. */
TEST(test_second_run__near_equal_pressures__difference_decays_exponentially)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_PAPER);
  g.linear_ratio = 0.1;
  g.start_pressure = g.ambient + 100.0;
  double rate = g.vent_area * sqrt(2.0 * g.linear_ratio * case_rt(&g)) / g.linear_ratio / g.dead_volume;
  case_run(&g, -1.0, 1.0, 0.1);
  for (size_t i = 0; i < got.n; i++)
    assert_close(got.p[i], 100.0 * exp(-rate * got.t[i]), 1e-7, 0);
}

/* Mass in is flow times the time that the orifice was open, wherever the samples are. */
TEST(test_second_run__command_between_samples__acts_at_its_own_time)
{
  static const double when[] = {0.12345, 0.98765}, what[] = {0.5, 0.0};
  second_rig g = case_held(0.0);
  g.flow = SECOND_CHOKED;
  g.stroke = 0.0;
  double flow = 0.5 * g.fill_area * case_choked(&g) * (g.supply + g.ambient) / sqrt(case_rt(&g));
  assert_close(case_schedule(&g, when, what, 2, 2.0, 0.5).mass_in, flow * (0.98765 - 0.12345), 0, 1e-10);
}

/* ---- stem ---- */

/* v = v0 - F t/M until it is zero at M v0/F, then for ever at M v0^2/(2 F). */
TEST(test_second_run__coulomb_slide__stops_at_the_known_time_and_place)
{
  second_rig g = case_held(0.0);
  g.dry_friction = 480.0;
  for (int up = 0; up < 2; up++) {
    g.start_position = 0.5;
    g.start_velocity = up ? 5.0 : -5.0;
    double stop = g.mass * 5.0 / 480.0, way = (up ? 0.5 : -0.5) * 5.0 * stop;
    second_audit a = case_run(&g, 0.0, 0.04, 0.00037);
    for (size_t i = 0; i < got.n; i++) {
      check_note("t = %g s, stop at %g s", got.t[i], stop);
      assert_close(got.v[i], got.t[i] < stop ? g.start_velocity * (1.0 - got.t[i] / stop) : 0.0, 1e-8, 0);
      if (got.t[i] > stop)
        assert_close(got.x[i] - 0.5, way, 1e-9, 0);
    }
    assert_close(a.dry, 0.5 * g.mass * 25.0, 0, 1e-8);
    assert_int_equal(a.events, 1);
  }
}

/* With viscous friction too the stop is at (M/c) ln(1 + c v0/F). */
TEST(test_second_run__viscous_and_coulomb_slide__stops_at_the_known_time)
{
  second_rig g = case_held(0.0);
  g.dry_friction = 480.0;
  g.viscous = 200.0;
  g.start_position = 0.1;
  g.start_velocity = 4.0;
  double stop = g.mass / g.viscous * log(1.0 + g.viscous * 4.0 / 480.0);
  case_run(&g, 0.0, 0.02, 0.0001);
  for (size_t i = 0; i < got.n; i++) {
    check_note("t = %g s", got.t[i]);
    double v = (4.0 + 480.0 / 200.0) * exp(-g.viscous * got.t[i] / g.mass) - 480.0 / 200.0;
    assert_close(got.v[i], got.t[i] < stop ? v : 0.0, 1e-8, 0);
  }
}

TEST(test_second_run__push_below_dry_friction__does_not_move_at_all)
{
  for (int up = 0; up < 2; up++) {
    second_rig g = case_held(up ? 11.99e3 : -11.99e3); /* 479.6 N of 480 N */
    g.dry_friction = 480.0;
    g.start_position = 0.25;
    case_run(&g, 0.0, 1.0, 0.1);
    for (size_t i = 0; i < got.n; i++)
      assert_true(got.x[i] == 0.25 && got.v[i] == 0.0);
  }
}

/* M x'' = p A - F from rest, either way. */
TEST(test_second_run__push_above_dry_friction__accelerates_by_the_rest)
{
  for (int sign = -1; sign < 2; sign += 2) {
    second_rig g = case_held(sign * 13e3);
    g.dry_friction = 480.0;
    g.start_position = 0.5;
    case_run(&g, 0.0, 0.2, 0.01);
    for (size_t i = 0; i < got.n; i++)
      assert_close(got.x[i] - 0.5, sign * 0.5 * (520.0 - 480.0) / g.mass * got.t[i] * got.t[i], 1e-10, 1e-8);
  }
}

TEST(test_second_run__moving_stem_meets_the_stop__stays_there_and_loses_its_energy)
{
  second_rig g = case_held(0.0);
  g.stroke = 0.02;
  g.dry_friction = 10.0;
  g.start_position = 0.01;
  g.start_velocity = 2.0;
  second_audit a = case_run(&g, 0.0, 0.02, 0.001);
  assert_true(case_last(got.x) == 0.02 && case_last(got.v) == 0.0);
  assert_close(a.impact, 0.5 * g.mass * 4.0 - 10.0 * 0.01, 0, 1e-9);
}

/* Leaves the lower stop at p A = k x0 + F, within the sample after that. */
TEST(test_second_run__standard_fill__breaks_away_at_the_preload_and_friction)
{
  second_rig g = second_rig_default_r1_400();
  g.dead_volume = 1e-3;
  case_run(&g, 1.0, 1.0, 0.001);
  size_t i = 0;
  while (got.x[i] == 0.0)
    i++;
  double p = (400e3 * 0.01 + 480.0) / 0.04;
  assert_true(i > 1);
  assert_true(got.p[i - 1] <= p);
  assert_true(2.0 * got.p[i - 1] - got.p[i - 2] > p);
}

/* ---- audits and convergence ---- */

static void audits_close(const second_audit *a, double ambient)
{
  double energy = a->enthalpy_in + a->enthalpy_out;
  assert_close(a->mass_end - a->mass_start, a->mass_in - a->mass_out, 1e-12 * (a->mass_in + a->mass_out), 0);
  assert_close(a->energy_end - a->energy_start, a->enthalpy_in - a->enthalpy_out + a->heat - a->gas_work,
               1e-11 * energy, 0);
  assert_close(a->gas_work - ambient * (a->volume_end - a->volume_start),
               a->kinetic_end - a->kinetic_start + a->spring_end - a->spring_start + a->dry + a->viscous + a->impact +
                   a->other,
               1e-6 * (a->dry + a->viscous + a->impact), 0);
}

static const double at[] = {0.1, 2.0, 4.0, 4.5, 5.0, 6.0}, to[] = {1.0, 0.0, -0.6, 0.0, 0.7, -1.0};

TEST(test_second_run__any_gas_and_flow__closes_mass_energy_and_work)
{
  for (int gas = 0; gas < 2; gas++)
    for (int flow = 0; flow < 3; flow++) {
      second_rig g = second_rig_default_r1_400();
      g.gas = gas ? SECOND_ENERGY : SECOND_ISOTHERMAL;
      g.flow = flow == 0 ? SECOND_PAPER : flow == 1 ? SECOND_CHOKED : SECOND_ISO6358;
      check_note("gas %d, flow %d", gas, flow);
      second_audit a = case_schedule(&g, at, to, 6, 8.0, 0.1);
      assert_true(a.mass_in > 1e-3 && a.mass_out > 1e-3 && a.dry > 1.0 && a.viscous > 0.1 && a.events > 4);
      audits_close(&a, g.ambient);
    }
}

/* Dry friction takes 2 F a stroke, whatever the gas does. */
TEST(test_second_run__full_cycle__dry_friction_takes_force_times_way)
{
  static const double t2[] = {0.0, 5.0}, u2[] = {1.0, -1.0};
  second_rig g = second_rig_default_r1_400();
  second_audit a = case_schedule(&g, t2, u2, 2, 15.0, 1.0);
  assert_true(case_last(got.x) == 0.0);
  assert_close(a.dry, 2.0 * 480.0 * 0.02, 0, 1e-10);
}

/* Mean distance of x and p from a fine run, at step h. */
static double error_at(second_rig g, double h, const double *fine)
{
  double sum = 0.0;
  g.step = h;
  case_schedule(&g, at, to, 6, 2.0, 0.01);
  for (size_t i = 0; i < got.n; i++)
    sum += fabs(got.x[i] - fine[i]) / g.stroke;
  return sum / (double)got.n;
}

TEST(test_second_run__step_halved__error_falls_sixteenfold)
{
  static double fine[CASE_SAMPLES];
  for (int gas = 0; gas < 2; gas++) {
    second_rig g = second_rig_default_37_13();
    g.gas = gas ? SECOND_ENERGY : SECOND_ISOTHERMAL;
    g.flow = SECOND_CHOKED;
    memset(fine, 0, sizeof fine);
    error_at(g, 5e-6, fine);
    memcpy(fine, got.x, sizeof fine);
    double e80 = error_at(g, 80e-6, fine), e40 = error_at(g, 40e-6, fine), e20 = error_at(g, 20e-6, fine);
    check_note("gas %d: %.2e %.2e %.2e of stroke", gas, e80, e40, e20);
    assert_between(e80 / e40, 10, 24);
    assert_between(e40 / e20, 10, 24);
    assert_between(e20, 0, 1e-9);
  }
}

TEST(test_second_run__refinement_on_a_coarse_step__reaches_the_fine_answer)
{
  static double fine[CASE_SAMPLES];
  second_rig g = second_rig_default_r1_400();
  memset(fine, 0, sizeof fine);
  error_at(g, 5e-6, fine);
  memcpy(fine, got.x, sizeof fine);
  double coarse = error_at(g, 160e-6, fine);
  g.refine_tolerance = 1e-10;
  double refined = error_at(g, 160e-6, fine);
  check_note("%.2e, refined %.2e", coarse, refined);
  assert_true(refined < 1e-2 * coarse);
}

TEST(test_second_run__same_arguments__same_bits)
{
  static double first[CASE_SAMPLES];
  second_rig g = second_rig_default_37_13();
  g.pressure_noise = 100.0;
  case_schedule(&g, at, to, 6, 3.0, 0.01);
  memcpy(first, got.p, sizeof first);
  memset(got.p, 0, got.n * sizeof *first);
  case_schedule(&g, at, to, 6, 3.0, 0.01);
  assert_memory_equal(first, got.p, got.n * sizeof *first);
}

TEST(test_second_run__step_far_beyond_stability__is_reported)
{
  second_rig g = second_rig_default_r1_400();
  const double t0 = 0.0, u = 1.0;
  g.step = 0.5;
  assert_int_equal(second_run(&g, &t0, &u, 1, 5.0, 0.5, NULL, NULL), 1);
}
