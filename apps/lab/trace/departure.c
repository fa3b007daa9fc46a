#include "departure.h"

#include <math.h>
#include <stdlib.h>

#include "../base/array.h"

/* By judgement. */
enum {
  SHORTEST = 4, /* the first beginning is one such part of the run */
  CLOSE = 24,   /* where the run leaves the model is known to one such part */
  LOOKS = 8     /* beginnings that are tried, at most */
};

/* Fit the first n rows from the values of the first `known`; from the declared values as well where these are few and
 * not only noise is left: they may have led astray. */
static int fit_beginning(lab_candidate *c, size_t known, size_t n, lab_error *error)
{
  lab_candidate *afresh = malloc(sizeof *afresh);
  int status = afresh ? lab_candidate_fit_beginning(c, n, known > 0 ? LAB_STEPS_ONWARD : LAB_ROUNDS_ALL, error)
                      : lab_fail_memory(error, "the beginning of a run");
  if (status == LAB_OK && !lab_is_noise(&c->quality) && known > 0 && known <= c->u.run->n / SHORTEST) {
    *afresh = *c;
    lab_unknowns_undo_fit(&afresh->u);
    status = lab_candidate_fit_beginning(afresh, n, LAB_ROUNDS_ALL, error);
    if (lab_candidate_by_bic(afresh, c) < 0)
      *c = *afresh;
  }
  free(afresh);
  return status;
}

/* The row of a stretch from which the residuals are most plainly more than noise. */
static size_t find_break(const lab_run *x, const double *r, size_t first, size_t end)
{
  static const double most = 4; /* square of what may be noise: two standard deviations */
  double sum = 0, best = 0;
  size_t i = end, at = first;
  int c;
  while (i-- > first) {
    for (c = 0; c < x->n_channels; c++)
      sum += pow(r[(size_t)c * x->n + i], 2) - most;
    if (sum > best) {
      best = sum;
      at = i;
    }
  }
  return at;
}

/* Whether residuals are more than noise; a gap leaves 0.  In: n  of them */
static int is_off(const double *r, size_t n)
{
  static const double deviations = 8, share = 1.5; /* by judgement */
  double values = 0;
  size_t i;
  for (i = 0; i < n; i++)
    values += r[i] != 0;
  return lab_dot(r, r, n) > fmax(values + deviations * sqrt(2 * values), share * values);
}

/* The row, after the first `known` ones, from which a residual is more than noise; the end of the run if there is none.
 * In:      r  residual of the run, channel by channel */
static size_t find_departure(const lab_run *x, const double *r, size_t known)
{
  enum { STRETCHES = 64 };
  const size_t length = x->n / STRETCHES + 1;
  size_t first;
  int c;
  for (first = known; first < x->n; first += length) {
    const size_t end = first + length < x->n ? first + length : x->n;
    for (c = 0; c < x->n_channels; c++)
      if (is_off(r + (size_t)c * x->n + first, end - first))
        return find_break(x, r, first > known + length ? first - length : known, end);
  }
  return x->n;
}

int lab_departure_row(const lab_candidate *c, size_t known, size_t *row, lab_error *error)
{
  lab_unknowns u = c->u;
  lab_run open = u.run[0];
  double *r = malloc((u.m + 1) * sizeof *r);
  int status;
  open.drift = NULL; /* taken out, it would hide in the rows known what the others leave */
  u.run = &open;
  status = r ? lab_unknowns_residuals(&u, NULL, r, error) : lab_fail_memory(error, "residuals");
  *row = status == LAB_OK ? find_departure(&open, r, known) : 0;
  free(r);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* The next beginning to try: as far as the model follows the run, unless that is hardly further than is known. */
static size_t go_further(const size_t between[2], size_t rows, size_t n)
{
  const size_t known = between[0], more = known + known / 2;
  if (rows > known + known / 4 && rows < between[1])
    return rows;
  return between[1] <= n ? (known + between[1]) / 2 : more < n ? more : n;
}

/* How many rows to fit first, or next; 0: no more. The values of more than half of a run say best where that leaves
 * them, but for the instants of the next commands, which they do not know.
 * In:      c        fitted to the first between[0] of them, if there are any
 *          between  as of lab_departure_find */
static int find_length(const lab_candidate *c, const size_t between[2], size_t *length, lab_error *error)
{
  const size_t n = c->u.run->n;
  size_t row;
  *length = n / SHORTEST;
  if (between[0] == 0)
    return LAB_OK;
  if (lab_departure_row(c, between[0], &row, error))
    return error->status;
  *length = go_further(between, row, n);
  if (between[1] <= n && between[0] > n / 2)
    *length = row >= between[0] && row + n / CLOSE < between[1] ? row + n / CLOSE : 0;
  return LAB_OK;
}

int lab_departure_find(lab_candidate *c, size_t known, size_t between[2], lab_error *error)
{
  const size_t n = c->u.run->n;
  lab_candidate *next = malloc(sizeof *next);
  size_t length = 0;
  int i, status = next ? LAB_OK : lab_fail_memory(error, "the beginning of a run");
  between[0] = known;
  between[1] = n + 1;
  for (i = 0; status == LAB_OK && i < LOOKS && between[1] > between[0] + n / CLOSE + 1; i++) {
    status = find_length(c, between, &length, error);
    if (status != LAB_OK || length == 0)
      break;
    *next = *c;
    status = fit_beginning(next, between[1] > n ? between[0] : n, length, error);
    between[!lab_is_noise(&next->quality)] = length;
    if (between[0] == length)
      *c = *next;
    if (between[0] == 0)
      break;
  }
  free(next);
  return status;
}
