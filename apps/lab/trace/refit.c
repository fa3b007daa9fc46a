#include "refit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../base/quantile.h"
#include "../fit/nuisance.h"

/* ---- Candidates ---- */

/* Schwarz 1978: what a fit costs, with what it fits counted, and what has no name against what has. A declared value
 * that is held costs what its prior adds to chi-square. */
static double bic(const lab_unknowns *u, double chi2)
{
  int j, n = 0;
  for (j = 0; j < u->n; j++)
    n += !lab_unknown_is_known(&u->unknown[j]);
  n += u->rig.n_onsets; /* each has its time beside its value */
  return chi2 + n * log((double)u->n_values) + lab_constant(LAB_TERM_BIC) * u->rig.n_terms;
}

int lab_candidate_fit(lab_candidate *c, int steps, lab_error *error)
{
  lab_quality *q = &c->quality;
  lab_residual_stats left[LAB_CHANNEL_COUNT];
  int status = lab_unknowns_fit(&c->u, steps, &q->chi2, error);
  if (status == LAB_DATA) /* with its values a run begins in no state of the rig: no fault of the data */
    status = error->status = LAB_NUMERIC;
  q->values = (double)c->u.n_values;
  q->bic = bic(&c->u, q->chi2);
  q->white = q->whole = 0;
  q->fitted = status == LAB_OK;
  if (q->fitted && c->u.window == 0 && !lab_is_noise(q) && q->chi2 < lab_constant(LAB_NOISE_DOUBTFUL) * q->values) {
    status = lab_unknowns_residual_stats(&c->u, left, error);
    q->fitted = status == LAB_OK;
    q->white = q->fitted && lab_residual_stats_noise(left);
  }
  if (q->fitted) {
    status = lab_nuisance_strain(&c->u, &q->strain, error);
    q->fitted = status == LAB_OK;
  }
  return status;
}

/* Fit one of many candidates, which fail for want of memory together; not at all when the time is spent. */
static int fit(lab_candidate *c, int steps, lab_error *all)
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

int lab_any(const lab_candidate *c, int n, int (*is)(const lab_quality *q))
{
  int i, any = 0;
  for (i = 0; i < n; i++)
    any |= is(&c[i].quality);
  return any;
}

int lab_candidate_by_bic(const void *x, const void *y)
{
  const lab_quality *a = &((const lab_candidate *)x)->quality, *b = &((const lab_candidate *)y)->quality;
  if (a->fitted != b->fitted)
    return b->fitted - a->fitted;
  return a->bic < b->bic ? -1 : a->bic > b->bic;
}

/* One more addition, to be filled in.  Returns: its place. */
static lab_found *add_found(lab_candidate *c)
{
  lab_found *found = &c->found[c->n_found++];
  memset(found, 0, sizeof *found);
  found->effect = found->term = found->shape = -1;
  found->degrees = 1;
  return found;
}

int lab_candidate_fit_held(lab_candidate *c, lab_error *error)
{
  static const double less = 0.7;
  double before;
  int status = lab_unknowns_weigh_held(&c->u, error);
  c->quality.fitted = 0;
  if (status == LAB_OK)
    status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  before = c->u.misfit;
  if (status == LAB_OK)
    status = lab_unknowns_weigh_held(&c->u, error);
  if (status == LAB_OK && c->u.misfit < less * before)
    status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

int lab_candidate_hold(lab_candidate *c, lab_error *error)
{
  return lab_unknowns_hold(&c->u, error) ? error->status : lab_candidate_fit_held(c, error);
}

int lab_candidate_stage(const lab_candidate *c, const lab_unknowns *declared, lab_candidate *staged, lab_error *error)
{
  int i, k;
  *staged = *c;
  staged->u = *declared;
  staged->u.until = c->u.until;
  staged->quality.fitted = 0;
  for (i = 0; i < c->n_found; i++) {
    const int params[] = {c->found[i].param, c->found[i].shape};
    for (k = 0; k < 2; k++)
      if (params[k] >= 0 &&
          lab_unknowns_add(&staged->u, params[k], c->u.unknown[lab_unknowns_find(&c->u, params[k])].value, error))
        return error->status;
  }
  lab_unknowns_take(&staged->u);
  if (lab_candidate_fit(staged, LAB_ROUNDS_ALL, error))
    return error->status;
  return lab_candidate_hold(staged, error);
}

void lab_candidate_explain(lab_candidate *c, double chi2_before)
{
  lab_found *found = &c->found[c->n_found - 1];
  found->explained = (chi2_before - c->quality.chi2) / fmax(chi2_before - c->quality.values, 1);
}

void lab_candidate_name(const lab_candidate *c, char *text, size_t size)
{
  size_t used = 0;
  int i;
  snprintf(text, size, "declared model");
  for (i = 0; i < c->n_found && used < size; i++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? " + " : "",
                             c->found[i].effect < 0 ? "unlisted" : pneu_effect_at(c->found[i].effect)->name);
  for (i = 0; i < c->u.n && used < size; i++)
    if (c->u.unknown[i].kind == LAB_UNKNOWN_ONSET)
      used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " + " : "", c->u.unknown[i].name);
}

