/* Which searches are made: seen coarsely, of a beginning, of the whole, and without the values that stand alone; and
 * which of their answers is given. */
#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../fit/deviations.h"
#include "../fit/outliers.h"
#include "../rig/tolerance.h"
#include "absent.h"
#include "carry.h"
#include "contest.h"
#include "preview.h"
#include "refill.h"
#include "rivals.h"
#include "slips.h"

/* The whole run: for a leak that a positioner makes up for, coarsely, then row by row.
 * Out:     leaks   whether such a leak is the answer, with what was found beside it
 *          coarse  whether what was seen coarsely is */
static int search_whole(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *leaks,
                        int *coarse, lab_error *error)
{
  int status = LAB_OK;
  if (lab_refill_is_asked(u))
    status = lab_refill_search(u, options, f, leaks, error);
  if (status == LAB_OK && !*leaks)
    status = lab_slips_search(u, options, f, coarse, error);
  return status == LAB_OK && !*leaks && !*coarse ? lab_contest_run(u, 0, options, f, error) : status;
}

void lab_search_options_default(lab_search_options *options)
{
  memset(options, 0, sizeof *options);
  options->alpha = lab_constant(LAB_ALPHA);
  options->min_gain = lab_constant(LAB_MIN_GAIN);
  options->max_effects = LAB_EFFECTS_MAX;
  options->may_begin = 1;
}

void lab_search_list_small(lab_search_result *result, int effect)
{
  int i = 0;
  while (i < result->n_listed && result->listed[i] != effect)
    i++;
  if (i == result->n_listed && i < LAB_SCORES_MAX)
    result->listed[result->n_listed++] = effect;
}

int lab_search_explains(const lab_search_result *result)
{
  return result->verdict == LAB_VERDICT_NONE || result->verdict == LAB_VERDICT_EFFECT;
}

static int has_free_term(const lab_search_result *result)
{
  int i, any = 0;
  for (i = 0; i < result->n_found; i++)
    any |= result->found[i].term >= 0;
  return any;
}

/* Schwarz's criterion of what a search leaves, row by row. */
static double bic_of(const lab_search_result *result)
{
  return result->after.chi2 + result->fit.n * log((double)result->after.n);
}

int lab_search_is_better(const lab_search_result *other, const lab_search_result *first)
{
  const int bends = has_free_term(first) && !has_free_term(other);
  return lab_search_explains(other) || bic_of(other) < (bends ? lab_constant(LAB_NOISE_SLIP) : 1) * bic_of(first);
}

int lab_search_measure(const lab_unknowns *u, enum lab_stage stage, lab_search_result *result, lab_error *error)
{
  const int status = stage == LAB_STAGE_BEFORE ? lab_loop_errors(u, &result->before, error)
                                               : lab_errors_without_drift(u, &result->after, error);
  return status == LAB_OK ? lab_unknowns_residual_stats(u, result->left[stage], error) : status;
}

/* Nothing was found: the best model cannot be simulated as closely as its intervals take, or is no better. */
static void give_up(lab_finding *f, const lab_unknowns *declared)
{
  f->best.u = *declared;
  f->best.n_found = 0;
  f->best.quality = (lab_quality){0};
  f->result.n_path = 1;
  f->result.verdict = LAB_VERDICT_UNDECIDED;
}

/* Take out again what does not carry over to runs that are left out; what is left then is more than noise, as before.
 */
static int take_out_what_harms(lab_finding *f, lab_error *error)
{
  int any, status = lab_carry_prune(&f->best, &any, error);
  if (any) {
    lab_rounds_note_way(&f->result, &f->best);
    f->result.verdict = LAB_VERDICT_UNDECIDED;
  }
  return status;
}

/* Put declared effects that the logs refute to rest. */
static int rest_what_is_absent(lab_finding *f, lab_error *error)
{
  int any, status = lab_absent_find(&f->best, &any, error);
  if (any)
    lab_rounds_note_way(&f->result, &f->best);
  return status;
}

/* Put each effect to the test against those that may stand in its place. */
static int try_rivals(lab_finding *f, lab_error *error)
{
  int changed, status;
  if (f->best.n_found == 0 || (lab_is_plainly_off(&f->best.quality) && !lab_carry_is_asked(&f->best)))
    return LAB_OK;
  status = lab_rivals_try(&f->best, &changed, error);
  if (status == LAB_OK && changed) {
    lab_rounds_note_step(&f->result, &f->best);
    lab_rounds_note_way(&f->result, &f->best);
    f->result.verdict = lab_rounds_verdict(&f->best);
  }
  return status;
}

