/* Effects on the sensors: what each shows of a state that it leaves alone. */
#include "../footprint.h"

typedef struct shown {
  double p, x, T;
} shown;

static shown look(const pneu_model *m, const pneu_state *s, const pneu_input *input)
{
  pneu_output out;
  shown seen;
  assert_int_equal(pneu_observe(m, s, input, &out), PNEU_OK);
  seen.p = (double)out.shown_pressure;
  seen.x = (double)out.shown_position;
  seen.T = (double)out.shown_temperature;
  return seen;
}

/* At rest at 1.5 bar and 8 mm, gas at 330 K. */
static shown look_at_rest(const pneu_params *p)
{
  const pneu_model m = fixture_model(p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  pneu_state s;
  assert_int_equal(pneu_state_rest(&m, (pneu_real)1.5e5, 330, (pneu_real)0.008, &input, &s), PNEU_OK);
  return look(&m, &s, &input);
}

static void check_at_rest(const pneu_params *p, double pressure, double x, double T)
{
  const shown seen = look_at_rest(p);
  assert_close(seen.p, pressure, 0, TOL(1e-14, 1e-6));
  assert_close(seen.x, x, 0, TOL(1e-14, 1e-6));
  assert_close(seen.T, T, 0, TOL(1e-14, 1e-6));
}

static pneu_params with(const char *name, double value)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_set(&p, name, value);
  return p;
}

FOOTPRINT(pressure_bias, at_rest__is_added)
{
  const pneu_params p = with("pressure_bias", -3e3);
  check_at_rest(&p, 1.5e5 - 3e3, 0.008, 330);
}

FOOTPRINT(pressure_gain, at_rest__multiplies)
{
  const pneu_params p = with("pressure_gain", 0.04);
  check_at_rest(&p, 1.5e5 * 1.04, 0.008, 330);
}

FOOTPRINT(position_bias, at_rest__is_added)
{
  const pneu_params p = with("position_bias", 5e-4);
  check_at_rest(&p, 1.5e5, 0.0085, 330);
}

FOOTPRINT(position_gain, at_rest__multiplies)
{
  const pneu_params p = with("position_gain", -0.03);
  check_at_rest(&p, 1.5e5, 0.008 * 0.97, 330);
}

/* Bias is what a sensor shows of nothing: it is not multiplied by the gain. */
TEST(test_gain_and_bias__together__are_affine)
{
  static const char *const needed[] = {"pressure_bias", "pressure_gain", "position_bias", "position_gain"};
  pneu_params p = fixture_params(FIXTURE_R1_400);
  int i;
  for (i = 0; i < COUNT(needed); i++) {
    fixture_need(needed[i]);
    fixture_set(&p, needed[i], i == 0 ? 1e3 : i == 2 ? 1e-3 : 0.1);
  }
  check_at_rest(&p, 1.1 * 1.5e5 + 1e3, 1.1 * 0.008 + 1e-3, 330);
}

/* Behind a ramp from rest of slope r: r (t - tau (1 - exp(-t/tau))). */
static double trailing(double slope, double t, double tau)
{
  return slope * (t - tau * (1 - exp(-t / tau)));
}

FOOTPRINT(pressure_lag, ramp__trails_by_the_closed_form)
{
  static const double at[] = {0.01, 0.05, 0.4};
  const pneu_params p = with("pressure_time", 0.05);
  const pneu_model m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 1);
  pneu_input input = fixture_input(&m, 0);
  int i;
  check_at_rest(&p, 1.5e5, 0.008, 330);
  input.pressure_rate = (pneu_real)1e5;
  for (i = 0; i < COUNT(at); i++) {
    pneu_state s = fixture_rest(&m, 5e4, 0.01, &input);
    fixture_run(&m, &s, &input, at[i], FIXTURE_TOL, NULL);
    assert_close(look(&m, &s, &input).p, 5e4 + trailing(1e5, at[i], 0.05), TOL(1e-3, 5), 0);
    assert_close(s.p, 5e4 + 1e5 * at[i], TOL(1e-6, 0.1), 0);
  }
}

FOOTPRINT(position_lag, ramp__trails_by_the_closed_form)
{
  static const double at[] = {0.01, 0.05, 0.4};
  const pneu_params p = with("position_time", 0.05);
  const pneu_model m = fixture_model_roles(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, 1, 1);
  pneu_input input = fixture_input(&m, 0);
  int i;
  check_at_rest(&p, 1.5e5, 0.008, 330);
  input.position_rate = (pneu_real)0.01;
  for (i = 0; i < COUNT(at); i++) {
    pneu_state s = fixture_rest(&m, 5e4, 0.002, &input);
    fixture_run(&m, &s, &input, at[i], FIXTURE_TOL, NULL);
    assert_close(look(&m, &s, &input).x, 0.002 + trailing(0.01, at[i], 0.05), TOL(1e-11, 1e-6), 0);
    assert_close(s.x, 0.002 + 0.01 * at[i], TOL(1e-14, 1e-7), 0);
  }
}

