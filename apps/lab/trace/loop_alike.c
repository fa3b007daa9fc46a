/* Models side by side: the same, and effects that the log cannot tell from one another. */
#include <math.h>

#include "loop_private.h"

static const double alike_bic = 9.2; /* refits that differ by less are alike: odds of a hundred to one */

/* Whether two models have the same, whatever was added first, beside one thing found of each; -1: beside nothing. */
static int is_alike_but(const lab_attempt *a, int which_a, const lab_attempt *b, int which_b)
{
  int i, k, all = a->n_found == b->n_found;
  for (i = 0; i < a->n_found; i++) {
    int any = i == which_a;
    for (k = 0; k < b->n_found; k++)
      any |= k != which_b && a->found[i].param == b->found[k].param && a->found[i].term == b->found[k].term;
    all &= any;
  }
  return all;
}

int loop_is_same(const lab_attempt *a, const lab_attempt *b)
{
  return is_alike_but(a, -1, b, -1);
}

void loop_note_alike(lab_attempt *model, int which, const lab_attempt *pool, int n)
{
  lab_found *found = &model->found[which];
  int i, k;
  found->n_alike = 0;
  for (i = 0; found->effect >= 0 && i < n; i++) {
    const int last = pool[i].n_found - 1, effect = pool[i].found[last].effect;
    int known = fmin(pool[i].bic - model->bic, pool[i].chi2 - model->chi2) > alike_bic || effect < 0 ||
                effect == found->effect || !is_alike_but(model, which, &pool[i], last);
    for (k = 0; k < found->n_alike; k++)
      known |= found->alike[k] == effect;
    if (known)
      continue;
    if (found->n_alike < LAB_LOOP_LEADERS)
      found->alike_params[found->n_alike] = pool[i].u.rig.params;
    found->alike[found->n_alike++] = effect;
  }
}

void loop_note_alike_best(lab_attempt *pool, int n)
{
  loop_note_alike(&pool[0], pool[0].n_found - 1, pool + 1, n - 1);
}
