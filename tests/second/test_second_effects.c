/* Each effect of the virtual rig against a closed form of its own.
 * SPDX-License-Identifier: MIT */
#include "../check.h"

#include "cases.h"

#define PI 3.14159265358979323846

/* ---- mass ---- */

/* A leak with both orifices shut is a blowdown through its own area. */
TEST(test_leak_area__vessel_shut_and_choked__decays_exponentially)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.start_pressure = 6e5;
  g.leak_area = 0.05e-6;
  double rate = g.leak_area * case_choked(&g) * sqrt(case_rt(&g)) / g.dead_volume;
  case_run(&g, 0.0, 4.0, 0.5);
  assert_close(case_last(got.p) + g.ambient, 6e5 * exp(-rate * 4.0), 0, 1e-12);
}

/* P' = -(c R T/V)(P^2 - Pa^2): (P - Pa)/(P + Pa) decays at 2 Pa c R T/V. */
TEST(test_laminar_leak__vessel_shut__follows_the_closed_form)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.start_pressure = 4e5;
  g.laminar_leak = 2e-15;
  double rate = 2.0 * g.ambient * g.laminar_leak * case_rt(&g) / g.dead_volume;
  double r0 = (4e5 - g.ambient) / (4e5 + g.ambient);
  case_run(&g, 0.0, 20.0, 1.0);
  for (size_t i = 0; i < got.n; i++) {
    double r = r0 * exp(-rate * got.t[i]);
    assert_close(got.p[i] + g.ambient, g.ambient * (1.0 + r) / (1.0 - r), 0, 1e-12);
  }
}

TEST(test_relief__below_and_above_its_pressure__shut_and_open)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.relief_area = 0.1e-6;
  g.relief_from = 150e3;
  g.relief_span = 1e3;
  g.start_pressure = g.ambient + 149e3;
  case_run(&g, 0.0, 10.0, 1.0);
  assert_true(case_last(got.m) == got.m[0]);
  g.start_pressure = g.ambient + 200e3;
  case_run(&g, 0.0, 10.0, 1.0);
  assert_between(case_last(got.p), 150e3, 152e3);
}

/* Into a held pressure Eq. (8) with droop reads q^2 R T/(2 (u Ca)^2) = (Ps - r q)(Ps - r q - P). */
TEST(test_supply_droop__held_pressure__flow_solves_its_equation)
{
  second_rig g = case_held(100e3);
  g.stroke = 0.0;
  g.supply_droop = 1e8;
  double Ps = g.supply + g.ambient, P = 100e3 + g.ambient;
  double q = case_run(&g, 0.8, 1.0, 1.0).mass_in, s = q / (0.8 * g.fill_area), P1 = Ps - 1e8 * q;
  assert_true(1e8 * q > 0.1 * Ps); /* it does droop */
  assert_close(s * s * 0.5 * case_rt(&g), P1 * (P1 - P), 0, 1e-7);
}

/* Choked flow through the fill orifice, by the supply pressure and the supply's temperature. */
static double full_flow(const second_rig *g)
{
  return g->fill_area * case_choked(g) * (g->supply + g->ambient) / sqrt(g->gas_constant * g->supply_temperature);
}

/* Under Eq. (8), whose root of the difference is exact, the share c of the line loses r c q^2/q_f. */
TEST(test_supply_turbulence__held_pressure__flow_solves_its_equation)
{
  for (int i = 0; i < 6; i++) {
    second_rig g = case_held(i < 3 ? 100e3 : 350e3);
    double c = (double[]){0.3, 0.7, 1.0}[i % 3], r = 2e8, P = g.start_pressure;
    g.stroke = 0.0;
    g.supply_droop = r;
    g.supply_turbulence = c;
    double Ps = g.supply + g.ambient, q = case_run(&g, 0.8, 1.0, 1.0).mass_in, s = q / (0.8 * g.fill_area);
    double P1 = 0.5 * (P + sqrt(P * P + 2.0 * s * s * case_rt(&g)));
    check_note("c = %g into %g Pa", c, P);
    assert_true(Ps - P1 > 0.03 * Ps);
    assert_close(Ps - P1, r * q * (1.0 - c + c * q / full_flow(&g)), 0, 1e-9);
  }
}

