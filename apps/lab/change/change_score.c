/* Which differences the new logs may have, and what speaks for each. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../trace/decide.h"
#include "../base/array.h"
#include "../base/quantile.h"
#include "repeat.h"
#include "sides.h"

/* ---- Scores ---- */

/* A difference that the new logs have, tried. */
typedef struct tried {
  lab_unknowns u; /* with the change as the last unknown */
  double theta[LAB_FIT_MAX];
  const lab_projection *p;
  double *r; /* p->m, and that of the change's own prior */
} tried;

static int change_slope(void *context, double size, double *slope, lab_error *error)
{
  tried *t = context;
  double *own = malloc(t->u.m * sizeof *own);
  size_t i;
  int status = own ? lab_unknowns_difference(&t->u, t->theta, t->r, t->u.n - 1, size, own, error)
                   : lab_fail_memory(error, "a slope");
  for (i = 0; i < t->p->m && status == LAB_OK; i++)
    slope[i] = own[i] * size;
  free(own);
  return status;
}

/* Put the change into the unknowns.  Returns: LAB_OK, LAB_DATA without room, LAB_WORLD */
static int begin_trial(const lab_projection *p, int first, int param, tried *t, lab_error *error)
{
  t->p = p;
  t->u = *p->u;
  if (lab_unknowns_add_change(&t->u, param, first, 0, error))
    return error->status;
  t->u.m++;
  lab_unknowns_values(&t->u, t->theta);
  t->r = calloc(t->u.m, sizeof *t->r);
  if (!t->r)
    return lab_fail_memory(error, "residuals");
  memcpy(t->r, p->r, p->m * sizeof *t->r);
  return LAB_OK;
}

double lab_change_usual(const lab_unknowns *u, int param)
{
  const pneu_param_info info = lab_param_info(param);
  const double now = lab_param_value(&u->rig, param);
  return lab_param_is_value(param) ? 0.1 * fabs(now != 0 ? now : (double)info.value)
                                   : (double)info.value - (double)info.neutral;
}

/* Score what may differ from day to day: whether it differs by more. That is the slope of its prior alone, the rest of
 * it being fitted.  Returns: as score_change */
static int score_release(const lab_projection *p, int j, lab_score *score, lab_error *all)
{
  lab_error error;
  double *slope = calloc(p->m, sizeof *slope);
  const size_t prior = p->u->n_data + (size_t)j;
  if (!slope) {
    lab_fail_memory(&error, "a score");
    lab_fail_together(all, &error);
    return 0;
  }
  slope[prior] = 1;
  score->visible = lab_projection_visible(p, slope);
  if (score->visible > 0)
    score->statistic = pow(lab_dot(slope, p->r, p->m) / score->visible, 2);
  score->size = p->u->unknown[j].value;
  free(slope);
  return 1;
}

/* Score a change of one shape as if it acted from a row of the new log on.  Returns: the number of slopes judged */
static int score_since(tried *t, const lab_trial *trial, size_t row, double *slope, lab_score *score, lab_error *all)
{
  static const double beyond = 15; /* chi-square with p = 1e-4: by what an onset must be better than none */
  const lab_run *run = &t->u.run[t->u.unknown[t->u.n - 1].run];
  lab_score since = *score;
  int tests;
  since.statistic = 0;
  t->u.unknown[t->u.n - 1].from = run->log->value[LAB_CHANNEL_TIME][run->first + row];
  tests = lab_score_try(t->p, trial, &since, slope, all);
  if (since.statistic > score->statistic + (score->onset > 0 ? 0 : beyond)) {
    *score = since;
    score->onset = row;
  }
  return tests;
}

static void set_shape(tried *t, lab_trial *trial, int shape, double value)
{
  trial->shape_value = value;
  *pneu_param_at(&t->u.rig.params, shape) = (pneu_real)value;
}

/* Score every shape throughout the new log; or the best, else the first, from some rows of it on.
 * In:      within  which of these
 * Returns: the number of slopes judged */
static int score_shapes(tried *t, lab_trial *trial, int within, lab_score *score, lab_error *all)
{
  const int shapes = score->shape >= 0 ? LAB_SCORE_SHAPES : 1;
  double *slope = malloc(t->p->m * sizeof *slope);
  lab_error error;
  int k, tests = 0;
  if (!slope) {
    lab_fail_memory(&error, "a slope");
    lab_fail_together(all, &error);
    return 0;
  }
  for (k = 0; k < shapes && !within; k++) {
    if (score->shape >= 0)
      set_shape(t, trial, score->shape, lab_score_shape(&t->u.rig.params, score, k));
    tests += lab_score_try(t->p, trial, score, slope, all);
  }
  if (within && score->shape >= 0)
    set_shape(t, trial, score->shape,
              score->shape_value > 0 ? score->shape_value : lab_score_shape(&t->u.rig.params, score, 0));
  for (k = 1; k < LAB_ONSET_PLACES && within; k++)
    tests += score_since(t, trial, t->u.run[t->u.n_runs - 1].n * (size_t)k / LAB_ONSET_PLACES, slope, score, all);
  free(slope);
  return tests;
}

/* In:  as score_shapes  Returns: the same */
static int score_new(const lab_projection *p, int first, int within, lab_score *score, lab_error *all)
{
  lab_error error = {LAB_OK, ""};
  tried *t = calloc(1, sizeof *t);
  int tests = 0;
  if (!t)
    lab_fail_memory(&error, "a score");
  else if (begin_trial(p, first, score->param, t, &error) == LAB_OK) {
    const lab_unknown *x = &t->u.unknown[t->u.n - 1];
    lab_trial trial = {lab_change_usual(&t->u, score->param), x->upper, -x->lower, 0, change_slope, t, 0};
    if (trial.usual > trial.up)
      trial.usual = -trial.usual;
    tests = score_shapes(t, &trial, within, score, all);
  }
  lab_fail_together(all, &error);
  if (t)
    free(t->r);
  free(t);
  return tests;
}