/* From a sensor still at ambient temperature in gas that keeps its own. */
FOOTPRINT(temperature_lag, steady_gas__is_approached_as_first_order)
{
  const pneu_params p = with("temperature_time", 0.4);
  const pneu_model m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  const pneu_input input = fixture_input(&m, 0);
  pneu_state s;
  check_at_rest(&p, 1.5e5, 0.008, 330);
  assert_int_equal(pneu_state_rest(&m, (pneu_real)5e4, 330, 0, &input, &s), PNEU_OK);
  s.extra[0] = 1;
  fixture_run(&m, &s, &input, 0.3, FIXTURE_TOL, NULL);
  assert_close(look(&m, &s, &input).T, 330 - (330 - 298.15) * exp(-0.3 / 0.4), 0, TOL(1e-9, 1e-5));
  assert_close(s.T, 330, 0, TOL(1e-9, 1e-5));
}

/* The skew is the model's constant; a state shows what it holds. tests/lab/run/test_response.c has the programs. */
FOOTPRINT(channel_skew, model__holds_the_skew)
{
  const pneu_params p = with("channel_skew", -0.03);
  assert_close(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER).position_skew, -0.03, 0, TOL(1e-15, 1e-7));
  check_at_rest(&p, 1.5e5, 0.008, 330);
}

TEST(test_effects_def__each_effect_on_a_sensor__has_a_footprint_test)
{
  footprint_complete("sensor");
}

/* ---- pneu_show: the sensors alone ---- */

/* Set an effect to its usual size. */
static void switch_on(int effect, pneu_params *p)
{
  int i, count, first = pneu_effect_params(effect, &count);
  for (i = first; i < first + count; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    *pneu_param_at(p, i) = info.value;
  }
}

/* What pneu_show and pneu_observe say of a state is the same, to a rounding of absolute pressure.
 * Returns: whether the sensors show something else than the truth. */
static int show_as_observed(const pneu_model *m, const pneu_state *s, const pneu_input *input)
{
  pneu_output out;
  pneu_shown seen;
  assert_int_equal(pneu_observe(m, s, input, &out), PNEU_OK);
  assert_int_equal(pneu_show(m, s, input, &seen), PNEU_OK);
  assert_close(seen.pressure, out.shown_pressure, TOL(1e-10, 0.1), 0);
  assert_close(seen.temperature, out.shown_temperature, 0, 0);
  assert_close(seen.position, out.shown_position, 0, 0);
  assert_close(seen.force, m->law.position_input ? out.holding_force : 0, 0, 0);
  return fabs((double)(out.shown_pressure - out.pressure)) > 1 || out.shown_temperature != out.temperature ||
         out.shown_position != out.position;
}

/* In the middle of a fill, where all moves. */
static pneu_state filling(const pneu_model *m, pneu_input *input)
{
  pneu_state s;
  *input = fixture_input(m, 1);
  if (m->law.position_input)
    input->position_rate = (pneu_real)1e-3;
  s = fixture_rest(m, 1.2e5, 0.002, input);
  fixture_run(m, &s, input, 0.4, TOL(1e-8, 1e-4), NULL);
  return s;
}

/* Alone, in every gas law, as a free stem and as a driven one. */
TEST(test_pneu_show__every_effect__is_as_observed)
{
  int e, gas, driven;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const pneu_effect *effect = pneu_effect_at(e);
    int other = 0;
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
      for (driven = 0; driven < 2; driven++) {
        pneu_params p = fixture_params(FIXTURE_R1_400);
        pneu_model m;
        pneu_input input;
        pneu_state s;
        switch_on(e, &p);
        m = fixture_model_roles(&p, gas, PNEU_FLOW_CHOKED, 0, driven);
        s = filling(&m, &input);
        check_note("%s, %s%s", effect->name, pneu_gas_key(gas), driven ? ", driven" : "");
        other |= show_as_observed(&m, &s, &input);
      }
    assert_int_equal(other, !strcmp(effect->equation, "sensor") && effect->add);
  }
}

TEST(test_pneu_show__no_effect__is_the_truth)
{
  int gas;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    const pneu_model m = fixture_r1_400(gas, PNEU_FLOW_PAPER);
    pneu_input input;
    pneu_state s = filling(&m, &input);
    check_note("%s", pneu_gas_key(gas));
    assert_int_equal(show_as_observed(&m, &s, &input), 0);
    s.T += 50; /* says nothing where temperature is no state */
    assert_int_equal(show_as_observed(&m, &s, &input), 0);
  }
}

