/* Which searches are made: seen coarsely, from the declared values as they stand, from values within tolerances, and
 * without the values that stand alone; and which of their answers is given. */
#include "search.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../fit/deviations.h"
#include "../fit/nuisance.h"
#include "../fit/outliers.h"
#include "carry.h"
#include "early.h"
#include "rivals.h"
#include "rounds.h"

/* Whether a search has explained the logs. */
static int explains(const lab_finding *f)
{
  return (f->best.n_found > 0 || lab_candidate_begins(&f->best)) && lab_is_noise(&f->best.quality);
}

/* When the first of two searches ends, so that most of the time is left to the other: no rig is just as declared. */
static double share_of_time(double until)
{
  static const double share = 0.35;
  const double now = lab_cpu_time();
  return until > 0 ? now + share * (until - now) : 0;
}

/* The search from the declared values as they stand; what it finds is then fitted with tolerances. */
static int search_exactly(const lab_unknowns *u, const lab_quality *within, const lab_search_options *options,
                          lab_finding *f, lab_error *error)
{
  f->declared.u = *u;
  f->declared.u.until = share_of_time(u->until);
  if (lab_rounds_run(f, NULL, within, options, error))
    return error->status;
  if (!explains(f))
    return LAB_OK;
  f->best.u.until = u->until;
  f->gain = f->best.quality.chi2;
  if (lab_unknowns_hold(&f->best.u, error) || lab_candidate_fit(&f->best, LAB_ROUNDS_ALL, error))
    return error->status;
  f->gain -= f->best.quality.chi2;
  return LAB_OK;
}

/* How many things were found: what begins, and effects that act throughout. */
static int count_causes(const lab_candidate *c)
{
  int i, n = 0;
  for (i = 0; i < c->u.rig.n_onsets; i++)
    n += c->begin[i].known != 0;
  for (i = 0; i < c->n_found; i++)
    n += lab_unknowns_find_onset(&c->u, c->found[i].param) < 0;
  return n;
}

static int has_held(const lab_unknowns *u)
{
  int j, any = 0;
  for (j = 0; j < u->n; j++)
    any |= lab_unknown_is_held(&u->unknown[j]);
  return any;
}

/* Whether a search that explains the logs by what acts or begins needs no deviations beside. Of two such things one may
 * stand for these.
 * In:      tolerant  the declared model within its tolerances */
static int is_enough(const lab_finding *f, const lab_unknowns *tolerant)
{
  const int explained = f->result.verdict == LAB_VERDICT_EFFECT ||
                        (f->result.verdict == LAB_VERDICT_NONE && lab_candidate_begins(&f->best));
  return explained && f->gain < lab_constant(LAB_DEVIATIONS_GAIN) &&
         (count_causes(&f->best) < 2 || !has_held(tolerant));
}

/* Whether of two searches that explain nothing the first is to be told for its candidates. */
static int comes_nearer(const lab_finding *exact, const lab_finding *tolerant)
{
  return exact->best.quality.fitted && exact->result.verdict == LAB_VERDICT_UNDECIDED &&
         tolerant->result.verdict == LAB_VERDICT_UNDECIDED && exact->best.quality.bic < tolerant->best.quality.bic;
}

/* Whether effects beside values as declared are to be told, where there is an answer with deviations: one that names
 * less is the simpler one, and gives way only to odds; one that needs values far beyond their tolerances has odds
 * against it. */
static int is_better(const lab_finding *exact, const lab_finding *tolerant)
{
  const lab_quality *of_exact = &exact->best.quality, *of_tolerant = &tolerant->best.quality;
  const double odds = lab_is_strained(of_tolerant) && !lab_is_strained(of_exact) ? -lab_constant(LAB_ALIKE_BIC)
                      : tolerant->best.n_found < exact->best.n_found && lab_is_noise(of_tolerant)
                          ? lab_constant(LAB_ALIKE_BIC)
                          : 0;
  return of_exact->bic + odds < of_tolerant->bic;
}

