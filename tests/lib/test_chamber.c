/* The gas in the chamber against closed forms. */
#include "../fixture.h"

static double gas_constant(const pneu_params *p)
{
  return (double)p->gas_constant;
}

/* Time in which a choked isothermal vessel falls by e: V/(a c R sqrt(T)). */
static double blowdown_time(const pneu_params *p, double area)
{
  const double g = (double)p->heat_ratio, R = gas_constant(p), T = (double)p->ambient_temperature;
  const double c = sqrt(g / R) * pow(2 / (g + 1), (g + 1) / (2 * (g - 1)));
  return (double)p->dead_volume / (area * c * R * sqrt(T));
}

static double absolute(const pneu_params *p, const pneu_state *s)
{
  return (double)s->p + (double)p->ambient_pressure;
}

/* ---- vessels ---- */

TEST(test_pneu_run__choked_isothermal_blowdown__is_exponential)
{
  static const int laws[] = {PNEU_FLOW_CHOKED, PNEU_FLOW_ISO6358};
  pneu_params p = fixture_vessel(2e-3);
  const double tau = blowdown_time(&p, 0.5e-6), p0 = 20e5;
  int i, j;
  p.critical_ratio = (pneu_real)0.528;
  for (j = 0; j < COUNT(laws); j++) {
    fixture_rig rig =
        fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, laws[j]), -0.5, p0 - (double)p.ambient_pressure, 0);
    for (i = 1; i <= 4; i++) {
      fixture_go(&rig, 0.5 * tau, FIXTURE_TOL, NULL);
      check_note("%s, t = %g tau", pneu_flow_key(laws[j]), 0.5 * i);
      assert_close(absolute(&p, &rig.s), p0 * exp(-0.5 * i), 0, TOL(1e-9, 1e-4));
      assert_close(rig.s.T, p.ambient_temperature, 0, 0);
    }
  }
}

TEST(test_pneu_run__choked_adiabatic_blowdown__follows_the_power_law)
{
  static const int gases[] = {PNEU_GAS_ENERGY, PNEU_GAS_POLYTROPIC};
  pneu_params p = fixture_vessel(2e-3);
  const double tau = blowdown_time(&p, 1e-6), p0 = 20e5, g = (double)p.heat_ratio;
  int i, j;
  for (j = 0; j < COUNT(gases); j++) {
    fixture_rig rig = fixture_at(fixture_model(&p, gases[j], PNEU_FLOW_CHOKED), -1, p0 - (double)p.ambient_pressure, 0);
    for (i = 1; i <= 4; i++) {
      const double z = 1 + (g - 1) / 2 * 0.4 * i;
      fixture_go(&rig, 0.4 * tau, FIXTURE_TOL, NULL);
      check_note("%s, t = %g tau", pneu_gas_key(gases[j]), 0.4 * i);
      assert_close(absolute(&p, &rig.s), p0 * pow(z, -2 * g / (g - 1)), 0, TOL(1e-9, 2e-4));
      assert_close(rig.s.T, (double)p.ambient_temperature * pow(z, -2), 0, TOL(1e-9, 1e-4));
    }
  }
}

/* Eq. 8 with p_up constant: the root of p_up - p falls in proportion to time. */
TEST(test_pneu_run__isothermal_fill_by_paper_law__pressure_is_quadratic_in_time)
{
  pneu_params p = fixture_vessel(1e-3);
  const double R = gas_constant(&p), T = (double)p.ambient_temperature, pu = 4e5 + (double)p.ambient_pressure;
  const double k = R * T * 1e-6 / 1e-3 * sqrt(2 * pu / (R * T)), s0 = sqrt(4e5);
  fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 1, 0, 0);
  int i;
  for (i = 1; i <= 4; i++) {
    const double t = 0.2 * i * 2 * s0 / k, root = s0 - k * t / 2;
    fixture_go(&rig, 0.2 * 2 * s0 / k, FIXTURE_TOL, NULL);
    assert_close(rig.s.p, 4e5 - root * root, 0, TOL(1e-9, 1e-4));
  }
}

