#include "early.h"

#include <stdlib.h>

#include "../fit/beginning.h"
#include "../fit/nuisance.h"
#include "departure.h"
#include "onset_sizes.h"
#include "refill.h"

enum { SHOWS = 16 }; /* what begins shows within one such part of the run: by judgement */

/* Keep the values that all runs share as they are; what a run has for itself, the instants of its commands, still
 * varies. */
static void freeze(lab_unknowns *u)
{
  int j, n = 0;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].run != LAB_ALL_RUNS)
      u->unknown[n++] = u->unknown[j];
  u->n = n;
  lab_unknowns_count(u);
}

/* Fit all values beside what begins, in a closed loop first to a part of what follows: there the values may be known by
 * what the run had not done before. */
static int fit_beside(lab_candidate *c, size_t after, lab_error *error)
{
  static const double share = 0.25; /* of the rest, by judgement */
  const size_t rest = c->u.run->n - after;
  const int loops = lab_refill_loops(&c->u);
  if (loops && c->u.rig.onset[c->u.rig.n_onsets - 1].param == pneu_param_find("leak_area"))
    return lab_refill_fit(c, error);
  if (loops && lab_candidate_fit_beginning(c, after + (size_t)(share * (double)rest), LAB_STEPS_ONWARD, error))
    return error->status;
  return lab_candidate_fit_held(c, error);
}

/* What begins in a frozen model, put into the one whose values vary, and fitted beside them.
 * In/out:  c  frozen; then fitted or not */
static int thaw(const lab_candidate *base, const size_t between[2], lab_candidate *c, lab_error *error)
{
  const lab_rig_onset begins = c->u.rig.onset[c->u.rig.n_onsets - 1];
  const lab_run *x = base->u.run;
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  const size_t after = between[1] < x->n ? between[1] : x->n - 1;
  c->u = base->u;
  c->quality.fitted = 0;
  if (lab_unknowns_add_onset(&c->u, begins.param, begins.from, begins.value, error))
    return LAB_OK; /* no room */
  c->begin[c->u.rig.n_onsets - 1] = (lab_onset){1, begins.from, t[between[0]], t[after]};
  if (fit_beside(c, after, error))
    return error->status;
  return c->quality.fitted ? lab_candidate_place_again(c, error) : LAB_OK;
}

/* The row from which what begins may act, before it shows. */
static size_t earliest(const lab_run *x, size_t sound)
{
  const size_t late = x->n / SHOWS;
  return sound > late ? sound - late : 0;
}

/* What may begin between two rows, by score, while all else is as the beginning has it.
 * In:      frozen
 *          row     at which it is fitted first
 * Out:     c  as of lab_refit_onsets_at */
static int refit_frozen(const lab_candidate *frozen, const size_t between[2], size_t row, double alpha,
                        lab_onset_scores *begins, lab_candidate *c, int *n, lab_error *error)
{
  const lab_run *x = frozen->u.run;
  lab_unknowns u = frozen->u;
  lab_projection p;
  int i, status = lab_projection_open(&u, &p, error);
  if (status == LAB_OK)
    status = lab_onset_scores_find(&p, earliest(x, between[0]), between[1] < x->n ? between[1] : x->n, begins, error);
  lab_projection_close(&p);
  for (i = 0; i < begins->n && status == LAB_OK; i++)
    begins->of[i].onset = row;
  return status == LAB_OK ? lab_refit_onsets_at(frozen, begins, lab_onset_scores_level(begins, alpha), c, n, error)
                          : status;
}

/* Whether a frozen model with what begins comes near enough to be fitted with all values, or takes off most of what is
 * left without that, where this is known. */
static int comes_near(const lab_quality *without, const lab_quality *q)
{
  static const double most = 0.25; /* by judgement */
  return q->chi2 < lab_constant(LAB_EARLY_NEAR) * q->values ||
         q->chi2 - q->values < most * (without->chi2 - without->values);
}

/* The first of n frozen models, best first, that leaves only noise with all its values; else one that does not.
 * In:      without  what is left where nothing begins; chi2 0: not known */
static int thaw_best(const lab_candidate *base, const size_t between[2], const lab_quality *without, lab_candidate *c,
                     int n, lab_candidate *onset, lab_error *error)
{
  const double reach = n > 0 ? lab_constant(LAB_RIVAL) * c[0].quality.chi2 : 0;
  int i, status = LAB_OK;
  for (i = 0; status == LAB_OK && !lab_is_noise(&onset->quality) && i < n && i < lab_count(LAB_ONSET_FINALISTS); i++) {
    const lab_quality *q = &c[i].quality;
    if (!q->fitted || !(q->chi2 < reach) || !comes_near(without, q))
      break;
    status = thaw(base, between, &c[i], error);
    *onset = c[i];
  }
  return status;
}

/* Whether what comes nearest, acting from the first row, leaves only noise of the run, and less than it does from its
 * row on: then it is not what begins. */
static int acts_throughout(const lab_candidate *base, const lab_candidate *nearest, int *throughout, lab_error *error)
{
  const lab_found last =
      nearest->n_found > base->n_found ? nearest->found[nearest->n_found - 1] : (lab_found){.effect = -1};
  const lab_score score = {.effect = last.effect, .param = last.param, .shape = -1};
  const double value = nearest->u.rig.onset[nearest->u.rig.n_onsets - 1].value;
  lab_candidate *c;
  int status = LAB_OK;
  *throughout = 0;
  if (last.effect < 0)
    return LAB_OK;
  c = malloc(sizeof *c);
  if (!c)
    return lab_fail_memory(error, "what acts throughout");
  *c = *base;
  c->quality.fitted = 0;
  if (lab_candidate_add_effect(c, &score, value - (double)lab_param_info(last.param).neutral, error) == LAB_OK)
    status = lab_candidate_fit_held(c, error);
  *throughout = lab_is_noise(&c->quality) && c->quality.chi2 < nearest->quality.chi2;
  free(c);
  return status;
}

