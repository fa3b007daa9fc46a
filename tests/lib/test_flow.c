/* Flow laws against their formulae, written out again. */
#include "../fixture.h"

#define BLEND 5e-4 /* as documented at pneu_orifice */

static const double ratios[] = {0, 0.05, 0.2, 0.299, 0.301, 0.45, 0.6, 0.75, 0.9, 0.97, 0.99, 0.999};

/* Down pressures are taken from the rounded ratio, so that the float build sees the same numbers. */
static pneu_flow orifice(const pneu_model *m, int law, double area, double p_up, double T, double p_down)
{
  pneu_flow flow;
  pneu_orifice(m, law, (pneu_real)area, (pneu_real)p_up, (pneu_real)T, (pneu_real)p_down, &flow);
  return flow;
}

static double paper(const pneu_model *m, double a, double pu, double T, double pd)
{
  const double rho = pu / ((double)m->p.gas_constant * T);
  return a * sqrt(2 * rho * (pu - pd));
}

static double choked_nozzle(const pneu_model *m, double a, double pu, double T)
{
  const double g = (double)m->p.heat_ratio, R = (double)m->p.gas_constant;
  return a * pu * sqrt(g / (R * T)) * pow(2 / (g + 1), (g + 1) / (2 * (g - 1)));
}

static double nozzle(const pneu_model *m, double a, double pu, double T, double pd)
{
  const double g = (double)m->p.heat_ratio, R = (double)m->p.gas_constant, r = pd / pu;
  if (r <= pow(2 / (g + 1), g / (g - 1)))
    return choked_nozzle(m, a, pu, T);
  return a * pu * sqrt(2 * g / ((g - 1) * R * T) * (pow(r, 2 / g) - pow(r, (g + 1) / g)));
}

/* ISO 6358-1:2013, with C from the choked flow at 293.15 K and 100 kPa. */
static double iso6358(const pneu_model *m, double a, double pu, double T, double pd)
{
  const double b = (double)m->p.critical_ratio, R = (double)m->p.gas_constant, r = pd / pu;
  const double rho0 = 1e5 / (R * 293.15), C = choked_nozzle(m, a, 1e5, 293.15) / (rho0 * 1e5);
  const double z = (r - b) / (1 - b);
  return C * rho0 * pu * sqrt(293.15 / T) * (r <= b ? 1 : pow(1 - z * z, (double)m->p.subsonic_index));
}

typedef double formula(const pneu_model *, double, double, double, double);
static formula *const formulae[PNEU_FLOW_COUNT] = {paper, nozzle, iso6358};

static void check_formula(int law, const pneu_params *p)
{
  const pneu_model m = fixture_model(p, PNEU_GAS_ISOTHERMAL, law);
  int i, hot;
  for (i = 0; i < COUNT(ratios); i++)
    for (hot = 0; hot < 2; hot++) {
      const double pu = 4.5e5, pd = (double)(pneu_real)(ratios[i] * pu), T = hot ? 400 : 250;
      check_note("%s, ratio %g, %g K", pneu_flow_key(law), ratios[i], T);
      assert_close(orifice(&m, law, 2e-6, pu, T, pd).q, formulae[law](&m, 2e-6, pu, T, pd), 0, TOL(3e-13, 1e-4));
    }
}

TEST(test_pneu_orifice__each_law__follows_its_formula)
{
  int law;
  for (law = 0; law < PNEU_FLOW_COUNT; law++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    check_formula(law, &p);
    p.heat_ratio = (pneu_real)1.3;
    p.critical_ratio = (pneu_real)0.15;
    p.subsonic_index = (pneu_real)0.62;
    p.gas_constant = 189;
    p.ambient_temperature = 320;
    check_formula(law, &p);
  }
}

TEST(test_pneu_orifice__area__is_a_factor)
{
  const pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  int law;
  for (law = 0; law < PNEU_FLOW_COUNT; law++) {
    const pneu_flow one = orifice(&m, law, 1e-6, 3e5, 300, 2e5), three = orifice(&m, law, 3e-6, 3e5, 300, 2e5);
    const pneu_flow none = orifice(&m, law, 0, 3e5, 300, 2e5);
    assert_close(three.q, 3 * one.q, 0, TOL(1e-15, 1e-6));
    assert_close(three.dq_dup, 3 * one.dq_dup, 0, TOL(1e-15, 1e-6));
    assert_close(three.dq_ddown, 3 * one.dq_ddown, 0, TOL(1e-15, 1e-6));
    assert_close(three.dq_dT, 3 * one.dq_dT, 0, TOL(1e-15, 1e-6));
    assert_close(none.q, 0, 0, 0);
  }
}

