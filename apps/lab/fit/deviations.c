#include "deviations.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"
#include "../rig/tolerance.h"

const char *lab_condition_text(int condition)
{
  static const char *const words[] = {"cannot tell", "as declared", "deviates"};
  return words[condition];
}

static const double one_in_twenty = 0.05;

static int param_of(const lab_unknowns *u, const lab_unknown *x)
{
  return x->kind == LAB_UNKNOWN_ONSET ? u->rig.onset[x->index].param : x->index;
}

/* Whether an unknown is the vent beside the fill orifice where nothing says how well their ratio is known: an effect.
 */
static int is_free_vent(const lab_rig *rig, const lab_unknown *x)
{
  return lab_param_is_vents_share(x->index) && !(lab_tolerance(rig, x->index) > 0);
}

/* Whether a parameter that begins to be another is a declared value, and no effect that begins. */
static int is_value(int param)
{
  const int positioner = pneu_effect_find("positioner");
  return lab_param_is_value(param) || (positioner >= 0 && pneu_effect_of(param) == positioner);
}

/* Whether unknown j is a declared value, and not a part of what was added; of two in a row the later one. */
static int is_declared(const lab_rig *rig, const lab_unknowns *u, int j)
{
  const lab_unknown *x = &u->unknown[j];
  if (x->kind == LAB_UNKNOWN_ONSET)
    return is_value(param_of(u, x));
  if (lab_unknowns_find_onset(u, x->index) >= 0)
    return 0;
  return x->kind == LAB_UNKNOWN_PARAM && x->run == LAB_ALL_RUNS && lab_tolerance_name(x->index) &&
         !is_free_vent(rig, x) && (lab_rig_fits(rig, x->index) || lab_unknown_is_held(x) || lab_unknown_is_let_go(x));
}

static double declared_of(const lab_unknowns *u, const lab_unknown *x)
{
  const int param = param_of(u, x);
  return param == LAB_PARAM_ORIFICE_AREA ? 1 : (double)*pneu_param_at((pneu_params *)&u->declared, param);
}

/* Whether unknown j is a lag of the only sensor, of half a row at most: a logger that writes each change of the command
 * with the row at which it is made looks like that beside one whose commands change anywhere between two rows. */
static int is_of_the_logger(const lab_unknowns *u, int j)
{
  const lab_unknown *x = &u->unknown[j];
  double row = 0;
  int i;
  if (x->kind != LAB_UNKNOWN_PARAM || !lab_param_is_of_sensor(x->index) || strcmp(x->unit, "s") != 0 ||
      u->n_runs == 0 || u->run->n_channels > 1)
    return 0;
  for (i = 0; i < u->n; i++)
    if (u->unknown[i].kind == LAB_UNKNOWN_INSTANT && u->unknown[i].index != LAB_ALL_INSTANTS)
      row = fmax(row, u->unknown[i].upper - u->unknown[i].lower);
  return fabs(x->value) < row / 2;
}

/* The p-value of unknown j being as declared, by the side of its interval that the declared value is on. */
static double chance(const lab_unknowns *u, const lab_fit_result *fit, int j)
{
  const lab_unknown *x = &u->unknown[j];
  const double off = x->value - declared_of(u, x), half = off > 0 ? x->value - fit->low[j] : fit->high[j] - x->value;
  if (fit->state[j] == LAB_STATE_UNDETERMINED || !(off != 0) || is_of_the_logger(u, j))
    return 1;
  return lab_chi2_tail(off * off / (half * half) * lab_chi2_threshold(one_in_twenty), 1);
}

/* The p-value up to which a log tells a value from the declared one: of those told one in twenty is as declared
 * (Benjamini and Hochberg 1995), where all are, any is told once in twenty. */
static double told_up_to(const lab_rig *rig, const lab_unknowns *u, const lab_fit_result *fit)
{
  double p[LAB_FIT_MAX];
  int j, n = 0, k;
  for (j = 0; j < u->n; j++)
    if (is_declared(rig, u, j))
      p[n++] = chance(u, fit, j);
  lab_sort(p, (size_t)n);
  for (k = n; k > 0 && p[k - 1] > one_in_twenty * k / n; k--)
    ;
  return k > 0 ? p[k - 1] : -1;
}

