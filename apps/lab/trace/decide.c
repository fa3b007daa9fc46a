#include "decide.h"

#include <math.h>

#define JUDGED "chosen by judgement; not calibrated"

const lab_constant_row lab_constants[LAB_CONSTANT_COUNT] = {
#define X(name, value, meaning, source) {#name, value, meaning, source},
#include "constants.def"
#undef X
};

double lab_constant(enum lab_constant which)
{
  return lab_constants[which].value;
}

int lab_count(enum lab_constant which)
{
  return (int)lab_constants[which].value;
}

/* ---- How good a model is ---- */

static double excess(const lab_quality *q)
{
  return q->chi2 - q->values;
}

/* Chi-square so many standard deviations above its expectation. */
static double beyond(const lab_quality *q, enum lab_constant deviations)
{
  return q->values + lab_constant(deviations) * sqrt(2 * q->values);
}

static int is_as_small_as_noise(const lab_quality *q)
{
  return q->fitted && (q->chi2 < beyond(q, LAB_NOISE_DEVIATIONS) || q->chi2 < lab_constant(LAB_NOISE_SLIP) * q->values);
}

int lab_is_noise(const lab_quality *q)
{
  return q->fitted && (q->white || is_as_small_as_noise(q));
}

int lab_is_plainly_off(const lab_quality *q)
{
  return !q->fitted || q->chi2 > lab_constant(LAB_NOISE_DOUBTFUL) * q->values;
}

int lab_is_clean(const lab_quality *q)
{
  return q->fitted && q->chi2 < beyond(q, LAB_CLEAN_DEVIATIONS) && !lab_is_strained(q);
}

int lab_is_strained(const lab_quality *q)
{
  return q->strain > lab_constant(LAB_STRAINED);
}

int lab_is_poor(const lab_quality *declared, const lab_quality *q)
{
  return !q->fitted || excess(q) > lab_constant(LAB_MUCH) * excess(declared);
}

/* What bends easily must leave only noise, or at most a share of what another model leaves. */
static int convinces(const lab_quality *with, const lab_quality *other, double share)
{
  return with->fitted && with->bic < other->bic && (lab_is_noise(with) || excess(with) < share * excess(other));
}

/* A free term can bend to nearly anything, and says nothing beyond what it has seen. */
static int term_convinces(const lab_quality *with, const lab_quality *other, double share)
{
  return convinces(with, other, share) && with->bic + lab_constant(LAB_ALIKE_BIC) < other->bic;
}

int lab_onset_convinces(const lab_quality *with, const lab_quality *without)
{
  return convinces(with, without, lab_constant(LAB_ONSET_CONVINCING));
}

/* ---- Rules ---- */

/* Whether declared values within their tolerances explain much of what the values as declared leave. */
static int tolerances_explain_much(const lab_facts *f)
{
  return f->within.fitted && !lab_is_poor(&f->declared, &f->within);
}

static int tolerances_are_better(const lab_facts *f)
{
  return f->within.fitted && f->within.bic < f->best.bic && !lab_is_noise(&f->free_term);
}

static int a_leader_comes_near(const lab_facts *f)
{
  return f->extended.fitted && excess(&f->extended) < lab_constant(LAB_LEADER_NEAR) * excess(&f->declared);
}

/* Values far beyond their tolerances explain nearly anything: they are no reason to look no further where a leader that
 * needs none comes near. */
static int tolerances_beat_the_leaders(const lab_facts *f)
{
  const int may_be_in_vain = lab_is_strained(&f->within) && a_leader_comes_near(f);
  return tolerances_are_better(f) && !may_be_in_vain && f->extended.fitted && f->within.bic < f->extended.bic;
}

static int something_may_begin(const lab_facts *f)
{
  return f->n_found == 0 && f->can_begin;
}

static int an_onset_stands_out(const lab_facts *f)
{
  return something_may_begin(f) && (!f->held || lab_is_noise(&f->best)) &&
         f->begins > lab_constant(LAB_ONSET_CLEAR) * f->throughout;
}

static int no_leader_is_enough(const lab_facts *f)
{
  return something_may_begin(f) && !lab_is_noise(&f->best) && !f->onset.fitted && !a_leader_comes_near(f) &&
         f->begins > lab_constant(LAB_ONSET_SHARE) * f->throughout;
}

