#include "change.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../base/quantile.h"
#include "../trace/decide.h"
#include "course.h"
#include "repeat.h"
#include "sides.h"

/* A change taken up, in a copy of the comparison. */
typedef struct extension {
  lab_unknowns u;
  double chi2, unplaced; /* unplaced: before its onset was found */
  int fitted, param, shape;
  int n_free; /* what it adds to the fit */
  lab_onset begin, end;
  int is_course;
} extension;

const char *lab_since_text(int condition)
{
  static const char *const text[] = {"cannot tell", "unchanged", "changed"};
  return text[condition];
}

const char *lab_change_name(int param, char name[LAB_PARAM_NAME_TEXT])
{
  const int e = pneu_effect_of(param);
  return e < 0 || e == pneu_effect_find("positioner") ? lab_fit_name(param, name)
                                                      : strcpy(name, pneu_effect_at(e)->name);
}

const char *lab_change_unit(const lab_change *change)
{
  return lab_param_info(change->param).unit;
}

/* ---- One after the other ---- */

/* Whether a refitted model still explains the baseline, as white noise sees it: noise with memory hides what a change
 * gets wrong on both sides. */
static int keeps_baseline(const lab_sides *c, const extension *x, lab_error *error)
{
  lab_rest left;
  return lab_sides_rest_of_all(c, &x->u, c->white, &left, error) == LAB_OK && !lab_rest_spoils_baseline(&left);
}

/* The model with the values that the baseline alone has, but for the changes taken up: a difference that is missing
 * bends them. */
static void unbend(const lab_sides *c, lab_unknowns *u)
{
  int j;
  for (j = 0; j < c->then.n; j++)
    if (u->unknown[j].kind != LAB_UNKNOWN_CHANGE || u->unknown[j].spread > 0)
      u->unknown[j].value = c->then.unknown[j].value;
  lab_unknowns_take(u);
}

/* Whether finding its onset can bring a change as far as it has brought another one. */
static int may_catch_up(const extension *x, const extension *leader)
{
  return !leader || !leader->begin.known || x->chi2 - leader->unplaced < leader->unplaced - leader->chi2;
}

/* In:      leader  another change that explains the new logs, or NULL: what cannot come near it is given up
 * In/out:  x       the model to begin with */
static int refit_from(const lab_sides *c, const lab_score *score, double size, double level, const extension *leader,
                      extension *x, lab_error *all)
{
  const double aim = leader ? leader->unplaced + lab_constant(LAB_ALIKE_BIC) : HUGE_VAL;
  lab_error error = {LAB_OK, ""};
  x->param = score->param;
  x->shape = score->shape;
  x->fitted = 0;
  memset(&x->begin, 0, sizeof x->begin);
  if (lab_sides_release(&x->u, c->first, score, size, &error) == LAB_OK &&
      (score->shape < 0 || lab_unknowns_add(&x->u, score->shape, score->shape_value, &error) == LAB_OK) &&
      lab_sides_settle(&x->u, aim, &x->chi2, &error) == LAB_OK) {
    x->unplaced = x->chi2;
    if (score->onset == 0 || (may_catch_up(x, leader) && lab_onset_find(&x->u, lab_sides_find(&x->u, x->param), level,
                                                                        &x->chi2, &x->begin, &error) == LAB_OK))
      x->fitted = keeps_baseline(c, x, &error);
  }
  x->n_free = 1 + (x->shape >= 0) + x->begin.known;
  lab_fail_together(all, &error);
  return x->fitted;
}

/* From what the slope says and, where that leads nowhere near what it promises, from the usual size; with the
 * baseline's values, if it is spoilt where it is followed to first order. Beside a leader, from the slope alone. */
static void refit(const lab_sides *c, const lab_score *score, double level, const extension *leader, extension *x,
                  lab_error *all)
{
  static const double kept = 0.5; /* of a promise */
  extension *again;
  x->u = c->u;
  if ((refit_from(c, score, score->size, level, leader, x, all) && c->chi2 - x->chi2 > kept * score->statistic) ||
      leader)
    return;
  again = calloc(1, sizeof *again);
  if (again) {
    again->u = c->u;
    if (!x->fitted && c->u.linear)
      unbend(c, &again->u);
  }
  if (again &&
      refit_from(c, score, copysign(lab_change_usual(&c->u, score->param), score->size), level, NULL, again, all) &&
      (!x->fitted || again->chi2 < x->chi2))
    *x = *again;
  free(again);
}

