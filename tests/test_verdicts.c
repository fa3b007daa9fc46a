/* apps/study/verdicts, removals: no cause is exempt from being tried alone; what each does without the other */
#include "check.h"

#include <string.h>

#include "../apps/study/speeds.h"
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

/* ---- Why: PAPER.md 3.5 ---- */

/* Chamber pressure [Pa] gauge that balances a rising stem at a share of the travel. */
static double rising_pressure(const pneu_params *p, double share)
{
  return ((double)p->spring_rate * ((double)p->spring_preload + share * (double)p->stroke) + (double)p->dry_friction) /
         (double)p->area;
}

/* Linear symmetric air: both strokes slow down alike, as the distance to the supply shrinks. */
static void check_symmetric_air(const lab_rig *rig)
{
  pneu_params p = rig->params;
  pneu_laws laws = rig->laws;
  speed_pair pair;
  double slowing;
  removals[REMOVE_AIR_PROCESS].apply(&p, &laws);
  assert_int_equal(speeds_measure(&p, &laws, &pair, &error), LAB_OK);
  slowing = ((double)p.supply_pressure - rising_pressure(&p, speed_position(0))) /
            ((double)p.supply_pressure - rising_pressure(&p, speed_position(SPEED_POINTS - 1)));
  assert_true(slowing > 2);
  assert_close(speed_max(&pair.up) / speed_min(&pair.up), slowing, 0, 1e-2);
  assert_close(speed_max(&pair.down) / speed_min(&pair.down), slowing, 0, 1e-2);
}

/* A constant load: both strokes are nearly straight, though they take different times. */
static void check_constant_load(const lab_rig *rig)
{
  pneu_params p = rig->params;
  pneu_laws laws = rig->laws;
  speed_pair pair;
  removals[REMOVE_SPRING].apply(&p, &laws);
  assert_int_equal(speeds_measure(&p, &laws, &pair, &error), LAB_OK);
  assert_close(speed_max(&pair.up) / speed_min(&pair.up), 1, 0.03, 0);
  assert_close(speed_max(&pair.down) / speed_min(&pair.down), 1, 0.03, 0);
  assert_true(fabs(pair.shape.duration_ratio - 1) > 0.1);
}

static void test_removals__spring_or_air__each_stroke_as_the_closed_form_has_it(void **state)
{
  static study s;
  int a;
  (void)state;
  if (study_read("study/hypotheses.cfg", &s, &error))
    fail_msg("%s", error.text);
  for (a = 0; a < s.n_actuators; a++) {
    check_note("%s", s.actuator[a].name);
    check_symmetric_air(&s.actuator[a]);
    check_constant_load(&s.actuator[a]);
  }
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_verdicts_text__crossing_a_threshold__flips),
      cmocka_unit_test(test_verdicts_text__any_cause__judged_alike),
      cmocka_unit_test(test_verdicts_measure__every_law_and_actuator__spring_and_air_judged_alike),
      cmocka_unit_test(test_verdicts_measure__a_threshold_that_one_cause_meets__confirmed),
      cmocka_unit_test(test_removals__spring_or_air__each_stroke_as_the_closed_form_has_it),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