/* Where only noise is left, by odds, and if it takes something off that. */
static int an_onset_is_worth_it(const lab_facts *f)
{
  return !lab_is_noise(&f->best) || (f->onset.bic + lab_constant(LAB_ALIKE_BIC) < f->best.bic &&
                                     f->onset.chi2 < pow(1 - lab_constant(LAB_MIN_GAIN), 2) * f->best.chi2);
}

static int an_onset_convinces(const lab_facts *f)
{
  return f->can_begin && an_onset_is_worth_it(f) && lab_onset_convinces(&f->onset, &f->best) &&
         (!f->extended.fitted || lab_onset_convinces(&f->onset, &f->extended));
}

static int no_effect_explains_it(const lab_facts *f)
{
  return !f->has_begun && f->n_found == 0 && !lab_is_noise(&f->best) && !tolerances_explain_much(f) &&
         lab_constant(LAB_TERM_ALONE) * f->effect < f->excess;
}

static int a_term_stands_out(const lab_facts *f)
{
  return f->term > lab_constant(LAB_TERM_MOSTLY) * f->excess && f->term > lab_constant(LAB_TERM_ALONE) * f->effect;
}

static int a_term_comes_near(const lab_facts *f)
{
  return !lab_is_noise(&f->free_term) && term_convinces(&f->free_term, &f->best, lab_constant(LAB_TERM_COMPELLING));
}

static int a_term_needs_tolerances(const lab_facts *f)
{
  return a_term_comes_near(f) && !f->held && f->within.fitted;
}

static int a_term_is_held(const lab_facts *f)
{
  return a_term_comes_near(f) && f->held;
}

/* Few rows tell little: an error that falls by a tenth over fifty of them can be chance. */
static int is_better_by_bic(const lab_facts *f)
{
  return f->extended.fitted && f->extended.bic + lab_constant(LAB_ALIKE_BIC) < f->best.bic;
}

static int onset_needs_tolerances(const lab_facts *f)
{
  return f->has_begun && f->within.fitted && !lab_is_noise(&f->best);
}

static int is_noise_coarsely(const lab_facts *f)
{
  return f->coarse && lab_is_noise(&f->best);
}

static int was_joined(const lab_facts *f)
{
  return f->added && f->n_found > 1;
}

static int may_be_exchanged(const lab_facts *f)
{
  return was_joined(f) && (f->n_found == 2 || lab_is_noise(&f->best));
}

static int leaves_more_than_noise(const lab_facts *f)
{
  return !lab_is_noise(&f->best);
}

static int leaves_what_moves(const lab_facts *f)
{
  return leaves_more_than_noise(f) && !f->best.of_sensors;
}

static int wants_a_term(const lab_facts *f)
{
  return leaves_more_than_noise(f) && !f->free_term.fitted && (f->round > 0 || lab_is_poor(&f->declared, &f->best));
}

static int a_term_is_better(const lab_facts *f)
{
  return leaves_more_than_noise(f) &&
         term_convinces(&f->free_term, &f->best, f->n_found > 1 ? 1 : lab_constant(LAB_TERM_CONVINCING));
}

static int has_room_for_a_term(const lab_facts *f)
{
  return f->n_terms == 0 && f->n_found < LAB_EFFECTS_MAX &&
         (f->n_found == 0 || f->best.chi2 > beyond(&f->best, LAB_REST_DEVIATIONS));
}

/* Where only noise is left, a free term has to bring declared values back within their tolerances. */
static int a_term_beside_convinces(const lab_facts *f)
{
  const int in_vain = lab_is_noise(&f->best) && lab_is_strained(&f->best) && lab_is_strained(&f->extended);
  return !in_vain && term_convinces(&f->extended, &f->best, lab_constant(LAB_TERM_CONVINCING));
}

static int has_found_a_term(const lab_facts *f)
{
  const double most = lab_constant(LAB_TERM_REST) * f->best.values;
  return f->found_term && (lab_is_noise(&f->best) || (!lab_is_strained(&f->best) && f->best.chi2 < most));
}