/* Whether a change leaves as little of the new logs as there is of the baseline. */
static int explains(const lab_sides *c, const extension *x)
{
  lab_error error;
  lab_rest left;
  return x->fitted && lab_sides_rest(&x->u, c->first, &left, &error) == LAB_OK && lab_rest_is_as_before(&left);
}

/* Whether the supply drives the model through the new log, and nobody has measured it. */
static int may_follow(const lab_sides *c)
{
  return c->first + 1 == c->u.n_runs && c->u.window == 0 && !c->u.rig.laws.pressure_input &&
         !c->u.rig.input[LAB_CHANNEL_PS];
}

/* Follow the supply where much is left, from the model of the baseline, which a log with a failing supply would bend.
 * White noise shows its course best; the other says what that is worth.
 * Out:     x  fitted or not
 *          c  chi2 of that model
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD */
static int follow(lab_sides *c, extension *x, lab_error *error)
{
  lab_course course;
  lab_rest left;
  int status = lab_sides_rest(&c->u, c->first, &left, error);
  memset(x, 0, sizeof *x);
  c->chi2 = left.chi2;
  if (status != LAB_OK || !may_follow(c))
    return status;
  c->u.run = c->white;
  status = lab_sides_rest(&c->u, c->first, &left, error);
  c->u.run = c->run;
  if (status != LAB_OK || !lab_rest_is_more_than_noise(&left))
    return status;
  x->u = c->then;
  x->param = PNEU_PARAM_supply_pressure;
  x->shape = -1;
  x->is_course = 1;
  x->u.run = c->white;
  status = lab_course_follow(&x->u, c->first, &course, error);
  x->u.run = c->run;
  if (status == LAB_OK && course.n_free > 0)
    status = lab_unknowns_fit(&x->u, LAB_ROUNDS_ALL, &x->chi2, error);
  x->fitted = status == LAB_OK && course.n_free > 0;
  x->n_free = course.n_free;
  x->begin = course.begin;
  x->end = course.end;
  return status == LAB_WORLD ? status : LAB_OK;
}

/* The order in which changes that are as good are named: orifices, parameters, effects. */
static int order_of(int param)
{
  return param == LAB_PARAM_ORIFICE_AREA ? -1 : param;
}

/* Schwarz's criterion. */
static double bic_of(const extension *x)
{
  return x->chi2 + x->n_free * log((double)x->u.n_values);
}

/* The best of n: the first in order of those that the log hardly tells apart. */
static extension *choose(extension *x, int n)
{
  extension *best = NULL, *first = NULL;
  int i;
  for (i = 0; i < n; i++)
    if (x[i].fitted && (!best || bic_of(&x[i]) < bic_of(best)))
      best = &x[i];
  for (i = 0; i < n; i++)
    if (x[i].fitted && bic_of(&x[i]) < bic_of(best) + lab_constant(LAB_ALIKE_BIC) / 2 &&
        (!first || order_of(x[i].param) < order_of(first->param)))
      first = &x[i];
  return first;
}

static void take(lab_sides *c, const extension *best, const extension *x, int n)
{
  lab_change *change = &c->change[c->n];
  int i;
  change->param = best->param;
  change->begin = best->begin;
  change->end = best->end;
  for (i = 0; i < n; i++)
    if (&x[i] != best && x[i].fitted && bic_of(&x[i]) < bic_of(best) + lab_constant(LAB_ALIKE_BIC))
      change->alike[change->n_alike++] = x[i].param;
  c->shape[c->n++] = best->shape;
  c->u = best->u;
  c->chi2 = best->chi2;
}

/* Chi-square with an effect on both sides; HUGE_VAL where that cannot be fitted. */
static double chi2_of_both(const lab_sides *c, const extension *x, lab_unknowns *both, lab_error *error)
{
  double chi2;
  lab_sides_whole(c, &c->u, both);
  if (lab_unknowns_add(both, x->param, x->u.unknown[lab_sides_find(&x->u, x->param)].value, error) ||
      (x->shape >= 0 &&
       lab_unknowns_add(both, x->shape, x->u.unknown[lab_unknowns_find(&x->u, x->shape)].value, error)) ||
      lab_unknowns_fit(both, LAB_ROUNDS_ALL, &chi2, error))
    return HUGE_VAL;
  return chi2;
}