int lab_found_is_of_sensor(const lab_found *found)
{
  return found->effect >= 0 && strcmp(pneu_effect_at(found->effect)->equation, "sensor") == 0;
}

int lab_candidate_begins(const lab_candidate *c)
{
  const int n = c->u.rig.n_onsets;
  return n > 0 && c->begin[n - 1].known;
}

int lab_candidate_place_again(lab_candidate *c, lab_error *error)
{
  const int k = c->u.rig.n_onsets - 1;
  int j, status;
  if (!lab_candidate_begins(c))
    return LAB_OK;
  j = lab_unknowns_find_onset(&c->u, c->u.rig.onset[k].param);
  status = lab_onset_settle(&c->u, j, 1, &c->quality.chi2, &c->begin[k], error);
  if (status == LAB_OK)
    status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* What the prior of an error of an instrument adds to chi-square; 0: it is none. */
static double cost_of_instrument(const lab_unknowns *u, const lab_unknown *x)
{
  const int effect = x->kind == LAB_UNKNOWN_PARAM && lab_unknown_is_held(x) ? pneu_effect_of(x->index) : -1;
  if (effect < 0 || strcmp(pneu_effect_at(effect)->equation, "sensor") != 0)
    return 0;
  return pow((x->value - x->prior) / lab_unknown_reach(u, x), 2);
}

int lab_candidate_take_instruments(lab_candidate *c, int *any, lab_error *error)
{
  const double excess = c->quality.chi2 - c->quality.values;
  int j, status = LAB_OK;
  *any = 0;
  for (j = 0; j < c->u.n && c->n_found < LAB_EFFECTS_MAX && status == LAB_OK; j++) {
    const lab_unknown x = c->u.unknown[j];
    const double cost = cost_of_instrument(&c->u, &x);
    lab_found *found;
    if (!(cost - log((double)c->u.n_values) > lab_constant(LAB_ALIKE_BIC)))
      continue;
    status = lab_unknowns_add(&c->u, x.index, x.value, error);
    found = add_found(c);
    found->effect = pneu_effect_of(x.index);
    found->param = x.index;
    found->statistic = cost;
    found->p_value = lab_chi2_tail(found->statistic, 1);
    found->explained = found->statistic / fmax(found->statistic, excess);
    *any = 1;
  }
  return *any && status == LAB_OK ? lab_candidate_fit(c, LAB_ROUNDS_ALL, error) : status;
}

/* ---- Refits of effects ---- */

/* Where a refit begins. The present fit may have bent its parameters to stand in for the effect; then the values
 * before any fit, with the effect at its usual size, are nearer to the truth, or at the largest size there is: a film
 * that lets no heat through. */
enum start { FROM_SLOPE, FROM_DECLARED, FROM_USUAL, FROM_BOUND, STARTS };

/* By how much an effect leaves neutral at the start. */
static double size_at(const lab_score *score, enum start start)
{
  pneu_param_info info;
  pneu_param_describe(score->param, &info);
  if (start == FROM_BOUND)
    return (double)(info.upper - info.neutral);
  if (start == FROM_SLOPE && score->size != 0)
    return score->size;
  return (double)(info.value - info.neutral) * (score->size * (double)(info.value - info.neutral) < 0 ? -1 : 1);
}

/* ---- Slopes that refits share ---- */

/* Candidates that begin at the same values of their unknowns begin with the same slopes in them, and each keeps its own
 * from fit to fit: slopes are what a refit costs. */
typedef struct shared {
  lab_candidate base; /* with its slopes */
  int has_slopes;
} shared;

/* Where extensions of one model begin: at its fit, and at the values that its unknowns had before any fit. */
typedef struct starts {
  shared of[2];
  double until; /* [s] of CPU time: after it no more begin, so that there is time for those that did; 0: never */
} starts;

/* Find the slopes of a base, where there is room for them and they can be had. */
static void share(shared *s, lab_error *all)
{
  lab_error error;
  if (s->has_slopes || lab_cpu_is_spent(s->base.u.until))
    return;
  s->has_slopes = 1;
  if (lab_unknowns_keep_slopes(&s->base.u, &error) || lab_unknowns_find_slopes(&s->base.u, &error))
    lab_fail_together(all, &error);
}

/* Whether an extension of a base has a fit: it begins with the slopes of its base. */
static int begin_fit(const lab_candidate *base, int steps, lab_candidate *c, lab_error *all)
{
  lab_error error;
  if (lab_unknowns_keep_slopes(&c->u, &error)) {
    lab_fail_together(all, &error);
    return 0;
  }
  lab_unknowns_begin_with(&c->u, &base->u);
  return fit(c, steps, all) == LAB_OK;
}

/* Returns: NULL for want of memory; else to be closed */
static starts *open_starts(const lab_candidate *base, lab_error *error)
{
  const double now = lab_cpu_time();
  starts *s = calloc(1, sizeof *s);
  error->status = LAB_OK;
  if (!s) {
    lab_fail_memory(error, "refits");
    return NULL;
  }
  s->of[0].base = s->of[1].base = *base;
  lab_unknowns_undo_fit(&s->of[1].base.u);
  if (base->u.until > 0)
    s->until = now + lab_constant(LAB_BEGIN_TIME) * (base->u.until - now);
  return s;
}

/* In/out:  c  n candidates that began there */
static void close_starts(starts *s, lab_candidate *c, int n)
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

/* The model with one effect more, from one start, after the first steps.  In/out: c  the base, not fitted */
static void begin_refit(const lab_candidate *base, const lab_score *score, enum start start, lab_candidate *c,
                        lab_error *all)
{
  pneu_param_info info;
  lab_error ignored;
  lab_found *found;
  pneu_param_describe(score->param, &info);
  if (lab_unknowns_add(&c->u, score->param, (double)info.neutral + size_at(score, start), &ignored) ||
      (score->shape >= 0 && lab_unknowns_add(&c->u, score->shape, score->shape_value, &ignored)))
    return; /* no room */
  lab_unknowns_take(&c->u);
  if (!begin_fit(base, lab_count(LAB_FIRST_STEPS), c, all))
    return;
  found = add_found(c);
  found->effect = score->effect;
  found->param = score->param;
  found->shape = score->shape;
  found->statistic = score->statistic;
  found->p_value = score->p_value;
}

/* Those of the first n whose statistic is not below a share of the best. */
static int count_near(const lab_score *score, int n, enum lab_constant share)
{
  int i = 0;
  while (i < n && score[i].statistic >= lab_constant(share) * score[0].statistic)
    i++;
  return i;
}

static double least_chi2(const lab_candidate *c, int n)
{
  double least = INFINITY;
  int i;
  for (i = 0; i < n; i++)
    if (c[i].quality.fitted)
      least = fmin(least, c[i].quality.chi2);
  return least;
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
    if (q->fitted && (q->bic < bar || (i < lab_count(LAB_FINALISTS) && q->chi2 < reach)))
      fit(&c[i], LAB_ROUNDS_ALL, all);
  }
}