/* Half of the chance of a false one is for what acts throughout, half for its parts. */
static void judge(lab_score *score, int parts)
{
  score->p_value = 2 * lab_chi2_tail(score->statistic, 1) * (score->onset > 0 ? parts : 1);
}

static int score_change(const lab_projection *p, int first, lab_score *score, lab_error *all)
{
  const int j = lab_sides_find(p->u, score->param);
  const int tests = j >= 0 ? score_release(p, j, score, all) : score_new(p, first, 0, score, all);
  judge(score, 0);
  return tests;
}

/* What acts from some rows on shows in all of them as well, but where it may differ from day to day: only such changes
 * and the first of the others are asked for their parts. */
static void score_parts(const lab_projection *p, int first, lab_scores *scores, lab_error *all)
{
  enum { ASKED = 2 * LAB_CHANGE_LEADERS };
  const double noise = lab_constant(LAB_NOISE_DEVIATIONS) * sqrt(2 * (double)p->u->n_values);
  int i;
  if (first + 1 < p->u->n_runs || p->u->window > 0 || !(p->excess > noise))
    return;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < scores->n; i++)
    if (i < ASKED || lab_sides_find(p->u, scores->of[i].param) >= 0)
      judge(&scores->of[i], score_new(p, first, 1, &scores->of[i], all));
}

/* ---- What is tested ---- */

static void list_one(const lab_sides *c, int param, int shape, lab_scores *scores)
{
  const int j = lab_sides_find(&c->u, param), own = lab_unknowns_find(&c->u, param);
  int i;
  if (own >= 0 && c->u.unknown[own].run != LAB_ALL_RUNS) /* what each log has for itself is no change */
    return;
  if (param < 0 || scores->n == LAB_SCORES_MAX || (j >= 0 && c->u.unknown[j].spread == 0))
    return;
  for (i = 0; i < scores->n; i++)
    if (scores->of[i].param == param)
      return;
  scores->of[scores->n].param = param;
  scores->of[scores->n++].shape = shape;
}

/* Whether an effect is off in the model: then its shape is open as well. */
static int is_off(const lab_unknowns *u, int first, int count)
{
  int i, off = 1;
  for (i = first; i < first + count; i++) {
    const pneu_param_info info = lab_param_info(i);
    off = off && (info.shape || (lab_unknowns_find(u, i) < 0 && lab_param_value(&u->rig, i) == (double)info.neutral));
  }
  return off;
}

static void list_effects(const lab_sides *c, lab_scores *scores)
{
  int e, i, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    const int off = is_off(&c->u, first, count);
    if (!lab_score_can_be_missing(&c->u.rig, e) || strcmp(pneu_effect_at(e)->name, "start_temperature") == 0)
      continue; /* how warm the gas of a log begins is no change of a rig */
    int shape = -1;
    for (i = first + count - 1; i >= first; i--)
      if (off && lab_param_info(i).shape == PNEU_FORM_OWN)
        shape = i;
    for (i = first; i < first + count; i++)
      if (!lab_param_info(i).shape)
        list_one(c, i, shape, scores);
  }
}

/* Whether an effect is the other name of a change in a parameter. */
static int is_an_effect(int param)
{
  return param == PNEU_PARAM_vent_area && pneu_effect_find("vent_restriction") >= 0;
}

/* Whether a parameter is one of a positioner that the rig does not have. */
static int is_of_no_positioner(const lab_rig *rig, int param)
{
  const int effect = param < 0 ? -1 : pneu_effect_of(param);
  return effect >= 0 && effect == pneu_effect_find("positioner") && !lab_rig_has_positioner(rig);
}

/* What was fitted, and not held; what the table of repeats has, unless it is one of two names for the same; every
 * effect. */
static void list_changes(const lab_sides *c, lab_scores *scores)
{
  int i, j;
  memset(scores, 0, sizeof *scores);
  for (j = 0; j < c->u.n; j++) {
    const lab_unknown *x = &c->u.unknown[j];
    if (x->kind == LAB_UNKNOWN_PARAM && x->run == LAB_ALL_RUNS && !lab_unknown_is_held(x))
      list_one(c, x->index, -1, scores);
  }
  for (i = 0; i < lab_repeat_count; i++) {
    const int param = lab_param_index(lab_repeats[i].name);
    if (lab_repeats[i].tested && !is_an_effect(param) && !is_of_no_positioner(&c->u.rig, param))
      list_one(c, param, -1, scores);
  }
  list_effects(c, scores);
}

int lab_change_scores(lab_sides *c, lab_scores *scores, lab_error *error)
{
  lab_projection p;
  int i, tests = 0, status = lab_projection_open(&c->u, &p, error);
  scores->n = scores->tests = 0;
  if (status == LAB_OK) {
    list_changes(c, scores);
    error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic) reduction(+ : tests)
    for (i = 0; i < scores->n; i++)
      tests += score_change(&p, c->first, &scores->of[i], error);
    scores->tests = tests;
    qsort(scores->of, (size_t)scores->n, sizeof *scores->of, lab_score_by_statistic);
    score_parts(&p, c->first, scores, error);
    qsort(scores->of, (size_t)scores->n, sizeof *scores->of, lab_score_by_statistic);
    status = error->status;
  }
  lab_projection_close(&p);
  return status;
}