/* Into a vessel that keeps the fill orifice choked, m' = u K Pl, and the volume behind a resistance follows
 * Pl' = R T/V ((Ps - Pl)/r - u K Pl): drawn from, shut, drawn from again. */
TEST(test_supply_volume__drawn_from_and_shut__falls_and_recovers_exponentially)
{
  static const double when[] = {0.1, 0.3, 0.35}, u[] = {1.0, 0.0, 0.5};
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.dead_volume = 1.0;
  g.supply_temperature = 330.0;
  g.supply_droop = 4e8;
  g.supply_volume = 2e-5;
  double Ps = g.supply + g.ambient, K = full_flow(&g) / Ps, Pl = Ps, drawn = 0.0, t = 0.0, now = 0.0;
  double rt = g.gas_constant * g.supply_temperature;
  case_schedule(&g, when, u, 3, 0.5, 0.01);
  for (size_t i = 1; i < got.n; t = got.t[i++]) {
    for (int k = 0; k < 3; k++)
      now = t > when[k] - 1e-9 ? u[k] : now;
    double ruk = g.supply_droop * now * K, lag = g.supply_droop * g.supply_volume / rt / (1.0 + ruk);
    double end = Ps / (1.0 + ruk), gone = 1.0 - exp(-0.01 / lag);
    drawn += now * K * (end * 0.01 + (Pl - end) * lag * gone);
    Pl += (end - Pl) * gone;
    check_note("t = %g s", got.t[i]);
    assert_close(got.m[i] - got.m[0], drawn, 1e-13, 1e-9);
  }
  assert_between(Pl, 0.5 * Ps, 0.8 * Ps);
}

/* The line is an orifice alone, of area S, and chokes as one. To second order a nozzle's a is sqrt(2/(R T))
 * (1 - 3/4 w/gamma) of a loss w = 1/1000. */
TEST(test_supply_volume__turbulent_and_choked__passes_what_its_orifice_does)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.dead_volume = 1.0;
  g.supply_droop = 5.6e8;
  g.supply_turbulence = 1.0;
  g.supply_volume = 2e-6;
  double Ps = g.supply + g.ambient, a2 = 2.0 / case_rt(&g) * (1.0 - 1.5e-3 / g.gamma);
  double S = sqrt(full_flow(&g) / (Ps * g.supply_droop) / a2);
  case_run(&g, 1.0, 1.0, 0.5);
  check_note("S = %g m2", S);
  assert_between(S / g.fill_area, 0.4, 0.5); /* both choke */
  assert_close((got.m[2] - got.m[1]) / 0.5, S * case_choked(&g) * Ps / sqrt(case_rt(&g)), 0, 1e-8);
}

/* q^2 R T/(2 Ca^2) = P (P - Pa - r q). */
TEST(test_back_pressure__held_pressure__flow_solves_its_equation)
{
  second_rig g = case_held(100e3);
  g.stroke = 0.0;
  g.back_pressure = 2e8;
  double q = case_run(&g, -1.0, 1.0, 1.0).mass_out, s = q / g.vent_area;
  assert_true(2e8 * q > 0.1 * 100e3);
  assert_close(s * s * 0.5 * case_rt(&g), (100e3 + g.ambient) * (100e3 - 2e8 * q), 0, 1e-7);
}

TEST(test_vent_area__smaller_than_fill_area__scales_the_outflow_only)
{
  second_rig g = case_held(100e3);
  g.stroke = 0.0;
  double in = case_run(&g, 1.0, 1.0, 1.0).mass_in, out = case_run(&g, -1.0, 1.0, 1.0).mass_out;
  g.vent_area *= 0.4;
  assert_close(case_run(&g, 1.0, 1.0, 1.0).mass_in, in, 0, 1e-12);
  assert_close(case_run(&g, -1.0, 1.0, 1.0).mass_out, 0.4 * out, 0, 1e-10);
}

/* Constant choked flow q into a tube, a linear restriction, a vessel:
 * P = P0 + q/(C1 + C2) (t - T (1 - exp(-t/T))), Ci = Vi/(R Ta), T = r C1 C2/(C1 + C2). */