/* Eq. 8 with p_down constant: p = p_a (1 + cosh(c - k t))/2. */
TEST(test_pneu_run__isothermal_vent_by_paper_law__follows_the_hyperbolic_cosine)
{
  pneu_params p = fixture_vessel(1e-3);
  const double R = gas_constant(&p), T = (double)p.ambient_temperature, pa = (double)p.ambient_pressure;
  const double k = R * T * 1e-6 / 1e-3 * sqrt(2 / (R * T)), c = acosh(2 * (4e5 + pa) / pa - 1);
  fixture_rig rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), -1, 4e5, 0);
  int i;
  for (i = 1; i <= 4; i++) {
    fixture_go(&rig, 0.2 * c / k, FIXTURE_TOL, NULL);
    assert_close(absolute(&p, &rig.s), pa * (1 + cosh(c * (1 - 0.2 * i))) / 2, 0, TOL(1e-9, 1e-4));
  }
}

/* First law for a rigid vessel: m c_v T - m_0 c_v T_0 = (m - m_0) c_p T_s. */
TEST(test_pneu_run__adiabatic_fill__keeps_the_first_law)
{
  pneu_params p = fixture_vessel(1e-3);
  const double g = (double)p.heat_ratio, pa = (double)p.ambient_pressure, p0 = 2e4, T0 = 298.15, Ts = 350;
  fixture_rig rig;
  int i;
  p.supply_temperature = (pneu_real)Ts;
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 1, p0 - pa, 0);
  for (i = 0; i < 5; i++) {
    double p1;
    fixture_go(&rig, 0.6, FIXTURE_TOL, NULL);
    p1 = absolute(&p, &rig.s);
    assert_close(rig.s.T, p1 / ((p1 - p0) / (g * Ts) + p0 / T0), 0, TOL(1e-8, 1e-4));
  }
  assert_true(absolute(&p, &rig.s) > 3e5);
}

TEST(test_pneu_run__adiabatic_fill_of_a_near_vacuum__ends_near_gamma_times_supply_temperature)
{
  pneu_params p = fixture_vessel(1e-3);
  fixture_rig rig =
      fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 1, 50 - (double)p.ambient_pressure, 0);
  fixture_go(&rig, 60, FIXTURE_TOL, NULL);
  assert_close(rig.s.p, 4e5, 0, TOL(1e-8, 1e-4));
  assert_close(rig.s.T, (double)p.heat_ratio * 298.15, 0, 1e-3);
}

TEST(test_pneu_run__long_after__ends_at_supply_and_at_ambient_pressure)
{
  const pneu_params p = fixture_vessel(1e-4);
  int gas, flow;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (flow = 0; flow < PNEU_FLOW_COUNT; flow++) {
      const pneu_model m = fixture_model(&p, gas, flow);
      const pneu_input fill = fixture_input(&m, 1), vent = fixture_input(&m, -1);
      pneu_state s = fixture_rest(&m, 0, 0, &fill);
      check_note("%s, %s", pneu_gas_key(gas), pneu_flow_key(flow));
      fixture_run(&m, &s, &fill, 60, TOL(1e-8, 1e-5), NULL);
      assert_close(s.p, p.supply_pressure, TOL(0.01, 20), 0);
      fixture_run(&m, &s, &vent, 60, TOL(1e-8, 1e-5), NULL);
      assert_close(s.p, 0, TOL(0.01, 20), 0);
    }
}

/* A long step must not leap over the point of equal pressures. */
TEST(test_pneu_run__loose_tolerance__pressure_keeps_within_supply_and_ambient)
{
  static fixture_sample s[2001];
  static const double volume[] = {1e-6, 1e-5, 1e-4, 1e-3}, tol[] = {1e-3, 1e-4, 1e-5};
  int i, j, k, flow;
  for (flow = 0; flow < PNEU_FLOW_COUNT; flow++)
    for (i = 0; i < COUNT(volume); i++)
      for (j = 0; j < COUNT(tol); j++) {
        const pneu_params p = fixture_vessel(volume[i]);
        const pneu_model m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, flow);
        fixture_stretch stretch[2];
        pneu_state at;
        const double over = 20 * tol[j] * 5e5;
        int n;
        stretch[0].duration = stretch[1].duration = volume[i] * 1e4;
        stretch[0].input = fixture_input(&m, 1);
        stretch[1].input = fixture_input(&m, -1);
        at = fixture_rest(&m, 0, 0, &stretch[0].input);
        n = fixture_trace(&m, &at, stretch, 2, volume[i] * 10, tol[j], s, 2001);
        check_note("%s, V = %g, tol = %g", pneu_flow_key(flow), volume[i], tol[j]);
        for (k = 0; k < n; k++)
          assert_between(s[k].p, -over, 4e5 + over);
        assert_close(s[999].p, 4e5, over + 400, 0);
        assert_close(at.p, 0, over + 400, 0);
      }
}

