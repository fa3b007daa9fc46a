/* Free terms, for what has no name. */
#include "rounds_private.h"

#include <math.h>

int lab_rounds_refit_terms(lab_rounds *s, const lab_candidate *base, lab_candidate *best, lab_error *error)
{
  lab_rounds_progress(s, "trying free terms");
  return lab_refit_free_terms(base, s->term, s->n_terms, best, error);
}

int lab_rounds_unfold_term(lab_rounds *s, lab_error *error)
{
  lab_candidate *whole = &s->unfolding.whole;
  if (lab_unfold(&s->unfolding, &s->free_term, whole, error))
    return error->status;
  if (whole->quality.fitted)
    s->free_term.quality = whole->quality;
  return LAB_OK;
}

/* Whether a refit might be worth it, were it to take twice as much off chi-square as the score says. */
static int may_pay(const lab_rounds *s, const lab_candidate *base, const lab_term_score *t)
{
  const double left = 1 - s->options->min_gain, values = base->quality.values / base->u.run[0].n_channels;
  return 2 * t->statistic > (1 - left * left) * values;
}

/* Whether its score says that a free term lowers BIC. */
static int lowers_bic(const lab_candidate *base, const lab_term_score *t)
{
  return t->statistic > lab_constant(LAB_TERM_BIC) + t->degrees * log(base->quality.values);
}

int lab_rounds_find_term(lab_rounds *s, const lab_candidate *base, lab_candidate *best, lab_error *error)
{
  const lab_term_score *t = s->term;
  lab_unknowns u = base->u;
  lab_projection p;
  int status = lab_projection_open(&u, &p, error);
  best->quality.fitted = 0;
  if (status == LAB_OK)
    status = lab_score_free_terms(&p, s->term, &s->n_terms, error);
  if (status == LAB_OK && s->n_terms > 0 && t->degrees > 0 &&
      lab_free_term_p_value(&t->term, t->statistic, t->degrees) < s->result->level) {
    if (!lab_is_noise(&base->quality) || may_pay(s, base, t))
      status = lab_rounds_refit_terms(s, base, best, error);
    else if (lowers_bic(base, t))
      lab_rounds_note_small(s->result, &t->term);
  }
  lab_projection_close(&p);
  return status;
}

int lab_rounds_find_term_beside(lab_rounds *s, lab_error *error)
{
  int white = 0, status = LAB_OK;
  s->has_extended = 1;
  s->pool[0].quality.fitted = 0;
  if (s->beam[0].n_found == 0 && lab_is_noise(&s->beam[0].quality))
    status = lab_candidate_is_white(&s->beam[0], &white, error);
  return status == LAB_OK && !white ? lab_rounds_find_term(s, &s->beam[0], &s->pool[0], error) : status;
}

void lab_rounds_take_term(lab_rounds *s)
{
  s->beam[0] = s->free_term;
  lab_rounds_note_step(s->result, &s->beam[0]);
  s->result->n_path = 1;
  lab_rounds_note_way(s->result, &s->beam[0]);
}

int lab_rounds_add_term(lab_rounds *s, lab_error *error)
{
  const lab_candidate *with = &s->pool[0];
  int enough;
  lab_rounds_note_step(s->result, with);
  if (lab_rounds_measure_gain(s, &enough, error))
    return error->status;
  if (!enough) {
    lab_rounds_note_small(s->result, &with->u.rig.term[with->u.rig.n_terms - 1]);
    return LAB_OK;
  }
  s->beam[0] = *with;
  if (lab_rounds_remove_needless(s, error))
    return error->status;
  lab_rounds_note_way(s->result, &s->beam[0]);
  return LAB_OK;
}