/* Refit effects from one start, in parallel: a few steps, and more for those that keep up with the best.
 * In/out:  c     the best candidate of each so far, with its slopes
 *          best  least chi-square of all candidates so far */
static void race(starts *s, const lab_score *score, int n, enum start start, lab_candidate *c, double *best,
                 lab_error *all)
{
  lab_candidate *mine = malloc(((size_t)n + 1) * sizeof *mine);
  shared *from = &s->of[start == FROM_DECLARED || start == FROM_BOUND];
  const int is_late = isfinite(*best) && lab_cpu_is_spent(s->until);
  double reach;
  int i;
  if (!mine) {
    lab_fail_memory(all, "refits");
    return;
  }
  if (n > 0 && !is_late)
    share(from, all);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    mine[i] = from->base;
    mine[i].u.slopes = NULL;
    mine[i].quality.fitted = 0;
    if (!isfinite(*best) || !lab_cpu_is_spent(s->until))
      begin_refit(&from->base, &score[i], start, &mine[i], all);
  }
  *best = fmin(*best, least_chi2(mine, n));
  reach = lab_constant(LAB_RIVAL) * *best;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    const lab_quality *q = &mine[i].quality;
    lab_candidate loser = mine[i];
    if (q->fitted && q->chi2 < reach)
      fit(&mine[i], lab_count(LAB_BRIEF_STEPS), all);
    if (q->fitted && (!c[i].quality.fitted || q->chi2 < c[i].quality.chi2)) {
      loser = c[i];
      c[i] = mine[i];
    }
    lab_unknowns_forget_slopes(&loser.u);
  }
  *best = fmin(*best, least_chi2(c, n));
  free(mine);
}