/* The ISO law as the caller's own takes the place of the declared one, filling and venting. */
static void own(const pneu_model *model, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                pneu_flow *flow)
{
  pneu_orifice(model, PNEU_FLOW_ISO6358, area, p_up, T_up, p_down, flow);
}

TEST(test_pneu_run__own_flow_law__takes_the_place_of_the_declared_one)
{
  pneu_state s[2];
  int k, stretch;
  for (k = 0; k < 2; k++) {
    pneu_model m = fixture_r1_400(PNEU_GAS_ENERGY, k ? PNEU_FLOW_PAPER : PNEU_FLOW_ISO6358);
    m.own_flow = k ? own : NULL;
    for (stretch = 0; stretch < 2; stretch++) {
      const pneu_input input = fixture_input(&m, stretch ? -0.4 : 0.8);
      if (!stretch)
        s[k] = fixture_rest(&m, 1e5, 0, &input);
      fixture_run(&m, &s[k], &input, 1, FIXTURE_TOL, NULL);
    }
  }
  assert_true((double)s[0].x > 1e-3);
  assert_memory_equal(&s[0], &s[1], sizeof s[0]);
}

/* ---- slopes ---- */

static void check_slopes(const pneu_model *m, int law, double pu, double T, double pd)
{
  const double a = 1e-6, s = TOL(1e-4, 3e-3), hp = s * (pu - pd), hT = TOL(0.01, 3);
  const pneu_flow f = orifice(m, law, a, pu, T, pd);
  const double scale = (double)f.q / (pu - pd), rtol = TOL(1e-7, 5e-2);
  const double up = ((double)orifice(m, law, a, pu + hp, T, pd).q - (double)orifice(m, law, a, pu - hp, T, pd).q);
  const double dn = ((double)orifice(m, law, a, pu, T, pd + hp).q - (double)orifice(m, law, a, pu, T, pd - hp).q);
  const double warm = ((double)orifice(m, law, a, pu, T + hT, pd).q - (double)orifice(m, law, a, pu, T - hT, pd).q);
  check_note("%s, ratio %.9g, %g K", pneu_flow_key(law), pd / pu, T);
  assert_close(f.dq_dup, up / (2 * hp), rtol * scale, rtol);
  assert_close(f.dq_ddown, dn / (2 * hp), rtol * scale, rtol);
  assert_close(f.dq_dT, warm / (2 * hT), rtol * (double)f.q / T, rtol);
}

TEST(test_pneu_orifice__slopes__match_central_differences)
{
  static const double r[] = {0.02, 0.1, 0.25, 0.29, 0.31, 0.5, 0.54, 0.7, 0.9, 0.99, 0.999, 0.9994};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int law, i, other;
  for (other = 0; other < 2; other++) {
    pneu_model m;
    p.subsonic_index = (pneu_real)(other ? 0.6 : 0.5);
    p.heat_ratio = (pneu_real)(other ? 1.3 : 1.4);
    m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    for (law = 0; law < PNEU_FLOW_COUNT; law++)
      for (i = 0; i < COUNT(r) - 2 * TOL(0, 1); i++)
        check_slopes(&m, law, 3.7e5, 310, r[i] * 3.7e5);
  }
}

#ifndef PNEU_SINGLE /* the ratio 1 - 1e-4 has four digits in float */
TEST(test_pneu_orifice__slopes_within_the_blend__match_central_differences)
{
  static const double w[] = {1e-6, 1e-5, 1e-4, 2e-4, 4.9e-4, 5.1e-4};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int law, i, other;
  for (other = 0; other < 2; other++) {
    pneu_model m;
    p.subsonic_index = other ? 0.6 : 0.5;
    m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    for (law = 0; law < PNEU_FLOW_COUNT; law++)
      for (i = 0; i < COUNT(w); i++) {
        const double pu = 3e5, pd = pu * (1 - w[i]), h = 1e-4 * pu * w[i];
        const pneu_flow f = orifice(&m, law, 1e-6, pu, 300, pd);
        const double up = orifice(&m, law, 1e-6, pu + h, 300, pd).q - orifice(&m, law, 1e-6, pu - h, 300, pd).q;
        const double dn = orifice(&m, law, 1e-6, pu, 300, pd + h).q - orifice(&m, law, 1e-6, pu, 300, pd - h).q;
        check_note("%s, m = %g, w = %g", pneu_flow_key(law), m.p.subsonic_index, w[i]);
        assert_close(f.dq_dup, up / (2 * h), 0, 1e-6);
        assert_close(f.dq_ddown, dn / (2 * h), 0, 1e-6);
      }
  }
}

