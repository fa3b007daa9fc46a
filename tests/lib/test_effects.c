/* Every effect: its record, its neutral value, the channel it acts on. What each does, test_effects_gas.c,
 * _stem.c and _sensor.c measure; tests/lab/run/test_effects_second.c compares it with an independent implementation. */
#include "../fixture.h"
#include "../../lib/internal.h"

enum { SAMPLES = 320 };

static const char *const names[] = {
#define PNEU_EFFECT(name, n_param, n_state) #name,
#include "../../lib/effects.def"
#undef PNEU_EFFECT
    NULL};

static int has_text(const char *s)
{
  return s && s[0];
}

/* ---- records ---- */

TEST(test_pneu_effect_at__each__has_a_complete_record)
{
  static const char *const equations[] = {"mass", "energy", "force", "command", "sensor"};
  int e, i, known;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const pneu_effect *effect = pneu_effect_at(e);
    check_note("%s", names[e]);
    assert_string_equal(effect->name, names[e]);
    assert_true(has_text(effect->what) && has_text(effect->source) && has_text(effect->footprint));
    for (i = known = 0; i < COUNT(equations); i++)
      known += strcmp(effect->equation, equations[i]) == 0;
    assert_int_equal(known, 1);
    assert_in_range(effect->stage, PNEU_STAGE_GEOMETRY, PNEU_STAGE_SENSOR);
    assert_true(effect->add || effect->prepare);
    assert_non_null(effect->param);
  }
}

TEST(test_pneu_effect_at__parameters__start_off_neutral_and_within_bounds)
{
  int e, k, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    pneu_effect_params(e, &count);
    for (k = 0; k < count; k++) {
      const pneu_param_info *info = &pneu_effect_at(e)->param[k];
      check_note("%s.%s", names[e], info->name);
      assert_true(has_text(info->name) && has_text(info->unit) && has_text(info->meaning));
      assert_between(info->value, info->lower, info->upper);
      assert_between(info->neutral, info->lower, info->upper);
      assert_int_equal(info->value == info->neutral, info->shape == PNEU_FORM_OWN);
    }
    assert_false(pneu_effect_at(e)->param[0].shape);
  }
}

/* ---- neutral ---- */

static int has_positioner(const pneu_params *p)
{
  const int gain = pneu_param_find("positioner.gain");
  return gain >= 0 && *pneu_param_at((pneu_params *)p, gain) > 0;
}

