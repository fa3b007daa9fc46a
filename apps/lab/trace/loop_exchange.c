/* What was found before is put to the test again when something else has come. */
#include <stdlib.h>

#include "loop_private.h"

/* Without one of the found effects, fitted again, or not fitted where no fit is found.  Returns: LAB_OK, LAB_WORLD. */
static int leave_out(const lab_attempt *a, int which, lab_attempt *without, lab_error *error)
{
  int k;
  *without = *a;
  if (a->found[which].shape >= 0)
    lab_unknowns_drop(&without->u, a->found[which].shape);
  lab_unknowns_drop(&without->u, a->found[which].param);
  for (k = which; k + 1 < without->n_found; k++)
    without->found[k] = without->found[k + 1];
  without->n_found--;
  return lab_attempt_fit(without, LAB_FIT_WHOLE, error) == LAB_WORLD ? LAB_WORLD : LAB_OK;
}

int loop_remove_needless(lab_attempt *a, lab_error *error)
{
  lab_attempt *without = malloc(sizeof *without);
  int i, status = without ? LAB_OK : lab_fail_memory(error, "the search");
  for (i = 0; status == LAB_OK && a->n_found > 1 && i < a->n_found - 1; i++) {
    if (a->found[i].term >= 0)
      continue;
    status = leave_out(a, i, without, error);
    if (status == LAB_OK && without->fitted && without->bic <= a->bic) {
      *a = *without;
      i = -1;
    }
  }
  free(without);
  return status;
}

int loop_exchange(search *s, lab_error *error)
{
  lab_attempt *without = malloc(sizeof *without);
  int i, status = without ? LAB_OK : lab_fail_memory(error, "the search");
  for (i = 0; status == LAB_OK && i < s->beam[0].n_found - 1; i++) {
    if (s->beam[0].found[i].term >= 0)
      continue;
    status = leave_out(&s->beam[0], i, without, error);
    if (status != LAB_OK || !without->fitted)
      continue;
    s->n_pool = 0;
    status = loop_extend(s, without, error);
    loop_rank(s);
    if (s->n_pool > 0 && s->pool[0].bic < s->beam[0].bic) {
      lab_attempt_explain(&s->pool[0], without->chi2);
      loop_note_alike_best(s->pool, s->n_pool);
      s->beam[0] = s->pool[0];
    } else
      loop_note_alike(&s->beam[0], i, s->pool, s->n_pool);
  }
  free(without);
  return status;
}
