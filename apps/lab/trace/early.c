#include "early.h"

#include <math.h>
#include <stdlib.h>

#include "../base/array.h"
#include "../fit/nuisance.h"
#include "refill.h"

enum {
  SHORTEST = 4, /* the first beginning is one such part of the run */
  CLOSE = 24,   /* where the run leaves the model is known to one such part */
  LOOKS = 8     /* beginnings that are tried, at most */
};

/* ---- The beginning of a run ---- */

/* Fit the first n rows. */
static int fit_beginning(lab_candidate *c, size_t n, lab_error *error)
{
  return lab_candidate_fit_beginning(c, n, LAB_ROUNDS_ALL, error);
}

/* The same from the declared values as well, unless only noise is left: a short beginning may have led astray. */
static int fit_beginning_again(lab_candidate *c, size_t n, lab_error *error)
{
  lab_candidate *afresh = malloc(sizeof *afresh);
  int status = afresh ? fit_beginning(c, n, error) : lab_fail_memory(error, "the beginning of a run");
  if (status == LAB_OK && !lab_is_noise(&c->quality)) {
    *afresh = *c;
    lab_unknowns_undo_fit(&afresh->u);
    status = fit_beginning(afresh, n, error);
    if (lab_candidate_by_bic(afresh, c) < 0)
      *c = *afresh;
  }
  free(afresh);
  return status;
}

/* ---- Where the rows leave the model ---- */

/* The first row of the stretch of a run, after its first `known` rows, in which a residual is more than noise; the end
 * of the run if there is none.
 * In:      r  residual of the run, channel by channel */
static size_t find_departure(const lab_run *x, const double *r, size_t known)
{
  enum { STRETCHES = 64 };
  static const double deviations = 8, share = 1.5;
  int c, k;
  for (k = 0; k < STRETCHES; k++) {
    const size_t first = x->n * (size_t)k / STRETCHES, end = x->n * (size_t)(k + 1) / STRETCHES;
    for (c = 0; c < x->n_channels && end > known; c++) {
      const double *v = r + (size_t)c * x->n + first, values = (double)(end - first);
      const double chi2 = lab_dot(v, v, end - first);
      if (chi2 > fmax(values + deviations * sqrt(2 * values), share * values))
        return first;
    }
  }
  return x->n;
}

/* How far a model of the first `known` rows follows the whole run; 0: it cannot be simulated. A drift that was taken
 * out would hide in these rows what the others leave. Returns: LAB_OK, LAB_WORLD */
