#include "refill.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../base/quantile.h"
#include "../fit/beginning.h"
#include "resume.h"

/* Sizes that are tried, as shares of the fill orifice: from 1/2048 to 1/2, each 1.4 times the one before. */
enum { SIZES = 21, SMALLEST = -11, FITTED = 4, STEPS = 30 };

typedef struct trial {
  double size, chi2; /* [m2] of the leak; of the declared model with it */
} trial;

int lab_refill_is_asked(const lab_unknowns *u)
{
  return u->n_runs == 1 && u->window == 0 && u->run->log->value[LAB_CHANNEL_SP] && lab_rig_has_positioner(&u->rig) &&
         pneu_effect_find("chamber_leak") >= 0;
}

static int by_chi2(const void *x, const void *y)
{
  const double a = ((const trial *)x)->chi2, b = ((const trial *)y)->chi2;
  return a < b ? -1 : a > b;
}

static double size_of(const lab_candidate *c, int k)
{
  return (double)c->u.rig.params.fill_area * pow(2, SMALLEST + 0.5 * k);
}

static int add_leak(lab_candidate *c, double size, lab_error *error)
{
  const lab_score leak = {
      .effect = pneu_effect_find("chamber_leak"), .param = pneu_param_find("leak_area"), .shape = -1};
  return lab_candidate_add_effect(c, &leak, size, error);
}

/* Whether something may be missing: more than noise is left, or values far off their sheet stand in for it. */
static int is_off(const lab_quality *within)
{
  return within->fitted && (lab_is_plainly_off(within) || lab_is_strained(within));
}

/* When a share of the time is spent: what else may be missing needs the rest. */
static double share_of_time(double until, double share)
{
  const double now = lab_cpu_time();
  return until > 0 ? now + share * (until - now) : 0;
}

/* All sizes, the nearest first. */
static void try_sizes(const lab_candidate *declared, trial *t)
{
  lab_candidate c;
  lab_error ignored;
  int k;
  for (k = 0; k < SIZES; k++) {
    c = *declared;
    t[k].size = size_of(&c, k);
    if (add_leak(&c, t[k].size, &ignored) || lab_unknowns_chi2(&c.u, &t[k].chi2, &ignored))
      t[k].chi2 = HUGE_VAL;
  }
  qsort(t, SIZES, sizeof *t, by_chi2);
}

/* The row from which all acts that a candidate has. */
static size_t row_of_last(const lab_candidate *c)
{
  const lab_run *x = c->u.run;
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  const int n = c->u.rig.n_onsets;
  size_t row = 0;
  while (n > 0 && row < x->n && t[row] < c->u.rig.onset[n - 1].from)
    row++;
  return row;
}