/* Whether the old logs may have had it as well, because it acts where they have not been: then nothing has changed.
 * In:      x  fitted */
static int was_there(const lab_sides *c, const extension *x, lab_error *all)
{
  lab_error error = {LAB_OK, ""};
  lab_unknowns *both;
  int there;
  if (x->is_course || pneu_effect_of(x->param) < 0 || lab_unknowns_find(&c->u, x->param) >= 0)
    return 0;
  both = malloc(sizeof *both);
  there = both && chi2_of_both(c, x, both, &error) < x->chi2 + lab_constant(LAB_ALIKE_BIC);
  if (!both)
    lab_fail_memory(&error, "a model of both sides");
  lab_fail_together(all, &error);
  if (!there && lab_cpu_is_spent(c->u.until)) {
    lab_fail(all, LAB_NUMERIC, "no time to ask the old logs");
    there = 1;
  }
  free(both);
  return there;
}

/* In:  x  fitted, or NULL */
static int is_change(const lab_sides *c, const extension *x, double level, lab_error *error)
{
  return x && lab_chi2_tail(fmax(c->chi2 - x->chi2, 0), x->n_free) < level && !was_there(c, x, error);
}

/* Refit the leaders, and take up the best of them and of the course.
 * In/out:  course  no longer fitted
 * Out:     taken   0 if no score passes, or if the supply was followed, which hides everything else */
static int take_best(lab_sides *c, const lab_scores *scores, double level, extension *course, int *taken,
                     lab_error *error)
{
  extension *x = calloc(LAB_CHANGE_LEADERS + 1, sizeof *x), *best;
  const extension *leader;
  int i, n = 1, passes;
  *taken = 0;
  if (!x)
    return lab_fail_memory(error, "changes");
  x[0] = *course;
  course->fitted = 0;
  error->status = LAB_OK;
  while (n <= LAB_CHANGE_LEADERS && n <= scores->n && scores->of[n - 1].p_value < level)
    n++;
  if (n > 1)
    refit(c, scores->of, level, NULL, &x[1], error);
  leader = n > 1 && explains(c, &x[1]) ? &x[1] : NULL;
#pragma omp parallel for schedule(dynamic)
  for (i = 2; i < n; i++)
    refit(c, &scores->of[i - 1], level, leader, &x[i], error);
  best = choose(x, n);
  passes = error->status == LAB_OK && is_change(c, best, level, error);
  if (error->status == LAB_NUMERIC && x[0].fitted) { /* a supply that was followed needs no time to try others */
    error->status = LAB_OK;
    best = &x[0];
    passes = is_change(c, best, level, error);
  }
  if (passes) {
    c->followed = best->is_course ? c->chi2 - best->chi2 : 0;
    c->n_followed = best->n_free;
    take(c, best, x, n);
    *taken = !best->is_course;
  }
  free(x);
  return error->status;
}

static int is_in_part(const lab_unknown *x)
{
  return isfinite(x->from) || isfinite(x->to);
}

/* Chi-square without one of the changes, which may differ from day to day all the same. */
static int leave_out(const lab_sides *c, int which, lab_unknowns *u, double *chi2, lab_error *error)
{
  const int param = c->change[which].param, j = lab_sides_find(&c->u, param);
  const lab_repeat *repeat = lab_repeat_find(param);
  int i, k;
  *u = c->u;
  if (repeat && !is_in_part(&u->unknown[j]))
    u->unknown[j].spread = sqrt(2) * lab_repeat_spread(repeat, &u->rig, c->row);
  u->unknown[j].value = 0;
  for (i = k = 0; i < u->n; i++)
    if (i != j || u->unknown[i].spread > 0)
      u->unknown[k++] = u->unknown[i];
  u->n = k;
  if (c->shape[which] >= 0)
    lab_unknowns_drop(u, c->shape[which]);
  return lab_sides_approach(u, chi2, error);
}

/* ---- What is said ---- */

static int by_statistic(const void *a, const void *b)
{
  const double x = ((const lab_change *)a)->statistic, y = ((const lab_change *)b)->statistic;
  return x < y ? 1 : x > y ? -1 : 0;
}

