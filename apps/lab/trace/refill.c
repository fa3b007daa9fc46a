#include "refill.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../base/quantile.h"
#include "contest.h"
#include "forces.h"
#include "onset_sizes.h"
#include "resume.h"
#include "standing.h"

/* Sizes that are tried: shares of the fill orifice from 1/2048 to 1/2, each 1.4 times the one before; where a leak
 * shows, every other one of these, and CLOSE sizes from 0.75 to 1.3 times that. */
enum { SIZES = 21, SMALLEST = -11, CLOSE = 11, FITTED = 4, STEPS = 30 };

typedef struct trial {
  int leak;    /* a parameter, its size */
  double size; /* in its unit */
  double chi2; /* of the model with it, infinite where it was not tried */
} trial;

int lab_refill_loops(const lab_unknowns *u)
{
  return u->n_runs == 1 && u->window == 0 && lab_log_command(u->run->log) == LAB_CHANNEL_SP &&
         lab_rig_has_positioner(&u->rig) && pneu_effect_find("chamber_leak") >= 0;
}

int lab_refill_is_asked(const lab_unknowns *u)
{
  return lab_refill_loops(u) && lab_score_lacks(u, pneu_effect_find("chamber_leak"));
}

static int by_chi2(const void *x, const void *y)
{
  const double a = ((const trial *)x)->chi2, b = ((const trial *)y)->chi2;
  return a < b ? -1 : a > b;
}

static int add_leak(lab_candidate *c, const trial *t, lab_error *error)
{
  const lab_score leak = {.effect = pneu_effect_of(t->leak), .param = t->leak, .shape = -1};
  return lab_candidate_add_effect(c, &leak, t->size, error);
}

/* Whether something may be missing: more than noise is left, or values far off their sheet stand in for it. */
static int is_off(const lab_quality *within)
{
  return within->fitted && (lab_is_plainly_off(within) || lab_is_strained(within));
}

/* The leak that the log shows while the pressure falls though the positioner would not vent, of the kind that is most
 * alike in all of it.  Out: size  0: none shows */
static int leak_that_shows(const lab_unknowns *model, double since, double *size)
{
  static const char *const kinds[] = {"leak_area", "laminar_leak"};
  double least = 0.5, scatter; /* of its size: where stretches are less alike no leak makes them, by judgement */
  int leak = pneu_param_find(kinds[0]);
  size_t k;
  *size = 0;
  for (k = 0; k < sizeof kinds / sizeof *kinds; k++) {
    const int of = pneu_param_find(kinds[k]);
    double seen;
    if (of < 0 || !lab_score_lacks(model, pneu_effect_of(of)))
      continue;
    seen = lab_standing_leak(model, of, since, &scatter);
    if (!(scatter < least))
      continue;
    least = scatter;
    leak = of;
    *size = seen;
  }
  return leak;
}

/* Size k where a leak of some size shows, or none does: sizes far between are out of step with how often the positioner
 * makes up for it. */
static double size_of(const lab_unknowns *model, double seen, int k)
{
  if (seen > 0 && k < CLOSE)
    return seen * pow(2, (k - CLOSE / 2) / 12.);
  return (double)model->rig.params.fill_area * pow(2, SMALLEST + (seen > 0 ? k - CLOSE + 1 : 0.5 * k));
}

/* All sizes, the nearest first; as far as there is time. */
static int try_sizes(const lab_unknowns *model, double since, trial *t, lab_error *error)
{
  double seen;
  const int shows = leak_that_shows(model, since, &seen), hole = pneu_param_find("leak_area");
  int k, status = LAB_OK;
  for (k = 0; k < SIZES && status == LAB_OK; k++) {
    t[k] = (trial){seen > 0 && k < CLOSE ? shows : hole, size_of(model, seen, k), HUGE_VAL};
    if (!lab_cpu_is_spent(model->until))
      status = lab_onset_try(model, t[k].leak, since, t[k].size, &t[k].chi2, error);
  }
  if (status == LAB_OK)
    qsort(t, SIZES, sizeof *t, by_chi2);
  return status;
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
  const size_t from = row_of_last(c), rest = c->u.run->n - from;
  int status = LAB_OK;
  size_t i;
  for (i = 0; i < sizeof share / sizeof *share && status == LAB_OK; i++)
    status = lab_candidate_fit_beginning(c, from + (size_t)ceil(share[i] * (double)rest), STEPS, error);
  return status == LAB_OK ? lab_candidate_fit_held(c, error) : status;
}

/* Whether a leak explains the logs, or nearly all of what values off their sheet leave. */
static int is_better(const lab_quality *leaks, const lab_quality *within)
{
  static const double nearly = 0.05;
  const int explains = lab_is_noise(leaks) || leaks->chi2 - leaks->values < nearly * (within->chi2 - within->values);
  return leaks->fitted && leaks->bic < within->bic && explains && (!lab_is_noise(within) || !lab_is_strained(leaks));
}

/* What the leak takes off chi-square is the best of many sizes. */
static void note_score(const lab_quality *within, lab_candidate *leaks)
{
  lab_found *found = &leaks->found[leaks->n_found - 1];
  found->statistic = fmax(within->chi2 - leaks->quality.chi2, 0);
  found->p_value = fmin(1, SIZES * lab_chi2_tail(found->statistic, 1));
}

