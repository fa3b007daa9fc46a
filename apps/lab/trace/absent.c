#include "absent.h"

#include <stdlib.h>

#include "../base/clock.h"

/* The effect of a parameter that all runs share, -1 if it has none. */
static int effect_of(const lab_unknown *x)
{
  const int is_shared = x->kind == LAB_UNKNOWN_PARAM && x->run == LAB_ALL_RUNS;
  return is_shared && x->index != LAB_PARAM_ORIFICE_AREA ? pneu_effect_of(x->index) : -1;
}

static int was_found(const lab_candidate *c, int effect)
{
  int i, any = 0;
  for (i = 0; i < c->n_found; i++)
    any |= c->found[i].effect == effect;
  return any;
}

/* Whether an unknown is the size of an effect that the rig file declares. */
static int is_declared_size(const lab_candidate *c, const lab_unknown *x)
{
  const int effect = effect_of(x);
  const pneu_param_info info = effect < 0 ? (pneu_param_info){0} : lab_param_info(x->index);
  return effect >= 0 && lab_score_can_be_missing(&c->u.rig, effect) && !info.shape && !lab_unknown_is_known(x) &&
         !was_found(c, effect) && x->lower <= (double)info.neutral && (double)info.neutral < x->upper;
}

static void rest_at(lab_unknown *x, double value)
{
  x->value = x->lower = x->upper = value;
}

/* The same without the effect of one of its unknowns. */
static int leave_out(const lab_candidate *c, int j, lab_candidate *without, lab_error *error)
{
  const int effect = effect_of(&c->u.unknown[j]);
  int i;
  *without = *c;
  without->u.slopes = NULL;
  for (i = 0; i < c->u.n; i++) {
    lab_unknown *x = &without->u.unknown[i];
    if (effect_of(x) == effect)
      rest_at(x, lab_param_info(x->index).shape ? x->value : (double)lab_param_info(x->index).neutral);
  }
  lab_unknowns_take(&without->u);
  return lab_candidate_fit(without, LAB_ROUNDS_ALL, error) == LAB_WORLD ? LAB_WORLD : LAB_OK;
}

int lab_absent_find(lab_candidate *c, int *any, lab_error *error)
{
  lab_candidate *without = malloc(sizeof *without);
  int j, status = without ? LAB_OK : lab_fail_memory(error, "a candidate");
  *any = 0;
  for (j = 0; j < c->u.n && status == LAB_OK && !lab_cpu_is_spent(c->u.until); j++) {
    if (!is_declared_size(c, &c->u.unknown[j]))
      continue;
    status = leave_out(c, j, without, error);
    if (status == LAB_OK && without->quality.fitted && without->quality.bic <= c->quality.bic) {
      *c = *without;
      *any = 1;
    }
  }
  free(without);
  return status;
}