static int has_a_term_beside_an_onset(const lab_facts *f)
{
  return f->found_term && f->begins_within;
}

static int has_too_many_causes(const lab_facts *f)
{
  return f->in_one_loop && f->n_causes > lab_count(LAB_LOOP_CAUSES);
}

static int has_found(const lab_facts *f)
{
  return f->n_found > 0;
}

static int has_found_nothing(const lab_facts *f)
{
  return f->n_found == 0;
}

const lab_rule lab_rules[] = {
    {LAB_PHASE_SCORED, "Nothing was found, and the logs are one run, of which nothing begins yet.", something_may_begin,
     "Score what may begin within it.", LAB_DO_SCORE_ONSETS},
    {LAB_PHASE_SCORED,
     "Values as declared, or only noise is left: something that may begin scores above ONSET_CLEAR times all that acts "
     "throughout.",
     an_onset_stands_out, "Refit those that do, and find when they begin.", LAB_DO_FIT_CLEAR_ONSET},
    {LAB_PHASE_SCORED,
     "The best of these has a lower BIC, and leaves only noise, or less than ONSET_CONVINCING of the excess; where "
     "only "
     "noise was left, by ALIKE_BIC, and an error that is lower by MIN_GAIN.",
     an_onset_convinces, "Take it in place of the declared model, and score again.", LAB_DO_TAKE_ONSET},
    {LAB_PHASE_SCORED,
     "The declared model leaves more than noise, of which tolerances alone do not explain MUCH, "
     "and TERM_ALONE times the best score is below its excess.",
     no_effect_explains_it, "Score the free terms at once.", LAB_DO_SCORE_TERMS},
    {LAB_PHASE_SCORED, "A free term scores above TERM_MOSTLY of the excess and TERM_ALONE times the best effect.",
     a_term_stands_out, "Refit the declared model with the best one; if that leaves only noise, refit no effect.",
     LAB_DO_FIT_SCORED_TERM},
    {LAB_PHASE_SCORED, "Values as declared: that leaves more than noise, but less than TERM_COMPELLING of the excess.",
     a_term_needs_tolerances, "End: the search goes on from values within their tolerances.", LAB_DO_END},
    {LAB_PHASE_SCORED, "Values within their tolerances: the same.", a_term_is_held,
     "Fit it with all its values; if that leaves only noise, refit no effect.", LAB_DO_UNFOLD_TERM},

    {LAB_PHASE_LED,
     "Values as declared: the declared model within its tolerances has a lower BIC than every refit of a leader, and "
     "no value more than STRAINED tolerances off if such a refit leaves less than LEADER_NEAR of the excess.",
     tolerances_beat_the_leaders, "End: the search goes on from values within their tolerances.", LAB_DO_END},
    {LAB_PHASE_LED,
     "No refit of a leader leaves only noise or less than LEADER_NEAR of the excess, no onset was tried yet, and "
     "something that may begin scores above ONSET_SHARE times all that acts throughout.",
     no_leader_is_enough, "Refit those that do, and find when they begin.", LAB_DO_FIT_ONSET},
    {LAB_PHASE_LED,
     "The best of these has a lower BIC than the declared model and the leaders, and leaves only noise, or less than "
     "ONSET_CONVINCING of their excess.",
     an_onset_convinces, "Take it in place of the declared model, and score again.", LAB_DO_TAKE_ONSET},

    {LAB_PHASE_REFITTED, "The best extension has a BIC lower by ALIKE_BIC than the best model.", is_better_by_bic,
     "Note the effects alike. If the error of some channel falls by MIN_GAIN, or BIC by PLAIN_BIC and white noise is "
     "left, go on from the best BEAM extensions; else list them as small. Without an addition the round is the last.",
     LAB_DO_ADD_EFFECT},

    {LAB_PHASE_ROUND, "The log is seen coarsely, and the best model leaves only noise.", is_noise_coarsely,
     "End: a coarse view does not see fine differences.", LAB_DO_END},
    {LAB_PHASE_ROUND, "Values as declared: what begins was taken, and more than noise is left.", onset_needs_tolerances,
     "End: the search goes on from there, with values within their tolerances.", LAB_DO_END},
    {LAB_PHASE_ROUND,
     "Values as declared: the declared model within its tolerances has a lower BIC than the best model, and no free "
     "term leaves only noise.",
     tolerances_are_better, "End: the search goes on from values within their tolerances.", LAB_DO_END},
    {LAB_PHASE_ROUND, "The round has added an effect to another.", was_joined,
     "Take out each earlier effect without which BIC is no higher.", LAB_DO_REMOVE_NEEDLESS},
    {LAB_PHASE_ROUND, "The same, and there are just two effects or only noise is left.", may_be_exchanged,
     "Exchange each earlier effect for one that has a lower BIC beside the others.", LAB_DO_EXCHANGE},
    {LAB_PHASE_ROUND,
     "More than noise is left, no free term was refitted yet, and it was not the first round or the best model is poor "
     "(MUCH).",
     wants_a_term, "Refit the declared model with the best free term, if its score passes.", LAB_DO_FIT_TERM},

    {LAB_PHASE_END,
     "More than noise is left. The declared model with a free term has a BIC lower by ALIKE_BIC and leaves only noise, "
     "or less than TERM_CONVINCING of the excess; less than the excess where two effects were added.",
     a_term_is_better, "Take it in place of the best model.", LAB_DO_TAKE_TERM},
    {LAB_PHASE_END,
     "The best model has no free term and fewer than EFFECTS effects, and either none or an excess beyond "
     "REST_DEVIATIONS.",
     has_room_for_a_term,
     "Refit it with the best free term beside, if its score passes, unless nothing was found and its errors are white.",
     LAB_DO_FIT_TERM_BESIDE},
    {LAB_PHASE_END,
     "That has a BIC lower by ALIKE_BIC and leaves only noise, or less than TERM_CONVINCING of the excess; and no "
     "declared value STRAINED tolerances off, if the best model has such a one and leaves only noise.",
     a_term_beside_convinces,
     "If the error of some channel falls by MIN_GAIN, add the free term and take out each effect without which BIC is "
     "no "
     "higher; else list the term as small.",
     LAB_DO_ADD_TERM},

    {LAB_PHASE_VERDICT,
     "A free term was added beside something that begins within the run: of two things that are rare one is as "
     "likely to stand in for the other.",
     has_a_term_beside_an_onset, "`undecided`", LAB_VERDICT_UNDECIDED},
    {LAB_PHASE_VERDICT,
     "A free term was added. Only noise is left; or chi-square is less than TERM_REST times its expectation and no "
     "declared value is more than STRAINED tolerances off.",
     has_found_a_term, "`unlisted`", LAB_VERDICT_UNLISTED},
    {LAB_PHASE_VERDICT,
     "More than LOOP_CAUSES effects were added to a single run behind a positioner, errors of sensors apart.",
     has_too_many_causes, "`undecided`", LAB_VERDICT_UNDECIDED},
    {LAB_PHASE_VERDICT, "More than noise is left, and not as much of it at rest as in motion.", leaves_what_moves,
     "`undecided`", LAB_VERDICT_UNDECIDED},
    {LAB_PHASE_VERDICT, "An effect was added.", has_found, "`effect`", LAB_VERDICT_EFFECT},
    {LAB_PHASE_VERDICT, "Nothing was added.", has_found_nothing, "`none`", LAB_VERDICT_NONE},
};

const int lab_rule_count = sizeof lab_rules / sizeof *lab_rules;

int lab_decide_verdict(const lab_facts *f)
{
  int i = 0;
  while (lab_rules[i].phase != LAB_PHASE_VERDICT || !lab_rules[i].holds(f))
    i++;
  return lab_rules[i].action;
}

int lab_needs_the_whole_search(int verdict)
{
  return verdict == LAB_VERDICT_NONE || verdict == LAB_VERDICT_UNLISTED;
}

int lab_values_stand_in(int verdict, double reduced_chi2)
{
  return verdict == LAB_VERDICT_UNDECIDED && !(reduced_chi2 < lab_constant(LAB_NOISE_DOUBTFUL));
}

const char *lab_verdict_text(int verdict)
{
  static const char *const text[] = {"none", "effect", "unlisted", "undecided"};
  return text[verdict];
}
