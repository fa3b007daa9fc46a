#include "unfold.h"

#include <math.h>
#include <stdlib.h>

#include "../base/clock.h"

int lab_unfold_has_held(const lab_unfolding *f)
{
  return f->nuisance->n > 0 && !lab_nuisance_is_instants(f->nuisance);
}

/* What follows a command bends too much for the instants that a straight line has about another model. */
static void restart_instants(lab_unknowns *u)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_INSTANT)
      u->unknown[j].value = u->unknown[j].prior;
}

/* From where the straight lines lead.  Returns: LAB_OK, LAB_WORLD */
static int fit_on(const lab_unfolding *f, const lab_candidate *c, lab_candidate *whole, lab_error *error)
{
  int status;
  *whole = *c;
  whole->quality.fitted = 0;
  status = lab_nuisance_return(&whole->u, error);
  if (status == LAB_OK) {
    restart_instants(&whole->u);
    status = lab_unknowns_keep_slopes(&whole->u, error);
  }
  if (status == LAB_OK) {
    lab_nuisance_begin_with(f->nuisance, &whole->u);
    status = lab_candidate_fit(whole, LAB_ROUNDS_ALL, error);
    lab_unknowns_forget_slopes(&whole->u);
  }
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Whether a candidate may explain the logs from other values than those that a bent fit leads to. */
static int may_explain(const lab_quality *q)
{
  return !q->fitted || q->chi2 < lab_constant(LAB_NOISE_DOUBTFUL) * q->values;
}

/* From the declared values, where it comes near to the logs.  In/out: whole  the better one */
static int fit_staged(const lab_unfolding *f, const lab_candidate *c, lab_candidate *whole, lab_error *error)
{
  lab_candidate *staged;
  int status;
  if (!lab_unfold_has_held(f) || !f->exact || c->u.rig.n_terms + c->u.rig.n_onsets > 0 || !may_explain(&whole->quality))
    return LAB_OK;
  staged = malloc(sizeof *staged);
  if (!staged)
    return lab_fail_memory(error, "a candidate");
  status = lab_candidate_stage(c, f->exact, staged, error);
  staged->u.misfit = whole->u.misfit; /* so that tolerances cost as much */
  if (status == LAB_OK)
    status = lab_candidate_fit(staged, LAB_ROUNDS_ALL, error);
  if (status == LAB_OK && lab_candidate_by_bic(staged, whole) < 0)
    *whole = *staged;
  free(staged);
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_unfold(const lab_unfolding *f, const lab_candidate *c, lab_candidate *whole, lab_error *error)
{
  return fit_on(f, c, whole, error) ? error->status : fit_staged(f, c, whole, error);
}

/* One of them.  Out: c->quality  with all its values, if they can be fitted */
static int unfold_one(lab_unfolding *f, lab_candidate *c, lab_error *error)
{
  lab_candidate *whole = &f->whole;
  if (lab_unfold(f, c, whole, error))
    return error->status;
  if (whole->quality.fitted && lab_candidate_by_bic(whole, &f->best) < 0)
    f->best = *whole;
  if (whole->quality.fitted)
    c->quality = whole->quality;
  c->quality.whole = 1;
  return LAB_OK;
}

/* The best by straight lines that was not fitted with all its values yet, NULL: none has a lower BIC. */
static lab_candidate *next_of(lab_candidate *c, int n, double bic)
{
  lab_candidate *next = NULL;
  int i;
  for (i = 0; i < n; i++)
    if (c[i].quality.fitted && !c[i].quality.whole && c[i].quality.bic < (next ? next->quality.bic : bic))
      next = &c[i];
  return next;
}

int lab_unfold_best(lab_unfolding *f, lab_candidate *c, int n, lab_error *error)
{
  const int has_held = lab_unfold_has_held(f), is_lazy = has_held && lab_any(c, n, lab_is_noise);
  const int most = lab_count(has_held ? LAB_UNFOLDED_HELD : LAB_UNFOLDED);
  const lab_candidate *first = next_of(c, n, HUGE_VAL);
  const double alike = first ? first->quality.bic + lab_constant(LAB_ALIKE_BIC) : 0;
  double gain = 0;
  int i;
  for (i = 0; i < most && f->nuisance->n > 0 && !lab_cpu_is_spent(f->until); i++) {
    const double bar =
        f->best.quality.fitted ? fmax(alike, f->best.quality.bic + lab_constant(LAB_UNFOLDED_GAIN) * gain) : HUGE_VAL;
    lab_candidate *next = next_of(c, n, is_lazy ? bar : HUGE_VAL);
    const double line = next ? next->quality.bic : 0;
    if (!next)
      break;
    if (unfold_one(f, next, error))
      return error->status;
    gain = fmax(gain, line - next->quality.bic);
  }
  qsort(c, (size_t)n, sizeof *c, lab_candidate_by_bic);
  return LAB_OK;
}
