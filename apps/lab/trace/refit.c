#include "refit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/quantile.h"

static const double rival = 3;                /* times the best chi-square: what leaves more falls behind */
static const double worth = 0.05;             /* of the best statistic: leaders have at least so much, */
static const double foremost = 0.2;           /* and those that are refitted first so much */
static const double nearly = 1.2;             /* times the best BIC: still in the running after a brief fit */
static const double much = 0.5;               /* of what the declared model leaves: a good effect takes so much */
enum { FIRST = 3, BRIEF = 8, FINALISTS = 3 }; /* steps of a fit; models fitted to the end */

/* Where a refit begins. The present fit may have bent its parameters to stand in for the effect; then the values
 * before any fit, with the effect at its usual size, are nearer to the truth, or at the largest size there is: a film
 * that lets no heat through. */
enum start { FROM_SLOPE, FROM_DECLARED, FROM_USUAL, FROM_BOUND, STARTS };

/* The model with one candidate of some size, before it is fitted.  Returns: 0, or -1 if there is no room. */
static int take_up(const lab_attempt *base, const lab_candidate *c, double size, int as_declared, lab_attempt *a)
{
  pneu_param_info info;
  lab_error ignored;
  double theta[LAB_FIT_MAX];
  int j;
  *a = *base;
  a->fitted = 0;
  pneu_param_describe(c->param, &info);
  if (as_declared)
    lab_attempt_undo_fit(a);
  if (lab_unknowns_add(&a->u, c->param, (double)info.neutral + size, &ignored) ||
      (c->shape >= 0 && lab_unknowns_add(&a->u, c->shape, c->shape_value, &ignored)))
    return -1;
  for (j = 0; j < a->u.n; j++)
    theta[j] = a->u.unknown[j].value;
  lab_unknowns_apply(&a->u, theta, LAB_ALL_EXPERIMENTS, &a->u.rig);
  return 0;
}

/* The model with one candidate, from one start. */
static void refit_from(const lab_attempt *base, const lab_candidate *c, int start, lab_attempt *a, lab_error *all)
{
  pneu_param_info info;
  double usual;
  lab_error error;
  lab_found *found;
  pneu_param_describe(c->param, &info);
  usual = (double)(info.value - info.neutral) * (c->size * (double)(info.value - info.neutral) < 0 ? -1 : 1);
  if (start == FROM_SLOPE && c->size != 0)
    usual = c->size;
  if (start == FROM_BOUND)
    usual = (double)(info.upper - info.neutral);
  if (take_up(base, c, usual, start == FROM_DECLARED || start == FROM_BOUND, a))
    return;
  if (lab_attempt_fit(a, FIRST, &error)) {
    lab_fail_together(all, &error);
    return;
  }
  found = lab_attempt_add_found(a);
  found->effect = c->effect;
  found->param = c->param;
  found->shape = c->shape;
  found->statistic = c->statistic;
  found->p_value = c->p_value;
}

/* All that pass. */
static int count_passing(const lab_trace_result *trace, double level)
{
  int n = 0;
  while (n < trace->n && n < LAB_REFIT_MAX && trace->candidate[n].p_value < level)
    n++;
  return n;
}

/* Those of the first n whose statistic is not below a share of the best. */
static int count_near(const lab_candidate *candidate, int n, double share)
{
  int i = 0;
  while (i < n && candidate[i].statistic >= share * candidate[0].statistic)
    i++;
  return i;
}

static double least_chi2(const lab_attempt *a, int n)
{
  double least = INFINITY;
  int i;
  for (i = 0; i < n; i++)
    if (a[i].fitted)
      least = fmin(least, a[i].chi2);
  return least;
}

/* Fit those to the end that are in the running after a brief fit: whatever is nearly as good as the best, and the best
 * few; of these only rivals where one leaves nothing to explain. */
static void fit_finalists(lab_attempt *a, int n, lab_error *all)
{
  double bar, reach;
  int i;
  qsort(a, (size_t)n, sizeof *a, lab_attempt_by_bic);
  bar = n > 0 ? nearly * a[0].bic : 0;
  reach = lab_any_is_clean(a, n) ? rival * least_chi2(a, n) : (double)INFINITY;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error error;
    if (a[i].fitted && (a[i].bic < bar || (i < FINALISTS && a[i].chi2 < reach)) &&
        lab_attempt_fit(&a[i], LAB_FIT_WHOLE, &error))
      lab_fail_together(all, &error);
  }
}

/* Refit leaders from one start, in parallel: a few steps, and more for those that keep up with the best.
 * In/out:  a  the best attempt of each so far */
static void refit_race(const lab_attempt *base, const lab_candidate *leader, int n, int start, lab_attempt *a,
                       lab_error *all)
{
  lab_attempt *mine = malloc(((size_t)n + 1) * sizeof *mine);
  double least;
  int i;
  if (!mine) {
    lab_fail_memory(all, "refits");
    return;
  }
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    refit_from(base, &leader[i], start, &mine[i], all);
  least = least_chi2(mine, n);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error error;
    if (mine[i].fitted && mine[i].chi2 < rival * least && lab_attempt_fit(&mine[i], BRIEF, &error))
      lab_fail_together(all, &error);
    lab_attempt_keep_better(&a[i], &mine[i]);
  }
  free(mine);
}

