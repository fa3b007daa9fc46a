/* What is known to a tolerance varies unseen along straight lines while effects are compared, and is fitted for the
 * best. */
#include "rounds_private.h"

#include "../base/clock.h"

int lab_rounds_linearise(lab_rounds *s, lab_error *error)
{
  if (s->declared.u.window > 0) /* an instant moves whole slips */
    return LAB_OK;
  if (lab_nuisance_open(&s->declared.u, &s->nuisance, error))
    return error->status;
  return lab_candidate_fit(&s->declared, LAB_ROUNDS_ALL, error);
}

/* Fit what is to be the answer: as far as the time goes, and a step where it is spent, for which there is a tenth more.
 * In:      start  [s] of CPU time at which the search began */
static int fit_in_time(lab_candidate *c, double start, lab_error *error)
{
  static const double more = 0.1;
  const double until = c->u.until;
  int status;
  if (!lab_cpu_is_spent(until))
    return lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  c->u.until = until > 0 ? lab_cpu_time() + more * (until - start) : 0;
  status = lab_candidate_fit(c, 1, error);
  c->u.until = until;
  return status;
}

/* Straight lines may lead to where a fit gets stuck, far from where the model, or one before it, had come. If it was
 * one before it, that is where the search ends. */
static void keep_better(lab_rounds *s)
{
  lab_candidate *best = &s->beam[0];
  if (!s->whole.quality.fitted || lab_candidate_by_bic(&s->whole, best) >= 0) {
    s->whole = *best;
    return;
  }
  if (s->whole.n_found < best->n_found) {
    s->added = 0;
    s->result->n_path -= s->result->n_path > 1;
  }
  *best = s->whole;
}

int lab_rounds_unfold(lab_rounds *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  int status = LAB_OK;
  if (!best->u.nuisance && (s->is_final || !lab_rounds_has_held(s))) { /* fitted to the end before */
    keep_better(s);
    return status;
  }
  if (best->u.nuisance && lab_nuisance_return(&best->u, error))
    return error->status;
  s->without = *best;
  best->u.until = s->declared.u.until;
  status = fit_in_time(best, s->start, error);
  if (status == LAB_NUMERIC) {
    *best = s->without;
    status = LAB_OK;
  } else if (status == LAB_OK) {
    keep_better(s);
  }
  lab_rounds_note_values(s->result, &best->u);
  return status;
}

/* A model about the same values as another: what the nuisance holds is where it is there. */
static int move_to(const lab_nuisance *h, lab_candidate *c, lab_error *error)
{
  int k, status;
  if (!c->quality.fitted)
    return LAB_OK;
  c->u.nuisance = h;
  c->u.misfit = h->misfit;
  for (k = 0; k < h->n; k++)
    if (h->of[k].kind == LAB_UNKNOWN_PARAM && h->of[k].run == LAB_ALL_RUNS)
      *pneu_param_at(&c->u.rig.params, h->of[k].index) = (pneu_real)h->of[k].value;
  lab_unknowns_take(&c->u);
  lab_unknowns_count(&c->u);
  status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* About the best model, and all others about the same values. */
static int linearise_about(lab_rounds *s, lab_error *error)
{
  lab_nuisance h;
  int i, status;
  if (lab_unknowns_weigh_held(&s->beam[0].u, error))
    return error->status;
  status = lab_nuisance_open(&s->beam[0].u, &h, error);
  lab_nuisance_close(&s->nuisance);
  s->nuisance = h;
  s->beam[0].u.nuisance = &s->nuisance;
  if (status == LAB_OK)
    status = lab_candidate_fit(&s->beam[0], LAB_ROUNDS_ALL, error);
  for (i = 1; status == LAB_OK && i < s->n_beam; i++)
    status = move_to(&s->nuisance, &s->beam[i], error);
  if (status == LAB_OK)
    status = move_to(&s->nuisance, &s->free_term, error);
  return status == LAB_OK ? move_to(&s->nuisance, &s->declared, error) : status;
}

int lab_rounds_linearise_again(lab_rounds *s, lab_error *error)
{
  int status = lab_rounds_unfold(s, error);
  s->is_final = lab_cpu_is_spent(s->declared.u.until);
  if (status == LAB_OK && !s->is_final)
    status = lab_candidate_place_again(&s->beam[0], error);
  if (status != LAB_OK || s->is_final)
    return status;
  s->without = s->beam[0];
  status = linearise_about(s, error);
  if (status != LAB_NUMERIC)
    return status;
  s->beam[0] = s->without;
  s->over = 1;
  return error->status = LAB_OK;
}
