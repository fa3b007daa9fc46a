#include "attempt.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double doubtful = 2.25; /* times the expected chi-square: more is not a slip in the noise declared */
static const double name_bonus = 20; /* of BIC, by which a free term must be better than an effect */

/* What is left is noise: chi-square within six standard deviations of its expectation, or the error within a twentieth
 * of the noise, as far as a declared noise can be trusted. */
static int is_noise(double chi2, size_t values)
{
  const double n = (double)values;
  return chi2 < n + 6 * sqrt(2 * n) || chi2 < 1.1025 * n;
}

/* Schwarz 1978: what a fit costs, with what it fits counted, and what has no name against what has. */
static double bic(const lab_unknowns *u, double chi2)
{
  return chi2 + (double)u->n * log((double)u->n_values) + name_bonus * u->rig.n_terms;
}

int lab_attempt_fit(lab_attempt *a, int steps, lab_error *error)
{
  int status = lab_unknowns_fit(&a->u, steps, &a->chi2, error);
  a->white = 0;
  if (status == LAB_OK && !is_noise(a->chi2, a->u.n_values) && a->chi2 < doubtful * (double)a->u.n_values)
    status = lab_unknowns_white(&a->u, &a->white, error);
  a->fitted = status == LAB_OK;
  a->bic = bic(&a->u, a->chi2);
  return status;
}

int lab_any_is_noise(const lab_attempt *a, int n)
{
  int i, any = 0;
  for (i = 0; i < n; i++)
    any |= a[i].fitted && (a[i].white || is_noise(a[i].chi2, a[i].u.n_values));
  return any;
}

int lab_any_is_clean(const lab_attempt *a, int n)
{
  int i, any = 0;
  for (i = 0; i < n; i++) {
    const double values = (double)a[i].u.n_values;
    any |= a[i].fitted && a[i].chi2 < values + sqrt(2 * values);
  }
  return any;
}

int lab_attempt_by_bic(const void *x, const void *y)
{
  const lab_attempt *a = x, *b = y;
  if (a->fitted != b->fitted)
    return b->fitted - a->fitted;
  return a->bic < b->bic ? -1 : a->bic > b->bic;
}

/* Better of two attempts takes the place of the first. */
void lab_attempt_keep_better(lab_attempt *a, const lab_attempt *other)
{
  if (other->fitted && (!a->fitted || other->chi2 < a->chi2))
    *a = *other;
}

lab_found *lab_attempt_add_found(lab_attempt *a)
{
  lab_found *found = &a->found[a->n_found++];
  memset(found, 0, sizeof *found);
  found->effect = found->term = found->shape = -1;
  found->degrees = 1;
  return found;
}

/* The values that the unknowns had before any fit. */
void lab_attempt_undo_fit(lab_attempt *a)
{
  double theta[LAB_FIT_MAX];
  int j;
  for (j = 0; j < a->u.n; j++)
    theta[j] = a->u.unknown[j].value = a->u.unknown[j].first;
  lab_unknowns_apply(&a->u, theta, LAB_ALL_EXPERIMENTS, &a->u.rig);
}

/* What the last addition did to chi-square. */
void lab_attempt_explain(lab_attempt *a, double chi2_before)
{
  lab_found *found = &a->found[a->n_found - 1];
  found->explained = (chi2_before - a->chi2) / fmax(chi2_before - (double)a->u.n_values, 1);
}

void lab_attempt_name(const lab_attempt *a, char *text, size_t size)
{
  size_t used = 0;
  int i;
  snprintf(text, size, "declared model");
  for (i = 0; i < a->n_found && used < size; i++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? " + " : "",
                             a->found[i].effect < 0 ? "unlisted" : pneu_effect_at(a->found[i].effect)->name);
}