/* Refit the leaders: the foremost from the first start, the rest unless one of these leaves nothing that they could
 * explain, and all from the other starts for as long as none leaves only noise. */
static void refit_leaders(starts *s, const lab_score *leader, int n, lab_candidate *c, double *best, lab_error *all)
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
static int refit_bent(starts *s, const lab_scores *scores, double level, lab_candidate *c, int n, double *best,
                      lab_error *error)
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
  starts *s = open_starts(base, error);
  double best = INFINITY;
  int i;
  for (i = 0; i < LAB_REFIT_MAX; i++) {
    c[i].quality.fitted = 0;
    c[i].u.slopes = NULL;
  }
  *n = count_near(scores->of, all < LAB_LEADERS_MAX ? all : LAB_LEADERS_MAX, LAB_LEADER_SHARE);
  if (s)
    refit_leaders(s, scores->of, *n, c, &best, error);
  close_starts(s, c, *n);
  return error->status;
}

int lab_refit_hidden(const lab_candidate *base, const lab_scores *scores, double level, lab_candidate *c, int *n,
                     lab_error *error)
{
  const int all = count_passing(scores, level);
  starts *s = open_starts(base, error);
  double best = least_chi2(c, *n);
  if (s && *n < all && all_are_poor(base, c, *n)) {
    refit_leaders(s, scores->of + *n, all - *n, c + *n, &best, error);
    *n = all;
  }
  if (s && error->status == LAB_OK && !lab_any(c, *n, lab_is_noise))
    *n = refit_bent(s, scores, level, c, *n, &best, error);
  close_starts(s, c, *n);
  return error->status;
}

/* ---- Refits of what begins ---- */

/* The time of a row of the only run [s]. */
static double time_of(const lab_candidate *c, size_t row)
{
  return c->u.run[0].log->value[LAB_CHANNEL_TIME][c->u.run[0].first + row];
}

/* The model in which one thing begins at some time, after some steps. */
static void begin_onset(const lab_candidate *base, const lab_score *score, double from, int steps, lab_candidate *c,
                        lab_error *all)
{
  const double now = score->param == LAB_PARAM_ORIFICE_AREA
                         ? 1
                         : (double)*pneu_param_at((pneu_params *)&base->u.rig.params, score->param);
  lab_error ignored;
  *c = *base;
  c->quality.fitted = 0;
  if (lab_unknowns_add_onset(&c->u, score->param, from, now + score->size, &ignored))
    return; /* no room */
  if (fit(c, steps, all) || score->effect < 0)
    return;
  add_found(c);
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
    fit(c, LAB_ROUNDS_ALL, all);
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

int lab_refit_onsets_at(const lab_candidate *base, const lab_onset_scores *scores, double level, size_t row,
                        lab_candidate *c, int *n, lab_error *error)
{
  const int most = lab_count(LAB_ONSET_LEADERS);
  double reach;
  int i;
  error->status = LAB_OK;
  *n = 0;
  while (*n < most && *n < scores->n && scores->of[*n].p_value < level)
    ++*n;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < *n; i++)
    begin_onset(base, &scores->of[i], time_of(base, row), lab_count(LAB_BRIEF_STEPS), &c[i], error);
  reach = lab_constant(LAB_RIVAL) * least_chi2(c, *n);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < *n; i++)
    if (c[i].quality.fitted && c[i].quality.chi2 <= reach)
      place_near(&c[i], error);
  qsort(c, (size_t)*n, sizeof *c, lab_candidate_by_bic);
  return error->status;
}

int lab_refit_instead(const lab_candidate *c, const lab_onset_scores *scores, double level, lab_candidate *other,
                      int *n, lab_error *error)
{
  const int most = lab_count(LAB_ONSET_LEADERS), k = c->u.rig.n_onsets - 1;
  const lab_rig_onset now = c->u.rig.onset[k];
  lab_candidate *base = malloc(sizeof *base);
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
    if (i < scores->n && scores->of[i].param != now.param)
      begin_onset(base, &scores->of[i], now.from, LAB_ROUNDS_ALL, &other[i], error);
    if (other[i].quality.fitted && !lab_is_noise(&c->quality))
      end_onset(&other[i], level, error);
  }
  *n = most;
  free(base);
  return error->status;
}

/* ---- Refits of free terms ---- */