/* The unknown whose value a change is told by: of a supply that was followed, the lowest step. */
static int told_by(const lab_sides *c, const lab_change *change)
{
  int j, at = lab_sides_find(&c->u, change->param);
  for (j = 0; j < c->u.n && c->followed > 0; j++)
    if (c->u.unknown[j].kind == LAB_UNKNOWN_CHANGE && c->u.unknown[j].index == change->param &&
        c->u.unknown[j].value < c->u.unknown[at].value)
      at = j;
  return at;
}

/* Value then and now, with the interval of now: a change of both orifices is a share of what they were. */
static void size_up(const lab_sides *c, const lab_fit_result *fit, lab_change *change)
{
  const int param = change->param, is_share = param == LAB_PARAM_ORIFICE_AREA;
  const int d = told_by(c, change), b = lab_unknowns_find(&c->u, param);
  const double by = c->u.unknown[d].value, half = lab_student_quantile(0.975, (double)INFINITY);
  double unit, kept, variance;
  change->then = b >= 0 ? c->u.unknown[b].value : lab_param_value(&c->u.rig, param);
  unit = is_share ? change->then : 1;
  kept = is_share ? 1 + by : 1; /* of an error of then */
  variance = unit * unit * fit->covariance[d][d];
  if (b >= 0)
    variance += kept * kept * fit->covariance[b][b] + 2 * kept * unit * fit->covariance[b][d];
  change->now = change->then + unit * by;
  change->low = change->now - half * sqrt(fmax(variance, 0));
  change->high = change->now + half * sqrt(fmax(variance, 0));
}

/* A supply that cannot lift the stem moves it as little as none does: where the log does not tell a followed level from
 * the least there can be, with all else fitted again, the interval begins there. */