/* Refit the leaders: the foremost from the first start, the rest unless one of these leaves nothing that they could
 * explain, and all from the other starts for as long as none leaves only noise. */
static void refit_leaders(const lab_attempt *base, const lab_candidate *leader, int n, lab_attempt *a, lab_error *all)
{
  const int starts = base->n_found == 0 ? STARTS : FROM_USUAL, first = count_near(leader, n, foremost);
  int i, start;
  for (i = 0; i < n; i++)
    a[i].fitted = 0;
  refit_race(base, leader, first, FROM_SLOPE, a, all);
  if (!lab_any_is_clean(a, n))
    refit_race(base, leader + first, n - first, FROM_SLOPE, a + first, all);
  for (start = FROM_SLOPE + 1; start < starts && !lab_any_is_noise(a, n); start++)
    refit_race(base, leader, n, start, a, all);
  fit_finalists(a, n, all);
}

/* Whether none of them explains much of what the declared model leaves. */
int lab_refit_all_poor(const lab_attempt *base, const lab_attempt *a, int n)
{
  const double excess = base->chi2 - (double)base->u.n_values;
  int i, poor = 1;
  for (i = 0; i < n; i++)
    poor &= !a[i].fitted || a[i].chi2 - (double)a[i].u.n_values > much * excess;
  return poor;
}

/* What was not refitted yet and may all the same be missing: what passes, though it explains little, and effects whose
 * slope asks for a sign that they cannot have as clearly as others pass. A fit that has bent so far that it overshoots
 * wants less of what is missing. Forces are not among them: p and x show them at once, where orifice and preload can
 * take up what the gas does.
 *
 * In:      n  foremost candidates that were refitted
 * Returns: how many, at most `room` */
static int list_bent(const lab_trace_result *trace, double level, int n, int room, lab_candidate *bent)
{
  int i, count = 0;
  for (i = n; i < trace->n && count < room; i++) {
    const lab_candidate *c = &trace->candidate[i];
    if (strcmp(pneu_effect_at(c->effect)->equation, "force") != 0 &&
        (c->p_value < level || (c->statistic == 0 && lab_chi2_tail(c->against, 1) < level)))
      bent[count++] = *c;
  }
  return count;
}

/* What a refit took off chi-square stands in for the statistic of an effect whose slope had the wrong sign. */
static void judge_bent(const lab_attempt *base, lab_attempt *a, int n)
{
  int i;
  for (i = 0; i < n; i++) {
    lab_found *found = a[i].fitted ? &a[i].found[a[i].n_found - 1] : NULL;
    if (found && found->statistic == 0) {
      found->statistic = fmax(base->chi2 - a[i].chi2, 0);
      found->p_value = lab_chi2_tail(found->statistic, 1);
    }
  }
}

/* The last resort among single effects: those that the bent fit has hidden, from the values before any fit.
 * In:      n  attempts so far
 * Returns: how many there are then */
static int refit_bent(const lab_attempt *base, const lab_trace_result *trace, double level, lab_attempt *a, int n,
                      lab_error *error)
{
  lab_candidate bent[LAB_REFIT_MAX] = {{0}};
  const int more = list_bent(trace, level, n, LAB_REFIT_MAX - n, bent);
  int i;
  for (i = 0; i < more; i++)
    a[n + i].fitted = 0;
  refit_race(base, bent, more, FROM_DECLARED, a + n, error);
  refit_race(base, bent, more, FROM_BOUND, a + n, error);
  fit_finalists(a + n, more, error);
  judge_bent(base, a + n, more);
  return n + more;
}

/* Refit the leaders; where none of them is any good beside the declared model, which what is missing may have bent
 * beyond the reach of slopes, all that pass; and while none leaves only noise, what the bent fit has hidden. */
int lab_refit_effects(const lab_attempt *base, const lab_trace_result *trace, double level, lab_attempt *a, int *n,
                      lab_error *error)
{
  const int all = count_passing(trace, level);
  const int leaders = count_near(trace->candidate, all < LAB_LOOP_LEADERS ? all : LAB_LOOP_LEADERS, worth);
  *n = leaders;
  error->status = LAB_OK;
  refit_leaders(base, trace->candidate, leaders, a, error);
  if (base->n_found > 0 || lab_any_is_noise(base, 1))
    return error->status;
  if (error->status == LAB_OK && lab_refit_all_poor(base, a, leaders)) {
    *n = all;
    refit_leaders(base, trace->candidate + leaders, all - leaders, a + leaders, error);
  }
  if (error->status == LAB_OK && !lab_any_is_noise(a, *n))
    *n = refit_bent(base, trace, level, a, *n, error);
  return error->status;
}