TEST(test_tube__constant_inflow__chamber_lags_by_the_closed_form)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.tube_volume = 2e-4;
  g.tube_resistance = 5e7;
  double c1 = g.tube_volume / case_rt(&g), c2 = g.dead_volume / case_rt(&g), lag = 5e7 * c1 * c2 / (c1 + c2);
  double q = 0.2 * g.fill_area * case_choked(&g) * (g.supply + g.ambient) / sqrt(case_rt(&g));
  case_run(&g, 0.2, 1.0, 0.05);
  for (size_t i = 0; i < got.n; i++) {
    double t = got.t[i];
    assert_close(got.p[i], q / (c1 + c2) * (t - lag * (1.0 - exp(-t / lag))), 1e-6, 1e-11);
  }
}

/* Constant choked flow q into one end of a tube without friction, half its air at either end: with C = V/(R Ta) and
 * omega = 2 sqrt(R Ta)/L, P = P0 + q/C (t - sin(omega t)/omega). */
TEST(test_line_length__constant_inflow__swings_by_the_closed_form)
{
  const double length = 5.0;
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.area = 1e-3, g.dead_volume = length * g.area;
  g.line_length = 1.0, g.line_friction = 1e-9;
  double C = g.dead_volume / case_rt(&g), omega = 2.0 * sqrt(case_rt(&g)) / length;
  double q = g.fill_area * case_choked(&g) * (g.supply + g.ambient) / sqrt(case_rt(&g));
  case_run(&g, 1.0, 0.1, 0.01);
  for (size_t i = 0; i < got.n; i++)
    assert_close(got.p[i], q / C * (got.t[i] - sin(omega * got.t[i]) / omega), 1e-6, 1e-7);
}

/* Steadily in by the fill orifice and out by a leak at the far end, both by Eq. (8), which tells the flow and the
 * pressure at either end: Pn - P is what a smooth bore takes of their mean density, by Darcy and Weisbach. */
TEST(test_line_friction__steady_flow__loses_what_a_smooth_bore_does)
{
  static const double opening[] = {2e-8, 5e-6}, least[] = {10.0, 1e4}, most[] = {800.0, 1e5};
  const double length = 5.0, mu = 1.82e-5, quarter_pi = 0.785398163397448;
  for (int i = 0; i < 2; i++) {
    second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_PAPER);
    g.area = 12.566e-6, g.dead_volume = length * g.area;
    g.line_length = 1.0, g.line_friction = 1.3;
    g.leak_area = 0.2 * (g.fill_area = opening[i]);
    case_run(&g, 1.0, 50.0, 50.0);
    double rt = case_rt(&g), P = got.p[1] + g.ambient, Ps = g.supply + g.ambient;
    double q = g.leak_area * sqrt(2.0 * P * got.p[1] / rt), s = q / g.fill_area, Pn = Ps - s * s * rt / (2.0 * Ps);
    double bore = sqrt(g.area / quarter_pi), reynolds = q * bore / (g.area * mu), u = q / g.area;
    double factor = g.line_friction * (i ? 0.3164 / sqrt(sqrt(reynolds)) : 64.0 / reynolds);
    check_note("Re = %g, %g Pa lost", reynolds, Pn - P);
    assert_between(reynolds, least[i], most[i]);
    assert_close(Pn - P, factor * length / bore * u * u * rt / (Pn + P), 0, 2e-3);
  }
}

/* Steadily into a held pressure P, or out of it: by Eq. (8) the transducer tells Pt of q, and the line's equation is
 * that of a supply's, but for pressure and temperature ahead of it, Pu and Tu in place of Ps and Ts. */
TEST(test_tube_turbulence__held_pressure__steady_flow_solves_its_equation)
{
  for (int i = 0; i < 6; i++) {
    second_rig g = case_held(200e3);
    double c = (double[]){0.3, 0.7, 1.0}[i % 3], u = i < 3 ? 1.0 : -1.0, r = 2e8, P = g.start_pressure;
    g.stroke = 0.0;
    g.supply_temperature = 350.0;
    g.tube_volume = 1e-5;
    g.tube_resistance = r;
    g.tube_turbulence = c;
    second_audit before = case_run(&g, u, 1.0, 1.0), after = case_run(&g, u, 2.0, 1.0);
    double q = u > 0.0 ? after.mass_in - before.mass_in : after.mass_out - before.mass_out;
    double Ps = g.supply + g.ambient, s = 0.5 * q * q * g.gas_constant / (g.fill_area * g.fill_area);
    double in = Ps - s * g.supply_temperature / Ps, Pa = g.ambient;
    double out = 0.5 * (Pa + sqrt(Pa * Pa + 4.0 * s * g.ambient_temperature)), Pu = u > 0.0 ? in : P;
    double ahead = Ps / Pu * g.ambient_temperature / g.supply_temperature;
    check_note("c = %g, u = %g", c, u);
    assert_close(Pu - (u > 0.0 ? P : out), r * q * (1.0 - c + c * q / full_flow(&g) * ahead), 0, 1e-10);
  }
}