static int standard(const pneu_params *p, int gas, int flow, double tol, fixture_sample *out)
{
  const pneu_model m = fixture_model(p, gas, flow);
  fixture_stretch stretch[3];
  pneu_state s;
  int i;
  fixture_standard(&m, stretch);
  for (i = 0; i < COUNT(stretch); i++)
    stretch[i].input.set_position = has_positioner(p);
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

TEST(test_pneu_run__each_effect_neutral__is_the_base_model_bit_for_bit)
{
  static fixture_sample base[SAMPLES], neutral[SAMPLES];
  int e, gas, flow;
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

static int is_of_positioner(int e)
{
  return strncmp(names[e], "positioner", strlen("positioner")) == 0;
}

/* A base on which effect e can act, and which is its limit: a wall needs a film, air in a tube is at ambient
 * temperature, what is wrong with a positioner one to be wrong. */
static pneu_params ground(int e, int *gas)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  *gas = PNEU_GAS_ISOTHERMAL;
  if (strcmp(names[e], "heat_transfer") != 0 && strcmp(names[e], "chamber_exponent") != 0 &&
      strcmp(names[e], "connecting_tube") != 0 && pneu_effect_find("heat_transfer") >= 0) {
    *gas = PNEU_GAS_ENERGY;
    fixture_set(&p, "film_conductance", 5);
  }
  if (is_of_positioner(e) && pneu_effect_find("positioner") >= 0)
    fixture_set(&p, "gain", 2);
  if (strcmp(names[e], "long_chamber") == 0)
    p.dead_volume = PNEU_C(0.25);
  return p;
}

#ifndef PNEU_SINGLE /* a millionth of an effect is below the rounding of float */
/* Effect e at a share of its usual size; a short tube has little volume as well. */
static void set_share(pneu_params *p, int e, double share)
{
  const pneu_param_info *info = &pneu_effect_at(e)->param[0];
  fixture_set(p, info->name, (double)info->neutral + share * (double)(info->value - info->neutral));
  if (strcmp(names[e], "connecting_tube") == 0)
    fixture_set(p, "tube_volume", share < 1 ? 1e-9 : 2e-5);
}

/* Whether it acts within a run: a skew belongs to the recorder, a wall needs a film. */
static int acts_in_run(int e, int gas)
{
  const int skew = strcmp(names[e], "channel_skew") == 0;
  const int thermal = strcmp(names[e], "temperature_lag") == 0 || strcmp(names[e], "wall_temperature") == 0;
  return !skew && (gas == PNEU_GAS_ENERGY || !thermal);
}

static int fewer(int a, int b)
{
  return a < b ? a : b;
}

/* The base model is the limit of the effect, not a case apart. The last sample of a run may be lost to rounding. */
TEST(test_pneu_run__each_effect_nearly_neutral__is_nearly_the_base_model)
{
  static fixture_sample base[SAMPLES], small[SAMPLES];
  int e;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    int gas, n;
    pneu_params p = ground(e, &gas);
    double far, near;
    if (strcmp(names[e], "positioner") == 0)
      continue; /* the less its gain, the less it is the base model */
    n = standard(&p, gas, PNEU_FLOW_PAPER, 1e-7, base);
    assert_in_range(n, 305, 306);
    set_share(&p, e, 1);
    far = fixture_apart(base, small, fewer(n, standard(&p, gas, PNEU_FLOW_PAPER, 1e-7, small)));
    set_share(&p, e, 1e-3);
    near = fixture_apart(base, small, fewer(n, standard(&p, gas, PNEU_FLOW_PAPER, 1e-7, small)));
    check_note("%s: %g at full size, %g at a thousandth", names[e], far, near);
    assert_between(far, acts_in_run(e, gas) ? 1e-5 : 0, acts_in_run(e, gas) ? 2 : 1e-6);
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
  fixture_rig rig = fixture_at(fixture_model_roles(p, gas, PNEU_FLOW_PAPER, pressure, position), 0.5, 1e5, 0.002);
  rig.input.pressure_rate = (pneu_real)1e5;
  rig.input.position_rate = (pneu_real)0.01;
  fixture_go(&rig, 1, TOL(1e-8, 1e-5), NULL);
  return rig.s;
}

TEST(test_pneu_run__effect_of_anything_but_force__leaves_the_force_balance)
{
  int e, gas;
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

TEST(test_pneu_run__effect_of_force__leaves_the_balances_of_the_gas)
{
  int e, gas;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
      const pneu_params base = fixture_params(FIXTURE_R1_400), p = switched_on(e);
      const pneu_state a = run_with_given(&base, gas, 0, 1), b = run_with_given(&p, gas, 0, 1);
      if (!acts_on(e, "force") || strcmp(names[e], "area_variation") == 0) /* its volume follows its area */
        continue;
      check_note("%s, %s", names[e], pneu_gas_key(gas));
      assert_close(b.p, a.p, TOL(0.01, 10), 0);
      assert_close(b.T, a.T, TOL(1e-5, 0.01), 0);
    }
}

TEST(test_pneu_run__two_effects_with_states__each_keeps_its_own)
{
  pneu_params p = fixture_params(FIXTURE_R1_400);
  fixture_rig rig;
  fixture_need("presliding");
  fixture_need("transducer_lag");
  fixture_set(&p, "presliding_length", 2e-5);
  fixture_set(&p, "transducer_time", 0.5);
  rig = fixture_at(fixture_model(&p, PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER), 0, 1.2e5, 0.001);
  rig.input.u = 1;
  fixture_go(&rig, 0.4, TOL(1e-7, 1e-5), NULL);
  assert_int_equal(rig.m.n_extra, 2);
  assert_close(fixture_see(&rig).opening, 1 - exp(-0.4 / 0.5), TOL(1e-6, 1e-4), 0);
  assert_close(rig.s.extra[rig.m.state_of[pneu_effect_find("presliding")]], 1, 0.02, 0);
}

/* Slope of the rate of an effect's first state, at z, while the stem slides up. */
static pneu_real own_slope(const pneu_model *m, int e, pneu_real z, pneu_real step)
{
  const pneu_input input = fixture_input(m, 0.5);
  pneu_state s = fixture_rest(m, 1e5, 0.01, &input);
  pneu_real y[PNEU_STATE_MAX], f0[PNEU_STATE_MAX], f1[PNEU_STATE_MAX], jac[PNEU_STATE_MAX][PNEU_STATE_MAX];
  const int at = 1 + m->thermal + m->state_of[e];
  s.v = (pneu_real)0.003;
  s.mode = PNEU_MODE_UP;
  s.extra[m->state_of[e]] = z;
  pneu_pack(m, &s, y);
  assert_int_equal(pneu_rhs(m, &s, &input, y, f0), PNEU_OK);
  if (step == 0) {
    assert_int_equal(pneu_jacobian(m, &s, &input, y, f0, jac), PNEU_OK);
    return jac[at][at];
  }
  y[at] += step;
  assert_int_equal(pneu_rhs(m, &s, &input, y, f1), PNEU_OK);
  return (f1[at] - f0[at]) / step;
}

/* Rates are linear in the effects' own states, but for the tube's, which is never near zero. */
TEST(test_pneu_jacobian__state_of_an_effect_at_zero__is_as_good_as_elsewhere)
{
  int e, gas, k;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    static const double z[] = {0, 1e-7, 0.3};
    pneu_params p = ground(e, &gas);
    pneu_model m;
    fixture_set(&p, pneu_effect_at(e)->param[0].name, (double)pneu_effect_at(e)->param[0].value);
    m = fixture_model(&p, gas, PNEU_FLOW_CHOKED);
    for (k = 0; k < COUNT(z) && m.n_extra > 0 && strcmp(names[e], "connecting_tube") != 0; k++) {
      check_note("%s at %g", names[e], z[k]);
      assert_close(own_slope(&m, e, (pneu_real)z[k], 0), own_slope(&m, e, (pneu_real)z[k], (pneu_real)0.125), 0,
                   TOL(1e-6, 5e-3));
    }
  }
}

