/* Effects on mass, energy and command: what each does to a vessel or a stroke. */
#include "../footprint.h"

/* ---- mass ---- */

static pneu_state run_vessel(const pneu_params *p, int gas, int flow, double from, double u, double time)
{
  const pneu_model m = fixture_model(p, gas, flow);
  const pneu_input shut = fixture_input(&m, 0), input = fixture_input(&m, u);
  pneu_state s = fixture_rest(&m, from, 0, &shut);
  fixture_run(&m, &s, &input, time, FIXTURE_TOL, NULL);
  return s;
}

/* Choked leak from a shut isothermal vessel: exponential at the rate of its area. */
FOOTPRINT(chamber_leak, shut_vessel__loses_pressure_as_a_choked_blowdown)
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
  { /* a leak that chokes says nothing about the transducer: shut, filling beyond its critical pressure, before it */
    static const double u[] = {0, 1, 1}, pressure[] = {3e5, 3e5, 1e5};
    const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
    int i;
    for (i = 0; i < COUNT(u); i++) {
      const pneu_input input = fixture_input(&m, u[i]);
      s = fixture_rest(&m, pressure[i], 0, &input);
      check_note("u = %g at %g Pa", u[i], pressure[i]);
      assert_true(fixture_look(&m, &s, &input).out > 0);
      assert_int_equal(fixture_look(&m, &s, &input).choked, i == 2);
    }
  }
}

/* q = c (p^2 - p_a^2) in a shut vessel: (p - p_a)/(p + p_a) decays at 2 p_a c R T/V, from above and below; under the
 * energy law, filled from vacuum, at gamma times that. */
static double seeped(const pneu_params *p, double from, double rate, double time)
{
  const double pa = (double)p->ambient_pressure, ratio = from / (from + 2 * pa) * exp(-2 * pa * rate * time);
  return 2 * pa * ratio / (1 - ratio);
}

FOOTPRINT(laminar_leak, shut_vessel__follows_the_closed_form)
{
  static const double from[] = {4e5, 2e4, -5e4};
  pneu_params p = fixture_vessel(1e-3);
  const double c = 1e-15, rate = c * (double)p.gas_constant * (double)p.ambient_temperature / 1e-3;
  int i;
  fixture_set(&p, "laminar_leak", c);
  for (i = 0; i < COUNT(from); i++)
    assert_close(run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, from[i], 0, 20).p, seeped(&p, from[i], rate, 20),
                 TOL(1e-4, 20), TOL(1e-9, 1e-4));
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, -5e4, 0, 20).p, seeped(&p, -5e4, 1.4 * rate, 20),
               TOL(1e-4, 20), TOL(1e-9, 1e-4));
  {
    const fixture_rig rig = fixture_at(fixture_pressed(&p), 0, 2e5, 0);
    assert_close(fixture_see(&rig).out, 0, 0, 0);
  }
}

/* With the exponent of the rate alone, a choked isothermal leak decays n times as fast, and the temperature stays. */
static void exponent_of_rate(double n)
{
  pneu_params p = fixture_vessel(1e-4);
  const double g = 1.4, R = (double)p.gas_constant, T = 298.15, pa = (double)p.ambient_pressure;
  const double c = sqrt(g / R) * pow(2 / (g + 1), (g + 1) / (2 * (g - 1)));
  pneu_state s;
  if (pneu_effect_find("chamber_leak") < 0)
    return;
  fixture_set(&p, "leak_area", 2e-8);
  fixture_set(&p, "rate_exponent_rise", n - 1);
  s = run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 5e5, 0, 10);
  assert_close((double)s.p + pa, (5e5 + pa) * exp(-2e-8 * c * R * sqrt(T) / 1e-4 * n * 10), 0, TOL(1e-8, 1e-4));
  assert_close(s.T, p.ambient_temperature, 0, 0);
}

/* Shut air that is compressed follows p V^n = const, T V^(n-1) = const; a film decides where there is one, and so does
 * another law. */
FOOTPRINT(chamber_exponent, shut_air__follows_its_power_law)
{
  const double n = 1.25;
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  double share, start;
  fixture_set(&p, "exponent_rise", n - 1);
  rig = fixture_at(fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 1), 0, 2e5, 0.015);
  start = (double)rig.s.p + (double)p.ambient_pressure;
  share = (double)pneu_volume(&rig.m, rig.s.x);
  rig.input.position_rate = (pneu_real)-0.01;
  fixture_go(&rig, 1, TOL(1e-9, 1e-5), NULL);
  share /= (double)pneu_volume(&rig.m, rig.s.x);
  assert_between(share, 1.5, 4);
  assert_close((double)rig.s.p + (double)p.ambient_pressure, start * pow(share, n), 0, TOL(1e-7, 1e-4));
  assert_close((double)rig.s.T, (double)p.ambient_temperature * pow(share, n - 1), 0, TOL(1e-7, 1e-4));
  assert_close((double)fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER).g, (double)p.heat_ratio, 0, 0);
  exponent_of_rate(n);
  if (pneu_effect_find("heat_transfer") >= 0) {
    fixture_set(&p, "film_resistance", 0.2);
    assert_close((double)fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).g, (double)p.heat_ratio, 0, 0);
  }
}

/* The flow solves s = q/c + (q/(c p_c))^2, s = p^2 - p_a^2 by size, from inside and outside; slow, it is laminar. */
FOOTPRINT(porous_leak, flow__solves_its_law_both_ways)
{
  static const double at[] = {7e5, 2e5, 1e3, -5e4};
  pneu_params p = fixture_vessel(1e-3);
  const double c = 2e-15, crossover = 4e5, pa = (double)p.ambient_pressure;
  int i, driven;
  fixture_set(&p, "porous_leak", c);
  fixture_set(&p, "crossover_pressure", crossover);
  for (i = 0; i < COUNT(at); i++) {
    const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, at[i], 0);
    const fixture_sample f = fixture_see(&rig);
    const double q = f.out - f.in, share = q / (c * crossover), squared = at[i] * (at[i] + 2 * pa);
    assert_close(q / c + share * fabs(share), squared, 0, TOL(1e-12, 1e-5));
  }
  fixture_set(&p, "crossover_pressure", 1e8);
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, -5e4, 0, 20).p,
               seeped(&p, -5e4, 1.4 * c * (double)p.gas_constant * (double)p.ambient_temperature / 1e-3, 20), 0,
               TOL(1e-4, 1e-3));
  for (driven = 0; driven < 2; driven++) {
    const fixture_rig rig =
        fixture_at(fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, driven, 0), 0, 2e5, 0);
    assert_true(driven == !(fixture_see(&rig).out > 0));
  }
}

static double inflow(const pneu_params *p, int flow, double pressure)
{
  const fixture_rig rig = fixture_at(fixture_model(p, PNEU_GAS_ISOTHERMAL, flow), 1, pressure, 0);
  return fixture_see(&rig).in;
}

FOOTPRINT(choked_flow, share__mixes_the_laws)
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
    fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 1, 0, 0);
    assert_true(fixture_see(&rig).choked);
    rig.s = fixture_rest(&rig.m, 3e5, 0, &rig.input);
    assert_false(fixture_see(&rig).choked);
  }
}

/* The flow through an orifice of 1 mm2 that a pressure lost before or built up behind it leaves. */
static pneu_flow orifice_between(const pneu_model *m, double up, double down)
{
  pneu_flow flow;
  pneu_orifice(m, m->law.flow, (pneu_real)1e-6, (pneu_real)up, m->p.supply_temperature, (pneu_real)down, &flow);
  return flow;
}

