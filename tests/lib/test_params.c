/* The parameter list, its bounds, and the words. */
#include "../fixture.h"

static int init(const pneu_params *p, int *bad)
{
  static const pneu_laws law;
  pneu_model model;
  return pneu_model_init(&model, p, &law, bad);
}

/* Set parameter i of the defaults to `value` and see whether it is refused by name. */
static void check_value(int i, double value, int allowed)
{
  pneu_params p;
  pneu_param_info info;
  int bad = -2, status;
  pneu_params_default(&p);
  pneu_param_describe(i, &info);
  *pneu_param_at(&p, i) = (pneu_real)value;
  status = init(&p, &bad);
  check_note("%s = %g: %s, bad = %d", info.name, value, pneu_status_text(status), bad);
  assert_close(status, allowed ? PNEU_OK : PNEU_E_PARAM, 0, 0);
  assert_close(bad, allowed ? -1 : i, 0, 0);
}

TEST(test_pneu_model_init__defaults__are_accepted)
{
  pneu_params p;
  int bad = -2;
  pneu_params_default(&p);
  assert_int_equal(init(&p, &bad), PNEU_OK);
  assert_int_equal(bad, -1);
  assert_int_equal(init(&p, NULL), PNEU_OK);
}

TEST(test_pneu_model_init__each_parameter_outside_its_bounds__is_refused_by_name)
{
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    double out;
    pneu_param_describe(i, &info);
    out = 1e-5 * ((double)info.upper - (double)info.lower);
    check_value(i, (double)info.lower, 1);
    check_value(i, (double)info.upper, 1);
    check_value(i, (double)info.lower - out, 0);
    check_value(i, (double)info.upper + out, 0);
    check_value(i, NAN, 0);
    check_value(i, INFINITY, 0);
    check_value(i, -INFINITY, 0);
  }
}

/* An initialiser that names only what it needs leaves the rest 0. */
TEST(test_pneu_model_init__form_left_at_0__is_accepted_where_its_effect_is_neutral)
{
  pneu_params p;
  pneu_param_info info;
  int e, i, k, count, bad, forms = 0;
  pneu_params_default(&p);
  memset(p.effect, 0, sizeof p.effect);
  assert_int_equal(init(&p, &bad), PNEU_OK);
  for (e = 0; e < PNEU_EFFECT_COUNT; e++)
    for (i = pneu_effect_params(e, &count), k = i; k < i + count; k++) {
      pneu_param_describe(k, &info);
      if (!info.shape || info.lower <= 0)
        continue;
      pneu_params_default(&p);
      *pneu_param_at(&p, k) = 0;
      pneu_param_describe(i, &info);
      *pneu_param_at(&p, i) = info.value;
      check_note("%s without its form", pneu_effect_at(e)->name);
      assert_int_equal(init(&p, &bad), PNEU_E_PARAM);
      assert_int_equal(bad, k);
      forms++;
    }
  assert_true(forms > 0 || PNEU_EFFECT_COUNT == 0);
}

TEST(test_pneu_model_init__two_bad_parameters__names_the_first)
{
  pneu_params p;
  int bad;
  pneu_params_default(&p);
  p.moving_mass = -1;
  p.heat_ratio = 5;
  assert_int_equal(init(&p, &bad), PNEU_E_PARAM);
  assert_int_equal(bad, PNEU_PARAM_moving_mass);
  assert_int_equal(init(&p, NULL), PNEU_E_PARAM);
}

TEST(test_pneu_model_init__unknown_law__is_refused)
{
  static const int bad[][2] = {{-1, 0}, {PNEU_GAS_COUNT, 0}, {0, -1}, {0, PNEU_FLOW_COUNT}, {99, 99}};
  pneu_params p;
  pneu_model model;
  int i;
  pneu_params_default(&p);
  for (i = 0; i < COUNT(bad); i++) {
    pneu_laws law = {0, 0, 0, 0};
    law.gas = bad[i][0];
    law.flow = bad[i][1];
    assert_int_equal(pneu_model_init(&model, &p, &law, NULL), PNEU_E_LAW);
  }
}

