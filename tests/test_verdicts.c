/* apps/study/verdicts: no cause is exempt from being tried alone */
#include "check.h"

#include <string.h>

#include "../apps/study/verdicts.h"

static lab_error error;

static const double below = 0.1;

/* One cause without which as much is left as given, alone as much; base 1. */
static verdicts_law law_with(double without, double alone)
{
  verdicts_law law;
  int c;
  memset(&law, 0, sizeof law);
  law.base = 1;
  for (c = 0; c < REMOVALS; c++) {
    law.without[c] = 0.5;
    law.alone[c] = (double)NAN;
  }
  law.without[REMOVE_SPRING] = without;
  law.alone[REMOVE_SPRING] = alone;
  return law;
}

static const char *text_of(double without, double alone)
{
  const verdicts_law law = law_with(without, alone);
  return verdicts_text(&law, REMOVE_SPRING, below);
}

static void test_verdicts_text__crossing_a_threshold__flips(void **state)
{
  (void)state;
  assert_string_equal(text_of(0.0999, 0.1001), "confirmed");
  assert_string_equal(text_of(0.0999, 0.0999), "confirmed as necessary; alone it makes no asymmetry");
  assert_string_equal(text_of(0.1001, (double)NAN), "not confirmed");
  assert_string_equal(text_of(2, (double)NAN), "not confirmed");
  assert_string_equal(text_of(1 + 1e-9, (double)NAN), "not confirmed: nothing to take away");
}

/* The same numbers give the same verdict, whichever cause has them. */
static void test_verdicts_text__any_cause__judged_alike(void **state)
{
  verdicts_law law = law_with(0.01, 0.01);
  int c;
  (void)state;
  for (c = 0; c < REMOVALS; c++) {
    law.without[c] = law.alone[c] = 0.01;
    assert_string_equal(verdicts_text(&law, c, below), verdicts_text(&law, REMOVE_SPRING, below));
  }
}

static void check_law(const study *s, const lab_rig *rig, int gas, int flow)
{
  verdicts_law law;
  int c;
  check_note("%s, %s, %s", rig->name, pneu_gas_key(gas), pneu_flow_key(flow));
  if (verdicts_measure(rig, gas, flow, s->confirmed_below, &law, &error))
    fail_msg("%s", error.text);
  assert_true(law.base > 0.01);
  /* two causes are needed: each is what is left when the other is taken away */
  assert_close(law.alone[REMOVE_AIR_PROCESS], law.without[REMOVE_SPRING], 1e-15, 0);
  assert_close(law.alone[REMOVE_SPRING], law.without[REMOVE_AIR_PROCESS], 1e-15, 0);
  assert_true(law.alone[REMOVE_AIR_PROCESS] < s->confirmed_below * law.base);
  assert_true(law.alone[REMOVE_SPRING] < s->confirmed_below * law.base);
  for (c = REMOVE_PRELOAD; c <= REMOVE_UNEQUAL_TIMES; c++)
    assert_true(isnan(law.alone[c]));
  assert_string_equal(verdicts_text(&law, REMOVE_AIR_PROCESS, s->confirmed_below),
                      verdicts_text(&law, REMOVE_SPRING, s->confirmed_below));
  assert_string_equal(verdicts_text(&law, REMOVE_AIR_PROCESS, s->confirmed_below),
                      "confirmed as necessary; alone it makes no asymmetry");
}

static void test_verdicts_measure__every_law_and_actuator__spring_and_air_judged_alike(void **state)
{
  static study s;
  int a, g, f;
  (void)state;
  if (study_read("study/hypotheses.cfg", &s, &error))
    fail_msg("%s", error.text);
  for (a = 0; a < s.n_actuators; a++)
    for (g = 0; g < s.n_gas; g++)
      for (f = 0; f < s.n_flow; f++)
        check_law(&s, &s.actuator[a], s.gas[g], s.flow[f]);
}

/* Where one cause is enough nothing else is taken away when it is tried alone: what it makes is all there is. */
static void test_verdicts_measure__a_threshold_that_one_cause_meets__confirmed(void **state)
{
  static study s;
  verdicts_law law;
  const double strict = 1e-6;
  (void)state;
  if (study_read("study/hypotheses.cfg", &s, &error))
    fail_msg("%s", error.text);
  if (verdicts_measure(&s.actuator[0], PNEU_GAS_ISOTHERMAL, PNEU_FLOW_PAPER, strict, &law, &error))
    fail_msg("%s", error.text);
  assert_close(law.alone[REMOVE_AIR_PROCESS], law.base, 0, 1e-12);
  assert_string_equal(verdicts_text(&law, REMOVE_AIR_PROCESS, strict), "confirmed");
  assert_string_equal(verdicts_text(&law, REMOVE_SPRING, strict), "not confirmed");
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_verdicts_text__crossing_a_threshold__flips),
      cmocka_unit_test(test_verdicts_text__any_cause__judged_alike),
      cmocka_unit_test(test_verdicts_measure__every_law_and_actuator__spring_and_air_judged_alike),
      cmocka_unit_test(test_verdicts_measure__a_threshold_that_one_cause_meets__confirmed),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