TEST(test_pneu_show__all_sensors_at_once__are_as_observed)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  pneu_model m;
  pneu_input input;
  pneu_state s;
  int e, any = 0;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    if (!strcmp(pneu_effect_at(e)->equation, "sensor")) {
      switch_on(e, &p);
      any |= pneu_effect_at(e)->add != NULL;
    }
  m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  s = filling(&m, &input);
  assert_int_equal(show_as_observed(&m, &s, &input), any);
}

/* Free terms that a sensor shows, one of them over the opening, and one that only acts. */
TEST(test_pneu_show__free_terms__are_as_observed)
{
  static const pneu_term term[] = {
      {PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_POSITION, 2, 0, (pneu_real)0.02, {3e3, 5e3}},
      {PNEU_TERM_SHOWN_POSITION, PNEU_TERM_OVER_PRESSURE, 2, 0, (pneu_real)4e5, {(pneu_real)1e-3, (pneu_real)2e-3}},
      {PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_OPENING, 2, -1, 1, {3e3, 5e3}},
      {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 2, 0, (pneu_real)0.02, {30, 60}}};
  int i;
  for (i = 0; i < COUNT(term); i++) {
    pneu_model m = fixture_r1_400(PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER);
    pneu_input input;
    pneu_state s;
    assert_int_equal(pneu_model_terms(&m, &term[i], 1), PNEU_OK);
    s = filling(&m, &input);
    check_note("term %d", i);
    assert_int_equal(show_as_observed(&m, &s, &input), i < 3);
  }
}

static int same_status(const pneu_model *m, const pneu_state *s, const pneu_input *input)
{
  pneu_output out;
  pneu_shown seen, before;
  int status;
  memset(&seen, 0x55, sizeof seen);
  before = seen;
  status = pneu_show(m, s, input, &seen);
  assert_int_equal(status, pneu_observe(m, s, input, &out));
  if (status != PNEU_OK)
    assert_memory_equal(&seen, &before, sizeof seen);
  return status;
}

/* No pressure, no temperature, no volume, or no number: refused by both, and nothing is written; with and without a
 * sensor between. */
TEST(test_pneu_show__unphysical_state__is_refused_as_by_pneu_observe)
{
  static const pneu_term bias = {PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_POSITION, 2, 0, 1, {3e3, 3e3}};
  int gas, n, role;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++)
    for (role = 0; role < 3; role++)
      for (n = 0; n < 2; n++) {
        const pneu_params p = fixture_params(FIXTURE_R1_400);
        fixture_rig rig = fixture_at(fixture_model_roles(&p, gas, PNEU_FLOW_PAPER, role == 1, role == 2), 1, 1e5, 0.01);
        pneu_state s = rig.s;
        assert_int_equal(pneu_model_terms(&rig.m, &bias, n), PNEU_OK);
        check_note("%s, role %d, %d terms", pneu_gas_key(gas), role, n);
        assert_int_equal(same_status(&rig.m, &s, &rig.input), PNEU_OK);
        s.p = -rig.m.p.ambient_pressure;
        assert_int_equal(same_status(&rig.m, &s, &rig.input), PNEU_RETRY_STATE);
        s.p = (pneu_real)NAN;
        assert_int_equal(same_status(&rig.m, &s, &rig.input), PNEU_RETRY_STATE);
        s = rig.s;
        s.T = 0;
        assert_int_equal(same_status(&rig.m, &s, &rig.input), rig.m.thermal ? PNEU_RETRY_STATE : PNEU_OK);
        s = rig.s;
        s.x = -1;
        assert_int_equal(same_status(&rig.m, &s, &rig.input), rig.m.law.pressure_input ? PNEU_OK : PNEU_RETRY_STATE);
      }
}

/* ---- Lags ---- */

TEST(test_lags__of_next_to_no_time__are_none)
{
  static const char *const lag[] = {"pressure_time", "position_time", "temperature_time", "transducer_time"};
  int i;
  for (i = 0; i < COUNT(lag); i++) {
    const pneu_params p = with(lag[i], 2e-19), none = with(lag[i], 0);
    const pneu_model m = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
    const pneu_model plain = fixture_model(&none, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
    const pneu_input input = fixture_input(&m, 1);
    pneu_state s = fixture_rest(&m, 0, 0, &input), expected = fixture_rest(&plain, 0, 0, &input);
    fixture_run(&m, &s, &input, 0.5, FIXTURE_TOL, NULL);
    fixture_run(&plain, &expected, &input, 0.5, FIXTURE_TOL, NULL);
    assert_close(s.p, expected.p, 0, 0);
    assert_close(look(&m, &s, &input).p, look(&plain, &expected, &input).p, 0, 0);
  }
}

TEST(test_lags__from_a_nanosecond_on__act)
{
  const pneu_params at = with("pressure_time", 1e-9), below = with("pressure_time", 0.999e-9);
  assert_int_equal(fixture_model(&at, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER).n_active, 1);
  assert_int_equal(fixture_model(&below, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER).n_active, 0);
}