/* Whether what was found can as well be nothing: its interval reaches the value that has no effect, of what begins
 * that before, or a sensor begins to have an error that any sensor may have. */
static int may_be_nothing(const lab_candidate *c, const lab_fit_result *fit, const lab_found *found)
{
  const int onset = lab_unknowns_find_onset(&c->u, found->param);
  const int j = found->effect < 0 ? -1 : onset >= 0 ? onset : lab_unknowns_find(&c->u, found->param);
  const double nothing = onset >= 0 ? lab_param_value(&c->u.rig, found->param)
                         : j >= 0   ? (double)lab_param_info(found->param).neutral
                                    : 0;
  const double ordinary =
      onset >= 0 && lab_param_is_of_sensor(found->param) ? lab_tolerance(&c->u.rig, found->param) : 0;
  return j >= 0 &&
         ((fit->low[j] <= nothing && nothing <= fit->high[j]) || fabs(c->u.unknown[j].value - nothing) < ordinary);
}

/* Whether a search that was ended has found what can as well be nothing: there was no time to see whether it is needed.
 */
static int is_unproved(const lab_finding *f)
{
  int i, any = 0;
  for (i = 0; i < f->best.n_found; i++)
    any |= may_be_nothing(&f->best, &f->result.fit, &f->best.found[i]);
  return any;
}

/* Take out one effect that can as well be nothing, if only noise is left without it: a switch that comes a row sooner
 * by accident lowers chi-square as much as a small effect does. Where the time is spent, some of what is kept for the
 * end goes to that. In/out:  f  with its intervals */
static int take_out_accident(lab_finding *f, int *any, lab_error *error)
{
  static const double kept = 0.15; /* of the search's time, by judgement */
  const double until = f->best.u.until;
  lab_candidate *without = malloc(sizeof *without);
  int i, out = -1, status = without ? LAB_OK : lab_fail_memory(error, "a candidate");
  f->best.u.until = until > 0 ? until + kept * (until - f->start) : 0;
  for (i = f->best.n_found - 1; status == LAB_OK && out < 0 && i >= 0 && !lab_cpu_is_spent(f->best.u.until); i--)
    if (may_be_nothing(&f->best, &f->result.fit, &f->best.found[i])) {
      status = lab_candidate_leave_out(&f->best, i, without, error);
      out = status == LAB_OK && lab_is_noise(&without->quality) ? i : -1;
    }
  *any = out >= 0;
  if (*any) {
    lab_search_list_small(&f->result, f->best.found[out].effect);
    f->best = *without;
    f->result.verdict = f->best.n_found > 0 ? f->result.verdict : LAB_VERDICT_NONE;
    lab_rounds_note_way(&f->result, &f->best);
  }
  f->best.u.until = until;
  free(without);
  return status;
}

/* Intervals of the model that was found, without what can as well be nothing. */
static int find_intervals(lab_finding *f, lab_error *error)
{
  int again = 1, status = LAB_OK;
  while (status == LAB_OK && again) {
    status = lab_unknowns_intervals(&f->best.u, &f->result.fit, error);
    if (status == LAB_OK)
      status = take_out_accident(f, &again, error);
  }
  return status;
}

/* Intervals and errors of the model that was found; whether the stem moves by jerks beside it, or its values are no
 * answer.
 * Out:     u, result */
