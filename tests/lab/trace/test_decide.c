/* What the search decides by: when a model leaves only noise, and which rule holds at which facts. */
#include "../../fixture.h"

#include "../../../apps/lab/trace/decide.h"

/* A fitted model with so many values that one standard deviation of chi-square is 20. */
static lab_quality quality(double chi2, double bic)
{
  const lab_quality q = {1, chi2, 200, bic, 0, 0, 0, 0};
  return q;
}

/* The declared model is the best one and leaves an excess of 1000. */
static lab_facts declared_alone(void)
{
  lab_facts f = {0};
  f.declared = f.best = quality(1200, 1200);
  f.excess = 1000;
  return f;
}

/* Two effects were added, the second in this round, and leave an excess of 400. */
static lab_facts two_effects(void)
{
  lab_facts f = declared_alone();
  f.round = 1;
  f.added = 1;
  f.n_found = 2;
  f.best = quality(600, 620);
  f.excess = 400;
  return f;
}

/* Whether a rule with an action holds. */
static int holds(enum lab_phase phase, int action, const lab_facts *f)
{
  int i, n = 0, any = 0;
  for (i = 0; i < lab_rule_count; i++)
    if (lab_rules[i].phase == phase && lab_rules[i].action == action) {
      n++;
      any |= lab_rules[i].holds(f) != 0;
    }
  if (n == 0)
    fail_msg("no rule %d in phase %d", action, phase);
  return any;
}

TEST(test_lab_is_noise__chi_square_near_its_expectation__is_noise)
{
  lab_quality q = quality(200 + 6 * 20 - 1, 0), many = {1, 1.1024e6, 1e6, 0, 0, 0, 0, 0};
  assert_true(lab_is_noise(&q));
  q.chi2 += 2;
  assert_false(lab_is_noise(&q));
  q.white = 1;
  assert_true(lab_is_noise(&q));
  q.fitted = 0;
  assert_false(lab_is_noise(&q));
  assert_true(lab_is_noise(&many));
  many.chi2 = 1.1026e6;
  assert_false(lab_is_noise(&many));
}

TEST(test_lab_is_clean__one_standard_deviation__is_the_limit)
{
  const lab_quality in = quality(219, 0), out = quality(221, 0);
  assert_true(lab_is_clean(&in));
  assert_false(lab_is_clean(&out));
}

TEST(test_lab_is_poor__half_of_the_excess__is_the_limit)
{
  const lab_quality declared = quality(1200, 0), much = quality(699, 0), little = quality(701, 0);
  lab_quality failed = much;
  failed.fitted = 0;
  assert_false(lab_is_poor(&declared, &much));
  assert_true(lab_is_poor(&declared, &little));
  assert_true(lab_is_poor(&declared, &failed));
}

TEST(test_rules__first_scores__call_for_free_terms_where_no_effect_explains_it)
{
  lab_facts f = declared_alone();
  f.effect = 333;
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_SCORE_TERMS, &f));
  f.effect = 334;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_SCORE_TERMS, &f));
  f.effect = 100;
  f.term = 501;
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_FIT_SCORED_TERM, &f));
  f.term = 499;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_FIT_SCORED_TERM, &f));
  f.term = 501;
  f.effect = 168;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_FIT_SCORED_TERM, &f));
  f.n_found = 1;
  f.effect = 0;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_SCORE_TERMS, &f));
}

/* It leaves 149 of an excess of 1500, and then 151. */
TEST(test_rules__free_term_that_comes_near__is_asked_with_tolerances_at_once)
{
  lab_facts f = declared_alone();
  f.within = quality(1100, 1100);
  f.best = quality(1700, 1700);
  f.free_term = quality(349, 500);
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_END, &f));
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_UNFOLD_TERM, &f));
  f.held = 1;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_END, &f));
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_UNFOLD_TERM, &f));
  f.free_term.chi2 = 351;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_UNFOLD_TERM, &f));
  f.free_term.chi2 = 201; /* which is noise */
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_UNFOLD_TERM, &f));
}

TEST(test_rules__values_as_declared__end_where_tolerances_alone_are_better)
{
  lab_facts f = declared_alone();
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_SCORE_TERMS, &f));
  f.within = quality(1100, 1201); /* a tenth of the excess, and no better */
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_SCORE_TERMS, &f));
  f.within = quality(600, 1199); /* most of the excess */
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  f.free_term = quality(200, 700);
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  f.free_term = (lab_quality){0};
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_SCORE_TERMS, &f));
}