/* ---- near equal pressures ---- */

static void check_edge(const pneu_model *m, int law)
{
  const double pu = 4e5, e = 1e-6, c = 1e-4;
  const double at[6] = {1 - 2 * c, 1 - c, 1 - e, 1 + e, 1 + c, 1 + 2 * c};
  double q[6], slope[6];
  int i;
  for (i = 0; i < 6; i++) {
    const pneu_flow f = orifice(m, law, 1e-6, pu, 300, pu * (1 - BLEND * at[i]));
    q[i] = f.q;
    slope[i] = -f.dq_ddown;
  }
  check_note("%s, m = %g", pneu_flow_key(law), m->p.subsonic_index);
  assert_close(q[3] - q[2], slope[2] * pu * BLEND * 2 * e, 0, 1e-5);
  assert_close(slope[3], slope[2], 0, 5 * e);
  assert_close(slope[5] - slope[4], slope[1] - slope[0], 0.02 * fabs(slope[1] - slope[0]), 0);
}

TEST(test_pneu_orifice__edge_of_the_blend__value_slope_and_curvature_are_continuous)
{
  static const double index[] = {0.5, 0.4, 0.62};
  int i;
  for (i = 0; i < COUNT(index); i++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    pneu_model m;
    p.subsonic_index = index[i];
    m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    check_edge(&m, PNEU_FLOW_PAPER);
    check_edge(&m, PNEU_FLOW_CHOKED);
    check_edge(&m, PNEU_FLOW_ISO6358);
  }
}

TEST(test_pneu_orifice__within_the_blend__is_linear_at_zero_and_below_the_law)
{
  const pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const double pu = 4e5;
  int law, i;
  for (law = 0; law < PNEU_FLOW_COUNT; law++) {
    const pneu_flow zero = orifice(&m, law, 1e-6, pu, 300, pu);
    check_note("%s", pneu_flow_key(law));
    assert_close(zero.q, 0, 0, 0);
    assert_close(zero.dq_dup, -zero.dq_ddown, 0, 1e-12);
    assert_close(orifice(&m, law, 1e-6, pu, 300, pu * (1 - 1e-6)).q, -zero.dq_ddown * pu * 1e-6, 0, 1e-5);
    for (i = 1; i < 100; i++) {
      const double pd = pu * (1 - BLEND * i / 100);
      const pneu_flow f = orifice(&m, law, 1e-6, pu, 300, pd);
      assert_true(f.dq_ddown < 0 && f.q > 0);
      assert_true(f.q < formulae[law](&m, 1e-6, pu, 300, pd));
    }
  }
}
#endif

/* ---- choking ---- */

TEST(test_pneu_orifice__at_choking__value_and_slope_are_continuous)
{
  const pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const double critical[PNEU_FLOW_COUNT] = {0, pow(1 / 1.2, 3.5), 0.3};
  int law;
  for (law = 0; law < PNEU_FLOW_COUNT; law++) {
    const double pu = 5e5, e = TOL(1e-7, 1e-5);
    const pneu_flow below = orifice(&m, law, 1e-6, pu, 300, pu * (critical[law] - e));
    const pneu_flow above = orifice(&m, law, 1e-6, pu, 300, pu * (critical[law] + e));
    const double scale = (double)below.q / pu;
    check_note("%s", pneu_flow_key(law));
    if (critical[law] <= 0)
      continue;
    assert_true(below.choked && !above.choked);
    assert_close(above.q, below.q, 0, TOL(1e-12, 1e-6));
    assert_close(below.dq_ddown, 0, 0, 0);
    assert_close(above.dq_ddown, 0, TOL(1e-5, 1e-3) * scale, 0);
  }
}

TEST(test_pneu_orifice__below_choking__flow_ignores_the_far_side)
{
  static const int laws[] = {PNEU_FLOW_CHOKED, PNEU_FLOW_ISO6358};
  const pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  int i;
  for (i = 0; i < COUNT(laws); i++) {
    const pneu_flow vacuum = orifice(&m, laws[i], 1e-6, 5e5, 300, 0), low = orifice(&m, laws[i], 1e-6, 5e5, 300, 1e5);
    check_note("%s", pneu_flow_key(laws[i]));
    assert_true(vacuum.q == low.q && vacuum.choked && low.choked);
    assert_close(low.dq_dup, low.q / (pneu_real)5e5, 0, TOL(1e-14, 1e-6));
  }
}