TEST(test_pneu_model_init__same_arguments__same_model_whatever_was_there)
{
  const pneu_laws law = {PNEU_GAS_ENERGY, PNEU_FLOW_CHOKED, 0, 1};
  pneu_params p;
  pneu_model a, b;
  memset(&a, 0x55, sizeof a);
  memset(&b, 0xaa, sizeof b);
  pneu_params_default(&p);
  assert_int_equal(pneu_model_init(&a, &p, &law, NULL), PNEU_OK);
  assert_int_equal(pneu_model_init(&b, &p, &law, NULL), PNEU_OK);
  assert_memory_equal(&a, &b, sizeof a);
}

TEST(test_pneu_params_default__base__is_table_a1)
{
  pneu_params p;
  pneu_params_default(&p);
  assert_close(p.area, 0.04, 0, TOL(0, 1e-7));
  assert_close(p.dead_volume, 2e-6, 0, TOL(0, 1e-7));
  assert_close(p.stroke, 0.02, 0, TOL(0, 1e-7));
  assert_close(p.spring_rate, 4e5, 0, 0);
  assert_close(p.spring_preload, 0.01, 0, TOL(0, 1e-7));
  assert_close(p.moving_mass, 2, 0, 0);
  assert_close(p.dry_friction, 480, 0, 0);
  assert_close(p.viscous_friction, 500, 0, 0);
  assert_close(p.damping, 1000, 0, 0);
  assert_close(p.fill_area, 0.893e-6, 0, TOL(0, 1e-7));
  assert_close(p.vent_area, 0.893e-6, 0, TOL(0, 1e-7));
  assert_close(p.supply_pressure, 4e5, 0, 0);
  assert_close(p.gas_constant, 8.31446 / 0.02896, 0, TOL(1e-15, 1e-7));
}

TEST(test_pneu_params_default__effects__are_neutral_and_none_acts)
{
  pneu_params p;
  pneu_model model;
  int i;
  pneu_params_default(&p);
  for (i = PNEU_PARAM_BASE_COUNT; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    assert_true(*pneu_param_at(&p, i) == info.neutral);
  }
  model = fixture_model(&p, PNEU_GAS_ENERGY, PNEU_FLOW_PAPER);
  assert_int_equal(model.n_active, 0);
  assert_int_equal(model.n_extra, 0);
}

/* ---- the list ---- */

TEST(test_pneu_param_describe__each__is_complete_and_its_values_within_bounds)
{
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    assert_int_equal(pneu_param_describe(i, &info), PNEU_OK);
    check_note("%s", info.name);
    assert_true(info.name[0] && info.unit[0] && info.meaning[0]);
    assert_true(strspn(info.name, "abcdefghijklmnopqrstuvwxyz0123456789_") == strlen(info.name));
    assert_true(info.lower < info.upper);
    assert_between(info.value, info.lower, info.upper);
    assert_between(info.neutral, info.lower, info.upper);
  }
}

TEST(test_pneu_param_describe__names__are_unique)
{
  pneu_param_info a, b;
  int i, j;
  for (i = 0; i < PNEU_PARAM_COUNT; i++)
    for (j = 0; j < i; j++) {
      pneu_param_describe(i, &a);
      pneu_param_describe(j, &b);
      assert_string_not_equal(a.name, b.name);
    }
}

TEST(test_pneu_param_find__each_name_alone_and_after_its_effect__is_its_index)
{
  char full[128];
  int i;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_param_info info;
    const int e = pneu_effect_of(i);
    pneu_param_describe(i, &info);
    check_note("%s", info.name);
    assert_int_equal(pneu_param_find(info.name), i);
    assert_int_equal(e < 0, i < PNEU_PARAM_BASE_COUNT);
    if (e < 0)
      continue;
    assert_int_equal(pneu_effect_find(pneu_effect_at(e)->name), e);
    snprintf(full, sizeof full, "%s.%s", pneu_effect_at(e)->name, info.name);
    assert_int_equal(pneu_param_find(full), i);
    assert_int_equal(pneu_param_find(full + 1), -1);
  }
}

