#include "suspect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../fit/deviations.h"
#include "repeat.h"

/* The deviation of an unknown, 0 without one. */
static double deviation_of(const lab_explained *e, int j)
{
  return j < 0 ? 0 : e->result->fit.deviation[j];
}

/* Whether it is among what a comparison tests: effects, what changes from day to day but the weather, what is fitted;
 * not what each log has for itself, and how warm its gas is at first. */
static int can_change(const lab_unknowns *then, int param)
{
  const lab_repeat *repeat = lab_repeat_find(param);
  const int j = lab_unknowns_find(then, param), effect = pneu_effect_of(param);
  if ((j >= 0 && then->unknown[j].run != LAB_ALL_RUNS) || effect == pneu_effect_find("start_temperature"))
    return 0;
  return repeat ? repeat->tested : effect >= 0 || (j >= 0 && !lab_unknown_is_held(&then->unknown[j]));
}

/* How far a sound rig may have it elsewhere on another day. */
static double day_to_day(const lab_unknowns *now, int param)
{
  const lab_repeat *repeat = lab_repeat_find(param);
  const double *t = now->run->log->value[LAB_CHANNEL_TIME] + now->run->first;
  return repeat ? lab_repeat_spread(repeat, &now->rig, (t[now->run->n - 1] - t[0]) / (double)now->run->n) : 0;
}

static const lab_found *find_found(const lab_search_result *r, int param)
{
  int i;
  for (i = 0; i < r->n_found; i++)
    if (r->found[i].param == param)
      return &r->found[i];
  return NULL;
}

/* The shape that an effect was given with it, which the old model lacks; -1 if none. */
static int shape_beside(const lab_unknowns *then, const lab_unknowns *now, int param)
{
  const int effect = pneu_effect_of(param);
  int i, count, first = effect < 0 ? 0 : pneu_effect_params(effect, &count);
  for (i = first; effect >= 0 && i < first + count; i++)
    if (lab_param_info(i).shape == PNEU_FORM_OWN && lab_unknowns_find(now, i) >= 0 && lab_unknowns_find(then, i) < 0)
      return i;
  return -1;
}

/* The first row of the only run at or after an instant. */
static size_t row_at(const lab_run *run, double t)
{
  size_t i = 0;
  while (i + 1 < run->n && run->log->value[LAB_CHANNEL_TIME][run->first + i] < t)
    i++;
  return i;
}

/* The parameter that unknown j is the value of, throughout or from an onset on; -1 if the logs do not tell it, or it is
 * none that can change. */
static int param_of(const lab_explained *then, const lab_explained *now, int j)
{
  const lab_unknown *x = &now->u->unknown[j];
  const int param = x->kind == LAB_UNKNOWN_PARAM   ? x->index
                    : x->kind == LAB_UNKNOWN_ONSET ? now->u->rig.onset[x->index].param
                                                   : -1;
  const int is_value = param >= 0 && x->run == LAB_ALL_RUNS && !lab_param_info(param).shape;
  return is_value && now->result->fit.state[j] == LAB_STATE_FREE && can_change(then->u, param) &&
                 (pneu_effect_of(param) < 0 || find_found(now->result, param))
             ? param
             : -1;
}

/* By how much unknown j of the model of the new logs, which is a parameter's value, is off that of the old ones. */
static lab_suspect differ(const lab_explained *then, const lab_explained *now, int j, int param)
{
  const lab_unknown *x = &now->u->unknown[j];
  const int before = lab_unknowns_find(then->u, param), shape = shape_beside(then->u, now->u, param);
  const double was = before >= 0 ? then->u->unknown[before].value : lab_param_value(&then->u->rig, param);
  const double off = lab_earlier_factor(now->u, x) * x->value - was,
               known = hypot(deviation_of(now, j), deviation_of(then, before));
  lab_suspect s = {.found = find_found(now->result, param)};
  s.score.effect = pneu_effect_of(param);
  s.score.param = param;
  s.score.shape = shape;
  s.score.shape_value = shape < 0 ? 0 : lab_param_value(&now->u->rig, shape);
  s.score.onset = x->kind == LAB_UNKNOWN_ONSET ? row_at(now->u->run, now->u->rig.onset[x->index].from) : 0;
  s.score.size = param == LAB_PARAM_ORIFICE_AREA ? off / was : off;
  s.score.statistic = pow(off / hypot(known, day_to_day(now->u, param)), 2);
  return s;
}

/* What was found before what differs, and of these the plainest. */
static int by_weight(const void *one, const void *other)
{
  const lab_suspect *a = one, *b = other;
  const double x = a->score.statistic, y = b->score.statistic;
  if (!a->found != !b->found)
    return a->found ? -1 : 1;
  return x < y ? 1 : x > y ? -1 : 0;
}

int lab_suspects_find(const lab_explained *then, const lab_explained *now, lab_suspect suspect[LAB_SUSPECTS_MAX])
{
  static const double plainly = 25; /* five deviations */
  lab_suspect all[LAB_FIT_MAX];
  int j, n = 0;
  if (!lab_search_explains(then->result) || !lab_search_explains(now->result))
    return 0;
  for (j = 0; j < now->u->n; j++) {
    const int param = param_of(then, now, j);
    if (param >= 0)
      all[n] = differ(then, now, j, param);
    n += param >= 0 && all[n].score.statistic > plainly;
  }
  qsort(all, (size_t)n, sizeof *all, by_weight);
  n = n < LAB_SUSPECTS_MAX ? n : LAB_SUSPECTS_MAX;
  memcpy(suspect, all, (size_t)n * sizeof *suspect);
  return n;
}
