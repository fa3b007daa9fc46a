/* What the search tells while it goes on, and notes for its result. */
#include <math.h>

#include "loop_private.h"

void loop_note_step(lab_loop_result *result, const lab_attempt *a)
{
  lab_step *step = result->n_steps < LAB_LOOP_STEPS ? &result->step[result->n_steps++] : NULL;
  if (!step)
    return;
  lab_attempt_name(a, step->name, sizeof step->name);
  step->chi2 = a->chi2;
  step->bic = a->bic;
}

void loop_note_way(lab_loop_result *result, const lab_attempt *a)
{
  lab_waypoint *way;
  if (result->n_path == LAB_LOOP_PATH)
    return;
  way = &result->path[result->n_path++];
  lab_attempt_name(a, way->name, sizeof way->name);
  way->chi2 = a->chi2;
  way->bic = a->bic;
  way->rig = a->u.rig;
}

/* Share by which the error of the channel that gains most falls; of all together where it is seen coarsely. */
static double gain(const lab_attempt *a, const lab_attempt *b, const lab_errors *before, const lab_errors *after)
{
  double most = a->u.window ? 1 - sqrt(b->chi2 / a->chi2) : 0;
  int c;
  for (c = 0; !a->u.window && c < LAB_CHANNEL_COUNT; c++)
    if (before->rmse[c] > 0)
      most = fmax(most, 1 - after->rmse[c] / before->rmse[c]);
  return most;
}

void loop_tell(const search *s, const char *what)
{
  if (s->options->tell)
    s->options->tell(s->options->context, what);
}

int loop_is_gain(const search *s, const lab_attempt *a, const lab_attempt *b, int *enough, lab_error *error)
{
  lab_errors before, after;
  *enough = 0;
  if (lab_loop_errors(&a->u, &before, error) || lab_loop_errors(&b->u, &after, error))
    return error->status;
  *enough = !(gain(a, b, &before, &after) < s->options->min_gain);
  return LAB_OK;
}