/* What may begin between two rows, by all that the run has after them; none if that acts throughout.
 * In:      base  whose values vary */
static int refit_open(const lab_candidate *base, lab_candidate *frozen, const size_t between[2], size_t row,
                      double alpha, lab_onset_scores *begins, lab_candidate *c, int *n, lab_error *error)
{
  lab_nuisance instants = {0};
  int throughout = 0, status = lab_nuisance_open(&frozen->u, &instants, error);
  if (status == LAB_OK)
    status = refit_frozen(frozen, between, row, alpha, begins, c, n, error);
  if (status == LAB_OK && *n > 0 && c[0].quality.fitted)
    status = acts_throughout(base, &c[0], &throughout, error);
  if (throughout)
    *n = 0;
  if (status == LAB_OK)
    status = lab_refit_place_onsets(c, *n, error);
  lab_nuisance_close(&instants);
  return status;
}

/* The same in a closed loop, by what comes next: later a change of a wrong size, or at a wrong time, falls out of step.
 * Each look is dear there: only what is fitted with all values is placed. */
static int refit_loop(lab_candidate *frozen, const size_t between[2], size_t row, double alpha,
                      lab_onset_scores *begins, lab_candidate *c, int *n, lab_error *error)
{
  static const double share = 0.12; /* of the rest, by judgement */
  const lab_run *x = frozen->u.run;
  const size_t end = between[1] < x->n ? between[1] + (size_t)(share * (double)(x->n - between[1])) : x->n;
  lab_run part = {0};
  int status = lab_beginning_open(x, end, &part, error);
  if (status == LAB_OK) {
    frozen->u.n = 0;
    frozen->u.run = &part;
    lab_unknowns_view(&frozen->u, 0);
    status = lab_onset_sizes_find(frozen, earliest(x, between[0]), row, begins, error);
    if (status == LAB_OK && lab_refill_is_asked(&frozen->u))
      status = lab_refill_score(frozen, between[0], begins, error);
    if (status == LAB_OK)
      status = lab_refit_onsets_at(frozen, begins, lab_onset_scores_level(begins, alpha), c, n, error);
    lab_refit_put_simplest_first(c, *n);
  }
  lab_beginning_close(&part);
  return status;
}

/* Find what begins with the values of the beginning, then fit it beside them. */
static int fit_onset(const lab_candidate *base, const size_t between[2], double alpha, lab_candidate *onset,
                     lab_onset_scores *begins, lab_error *error)
{
  lab_candidate *frozen = malloc(sizeof *frozen), *c = malloc((size_t)lab_count(LAB_ONSET_LEADERS) * sizeof *c);
  size_t row;
  int n = 0, status = frozen && c ? lab_departure_row(base, between[0], &row, error) : lab_fail_memory(error, "refits");
  if (status == LAB_OK) {
    *frozen = *base;
    freeze(&frozen->u);
    frozen->quality.chi2 = 0;
    row = between[0] < row && row < between[1] ? row : between[0];
    status = lab_refill_loops(&base->u) ? refit_loop(frozen, between, row, alpha, begins, c, &n, error)
                                        : refit_open(base, frozen, between, row, alpha, begins, c, &n, error);
  }
  if (status == LAB_OK)
    status = thaw_best(base, between, &frozen->quality, c, n, onset, error);
  free(frozen);
  free(c);
  return status;
}

/* Whether something begins after the first row, beyond doubt: what acts throughout may have bent the values of a
 * beginning that shows little of it. */
static int begins_later(const lab_candidate *onset, double alpha, int *later, lab_error *error)
{
  const lab_run *x = onset->u.run;
  lab_unknowns *u = malloc(sizeof *u);
  lab_onset begin = onset->begin[0];
  double chi2 = onset->quality.chi2;
  int status = u ? LAB_OK : lab_fail_memory(error, "what begins");
  *later = lab_is_noise(&onset->quality) && lab_candidate_begins(onset) &&
           begin.low > x->log->value[LAB_CHANNEL_TIME][x->first];
  if (status == LAB_OK && *later && onset->n_found > 0) { /* values vary from the first row in any case */
    *u = onset->u;
    status = lab_onset_extend(u, lab_unknowns_find_onset(u, u->rig.onset[0].param), alpha, &chi2, &begin, error);
    *later = begin.known;
  }
  free(u);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

int lab_early_fit(lab_candidate *within, size_t rows, double alpha, lab_candidate *onset, lab_onset_scores *begins,
                  size_t *sound, lab_error *error)
{
  const size_t n = within->u.run->n;
  lab_candidate *c = malloc(sizeof *c);
  size_t between[2] = {0, 0};
  int later = 0, status = c ? LAB_OK : lab_fail_memory(error, "the beginning of a run");
  onset->quality.fitted = 0;
  if (status == LAB_OK) {
    *c = *within;
    if (rows == 0)
      lab_unknowns_undo_fit(&c->u);
    status = lab_departure_find(c, rows, between, error);
  }
  if (status == LAB_OK && between[0] == n)
    *within = *c;
  else if (status == LAB_OK && between[0] > 0)
    status = fit_onset(c, between, alpha, onset, begins, error);
  *sound = between[0];
  if (status == LAB_OK && onset->quality.fitted)
    status = begins_later(onset, alpha, &later, error);
  onset->quality.fitted &= status == LAB_OK && later;
  if (!onset->quality.fitted && c) {
    *onset = *c;
    onset->quality.fitted = 0;
  }
  free(c);
  return status == LAB_NUMERIC ? LAB_OK : status;
}