static double flow_between(const pneu_model *m, double up, double down)
{
  return orifice_between(m, up, down).q;
}

/* Flow into or out of the vessel at p by a law of which a quarter follows the nozzle; both are solved for, whatever the
 * resistance before the fill or behind the vent. The flow that belongs to the pressure which the resistance leaves is
 * off by more than the flow itself: R times the orifice's slope more, which is taken out. */
static void check_mixed_series(double resistance, double p_in, int fill)
{
  pneu_params p = fixture_vessel(1e-4);
  const double pa = (double)p.ambient_pressure;
  double q, up, down, off, slope;
  pneu_flow paper, choked;
  pneu_model m, nozzle;
  pneu_input input;
  pneu_state s;
  fixture_set(&p, "choked_share", 0.25);
  fixture_set(&p, fill ? "supply_resistance" : "exhaust_resistance", resistance);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  nozzle = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  input = fixture_input(&m, fill ? 1 : -1);
  s = fixture_rest(&m, p_in, 0, &input);
  q = fill ? fixture_look(&m, &s, &input).in : fixture_look(&m, &s, &input).out;
  up = fill ? 4e5 + pa - resistance * q : p_in + pa;
  down = fill ? p_in + pa : pa + resistance * q;
  paper = orifice_between(&m, up, down);
  choked = orifice_between(&nozzle, up, down);
  slope =
      0.75 * (double)(fill ? paper.dq_dup : -paper.dq_ddown) + 0.25 * (double)(fill ? choked.dq_dup : -choked.dq_ddown);
  off = (q - 0.75 * (double)paper.q - 0.25 * (double)choked.q) / (1 + resistance * slope);
  check_note("%s through %g Pa s/kg, %g Pa", fill ? "fill" : "vent", resistance, p_in);
  assert_close(q, q - off, 0, TOL(1e-9, 5e-3));
  assert_true(q > 0);
}

static void check_all_mixed_series(void)
{
  static const double resistance[] = {1e5, 1e6, 1e7, 1e8, 1e9}, at[] = {1e4, 1e5, 2e5, 3.5e5, 3.98e5};
  int i, k, fill;
  for (fill = 0; fill < 2; fill++)
    for (i = 0; i < COUNT(resistance); i++)
      for (k = 0; k < COUNT(at); k++)
        check_mixed_series(resistance[i], at[k], fill);
}

/* Choked flow of the fill orifice, fully open. */
static double full_flow(const pneu_model *m)
{
  const double g = (double)m->p.heat_ratio, R = (double)m->p.gas_constant, T = (double)m->p.supply_temperature;
  const double gain = sqrt(g / R) * pow(2 / (g + 1), (g + 1) / (2 * (g - 1))) / sqrt(T);
  return gain * (double)m->p.fill_area * (double)(m->p.supply_pressure + m->p.ambient_pressure);
}

/* What a line of which a share c is turbulent loses of p_up - p_down at flow q: [Pa]. Its orifice passes the full flow
 * at the loss that its resistance has there, taken for a thousandth of the pressure. */
static double line_loss(const pneu_model *m, double resistance, double c, double p_up, double T_up, double p_down,
                        double q)
{
  const double little = 1e-3, ps = (double)(m->p.supply_pressure + m->p.ambient_pressure), qf = full_flow(m);
  double area;
  pneu_flow flow;
  pneu_orifice(m, m->law.flow, 1, (pneu_real)ps, m->p.supply_temperature, (pneu_real)(ps * (1 - little)), &flow);
  area = qf / ((double)flow.q * sqrt(resistance * c * qf / (little * ps)));
  pneu_orifice(m, m->law.flow, (pneu_real)area, (pneu_real)p_up, (pneu_real)T_up, (pneu_real)p_down, &flow);
  return resistance * (1 - c) * q + (p_up - p_down) * pow(q / (double)flow.q, 2);
}

/* A vessel whose supply is warmer than the room, and where ISO 6358 is no root of the difference. */
static pneu_params warm_supply(void)
{
  pneu_params p = fixture_vessel(1e-3);
  p.supply_temperature = 350;
  p.subsonic_index = (pneu_real)0.45;
  return p;
}

/* In series with the fill orifice: both pass the same. */
static void check_turbulent_series(int flow, double resistance, double c, double p_in)
{
  pneu_params p = warm_supply();
  const double pa = (double)p.ambient_pressure, ps = 4e5 + pa;
  double loss, q;
  fixture_rig rig;
  pneu_flow orifice;
  fixture_set(&p, "supply_resistance", resistance);
  fixture_set(&p, "supply_turbulence", c);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, flow), 1, p_in, 0);
  q = fixture_see(&rig).in;
  loss = 4e5 - fixture_see(&rig).supply;
  pneu_orifice(&rig.m, flow, p.fill_area, (pneu_real)(ps - loss), p.supply_temperature, (pneu_real)(p_in + pa),
               &orifice);
  check_note("%s, %g Pa s/kg, c = %g into %g Pa", pneu_flow_key(flow), resistance, c, p_in);
  assert_close(line_loss(&rig.m, resistance, c, ps, 350, ps - loss, q), loss, 0, TOL(1e-12, 1e-2));
  assert_close(q, (double)orifice.q, 0, TOL(1e-13, 1e-2));
}

static void check_all_turbulent_series(void)
{
  static const double resistance[] = {1e6, 2e7, 5e8}, share[] = {0.2, 0.7, 1}, at[] = {0, 2e5, 3.5e5};
  int flow, i, k, j;
  for (flow = 0; flow < PNEU_FLOW_COUNT; flow++)
    for (i = 0; i < COUNT(resistance); i++)
      for (k = 0; k < COUNT(share); k++)
        for (j = 0; j < COUNT(at); j++)
          check_turbulent_series(flow, resistance[i], share[k], at[j]);
}

/* The pressure at the transducer, shares of the supply's, a time after it stood at `from`. */
static double line_recovers(const pneu_params *p, int flow, double from, double u, double time)
{
  fixture_rig rig = fixture_at(fixture_model(p, PNEU_GAS_ISOTHERMAL, flow), u, 0, 0);
  assert_close(rig.s.extra[0], 1, 0, TOL(1e-15, 1e-7));
  rig.s.extra[0] = (pneu_real)from;
  fixture_go(&rig, time, FIXTURE_TOL, NULL);
  assert_close((fixture_see(&rig).supply + 101325) / (double)rig.m.scale[0], rig.s.extra[0], 0, TOL(1e-14, 1e-6));
  return (double)rig.s.extra[0];
}

/* Shut, a volume behind a resistance recovers as exp(-t R_g T/(R V)); drawn from by a choked flow K p_l, it falls to
 * 1/(1 + R K); behind an orifice that obeys [B, Eq. 8] the root of what is left falls by (R_g T/V) sqrt(q_f/R)/2 a
 * second. */