/* A tiny vessel behind a large orifice follows the supply. */
TEST(test_pulsation__tiny_vessel__follows_the_supply)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_PAPER);
  g.dead_volume = 1e-5;
  g.pulsation = 5e3;
  g.pulsation_rate = 2.0;
  case_run(&g, 1.0, 3.0, 0.01);
  for (size_t i = 150; i < got.n; i++)
    assert_close(got.p[i], g.supply + 5e3 * sin(2.0 * PI * 2.0 * got.t[i]), 300, 0);
}

/* ---- energy ---- */

/* (T - Ta) decays at hA/(m cv); hot air sealed in. */
TEST(test_heat__sealed_hot_air__cools_exponentially)
{
  second_rig g = case_vessel(SECOND_ENERGY, SECOND_CHOKED);
  g.heat = 0.8;
  g.start_temperature = 400.0;
  case_run(&g, 0.0, 3.0, 0.1);
  double rate = 0.8 / (got.m[0] * g.gas_constant / (g.gamma - 1.0));
  for (size_t i = 0; i < got.n; i++)
    assert_close(got.T[i] - g.ambient_temperature, (400.0 - g.ambient_temperature) * exp(-rate * got.t[i]), 1e-9, 0);
}

/* d' = -a d^(4/3): d^(-1/3) grows by a/3 a second. */
TEST(test_heat_natural__sealed_hot_air__follows_the_closed_form)
{
  second_rig g = case_vessel(SECOND_ENERGY, SECOND_CHOKED);
  g.heat_natural = 0.2;
  g.start_temperature = 400.0;
  case_run(&g, 0.0, 3.0, 0.1);
  double a = 0.2 / (got.m[0] * g.gas_constant / (g.gamma - 1.0)), d0 = 400.0 - g.ambient_temperature;
  for (size_t i = 0; i < got.n; i++)
    assert_close(got.T[i] - g.ambient_temperature, pow(1.0 / cbrt(d0) + a * got.t[i] / 3.0, -3.0), 1e-9, 0);
}

/* Air and wall, insulated from the rest, meet at the common mean. */
TEST(test_wall_capacity__insulated_wall__temperatures_meet_at_the_mean)
{
  second_rig g = case_vessel(SECOND_ENERGY, SECOND_CHOKED);
  g.heat = 1.0;
  g.wall_capacity = 5.0;
  g.start_temperature = 400.0;
  case_run(&g, 0.0, 20.0, 1.0);
  double c = got.m[0] * g.gas_constant / (g.gamma - 1.0);
  assert_close(case_last(got.T), (c * 400.0 + 5.0 * g.ambient_temperature) / (c + 5.0), 1e-8, 0);
}

TEST(test_heat__very_large__is_the_isothermal_chamber)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  case_run(&g, 1.0, 1.0, 0.5);
  double want = case_last(got.p);
  g.gas = SECOND_ENERGY;
  g.heat = 5e3;
  case_run(&g, 1.0, 1.0, 0.5);
  assert_close(case_last(got.p), want, 0, 2e-4);
}

/* ---- command ---- */

/* Into a held pressure the mass is the integral of the opening, t - T (1 - exp(-t/T)). */
TEST(test_transducer_lag__step__opening_rises_as_first_order)
{
  second_rig g = case_held(0.0);
  g.stroke = 0.0;
  g.transducer_lag = 0.1;
  double t = 0.25, in = case_run(&g, 1.0, t, t).mass_in;
  g.transducer_lag = 0.0;
  double full = case_run(&g, 1.0, 1.0, 1.0).mass_in;
  assert_close(in / full, t - 0.1 * (1.0 - exp(-t / 0.1)), 0, 1e-8);
}

