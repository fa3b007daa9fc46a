#include "refit_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../base/quantile.h"

/* ---- What refits share ---- */

int lab_refit_one(lab_candidate *c, int steps, lab_error *all)
{
  lab_error error;
  int status;
  if (lab_cpu_is_spent(c->u.until))
    return LAB_NUMERIC;
  status = lab_candidate_fit(c, steps, &error);
  if (status != LAB_OK)
    lab_fail_together(all, &error);
  return status;
}

void lab_refit_share(lab_shared_slopes *s, lab_error *all)
{
  lab_error error;
  if (s->has_slopes || lab_cpu_is_spent(s->base.u.until))
    return;
  s->has_slopes = 1;
  if (lab_unknowns_keep_slopes(&s->base.u, &error) || lab_unknowns_find_slopes(&s->base.u, &error))
    lab_fail_together(all, &error);
}

int lab_refit_begin(const lab_candidate *base, int steps, lab_candidate *c, lab_error *all)
{
  lab_error error;
  if (lab_unknowns_keep_slopes(&c->u, &error)) {
    lab_fail_together(all, &error);
    return 0;
  }
  lab_unknowns_begin_with(&c->u, &base->u);
  return lab_refit_one(c, steps, all) == LAB_OK;
}

lab_refit_starts *lab_refit_open_starts(const lab_candidate *base, lab_error *error)
{
  lab_refit_starts *s = calloc(1, sizeof *s);
  error->status = LAB_OK;
  if (!s) {
    lab_fail_memory(error, "refits");
    return NULL;
  }
  s->of[0].base = s->of[1].base = *base;
  lab_unknowns_undo_fit(&s->of[1].base.u);
  s->until = lab_cpu_share(base->u.until, lab_constant(LAB_BEGIN_TIME));
  return s;
}

void lab_refit_close_starts(lab_refit_starts *s, lab_candidate *c, int n)
{
  int i;
  for (i = 0; i < n; i++)
    lab_unknowns_forget_slopes(&c[i].u);
  if (s) {
    lab_unknowns_forget_slopes(&s->of[0].base.u);
    lab_unknowns_forget_slopes(&s->of[1].base.u);
  }
  free(s);
}

/* ---- Refits of effects ---- */

/* Where a refit begins. The present fit may have bent its parameters to stand in for the effect; then the values
 * before any fit, with the effect at its usual size, are nearer to the truth, or at the largest size there is: a film
 * that lets no heat through. */
enum start { FROM_SLOPE, FROM_DECLARED, FROM_USUAL, FROM_BOUND, STARTS };

/* By how much an effect leaves neutral at the start. */
static double size_at(const lab_unknowns *u, const lab_score *score, enum start start)
{
  const pneu_param_info info = lab_param_info(score->param);
  const double usual = lab_score_usual(u, score->param);
  if (start == FROM_BOUND)
    return (double)(info.upper - info.neutral);
  if (start == FROM_SLOPE && score->size != 0)
    return score->size;
  return score->size * usual < 0 ? -usual : usual;
}

/* The model with one effect more, from one start, after the first steps.  In/out: c  the base, not fitted */
static void begin_refit(const lab_candidate *base, const lab_score *score, enum start start, lab_candidate *c,
                        lab_error *all)
{
  lab_error ignored;
  if (lab_candidate_add_effect(c, score, size_at(&base->u, score, start), &ignored) == LAB_OK)
    lab_refit_begin(base, lab_count(LAB_FIRST_STEPS), c, all);
}

/* Those of the first n whose statistic is not below a share of the best. */
static int count_near(const lab_score *score, int n, enum lab_constant share)
{
  int i = 0;
  while (i < n && score[i].statistic >= lab_constant(share) * score[0].statistic)
    i++;
  return i;
}

/* Fit those to the end that are in the running after a brief fit: whatever is nearly as good as the best, and the best
 * few rivals.
 * In:      best  chi-square that they are to keep up with */
static void fit_finalists(lab_candidate *c, int n, double best, lab_error *all)
{
  const double reach = lab_constant(LAB_RIVAL) * best;
  double bar;
  int i;
  qsort(c, (size_t)n, sizeof *c, lab_candidate_by_bic);
  bar = n > 0 ? fmin(lab_constant(LAB_NEARLY) * c[0].quality.bic, reach) : 0;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    const lab_quality *q = &c[i].quality;
    lab_error error;
    if (!q->fitted || !(q->bic < bar || (i < lab_count(LAB_FINALISTS) && q->chi2 < reach)))
      continue;
    if (lab_refit_one(&c[i], LAB_ROUNDS_ALL, all) == LAB_OK && lab_candidate_try_options(&c[i], &error))
      lab_fail_together(all, &error);
  }
}

/* Refit effects from one start, in parallel: a few steps, and more for those that keep up with the best.
 * In/out:  c     the best candidate of each so far, with its slopes
 *          best  least chi-square of all candidates so far */
static void race(lab_refit_starts *s, const lab_score *score, int n, enum start start, lab_candidate *c, double *best,
                 lab_error *all)
{
  lab_candidate *mine = malloc(((size_t)n + 1) * sizeof *mine);
  lab_shared_slopes *from = &s->of[start == FROM_DECLARED || start == FROM_BOUND];
  const int is_late = isfinite(*best) && lab_cpu_is_spent(s->until);
  double reach;
  int i;
  if (!mine) {
    lab_fail_memory(all, "refits");
    return;
  }
  if (n > 0 && !is_late)
    lab_refit_share(from, all);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    mine[i] = from->base;
    mine[i].u.slopes = NULL;
    mine[i].quality.fitted = 0;
    if (!isfinite(*best) || !lab_cpu_is_spent(s->until))
      begin_refit(&from->base, &score[i], start, &mine[i], all);
  }
  *best = fmin(*best, lab_least_chi2(mine, n));
  reach = lab_constant(LAB_RIVAL) * *best;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    const lab_quality *q = &mine[i].quality;
    lab_candidate loser = mine[i];
    if (q->fitted && q->chi2 < reach)
      lab_refit_one(&mine[i], lab_count(LAB_BRIEF_STEPS), all);
    if (q->fitted && (!c[i].quality.fitted || q->chi2 < c[i].quality.chi2)) {
      loser = c[i];
      c[i] = mine[i];
    }
    lab_unknowns_forget_slopes(&loser.u);
  }
  *best = fmin(*best, lab_least_chi2(c, n));
  free(mine);
}