static void check_supply_volume(void)
{
  pneu_params p = warm_supply();
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  const double ps = 4e5 + (double)p.ambient_pressure, R = 2e8, k = (double)p.gas_constant * 350 / 2e-5;
  const double RK = R * full_flow(&m) / ps, end = 1 / (1 + RK), fell = end + (1 - end) * exp(-0.02 * k / R / end);
  const double slower = k * sqrt(full_flow(&m) / R / ps) / 2 * 0.01;
  fixture_set(&p, "supply_resistance", R);
  fixture_set(&p, "supply_volume", 2e-5);
  check_note("a volume behind the supply's resistance");
  assert_close(line_recovers(&p, PNEU_FLOW_PAPER, 0.6, 0, 0.03), 1 - 0.4 * exp(-0.03 * k / R), 0, TOL(1e-10, 1e-5));
  assert_close(line_recovers(&p, PNEU_FLOW_PAPER, 1.2, 0, 0.03), 1 + 0.2 * exp(-0.03 * k / R), 0, TOL(1e-10, 1e-5));
  assert_close(line_recovers(&p, PNEU_FLOW_CHOKED, 1, 1, 0.02), fell, 0, TOL(1e-10, 1e-5));
  fixture_set(&p, "supply_turbulence", 1);
  assert_close(line_recovers(&p, PNEU_FLOW_PAPER, 0.6, 0, 0.01), 1 - pow(sqrt(0.4) - slower, 2), 0, TOL(1e-10, 1e-5));
}

/* A volume lends the vessel some of the air that it loses itself; the less there is, the closer it is to none. */
static void check_small_supply_volume(void)
{
  static const double volume[] = {1e-5, 1e-6, 1e-7};
  pneu_params p = fixture_vessel(1e-3);
  double want, lent;
  int i, flow;
  fixture_set(&p, "supply_resistance", 2e8);
  fixture_set(&p, "supply_turbulence", 0.6);
  for (flow = PNEU_FLOW_PAPER; flow <= PNEU_FLOW_CHOKED; flow++) {
    fixture_set(&p, "supply_volume", 0);
    want = (double)run_vessel(&p, PNEU_GAS_ISOTHERMAL, flow, 0, 1, 0.5).p;
    for (i = 0; i < COUNT(volume); i++) {
      fixture_set(&p, "supply_volume", volume[i]);
      lent = (double)run_vessel(&p, PNEU_GAS_ISOTHERMAL, flow, 0, 1, 0.5).p - want;
      check_note("%s, %g m3", pneu_flow_key(flow), volume[i]);
      assert_between(lent * 1e-3 / volume[i], TOL(5e4, -5e6), TOL(4e5, 5e6));
    }
  }
}

/* What flows back out of a vessel is in the volume: p V of both together grows by no more than what the line lets
 * through, which is next to nothing. */
static void check_backflow(void)
{
  pneu_params p = fixture_vessel(1e-4);
  double held, left;
  fixture_rig rig;
  fixture_set(&p, "supply_resistance", 1e10);
  fixture_set(&p, "supply_volume", 5e-5);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED), 1, 3e5, 0);
  rig.s.extra[0] = (pneu_real)0.4;
  held = 1e-4 * (3e5 + (double)p.ambient_pressure) + 5e-5 * 0.4 * (double)rig.m.scale[0];
  fixture_go(&rig, 0.02, FIXTURE_TOL, NULL);
  left = 1e-4 * (double)(rig.s.p + p.ambient_pressure) + 5e-5 * (double)(rig.s.extra[0] * rig.m.scale[0]);
  check_note("a vessel that fills the supply's volume");
  assert_between(left / held, 1 - TOL(1e-9, 1e-4), 1 + 2e-3);
  assert_between(rig.s.p, 2e5, 2.9e5);
}

/* Without a fill orifice there is no flow to compare with, and a line resists in proportion; where the vessel is fuller
 * than the supply, what it loses on the way there is above it; a pressure that is the input draws nothing. */
static void check_odd_lines(void)
{
  pneu_params p = fixture_vessel(1e-4);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  double supply;
  fixture_set(&p, "supply_resistance", 1e8);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  input = fixture_input(&m, 1);
  input.supply_pressure = 100000;
  s = fixture_rest(&m, 3e5, 0, &input);
  supply = (double)fixture_look(&m, &s, &input).supply;
  assert_close(supply, 1e5 + 1e8 * (double)fixture_look(&m, &s, &input).out, 1, 0);
  fixture_set(&p, "supply_volume", 1e-4);
  fixture_set(&p, "supply_turbulence", 1);
  p.fill_area = 0;
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  s = fixture_rest(&m, 0, 0, &input);
  s.extra[0] = (pneu_real)0.5;
  fixture_run(&m, &s, &input, 0.01, FIXTURE_TOL, NULL);
  supply = (1e5 + (double)p.ambient_pressure) / (double)m.scale[0];
  assert_close(s.extra[0],
               supply + (0.5 - supply) * exp(-0.01 * (double)p.gas_constant * (double)p.supply_temperature / 1e4), 0,
               TOL(1e-9, 1e-5));
}

FOOTPRINT(supply_droop, filling__is_slowed_and_venting_is_not)
{
  static const double at[] = {0, 2e5, 3.5e5, 3.98e5};
  const pneu_params base = fixture_vessel(1e-4);
  pneu_params p = base;
  const double resistance = 5e7, pa = (double)base.ambient_pressure;
  int i, flow;
  fixture_set(&p, "supply_resistance", resistance);
  for (flow = PNEU_FLOW_PAPER; flow <= PNEU_FLOW_CHOKED; flow++)
    for (i = 0; i < COUNT(at); i++) {
      const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, flow), 1, at[i], 0);
      const fixture_sample look = fixture_see(&rig);
      check_note("%s from %g Pa", pneu_flow_key(flow), at[i]);
      assert_close(look.in, flow_between(&rig.m, 4e5 + pa - resistance * look.in, at[i] + pa), 0, TOL(1e-8, 1e-2));
      assert_close(look.supply, 4e5 - resistance * look.in, TOL(1e-6, 1), 0);
      assert_true(look.in < 0.99 * inflow(&base, flow, at[i]));
    }
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 4e5, -1, 0.1).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 4e5, -1, 0.1).p, TOL(1e-3, 10), 0);
  check_all_mixed_series();
  check_all_turbulent_series();
  check_supply_volume();
  check_small_supply_volume();
  check_backflow();
  check_odd_lines();
}

FOOTPRINT(exhaust_back_pressure, venting__is_slowed_and_filling_is_not)
{
  static const double at[] = {4e5, 1e5, 1e4, 2e3};
  const pneu_params base = fixture_vessel(1e-4);
  pneu_params p = base;
  const double resistance = 5e7, pa = (double)base.ambient_pressure;
  int i, flow;
  fixture_set(&p, "exhaust_resistance", resistance);
  for (flow = PNEU_FLOW_PAPER; flow <= PNEU_FLOW_CHOKED; flow++)
    for (i = 0; i < COUNT(at); i++) {
      const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, flow), -1, at[i], 0);
      const fixture_sample look = fixture_see(&rig);
      check_note("%s from %g Pa", pneu_flow_key(flow), at[i]);
      assert_close(look.out, flow_between(&rig.m, at[i] + pa, pa + resistance * look.out), 0, TOL(1e-8, 1e-2));
      assert_true(look.out > 0 && (look.out < 0.99 * flow_between(&rig.m, at[i] + pa, pa) || at[i] > 3e5));
    }
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1, 0.05).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1, 0.05).p, TOL(1e-3, 10), 0);
}

/* Venting takes 1/(1 - r) of the time, filling what it took. */
FOOTPRINT(vent_restriction, venting__takes_longer_and_filling_does_not)
{
  const pneu_params base = fixture_vessel(1e-3);
  pneu_params p = base;
  fixture_set(&p, "vent_restriction", 0.2);
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 4e5, -1, 0.5).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 4e5, -1, 0.4).p, TOL(0.01, 20), 0);
  assert_close(run_vessel(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1, 0.5).p,
               run_vessel(&base, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1, 0.5).p, TOL(0.01, 20), 0);
}

