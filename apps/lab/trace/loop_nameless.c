/* When the search wants what has no name, and when that is better than what has. */
#include <math.h>

#include "loop_private.h"
#include "refit.h"

static const double convincing = 0.5; /* of the excess of one effect, or of none: a free term leaves at most so much, */
static const double compelling = 0.1; /* and with so little there is no need to look on */

/* More than noise, if only a little. */
static int leaves_something(const lab_attempt *a)
{
  const double n = (double)a->u.n_values;
  return a->chi2 > n + 2 * sqrt(2 * n);
}

/* A free term can bend to nearly anything, and says nothing beyond what it has seen: it must leave only noise, or far
 * less than what has a name does. */
static int is_better(const lab_attempt *nameless, const lab_attempt *named, double share)
{
  const double n = (double)named->u.n_values;
  return nameless->fitted && nameless->bic < named->bic &&
         (lab_any_is_noise(nameless, 1) || nameless->chi2 - n < share * (named->chi2 - n));
}

int loop_last_resort(search *s, lab_error *error)
{
  lab_attempt *best = &s->beam[0], *longer = &s->pool[0];
  int enough;
  if (best->u.rig.n_terms > 0 || best->n_found >= LAB_LOOP_EFFECTS || (best->n_found > 0 && !leaves_something(best)))
    return LAB_OK;
  if (loop_find_slot(s, best, longer, error))
    return error->status;
  if (!is_better(longer, best, convincing))
    return LAB_OK;
  loop_note_step(s->result, longer);
  if (loop_is_gain(s, best, longer, &enough, error))
    return error->status;
  if (!enough) {
    s->result->small = longer->u.rig.term[longer->u.rig.n_terms - 1];
    s->result->has_small = 1;
    return LAB_OK;
  }
  *best = *longer;
  if (loop_remove_needless(best, error))
    return error->status;
  loop_note_way(s->result, best);
  return LAB_OK;
}

int loop_wants_nameless(const search *s, int rounds)
{
  const lab_attempt *best = &s->beam[0];
  return !s->nameless->fitted && !lab_any_is_noise(best, 1) && (rounds > 0 || lab_refit_all_poor(s->declared, best, 1));
}

int loop_is_compelling(const search *s)
{
  const lab_attempt *best = &s->beam[0];
  return !lab_any_is_noise(best, 1) &&
         (lab_any_is_noise(s->nameless, 1) || (best->n_found > 1 && is_better(s->nameless, best, compelling)));
}

int loop_is_preferred(const search *s)
{
  const lab_attempt *best = &s->beam[0];
  return s->nameless->fitted && !lab_any_is_noise(best, 1) &&
         is_better(s->nameless, best, best->n_found > 1 ? 1 : convincing);
}
