#include "onset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"

/* How far from the best row chi-square stays within what 95 % allow, in one direction.  Out: end */
static int reach(const lab_onset_profile *f, size_t best, double least, int up, size_t *end, lab_error *error)
{
  const double within = least + lab_chi2_threshold(0.05);
  size_t step = 1;
  *end = best;
  while (step > 0) {
    const size_t room = up ? f->n - 1 - *end : *end, row = up ? *end + step : *end - step;
    double chi2 = HUGE_VAL;
    if (step <= room && f->look(f->context, row, &chi2, error))
      return error->status;
    if (step <= room && chi2 < within) {
      *end = row;
      step *= 2;
    } else {
      step /= 2;
    }
  }
  return LAB_OK;
}

int lab_onset_enclose(const lab_onset_profile *f, const double *t, size_t best, double least, size_t *low, size_t *high,
                      lab_onset *onset, lab_error *error)
{
  if (reach(f, best, least, 0, low, error) || reach(f, best, least, 1, high, error))
    return error->status;
  onset->known = 1;
  onset->t = t[best];
  onset->low = t[*low > 0 ? *low - 1 : 0];
  onset->high = t[*high + 1 < f->n ? *high + 1 : *high];
  return LAB_OK;
}

/* The row with the least chi-square: by a grid of places, or only between those next to where it is, and ever finer
 * ones about the best.
 * In/out:  best  where it is
 * Out:     least */
static int descend(const lab_onset_profile *f, int anywhere, size_t *best, double *least, lab_error *error)
{
  enum { PLACES = 32 };
  size_t low = 1, high = f->n - 1, step = (f->n + PLACES - 1) / PLACES, row;
  if (f->look(f->context, *best, least, error))
    return error->status;
  if (!anywhere) {
    low = *best > step ? *best - step : 1;
    high = *best + step < f->n ? *best + step : f->n - 1;
    step = (step + 3) / 4;
  }
  for (;;) {
    for (row = low; row <= high; row += step) {
      double chi2;
      if (f->look(f->context, row, &chi2, error))
        return error->status;
      if (chi2 < *least) {
        *least = chi2;
        *best = row;
      }
    }
    if (step == 1)
      return LAB_OK;
    low = *best > step ? *best - step + 1 : 1;
    high = *best + step < f->n ? *best + step - 1 : f->n - 1;
    step = (step + 3) / 4;
  }
}

/* The run in which a change begins. */
static const lab_run *run_of(const lab_unknowns *u, int change)
{
  return &u->run[u->unknown[change].run == LAB_ALL_RUNS ? 0 : u->unknown[change].run];
}

static void set_from(lab_unknowns *u, int change, double from)
{
  if (u->unknown[change].kind == LAB_UNKNOWN_ONSET)
    u->rig.onset[u->unknown[change].index].from = from;
  else
    u->unknown[change].from = from;
}

/* A change whose beginning is tried at one row after the other. The rest of the fit follows by its slopes as they are
 * where the change begins at present, the size of the change by what the change does where it is tried. */
typedef struct trial_row {
  lab_projection p; /* of the rest */
  lab_unknowns u;   /* with the change as the last unknown */
  const double *t;
  double theta[LAB_FIT_MAX], *none, *r, *slope; /* residuals without the change and with it, and their difference */
} trial_row;

/* Residuals where the change begins at some time. */
static int residuals_from(trial_row *f, double from, double *r, lab_error *error)
{
  set_from(&f->u, f->u.n - 1, from);
  return lab_unknowns_residuals(&f->u, f->theta, r, error);
}

static int open_trial(const lab_unknowns *u, int change, trial_row *f, lab_error *error)
{
  const lab_run *x = run_of(u, change);
  f->t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  f->u = *u;
  if (change != u->n - 1)
    f->u.slopes = NULL; /* which are in the order that the unknowns had */
  f->u.unknown[change] = u->unknown[u->n - 1];
  f->u.unknown[u->n - 1] = u->unknown[change];
  lab_unknowns_values(&f->u, f->theta);
  if (lab_projection_open_rest(&f->u, &f->p, error))
    return error->status;
  f->none = malloc(f->p.m * sizeof *f->none);
  f->r = malloc(f->p.m * sizeof *f->r);
  f->slope = malloc(f->p.m * sizeof *f->slope);
  if (!f->none || !f->r || !f->slope)
    return lab_fail_memory(error, "a profile");
  return residuals_from(f, 2 * f->t[x->n - 1] - f->t[0] + 1, f->none, error); /* after the end */
}

static void close_trial(trial_row *f)
{
  lab_projection_close(&f->p);
  free(f->none);
  free(f->r);
  free(f->slope);
}

/* Chi-square where the change begins at a row; infinite where the model fails. */
static int look(void *context, size_t row, double *chi2, lab_error *error)
{
  trial_row *f = context;
  double left;
  size_t i;
  int status = residuals_from(f, f->t[row], f->r, error);
  *chi2 = HUGE_VAL;
  if (status != LAB_OK)
    return status == LAB_NUMERIC ? LAB_OK : status;
  for (i = 0; i < f->p.m; i++)
    f->slope[i] = f->r[i] - f->none[i];
  lab_projection_visible(&f->p, f->r);
  left = lab_projection_visible(&f->p, f->slope);
  *chi2 = lab_dot(f->r, f->r, f->p.m);
  if (left > 0)
    *chi2 -= pow(lab_dot(f->slope, f->r, f->p.m) / left, 2);
  return LAB_OK;
}