/* Flow out of a tube at pressure p_tube into the chamber at p [Pa abs], both at rest. */
static double tube_flow(const pneu_params *p, int flow, double p_tube, double p_chamber)
{
  fixture_rig rig =
      fixture_at(fixture_model(p, PNEU_GAS_ISOTHERMAL, flow), 0, p_chamber - (double)p->ambient_pressure, 0);
  fixture_sample look;
  rig.s.extra[0] = (pneu_real)(p_tube / (double)rig.m.scale[0]);
  look = fixture_see(&rig);
  return look.in - look.out;
}

/* Either way, a line loses what there is to lose. */
static void check_turbulent_tube(int flow, double c, double p_tube, double p_chamber)
{
  pneu_params p = warm_supply();
  const double up = p_tube > p_chamber ? p_tube : p_chamber, down = p_tube > p_chamber ? p_chamber : p_tube;
  pneu_model m;
  double q;
  fixture_set(&p, "tube_resistance", 3e7);
  fixture_set(&p, "tube_turbulence", c);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, flow);
  q = tube_flow(&p, flow, p_tube, p_chamber);
  check_note("%s, c = %g, from %g to %g Pa", pneu_flow_key(flow), c, p_tube, p_chamber);
  assert_true((q > 0) == (p_tube > p_chamber));
  assert_close(line_loss(&m, 3e7, c, up, (double)p.ambient_temperature, down, fabs(q)), up - down, 0, TOL(1e-13, 1e-3));
}

/* At the full flow of the fill orifice a line from the supply pressure loses R q_f, whatever the share is; a fourth of
 * the loss passes half the flow where all of it is turbulent, and a fourth where none is. That is exact under [B, Eq.
 * 8], and under the others while the loss is little. */
static void check_share_of_turbulence(void)
{
  static const double share[] = {0, 0.3, 1};
  pneu_params p = fixture_vessel(1e-3);
  const double ps = 4e5 + (double)p.ambient_pressure, R = 1e7;
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const double qf = full_flow(&m), fourth = R * qf / 4;
  int flow, i;
  fixture_set(&p, "tube_resistance", R);
  for (flow = 0; flow < PNEU_FLOW_COUNT; flow++)
    for (i = 0; i < COUNT(share); i++) {
      const double within = flow == PNEU_FLOW_PAPER ? TOL(1e-13, 1e-4) : 2e-2;
      fixture_set(&p, "tube_turbulence", share[i]);
      check_note("%s, c = %g, %g Pa of %g", pneu_flow_key(flow), share[i], R * qf, ps);
      assert_close(tube_flow(&p, flow, ps, ps - R * qf), qf, 0, within);
      if (share[i] == 1)
        assert_close(tube_flow(&p, flow, ps, ps - fourth), qf / 2, 0, within);
      if (share[i] == 0)
        assert_close(tube_flow(&p, flow, ps, ps - fourth), qf / 4, 0, TOL(1e-13, 1e-4));
    }
}

static void check_all_turbulent_tubes(void)
{
  static const double share[] = {0.3, 0.7, 1}, at[] = {1.1e5, 2.6e5, 4.8e5, 4.9e5, 5e5};
  int flow, i, k, j;
  for (flow = 0; flow < PNEU_FLOW_COUNT; flow++)
    for (i = 0; i < COUNT(share); i++)
      for (k = 0; k < COUNT(at); k++)
        for (j = 0; j < COUNT(at); j++)
          if (k != j)
            check_turbulent_tube(flow, share[i], at[k], at[j]);
}

/* Constant choked inflow q into V_t, then R, then V: with k = R_g T/V the difference p_t - p settles to
 * k_t q R/(k_t + k) with time constant R/(k_t + k). */
FOOTPRINT(connecting_tube, constant_inflow__chamber_trails_the_tube)
{
  static const double at[] = {0.002, 0.01, 0.05};
  pneu_params p = fixture_vessel(1e-3);
  const double R = 3e7, RT = (double)p.gas_constant * (double)p.ambient_temperature, pa = (double)p.ambient_pressure;
  const double k_tube = RT / 2e-5, k = RT / 1e-3, tau = R / (k_tube + k);
  const double q = inflow(&p, PNEU_FLOW_CHOKED, 0), most = k_tube * q * tau;
  int i;
  fixture_set(&p, "tube_resistance", R);
  fixture_set(&p, "tube_volume", 2e-5);
  for (i = 0; i < COUNT(at); i++) {
    const double settled = 1 - exp(-at[i] / tau), chamber = k / R * most * (at[i] - tau * settled);
    const pneu_state s = run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 1, at[i]);
    check_note("t = %g s", at[i]);
    assert_close(s.p, chamber, TOL(1e-3, 5), TOL(1e-8, 1e-4));
    assert_close((double)s.extra[0] * (4e5 + pa), pa + chamber + most * settled, 0, TOL(1e-8, 1e-4));
  }
  assert_close(run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 2e5, 0, 1).p, 2e5, TOL(1e-6, 1), 0);
  check_all_turbulent_tubes();
  check_share_of_turbulence();
}

/* A vessel 5 m long and 36 mm wide. */
static pneu_params long_vessel(double friction)
{
  pneu_params p = fixture_vessel(5e-3);
  p.area = (pneu_real)1e-3;
  fixture_set(&p, "line_length", 1);
  fixture_set(&p, "line_friction", friction);
  return p;
}

/* Rate at which friction takes the flow [1/s], at the Reynolds number of it and even pressure. */
static double damping(double friction, double reynolds)
{
  const pneu_params p = long_vessel(friction);
  pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  pneu_input input = fixture_input(&m, 0);
  pneu_state s = fixture_rest(&m, 2e5, 0, &input);
  const double A = 1e-3, bore = 0.0356824823, q = reynolds * A * 1.82e-5 / bore;
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  s.extra[1] = (pneu_real)(q * sqrt((double)p.gas_constant * (double)p.ambient_temperature) / (A * (double)m.scale[0]));
  pneu_pack(&m, &s, y);
  assert_int_equal(pneu_rhs(&m, &s, &input, y, f), PNEU_OK);
  return -(double)f[2] / (double)s.extra[1];
}

/* A stem that moves at even pressure takes as much of both volumes: either pressure falls by P A v/V. */
static void check_moving_stem(void)
{
  pneu_params p = long_vessel(1);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  double falls;
  p.stroke = (pneu_real)0.02;
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  input = fixture_input(&m, 0);
  s = fixture_rest(&m, 2e5, 0.01, &input);
  s.mode = PNEU_MODE_UP;
  s.v = (pneu_real)0.5;
  falls = (2e5 + (double)p.ambient_pressure) * 1e-3 * 0.5 / (5e-3 + 1e-3 * 0.01);
  pneu_pack(&m, &s, y);
  assert_int_equal(pneu_rhs(&m, &s, &input, y, f), PNEU_OK);
  assert_close(-(double)f[0], falls, 0, TOL(1e-12, 1e-5));
  assert_close(-(double)f[1] * (double)m.scale[0], falls, 0, TOL(1e-12, 1e-5));
}

/* Constant choked inflow q with hardly any friction: with C = V/(R T) and omega = 2 sqrt(R T)/L the far end's pressure
 * rises by q/C (t - sin(omega t)/omega); 64/Re or Blasius's 0.3164/Re^0.25 takes lambda u/(2 D) of the flow. */