TEST(test_dead_time__step__flow_starts_late_and_the_log_shows_the_command)
{
  static const double at[] = {0.1}, to[] = {1.0};
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.dead_time = 0.033;
  case_schedule(&g, at, to, 1, 0.2, 0.001);
  assert_true(got.u[99] == 0.0 && got.u[100] == 1.0);
  assert_true(got.m[133] == got.m[0] && got.m[134] > got.m[0]);
}

/* ---- force ---- */

/* Below break-away, F (1 + s), the stem stays; above, it goes. */
TEST(test_stribeck__push_around_the_break_away__stays_or_goes)
{
  for (int go = 0; go < 2; go++) {
    second_rig g = case_held((go ? 721.0 : 719.0) / 0.04);
    g.dry_friction = 480.0;
    g.stribeck = 0.5;
    g.stribeck_velocity = 1e-3;
    case_run(&g, 0.0, 0.5, 0.1);
    assert_int_equal(case_last(got.x) > 0.0, go);
  }
}

/* Far above vs it is Coulomb again: M v'= p A - F. */
TEST(test_stribeck__fast_slide__is_coulomb_friction)
{
  second_rig g = case_held(0.0);
  g.dry_friction = 480.0;
  g.stribeck = 0.5;
  g.stribeck_velocity = 1e-3;
  g.start_velocity = 5.0;
  case_run(&g, 0.0, 0.02, 0.01);
  assert_close(case_last(got.v), 5.0 - 240.0 * 0.02, 1e-7, 0);
}

/* Presliding by dz/dt = v - s0 |v| z/F: a load f < F is carried at x = -(F/s0) ln(1 - f/F). */
TEST(test_bristle__load_below_friction__creeps_to_the_presliding_distance)
{
  second_rig g = case_held(240.0 / 0.04);
  g.dry_friction = 480.0;
  g.bristle_rate = 1e6;
  g.bristle_damping = 1e3;
  g.viscous = 1e4;
  g.start_position = 0.3;
  case_run(&g, 0.0, 0.5, 0.1);
  assert_close(case_last(got.x) - 0.3, 480.0 / 1e6 * log(2.0), 1e-9, 0);
}

/* Sliding at a steady velocity it is F: v = (f - F)/c. */
TEST(test_bristle__steady_slide__is_coulomb_friction)
{
  second_rig g = case_held(600.0 / 0.04);
  g.dry_friction = 480.0;
  g.viscous = 1000.0;
  g.bristle_rate = 1e6;
  g.start_position = 0.1;
  case_run(&g, 0.0, 1.0, 0.5);
  assert_close(case_last(got.v), 0.12, 1e-9, 0);
}

/* Where a slide from x = 0 at v0 ends: the work of friction equals M v0^2/2. */
static double slide_end(const second_rig *g)
{
  second_audit a = case_run(g, 0.0, 1.0, 0.5);
  assert_true(case_last(got.v) == 0.0);
  double push = (g->start_pressure - g->ambient) * g->area * case_last(got.x);
  assert_close(a.dry, 0.5 * g->mass * g->start_velocity * g->start_velocity + push, 0, 1e-7);
  return case_last(got.x);
}

TEST(test_friction_position__slide__work_is_the_integral)
{
  second_rig g = case_held(0.0);
  g.dry_friction = 480.0;
  g.friction_position = 2.0;
  g.start_velocity = 8.0;
  double x = slide_end(&g);
  assert_close(480.0 * (x + x * x), 64.0, 0, 1e-6);
}

TEST(test_friction_pressure__slide__adds_in_proportion)
{
  second_rig g = case_held(5e3); /* pushes by 200 N, adds 400 N */
  g.dry_friction = 480.0;
  g.friction_pressure = 0.08;
  g.start_velocity = 8.0;
  assert_close(slide_end(&g), 64.0 / 680.0, 0, 1e-6);
}

TEST(test_bump__slide_across_it__takes_its_area)
{
  second_rig g = case_held(0.0);
  g.dry_friction = 480.0;
  g.bump = 300.0;
  g.bump_at = 0.05;
  g.bump_width = 0.005;
  g.start_velocity = 8.0;
  double area = 300.0 * 0.005 * sqrt(PI); /* its tails are whole within the slide */
  assert_close(slide_end(&g), (64.0 - area) / 480.0, 0, 1e-6);
}

