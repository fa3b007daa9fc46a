/* Refits of free terms. */
#include "../base/array.h"
#include "refit_private.h"

#include <math.h>
#include <stdlib.h>

static void begin_term(const lab_candidate *base, const lab_term_score *score, lab_candidate *c, lab_error *all)
{
  lab_error error;
  lab_found *found;
  *c = *base;
  c->u.slopes = NULL;
  c->quality.fitted = 0;
  if (lab_unknowns_add_term(&c->u, &score->term, score->scale, 0, &error)) {
    lab_fail_together(all, &error);
    return;
  }
  if (!lab_refit_begin(base, lab_count(LAB_BRIEF_STEPS), c, all))
    return;
  found = lab_candidate_add_found(c);
  found->term = c->u.rig.n_terms - 1;
  found->statistic = score->statistic;
  found->degrees = score->degrees;
  found->scale = score->scale;
}

/* Fit to the end, and on where the end is still moving: knots near which the log hardly ever is make a long valley. */
static void end_term(lab_candidate *c, lab_error *all)
{
  const lab_quality *q = &c->quality;
  double before = INFINITY;
  int i;
  for (i = 0; i < lab_count(LAB_TERM_REFITS) && q->fitted && !lab_is_noise(q) &&
              q->chi2 < lab_constant(LAB_TERM_MOVING) * before;
       i++) {
    before = q->chi2;
    lab_refit_one(c, LAB_ROUNDS_ALL, all);
  }
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

/* Chi-square of a model with another free term in its place; infinite where it fails. */
static double chi2_with(const lab_candidate *c, const pneu_term *term, double *r)
{
  lab_rig rig = c->u.rig;
  lab_error ignored;
  rig.term[c->found[c->n_found - 1].term] = *term;
  return lab_unknowns_residuals_with(&c->u, &rig, r, &ignored) == LAB_OK ? lab_dot(r, r, c->u.m) : HUGE_VAL;
}

/* Give knots at the ends the value of their neighbour as long as the log hardly tells the difference: where it hardly
 * ever is, a fit leaves them anywhere.  In/out: term  of c, which stays as it is */
static void trim(const lab_candidate *c, pneu_term *term, double *r)
{
  static const double told = 4; /* of chi-square: chosen by judgement */
  const double most = chi2_with(c, term, r) + told;
  const int n = term->n;
  int side, k, i;
  for (side = 0; side < 2; side++)
    for (k = 1; k < n; k++) {
      pneu_term flat = *term;
      for (i = 0; i < k; i++)
        flat.value[side ? n - 1 - i : i] = term->value[side ? n - 1 - k : k];
      if (!(chi2_with(c, &flat, r) < most))
        break;
      *term = flat;
    }
}

/* A free term that acts on a short stretch only: knots there, close together, and none elsewhere. It is taken unless it
 * is plainly worse. */
static void refine(lab_candidate *c, lab_candidate *fine, lab_error *all)
{
  const lab_found *found = &c->found[c->n_found - 1];
  pneu_term coarse = c->u.rig.term[found->term];
  const double margin = lab_constant(LAB_TERM_MARGIN) * (double)(coarse.to - coarse.from) / (coarse.n - 1);
  double from, to, level, peak, *r = malloc((c->u.m + 1) * sizeof *r);
  pneu_term term = coarse;
  lab_error error;
  if (r && coarse.argument != PNEU_TERM_OVER_CYCLE)
    trim(c, &coarse, r);
  free(r);
  if (!lab_free_term_stretch(&coarse, &from, &to, &level, &peak))
    return;
  *fine = *c;
  fine->u.slopes = NULL;
  lab_unknowns_drop_term(&fine->u);
  term.n = lab_count(LAB_TERM_FINE_KNOTS);
  term.from = (pneu_real)fmax(from - margin, (double)coarse.from);
  term.to = (pneu_real)fmin(to + margin, (double)coarse.to);
  resample(&coarse, level, &term);
  if (lab_unknowns_add_term(&fine->u, &term, found->scale, 1, &error))
    lab_fail_together(all, &error);
  else if (lab_refit_one(fine, LAB_ROUNDS_ALL, all) == LAB_OK &&
           fine->quality.bic < c->quality.bic + lab_constant(LAB_ALIKE_BIC))
    *c = *fine;
}

int lab_refit_free_terms(const lab_candidate *base, const lab_term_score *score, int n, lab_candidate *best,
                         lab_error *error)
{
  const int most = lab_count(LAB_TERM_LEADERS), finalists = lab_count(LAB_FINALISTS);
  lab_candidate *c = malloc((size_t)(most + 1) * sizeof *c);
  lab_refit_starts *s = lab_refit_open_starts(base, error);
  const int all = n < most ? n : most, last = all < finalists ? all : finalists;
  int i;
  best->quality.fitted = 0;
  if (!c || !s) {
    free(c);
    lab_refit_close_starts(s, NULL, 0);
    return lab_fail_memory(error, "refits");
  }
  lab_refit_share(&s->of[0], error);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < all; i++)
    begin_term(&s->of[0].base, &score[i], &c[i], error);
  qsort(c, (size_t)all, sizeof *c, lab_candidate_by_bic);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < last; i++)
    end_term(&c[i], error);
  lab_refit_close_starts(s, c, all);
  qsort(c, (size_t)last, sizeof *c, lab_candidate_by_bic);
  if (last > 0)
    *best = c[0];
  if (best->quality.fitted) {
    refine(best, &c[all], error);
    lab_candidate_explain(best, base->quality.chi2);
  }
  free(c);
  return error->status;
}