TEST(test_rules__what_begins__is_fitted_where_it_scores_clearly_and_taken_where_it_convinces)
{
  lab_facts f = declared_alone();
  f.begins = 121;
  f.throughout = 100;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_FIT_CLEAR_ONSET, &f));
  f.can_begin = 1;
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_FIT_CLEAR_ONSET, &f));
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_TAKE_ONSET, &f));
  f.begins = 119;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_FIT_CLEAR_ONSET, &f));
  assert_true(holds(LAB_PHASE_LED, LAB_DO_FIT_ONSET, &f));
  f.extended = quality(215, 700); /* a leader that leaves a fiftieth is near enough */
  assert_false(holds(LAB_PHASE_LED, LAB_DO_FIT_ONSET, &f));
  f.extended = quality(230, 700);
  assert_true(holds(LAB_PHASE_LED, LAB_DO_FIT_ONSET, &f));
  f.extended = (lab_quality){0};
  f.begins = 49;
  assert_false(holds(LAB_PHASE_LED, LAB_DO_FIT_ONSET, &f));
  f.onset = quality(299, 1199); /* more than noise, but less than a tenth of the excess */
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_TAKE_ONSET, &f));
  f.onset = quality(330, 1199);
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_TAKE_ONSET, &f));
  f.onset = quality(220, 400);
  f.extended = quality(230, 399);
  assert_false(holds(LAB_PHASE_LED, LAB_DO_TAKE_ONSET, &f));
  f.extended = quality(230, 401);
  assert_true(holds(LAB_PHASE_LED, LAB_DO_TAKE_ONSET, &f));
  f.best = quality(319, 500); /* only noise: by odds, with values within their tolerances as well, and by no leader */
  f.begins = 121;
  f.extended = (lab_quality){0};
  f.held = 1;
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_FIT_CLEAR_ONSET, &f));
  assert_false(holds(LAB_PHASE_LED, LAB_DO_FIT_ONSET, &f));
  f.onset = quality(220, 500 - lab_constant(LAB_ALIKE_BIC) + 1);
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_TAKE_ONSET, &f));
  f.onset = quality(220, 500 - lab_constant(LAB_ALIKE_BIC) - 1);
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_TAKE_ONSET, &f));
  f.onset.chi2 = pow(1 - lab_constant(LAB_MIN_GAIN), 2) * f.best.chi2 + 1; /* takes nothing off that anybody sees */
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_TAKE_ONSET, &f));
}

TEST(test_rules__what_begins_beside_values_as_declared__ends_where_more_than_noise_is_left)
{
  lab_facts f = declared_alone();
  f.within = quality(1100, 1201);
  f.has_begun = 1;
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  f.best = quality(300, 350);
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
}

TEST(test_rules__values_as_declared__end_where_tolerances_beat_every_leader)
{
  lab_facts f = declared_alone();
  f.extended = quality(600, 700);
  assert_false(holds(LAB_PHASE_LED, LAB_DO_END, &f)); /* there are no tolerances */
  f.within = quality(600, 701);
  assert_false(holds(LAB_PHASE_LED, LAB_DO_END, &f));
  f.within = quality(600, 699);
  assert_true(holds(LAB_PHASE_LED, LAB_DO_END, &f));
  f.within.strain = lab_constant(LAB_STRAINED) + 0.1; /* values far off explain nearly anything, */
  assert_true(holds(LAB_PHASE_LED, LAB_DO_END, &f));
  f.extended = quality(215, 700); /* and a leader comes near */
  assert_false(holds(LAB_PHASE_LED, LAB_DO_END, &f));
  f.within.strain = 0;
  f.extended = (lab_quality){0};
  assert_false(holds(LAB_PHASE_LED, LAB_DO_END, &f)); /* no leader was fitted */
}

TEST(test_rules__values_within_tolerances__effects_come_before_onsets)
{
  lab_facts f = declared_alone();
  f.can_begin = 1;
  f.begins = 121;
  f.throughout = 100;
  assert_true(holds(LAB_PHASE_SCORED, LAB_DO_FIT_CLEAR_ONSET, &f));
  f.held = 1;
  assert_false(holds(LAB_PHASE_SCORED, LAB_DO_FIT_CLEAR_ONSET, &f));
  assert_true(holds(LAB_PHASE_LED, LAB_DO_FIT_ONSET, &f));
}

TEST(test_rules__extension__is_added_by_bic)
{
  lab_facts f = declared_alone();
  f.extended = quality(1100, 1190.7); /* 2 ln 100 = 9.21 below 1200 */
  assert_true(holds(LAB_PHASE_REFITTED, LAB_DO_ADD_EFFECT, &f));
  f.extended.bic = 1191;
  assert_false(holds(LAB_PHASE_REFITTED, LAB_DO_ADD_EFFECT, &f));
  f.extended = quality(1100, 1190.7);
  f.extended.fitted = 0;
  assert_false(holds(LAB_PHASE_REFITTED, LAB_DO_ADD_EFFECT, &f));
}

TEST(test_rules__after_a_round__earlier_effects_are_tried_again)
{
  lab_facts f = two_effects();
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_REMOVE_NEEDLESS, &f));
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_EXCHANGE, &f));
  f.n_found = 3;
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_REMOVE_NEEDLESS, &f));
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_EXCHANGE, &f));
  f.best.chi2 = 200;
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_EXCHANGE, &f));
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  f.coarse = 1;
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_END, &f));
  f.added = 0;
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_REMOVE_NEEDLESS, &f));
}