/* Refit the leaders: the foremost from the first start, the rest unless one of these leaves nothing that they could
 * explain, and all from the other starts for as long as none leaves only noise. */
static void refit_leaders(lab_refit_starts *s, const lab_score *leader, int n, lab_candidate *c, double *best,
                          lab_error *all)
{
  const int end = s->of[0].base.n_found == 0 ? STARTS : FROM_USUAL, first = count_near(leader, n, LAB_FOREMOST_SHARE);
  int start;
  race(s, leader, first, FROM_SLOPE, c, best, all);
  if (!lab_any(c, n, lab_is_clean))
    race(s, leader + first, n - first, FROM_SLOPE, c + first, best, all);
  for (start = FROM_SLOPE + 1; start < end && !lab_any(c, n, lab_is_noise); start++)
    race(s, leader, n, (enum start)start, c, best, all);
  fit_finalists(c, n, *best, all);
}

/* What was not refitted yet and may all the same be missing: what passes, though it explains little, and effects whose
 * slope asks for a sign that they cannot have as clearly as others pass. A fit that has bent so far that it overshoots
 * wants less of what is missing. Forces are not among them: p and x show them at once, where orifice and preload can
 * take up what the gas does.
 * In:      n  foremost effects that were refitted
 * Returns: how many, at most `room` */
static int list_bent(const lab_scores *scores, double level, int n, int room, lab_score *bent)
{
  int i, count = 0;
  for (i = n; i < scores->n && count < room; i++) {
    const lab_score *s = &scores->of[i];
    if (strcmp(pneu_effect_at(s->effect)->equation, "force") != 0 &&
        (s->p_value < level || (s->statistic == 0 && lab_chi2_tail(s->against, 1) < level)))
      bent[count++] = *s;
  }
  return count;
}

/* The last resort among single effects: those that the bent fit has hidden, from the values before any fit. What a
 * refit took off chi-square stands in for the statistic where the slope had the wrong sign.
 * In:      n  candidates so far
 * Returns: how many there are then */
static int refit_bent(lab_refit_starts *s, const lab_scores *scores, double level, lab_candidate *c, int n,
                      double *best, lab_error *error)
{
  lab_score bent[LAB_REFIT_MAX] = {{0}};
  const int all = n + list_bent(scores, level, n, LAB_REFIT_MAX - n, bent);
  int i;
  race(s, bent, all - n, FROM_DECLARED, c + n, best, error);
  race(s, bent, all - n, FROM_BOUND, c + n, best, error);
  fit_finalists(c + n, all - n, *best, error);
  for (i = n; i < all; i++) {
    lab_found *found = c[i].quality.fitted ? &c[i].found[c[i].n_found - 1] : NULL;
    if (found && found->statistic == 0) {
      found->statistic = fmax(s->of[0].base.quality.chi2 - c[i].quality.chi2, 0);
      found->p_value = lab_chi2_tail(found->statistic, 1);
    }
  }
  return all;
}

/* Whether none of n candidates explains much of what the declared model leaves. */
static int all_are_poor(const lab_candidate *declared, const lab_candidate *c, int n)
{
  int i, poor = 1;
  for (i = 0; i < n; i++)
    poor &= lab_is_poor(&declared->quality, &c[i].quality);
  return poor;
}

/* Foremost effects whose score passes. */
static int count_passing(const lab_scores *scores, double level)
{
  int n = 0;
  while (n < scores->n && n < LAB_REFIT_MAX && scores->of[n].p_value < level)
    n++;
  return n;
}

int lab_refit_effects(const lab_candidate *base, const lab_scores *scores, double level, lab_candidate *c, int *n,
                      lab_error *error)
{
  const int all = count_passing(scores, level);
  lab_refit_starts *s = lab_refit_open_starts(base, error);
  double best = INFINITY;
  int i;
  for (i = 0; i < LAB_REFIT_MAX; i++) {
    c[i].quality.fitted = 0;
    c[i].u.slopes = NULL;
  }
  *n = count_near(scores->of, all < LAB_LEADERS_MAX ? all : LAB_LEADERS_MAX, LAB_LEADER_SHARE);
  if (s)
    refit_leaders(s, scores->of, *n, c, &best, error);
  lab_refit_close_starts(s, c, *n);
  return error->status;
}

int lab_refit_hidden(const lab_candidate *base, const lab_scores *scores, double level, lab_candidate *c, int *n,
                     lab_error *error)
{
  const int all = count_passing(scores, level);
  lab_refit_starts *s = lab_refit_open_starts(base, error);
  double best = lab_least_chi2(c, *n);
  if (s && *n < all && all_are_poor(base, c, *n)) {
    refit_leaders(s, scores->of + *n, all - *n, c + *n, &best, error);
    *n = all;
  }
  if (s && error->status == LAB_OK && !lab_any(c, *n, lab_is_noise))
    *n = refit_bent(s, scores, level, c, *n, &best, error);
  lab_refit_close_starts(s, c, *n);
  return error->status;
}