double lab_earlier_factor(const lab_unknowns *u, const lab_unknown *x)
{
  const int j = x->kind == LAB_UNKNOWN_ONSET && u->rig.onset[x->index].param == LAB_PARAM_ORIFICE_AREA
                    ? lab_unknowns_find(u, LAB_PARAM_ORIFICE_AREA)
                    : -1;
  return j < 0 ? 1 : u->unknown[j].value;
}

/* Whether a value is plainly beyond its tolerance: one that is known to no better than half of that, only where all of
 * its interval is. */
static int is_beyond(const lab_deviation *d, double tolerance)
{
  static const double known = 0.5; /* of the tolerance, by judgement */
  const double off = fabs(d->found - d->declared);
  const double least = d->found > d->declared ? d->lower - d->declared : d->declared - d->upper;
  return off > tolerance && (off - least <= known * tolerance || least > tolerance);
}

/* What is not known of the other one of two values that act as one. */
static double beside(const lab_rig *rig, int param)
{
  const int twin = lab_param_twin(param);
  return twin < 0 ? 0 : lab_tolerance(rig, twin);
}

/* The deviation of unknown j.  Returns: its size over the tolerance */
static double compare(const lab_rig *rig, const lab_unknowns *u, const lab_fit_result *fit, int j, lab_deviation *d)
{
  const lab_unknown *x = &u->unknown[j];
  const int param = d->param = param_of(u, x);
  const double tolerance = (x->tolerance > 0 ? x->tolerance : lab_tolerance(rig, param)) +
                           (x->kind == LAB_UNKNOWN_PARAM ? beside(rig, param) : 0);
  const double unit = lab_earlier_factor(u, x);
  d->declared = lab_param_value(rig, param);
  snprintf(d->name, sizeof d->name, "%s", lab_tolerance_name(param));
  snprintf(d->unit, sizeof d->unit, "%s", x->unit);
  d->found = unit * x->value;
  d->lower = unit * fit->low[j];
  d->upper = unit * fit->high[j];
  d->ratio = d->declared != 0 ? d->found / d->declared : (double)NAN;
  d->tolerance = d->declared != 0 ? tolerance / fabs(d->declared) : tolerance;
  d->held = lab_unknown_is_held(x) || lab_unknown_is_let_go(x);
  d->beyond = is_beyond(d, tolerance);
  return tolerance > 0 ? fabs(d->found - d->declared) / tolerance : (double)INFINITY;
}

int lab_deviation_of(const lab_rig *rig, const lab_unknowns *u, const lab_fit_result *fit, int j, lab_deviation *d)
{
  if (!is_declared(rig, u, j))
    return 0;
  compare(rig, u, fit, j, d);
  return 1;
}

/* What is told first: what begins within the log, then values of the rig, then its instruments; the largest of each. */
enum { BEGINS, VALUE, INSTRUMENT };

typedef struct ranked {
  int rank;
  double size;
  lab_deviation deviation;
} ranked;

static int rank_of(const lab_unknown *x, const lab_deviation *d)
{
  return x->kind == LAB_UNKNOWN_ONSET ? BEGINS : lab_param_is_of_sensor(d->param) ? INSTRUMENT : VALUE;
}

static int first_told(const void *a, const void *b)
{
  const ranked *x = a, *y = b;
  return x->rank != y->rank ? x->rank - y->rank : (x->size < y->size) - (x->size > y->size);
}

/* Whether a value is to be told: where a model lacks something, one that goes to its end or far from its sheet makes up
 * for that. */
static int is_trusted(const lab_fit_result *fit, int j, double tolerances, double trusted)
{
  return !isfinite(trusted) || (fit->state[j] == LAB_STATE_FREE && tolerances < trusted);
}

