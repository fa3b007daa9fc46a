#include "onset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"

int lab_onset_reach(const lab_onset_profile *f, size_t best, double least, int up, size_t *end, lab_error *error)
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

/* The row with the least chi-square: by the grid of places, then by ever finer ones about the best. */
static int descend(const lab_onset_profile *f, size_t *best, double *least, lab_error *error)
{
  size_t low = 1, high = f->n - 1, step = (f->n + LAB_ONSET_PLACES - 1) / LAB_ONSET_PLACES, row;
  *least = HUGE_VAL;
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

/* A change whose beginning is tried at one row after the other, the rest of the fit projected out. */
typedef struct trial_row {
  lab_projection p;     /* without the change, the rest as fitted */
  lab_unknowns without; /* of the projection */
  lab_unknowns u;       /* with the change as the last unknown */
  const double *t;
  double theta[LAB_FIT_MAX], *slope;
} trial_row;

static int open_trial(const lab_unknowns *u, int change, trial_row *f, lab_error *error)
{
  const lab_run *x = &u->run[u->unknown[change].run];
  int j;
  f->t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  f->u = *u;
  f->u.unknown[change] = u->unknown[u->n - 1];
  f->u.unknown[u->n - 1] = u->unknown[change];
  f->without = f->u;
  f->without.n--;
  f->without.m--;
  for (j = 0; j < u->n; j++)
    f->theta[j] = f->u.unknown[j].value;
  if (lab_projection_open(&f->without, &f->p, error))
    return error->status;
  f->slope = malloc(u->m * sizeof *f->slope);
  return f->slope ? LAB_OK : lab_fail_memory(error, "a profile");
}

/* How far chi-square falls below that without the change; not at all where the model fails. */
static int look(void *context, size_t row, double *chi2, lab_error *error)
{
  trial_row *f = context;
  double left;
  size_t i;
  int status;
  f->u.unknown[f->u.n - 1].from = f->t[row];
  memcpy(f->slope, f->p.r, f->p.m * sizeof *f->slope);
  status = lab_unknowns_residuals_of(&f->u, f->theta, f->u.n - 1, f->slope, error);
  *chi2 = 0;
  if (status != LAB_OK)
    return status == LAB_NUMERIC ? LAB_OK : status;
  for (i = 0; i < f->p.m; i++)
    f->slope[i] -= f->p.r[i];
  left = lab_projection_visible(&f->p, f->slope);
  if (left > 0)
    *chi2 = -pow(lab_dot(f->slope, f->p.r, f->p.m) / left, 2);
  return LAB_OK;
}

/* The best row.  Out: onset  Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD */
static int place(const lab_unknowns *u, int change, lab_onset *onset, lab_error *error)
{
  trial_row *f = calloc(1, sizeof *f);
  const lab_onset_profile profile = {look, f, u->run[u->unknown[change].run].n};
  size_t best = 0, low, high;
  double least;
  int status = f ? open_trial(u, change, f, error) : lab_fail_memory(error, "an onset");
  if (status == LAB_OK && !descend(&profile, &best, &least, error) &&
      !lab_onset_reach(&profile, best, least, 0, &low, error) &&
      !lab_onset_reach(&profile, best, least, 1, &high, error))
    lab_onset_set(f->t, profile.n, low, best, high, onset);
  else if (status == LAB_OK)
    status = error->status;
  if (f) {
    lab_projection_close(&f->p);
    free(f->slope);
  }
  free(f);
  return status;
}

void lab_onset_set(const double *t, size_t n, size_t low, size_t best, size_t high, lab_onset *onset)
{
  onset->known = 1;
  onset->t = t[best];
  onset->low = t[low > 0 ? low - 1 : 0];
  onset->high = t[high + 1 < n ? high + 1 : high];
}

int lab_onset_find(lab_unknowns *u, int change, double level, double *chi2, lab_onset *begin, lab_error *error)
{
  lab_unknowns *throughout = malloc(sizeof *throughout);
  double whole;
  int status = throughout ? place(u, change, begin, error) : lab_fail_memory(error, "an onset");
  if (status == LAB_OK) {
    *throughout = *u;
    throughout->unknown[change].from = -HUGE_VAL;
    u->unknown[change].from = begin->t;
    status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, chi2, error);
  }
  if (status == LAB_OK)
    status = lab_unknowns_fit(throughout, LAB_ROUNDS_ALL, &whole, error);
  if (status == LAB_OK && lab_chi2_tail(fmax(whole - *chi2, 0), 1) >= level / LAB_ONSET_PLACES) {
    *u = *throughout;
    *chi2 = whole;
    begin->known = 0;
  }
  free(throughout);
  return status;
}