static int conclude(lab_finding *f, lab_unknowns *u, lab_search_result *result, lab_error *error)
{
  int status = find_intervals(f, error);
  *u = f->best.u;
  *result = f->result;
  result->n_found = f->best.n_found;
  memcpy(result->found, f->best.found, sizeof result->found);
  memcpy(result->begin, f->best.begin, sizeof result->begin);
  result->cut_short = lab_cpu_is_spent(u->until);
  if (result->cut_short && (lab_needs_the_whole_search(result->verdict) || is_unproved(f)))
    result->verdict = LAB_VERDICT_UNDECIDED;
  if (status == LAB_OK)
    status = lab_deviations_widen(u, &result->fit, error);
  if (status == LAB_OK)
    status = lab_deviations_forget(u, &f->best.quality.chi2, &result->fit, error);
  lab_unknowns_view(u, 0);
  if (status == LAB_OK)
    status = lab_search_measure(u, LAB_STAGE_AFTER, result, error);
  if (status == LAB_OK && result->verdict == LAB_VERDICT_UNDECIDED) {
    size_t window;
    status = lab_unknowns_sticks_and_slips(u, 1, &window, error);
    result->jerks = window > 0;
  }
  if (status == LAB_OK && lab_search_explains(result) && lab_candidate_is_far(u)) {
    result->verdict = LAB_VERDICT_UNDECIDED;
    result->is_far = 1;
  }
  if (status == LAB_OK && result->n_path > 0) {
    result->path[result->n_path - 1].rig = lab_unknowns_expected(u);
    result->path[result->n_path - 1].errors = result->after;
  }
  return status;
}

/* Whether a search that has not explained the logs has ended further from them, row by row, than it began. */
static int is_worse(const lab_search_result *result)
{
  return result->verdict == LAB_VERDICT_UNDECIDED && result->window == 0 && result->after.chi2 > result->before.chi2;
}

int lab_search_run(lab_unknowns *u, const lab_search_options *options, lab_search_result *result, lab_error *error)
{
  lab_finding *f = calloc(1, sizeof *f);
  lab_unknowns *declared = malloc(sizeof *declared);
  lab_candidate *held = calloc(1, sizeof *held);
  double sound_until = 0;
  int early = 0, leaks = 0, coarse = 0, status = f && declared && held ? LAB_OK : lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    *declared = *u;
    f->held = held;
    f->start = lab_cpu_time();
    status = lab_search_measure(u, LAB_STAGE_BEFORE, &f->result, error);
  }
  if (status == LAB_OK && lab_preview_is_asked(u))
    status = lab_preview_search(u, options, f, &early, error);
  if (status == LAB_OK)
    sound_until = f->result.sound_until;
  if (status == LAB_OK && !early)
    status = search_whole(u, options, f, &leaks, &coarse, error);
  if (status == LAB_OK && !coarse)
    status = try_rivals(f, error);
  if (status == LAB_OK && !leaks && !coarse)
    status = take_out_what_harms(f, error);
  if (status == LAB_OK && !coarse)
    status = rest_what_is_absent(f, error);
  if (status == LAB_OK)
    status = conclude(f, u, result, error);
  if (f && f->result.n_path > 0 && (status == LAB_NUMERIC || (status == LAB_OK && is_worse(result)))) {
    give_up(f, declared);
    status = conclude(f, u, result, error);
  }
  if (f && (result->verdict != LAB_VERDICT_UNDECIDED || result->is_far || lab_is_noise(&f->best.quality)))
    sound_until = 0;
  result->sound_until = sound_until;
  free(held);
  free(declared);
  free(f);
  return status;
}

/* ---- Once more without the values that stand alone ---- */

/* What a search makes of a bench. */
typedef struct outcome {
  lab_unknowns declared, completed;
  lab_search_result result;
} outcome;

/* How much there is to explain or to doubt: what is too small to be added, each effect more, a free term more than all
 * of these, and not to know most. */
static int doubt(const lab_search_result *result)
{
  static const int of_verdict[] = {
      [LAB_VERDICT_UNLISTED] = LAB_EFFECTS_MAX, [LAB_VERDICT_UNDECIDED] = 2 * LAB_EFFECTS_MAX + 1};
  return 2 * (of_verdict[result->verdict] + result->n_found) + (result->n_listed > 0 || result->has_small);
}

/* How many declared values an explanation puts far from their sheet. */
static int let_go(const lab_unknowns *declared, const lab_unknowns *u)
{
  int j, n = 0;
  for (j = 0; j < u->n; j++)
    n += lab_param_is_value(u->unknown[j].index) && u->unknown[j].kind == LAB_UNKNOWN_PARAM &&
         !lab_unknown_is_held(&u->unknown[j]) && lab_unknowns_find(declared, u->unknown[j].index) < 0;
  return n;
}

/* Whether the values can be accidents. What an effect does comes back with every change of the command, or with every
 * other one, and may last a row where rows are far between. */
static int can_be_accidents(const lab_outliers *out, const lab_logs *bench)
{
  size_t changes = 0;
  int i;
  for (i = 0; i < bench->n; i++)
    changes += bench->run[i].n_instants;
  return out->n > 0 && (out->n_soon == 0 || (double)out->n_soon < lab_constant(LAB_ACCIDENT_SHARE) * (double)changes);
}