FOOTPRINT(long_chamber, constant_inflow__swings_and_friction_damps_it)
{
  static const double at[] = {0.01, 0.03, 0.1};
  pneu_params base = fixture_vessel(5e-3), p = long_vessel(0.1);
  const double RT = (double)p.gas_constant * (double)p.ambient_temperature, omega = 2 * sqrt(RT) / 5;
  const double rho = (2e5 + (double)p.ambient_pressure) / RT, unit = 1.82e-5 / (rho * 0.0356824823 * 0.0356824823);
  double q;
  int i;
  p.fill_area = base.fill_area = (pneu_real)5e-6;
  q = inflow(&base, PNEU_FLOW_CHOKED, 0);
  for (i = 0; i < COUNT(at); i++) {
    check_note("t = %g s", at[i]);
    assert_close(run_vessel(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 1, at[i]).p,
                 q * RT / 5e-3 * (at[i] - sin(omega * at[i]) / omega), 0, TOL(2e-3, 2e-2));
  }
  check_moving_stem();
  assert_close(damping(1, 50), 32 * unit, 0, TOL(1e-3, 1e-2));
  assert_close(damping(3, 1e5), 3 * 0.1582 * pow(1e5, 0.75) * unit, 0, TOL(1e-4, 1e-2));
}

/* What leaves the chamber leaves at its temperature, what comes in has that of the tube; the pressure is shared. */
TEST(test_connecting_tube__chamber_colder_than_tube__is_warmed_by_it)
{
  pneu_params p = fixture_vessel(1e-3);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  pneu_real y[PNEU_STATE_MAX], f[PNEU_STATE_MAX];
  const double R = 3e7, q = 3e4 / R;
  fixture_need("connecting_tube");
  fixture_set(&p, "tube_resistance", R);
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED);
  input = fixture_input(&m, 0);
  assert_int_equal(pneu_state_rest(&m, (pneu_real)2e5, 250, 0, &input, &s), PNEU_OK);
  s.extra[0] += (pneu_real)3e4 / m.scale[0];
  pneu_pack(&m, &s, y);
  assert_int_equal(pneu_rhs(&m, &s, &input, y, f), PNEU_OK);
  assert_close(f[0], 1.4 * (double)p.gas_constant * 298.15 * q / 1e-3, 0, TOL(1e-9, 1e-4));
  s.extra[0] -= (pneu_real)6e4 / m.scale[0];
  pneu_pack(&m, &s, y);
  assert_int_equal(pneu_rhs(&m, &s, &input, y, f), PNEU_OK);
  assert_close(f[0], -1.4 * (double)p.gas_constant * 250 * q / 1e-3, 0, TOL(1e-9, 1e-4));
}

/* Hardly any tube: chamber and tube are one, and gas that is not at ambient temperature may rest. */
TEST(test_connecting_tube__hardly_any_resistance__is_not_stiff_at_rest)
{
  static const double resistance[] = {1, 1e3, 1e5, 1e7}, share[] = {0, 0.5, 1};
  pneu_params p = fixture_params(FIXTURE_37_13);
  int i, k;
  fixture_need("connecting_tube");
  for (i = 0; i < COUNT(resistance); i++)
    for (k = 0; k < COUNT(share); k++) {
      pneu_model m;
      fixture_set(&p, "tube_resistance", resistance[i]);
      fixture_set(&p, "tube_turbulence", share[k]);
      m = fixture_model(&p, PNEU_GAS_POLYTROPIC, PNEU_FLOW_PAPER);
      check_note("%g Pa s/kg, c = %g", resistance[i], share[k]);
      assert_between(fixture_steps(&m) * PNEU_STAGE_COUNT, 1, TOL(24000, 240000)); /* stages */
    }
}

/* Down to a cubic millimetre behind a supply's resistance, and hardly any of that. */
TEST(test_supply_droop__small_volume__is_not_stiff_at_rest)
{
  static const double resistance[] = {1, 1e5, 1e7}, share[] = {0, 0.5, 1}, volume[] = {1e-12, 1e-9, 1e-6, 1e-3};
  pneu_params p = fixture_params(FIXTURE_37_13);
  int i, k, j;
  fixture_need("supply_droop");
  for (i = 0; i < COUNT(resistance); i++)
    for (k = 0; k < COUNT(share); k++)
      for (j = 0; j < COUNT(volume); j++) {
        pneu_model m;
        fixture_set(&p, "supply_resistance", resistance[i]);
        fixture_set(&p, "supply_turbulence", share[k]);
        fixture_set(&p, "supply_volume", volume[j]);
        m = fixture_model(&p, PNEU_GAS_POLYTROPIC, PNEU_FLOW_PAPER);
        check_note("%g Pa s/kg, c = %g, %g m3", resistance[i], share[k], volume[j]);
        assert_between(fixture_steps(&m) * PNEU_STAGE_COUNT, 1, TOL(5000, 20000)); /* stages */
      }
}

/* ---- energy ---- */

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

/* Shut air that begins b too warm falls to p T_w/(T_w + b) as its film takes the heat; a thermometer that lags begins
 * at what it was taken to show. */
FOOTPRINT(start_temperature, shut_air__falls_as_it_cools)
{
  const double b = 30, P = 2e5 + 101325, Tw = 298.15;
  pneu_params p = fixture_vessel(1e-3);
  fixture_rig rig;
  pneu_shown shown;
  fixture_set(&p, "start_excess", b);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 2e5, 0);
  assert_close((double)rig.s.T, Tw, 0, TOL(0, 1e-6));                      /* it has no temperature of its own */
  rig.m = fixture_model_roles(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 1, 0); /* nor where pressure drives it */
  assert_close((double)rig.m.start_excess, 0, 0, 0);
  if (pneu_effect_find("heat_transfer") < 0 || pneu_effect_find("temperature_lag") < 0)
    return;
  fixture_set(&p, "film_conductance", 5);
  fixture_set(&p, "temperature_time", 10);
  rig.m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  rig.s = fixture_rest(&rig.m, 2e5, 0, &rig.input);
  assert_close((double)rig.s.T, Tw + b, 0, TOL(1e-12, 1e-6));
  assert_int_equal(pneu_show(&rig.m, &rig.s, &rig.input, &shown), PNEU_OK);
  assert_close((double)shown.temperature, Tw, 0, TOL(1e-12, 1e-6));
  fixture_go(&rig, 20, FIXTURE_TOL, NULL);
  assert_close((double)rig.s.p + 101325, P * Tw / (Tw + b), 0, TOL(1e-6, 1e-4));
}

FOOTPRINT(heat_transfer, shut_vessel__levels_temperature_and_pressure_recovers)
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

/* A conductance does nothing under the isothermal law, a resistance nothing under any other. */
TEST(test_heat_transfer__parameter_of_another_law__does_not_act)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_need("heat_transfer");
  fixture_set(&p, "film_conductance", 2);
  fixture_set(&p, "free_convection", 2);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).n_active, 0);
  fixture_set(&p, "film_resistance", 0.5);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).n_active, 1);
  p = fixture_params(FIXTURE_R1_400);
  fixture_set(&p, "film_resistance", 0.5);
  assert_int_equal(fixture_model(&p, PNEU_GAS_POLYTROPIC, PNEU_FLOW_PAPER).n_active, 0);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER).n_active, 0);
}

