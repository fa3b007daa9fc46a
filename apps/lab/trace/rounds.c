#include "rounds_private.h"

#include <math.h>
#include <stdlib.h>

#include "../base/clock.h"

/* ---- What is noted for the result ---- */

void lab_rounds_progress(const lab_rounds *s, const char *what)
{
  if (s->options->on_progress)
    s->options->on_progress(s->options->context, what);
}

void lab_rounds_note_step(lab_search_result *result, const lab_candidate *c)
{
  lab_tried_model *step = result->n_steps < LAB_SEARCH_STEPS ? &result->step[result->n_steps++] : NULL;
  if (!step)
    return;
  lab_candidate_name(c, step->name, sizeof step->name);
  step->chi2 = c->quality.chi2;
  step->bic = c->quality.bic;
}

void lab_rounds_note_way(lab_search_result *result, const lab_candidate *c)
{
  lab_error ignored;
  lab_unknowns u = c->u;
  lab_path_model *way;
  result->n_path -= result->n_path == LAB_SEARCH_PATH; /* the last is the one that the search ends with */
  way = &result->path[result->n_path++];
  lab_candidate_name(c, way->name, sizeof way->name);
  way->chi2 = c->quality.chi2;
  way->bic = c->quality.bic;
  if (c->u.nuisance)
    lab_nuisance_return(&u, &ignored);
  lab_rounds_note_values(result, &u);
}

void lab_rounds_note_values(lab_search_result *result, const lab_unknowns *u)
{
  lab_path_model *way = &result->path[result->n_path - 1];
  lab_error ignored;
  int c;
  way->rig = lab_unknowns_expected(u);
  if (lab_loop_errors(u, &way->errors, &ignored))
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      way->errors.rmse[c] = way->errors.in_noise[c] = (double)NAN;
}

void lab_rounds_note_small(lab_search_result *result, const pneu_term *term)
{
  result->small = *term;
  result->has_small = 1;
}

/* ---- Rules ---- */

int lab_rounds_may_begin(const lab_unknowns *u, const lab_search_options *options)
{
  return options->may_begin && u->n_runs == 1 && u->window == 0 && u->rig.n_onsets == 0;
}

static lab_facts facts_of_best(const lab_candidate *best)
{
  lab_facts f = {0};
  int i;
  f.best = best->quality;
  f.n_found = best->n_found;
  f.n_terms = best->u.rig.n_terms;
  f.begins_within = lab_candidate_begins(best);
  f.in_one_loop = best->u.n_runs == 1 && lab_rig_has_positioner(&best->u.rig);
  for (i = 0; i < best->n_found; i++) {
    f.found_term |= best->found[i].term >= 0;
    f.n_causes += best->found[i].effect >= 0 && !lab_found_is_of_sensor(&best->found[i]);
  }
  return f;
}

static lab_facts facts_of(const lab_rounds *s)
{
  const lab_candidate *best = &s->beam[0];
  lab_facts f = facts_of_best(best);
  int i;
  f.round = s->round;
  f.coarse = best->u.window > 0;
  f.added = s->added;
  f.has_begun = s->has_begun;
  f.held = lab_rounds_has_held(s);
  f.declared = s->declared.quality;
  if (s->within)
    f.within = *s->within;
  f.can_begin = lab_rounds_may_begin(&best->u, s->options);
  f.onset = s->onset.quality;
  f.free_term = s->free_term.quality;
  if (s->has_extended)
    f.extended = s->pool[0].quality;
  for (i = 0; i < s->n_leaders; i++)
    if (s->leaders[i].quality.fitted && (!f.extended.fitted || s->leaders[i].quality.bic < f.extended.bic))
      f.extended = s->leaders[i].quality;
  f.begins = s->begins.n > 0 ? s->begins.of[0].statistic : 0;
  f.throughout = fmax(s->begins.throughout, s->best_effect);
  f.excess = s->projection ? s->projection->excess : 0;
  f.effect = s->best_effect;
  f.term = s->n_terms > 0 ? s->term[0].statistic : 0;
  return f;
}