/* The best from the nearest sizes, until one leaves clearly no more than noise.
 * In:      within    the declared model within its tolerances, fitted
 *          declared  it before any fit
 * In/out:  leaks     not fitted; so it stays where none explains the logs, or nearly */
static int fit_sizes(const lab_quality *within, const lab_candidate *declared, const trial *t, lab_candidate *leaks,
                     lab_error *error)
{
  lab_candidate c;
  int k, status = LAB_OK;
  for (k = 0; k < FITTED && status == LAB_OK && !lab_is_clean(&leaks->quality) && !lab_cpu_is_spent(declared->u.until);
       k++) {
    c = *declared;
    c.quality.fitted = 0;
    if (isfinite(t[k].chi2) && add_leak(&c, &t[k], error) == LAB_OK)
      status = lab_refill_fit(&c, error);
    if (is_better(&c.quality, within) && lab_candidate_by_bic(&c, leaks) < 0)
      *leaks = c;
  }
  return status;
}

/* Look for a leak where one comes nearer to the logs than none.
 * In:      within  the declared model within its tolerances, fitted
 * Out:     leaks   not fitted where none explains the logs, or nearly */
static int find(const lab_candidate *within, lab_candidate *leaks, lab_error *error)
{
  /* sixteen logs behind a positioner: 0.05 to 0.93 times as much with a leak, 0.89 to 1.04 without */
  static const double nearer = 0.98;
  trial t[SIZES];
  lab_candidate *declared = malloc(sizeof *declared);
  double none = 0;
  int status = declared ? LAB_OK : lab_fail_memory(error, "a candidate");
  leaks->quality.fitted = 0;
  if (status == LAB_OK) {
    *declared = *within;
    lab_unknowns_undo_fit(&declared->u);
    declared->u.until = lab_cpu_share(within->u.until, 0.25); /* what else may be missing needs the rest */
    status = lab_forces_begin(&declared->u, error);
  }
  if (status == LAB_OK)
    status = lab_unknowns_chi2(&declared->u, &none, error);
  if (status == LAB_OK)
    status = try_sizes(&declared->u, HUGE_VAL, t, error);
  if (status == LAB_OK && t[0].chi2 < nearer * none)
    status = fit_sizes(&within->quality, declared, t, leaks, error);
  if (status == LAB_OK && leaks->quality.fitted) {
    note_score(&within->quality, leaks);
    leaks->u.until = lab_is_noise(&leaks->quality) ? within->u.until : lab_cpu_share(within->u.until, 0.5);
  }
  free(declared);
  return status;
}

/* What else was tried on the declared model, by score. */
static int score_declared(const lab_unknowns *within, const lab_search_options *options, lab_search_result *result,
                          lab_error *error)
{
  const double start = lab_clock();
  lab_unknowns u = *within;
  lab_projection p;
  int status = lab_projection_open(&u, &p, error);
  if (status == LAB_OK)
    status = lab_score_effects(&p, &result->scores, error);
  lab_projection_close(&p);
  result->level = result->scores.tests > 0 ? options->alpha / result->scores.tests : 0;
  result->score_s = lab_clock() - start;
  return status;
}

int lab_refill_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                      lab_error *error)
{
  lab_finding *leaks = malloc(sizeof *leaks), *whole = malloc(sizeof *whole);
  int status = leaks && whole ? LAB_OK : lab_fail_memory(error, "the search");
  *done = 0;
  if (status == LAB_OK)
    status = lab_contest_hold(u, f, error);
  if (status == LAB_OK && is_off(&f->held->quality)) {
    *leaks = *whole = *f;
    leaks->declared = *f->held;
    status = find(f->held, &leaks->best, error);
    if (status == LAB_OK && leaks->best.quality.fitted) {
      status = score_declared(&f->held->u, options, &whole->result, error);
      if (status == LAB_OK)
        status = lab_resume(u, options, leaks, whole, error);
      *done = status == LAB_OK && lab_is_noise(&whole->best.quality);
    }
  }
  if (*done) {
    *f = *whole;
    f->best.u.until = f->declared.u.until = u->until;
  }
  free(leaks);
  free(whole);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Place of a leak among what begins; n: it is not there */
static int place_of(const lab_onset_scores *begins, int leak)
{
  int i = 0;
  while (i < begins->n && begins->of[i].param != leak)
    i++;
  return i;
}

int lab_refill_score(const lab_candidate *base, size_t row, lab_onset_scores *begins, lab_error *error)
{
  const lab_run *x = base->u.run;
  trial t[SIZES];
  lab_score first;
  const double none = base->quality.chi2;
  int i = place_of(begins, pneu_param_find("leak_area")), status = LAB_OK;
  if (i < begins->n) {
    status = try_sizes(&base->u, x->log->value[LAB_CHANNEL_TIME][x->first + row], t, error);
    i = status == LAB_OK ? place_of(begins, t[0].leak) : i;
  }
  if (status != LAB_OK || i == begins->n || !(none - t[0].chi2 > begins->of[0].statistic))
    return status == LAB_WORLD ? status : LAB_OK;
  first = begins->of[i];
  first.size = t[0].size;
  first.statistic = none - t[0].chi2;
  first.p_value = lab_chi2_tail(first.statistic, 1);
  first.onset = row;
  begins->tests += SIZES;
  memmove(begins->of + 1, begins->of, (size_t)i * sizeof first);
  begins->of[0] = first;
  return LAB_OK;
}