/* A sealed vessel in an insulated wall: both meet at their mean by heat capacity, the difference decays at
 * G (1/(m c_v) + 1/C); with a loss both end at ambient temperature. */
FOOTPRINT(wall_temperature, sealed_vessel__shares_its_heat_with_the_wall)
{
  pneu_params p = fixture_vessel(1e-3);
  const double T0 = 250, dT = T0 - 298.15, C = 4, G = 2;
  const double mcv = (2e5 + (double)p.ambient_pressure) * 1e-3 / (0.4 * T0), rate = G * (1 / mcv + 1 / C);
  pneu_model m;
  pneu_input shut;
  pneu_state s;
  fixture_set(&p, "wall_compliance", 1 / C);
  fixture_set(&p, "wall_loss", 0);
  assert_int_equal(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER).n_active, 0); /* no film, no heat */
  fixture_need("heat_transfer");
  fixture_set(&p, "film_conductance", G);
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  shut = fixture_input(&m, 0);
  assert_int_equal(pneu_state_rest(&m, (pneu_real)2e5, (pneu_real)T0, 0, &shut, &s), PNEU_OK);
  fixture_run(&m, &s, &shut, 0.7, FIXTURE_TOL, NULL);
  assert_close(s.T, 298.15 + dT * (mcv + C * exp(-rate * 0.7)) / (mcv + C), 0, TOL(1e-9, 1e-5));
  assert_close(s.extra[0], dT * mcv / (mcv + C) * (1 - exp(-rate * 0.7)) / 298.15, TOL(1e-9, 1e-5), 0);
  fixture_set(&p, "wall_loss", 1);
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  fixture_run(&m, &s, &shut, 200, FIXTURE_TOL, NULL);
  assert_close(s.T, 298.15, 0, TOL(1e-9, 1e-5));
}

/* Of a shut vessel P (1 + c (p_y - p_a)) stays what it was while p_y goes to p: in the end both have what the square
 * says. On the way p_y follows the pressure at the rate of the difference over tau. */
FOOTPRINT(chamber_creep, shut_vessel__shares_its_pressure_with_the_wall)
{
  const double c = 2e-6, P0 = 3e5, Pa = 101325;
  pneu_params p = fixture_vessel(1e-3);
  pneu_model m;
  pneu_input shut;
  pneu_state s;
  double scale, end;
  fixture_set(&p, "volume_compliance", c);
  fixture_set(&p, "volume_time", 0.5);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  scale = (double)m.scale[0];
  shut = fixture_input(&m, 0);
  s = fixture_rest(&m, P0 - Pa, 0, &shut);
  assert_close(s.extra[0], P0 / scale, 0, TOL(1e-15, 1e-6)); /* at rest it has given way */
  s.extra[0] = (pneu_real)(Pa / scale);
  fixture_run(&m, &s, &shut, 0.3, FIXTURE_TOL, NULL);
  assert_close(((double)s.p + Pa) * (1 + c * ((double)s.extra[0] * scale - Pa)), P0, 0, TOL(1e-7, 1e-4));
  fixture_run(&m, &s, &shut, 20, FIXTURE_TOL, NULL);
  end = (c * Pa - 1 + sqrt((1 - c * Pa) * (1 - c * Pa) + 4 * c * P0)) / (2 * c); /* P (1 + c (P - Pa)) = P0 */
  assert_close((double)s.p + Pa, end, 0, TOL(1e-7, 1e-4));
  assert_int_equal(fixture_pressed(&p).n_active, 0);
}

/* ---- command ---- */

/* In a vessel time enters by the integral of the opening alone: t becomes t - tau (1 - exp(-t/tau)). */
FOOTPRINT(transducer_lag, vessel__runs_late_by_the_integral_of_the_lag)
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
    const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0.5, 0, 0);
    assert_close(fixture_see(&rig).opening, 0.5, 0, 0);
  }
}

/* With a proportional band the command is a pressure; at rest the opening is the regulator's. */
TEST(test_transducer_lag__regulator_at_rest__starts_from_its_opening)
{
  pneu_params p = fixture_vessel(1e-3);
  fixture_rig rig;
  fixture_need("transducer_lag");
  fixture_set(&p, "transducer_time", 0.02);
  p.proportional_band = (pneu_real)1e4;
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 1.05e5, 1e5, 0);
  assert_close(rig.s.extra[0], 0.5, TOL(1e-12, 1e-5), 0);
}

/* The pressure of a prompt transducer, later by the dead time; test_delay.c has the rest. */
FOOTPRINT(dead_time, model__holds_the_delay)
{
  const pneu_params base = fixture_vessel(1e-3);
  pneu_params p = base;
  fixture_set(&p, "dead_time", 0.03);
  assert_close(fixture_model(&base, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).command_delay, 0, 0, 0);
  assert_close(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).command_delay, 0.03, 0, TOL(1e-15, 1e-7));
  {
    const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    pneu_late slot;
    pneu_delay late;
    pneu_input input = fixture_input(&m, 0);
    pneu_state s = fixture_rest(&m, 0, 0, &input);
    pneu_delay_begin(&late, &slot, 1, 0);
    input.delay = &late;
    input.u = 1;
    fixture_run(&m, &s, &input, 0.13, FIXTURE_TOL, NULL);
    assert_close(s.p, run_vessel(&base, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 1, 0.1).p, TOL(1e-3, 10), 0);
  }
}

/* The R1-400 without dry friction, with a positioner. */
static pneu_params positioned(double gain)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.dry_friction = 0;
  fixture_set(&p, "gain", gain);
  return p;
}

static pneu_input set_position(const pneu_model *m, double set)
{
  pneu_input input = fixture_input(m, set);
  input.set_position = 1;
  return input;
}