TEST(test_pneu_orifice__iso6358_choked__equals_the_nozzle)
{
  const pneu_params p = fixture_params(FIXTURE_37_13);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const pneu_flow iso = orifice(&m, PNEU_FLOW_ISO6358, 1e-6, 7e5, 350, 1e5);
  const pneu_flow isentropic = orifice(&m, PNEU_FLOW_CHOKED, 1e-6, 7e5, 350, 1e5);
  assert_close(iso.q, isentropic.q, 0, TOL(1e-14, 1e-6));
  assert_close(iso.dq_dT, isentropic.dq_dT, 0, TOL(1e-14, 1e-6));
}

/* The rule of thumb of catalogues, effective area S [mm2] = 5.02 C [dm3/(s bar)], for air. */
TEST(test_pneu_sonic_conductance__one_square_millimetre__is_what_catalogues_say)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  const double C = (double)pneu_sonic_conductance(&m, (pneu_real)1e-6), R = (double)p.gas_constant;
  assert_close(C * 1e8, 1 / 5.02, 0, 5e-3);
  assert_close(C * 1e5 / (R * 293.15) * 6e5 * sqrt(293.15 / 330), choked_nozzle(&m, 1e-6, 6e5, 330), 0,
               TOL(1e-13, 1e-6));
}

/* ---- direction ---- */

/* Net flow into a vessel at p_in [Pa abs] from a reservoir at p_from. */
static double net_flow(int law, double p_in, double p_from)
{
  pneu_params p = fixture_vessel(1e-3);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  fixture_sample look;
  p.ambient_pressure = (pneu_real)5e4;
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, law);
  input = fixture_input(&m, 1);
  input.supply_pressure = (pneu_real)(p_from - 5e4);
  s = fixture_rest(&m, p_in - 5e4, 0, &input);
  look = fixture_look(&m, &s, &input);
  assert_true(look.in >= 0 && look.out >= 0);
  return look.in - look.out;
}

TEST(test_pneu_observe__pressures_swapped__net_flow_changes_sign_only)
{
  static const double other[] = {1e5, 2e5, 2.9e5, 2.9999e5};
  int law, i;
  for (law = 0; law < PNEU_FLOW_COUNT; law++)
    for (i = 0; i < COUNT(other); i++) {
      check_note("%s, %g Pa", pneu_flow_key(law), other[i]);
      assert_true(net_flow(law, other[i], 3e5) > 0);
      assert_close(net_flow(law, other[i], 3e5), -net_flow(law, 3e5, other[i]), 0, TOL(1e-12, 1e-2));
    }
}

TEST(test_pneu_observe__vacuum_at_open_vent__draws_ambient_air)
{
  const pneu_params p = fixture_vessel(1e-3);
  const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), -0.5, -4e4, 0);
  const fixture_sample look = fixture_see(&rig);
  assert_close(look.in, paper(&rig.m, 0.5e-6, (double)p.ambient_pressure, 298.15, (double)p.ambient_pressure - 4e4), 0,
               TOL(1e-13, 1e-6));
  assert_close(look.out, 0, 0, 0);
}

TEST(test_pneu_observe__shut__passes_nothing)
{
  const pneu_params p = fixture_vessel(1e-3);
  const fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 1e5, 0);
  const fixture_sample look = fixture_see(&rig);
  assert_true(look.in <= 0 && look.out <= 0);
}

TEST(test_pneu_observe__open_orifice_without_area__passes_nothing_and_is_not_choked)
{
  pneu_params p = fixture_vessel(1e-3);
  fixture_rig rig;
  fixture_sample look;
  p.fill_area = 0;
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED), 1, 0, 0);
  look = fixture_see(&rig);
  assert_close(look.in, 0, 0, 0);
  assert_int_equal(look.choked, 0);
}

TEST(test_pneu_observe__choked__is_reported_while_it_lasts)
{
  const pneu_params p = fixture_vessel(1e-3);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED);
  const pneu_input input = fixture_input(&m, 1);
  const double p_s = 4e5 + (double)p.ambient_pressure, edge = 0.528281787717 * p_s - (double)p.ambient_pressure;
  pneu_state s = fixture_rest(&m, edge - 100, 0, &input);
  assert_true(fixture_look(&m, &s, &input).choked);
  s = fixture_rest(&m, edge + 100, 0, &input);
  assert_false(fixture_look(&m, &s, &input).choked);
}