/* ---- moved chambers, both orifices shut ---- */

/* A piston in a chamber of 1e-4 m3 that doubles over the stroke. */
static pneu_model moved(int gas, double n)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  p.area = (pneu_real)1e-3;
  p.dead_volume = (pneu_real)1e-4;
  p.stroke = (pneu_real)0.1;
  p.polytropic_index = (pneu_real)n;
  return fixture_model_roles(&p, gas, PNEU_FLOW_PAPER, 0, 1);
}

/* Expand to twice the volume in `time`.  Returns: the ratio of absolute pressures. */
static double expand(const pneu_model *m, double time, pneu_state *s)
{
  pneu_input input = fixture_input(m, 0);
  double p0;
  *s = fixture_rest(m, 2e5, 0, &input);
  p0 = absolute(&m->p, s);
  input.position_rate = (pneu_real)(0.1 / time);
  fixture_run(m, s, &input, time, FIXTURE_TOL, NULL);
  assert_close(s->x, 0.1, 0, TOL(1e-12, 1e-5));
  assert_true(s->mode == PNEU_MODE_DRIVEN && s->v == input.position_rate);
  return absolute(&m->p, s) / p0;
}

TEST(test_pneu_run__moved_shut_chamber__keeps_p_times_volume_to_the_n)
{
  static const double n[] = {1, 1.1, 1.25, 1.4, 1.6};
  int i;
  for (i = 0; i < COUNT(n); i++) {
    const pneu_model m = moved(PNEU_GAS_POLYTROPIC, n[i]);
    pneu_state s;
    check_note("n = %g", n[i]);
    assert_close(expand(&m, 0.05, &s), pow(2, -n[i]), 0, TOL(1e-9, 1e-4));
    assert_close(s.T, 298.15 * pow(2, 1 - n[i]), 0, TOL(1e-9, 1e-4));
  }
}

TEST(test_pneu_run__moved_shut_chamber__energy_law_is_adiabatic_and_isothermal_law_boyle)
{
  const pneu_model energy = moved(PNEU_GAS_ENERGY, 1.2), isothermal = moved(PNEU_GAS_ISOTHERMAL, 1.2);
  pneu_state s;
  assert_close(expand(&energy, 0.05, &s), pow(2, -1.4), 0, TOL(1e-9, 1e-4));
  assert_close(s.T, 298.15 * pow(2, -0.4), 0, TOL(1e-9, 1e-4));
  assert_close(expand(&isothermal, 0.05, &s), 0.5, 0, TOL(1e-9, 1e-4));
  assert_close(s.T, 298.15, 0, TOL(1e-15, 1e-7));
}

TEST(test_pneu_run__moved_shut_chamber__keeps_its_mass)
{
  int gas;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    fixture_rig rig = fixture_at(moved(gas, 1.3), 0, 2e5, 0);
    pneu_state s;
    expand(&rig.m, 0.03, &s);
    check_note("%s", pneu_gas_key(gas));
    assert_close(pneu_mass(&rig.m, &s), pneu_mass(&rig.m, &rig.s), 0, TOL(2e-9, 1e-4));
  }
}

TEST(test_pneu_run__swept_ratio_zero__movement_leaves_the_pressure)
{
  pneu_params p = moved(PNEU_GAS_ENERGY, 1.4).p;
  pneu_model m;
  pneu_state s;
  p.swept_ratio = 0;
  m = fixture_model_roles(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 0, 1);
  assert_close(expand(&m, 0.05, &s), 1, 0, 0);
}

/* Work of the gas over the sampled run, by Simpson's rule. */
static double work(const fixture_sample *s, int n, double area, double pa)
{
  double sum = 0;
  int i;
  for (i = 0; i + 2 < n; i += 2)
    sum += (s[i + 2].x - s[i].x) / 6 * area * (s[i].p + 4 * s[i + 1].p + s[i + 2].p + 6 * pa);
  return sum;
}

