#include "refit.h"

#include <math.h>
#include <stdlib.h>

static const double rival = 3;                /* times the best chi-square: what leaves more falls behind */
static const double worth = 0.05;             /* of the best statistic: leaders have at least so much */
static const double nearly = 1.2;             /* times the best BIC: still in the running after a brief fit */
static const double much = 0.5;               /* of what the declared model leaves: a good effect takes so much */
enum { FIRST = 3, BRIEF = 8, FINALISTS = 3 }; /* steps of a fit; models fitted to the end */

/* Where a refit begins. The present fit may have bent its parameters to stand in for the effect; then the values
 * before any fit, with the effect at its usual size, are nearer to the truth. */
enum start { FROM_SLOPE, FROM_DECLARED, FROM_USUAL, STARTS };

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
static void refit_from(const lab_attempt *base, const lab_candidate *c, int start, lab_attempt *a)
{
  pneu_param_info info;
  double usual;
  lab_error ignored;
  lab_found *found;
  pneu_param_describe(c->param, &info);
  usual = (double)(info.value - info.neutral) * (c->size * (double)(info.value - info.neutral) < 0 ? -1 : 1);
  if (start == FROM_SLOPE && c->size != 0)
    usual = c->size;
  if (take_up(base, c, usual, start == FROM_DECLARED, a) || lab_attempt_fit(a, FIRST, &ignored))
    return;
  found = lab_attempt_add_found(a);
  found->effect = c->effect;
  found->param = c->param;
  found->shape = c->shape;
  found->statistic = c->statistic;
  found->p_value = c->p_value;
}

/* The candidates worth a refit: the first of those that pass. */
static int count_leaders(const lab_trace_result *trace, double level)
{
  int n = 0;
  while (n < trace->n && n < LAB_LOOP_LEADERS && trace->candidate[n].p_value < level &&
         trace->candidate[n].statistic >= worth * trace->candidate[0].statistic)
    n++;
  return n;
}

/* All that pass. */
static int count_passing(const lab_trace_result *trace, double level)
{
  int n = 0;
  while (n < trace->n && n < LAB_REFIT_MAX && trace->candidate[n].p_value < level)
    n++;
  return n;
}

/* Fit those to the end that are in the running after a brief fit: the best few, and whatever is nearly as good. */
static void fit_finalists(lab_attempt *a, int n)
{
  double bar;
  int i;
  qsort(a, (size_t)n, sizeof *a, lab_attempt_by_bic);
  bar = n > 0 ? nearly * a[0].bic : 0;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error ignored;
    if (a[i].fitted && (i < FINALISTS || a[i].bic < bar))
      lab_attempt_fit(&a[i], LAB_FIT_WHOLE, &ignored);
  }
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

/* Refit the leaders from one start, in parallel: a few steps, and more for those that keep up with the best. */
static void refit_race(const lab_attempt *base, const lab_candidate *leader, int n, int start, lab_attempt *a)
{
  double least;
  int i;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    refit_from(base, &leader[i], start, &a[i]);
  least = least_chi2(a, n);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error ignored;
    if (a[i].fitted && a[i].chi2 < rival * least)
      lab_attempt_fit(&a[i], BRIEF, &ignored);
  }
}

/* Refit the leaders: all from the first start, and from the others for as long as none leaves only noise. */
static void refit_leaders(const lab_attempt *base, const lab_candidate *leader, int n, lab_attempt *a)
{
  const int starts = base->n_found == 0 ? STARTS : STARTS - 1;
  lab_attempt *mine = malloc(((size_t)n + 1) * sizeof *mine);
  int i, start;
  for (i = 0; i < n; i++)
    a[i].fitted = 0;
  for (start = 0; mine && start < starts && !lab_any_is_noise(a, n); start++) {
    refit_race(base, leader, n, start, mine);
    for (i = 0; i < n; i++)
      lab_attempt_keep_better(&a[i], &mine[i]);
  }
  free(mine);
  fit_finalists(a, n);
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

/* Refit the leaders; where none of them is any good beside the declared model, which what is missing may have bent
 * beyond the reach of slopes, all that pass.  Returns: how many. */
int lab_refit_effects(const lab_attempt *base, const lab_trace_result *trace, double level, lab_attempt *a)
{
  const int leaders = count_leaders(trace, level), all = count_passing(trace, level);
  refit_leaders(base, trace->candidate, leaders, a);
  if (base->n_found > 0 || all <= leaders || lab_any_is_noise(base, 1) || !lab_refit_all_poor(base, a, leaders))
    return leaders;
  refit_leaders(base, trace->candidate + leaders, all - leaders, a + leaders);
  return all;
}