/* Where nothing was missing with these values, nothing is without them: the model is fitted once more.
 * In/out:  o  completed, result  as they were with these values */
static int settle_again(outcome *o, lab_error *error)
{
  lab_finding *f = calloc(1, sizeof *f);
  int status = f ? LAB_OK : lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    f->result = o->result;
    f->best.u = o->completed;
    lab_unknowns_view(&f->best.u, 0);
    status = lab_search_measure(&o->declared, LAB_STAGE_BEFORE, &f->result, error);
  }
  if (status == LAB_OK)
    status = lab_candidate_fit(&f->best, LAB_ROUNDS_ALL, error);
  if (status == LAB_OK)
    status = conclude(f, &o->completed, &o->result, error);
  free(f);
  return status;
}

/* Whether less than what was found cannot explain the logs: it is one effect beside values near their sheet, nothing is
 * in doubt, and values within their tolerances alone are fitted and plainly off. */
static int is_least(const outcome *o, int *least, lab_error *error)
{
  lab_candidate *held = NULL;
  int status = LAB_OK;
  *least =
      o->result.verdict == LAB_VERDICT_EFFECT && doubt(&o->result) == 2 && let_go(&o->declared, &o->completed) == 0;
  if (*least) {
    held = calloc(1, sizeof *held);
    if (!held)
      return lab_fail_memory(error, "the search");
    held->u = o->declared;
    status = lab_candidate_hold(held, error);
    *least = status == LAB_OK && held->quality.fitted && lab_is_plainly_off(&held->quality);
  }
  free(held);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* In/out:  o  completed, result  as they were with these values */
static int run_again(const lab_search_options *options, outcome *o, lab_error *error)
{
  int least, status;
  lab_unknowns_view(&o->declared, 0); /* counts the values that are left */
  if (lab_unknowns_fit(&o->declared, LAB_ROUNDS_ALL, NULL, error))
    return error->status;
  if (doubt(&o->result) == 0)
    return settle_again(o, error);
  status = is_least(o, &least, error);
  if (status != LAB_OK || least)
    return status;
  o->completed = o->declared;
  return lab_search_run(&o->completed, options, &o->result, error);
}

/* Whether an answer without the isolated values is to be taken: it decides, and less is found or in doubt, or as much
 * with fewer declared values far off, or nothing either way. Where more than these values is beyond the model, they may
 * be real. */
static int is_clearer(const outcome *without, const lab_unknowns *completed, const lab_search_result *with)
{
  const int now = doubt(&without->result), before = doubt(with);
  return without->result.verdict != LAB_VERDICT_UNDECIDED &&
         (now < before || now == 0 ||
          (now == before && let_go(&without->declared, &without->completed) < let_go(&without->declared, completed)));
}

int lab_search_without_outliers(const lab_search_options *options, lab_logs *bench, lab_unknowns *declared,
                                lab_unknowns *completed, lab_search_result *result, lab_error *error)
{
  lab_outliers out = {0};
  outcome *o = NULL;
  int status;
  if (result->window > 0 || result->cut_short || (doubt(result) == 0 && completed->rig.n_onsets > 0))
    return LAB_OK; /* a step that is not quite one leaves a few values alone */
  status = lab_outliers_take(lab_values_stand_in(result->verdict, result->fit.reduced_chi2) ? completed : declared,
                             bench->log, &out, error);
  if (status == LAB_OK && can_be_accidents(&out, bench)) {
    o = malloc(sizeof *o);
    status = o ? LAB_OK : lab_fail_memory(error, "a search without outliers");
  }
  if (o) {
    o->declared = *declared;
    o->completed = *completed;
    o->result = *result;
    status = run_again(options, o, error);
  }
  result->cut_short = o && o->result.cut_short;
  if (o && status == LAB_OK && !result->cut_short && is_clearer(o, completed, result)) {
    *declared = o->declared;
    *completed = o->completed;
    *result = o->result;
    lab_limitations_join(&bench->limitations, &out.limitations);
  } else {
    lab_outliers_put_back(&out);
  }
  free(o);
  lab_outliers_free(&out);
  return status == LAB_NUMERIC ? LAB_OK : status;
}