TEST(test_pneu_run__isothermal_pumping__takes_the_logarithmic_work)
{
  static fixture_sample s[101];
  const pneu_model m = moved(PNEU_GAS_ISOTHERMAL, 1.4);
  const double pa = (double)m.p.ambient_pressure, p0 = 2e5 + pa;
  int back;
  for (back = 0; back < 2; back++) {
    fixture_stretch stretch;
    pneu_state at;
    stretch.duration = 1.01;
    stretch.input = fixture_input(&m, 0);
    stretch.input.position_rate = (pneu_real)(back ? -0.1 : 0.1);
    at = fixture_rest(&m, 2e5, back ? 0.1 : 0, &stretch.input);
    assert_int_equal(fixture_trace(&m, &at, &stretch, 1, 0.01, FIXTURE_TOL, s, 101), 101);
    assert_close(work(s, 101, 1e-3, pa), back ? -p0 * 2e-4 * log(2) : p0 * 1e-4 * log(2), 0, TOL(1e-8, 1e-4));
  }
}

/* ---- limits of the film ---- */

TEST(test_pneu_run__film_resistance_to_zero__is_isothermal)
{
  pneu_params p = moved(PNEU_GAS_ISOTHERMAL, 1.4).p;
  double apart = 1;
  int i;
  fixture_need("heat_transfer");
  for (i = 0; i < 3; i++) {
    pneu_model m;
    pneu_state s;
    double now;
    fixture_set(&p, "film_resistance", 1e-2 * pow(TOL(10, 3), -i));
    m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 0, 1);
    now = fabs(expand(&m, 0.5, &s) - 0.5);
    check_note("film_resistance/10^%d", i);
    assert_between(now, 0, TOL(0.15, 0.5) * apart);
    apart = now;
  }
  assert_between(apart, 0, TOL(1e-5, 1e-3));
}

TEST(test_pneu_run__film_conductance_to_infinity__is_isothermal)
{
  pneu_params p = moved(PNEU_GAS_ENERGY, 1.4).p;
  pneu_model m;
  pneu_state s;
  fixture_need("heat_transfer");
  fixture_set(&p, "film_conductance", TOL(1e5, 1e3));
  m = fixture_model_roles(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 0, 1);
  assert_close(expand(&m, 0.5, &s), 0.5, 0, TOL(1e-5, 2e-3));
  assert_close(s.T, 298.15, 0, TOL(1e-5, 2e-3));
}

/* A standard run under the energy and the polytropic law is one and the same. */
static void check_same_run(const pneu_params *p)
{
  static fixture_sample a[320], b[320];
  fixture_sample *out[2];
  int gas[2] = {PNEU_GAS_ENERGY, PNEU_GAS_POLYTROPIC}, i, n = 0;
  out[0] = a;
  out[1] = b;
  for (i = 0; i < 2; i++) {
    const pneu_model m = fixture_model(p, gas[i], PNEU_FLOW_CHOKED);
    fixture_stretch stretch[3];
    pneu_state s;
    fixture_standard(&m, stretch);
    s = fixture_rest(&m, 0, 0, &stretch[0].input);
    n = fixture_trace(&m, &s, stretch, 3, 0.1, 1e-5, out[i], 320);
  }
  assert_true(n >= 300);
  for (i = 0; i < n; i++) {
    assert_close(a[i].p, b[i].p, 0, 0);
    assert_close(a[i].T, b[i].T, 0, 0);
    assert_close(a[i].x, b[i].x, 0, 0);
  }
}

TEST(test_pneu_run__no_film__energy_law_is_the_polytropic_one_at_n_equal_gamma)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  check_same_run(&p);
}

TEST(test_pneu_run__film_of_the_polytropic_law__is_that_of_the_energy_law_whatever_n)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_need("heat_transfer");
  fixture_set(&p, "film_conductance", 2);
  p.polytropic_index = (pneu_real)1.2;
  check_same_run(&p);
}

TEST(test_pneu_run__film_between__lies_between_isothermal_and_adiabatic)
{
  static const double G[] = {0.1, 0.5, 2, 10};
  pneu_params p = moved(PNEU_GAS_ENERGY, 1.4).p;
  double last = pow(2, -1.4);
  int i;
  fixture_need("heat_transfer");
  for (i = 0; i < COUNT(G); i++) {
    pneu_model m;
    pneu_state s;
    double now;
    fixture_set(&p, "film_conductance", G[i]);
    m = fixture_model_roles(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER, 0, 1);
    now = expand(&m, 0.5, &s);
    assert_between(now, last, 0.5);
    last = now;
  }
}

