/* Which of two answers is told: effects beside values as declared, or values that deviate. */
#include "../../check.h"

#include "../../../apps/lab/trace/contest.h"

static lab_finding exact, tolerant;

/* An effect explains as much as one value far beyond its tolerance. */
static void name(const char *param)
{
  const lab_quality noise = {.fitted = 1, .white = 1, .chi2 = 1000, .bic = 1020, .values = 1000};
  exact = tolerant = (lab_finding){0};
  exact.best.quality = tolerant.best.quality = noise;
  exact.best.n_found = 1;
  exact.best.found[0].term = -1;
  exact.best.found[0].param = pneu_param_find(param);
  exact.best.found[0].effect = pneu_effect_of(exact.best.found[0].param);
  tolerant.best.quality.strain = lab_constant(LAB_STRAINED) + 1;
}

TEST(test_lab_contest_is_better__value_far_off__is_told_only_by_odds)
{
  const double odds = lab_constant(LAB_ALIKE_BIC);
  name("chamber_leak.leak_area");
  exact.best.quality.bic += odds - 0.1;
  assert_true(lab_contest_is_better(&exact, &tolerant));
  exact.best.quality.bic += 0.2;
  assert_false(lab_contest_is_better(&exact, &tolerant));
}

TEST(test_lab_contest_is_better__gain_of_a_sensor__is_no_less_far_off)
{
  const double odds = lab_constant(LAB_ALIKE_BIC);
  name("pressure_gain.pressure_gain");
  exact.best.quality.bic -= odds - 0.1;
  assert_false(lab_contest_is_better(&exact, &tolerant));
  exact.best.quality.bic -= 0.2;
  assert_true(lab_contest_is_better(&exact, &tolerant));
}