int lab_deviations_find(const lab_rig *rig, const lab_unknowns *u, const lab_fit_result *fit, double trusted,
                        lab_deviations *all, lab_error *error)
{
  ranked *found = calloc((size_t)u->n + 1, sizeof *found);
  const double limit = told_up_to(rig, u, fit);
  int j, n = 0;
  if (!found)
    return lab_fail_memory(error, "deviations");
  memset(all, 0, sizeof *all);
  for (j = 0; j < u->n; j++) {
    lab_deviation *d = &found[n].deviation;
    if (!is_declared(rig, u, j))
      continue;
    all->condition = all->condition == LAB_CONDITION_DEVIATES ? all->condition : (int)LAB_CONDITION_AS_DECLARED;
    found[n].size = compare(rig, u, fit, j, d);
    found[n].rank = rank_of(&u->unknown[j], d);
    if (chance(u, fit, j) > limit || !is_trusted(fit, j, found[n].size, trusted))
      continue;
    if (d->beyond)
      all->condition = LAB_CONDITION_DEVIATES;
    n++;
  }
  qsort(found, (size_t)n, sizeof *found, first_told);
  for (j = 0; j < n && j < LAB_DEVIATIONS_MAX; j++)
    all->of[all->n++] = found[j].deviation;
  free(found);
  return LAB_OK;
}

/* ---- Without some unknowns ---- */

/* The unknowns with these at their declared values, and not to be fitted.  Returns: how many these are */
static int leave_out(const lab_unknowns *u, const unsigned char *as_declared, lab_unknowns *less)
{
  int j;
  *less = *u;
  for (j = 0; j < u->n; j++)
    if (as_declared[j])
      less->unknown[j].value = declared_of(u, &u->unknown[j]);
  lab_unknowns_take(less);
  for (j = less->n = 0; j < u->n; j++)
    if (!as_declared[j])
      less->unknown[less->n++] = u->unknown[j];
  lab_unknowns_count(less);
  return u->n - less->n;
}

/* ---- How far the intervals reach ---- */

/* The others as they follow where unknown j goes to its declared value. */
static void follow(const lab_unknowns *u, const lab_fit_result *fit, int j, lab_unknowns *less)
{
  const double share = (declared_of(u, &u->unknown[j]) - u->unknown[j].value) / fit->covariance[j][j];
  int k;
  for (k = 0; k < less->n; k++) {
    lab_unknown *x = &less->unknown[k];
    x->value = fmin(fmax(x->value + share * fit->covariance[k + (k >= j)][j], x->lower), x->upper);
  }
  lab_unknowns_take(less);
}

/* Make the interval of unknown j wider until the parabola rises no more than chi-square does on the way to the declared
 * value; where the time is spent the others are not fitted there.
 * In:      u      with slopes that it keeps
 *          least  chi-square of the fit, followed as closely as fits do, and not as intervals do */
static int widen(const lab_unknowns *u, int j, double least, lab_unknowns *less, lab_fit_result *fit, lab_error *error)
{
  enum { STEPS = 3 };
  const lab_unknown *x = &u->unknown[j];
  const double off = declared_of(u, x) - x->value, expected = off * off / fit->covariance[j][j];
  unsigned char only[LAB_FIT_MAX] = {0};
  double chi2, wider;
  int status;
  only[j] = 1;
  leave_out(u, only, less);
  follow(u, fit, j, less);
  status = lab_unknowns_keep_slopes(less, error);
  if (status == LAB_OK) {
    lab_unknowns_begin_with(less, u);
    status = lab_unknowns_fit(less, STEPS, &chi2, error);
  }
  lab_unknowns_forget_slopes(less);
  if (status != LAB_OK)
    return status;
  wider = sqrt(expected / fmax((chi2 - least) / fmax(fit->reduced_chi2, 1), 1));
  if (wider > 1) {
    fit->low[j] = fmax(x->value - wider * (x->value - fit->low[j]), x->lower);
    fit->high[j] = fmin(x->value + wider * (fit->high[j] - x->value), x->upper);
  }
  return LAB_OK;
}