/* ---- parts ---- */

TEST(test_pneu_volume__along_the_stroke__is_dead_volume_and_swept)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  p.swept_ratio = (pneu_real)0.8;
  m = fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
  assert_close(pneu_volume(&m, 0), 2e-6, 0, TOL(1e-15, 1e-6));
  assert_close(pneu_volume(&m, (pneu_real)0.01), 2e-6 + 0.8 * 0.04 * 0.01, 0, TOL(1e-14, 1e-6));
}

TEST(test_pneu_mass__each_law__is_pv_over_rt)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const double pa = (double)p.ambient_pressure, V = 2e-6 + 0.04 * 0.005, R = gas_constant(&p);
  int gas;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    fixture_rig rig = fixture_at(fixture_model(&p, gas, PNEU_FLOW_PAPER), 0, 1e5, 0.005);
    const double T = gas == PNEU_GAS_ISOTHERMAL ? 298.15 : 400;
    rig.s.T = 400;
    check_note("%s", pneu_gas_key(gas));
    assert_close(pneu_mass(&rig.m, &rig.s), (1e5 + pa) * V / (R * T), 0, TOL(1e-14, 1e-6));
    assert_close(fixture_see(&rig).m, (1e5 + pa) * V / (R * T), 0, TOL(1e-14, 1e-6));
  }
}

TEST(test_pneu_run__pressure_input__follows_the_straight_line)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  int gas;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    fixture_rig rig = fixture_at(fixture_model_roles(&p, gas, PNEU_FLOW_CHOKED, 1, 0), 1, 1e4, 0);
    rig.input.pressure_rate = (pneu_real)3e4;
    fixture_go(&rig, 2, TOL(1e-8, 1e-5), NULL);
    assert_close(rig.s.p, 7e4, 0, TOL(1e-10, 1e-5));
    assert_close(fixture_see(&rig).in, 0, 0, 0);
  }
}

TEST(test_pneu_state_rest__outside_the_domain__is_refused)
{
  const pneu_params p = fixture_params(FIXTURE_R1_400);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  static const double bad[][3] = {{-101325, 300, 0}, {-2e5, 300, 0},     {NAN, 300, 0},   {0, 0, 0},
                                  {0, -5, 0},        {0, NAN, 0},        {0, 300, -1e-3}, {0, 300, 0.0201},
                                  {0, 300, NAN},     {INFINITY, 300, 0}, {0, INFINITY, 0}};
  pneu_state s;
  int i;
  for (i = 0; i < COUNT(bad); i++) {
    check_note("case %d", i);
    assert_int_equal(pneu_state_rest(&m, (pneu_real)bad[i][0], (pneu_real)bad[i][1], (pneu_real)bad[i][2], &input, &s),
                     PNEU_E_NONFINITE);
  }
  assert_int_equal(pneu_state_rest(&m, (pneu_real)-1e5, 250, p.stroke, &input, &s), PNEU_OK);
}

TEST(test_pneu_rhs__state_outside_the_domain__asks_for_a_smaller_step)
{
  static const double bad[][3] = {{-2e5, 300, 0.01}, {NAN, 300, 0.01}, {0, -1, 0.01}, {0, NAN, 0.01}, {0, 300, -0.01}};
  fixture_rig rig = fixture_at(fixture_r1_400(PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 1, 1e5, 0.01);
  pneu_output out;
  int i;
  rig.s.mode = PNEU_MODE_UP;
  for (i = 0; i < COUNT(bad); i++) {
    const pneu_real y[PNEU_STATE_MAX] = {(pneu_real)bad[i][0], (pneu_real)bad[i][1], (pneu_real)bad[i][2], 0};
    pneu_real dydt[PNEU_STATE_MAX];
    check_note("case %d", i);
    assert_int_equal(pneu_rhs(&rig.m, &rig.s, &rig.input, y, dydt), PNEU_RETRY_STATE);
    rig.s.p = y[0];
    rig.s.T = y[1];
    rig.s.x = y[2];
    assert_int_equal(pneu_observe(&rig.m, &rig.s, &rig.input, &out), PNEU_RETRY_STATE);
  }
}