int lab_rounds_verdict(const lab_candidate *best)
{
  const lab_facts f = facts_of_best(best);
  return lab_decide_verdict(&f);
}

static int act(lab_rounds *s, int action, lab_error *error)
{
  switch (action) {
  case LAB_DO_SCORE_ONSETS:
    return lab_onset_scores_find(s->projection, 0, s->beam[0].u.run->n, &s->begins, error);
  case LAB_DO_FIT_CLEAR_ONSET:
    return lab_rounds_fit_onset(s, LAB_ONSET_CLEAR, error);
  case LAB_DO_FIT_ONSET:
    return lab_rounds_fit_onset(s, LAB_ONSET_SHARE, error);
  case LAB_DO_TAKE_ONSET:
    lab_rounds_take_onset(s);
    break;
  case LAB_DO_SCORE_TERMS:
    return lab_score_free_terms(s->projection, s->term, &s->n_terms, error);
  case LAB_DO_FIT_SCORED_TERM:
    if (!s->declared.quality.fitted)
      break;
    return lab_rounds_refit_terms(s, &s->declared, &s->free_term, error);
  case LAB_DO_UNFOLD_TERM:
    return lab_rounds_unfold_term(s, error);
  case LAB_DO_FIT_TERM:
    if (!s->declared.quality.fitted)
      break;
    return lab_rounds_find_term(s, &s->declared, &s->free_term, error);
  case LAB_DO_FIT_TERM_BESIDE:
    return lab_rounds_find_term_beside(s, error);
  case LAB_DO_ADD_EFFECT:
    return lab_rounds_add_effect(s, error);
  case LAB_DO_ADD_TERM:
    return lab_rounds_add_term(s, error);
  case LAB_DO_REMOVE_NEEDLESS:
    return lab_rounds_remove_needless(s, error);
  case LAB_DO_EXCHANGE:
    return lab_rounds_exchange(s, error);
  case LAB_DO_TAKE_TERM:
    lab_rounds_take_term(s);
    break;
  case LAB_DO_END:
    s->over = 1;
    break;
  }
  return LAB_OK;
}

int lab_rounds_follow(lab_rounds *s, enum lab_phase phase, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; status == LAB_OK && i < lab_rule_count && !s->over; i++) {
    const lab_facts f = facts_of(s);
    if (lab_rules[i].phase == phase && lab_rules[i].holds(&f))
      status = act(s, lab_rules[i].action, error);
  }
  return status;
}

/* ---- The search ---- */

/* Whether there is room for one more; what begins may have come with others. */
static int has_room(const lab_rounds *s)
{
  return s->round < s->options->max_effects && s->beam[0].n_found < s->options->max_effects;
}

/* Whether what begins was found with values as declared and leaves more than noise: the search goes on from there. */
static int needs_tolerances(const lab_rounds *s)
{
  return s->within && !lab_is_noise(&s->beam[0].quality);
}

static int search_all(lab_rounds *s, lab_error *error)
{
  for (s->round = 0, s->added = 1; s->added && !s->is_final && has_room(s); s->round++) {
    double chi2;
    if (lab_rounds_advance(s, error))
      return error->status;
    if (s->added && s->nuisance.n > 0 && lab_rounds_linearise_again(s, error))
      return error->status;
    if (s->has_begun && !needs_tolerances(s) && lab_rounds_try_instead(s, error))
      return error->status;
    chi2 = s->beam[0].quality.chi2;
    if (lab_rounds_follow(s, LAB_PHASE_ROUND, error))
      return error->status;
    if (s->over)
      return LAB_OK;
    if (s->beam[0].quality.chi2 != chi2)
      lab_rounds_note_way(s->result, &s->beam[0]);
  }
  return lab_rounds_follow(s, LAB_PHASE_END, error);
}

/* From the declared model, fitted. */
static int begin(lab_rounds *s, lab_error *error)
{
  if (lab_candidate_fit(&s->declared, LAB_ROUNDS_ALL, error))
    return error->status;
  lab_rounds_note_way(s->result, &s->declared);
  if (lab_rounds_linearise(s, error))
    return error->status;
  s->beam[0] = s->declared;
  s->n_beam = 1;
  lab_rounds_note_step(s->result, &s->declared);
  return LAB_OK;
}