int lab_refill_fit(lab_candidate *c, lab_error *error)
{
  static const double share[] = {0.12, 0.25, 0.5};
  const lab_run *whole = c->u.run;
  const size_t row = row_of_last(c);
  int status = LAB_OK;
  size_t i;
  for (i = 0; i < sizeof share / sizeof *share && status == LAB_OK; i++) {
    lab_run part = {0};
    status = lab_beginning_open(whole, row + (size_t)(share[i] * (double)(whole->n - row)), &part, error);
    c->u.run = &part;
    lab_unknowns_view(&c->u, 0);
    if (status == LAB_OK)
      status = lab_candidate_fit(c, STEPS, error);
    lab_beginning_close(&part);
    c->u.run = whole;
    lab_unknowns_view(&c->u, 0);
  }
  if (status == LAB_OK)
    status = lab_candidate_fit_held(c, error);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Whether a leak explains the logs, or nearly all of what values off their sheet leave. */
static int is_better(const lab_quality *leaks, const lab_quality *within)
{
  static const double nearly = 0.05;
  const int explains = lab_is_noise(leaks) || leaks->chi2 - leaks->values < nearly * (within->chi2 - within->values);
  return leaks->fitted && leaks->bic < within->bic && explains && (!lab_is_noise(within) || !lab_is_strained(leaks));
}

/* The best from the nearest sizes, until one leaves clearly no more than noise.
 * In:      within    the declared model within its tolerances, fitted
 *          declared  it before any fit
 * Out:     leaks     not fitted if none explains the logs */
static int fit_sizes(const lab_quality *within, const lab_candidate *declared, const trial *t, lab_candidate *leaks,
                     lab_error *error)
{
  lab_candidate c;
  int k, status = LAB_OK;
  for (k = 0; k < FITTED && status == LAB_OK && !lab_is_clean(&leaks->quality) && !lab_cpu_is_spent(declared->u.until);
       k++) {
    c = *declared;
    c.quality.fitted = 0;
    if (isfinite(t[k].chi2) && add_leak(&c, t[k].size, error) == LAB_OK)
      status = lab_refill_fit(&c, error);
    if (is_better(&c.quality, within) && lab_candidate_by_bic(&c, leaks) < 0)
      *leaks = c;
  }
  return status;
}

/* Whether any leak comes nearer to the logs than none.
 * In:      declared  within its tolerances, as they were before any fit
 * Out:     t         all sizes, the nearest first */
static int comes_nearer(const lab_candidate *declared, trial *t, lab_error *error)
{
  static const double nearer = 0.98;
  double none;
  if (lab_unknowns_chi2(&declared->u, &none, error))
    return 0;
  try_sizes(declared, t);
  return t[0].chi2 < nearer * none;
}

/* Look for a leak.
 * In:      within  the declared model within its tolerances, fitted
 * Out:     leaks   not fitted where no leak leaves only noise */
static int find(const lab_candidate *within, lab_candidate *leaks, lab_error *error)
{
  trial t[SIZES];
  lab_candidate *declared = malloc(sizeof *declared);
  int status = declared ? LAB_OK : lab_fail_memory(error, "a candidate");
  leaks->quality.fitted = 0;
  if (status == LAB_OK) {
    *declared = *within;
    lab_unknowns_undo_fit(&declared->u);
    declared->u.until = share_of_time(within->u.until, 0.25);
    if (comes_nearer(declared, t, error))
      status = fit_sizes(&within->quality, declared, t, leaks, error);
    leaks->u.until = lab_is_noise(&leaks->quality) ? within->u.until : share_of_time(within->u.until, 0.5);
  }
  free(declared);
  return status;
}

int lab_refill_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                      lab_error *error)
{
  lab_finding *leaks = malloc(sizeof *leaks), *whole = malloc(sizeof *whole);
  int status = leaks && whole ? LAB_OK : lab_fail_memory(error, "the search");
  *done = 0;
  if (status == LAB_OK)
    status = lab_candidate_hold_once(u, f->held, error);
  if (status == LAB_OK && is_off(&f->held->quality)) {
    *leaks = *whole = *f;
    leaks->declared = *f->held;
    status = find(&leaks->declared, &leaks->best, error);
    if (status == LAB_OK && leaks->best.quality.fitted) {
      status = lab_resume(u, options, leaks, whole, error);
      *done = status == LAB_OK && lab_is_noise(&whole->best.quality);
    }
  }
  if (*done)
    *f = *whole;
  free(leaks);
  free(whole);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Chi-square with a leak that begins at some time [s]. */
static double chi2_since(const lab_candidate *base, double size, double from)
{
  lab_candidate c = *base;
  lab_error ignored;
  double chi2;
  if (lab_unknowns_add_onset(&c.u, pneu_param_find("leak_area"), from, size, &ignored) ||
      lab_unknowns_chi2(&c.u, &chi2, &ignored))
    return HUGE_VAL;
  return chi2;
}

void lab_refill_score(const lab_candidate *base, size_t row, lab_onset_scores *begins)
{
  const lab_run *x = base->u.run;
  const double from = x->log->value[LAB_CHANNEL_TIME][x->first + row];
  const int leak = pneu_param_find("leak_area");
  lab_score *score = NULL, first;
  lab_error ignored;
  double none, least;
  int i, k;
  if (lab_unknowns_chi2(&base->u, &none, &ignored))
    return;
  for (i = 0, least = none; i < begins->n; i++)
    score = begins->of[i].param == leak ? &begins->of[i] : score;
  for (k = 0; score && k < SIZES; k++) {
    const double chi2 = chi2_since(base, size_of(base, k), from);
    if (chi2 < least) {
      least = chi2;
      score->size = size_of(base, k);
    }
  }
  if (!score || !(none - least > begins->of[0].statistic))
    return;
  score->statistic = none - least;
  score->p_value = lab_chi2_tail(score->statistic, 1);
  score->onset = row;
  first = *score;
  memmove(begins->of + 1, begins->of, (size_t)(score - begins->of) * sizeof first);
  begins->of[0] = first;
}
