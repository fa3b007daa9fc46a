#include "advise.h"

#include <math.h>
#include <string.h>

#include "../separate/foresee.h"

/* The rig and the longest of its records, as the search for a trial sees them. */
static void inquire(const lab_story *story, lab_inquiry *q)
{
  const lab_unknowns *u = story->completed;
  const lab_experiment *x = &u->experiment[0];
  const double *t;
  int e, c;
  memset(q, 0, sizeof *q);
  for (e = 1; e < u->n_experiments; e++)
    if (u->experiment[e].n > x->n)
      x = &u->experiment[e];
  t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  q->rig = story->rig;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    q->noise[c] = (double)NAN;
  for (c = 0; c < x->n_channels; c++)
    q->noise[x->channel[c]] = x->sigma[c];
  q->recorded_duration = t[x->n - 1] - t[0];
  q->spacing = q->recorded_duration / (double)(x->n > 1 ? x->n - 1 : 1);
  q->n_fit = story->rig->n_fit;
  q->fit = story->rig->fit;
  q->recorded = &x->drive.schedule;
}

/* Whether anything was recorded that a test can be foreseen for. */
static int can_foresee(const lab_inquiry *q)
{
  int c;
  for (c = 0; c < LAB_FORESEEN; c++)
    if (q->noise[lab_foreseen[c]] > 0)
      return 1;
  return 0;
}

int lab_advise(lab_story *story, lab_error *error)
{
  const lab_loop_result *r = story->result;
  int fit[LAB_FIT_COUNT], i, alike = 0;
  lab_inquiry q;
  inquire(story, &q);
  if (!can_foresee(&q))
    return LAB_OK;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    alike += found->n_alike;
    if (found->n_alike > 0 &&
        lab_separate(&q, &story->completed->rig.params, &found->alike_params[0], &story->separate[i], error))
      return error->status;
  }
  if (alike > 0 || r->window > 0 || story->completed->rig.n_terms > 0)
    return LAB_OK;
  memcpy(fit, q.fit, (size_t)q.n_fit * sizeof *fit);
  for (i = 0; i < r->n_found; i++)
    fit[q.n_fit++] = r->found[i].param;
  q.fit = fit;
  return lab_advise_interval(&q, &story->completed->rig.params, &story->next, error);
}
