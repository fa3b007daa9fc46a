/* What a fit says of declared values: in which order it is told. */
#include "../../fixture.h"

#include "../../../apps/lab/fit/deviations.h"

static lab_error error;

/* Well determined at a value. */
static void put(lab_unknowns *u, lab_fit_result *fit, int kind, int index, double value, double declared)
{
  u->unknown[u->n] =
      (lab_unknown){.kind = kind, .index = index, .run = LAB_ALL_RUNS, .value = value, .prior = declared};
  fit->low[u->n] = 0.99 * value;
  fit->high[u->n] = 1.01 * value;
  fit->state[u->n++] = LAB_STATE_FREE;
}

/* A filter of 25 ms is five tolerances, a spring half as stiff again five, friction of three times its sheet four, and
 * a supply that loses 4 % two: by size alone the order would be another. */
static void test_lab_deviations_find__begins_within_the_log__is_told_first(void **state)
{
  static lab_unknowns u;
  static lab_fit_result fit;
  static lab_deviations all;
  static lab_rig rig;
  const int lag = pneu_param_find("pressure_lag.pressure_time");
  double supply;
  (void)state;
  if (lag < 0)
    skip();
  lab_rig_default(&rig);
  supply = (double)rig.params.supply_pressure;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  rig.fit[rig.n_fit++] = lag;
  u.rig = rig;
  u.declared = rig.params;
  u.rig.onset[0] = (lab_rig_onset){.param = PNEU_PARAM_supply_pressure, .from = 5, .value = 0.96 * supply};
  u.rig.n_onsets = 1;
  put(&u, &fit, LAB_UNKNOWN_PARAM, lag, 0.025, 0);
  put(&u, &fit, LAB_UNKNOWN_PARAM, PNEU_PARAM_dry_friction, 3 * (double)rig.params.dry_friction, 480);
  put(&u, &fit, LAB_UNKNOWN_PARAM, PNEU_PARAM_spring_rate, 1.5 * (double)rig.params.spring_rate, 4e5);
  put(&u, &fit, LAB_UNKNOWN_ONSET, 0, 0.96 * supply, supply);
  assert_int_equal(lab_deviations_find(&rig, &u, &fit, &all, &error), LAB_OK);
  assert_int_equal(all.n, 4);
  assert_string_equal(all.of[0].name, "supply_pressure");
  assert_string_equal(all.of[1].name, "spring_rate");
  assert_string_equal(all.of[2].name, "dry_friction");
  assert_string_equal(all.of[3].name, "pressure_lag");
  assert_int_equal(all.condition, LAB_CONDITION_DEVIATES);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_deviations_find__begins_within_the_log__is_told_first),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