TEST(test_pneu_param_find__what_is_not_there__is_not_found)
{
  static const char *const none[] = {"",      ".",     "Area",          "area ",
                                     ".area", "area.", "actuator.area", "chamber_lea.leak_area"};
  int i;
  for (i = 0; i < COUNT(none); i++)
    assert_int_equal(pneu_param_find(none[i]), -1);
  assert_int_equal(pneu_effect_find("leak"), -1);
  assert_int_equal(pneu_effect_of(PNEU_PARAM_COUNT), -1);
  assert_int_equal(pneu_effect_of(-1), -1);
}

TEST(test_pneu_param_describe__out_of_range__is_refused)
{
  pneu_param_info info;
  pneu_params p;
  assert_int_equal(pneu_param_describe(-1, &info), PNEU_E_PARAM);
  assert_int_equal(pneu_param_describe(PNEU_PARAM_COUNT, &info), PNEU_E_PARAM);
  assert_null(pneu_param_at(&p, -1));
  assert_null(pneu_param_at(&p, PNEU_PARAM_COUNT));
  assert_null(pneu_effect_at(-1));
  assert_null(pneu_effect_at(PNEU_EFFECT_COUNT));
  assert_int_equal(pneu_effect_params(-1, NULL), -1);
  assert_int_equal(pneu_effect_params(PNEU_EFFECT_COUNT, NULL), -1);
}

TEST(test_pneu_param_at__each__is_a_place_of_its_own_inside)
{
  pneu_params p;
  int i;
  pneu_params_default(&p);
  for (i = 0; i < PNEU_PARAM_COUNT; i++)
    *pneu_param_at(&p, i) = (pneu_real)(1000 + i);
  for (i = 0; i < PNEU_PARAM_COUNT; i++)
    assert_true(*pneu_param_at(&p, i) == (pneu_real)(1000 + i));
  assert_true(p.area == 1000 && p.stroke == 1000 + PNEU_PARAM_stroke);
  assert_true(p.polytropic_index == 1000 + PNEU_PARAM_polytropic_index);
}

TEST(test_pneu_effect_params__ranges__fill_the_list_in_order)
{
  int i, next = PNEU_PARAM_BASE_COUNT;
  for (i = 0; i < PNEU_EFFECT_COUNT; i++) {
    pneu_param_info info;
    int count = 0, k;
    const int first = pneu_effect_params(i, &count);
    assert_int_equal(first, next);
    assert_true(count > 0);
    for (k = 0; k < count; k++) {
      pneu_param_describe(first + k, &info);
      assert_string_equal(info.name, pneu_effect_at(i)->param[k].name);
    }
    next += count;
  }
  assert_int_equal(next, PNEU_PARAM_COUNT);
}

/* ---- words ---- */

TEST(test_pneu_text__in_and_out_of_range__has_words)
{
  assert_string_equal(pneu_status_text(PNEU_OK), "success");
  assert_string_equal(pneu_status_text(PNEU_E_STOPPED), "stopped by the observer");
  assert_string_equal(pneu_status_text(-77), "unknown");
  assert_string_equal(pneu_mode_text(PNEU_MODE_STUCK), "stuck");
  assert_string_equal(pneu_mode_text(PNEU_MODE_COUNT), "unknown");
  assert_string_equal(pneu_mode_text(-1), "unknown");
  assert_string_equal(pneu_gas_key(PNEU_GAS_POLYTROPIC), "polytropic");
  assert_string_equal(pneu_gas_key(PNEU_GAS_COUNT), "unknown");
  assert_string_equal(pneu_flow_key(PNEU_FLOW_ISO6358), "iso6358");
  assert_string_equal(pneu_flow_key(-1), "unknown");
}

/* Results that programs publish rest on the default tolerance. */
TEST(test_pneu_options_default__each__is_as_documented)
{
  pneu_options options;
  pneu_options_default(&options);
  assert_close(options.tol, TOL(1e-6, 1e-4), 0, TOL(1e-15, 1e-7));
  assert_close(options.h_max, 0, 0, 0);
  assert_int_equal(options.max_steps, 100000);
}