/* Whether the interval of an unknown leaves out its declared value. */
static int leaves_out(const lab_unknowns *u, const lab_fit_result *fit, int j)
{
  return u->unknown[j].kind == LAB_UNKNOWN_PARAM && is_declared(&u->rig, u, j) && fit->covariance[j][j] > 0 &&
         chance(u, fit, j) <= told_up_to(&u->rig, u, fit);
}

int lab_deviations_widen(const lab_unknowns *u, lab_fit_result *fit, lab_error *error)
{
  lab_unknowns *all, *less;
  double least;
  int j = 0, status;
  while (j < u->n && !leaves_out(u, fit, j))
    j++;
  if (j == u->n)
    return LAB_OK;
  all = malloc(sizeof *all);
  less = malloc(sizeof *less);
  status = all && less ? lab_unknowns_chi2(u, &least, error) : lab_fail_memory(error, "a fit");
  if (status == LAB_OK) {
    *all = *u;
    if (lab_unknowns_keep_slopes(all, error) || lab_unknowns_find_slopes(all, error))
      status = error->status;
    for (; j < u->n && status != LAB_WORLD; j++)
      if (leaves_out(u, fit, j))
        status = widen(all, j, least, less, fit, error);
    lab_unknowns_forget_slopes(all);
  }
  free(all);
  free(less);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* ---- What is as declared, after all ---- */

/* Which unknowns are held, and as declared as far as the log tells. */
static void find_as_declared(const lab_unknowns *u, const lab_fit_result *fit, unsigned char is[LAB_FIT_MAX])
{
  const double limit = told_up_to(&u->rig, u, fit);
  int j;
  for (j = 0; j < u->n; j++)
    is[j] = lab_unknown_is_held(&u->unknown[j]) && chance(u, fit, j) > limit;
}

/* Whether no value that stays has to give for those that went back, by what matters beside its interval and its
 * tolerance: in sound logs of set position and travel friction took up what a dead volume 15 % off its sheet did. */
static int stay(const lab_unknowns *u, const lab_fit_result *fit, const unsigned char *as_declared,
                const lab_unknowns *less)
{
  static const double of_interval = 0.25, of_tolerance = 0.1; /* by judgement */
  int j, k = 0, all = 1;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    const double off = as_declared[j] ? 0 : fabs(less->unknown[k++].value - x->value);
    all &= x->kind != LAB_UNKNOWN_PARAM || off <= of_interval * (fit->high[j] - fit->low[j]) ||
           off <= of_tolerance * lab_tolerance(&u->rig, x->index);
  }
  return all;
}

/* The values of fewer unknowns, and the declared ones, for all of them. */
static void take_values(const lab_unknowns *less, const unsigned char *as_declared, lab_unknowns *u,
                        lab_fit_result *fit)
{
  int j, k = 0;
  for (j = 0; j < u->n; j++) {
    lab_unknown *x = &u->unknown[j];
    const double value = as_declared[j] ? x->prior : less->unknown[k++].value;
    fit->low[j] += value - x->value;
    fit->high[j] += value - x->value;
    x->value = value;
  }
  lab_unknowns_take(u);
}

int lab_deviations_forget(lab_unknowns *u, double *chi2, lab_fit_result *fit, lab_error *error)
{
  static const double together = 0.05; /* p-value below which they are not as declared */
  lab_unknowns *less = malloc(sizeof *less);
  unsigned char as_declared[LAB_FIT_MAX];
  double without;
  int status, n;
  if (!less)
    return lab_fail_memory(error, "a fit");
  find_as_declared(u, fit, as_declared);
  n = leave_out(u, as_declared, less);
  status = n > 0 ? lab_unknowns_fit(less, LAB_ROUNDS_ALL, &without, error) : (int)LAB_NUMERIC;
  if (status == LAB_OK && lab_chi2_tail(fmax(without - *chi2, 0), n) > together && stay(u, fit, as_declared, less)) {
    take_values(less, as_declared, u, fit);
    *chi2 = without;
  }
  free(less);
  return status == LAB_NUMERIC ? LAB_OK : status;
}