static void begin_term(const lab_candidate *base, const lab_term_score *score, lab_candidate *c, lab_error *all)
{
  lab_error error;
  lab_found *found;
  *c = *base;
  c->u.slopes = NULL;
  c->quality.fitted = 0;
  if (lab_unknowns_add_term(&c->u, &score->term, score->scale, 0, &error)) {
    lab_fail_together(all, &error);
    return;
  }
  if (!begin_fit(base, lab_count(LAB_BRIEF_STEPS), c, all))
    return;
  found = add_found(c);
  found->term = c->u.rig.n_terms - 1;
  found->statistic = score->statistic;
  found->degrees = score->degrees;
  found->scale = score->scale;
}

/* Fit to the end, and on where the end is still moving: knots near which the log hardly ever is make a long valley. */
static void end_term(lab_candidate *c, lab_error *all)
{
  const lab_quality *q = &c->quality;
  double before = INFINITY;
  int i;
  for (i = 0; i < lab_count(LAB_TERM_REFITS) && q->fitted && !lab_is_noise(q) &&
              q->chi2 < lab_constant(LAB_TERM_MOVING) * before;
       i++) {
    before = q->chi2;
    fit(c, LAB_ROUNDS_ALL, all);
  }
}

/* Values of one term, less a level, at the knots of another; 0 at its ends. */
static void resample(const pneu_term *from, double level, pneu_term *to)
{
  int i;
  for (i = 0; i < to->n; i++) {
    const double at = (double)(to->from + (to->to - to->from) * (pneu_real)i / (pneu_real)(to->n - 1));
    const double place = (at - (double)from->from) / (double)(from->to - from->from) * (from->n - 1);
    const int k = place < from->n - 2 ? (int)fmax(place, 0) : from->n - 2;
    const double share = fmin(fmax(place - k, 0), 1);
    to->value[i] = (pneu_real)((1 - share) * (double)from->value[k] + share * (double)from->value[k + 1] - level);
  }
  to->value[0] = to->value[to->n - 1] = 0;
}

/* A free term that acts on a short stretch only: knots there, close together, and none elsewhere. */
static void refine(lab_candidate *c, lab_candidate *fine, lab_error *all)
{
  const lab_found *found = &c->found[c->n_found - 1];
  const pneu_term coarse = c->u.rig.term[found->term];
  const double margin = lab_constant(LAB_TERM_MARGIN) * (double)(coarse.to - coarse.from) / (coarse.n - 1);
  double from, to, level, peak;
  pneu_term term = coarse;
  lab_error error;
  if (!lab_free_term_stretch(&coarse, &from, &to, &level, &peak))
    return;
  *fine = *c;
  fine->u.slopes = NULL;
  lab_unknowns_drop_term(&fine->u);
  term.n = lab_count(LAB_TERM_FINE_KNOTS);
  term.from = (pneu_real)fmax(from - margin, (double)coarse.from);
  term.to = (pneu_real)fmin(to + margin, (double)coarse.to);
  resample(&coarse, level, &term);
  if (lab_unknowns_add_term(&fine->u, &term, found->scale, 1, &error))
    lab_fail_together(all, &error);
  else if (fit(fine, LAB_ROUNDS_ALL, all) == LAB_OK && fine->quality.bic < c->quality.bic)
    *c = *fine;
}

int lab_refit_free_terms(const lab_candidate *base, const lab_term_score *score, int n, lab_candidate *best,
                         lab_error *error)
{
  const int most = lab_count(LAB_TERM_LEADERS), finalists = lab_count(LAB_FINALISTS);
  lab_candidate *c = malloc((size_t)(most + 1) * sizeof *c);
  starts *s = open_starts(base, error);
  const int all = n < most ? n : most, last = all < finalists ? all : finalists;
  int i;
  best->quality.fitted = 0;
  if (!c || !s) {
    free(c);
    close_starts(s, NULL, 0);
    return lab_fail_memory(error, "refits");
  }
  share(&s->of[0], error);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < all; i++)
    begin_term(&s->of[0].base, &score[i], &c[i], error);
  qsort(c, (size_t)all, sizeof *c, lab_candidate_by_bic);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < last; i++)
    end_term(&c[i], error);
  close_starts(s, c, all);
  qsort(c, (size_t)last, sizeof *c, lab_candidate_by_bic);
  if (last > 0)
    *best = c[0];
  if (best->quality.fitted) {
    refine(best, &c[all], error);
    lab_candidate_explain(best, base->quality.chi2);
  }
  free(c);
  return error->status;
}