static int reach_down(const lab_sides *c, lab_change *change, lab_error *error)
{
  const int d = told_by(c, change);
  lab_unknowns *least = malloc(sizeof *least);
  double chi2;
  int status;
  if (!least)
    return lab_fail_memory(error, "a fit");
  *least = c->u;
  least->unknown[d].value = least->unknown[d].upper = least->unknown[d].lower;
  status = lab_unknowns_fit(least, LAB_ROUNDS_ALL, &chi2, error);
  if (status == LAB_OK && chi2 < c->chi2 + lab_chi2_threshold(0.05))
    change->low = fmin(change->low, change->then + least->unknown[d].lower);
  free(least);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Whether a change, sized up, is an effect that was not there before, and of which nobody knows how far it differs by
 * itself: of many one or the other bends to what the model leaves. */
static int is_new(const lab_sides *c, const lab_change *change)
{
  const lab_repeat *repeat = lab_repeat_find(change->param);
  const int j = lab_unknowns_find(&c->u, change->param);
  return pneu_effect_of(change->param) >= 0 && !(repeat && lab_repeat_spread(repeat, &c->u.rig, c->row) > 0) &&
         (change->then == (double)lab_param_info(change->param).neutral ||
          (j >= 0 && lab_unknown_is_held(&c->u.unknown[j])));
}

/* Whether it takes as much off what is left of the new logs as an effect that is added. */
static int is_worth_telling(const lab_rest *left, const lab_change *change)
{
  return change->statistic > 2 * lab_constant(LAB_MIN_GAIN) * left->now * left->now * (double)left->n;
}

/* Whether the logs tell the value of a change from none. */
static int is_known(const lab_sides *c, const lab_fit_result *fit, const lab_change *change)
{
  const int d = told_by(c, change);
  return fabs(c->u.unknown[d].value) > lab_student_quantile(0.975, (double)INFINITY) * sqrt(fit->covariance[d][d]);
}

/* In:      left     of both sides
 * Out:     unknown  whether something has changed of which the logs do not tell the value */
static int describe(lab_sides *c, const lab_rest *left, lab_changes *changes, int *unknown, lab_error *error)
{
  lab_unknowns *without = malloc(sizeof *without);
  lab_fit_result *fit = malloc(sizeof *fit);
  double chi2;
  int i, status = without && fit ? lab_unknowns_intervals(&c->u, fit, error) : lab_fail_memory(error, "changes");
  for (i = 0; i < c->n && status == LAB_OK; i++) {
    lab_change *change = &changes->change[changes->n];
    *change = c->change[i];
    const int followed = c->followed > 0 && i + 1 == c->n;
    int fresh;
    chi2 = c->without_first;
    status = followed || (c->n == 1 && chi2 > 0) ? LAB_OK : leave_out(c, i, without, &chi2, error);
    if (status != LAB_OK)
      break;
    change->statistic = followed ? c->followed : fmax(chi2 - c->chi2, 0);
    change->p_value = lab_chi2_tail(change->statistic, followed ? c->n_followed : c->shape[i] >= 0 ? 2 : 1);
    size_up(c, fit, change);
    if (followed && reach_down(c, change, error)) {
      status = error->status;
      break;
    }
    fresh = is_new(c, change);
    if (!(change->p_value < changes->level) || (fresh && !(change->statistic > lab_constant(LAB_PLAIN_BIC))))
      continue;
    if (followed || (is_known(c, fit, change) && (!fresh || is_worth_telling(left, change))))
      changes->n++;
    else
      *unknown = 1;
  }
  qsort(changes->change, (size_t)changes->n, sizeof *changes->change, by_statistic);
  free(without);
  free(fit);
  return status;
}

static void conclude(const lab_rest *left, int unknown, lab_changes *changes)
{
  static const double stand_ins = 2; /* times the noise: changes that leave so much stand in for others, by judgement */
  changes->then = left->then;
  changes->now = left->now;
  changes->condition = changes->n      ? LAB_SINCE_CHANGED
                       : *changes->why ? LAB_SINCE_CANNOT_TELL /* the time is spent */
                                       : LAB_SINCE_UNCHANGED;
  if (lab_rest_is_doubtful(left)) {
    if (left->now > stand_ins * fmax(left->then, 1))
      changes->n = 0;
    if (!changes->n)
      changes->condition = LAB_SINCE_CANNOT_TELL;
    snprintf(changes->why, sizeof changes->why,
             "what the model of the baseline leaves of the new log, %.2f times the noise, is more than it leaves of "
             "the baseline, %.2f times, and no change in the list explains it",
             changes->now, changes->then);
  } else if (!changes->n && lab_rest_spoils_baseline(left)) {
    changes->condition = LAB_SINCE_CANNOT_TELL;
    snprintf(
        changes->why, sizeof changes->why,
        "a model of both leaves %.2f times the noise of the baseline, and no change in the list explains the new log",
        changes->then);
  } else if (!changes->n && !*changes->why && (unknown || lab_rest_is_strained(left))) {
    changes->condition = LAB_SINCE_CANNOT_TELL;
    snprintf(
        changes->why, sizeof changes->why,
        unknown
            ? "something may have, but the logs do not tell the value of what would explain it, or that is too small"
            : "something has, as values differ by more than from day to day, and the logs do not tell which");
  }
}

/* Whether a comparison failed for want of time. */
static int is_out_of_time(const lab_sides *c, int status)
{
  return status == LAB_NUMERIC && lab_cpu_is_spent(c->u.until);
}

/* What was found when the time ended is told.  Returns: status */
static int end_with_found(const lab_sides *c, int status, lab_changes *changes)
{
  if (c->n == 0 || !is_out_of_time(c, status))
    return status;
  snprintf(changes->why, sizeof changes->why, "the comparison was ended by --budget: more may have changed");
  return LAB_OK;
}

/* Take up one change after the other. A supply that was followed is one even if there is no time to try others.
 * In/out:  course  the followed supply, fitted or not */
static int take_all(lab_sides *c, double alpha, extension *course, lab_changes *changes, lab_error *error)
{
  int taken = 1;
  while (taken && c->n < LAB_CHANGES_MAX) {
    lab_scores scores;
    const int status = lab_change_scores(c, &scores, error);
    if (status != LAB_OK && !(status == LAB_NUMERIC && course->fitted))
      return end_with_found(c, status, changes);
    if (!changes->tests) {
      changes->tests = scores.tests;
      changes->level = alpha / (scores.tests ? scores.tests : 1);
    }
    if (take_best(c, &scores, changes->level, course, &taken, error))
      return end_with_found(c, error->status, changes);
  }
  return LAB_OK;
}

/* Whether anything may have changed: what a model lacks that does not explain the baseline, any change takes off a
 * little of, so that of the new logs such a model has to leave more. */
static int may_have_changed(const lab_sides *c, lab_error *error)
{
  lab_rest left;
  return c->decided || lab_sides_rest(&c->u, c->first, &left, error) || lab_rest_is_more_than_noise(&left) ||
         lab_rest_is_strained(&left);
}

/* The level of one test where there are as many as there may be. */
static double most_tests(double alpha)
{
  return alpha / (LAB_SCORES_MAX * LAB_ONSET_PLACES);
}

/* Whether what was taken up first explains more than what may differ from day to day does without it: else the model is
 * the one without it, fitted. Where that cannot be fitted, or the time ends, it stays.
 * In:      n_free  what it added to the fit
 * In/out:  c       with one change */
static int stands_alone(lab_sides *c, double level, int n_free)
{
  lab_error error = {LAB_OK, ""};
  lab_unknowns *without = malloc(sizeof *without);
  double chi2;
  const int fitted = without && leave_out(c, 0, without, &chi2, &error) == LAB_OK && !lab_cpu_is_spent(c->u.until);
  const int stands = !fitted || lab_chi2_tail(fmax(chi2 - c->chi2, 0), n_free) < level;
  if (fitted && stands)
    c->without_first = chi2;
  if (!stands) {
    c->u = *without;
    c->chi2 = chi2;
    c->n = 0;
    memset(&c->change[0], 0, sizeof c->change[0]);
  }
  free(without);
  return stands;
}

/* Name the other effects that explain as much as a suspect. */
static void list_alike(const lab_suspect *s, lab_change *change)
{
  int k, count;
  for (k = 0; s->found && k < s->found->n_alike && k < LAB_CHANGE_LEADERS; k++)
    change->alike[change->n_alike++] = pneu_effect_params(s->found->alike[k], &count);
}

/* Take up the first suspect that explains the new logs.
 * Out:  taken
 *       without  whether `c` is the model without any, fitted: one explained them that a day's differences do as well
 */
static int take_suspect(lab_sides *c, const lab_comparison *of, int *taken, int *without, lab_error *error)
{
  const double level = most_tests(of->alpha);
  extension *x = calloc(1, sizeof *x);
  int i;
  *taken = *without = 0;
  if (!x)
    return lab_fail_memory(error, "changes");
  error->status = LAB_OK;
  for (i = 0; i < of->n_suspects && !*taken && !*without && error->status == LAB_OK; i++) {
    const lab_suspect *s = &of->suspect[i];
    x->u = c->u;
    refit_from(c, &s->score, s->score.size, level, NULL, x, error);
    if (!explains(c, x) || !is_change(c, x, level, error))
      continue;
    take(c, x, NULL, 0);
    list_alike(s, &c->change[0]);
    *taken = stands_alone(c, level, x->n_free);
    *without = !*taken;
  }
  free(x);
  return error->status;
}

static int compare(lab_sides *c, const lab_comparison *of, lab_changes *changes, lab_error *error)
{
  extension *course = malloc(sizeof *course);
  lab_rest left;
  int unknown = 0, taken = 0, without = 0,
      status = course ? follow(c, course, error) : lab_fail_memory(error, "a course");
  if (status == LAB_OK && !course->fitted)
    status = take_suspect(c, of, &taken, &without, error);
  if (status == LAB_OK && !taken && !without)
    status = lab_sides_approach(&c->u, &c->chi2, error);
  if ((status == LAB_OK && (taken || course->fitted || may_have_changed(c, error))) ||
      (status == LAB_NUMERIC && course->fitted))
    status = take_all(c, of->alpha, course, changes, error);
  free(course);
  if (status != LAB_OK)
    return status;
  c->u.until = 0; /* what was found is sized in any case */
  if (lab_sides_rest_of_all(c, &c->u, c->run, &left, error) || describe(c, &left, changes, &unknown, error))
    return error->status;
  conclude(&left, unknown, changes);
  return LAB_OK;
}

int lab_changes_find(const lab_comparison *of, lab_changes *changes, lab_error *error)
{
  lab_sides *c = calloc(1, sizeof *c);
  int status = c ? lab_sides_join(of, c, error) : lab_fail_memory(error, "a comparison");
  memset(changes, 0, sizeof *changes);
  changes->level = most_tests(of->alpha);
  if (status == LAB_OK)
    status = compare(c, of, changes, error);
  if (c && is_out_of_time(c, status)) {
    snprintf(changes->why, sizeof changes->why, "the comparison was ended by --budget");
    status = LAB_OK;
  }
  if (c)
    lab_linear_close(&c->old);
  free(c);
  return status;
}
