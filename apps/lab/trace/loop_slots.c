/* Free terms beside a model, from the slots where something is left. */
#include "../base/quantile.h"
#include "loop_private.h"
#include "nameless.h"

static const double alone = 3;    /* a slot is tried at once if it explains so much more than any effect, */
static const double mostly = 0.5; /* and so much of all there is */

static int try_slots(const search *s, const lab_attempt *base, const lab_slot *slot, int n, lab_attempt *best,
                     lab_error *error)
{
  loop_tell(s, "looking for what has no name");
  return lab_refit_slots(base, slot, n, best, error);
}

int loop_try_slots_first(const search *s, const lab_attempt *base, const lab_scan *scan, double best_effect,
                         lab_error *error)
{
  lab_slot slot[LAB_SLOT_MAX];
  int n;
  if (base->n_found > 0 || lab_any_is_noise(base, 1) || !(alone * best_effect < scan->excess))
    return LAB_OK;
  if (lab_slots_try(scan, slot, &n, error))
    return error->status;
  if (n == 0 || !(slot[0].statistic > mostly * scan->excess) || !(slot[0].statistic > alone * best_effect))
    return LAB_OK;
  return try_slots(s, base, slot, n, s->nameless, error);
}

static int slot_passes(const search *s, const lab_slot *slot)
{
  return slot->degrees > 0 &&
         lab_slot_tests(&slot->term) * lab_chi2_tail(slot->statistic, slot->degrees) < s->result->level;
}

int loop_find_slot(const search *s, const lab_attempt *base, lab_attempt *best, lab_error *error)
{
  lab_attempt copy = *base;
  lab_slot slot[LAB_SLOT_MAX];
  lab_scan scan;
  int n, status = lab_scan_open(&copy.u, &scan, error);
  best->fitted = 0;
  if (status == LAB_OK)
    status = lab_slots_try(&scan, slot, &n, error);
  if (status == LAB_OK && n > 0 && slot_passes(s, slot))
    status = try_slots(s, base, slot, n, best, error);
  lab_scan_close(&scan);
  return status;
}
