/* Refits of what begins within the run. */
#include "refit_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../fit/nuisance.h"

/* The time of a row of the only run [s]. */
static double time_of(const lab_candidate *c, size_t row)
{
  return c->u.run[0].log->value[LAB_CHANNEL_TIME][c->u.run[0].first + row];
}

/* The model in which one thing begins at some time, after some steps. */
static void begin_onset(const lab_candidate *base, const lab_score *score, double from, int steps, lab_candidate *c,
                        lab_error *all)
{
  const double now = lab_param_value(&base->u.rig, score->param);
  lab_error ignored;
  *c = *base;
  c->quality.fitted = 0;
  if (lab_unknowns_add_onset(&c->u, score->param, from, now + score->size, &ignored))
    return; /* no room */
  if (lab_refit_one(c, steps, all) || score->effect < 0)
    return;
  lab_candidate_add_found(c);
  c->found[c->n_found - 1].effect = score->effect;
  c->found[c->n_found - 1].param = score->param;
  c->found[c->n_found - 1].statistic = score->statistic;
  c->found[c->n_found - 1].p_value = score->p_value;
}

/* Fit the instants of commands again, where they are all that varies unseen: about another model they bend otherwise.
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD */
static int unfold_instants(lab_unknowns *u, lab_error *error)
{
  return u->nuisance && lab_nuisance_is_instants(u->nuisance) ? lab_nuisance_return(u, error) : LAB_OK;
}

/* Find when it begins. */
static void end_onset(lab_candidate *c, double level, lab_error *all)
{
  const int j = c->u.n - 1;
  lab_onset *begin = &c->begin[c->u.rig.n_onsets - 1];
  lab_error error;
  double chi2;
  int status = unfold_instants(&c->u, &error);
  if (status == LAB_OK)
    status = lab_unknowns_fit(&c->u, lab_count(LAB_BRIEF_STEPS), &chi2, &error);
  if (status == LAB_OK)
    status = lab_onset_find(&c->u, j, level, &chi2, begin, &error);
  if (status == LAB_OK && begin->known) {
    c->u.unknown[j].first = c->u.unknown[j].value;
    lab_refit_one(c, LAB_ROUNDS_ALL, all);
    return;
  }
  c->quality.fitted = 0;
  if (status != LAB_OK)
    lab_fail_together(all, &error);
}

/* The same from the best of a few places all over the run: a fit that has been bent far sees only what is near.
 * In/out:  c  fitted or not; the better of both */
static void start_elsewhere(const lab_candidate *base, const lab_score *score, double level, lab_candidate *c,
                            lab_error *all)
{
  lab_candidate *mine = malloc((LAB_ONSET_PLACES - 1) * sizeof *mine);
  int i;
  if (!mine) {
    lab_fail_memory(all, "refits");
    return;
  }
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < LAB_ONSET_PLACES - 1; i++)
    begin_onset(base, score, time_of(base, base->u.run[0].n * (size_t)(i + 1) / LAB_ONSET_PLACES),
                lab_count(LAB_FIRST_STEPS), &mine[i], all);
  qsort(mine, LAB_ONSET_PLACES - 1, sizeof *mine, lab_candidate_by_bic);
  if (mine[0].quality.fitted)
    end_onset(&mine[0], level, all);
  if (lab_candidate_by_bic(&mine[0], c) < 0)
    *c = mine[0];
  free(mine);
}

/* The score of what begins in a candidate; NULL: nothing does. */
static const lab_score *score_of(const lab_onset_scores *scores, const lab_candidate *c)
{
  int i = 0, k = c->u.rig.n_onsets - 1;
  while (k >= 0 && i < scores->n && scores->of[i].param != c->u.rig.onset[k].param)
    i++;
  return k >= 0 && i < scores->n ? &scores->of[i] : NULL;
}

/* Fit leaders briefly.  Out: c, best first  Returns: how many are to be fitted to the end */
static int start_leaders(const lab_candidate *base, const lab_score *score, int n, lab_candidate *c, lab_error *error)
{
  int i, last = 0;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    begin_onset(base, &score[i], time_of(base, score[i].onset), lab_count(LAB_BRIEF_STEPS), &c[i], error);
  qsort(c, (size_t)n, sizeof *c, lab_candidate_by_bic);
  while (last < n && last < lab_count(LAB_ONSET_FINALISTS) && c[last].quality.fitted)
    last++;
  return last;
}

/* Find when each begins, and where that leaves more than noise but not much, from elsewhere. */
static void end_onsets(const lab_candidate *base, const lab_onset_scores *scores, double level, lab_candidate *c, int n,
                       lab_error *error)
{
  int i;
  for (i = 0; i < n && (i == 0 || !lab_is_noise(&c[i - 1].quality)); i++)
    end_onset(&c[i], level, error);
  n = i;
  qsort(c, (size_t)n, sizeof *c, lab_candidate_by_bic);
  if (n == 0 || lab_is_noise(&c[0].quality) || lab_is_poor(&base->quality, &c[0].quality))
    return;
  for (i = 0; i < n; i++)
    if (score_of(scores, &c[i]))
      start_elsewhere(base, score_of(scores, &c[i]), level, &c[i], error);
  qsort(c, (size_t)n, sizeof *c, lab_candidate_by_bic);
}