/* ---- all at once ---- */

TEST(test_pneu_run__all_effects_together__stays_physical)
{
  static fixture_sample s[SAMPLES];
  int gas, i, e, n;
  for (gas = 0; gas < PNEU_GAS_COUNT; gas++) {
    pneu_params p = fixture_params(FIXTURE_R1_400);
    for (e = 0; e < PNEU_EFFECT_COUNT; e++)
      *pneu_param_at(&p, pneu_effect_params(e, NULL)) = pneu_effect_at(e)->param[0].value;
    n = standard(&p, gas, PNEU_FLOW_PAPER, TOL(1e-6, 1e-4), s);
    check_note("%s", pneu_gas_key(gas));
    assert_true(n >= 305);
    for (i = 0; i < n; i++) {
      assert_between(s[i].p, -1e3, 4.01e5);
      assert_between(s[i].x, -5e-5, 0.02 + 2e-4); /* stops yield */
      assert_between(s[i].T, 150, 600);
    }
    assert_between(s[150].x, 0.015, 0.02 + 2e-4);
  }
}

/* A vessel has no stroke to divide by. */
TEST(test_pneu_observe__each_effect_on_a_vessel__shows_numbers)
{
  int e;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    pneu_params p = fixture_vessel(1e-3);
    fixture_sample look;
    fixture_rig rig;
    *pneu_param_at(&p, pneu_effect_params(e, NULL)) = pneu_effect_at(e)->param[0].value;
    rig = fixture_at(fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED), 1, 2e5, 0);
    fixture_go(&rig, 0.1, TOL(1e-6, 1e-4), NULL);
    look = fixture_see(&rig);
    check_note("%s", names[e]);
    assert_true(isfinite(look.p) && isfinite(look.T) && isfinite(look.m) && isfinite(look.in) &&
                isfinite(look.friction));
    assert_true(isfinite(look.shown_p) && isfinite(look.shown_T) && isfinite(look.shown_x));
    assert_close(look.x, 0, 0, 0);
    assert_true(look.friction > 0);
  }
}
