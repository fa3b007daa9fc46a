#include "nameless.h"

#include <math.h>
#include <stdlib.h>

#include "unlisted.h"

enum { SLOTS = 8, BRIEF = 8, FINALISTS = 3, REFINED = 21, MARGIN = 2, ROUNDS = 4 };

static const double moving = 0.9; /* of the chi-square before: a fit that still gets there is not at its end */

static void refit_slot(const lab_attempt *base, const lab_slot *slot, lab_attempt *a, lab_error *all)
{
  lab_error error;
  lab_found *found;
  *a = *base;
  a->fitted = 0;
  if (lab_unknowns_add_term(&a->u, &slot->term, slot->scale, 0, &error) || lab_attempt_fit(a, BRIEF, &error)) {
    lab_fail_together(all, &error);
    return;
  }
  found = lab_attempt_add_found(a);
  found->term = a->u.rig.n_terms - 1;
  found->statistic = slot->statistic;
  found->degrees = slot->degrees;
  found->scale = slot->scale;
}

/* Values of one term, less a level, at the knots of another; 0 at its ends. */
static void resample(const pneu_term *from, double level, pneu_term *to)
{
  int i;
  for (i = 0; i < to->n; i++) {
    const double at = (double)(to->from + (to->to - to->from) * (pneu_real)i / (pneu_real)(to->n - 1));
    const double place = (at - (double)from->from) / (double)(from->to - from->from) * (from->n - 1);
    const int k = place < from->n - 2 ? (int)fmax(place, 0) : from->n - 2;
    const double share = fmin(fmax(place - k, 0), 1);
    to->value[i] = (pneu_real)((1 - share) * (double)from->value[k] + share * (double)from->value[k + 1] - level);
  }
  to->value[0] = to->value[to->n - 1] = 0;
}

/* A free term that acts on a short stretch only: knots there, close together, and none elsewhere. */
static void refine(lab_attempt *a, lab_error *all)
{
  const lab_found *found = &a->found[a->n_found - 1];
  const pneu_term coarse = a->u.rig.term[found->term];
  const double margin = MARGIN * (double)(coarse.to - coarse.from) / (coarse.n - 1);
  lab_attempt *fine = malloc(sizeof *fine);
  double from, to, level, peak;
  pneu_term term = coarse;
  lab_error error = {LAB_OK, ""};
  if (!fine)
    lab_fail_memory(&error, "a finer term");
  else if (lab_unlisted_stretch(&coarse, &from, &to, &level, &peak)) {
    *fine = *a;
    lab_unknowns_drop_term(&fine->u);
    term.n = REFINED;
    term.from = (pneu_real)fmax(from - margin, (double)coarse.from);
    term.to = (pneu_real)fmin(to + margin, (double)coarse.to);
    resample(&coarse, level, &term);
    if (lab_unknowns_add_term(&fine->u, &term, found->scale, 1, &error) == LAB_OK &&
        lab_attempt_fit(fine, LAB_FIT_WHOLE, &error) == LAB_OK && fine->bic < a->bic)
      *a = *fine;
  }
  lab_fail_together(all, &error);
  free(fine);
}

/* Fit to the end, and on where the end is still moving: knots near which the log hardly ever is make a long valley. */
static void fit_on(lab_attempt *a, lab_error *all)
{
  double before = INFINITY;
  lab_error error;
  int i;
  for (i = 0; i < ROUNDS && a->fitted && !lab_any_is_noise(a, 1) && a->chi2 < moving * before; i++) {
    before = a->chi2;
    if (lab_attempt_fit(a, LAB_FIT_WHOLE, &error))
      lab_fail_together(all, &error);
  }
}

int lab_refit_slots(const lab_attempt *base, const lab_slot *slot, int n, lab_attempt *best, lab_error *error)
{
  lab_attempt *a = malloc(SLOTS * sizeof *a);
  int i;
  best->fitted = 0;
  if (!a)
    return lab_fail_memory(error, "refits");
  error->status = LAB_OK;
  n = n < SLOTS ? n : SLOTS;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    refit_slot(base, &slot[i], &a[i], error);
  qsort(a, (size_t)n, sizeof *a, lab_attempt_by_bic);
  n = n < FINALISTS ? n : FINALISTS;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    fit_on(&a[i], error);
  qsort(a, (size_t)n, sizeof *a, lab_attempt_by_bic);
  if (n > 0)
    *best = a[0];
  free(a);
  if (best->fitted) {
    refine(best, error);
    lab_attempt_explain(best, base->chi2);
  }
  return error->status;
}