/* What is missing is known, or a part of it. Where something begins, it may be another thing that begins then. */
static int go_on_from(lab_rounds *s, const lab_candidate *begun, const lab_onset_scores *begins, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  int status;
  lab_rounds_note_way(s->result, &s->declared);
  lab_rounds_note_step(s->result, &s->declared);
  s->declared.quality.fitted = 0;
  s->n_beam = 1;
  *best = *begun;
  s->begins = *begins;
  best->u.until = s->declared.u.until;
  if (!best->quality.fitted)
    return lab_fail(error, LAB_NUMERIC, "what is known to be missing cannot be fitted within tolerances");
  if (best->n_found > 0)
    lab_candidate_explain(best, s->declared.quality.chi2);
  lab_rounds_note_step(s->result, best);
  lab_rounds_note_way(s->result, best);
  status = lab_rounds_linearise_again(s, error);
  return status == LAB_OK && lab_candidate_begins(best) ? lab_rounds_try_instead(s, error) : status;
}

/* Whether tolerances alone were found to be better than anything that could be added. */
static int is_given_up(const lab_rounds *s)
{
  return s->over && s->within && s->within->fitted && s->beam[0].n_found == 0 && !s->has_begun &&
         s->within->bic < s->beam[0].quality.bic;
}

/* Nothing was found. */
static int give_back(const lab_rounds *s, lab_finding *f)
{
  f->best = f->declared;
  f->best.quality = s->declared.quality;
  f->result.verdict = LAB_VERDICT_UNDECIDED;
  return LAB_OK;
}

/* Where only noise is left, an instrument, or the vent, may all the same be further off than one can be. */
static int take_instruments(lab_rounds *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  int any, status;
  if (!lab_is_noise(&best->quality) || lab_cpu_is_spent(s->declared.u.until))
    return LAB_OK;
  s->without = *best;
  status = lab_candidate_take_instruments(best, &any, error);
  if (status == LAB_OK && any)
    lab_rounds_note_way(s->result, best);
  if (status != LAB_OK)
    *best = s->without;
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Where the time is spent, of the rules at the end those hold that ask for no more fits. */
static int end_early(lab_rounds *s, lab_error *error)
{
  const int status = lab_rounds_follow(s, LAB_PHASE_END, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* The best model, fitted with all that varies. */
static int end_with(lab_rounds *s, lab_finding *f, lab_error *error)
{
  if (lab_rounds_unfold(s, error))
    return error->status;
  if (!lab_cpu_is_spent(f->declared.u.until) && lab_candidate_place_again(&s->beam[0], error))
    return error->status;
  if (take_instruments(s, error))
    return error->status;
  lab_candidate_drop_neutral(&s->beam[0]);
  f->best = s->beam[0];
  f->result.verdict = lab_rounds_verdict(&f->best);
  return LAB_OK;
}

int lab_rounds_run(lab_finding *f, const lab_finding *begun, const lab_quality *within,
                   const lab_search_options *options, lab_error *error)
{
  lab_rounds *s = calloc(1, sizeof *s);
  int status;
  if (!s)
    return lab_fail_memory(error, "the search");
  s->options = options;
  s->result = &f->result;
  s->start = f->start;
  s->within = within;
  s->declared = f->declared;
  s->unfolding.nuisance = &s->nuisance;
  s->unfolding.exact = f->exact;
  s->unfolding.until = f->declared.u.until;
  status = begun ? go_on_from(s, &begun->best, &begun->begins, error) : begin(s, error);
  if (status == LAB_OK)
    status = search_all(s, error);
  if (status == LAB_NUMERIC && lab_cpu_is_spent(f->declared.u.until) && s->beam[0].quality.fitted)
    status = end_early(s, error);
  if (status == LAB_OK)
    status = is_given_up(s) ? give_back(s, f) : end_with(s, f, error);
  f->begins = s->begins;
  lab_nuisance_close(&s->nuisance);
  free(s);
  return status;
}