/* p A = k x + k3 x^3 */
TEST(test_spring_cubic__held_pressure__balances)
{
  second_rig g = case_balance(500e3);
  g.spring_cubic = 4e6;
  case_run(&g, 0.0, 2.0, 1.0);
  double x = case_last(got.x);
  assert_close(1e5 * x + 4e6 * x * x * x, 500e3 * 0.04, 0, 1e-8);
}

/* On the way up the loop's force is H (1 - exp(-x/l)). */
TEST(test_hysteresis__held_pressure__balances_on_the_loading_branch)
{
  second_rig g = case_balance(100e3);
  g.hysteresis = 400.0;
  g.hysteresis_length = 0.02;
  case_run(&g, 0.0, 2.0, 1.0);
  double x = case_last(got.x);
  assert_close(1e5 * x + 400.0 * (1.0 - exp(-x / 0.02)), 100e3 * 0.04, 0, 1e-8);
}

/* p A (1 - a x/stroke) = k x, and the volume swept is A (x - a x^2/(2 stroke)). */
TEST(test_area_slope__held_pressure__force_and_volume_agree)
{
  second_rig g = case_balance(500e3);
  g.area_slope = 0.2;
  second_audit a = case_run(&g, 0.0, 2.0, 1.0);
  double x = 500e3 * 0.04 / (1e5 + 500e3 * 0.04 * 0.2);
  assert_close(case_last(got.x), x, 0, 1e-8);
  assert_close(a.volume_end - a.volume_start, 0.04 * (x - 0.1 * x * x), 1e-6, 0);
}

TEST(test_travel_limit__large_push__stops_there)
{
  second_rig g = case_balance(500e3);
  g.travel_limit = 0.123;
  case_run(&g, 0.0, 2.0, 1.0);
  assert_true(case_last(got.x) == 0.123);
}

/* k x + ks (x - limit) = p A */
TEST(test_upper_rate__large_push__yields_elastically)
{
  second_rig g = case_balance(500e3);
  g.travel_limit = 0.1;
  g.upper_rate = 1e6;
  g.stop_damping = 100.0;
  case_run(&g, 0.0, 2.0, 1.0);
  assert_close(case_last(got.x), (500e3 * 0.04 + 1e6 * 0.1) / (1e5 + 1e6), 0, 1e-8);
}

TEST(test_lower_rate__preload__rests_below_zero)
{
  second_rig g = case_balance(0.0);
  g.spring_preload = 0.01;
  g.lower_rate = 1e7;
  case_run(&g, 0.0, 1.0, 0.5);
  assert_close(case_last(got.x), -1e5 * 0.01 / (1e5 + 1e7), 1e-12, 0);
}

/* Amplitude of a forced, damped mass on a spring. */
TEST(test_force__periodic__swings_by_the_transfer_function)
{
  second_rig g = case_balance(500e3); /* about x = 0.2 m */
  g.force = 500.0;
  g.force_rate = 5.0;
  g.viscous = 800.0;
  case_run(&g, 0.0, 2.0, 0.001);
  double w = 2.0 * PI * 5.0, re = 1e5 - g.mass * w * w, im = 800.0 * w, gain = 500.0 / (re * re + im * im);
  for (size_t i = 1500; i < got.n; i++) {
    double a = w * got.t[i];
    assert_close(got.x[i], 0.2 - gain * (re * sin(a) - im * cos(a)), 1e-8, 0);
  }
}

/* ---- measuring chain ---- */

TEST(test_bias_and_gain__measured__are_affine)
{
  static double p[CASE_SAMPLES], x[CASE_SAMPLES];
  second_rig g = second_rig_default_r1_400();
  case_run(&g, 1.0, 2.0, 0.01);
  memcpy(p, got.p, sizeof p);
  memcpy(x, got.x, sizeof x);
  g.pressure_bias = 1500.0;
  g.pressure_gain = 0.02;
  g.position_bias = -1e-4;
  g.position_gain = -0.01;
  case_run(&g, 1.0, 2.0, 0.01);
  for (size_t i = 0; i < got.n; i++) {
    assert_close(got.p[i], 1.02 * p[i] + 1500.0, 1e-9, 1e-14);
    assert_close(got.x[i], 0.99 * x[i] - 1e-4, 1e-16, 1e-14);
  }
}