int lab_refit_onset(const lab_candidate *base, const lab_onset_scores *scores, double level, double bar,
                    lab_candidate *best, lab_error *error)
{
  const int most = lab_count(LAB_ONSET_LEADERS);
  lab_candidate *c = malloc((size_t)most * sizeof *c);
  int n = 0;
  best->quality.fitted = 0;
  if (!c)
    return lab_fail_memory(error, "refits");
  error->status = LAB_OK;
  while (n < most && n < scores->n && scores->of[n].p_value < level && scores->of[n].statistic > bar)
    n++;
  n = start_leaders(base, scores->of, n, c, error);
  end_onsets(base, scores, level, c, n, error);
  if (n > 0)
    *best = c[0];
  if (best->quality.fitted && best->n_found > base->n_found)
    lab_candidate_explain(best, base->quality.chi2);
  free(c);
  return error->status;
}

/* What begins last in a candidate. */
static int last_onset(const lab_candidate *c)
{
  return c->u.rig.onset[c->u.rig.n_onsets - 1].param;
}

/* Find when near its time it begins. */
static void place_near(lab_candidate *c, lab_error *all)
{
  lab_error error;
  const double before = c->quality.chi2;
  const int status = lab_onset_settle(&c->u, c->u.n - 1, 0, &c->quality.chi2, &c->begin[c->u.rig.n_onsets - 1], &error);
  c->quality.bic += c->quality.chi2 - before;
  c->quality.fitted = status == LAB_OK;
  if (status != LAB_OK)
    lab_fail_together(all, &error);
}

int lab_refit_is_simpler(const lab_candidate *a, const lab_candidate *b)
{
  int value_a, value_b;
  if (!a->quality.fitted || !b->quality.fitted)
    return a->quality.fitted;
  value_a = pneu_effect_of(last_onset(a)) < 0;
  value_b = pneu_effect_of(last_onset(b)) < 0;
  return a->quality.bic < b->quality.bic + (value_a - value_b) * lab_constant(LAB_ALIKE_BIC);
}

void lab_refit_put_simplest_first(lab_candidate *c, int n)
{
  int i;
  for (i = 1; i < n; i++)
    if (lab_refit_is_simpler(&c[i], &c[0])) {
      const lab_candidate simplest = c[i];
      memmove(c + 1, c, (size_t)i * sizeof *c);
      c[0] = simplest;
    }
}

int lab_refit_onsets_at(const lab_candidate *base, const lab_onset_scores *scores, double level, lab_candidate *c,
                        int *n, lab_error *error)
{
  const int most = lab_count(LAB_ONSET_LEADERS);
  int i;
  error->status = LAB_OK;
  *n = 0;
  while (*n < most && *n < scores->n && scores->of[*n].p_value < level)
    ++*n;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < *n; i++)
    begin_onset(base, &scores->of[i], time_of(base, scores->of[i].onset), lab_count(LAB_BRIEF_STEPS), &c[i], error);
  qsort(c, (size_t)*n, sizeof *c, lab_candidate_by_bic);
  return error->status;
}

int lab_refit_place_onsets(lab_candidate *c, int n, lab_error *error)
{
  const double reach = lab_constant(LAB_RIVAL) * lab_least_chi2(c, n);
  int i;
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    if (c[i].quality.fitted && (i < lab_count(LAB_ONSET_FINALISTS) || c[i].quality.chi2 <= reach))
      place_near(&c[i], error);
  qsort(c, (size_t)n, sizeof *c, lab_candidate_by_bic);
  lab_refit_put_simplest_first(c, n);
  return error->status;
}

int lab_refit_instead(const lab_candidate *c, const lab_onset_scores *scores, double level, lab_candidate *other,
                      int *n, lab_error *error)
{
  const int most = lab_count(LAB_ONSET_LEADERS), k = c->u.rig.n_onsets - 1;
  const lab_rig_onset now = c->u.rig.onset[k];
  lab_candidate *base = malloc(sizeof *base);
  double reach;
  int i;
  *n = 0;
  if (!base)
    return lab_fail_memory(error, "refits");
  *base = *c;
  base->n_found -= base->n_found > 0 && base->found[base->n_found - 1].param == now.param;
  lab_unknowns_drop_onset(&base->u);
  lab_unknowns_count(&base->u);
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < most; i++) {
    other[i].quality.fitted = 0;
    if (i < scores->n && scores->of[i].statistic > 0 && scores->of[i].param != now.param)
      begin_onset(base, &scores->of[i], now.from, lab_count(LAB_BRIEF_STEPS), &other[i], error);
  }
  reach = lab_constant(LAB_RIVAL) * fmin(lab_least_chi2(other, most), c->quality.chi2);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < most; i++) {
    if (!other[i].quality.fitted || other[i].quality.chi2 > reach)
      continue;
    lab_refit_one(&other[i], LAB_ROUNDS_ALL, error);
    if (other[i].quality.fitted && !lab_is_noise(&c->quality))
      end_onset(&other[i], level, error);
  }
  *n = most;
  free(base);
  return error->status;
}