TEST(test_rules__after_a_round__a_free_term_waits_for_poor_effects_or_the_second)
{
  lab_facts f = declared_alone();
  f.best.chi2 = 701;
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_FIT_TERM, &f));
  f.best.chi2 = 699;
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_FIT_TERM, &f));
  f.round = 1;
  assert_true(holds(LAB_PHASE_ROUND, LAB_DO_FIT_TERM, &f));
  f.free_term = quality(900, 900);
  assert_false(holds(LAB_PHASE_ROUND, LAB_DO_FIT_TERM, &f));
}

TEST(test_rules__free_term__replaces_one_effect_by_half_and_two_by_less)
{
  lab_facts f = two_effects();
  f.free_term = quality(599, 610);
  assert_true(holds(LAB_PHASE_END, LAB_DO_TAKE_TERM, &f));
  f.n_found = 1;
  assert_false(holds(LAB_PHASE_END, LAB_DO_TAKE_TERM, &f));
  f.free_term.chi2 = 399;
  assert_true(holds(LAB_PHASE_END, LAB_DO_TAKE_TERM, &f));
  f.free_term.bic = f.best.bic - 9;
  assert_false(holds(LAB_PHASE_END, LAB_DO_TAKE_TERM, &f));
  f.free_term.bic = 610;
  f.best.chi2 = 319; /* noise */
  assert_false(holds(LAB_PHASE_END, LAB_DO_TAKE_TERM, &f));
}

TEST(test_rules__free_term_beside__needs_room_and_something_left)
{
  lab_facts f = two_effects();
  assert_true(holds(LAB_PHASE_END, LAB_DO_FIT_TERM_BESIDE, &f));
  f.best.chi2 = 239;
  assert_false(holds(LAB_PHASE_END, LAB_DO_FIT_TERM_BESIDE, &f));
  f.n_found = 0;
  assert_true(holds(LAB_PHASE_END, LAB_DO_FIT_TERM_BESIDE, &f));
  f.n_terms = 1;
  assert_false(holds(LAB_PHASE_END, LAB_DO_FIT_TERM_BESIDE, &f));
  f = two_effects();
  f.n_found = 3;
  assert_false(holds(LAB_PHASE_END, LAB_DO_FIT_TERM_BESIDE, &f));
  f = two_effects();
  f.extended = quality(399, 500);
  assert_true(holds(LAB_PHASE_END, LAB_DO_ADD_TERM, &f));
  f.extended.chi2 = 401;
  assert_false(holds(LAB_PHASE_END, LAB_DO_ADD_TERM, &f));
  f.best = quality(210, 620); /* noise, by a declared value that is beyond its tolerance */
  f.best.strain = 4;
  f.extended = quality(190, 500);
  assert_true(holds(LAB_PHASE_END, LAB_DO_ADD_TERM, &f));
  f.extended.strain = 4;
  assert_false(holds(LAB_PHASE_END, LAB_DO_ADD_TERM, &f));
}

TEST(test_lab_decide_verdict__each_outcome__has_its_verdict)
{
  lab_facts f = two_effects();
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNDECIDED);
  f.best.of_sensors = 1; /* as much at rest as in motion */
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_EFFECT);
  f.best.of_sensors = 0;
  f.found_term = 1;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNLISTED);
  f.best.chi2 = 9 * f.best.values; /* three times the noise: the term is not the answer */
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNDECIDED);
  f.best.chi2 *= 0.99;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNLISTED);
  f.best.strain = 4; /* tolerances off, and more than noise is left */
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNDECIDED);
  f.best.chi2 = 200;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNLISTED);
  f.begins_within = 1;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNDECIDED);
  f.begins_within = 0;
  f.found_term = 0;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_EFFECT);
  f.in_one_loop = 1;
  f.n_causes = 3;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_UNDECIDED);
  f.n_causes = 2;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_EFFECT);
  f.n_found = 0;
  assert_int_equal(lab_decide_verdict(&f), LAB_VERDICT_NONE);
  assert_string_equal(lab_verdict_text(LAB_VERDICT_NONE), "none");
}

/* A name can be found before everything was tried; that there is nothing to be found cannot. */
TEST(test_lab_needs_the_whole_search__a_name__does_not)
{
  assert_true(lab_needs_the_whole_search(LAB_VERDICT_NONE));
  assert_true(lab_needs_the_whole_search(LAB_VERDICT_UNLISTED));
  assert_false(lab_needs_the_whole_search(LAB_VERDICT_EFFECT));
}

TEST(test_lab_values_stand_in__undecided_by_more_than_noise__they_do)
{
  assert_true(lab_values_stand_in(LAB_VERDICT_UNDECIDED, 2.26));
  assert_true(lab_values_stand_in(LAB_VERDICT_UNDECIDED, NAN));
  assert_false(lab_values_stand_in(LAB_VERDICT_UNDECIDED, 2.24));
  assert_false(lab_values_stand_in(LAB_VERDICT_EFFECT, 100));
}