static int follow(const lab_candidate *c, size_t known, size_t *rows, lab_error *error)
{
  lab_unknowns u = c->u;
  lab_run open = u.run[0];
  double *r = malloc((u.m + 1) * sizeof *r);
  int status;
  open.drift = NULL;
  u.run = &open;
  status = r ? lab_unknowns_residuals(&u, NULL, r, error) : lab_fail_memory(error, "residuals");
  *rows = status == LAB_OK ? find_departure(&open, r, known) : 0;
  free(r);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* The next beginning to try: as far as the model follows the run, unless that is hardly further than is known. */
static size_t go_further(const size_t between[2], size_t rows, size_t n)
{
  const size_t more = between[0] + between[0] / 2;
  if (rows > between[0] + between[0] / 4 && rows < between[1])
    return rows;
  return between[1] <= n ? (between[0] + between[1]) / 2 : more < n ? more : n;
}

/* The longest beginning that leaves only noise.
 * In/out:  c        the declared model with its values held; then fitted to that
 * Out:     between  rows between which the run leaves the model; from 0: there is no such beginning; from the end of
 *                   the run to beyond: it does not
 * Returns: LAB_OK, LAB_WORLD */
static int find_beginning(lab_candidate *c, size_t between[2], lab_error *error)
{
  const size_t n = c->u.run->n;
  lab_candidate *next = malloc(sizeof *next);
  size_t length = n / SHORTEST, rows = 0;
  int i, status = next ? LAB_OK : lab_fail_memory(error, "the beginning of a run");
  between[0] = 0;
  between[1] = n + 1;
  for (i = 0; status == LAB_OK && i < LOOKS && between[1] > between[0] + n / CLOSE + 1; i++) {
    *next = *c;
    status = (between[1] > n && between[0] > 0 ? fit_beginning_again : fit_beginning)(next, length, error);
    between[!lab_is_noise(&next->quality)] = length;
    if (status != LAB_OK || between[0] == 0)
      break;
    if (between[0] == length) {
      *c = *next;
      status = follow(c, length, &rows, error);
    }
    length = go_further(between, rows, n);
  }
  free(next);
  return status;
}

/* ---- What begins ---- */

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

/* What begins in a frozen model, put into the one whose values vary, and fitted beside them.
 * In/out:  c  frozen; then fitted or not */
static int thaw(const lab_candidate *base, lab_candidate *c, lab_error *error)
{
  const lab_rig_onset begins = c->u.rig.onset[c->u.rig.n_onsets - 1];
  c->u = base->u;
  c->quality.fitted = 0;
  if (lab_unknowns_add_onset(&c->u, begins.param, begins.from, begins.value, error))
    return LAB_OK; /* no room */
  if (lab_refill_loops(&c->u) && begins.param == pneu_param_find("leak_area") ? lab_refill_fit(c, error)
                                                                              : lab_candidate_fit_held(c, error))
    return error->status;
  return c->quality.fitted ? lab_candidate_place_again(c, error) : LAB_OK;
}

/* What may begin between two rows, by score, while all else is as the beginning has it.
 * In:      frozen
 * Out:     c  as of lab_refit_onsets_at */
static int refit_frozen(const lab_candidate *frozen, const size_t between[2], double alpha, lab_onset_scores *begins,
                        lab_candidate *c, int *n, lab_error *error)
{
  const lab_run *x = frozen->u.run;
  lab_unknowns u = frozen->u;
  lab_projection p;
  int status = lab_projection_open(&u, &p, error);
  if (status == LAB_OK)
    status = lab_onset_scores_find(&p, between[0], between[1] < x->n ? between[1] : x->n, begins, error);
  lab_projection_close(&p);
  if (status != LAB_OK)
    return status;
  if (lab_refill_is_asked(&frozen->u) && lab_refill_score(frozen, between[0], begins, error))
    return error->status;
  return lab_refit_onsets_at(frozen, begins, alpha / (begins->tests > 0 ? begins->tests : 1), between[0], c, n, error);
}

/* The first of n frozen models, best first, that leaves only noise with all its values; else one that does not. */
static int thaw_best(const lab_candidate *base, lab_candidate *c, int n, lab_candidate *onset, lab_error *error)
{
  const double reach = n > 0 ? lab_constant(LAB_RIVAL) * c[0].quality.chi2 : 0;
  int i, status = LAB_OK;
  for (i = 0; status == LAB_OK && !lab_is_noise(&onset->quality) && i < n && i < lab_count(LAB_ONSET_FINALISTS); i++) {
    const lab_quality *q = &c[i].quality;
    if (!q->fitted || !(q->chi2 < reach && q->chi2 < lab_constant(LAB_EARLY_NEAR) * q->values))
      break;
    status = thaw(base, &c[i], error);
    *onset = c[i];
  }
  return status;
}

/* Find what begins with the values of the beginning, then fit it beside them. */
static int fit_onset(const lab_candidate *base, const size_t between[2], double alpha, lab_candidate *onset,
                     lab_onset_scores *begins, lab_error *error)
{
  lab_candidate *frozen = malloc(sizeof *frozen), *c = malloc((size_t)lab_count(LAB_ONSET_LEADERS) * sizeof *c);
  lab_nuisance instants = {0};
  int n = 0, status = frozen && c ? LAB_OK : lab_fail_memory(error, "refits");
  if (status == LAB_OK) {
    *frozen = *base;
    freeze(&frozen->u);
    status = lab_nuisance_open(&frozen->u, &instants, error);
  }
  if (status == LAB_OK)
    status = refit_frozen(frozen, between, alpha, begins, c, &n, error);
  if (status == LAB_OK)
    status = thaw_best(base, c, n, onset, error);
  lab_nuisance_close(&instants);
  free(frozen);
  free(c);
  return status;
}

/* Whether something begins after the first row, beyond doubt. */
static int begins_later(const lab_candidate *onset)
{
  const lab_run *x = onset->u.run;
  return lab_candidate_begins(onset) && onset->begin[0].low > x->log->value[LAB_CHANNEL_TIME][x->first];
}

int lab_early_fit(lab_candidate *within, double alpha, lab_candidate *onset, lab_onset_scores *begins, double *known,
                  lab_error *error)
{
  const size_t n = within->u.run->n;
  lab_candidate *c = malloc(sizeof *c);
  size_t between[2] = {0, 0};
  int status = c ? LAB_OK : lab_fail_memory(error, "the beginning of a run");
  onset->quality.fitted = 0;
  if (status == LAB_OK) {
    *c = *within;
    lab_unknowns_undo_fit(&c->u);
    status = find_beginning(c, between, error);
  }
  if (status == LAB_OK && between[0] == n)
    *within = *c;
  else if (status == LAB_OK && between[0] > 0)
    status = fit_onset(c, between, alpha, onset, begins, error);
  *known = (double)between[0] / (double)n;
  onset->quality.fitted &= status == LAB_OK && lab_is_noise(&onset->quality) && begins_later(onset);
  free(c);
  return status == LAB_NUMERIC ? LAB_OK : status;
}