/* Whether something that begins is to be told and not what acts throughout, which may show late and is simpler. */
static int is_plainly_later(const lab_finding *early, const lab_finding *throughout)
{
  const double odds = lab_candidate_begins(&throughout->best) ? 0 : lab_constant(LAB_ALIKE_BIC);
  return early->best.quality.bic + odds < throughout->best.quality.bic;
}

/* When to stop where there is an answer already: after four times as long again, and a second; never where time does
 * not count, so that an answer is the same each time. */
static double enough(double until, double start)
{
  const double now = lab_cpu_time();
  return until > 0 ? fmin(until, now + 4 * (now - start) + 1) : 0;
}

/* What a search from exact values says begins, with values within their tolerances.
 * In:      tolerant  the declared model with these, without anything that begins
 * In/out:  c         fitted
 * Out:     begins    whether it convinces
 * Returns: LAB_OK, LAB_WORLD */
static int tolerate_onset(lab_candidate *c, const lab_quality *tolerant, int *begins, lab_error *error)
{
  int status;
  *begins = 0;
  if (!lab_candidate_begins(c) || lab_cpu_is_spent(c->u.until))
    return LAB_OK;
  status = lab_candidate_hold(c, error);
  if (status == LAB_OK)
    status = lab_candidate_place_again(c, error);
  *begins = status == LAB_OK && lab_onset_convinces(&c->quality, tolerant);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* The declared model within its tolerances, or what begins within the logs where that explains them.
 * In:      u       the declared model, fitted
 * In/out:  begun   with the errors of the declared model; then what begins
 * Out:     within  with what is held, fitted; where something begins as u
 *          begins  whether anything does
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD */
static int fit_within(const lab_unknowns *u, const lab_search_options *options, lab_candidate *within,
                      lab_finding *begun, int *begins, lab_error *error)
{
  static const double most = 0.8; /* of the time: if nothing begins the rest has to do */
  const double now = lab_cpu_time();
  const lab_errors *declared = &begun->result.before;
  const lab_quality left = {.fitted = 1, .chi2 = declared->chi2, .values = (double)declared->n};
  int status;
  within->u = *u;
  within->u.until = u->until > 0 ? now + most * (u->until - now) : 0;
  *begins = within->quality.fitted = 0;
  status = lab_unknowns_hold(&within->u, error);
  if (status == LAB_OK && lab_is_plainly_off(&left) && lab_rounds_may_begin(&within->u, options)) {
    status = lab_early_fit(within, options->alpha, &begun->best, &begun->begins, error);
    begun->best.u.until = u->until;
    *begins = status == LAB_OK && begun->best.quality.fitted;
  }
  within->u.until = u->until;
  if (*begins) {
    within->u = *u;
    return lab_candidate_fit(within, 1, error);
  }
  if (status == LAB_OK && !within->quality.fitted)
    status = lab_candidate_fit_held(within, error);
  return status == LAB_OK ? lab_candidate_let_go(within, error) : status;
}

/* A search holds what varies unseen to straight lines. If the declared model, fitted without them, is the better one
 * after all, it was only these that asked for more. */
static void forget_what_was_in_vain(lab_finding *f)
{
  if (f->best.n_found == 0 || !f->declared.quality.fitted || !(f->best.quality.bic > f->declared.quality.bic))
    return;
  f->best = f->declared;
  f->result.n_path = 1;
  f->result.verdict = lab_is_noise(&f->best.quality) ? LAB_VERDICT_NONE : LAB_VERDICT_UNDECIDED;
}

/* When a search ends [s]: what follows it takes about as long as the first fit with tolerances, and a quarter of the
 * search's time is kept for that already (for_search in answer.c).
 * In:      start  [s] when that fit began */
static double before_the_end(double until, double start)
{
  static const double kept = 0.25;
  return until > 0 ? until - fmax(lab_cpu_time() - start - kept * (until - start), 0) : 0;
}

/* The search from values exactly as declared and that from values within their tolerances, side by side. */
typedef struct contest {
  lab_finding exact, early; /* early: what begins where the run leaves the model that explains its beginning */
  int is_exact;             /* whether `exact` is the answer so far */
  int begins;               /* whether something was found to begin */
  double start, until;      /* [s] of CPU time */
} contest;

/* What is found beside values exactly as declared, and whether that explains the logs.
 * In:      u        the declared model, fitted
 * In/out:  tolerant it within its tolerances, fitted */
static int search_beside(const lab_unknowns *u, const lab_search_options *options, contest *c, lab_finding *tolerant,
                         lab_error *error)
{
  lab_candidate *within = &tolerant->best;
  int status = search_exactly(u, c->begins ? &c->early.best.quality : &within->quality, options, &c->exact, error);
  c->is_exact = status == LAB_OK && explains(&c->exact) && !(c->begins && is_plainly_later(&c->early, &c->exact));
  if (c->begins && c->is_exact) {
    c->begins = 0;
    within->u.until = u->until;
    status = lab_candidate_hold(within, error);
    within->u.until = c->until;
    tolerant->declared = *within;
  } else if (c->begins && status != LAB_WORLD) {
    c->exact = c->early;
    status = LAB_OK;
  } else if (status == LAB_OK && !c->is_exact)
    status = tolerate_onset(&c->exact.best, &within->quality, &c->begins, error);
  return status;
}

/* The rounds from values within their tolerances, and whether their answer is the better one. */
static int search_within(const lab_search_options *options, contest *c, lab_finding *tolerant, lab_error *error)
{
  const int begins = c->begins || (c->is_exact && lab_candidate_begins(&c->exact.best));
  int status;
  if (c->is_exact)
    tolerant->declared.u.until = enough(c->until, c->start);
  status = lab_rounds_run(tolerant, begins ? &c->exact : NULL, NULL, options, error);
  if (status == LAB_OK)
    forget_what_was_in_vain(tolerant);
  if (status == LAB_NUMERIC)
    c->is_exact = c->exact.result.n_path > 0 && c->exact.best.quality.fitted;
  else if (c->is_exact)
    c->is_exact = status != LAB_OK || is_better(&c->exact, tolerant);
  else
    c->is_exact = status == LAB_OK && comes_nearer(&c->exact, tolerant);
  return status;
}

/* The search from declared values that are known to tolerances. Where these do not explain the logs by themselves,
 * something may be missing from a rig that is as declared: if one cause explains them and needs no deviations beside,
 * none are looked for; else the better model of the two searches is the answer.
 * In:      u      the declared model, fitted
 * In/out:  whole  with the errors of that; then what is taken for the answer */
static int search_tolerantly(const lab_unknowns *u, const lab_search_options *options, lab_finding *whole,
                             lab_error *error)
{
  contest *c = malloc(sizeof *c);
  lab_candidate *within = &whole->best;
  int status;
  if (!c)
    return lab_fail_memory(error, "the search");
  c->exact = c->early = *whole;
  c->is_exact = c->begins = 0;
  c->start = lab_cpu_time();
  whole->exact = u;
  status = fit_within(u, options, within, &c->early, &c->begins, error);
  c->until = before_the_end(u->until, c->start);
  within->u.until = c->until;
  whole->declared = *within;
  if (status == LAB_OK && (c->begins || !lab_is_noise(&within->quality) || lab_is_strained(&within->quality)))
    status = search_beside(u, options, c, whole, error);
  if (status != LAB_WORLD && !(c->is_exact && is_enough(&c->exact, &whole->declared.u)))
    status = search_within(options, c, whole, error);
  if (c->is_exact) {
    *whole = c->exact;
    status = LAB_OK;
  }
  whole->best.u.until = c->until;
  free(c);
  return status;
}

/* Whether something that acts on the stem or its air was found: an error of a sensor makes no stem stick and slip. */
static int has_found_cause(const lab_candidate *c)
{
  int i, any = 0;
  for (i = 0; i < c->n_found; i++)
    any |= c->found[i].effect >= 0 && !lab_found_is_of_sensor(&c->found[i]);
  return any;
}

/* Whether declared values within tolerances leave only noise, row by row: a valve that is worn or set otherwise is far
 * from its declared model, but need not stick and slip. */
static int try_tolerances(const lab_unknowns *u, lab_candidate *within, int *enough, lab_error *error)
{
  int status;
  within->u = *u;
  status = lab_candidate_hold(within, error);
  *enough = status == LAB_OK && within->quality.fitted && lab_is_noise(&within->quality);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* What was found coarsely, row by row, where that leaves only noise as well: then no slip asked for the coarse view. */
static int see_row_by_row(lab_finding *coarse, lab_error *error)
{
  lab_candidate *rows = malloc(sizeof *rows);
  int status = rows ? LAB_OK : lab_fail_memory(error, "a candidate");
  if (status == LAB_OK) {
    *rows = coarse->best;
    lab_unknowns_view(&rows->u, 0);
    status = lab_candidate_fit(rows, LAB_ROUNDS_ALL, error);
  }
  if (status == LAB_OK && lab_is_noise(&rows->quality)) {
    coarse->best = *rows;
    coarse->result.window = 0;
  }
  free(rows);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* The search seen coarsely, if the log is rough.
 * Out:     done  1 if it found a cause and left only noise; else
 *          f     is as it was */
static int search_coarsely(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                           lab_error *error)
{
  lab_finding *coarse = malloc(sizeof *coarse);
  int status, enough = 0;
  *done = 0;
  if (!coarse)
    return lab_fail_memory(error, "the search");
  *coarse = *f;
  status = lab_unknowns_sticks_and_slips(u, &coarse->result.window, error);
  if (status == LAB_OK && coarse->result.window > 0)
    status = try_tolerances(u, &coarse->best, &enough, error);
  if (status == LAB_OK && coarse->result.window > 0 && !enough) {
    coarse->declared.u = *u;
    lab_unknowns_view(&coarse->declared.u, coarse->result.window);
    status = lab_rounds_run(coarse, NULL, NULL, options, error);
    *done = status == LAB_OK && lab_is_noise(&coarse->best.quality) && has_found_cause(&coarse->best);
  }
  if (*done) {
    status = see_row_by_row(coarse, error);
    *f = *coarse;
  }
  free(coarse);
  return status;
}

void lab_search_options_default(lab_search_options *options)
{
  memset(options, 0, sizeof *options);
  options->alpha = lab_constant(LAB_ALPHA);
  options->min_gain = lab_constant(LAB_MIN_GAIN);
  options->max_effects = LAB_EFFECTS_MAX;
  options->may_begin = 1;
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

/* Whether what was found can as well be nothing: its interval reaches the value that has no effect. */
static int may_be_nothing(const lab_candidate *c, const lab_fit_result *fit, const lab_found *found)
{
  const int j = found->effect >= 0 ? lab_unknowns_find(&c->u, found->param) : -1;
  const double nothing = j >= 0 ? (double)lab_param_info(found->param).neutral : 0;
  return j >= 0 && fit->low[j] <= nothing && nothing <= fit->high[j];
}

/* Take out one effect that can as well be nothing, if only noise is left without it: a switch that comes a row sooner
 * by accident lowers chi-square as much as a small effect does.
 * In/out:  f  with its intervals */
static int take_out_accident(lab_finding *f, int *any, lab_error *error)
{
  lab_candidate *without = malloc(sizeof *without);
  int i, out = -1, status = without ? LAB_OK : lab_fail_memory(error, "a candidate");
  for (i = f->best.n_found - 1; status == LAB_OK && out < 0 && i >= 0 && !lab_cpu_is_spent(f->best.u.until); i--)
    if (may_be_nothing(&f->best, &f->result.fit, &f->best.found[i])) {
      status = lab_candidate_leave_out(&f->best, i, without, error);
      out = status == LAB_OK && lab_is_noise(&without->quality) ? i : -1;
    }
  *any = out >= 0;
  if (*any) {
    if (f->result.n_listed < LAB_SCORES_MAX)
      f->result.listed[f->result.n_listed++] = f->best.found[out].effect;
    f->best = *without;
    f->result.verdict = f->best.n_found > 0 ? f->result.verdict : LAB_VERDICT_NONE;
    lab_rounds_note_way(&f->result, &f->best);
  }
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

/* Intervals and errors of the model that was found.
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
  if (result->cut_short && lab_needs_the_whole_search(result->verdict))
    result->verdict = LAB_VERDICT_UNDECIDED;
  if (status == LAB_OK)
    status = lab_deviations_widen(u, &result->fit, error);
  if (status == LAB_OK)
    status = lab_deviations_forget(u, &f->best.quality.chi2, &result->fit, error);
  lab_unknowns_view(u, 0);
  if (status == LAB_OK)
    status = lab_search_measure(u, LAB_STAGE_AFTER, result, error);
  if (status == LAB_OK && result->n_path > 0) {
    result->path[result->n_path - 1].rig = lab_unknowns_expected(u);
    result->path[result->n_path - 1].errors = result->after;
  }
  return status;
}

/* Whether a search whose time was spent has ended further from the logs, row by row, than it began. */
static int is_worse(const lab_search_result *result)
{
  return result->cut_short && result->window == 0 && result->after.chi2 > result->before.chi2;
}

int lab_search_run(lab_unknowns *u, const lab_search_options *options, lab_search_result *result, lab_error *error)
{
  lab_finding *f = calloc(1, sizeof *f);
  lab_unknowns *declared = malloc(sizeof *declared);
  int done = 0, status = f && declared ? LAB_OK : lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    *declared = *u;
    status = lab_search_measure(u, LAB_STAGE_BEFORE, &f->result, error);
  }
  if (status == LAB_OK)
    status = search_coarsely(u, options, f, &done, error);
  if (status == LAB_OK && !done)
    status = search_tolerantly(u, options, f, error);
  if (status == LAB_OK && !done)
    status = try_rivals(f, error);
  if (status == LAB_OK && !done)
    status = take_out_what_harms(f, error);
  if (status == LAB_OK)
    status = conclude(f, u, result, error);
  if (f && f->result.n_path > 0 && (status == LAB_NUMERIC || (status == LAB_OK && is_worse(result)))) {
    give_up(f, declared);
    status = conclude(f, u, result, error);
  }
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

static int run_again(const lab_search_options *options, outcome *o, lab_error *error)
{
  lab_unknowns_view(&o->declared, 0); /* counts the values that are left */
  if (lab_unknowns_fit(&o->declared, LAB_ROUNDS_ALL, NULL, error))
    return error->status;
  o->completed = o->declared;
  return lab_search_run(&o->completed, options, &o->result, error);
}

/* Whether an answer without the isolated values is to be taken: it decides, and less is found or in doubt, or nothing
 * either way. Where more than these values is beyond the model, they may be real. */
static int is_clearer(const lab_search_result *without, const lab_search_result *with)
{
  return without->verdict != LAB_VERDICT_UNDECIDED && (doubt(without) < doubt(with) || doubt(without) == 0);
}

int lab_search_without_outliers(const lab_search_options *options, lab_logs *bench, lab_unknowns *declared,
                                lab_unknowns *completed, lab_search_result *result, lab_error *error)
{
  lab_outliers out = {0};
  outcome *o = NULL;
  int status;
  if (result->window > 0 || result->cut_short || (doubt(result) == 0 && completed->rig.n_onsets > 0))
    return LAB_OK; /* a step that is not quite one leaves a few values alone */
  status = lab_outliers_take(result->verdict == LAB_VERDICT_UNDECIDED ? completed : declared, bench->log, &out, error);
  if (status == LAB_OK && can_be_accidents(&out, bench)) {
    o = malloc(sizeof *o);
    status = o ? LAB_OK : lab_fail_memory(error, "a search without outliers");
  }
  if (o) {
    o->declared = *declared;
    status = run_again(options, o, error);
  }
  result->cut_short = o && o->result.cut_short;
  if (o && status == LAB_OK && !result->cut_short && is_clearer(&o->result, result)) {
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
