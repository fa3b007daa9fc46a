/* What was found before is put to the test again beside what came after it; and what begins within the run. */
#include "rounds_private.h"

#include <math.h>

int lab_rounds_remove_needless(lab_rounds *s, lab_error *error)
{
  return lab_candidate_drop_needless(&s->beam[0], s->beam[0].n_found - 1, error);
}

/* Take the best extension in place of the best candidate.  Out: other  whether it has something else */
static int swap_in(lab_rounds *s, double chi2_without, int *other, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  *other = !lab_candidate_is_alike_but(best, -1, &s->pool[0], -1);
  lab_candidate_explain(&s->pool[0], chi2_without);
  lab_rounds_note_alike(s);
  *best = s->pool[0];
  return s->nuisance.n > 0 ? lab_rounds_linearise_again(s, error) : LAB_OK;
}

int lab_rounds_exchange(lab_rounds *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0], *without = &s->without;
  int i, other, again = LAB_EFFECTS_MAX, status = LAB_OK;
  for (i = 0; status == LAB_OK && !s->over && i < best->n_found - 1; i++) {
    if (best->found[i].term >= 0)
      continue;
    status = lab_candidate_leave_out(best, i, without, error);
    if (status != LAB_OK || !without->quality.fitted)
      continue;
    s->n_pool = 0;
    if (lab_rounds_extend(s, without, error) == LAB_WORLD)
      return error->status;
    lab_rounds_rank(s);
    s->unfolding.best.quality.fitted = 0;
    if (lab_rounds_rank_whole(s, error))
      return error->status;
    if (s->n_pool == 0 || s->pool[0].quality.bic >= best->quality.bic) {
      lab_candidate_note_alike(best, i, s->pool, s->n_pool);
      continue;
    }
    status = swap_in(s, without->quality.chi2, &other, error);
    if (other && again-- > 0)
      i = -1;
  }
  return status;
}

/* ---- What begins within the run ---- */

int lab_rounds_fit_onset(lab_rounds *s, enum lab_constant share, lab_error *error)
{
  const lab_onset_scores *all = &s->begins;
  const double bar = lab_constant(share) * fmax(all->throughout, s->best_effect);
  lab_rounds_progress(s, "looking for what begins within the log");
  return lab_refit_onset(&s->beam[0], all, lab_onset_scores_level(all, s->options->alpha), bar, &s->onset, error);
}

void lab_rounds_take_onset(lab_rounds *s)
{
  s->beam[0] = s->onset;
  s->n_beam = 1;
  s->has_begun = 1;
  lab_rounds_note_step(s->result, &s->beam[0]);
  lab_rounds_note_way(s->result, &s->beam[0]);
}

int lab_rounds_try_instead(lab_rounds *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  const double level = lab_onset_scores_level(&s->begins, s->options->alpha);
  int i, n, status = lab_refit_instead(best, &s->begins, level, s->pool, &s->n_pool, error);
  if (status != LAB_OK)
    return status;
  lab_rounds_rank(s);
  lab_refit_put_simplest_first(s->pool, s->n_pool);
  if (s->n_pool > 0 && lab_refit_is_simpler(&s->pool[0], best)) {
    s->without = *best;
    *best = s->pool[0];
    s->pool[0] = s->without;
    if (best->n_found > 0)
      lab_candidate_explain(best, s->declared.quality.chi2);
    status = s->nuisance.n > 0 ? lab_rounds_linearise_again(s, error) : lab_candidate_place_again(best, error);
  }
  for (i = n = 0; i < s->n_pool; i++)
    if (s->pool[i].n_found > 0)
      s->pool[n++] = s->pool[i];
  if (best->n_found > 0)
    lab_candidate_note_alike(best, best->n_found - 1, s->pool, n);
  return status;
}