/* A first-order sensor on a ramp trails by rate times lag. Constant choked flow makes the pressure a ramp. */
TEST(test_pressure_lag__ramp__trails_by_rate_times_lag)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.pressure_lag = 0.02;
  double q = g.fill_area * case_choked(&g) * (g.supply + g.ambient) / sqrt(case_rt(&g));
  double rate = q * case_rt(&g) / g.dead_volume;
  case_run(&g, 1.0, 0.6, 0.1);
  for (size_t i = 0; i < got.n; i++) {
    double t = got.t[i];
    assert_close(got.p[i], rate * (t - 0.02 * (1.0 - exp(-t / 0.02))), 1e-6, 1e-8);
  }
}

TEST(test_position_lag__uniform_motion__trails_by_velocity_times_lag)
{
  second_rig g = case_held(0.0);
  g.position_lag = 0.02;
  g.start_velocity = 0.5;
  case_run(&g, 0.0, 0.6, 0.1);
  for (size_t i = 0; i < got.n; i++) {
    double t = got.t[i];
    assert_close(got.x[i], 0.5 * (t - 0.02 * (1.0 - exp(-t / 0.02))), 1e-8, 0);
  }
}

/* Two first-order lags in series: air cooling at rate a, read with rate b. */
TEST(test_temperature_lag__sealed_hot_air__is_two_lags_in_series)
{
  second_rig g = case_vessel(SECOND_ENERGY, SECOND_CHOKED);
  g.heat = 0.8;
  g.temperature_lag = 0.2;
  g.start_temperature = 400.0;
  case_run(&g, 0.0, 3.0, 0.1);
  double a = 0.8 / (got.m[0] * g.gas_constant / (g.gamma - 1.0)), b = 5.0, d = 400.0 - g.ambient_temperature;
  for (size_t i = 0; i < got.n; i++) {
    double t = got.t[i], want = d * (b * exp(-a * t) - a * exp(-b * t)) / (b - a);
    assert_close(got.T[i] - g.ambient_temperature, want, 1e-8, 0);
  }
}

/* Late by 3 samples, the position channel is the true one of 3 rows before; early, of 3 rows after. */
TEST(test_position_skew__uniform_motion__shifts_that_channel_only)
{
  for (int late = 0; late < 2; late++) {
    second_rig g = case_held(0.0);
    g.start_velocity = 0.5;
    g.position_skew = late ? 0.0123 : -0.0123;
    case_run(&g, 0.0, 0.5, 0.01);
    for (size_t i = 2; i < got.n; i++)
      assert_close(got.x[i], 0.5 * (got.t[i] - g.position_skew), 1e-9, 0);
  }
}

static void mean_and_deviation(const double *y, double *mean, double *deviation)
{
  double s = 0.0, q = 0.0;
  for (size_t i = 0; i < got.n; i++)
    s += y[i];
  *mean = s / (double)got.n;
  for (size_t i = 0; i < got.n; i++)
    q += (y[i] - *mean) * (y[i] - *mean);
  *deviation = sqrt(q / (double)(got.n - 1));
}

/* 4,001 draws: the mean is known to 1.6 %, the deviation to 1.1 % of it; four of those allowed. */
TEST(test_noise__many_samples__has_the_given_deviation_and_no_bias)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.pressure_noise = 320.0;
  g.position_noise = 2e-5;
  g.temperature_noise = 0.1;
  double mean, deviation;
  case_run(&g, 0.0, 4.0, 0.001);
  mean_and_deviation(got.p, &mean, &deviation);
  assert_close(mean, 0.0, 0.065 * 320.0, 0);
  assert_close(deviation, 320.0, 0, 0.045);
  mean_and_deviation(got.x, &mean, &deviation);
  assert_close(mean, 0.0, 0.065 * 2e-5, 0);
  assert_close(deviation, 2e-5, 0, 0.045);
  mean_and_deviation(got.T, &mean, &deviation);
  assert_close(mean, g.ambient_temperature, 0.065 * 0.1, 0);
  assert_close(deviation, 0.1, 0, 0.045);
}