/* What the positioner asks for at rest at a share of the stroke, on a set position that ramps [1/s]. */
static double asked_on_ramp(const pneu_params *p, double set, double share, double rate)
{
  const pneu_model m = fixture_model(p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  pneu_input input = set_position(&m, set);
  pneu_state s;
  input.u_rate = (pneu_real)rate;
  s = fixture_rest(&m, 1e5, share * (double)p->stroke, &input);
  return fixture_look(&m, &s, &input).opening;
}

static double asked(const pneu_params *p, double set, double share)
{
  return asked_on_ramp(p, set, share, 0);
}

/* Where the stem comes to rest. */
static pneu_state follow(const pneu_params *p, double set)
{
  const pneu_model m = fixture_model(p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  const pneu_input input = set_position(&m, set);
  pneu_state s = fixture_rest(&m, 0, 0, &input);
  fixture_run(&m, &s, &input, 100, TOL(1e-8, 1e-5), NULL);
  return s;
}

FOOTPRINT(positioner, opening__follows_the_error_and_the_integral_takes_it_away)
{
  /* with a dead band of 1 % and cut-offs at 2 and 98 % */
  static const struct law {
    double set, x, opening;
  } law[] = {{0.5, 0.5, 0},    {0.5, 0.4901, 0},   {0.5, 0.5099, 0},        {0.5, 0.489, 0.22},    {0.5, 0.511, -0.22},
             {0.5, 0.47, 0.6}, {0.5, 0.53, -0.6},  {0.9, 0.2, 1},           {0.2, 0.9, -1},        {0.019, 0, -1},
             {0.02, 0, 0.4},   {0.0201, 0, 0.402}, {0.98, 1, -0.4},         {0.981, 1, 1},         {0.9799, 1, -0.402},
             {-3, 0.5, -1},    {3, 0.5, 1},        {0.98 + 1e-14, 1, -0.4}, {0.02 - 1e-14, 0, 0.4}};
  pneu_params p = positioned(20);
  fixture_rig rig;
  double e;
  int i;
  fixture_set(&p, "dead_band", 0.01);
  fixture_set(&p, "cutoff_low", 0.02);
  fixture_set(&p, "cutoff_high", 0.98);
  for (i = 0; i < COUNT(law); i++) {
    check_note("set %g, at %g", law[i].set, law[i].x);
    assert_close(asked(&p, law[i].set, law[i].x), law[i].opening, TOL(1e-12, 1e-5), 0);
  }
  /* without a set position the command is the opening */
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED), -0.3, 1e5, 0.01);
  assert_close(fixture_see(&rig).opening, -0.3, TOL(1e-15, 1e-7), 0);
  check_note("the derivative, on a set position that ramps");
  p = positioned(20);
  fixture_set(&p, "derivative_time", 0.1);
  assert_close(asked_on_ramp(&p, 0.5, 0.5, 0.05), 20 * 0.1 * 0.05, TOL(1e-12, 1e-5), 0);
  check_note("an integral that has worked before");
  p = positioned(20);
  fixture_set(&p, "integral_start", 0.02);
  assert_close(asked(&p, 0.5, 0.49), 0.2, TOL(1e-12, 1e-5), 0); /* there is none */
  fixture_set(&p, "integral_time", 5);
  assert_close(asked(&p, 0.5, 0.49), 0.6, TOL(1e-12, 1e-5), 0);
  assert_close(asked(&p, 0.5, 0.5), 0.4, TOL(1e-12, 1e-5), 0);
  fixture_set(&p, "integral_start", -0.02);
  assert_close(asked(&p, 0.5, 0.49), -0.2, TOL(1e-12, 1e-5), 0);
  fixture_set(&p, "dead_band", 0.015);
  assert_close(asked(&p, 0.5, 0.49), 0, 0, 0);
  /* droop: the fill orifice passes what leaks, both choked, so that the opening is known, and so is the error; the
   * integral takes it away */
  p = positioned(20);
  p.supply_pressure = (pneu_real)9e5;
  fixture_set(&p, "leak_area", 5e-8);
  rig.s = follow(&p, 0.5);
  e = 5e-8 * ((double)rig.s.p + (double)p.ambient_pressure) / (20 * 0.893e-6 * (9e5 + (double)p.ambient_pressure));
  assert_close((double)rig.s.x / 0.02, 0.5 - e, TOL(1e-8, 1e-5), 0);
  /* in single precision a stem stays at rest against a ten-thousandth of the largest force */
  assert_close(rig.s.p, 400e3 * ((double)rig.s.x + 0.01) / 0.04, TOL(1e-2, 1e-4 * 9e5), 0);
  fixture_set(&p, "integral_time", 1);
  rig.s = follow(&p, 0.5);
  assert_close((double)rig.s.x / 0.02, 0.5, TOL(1e-7, 1e-5), 0);
  assert_close(rig.s.extra[0], e, TOL(1e-5, 1e-4), 1e-2);
}

FOOTPRINT(positioner_bend, half_opening__passes_less_and_full_opening_as_before)
{
  pneu_params p = positioned(2);
  fixture_set(&p, "flow_bend", 0.4);
  assert_close(asked(&p, 0.5, 0.25), 0.5 * (1 - 0.4 * 0.5), TOL(1e-12, 1e-5), 0);
  assert_close(asked(&p, 0.25, 0.5), -0.5 * (1 - 0.4 * 0.5), TOL(1e-12, 1e-5), 0);
  assert_close(asked(&p, 1, 0.5), 1, TOL(1e-12, 1e-5), 0);
}

FOOTPRINT(positioner_dead_band, small_errors__open_nothing)
{
  pneu_params p = positioned(20);
  fixture_set(&p, "dead_band", 0.01);
  fixture_set(&p, "dead_band_excess", 0.02);
  assert_close(asked(&p, 0.5, 0.471), 0, 0, 0);
  assert_close(asked(&p, 0.5, 0.529), 0, 0, 0);
  assert_close(asked(&p, 0.5, 0.469), 0.62, TOL(1e-12, 1e-5), 0);
  assert_close(asked(&p, 0.5, 0.531), -0.62, TOL(1e-12, 1e-5), 0);
  assert_close(asked_on_ramp(&p, 0.5, 0.47, 0.1), 0, TOL(1e-9, 0.01), 0); /* at its edge, which rises from there */
}

/* Between two orifices in series the chamber stands where [B, Eq. 8] gives both the same flow: f^2 P_s (P_s - P) =
 * v^2 P (P - P_a), a quadratic equation. */
FOOTPRINT(positioner_overlap, spool__opens_late_or_never_shuts)
{
  static const double u[] = {0, 0.02, -0.03, 0.04};
  pneu_params p = positioned(2), q = fixture_vessel(1e-5);
  int i;
  fixture_set(&p, "overlap", 0.05);
  assert_close(asked(&p, 0.5, 0.25), 0.45 / 0.95, TOL(1e-12, 1e-5), 0);
  assert_close(asked(&p, 0.25, 0.5), -0.45 / 0.95, TOL(1e-12, 1e-5), 0);
  assert_close(asked(&p, 0.5, 0.476), 0, 0, 0);
  assert_close(asked(&p, 1, 0.5), 1, TOL(1e-12, 1e-5), 0);
  fixture_set(&q, "overlap", -0.05);
  for (i = 0; i < COUNT(u); i++) {
    const pneu_state s = run_vessel(&q, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1e5, u[i], 1000);
    const double pa = (double)q.ambient_pressure, ps = (double)q.supply_pressure + pa;
    const double f2 = pow(0.05 + u[i], 2), v2 = pow(0.05 - u[i], 2), half = (f2 * ps - v2 * pa) / 2;
    check_note("u = %g", u[i]);
    assert_close((double)s.p + pa, (sqrt(half * half + v2 * f2 * ps * ps) - half) / v2, 0, TOL(1e-6, 1e-3));
  }
}

FOOTPRINT(positioner_span, stem__rests_off_in_proportion)
{
  pneu_params p = positioned(20);
  fixture_set(&p, "span_excess", 0.25);
  assert_close((double)follow(&p, 0.5).x / 0.02, 0.4, TOL(1e-6, 1e-4), 0);
  assert_close((double)follow(&p, 1).x / 0.02, 0.8, TOL(1e-6, 1e-4), 0);
}

FOOTPRINT(positioner_zero, stem__rests_off_by_the_same)
{
  pneu_params p = positioned(20);
  fixture_set(&p, "zero_shift", 1e-3);
  assert_close((double)follow(&p, 0.5).x / 0.02, 0.45, TOL(1e-6, 1e-4), 0);
  assert_close((double)follow(&p, 0.9).x / 0.02, 0.85, TOL(1e-6, 1e-4), 0);
}

TEST(test_effects_def__each_effect_on_the_gas__has_a_footprint_test)
{
  footprint_complete("mass energy command");
}

/* A stem that a positioner with a dead band has brought to rest creeps off again when its set position does; without
 * friction it goes in and out of the band, in the end by less than single precision resolves: holds and ramps of many
 * loops. */