static double when(const lab_unknowns *u, int change)
{
  const lab_unknown *x = &u->unknown[change];
  return x->kind == LAB_UNKNOWN_ONSET ? u->rig.onset[x->index].from : x->from;
}

static size_t row_near(const double *t, size_t n, double at)
{
  size_t i = 0;
  while (i + 1 < n && t[i] < at)
    i++;
  return i > 0 && at - t[i - 1] < t[i] - at ? i - 1 : i;
}

/* Where to look for the beginning of a change: where it is, near that, or all over the run. */
enum where { HERE, NEAR, ANYWHERE };

/* The row from which a change acts: that with the least chi-square, the rest of the fit following; and the interval in
 * which chi-square stays within what 95 % allow.
 * In:      where  to look
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD */
static int place(const lab_unknowns *u, int change, enum where where, lab_onset *onset, lab_error *error)
{
  trial_row *f = calloc(1, sizeof *f);
  const lab_onset_profile profile = {look, f, run_of(u, change)->n};
  size_t best = 0, low, high;
  double least;
  int status = f ? open_trial(u, change, f, error) : lab_fail_memory(error, "an onset");
  if (status == LAB_OK) {
    best = row_near(f->t, profile.n, when(u, change));
    status = where == HERE ? look(f, best, &least, error) : descend(&profile, where == ANYWHERE, &best, &least, error);
  }
  if (status == LAB_OK)
    status = lab_onset_enclose(&profile, f->t, best, least, &low, &high, onset, error);
  if (f)
    close_trial(f);
  free(f);
  return status;
}

/* Fit, and with the rest of it when what is found begins; a change begins at its row. */
static int fit_since(lab_unknowns *u, int change, double *chi2, lab_error *error)
{
  const int moves = u->unknown[change].kind == LAB_UNKNOWN_ONSET;
  int status;
  if (moves && lab_unknowns_add_since(u, error))
    return error->status = LAB_NUMERIC;
  status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, chi2, error);
  if (moves) {
    lab_unknowns_drop_since(u);
    lab_unknowns_count(u);
  }
  return status;
}

/* Fit from another time, and take that if it is better.  Returns: whether it is */
static int move(lab_unknowns *u, int change, double from, double *chi2, lab_error *all)
{
  lab_unknowns *there = malloc(sizeof *there);
  lab_error error;
  double at = HUGE_VAL;
  int better = 0;
  if (!there) {
    lab_fail_memory(all, "an onset");
    return 0;
  }
  *there = *u;
  set_from(there, change, from);
  if (fit_since(there, change, &at, &error))
    lab_fail_together(all, &error);
  else
    better = at < *chi2;
  if (better) {
    *u = *there;
    *chi2 = at;
  }
  free(there);
  return better;
}

int lab_onset_settle(lab_unknowns *u, int change, int anywhere, double *chi2, lab_onset *begin, lab_error *error)
{
  enum { MOVES = 5 };
  int i, status = fit_since(u, change, chi2, error);
  for (i = 0; status == LAB_OK; i++) {
    const double from = when(u, change);
    status = place(u, change, i == 0 && anywhere ? ANYWHERE : i < MOVES ? NEAR : HERE, begin, error);
    if (status != LAB_OK || (begin->low <= from && from <= begin->high))
      break;
    error->status = LAB_OK;
    if (!move(u, change, begin->t, chi2, error))
      i = MOVES; /* nowhere better: the interval is about where it is */
    status = error->status;
  }
  if (status == LAB_OK && u->unknown[change].kind == LAB_UNKNOWN_ONSET)
    begin->t = fmin(fmax(when(u, change), begin->low), begin->high);
  return status;
}

int lab_onset_extend(lab_unknowns *u, int change, double level, double *chi2, lab_onset *begin, lab_error *error)
{
  lab_unknowns *throughout = malloc(sizeof *throughout);
  double whole;
  int status = throughout ? LAB_OK : lab_fail_memory(error, "an onset");
  if (status == LAB_OK) {
    *throughout = *u;
    set_from(throughout, change, -HUGE_VAL);
    status = lab_unknowns_fit(throughout, LAB_ROUNDS_ALL, &whole, error);
  }
  if (status == LAB_OK && lab_chi2_tail(fmax(whole - *chi2, 0), 1) >= level / LAB_ONSET_PLACES) {
    *u = *throughout;
    *chi2 = whole;
    begin->known = 0;
  }
  free(throughout);
  return status;
}

int lab_onset_find(lab_unknowns *u, int change, double level, double *chi2, lab_onset *begin, lab_error *error)
{
  const int status = lab_onset_settle(u, change, 1, chi2, begin, error);
  return status == LAB_OK ? lab_onset_extend(u, change, level, chi2, begin, error) : status;
}