TEST(test_noise__channels_and_seeds__are_independent)
{
  static double first[CASE_SAMPLES];
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED);
  g.pressure_noise = g.position_noise = 1.0;
  case_run(&g, 0.0, 4.0, 0.001);
  memcpy(first, got.p, sizeof first);
  double same = 0.0, other = 0.0, next = 0.0;
  for (size_t i = 0; i < got.n; i++)
    same += got.p[i] * got.x[i];
  for (size_t i = 1; i < got.n; i++)
    next += got.p[i] * got.p[i - 1];
  g.seed = 1;
  case_run(&g, 0.0, 4.0, 0.001);
  for (size_t i = 0; i < got.n; i++)
    other += got.p[i] * first[i];
  assert_close(same / (double)got.n, 0.0, 0.065, 0);
  assert_close(next / (double)got.n, 0.0, 0.065, 0);
  assert_close(other / (double)got.n, 0.0, 0.065, 0);
}

TEST(test_range__quantised__every_value_is_a_code)
{
  second_rig g = second_rig_default_r1_400();
  g.pressure_range = 1e6;
  g.position_range = 0.05;
  case_run(&g, 1.0, 2.0, 0.001);
  for (size_t i = 0; i < got.n; i++) {
    double p = got.p[i] / (1e6 / 16384.0), x = got.x[i] / (0.05 / 16384.0);
    assert_close(p, floor(p + 0.5), 1e-9, 0);
    assert_close(x, floor(x + 0.5), 1e-9, 0);
  }
}

/* ---- together ---- */

static const double at[] = {0.1, 1.5, 2.5, 3.0, 4.0}, to[] = {1.0, -0.5, 0.0, 0.8, -1.0};

/* Everything at once: the audits still close, and the run is worth its name. */
TEST(test_second_run__all_effects_at_once__audits_close)
{
  second_rig g = second_rig_default_r1_400();
  g.gas = SECOND_ENERGY;
  g.flow = SECOND_CHOKED;
  g.dead_volume = 4e-5;
  g.leak_area = 1e-8;
  g.laminar_leak = 1e-16;
  g.relief_area = 1e-8, g.relief_from = 2e5, g.relief_span = 1e3;
  g.heat = 2.0, g.heat_natural = 0.1, g.wall_capacity = 50.0, g.wall_loss = 1.0;
  g.supply_droop = 1e7, g.back_pressure = 5e6, g.pulsation = 2e3, g.pulsation_rate = 3.0;
  g.supply_turbulence = 0.5, g.supply_volume = 1e-4;
  g.tube_volume = 2e-5, g.tube_resistance = 1e7, g.tube_turbulence = 0.7;
  g.transducer_lag = 0.02, g.dead_time = 0.013;
  g.stribeck = 0.2, g.stribeck_velocity = 5e-3;
  g.friction_position = 0.2, g.friction_pressure = 1e-4;
  g.bump = 200.0, g.bump_at = 0.012, g.bump_width = 1e-3;
  g.spring_cubic = 1e7, g.hysteresis = 100.0, g.hysteresis_length = 2e-3;
  g.area_slope = 0.1, g.travel_limit = 0.019, g.upper_rate = 1e7, g.stop_damping = 1e3;
  g.force = 20.0, g.force_rate = 2.0;
  second_audit a = case_schedule(&g, at, to, 5, 6.0, 0.01);
  double turnover = a.enthalpy_in + a.enthalpy_out, work = a.gas_work - g.ambient * (a.volume_end - a.volume_start);
  assert_true(a.mass_in > 1e-3 && a.mass_out > 1e-3 && a.dry > 5.0);
  assert_close(a.mass_end - a.mass_start, a.mass_in - a.mass_out, 1e-12 * a.mass_in, 0);
  assert_close(a.energy_end - a.energy_start, a.enthalpy_in - a.enthalpy_out + a.heat - a.gas_work, 1e-10 * turnover,
               0);
  double taken =
      a.kinetic_end - a.kinetic_start + a.spring_end - a.spring_start + a.dry + a.viscous + a.impact + a.other;
  assert_close(work, taken, 1e-5 * a.dry, 0);
}