TEST(test_positioner__holds_and_ramps__always_end)
{
  enum { LOOPS = 60, STRETCHES = 20 };
  uint64_t seed = 5;
  int loop, i;
  for (loop = 0; loop < LOOPS; loop++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    double set = 0;
    pneu_model m;
    pneu_input input;
    pneu_state s;
    p.dead_volume = (pneu_real)4e-5;
    p.fill_area = p.vent_area = (pneu_real)9e-7;
    p.damping = (pneu_real)fixture_random(&seed, 0, 1e4);
    p.dry_friction = (pneu_real)fixture_random(&seed, 100, 800);
    if (loop % 3 == 2) {
      p.dry_friction = 0;
      fixture_set(&p, "leak_area", 1e-9 * loop);
    }
    fixture_set(&p, "gain", fixture_random(&seed, 5, 40));
    fixture_set(&p, "dead_band", fixture_random(&seed, 0.002, 0.01));
    m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
    input = set_position(&m, set);
    s = fixture_rest(&m, 0, 0, &input);
    for (i = 0; i < STRETCHES; i++) {
      const double duration = fixture_random(&seed, 0.5, 5), to = fixture_random(&seed, 0, 1);
      check_note("loop %d, stretch %d", loop, i);
      input.u = (pneu_real)set;
      input.u_rate = (pneu_real)(i % 2 ? (to - set) / duration : 0);
      fixture_run(&m, &s, &input, duration, TOL(1e-6, 1e-4), NULL);
      set = i % 2 ? to : set;
    }
  }
}

/* Where the stem is after ten seconds of a ramp of 2.7 %/s, 10 mm of travel; events on the way.  In: edge  0: as usual
 */
static double ramped(double edge, long *events)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_options options = fixture_options(TOL(1e-6, 1e-4));
  pneu_workspace work = {0};
  pneu_model m;
  pneu_input input;
  pneu_state s;
  p.area = (pneu_real)0.01, p.dead_volume = (pneu_real)3e-5, p.stroke = (pneu_real)0.01;
  p.spring_rate = 80000, p.spring_preload = (pneu_real)0.005;
  p.moving_mass = (pneu_real)1.5, p.dry_friction = 28, p.viscous_friction = 600, p.damping = 0;
  p.fill_area = (pneu_real)2.2e-7, p.vent_area = (pneu_real)2.8e-7, p.supply_pressure = (pneu_real)2e5;
  fixture_set(&p, "gain", 30);
  fixture_set(&p, "dead_band", 0.005);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  if (edge > 0)
    m.band_edge = (pneu_real)edge;
  input = set_position(&m, 0.1);
  input.u_rate = (pneu_real)0.02667;
  s = fixture_rest(&m, 45816, 0.001, &input);
  assert_int_equal(pneu_run(&m, &s, &input, 10, &options, NULL, &work), PNEU_OK);
  *events = work.stats.events;
  return (double)s.x;
}

/* It goes in and out of its dead band 600 times, by 4 um; a wider edge of the band has it pass on in the mean. */
TEST(test_positioner__edge_of_the_band_wider_than_pulses__follows_a_ramp_without_them)
{
  long pulses, none;
  const double x = ramped(0, &pulses);
  fixture_need("positioner");
  assert_close(ramped(4e-4, &none), x, 4e-6, 0);
  assert_between(pulses, 1000, 4000);
  assert_between(none, 0, 40);
}

/* A leak pushes the stem out of the dead band, air is let in, and friction keeps the stem where it is until the
 * pressure has risen by the whole friction band, 2 F/A, so that the cycle begins again. */
TEST(test_positioner__leak_at_the_dead_band__pressure_swings_over_the_friction_band)
{
  const double slice = 0.02, band = 2 * 480.0 / 0.04;
  pneu_params p = fixture_params(FIXTURE_R1_400);
  double low = 1e9, high = 0, t;
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_set(&p, "gain", 20);
  fixture_set(&p, "dead_band", 0.003);
  fixture_set(&p, "leak_area", 3e-8);
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  input = set_position(&m, 0.5);
  s = fixture_rest(&m, 0, 0, &input);
  fixture_run(&m, &s, &input, 60, TOL(1e-7, 1e-4), NULL);
  for (t = 0; t < 60; t += slice) {
    fixture_run(&m, &s, &input, slice, TOL(1e-7, 1e-4), NULL);
    low = (double)s.p < low ? (double)s.p : low;
    high = (double)s.p > high ? (double)s.p : high;
    assert_close((double)s.x / 0.02, 0.497, 1e-3, 0);
  }
  assert_close(high - low, band, 0, 0.03);
}

/* A loop without dry friction, with a dead band. */
static pneu_model banded(double band)
{
  pneu_params p;
  fixture_need("positioner");
  p = positioned(20);
  fixture_set(&p, "dead_band", band);
  return fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
}

/* The edges that a stem has passed. */
typedef struct edges {
  int n, side;
  double furthest; /* that it was off one, of the stroke */
} edges;

static int note_edge(void *context, pneu_real t, const pneu_state *after, int before)
{
  edges *e = (edges *)context;
  const double off = fabs(0.5 - (double)after->x / 0.02);
  (void)t, (void)before;
  if (after->side != e->side) {
    e->n++;
    e->furthest = fmax(e->furthest, fabs(off - 0.01));
  }
  e->side = after->side;
  return 0;
}

/* Without friction the stem swings through its dead band; each edge ends a step. */
TEST(test_pneu_run__dead_band__steps_end_on_its_edges)
{
  edges e = {.side = PNEU_SIDE_BELOW};
  const pneu_observer observer = {NULL, note_edge, &e};
  const pneu_options options = fixture_options(TOL(1e-7, 1e-4));
  const pneu_model m = banded(0.01);
  const pneu_input input = set_position(&m, 0.5);
  pneu_state s = fixture_rest(&m, 0, 0, &input);
  pneu_workspace work = {0};
  assert_int_equal(pneu_run(&m, &s, &input, 60, &options, &observer, &work), PNEU_OK);
  assert_between(e.n, 1, 1000);
  assert_close(e.furthest, 0, TOL(1e-9, 1e-4), 0);
  assert_int_equal(s.side, PNEU_SIDE_WITHIN);
}

/* Out of the band to one side, the set position may have jumped to the other. */
TEST(test_pneu_side__set_position_jumps_or_ramps__is_told_again)
{
  static const struct {
    double set, rate;
    int side;
  } told[] = {{0.5, 0, PNEU_SIDE_BELOW},
              {0.31, 0, PNEU_SIDE_WITHIN},
              {0.1, 0, PNEU_SIDE_ABOVE},
              {0.5, 0.1, PNEU_SIDE_UNTOLD},
              {0.29, 0, PNEU_SIDE_WITHIN}};
  const pneu_model m = banded(0.02);
  pneu_input input = set_position(&m, 0.3);
  const pneu_state s = fixture_rest(&m, 0, 0.006, &input);
  int i;
  for (i = 0; i < COUNT(told); i++) {
    pneu_state after = s;
    pneu_real y[PNEU_STATE_MAX], g[PNEU_EVENT_MAX];
    check_note("%d", i);
    input = set_position(&m, told[i].set);
    input.u_rate = (pneu_real)told[i].rate;
    pneu_settle(&m, &input, &after);
    assert_int_equal(after.side, told[i].side);
    after = s;
    after.side = PNEU_SIDE_BELOW;
    pneu_pack(&m, &after, y);
    pneu_switch(&m, &input, pneu_events(&m, &after, &input, y, g) - 1, &after);
    assert_int_equal(after.side, told[i].side);
  }
}
