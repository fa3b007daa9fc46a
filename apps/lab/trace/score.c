#include "score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/clock.h"
#include "../base/quantile.h"
#include "../fit/nuisance.h"
#include "decide.h"

/* ---- A fitted model, seen from its residual ---- */

double lab_projection_visible(const lab_projection *p, double *v)
{
  const double whole = sqrt(lab_dot(v, v, p->m));
  const double left = whole > 0 ? lab_project_out(p->basis, p->n_basis, p->m, p->m, v) : 0;
  return left > lab_constant(LAB_INVISIBLE) * whole ? left : 0;
}

static int fail_spent(lab_error *error)
{
  return lab_fail(error, LAB_NUMERIC, "the CPU time that was given is spent");
}

/* Make the columns of slopes an orthonormal basis of their span. */
static void orthonormalise(lab_projection *p, int columns)
{
  size_t i;
  int j;
  for (j = 0; j < columns; j++) {
    double *to = p->basis + (size_t)p->n_basis * p->m, *column = p->basis + (size_t)j * p->m;
    const double left = lab_projection_visible(p, column);
    if (!(left > 0))
      continue;
    for (i = 0; i < p->m; i++)
      to[i] = column[i] / left;
    p->n_basis++;
  }
}

/* Slopes of the first n unknowns, as they are known or anew. */
static int find_slopes(lab_unknowns *u, int n, const double *r, double *J, lab_error *error)
{
  char done[LAB_FIT_MAX];
  int j;
  for (j = 0; j < u->n; j++) {
    done[j] = j >= n || (u->slopes && u->has_slope[j]);
    if (j < n && done[j])
      memcpy(J + (size_t)j * u->m, u->slopes + (size_t)j * u->m, u->m * sizeof *J);
  }
  return lab_unknowns_slopes(u, r, done, J, error);
}

/* With the slopes of the first n unknowns. */
static int open_with(lab_unknowns *u, int n, lab_projection *p, lab_error *error)
{
  int status;
  memset(p, 0, sizeof *p);
  p->u = u;
  lab_unknowns_count(u);
  p->m = u->m;
  p->r = malloc(p->m * sizeof *p->r);
  p->basis = malloc((size_t)(u->n + 1) * p->m * sizeof *p->basis);
  if (!p->r || !p->basis)
    return lab_fail_memory(error, "a projection");
  if (lab_unknowns_residuals(u, NULL, p->r, error))
    return error->status;
  status = find_slopes(u, n, p->r, p->basis, error);
  if (status == LAB_OK && lab_cpu_is_spent(u->until))
    return fail_spent(error);
  if (status == LAB_OK)
    orthonormalise(p, n);
  p->excess = lab_dot(p->r, p->r, u->n_data) - (double)u->n_values;
  return status;
}

int lab_projection_open(lab_unknowns *u, lab_projection *p, lab_error *error)
{
  return open_with(u, u->n, p, error);
}

int lab_projection_open_rest(lab_unknowns *u, lab_projection *p, lab_error *error)
{
  return open_with(u, u->n - 1, p, error);
}

void lab_projection_close(lab_projection *p)
{
  free(p->r);
  free(p->basis);
  memset(p, 0, sizeof *p);
}

int lab_projection_slope(const lab_projection *p, const lab_rig *model, double *slope, lab_error *error)
{
  if (lab_cpu_is_spent(p->u->until))
    return fail_spent(error);
  return lab_unknowns_change_with(p->u, model, p->r, slope, error);
}

/* ---- Scores of effects ---- */

static const double shapes[LAB_SCORE_SHAPES] = {0.3, 1.0, 3.0}; /* over the usual shape */

/* The statistic of a slope that was taken over a step; the score keeps it if it is larger than what it has. */
static void judge(const lab_projection *p, const lab_trial *trial, double *slope, double step, lab_score *score)
{
  const double whole = sqrt(lab_dot(slope, slope, p->m)), left = lab_projection_visible(p, slope);
  double along, size, statistic;
  if (!(left > 0))
    return;
  along = lab_dot(slope, p->r, p->m) / left;
  size = -along / left * step; /* r + (size/step) slope is least */
  statistic = along * along;
  if ((size > 0 && !(trial->up > 0)) || (size < 0 && !(trial->down > 0))) {
    score->against = fmax(score->against, statistic);
    statistic = 0;
  }
  if (score->visible > 0 && statistic <= score->statistic)
    return;
  score->statistic = statistic;
  score->size = fmax(fmin(size, trial->up), -trial->down) + trial->offset;
  score->shape_value = trial->shape_value;
  score->visible = left / whole;
}

int lab_score_try(const lab_projection *p, const lab_trial *trial, lab_score *score, double *slope, lab_error *all)
{
  lab_error error;
  double step = trial->usual, length;
  int i, tests = 0;
  for (i = 0; i < lab_count(LAB_SLOPE_SIZES); i++) {
    if (trial->slope(trial->context, step, slope, &error)) {
      lab_fail_together(all, &error);
      step *= lab_constant(LAB_SLOPE_SMALL);
      continue;
    }
    length = sqrt(lab_dot(slope, slope, p->m));
    judge(p, trial, slope, step, score);
    tests++;
    if (!(length > lab_constant(LAB_SLOPE_LONG)))
      break;
    step *= lab_constant(LAB_SLOPE_SEEN) / length;
  }
  return tests;
}

/* An effect of one shape, tried in a model. */
typedef struct shaped_effect {
  const lab_projection *p;
  lab_rig model;
  int param;
  double present;
} shaped_effect;

static int effect_slope(void *context, double size, double *slope, lab_error *error)
{
  shaped_effect *e = context;
  *pneu_param_at(&e->model.params, e->param) = (pneu_real)(e->present + size);
  return lab_projection_slope(e->p, &e->model, slope, error);
}

/* What is usual for a rig: a small chamber has a small tube. */
static double usual_shape(const pneu_params *p, const pneu_param_info *info)
{
  static const double most = 0.5; /* of what the chamber has beside its stroke, by judgement */
  const double usual = (double)info->value;
  return strcmp(info->unit, "m3") == 0 ? fmin(usual, most * (double)p->dead_volume) : usual;
}

double lab_score_shape(const pneu_params *p, const lab_score *score, int which)
{
  const pneu_param_info info = lab_param_info(score->shape);
  return fmin(fmax(shapes[which] * usual_shape(p, &info), (double)info.lower), (double)info.upper);
}

/* How much of the stroke a log has not used; 0 without a position. */
static double unused_stroke(const lab_run *x)
{
  static const size_t one_in = 100; /* may lie higher: noise */
  const double *from = x->log->value[LAB_CHANNEL_X];
  double *value = from ? malloc((x->n + 1) * sizeof *value) : NULL, left = 0;
  size_t i, n = 0;
  for (i = 0; value && i < x->n; i++)
    if (!isnan(from[x->first + i]))
      value[n++] = from[x->first + i];
  if (n > 0) {
    lab_sort(value, n);
    left = (double)x->rig->params.stroke - value[n - 1 - n / one_in];
  }
  free(value);
  return left;
}

/* Whether an effect shows from a size on: behind a positioner that does not ask for the whole stroke nothing, before
 * the stem meets its stop. */
static int shows_late(const lab_unknowns *u, int param)
{
  return param == pneu_param_find("travel_limit.travel_loss") && u->n_runs > 0 &&
         lab_log_command(u->run->log) == LAB_CHANNEL_SP && lab_rig_has_positioner(&u->rig);
}

double lab_score_usual(const lab_unknowns *u, int param)
{
  const pneu_param_info info = lab_param_info(param);
  const double present = lab_param_value(&u->rig, param);
  double least = HUGE_VAL;
  int e;
  for (e = 0; e < u->n_runs && shows_late(u, param); e++)
    least = fmin(least, unused_stroke(&u->run[e]) - present);
  return isfinite(least) && least > 0 ? least : (double)info.value - (double)info.neutral;
}

/* One shape of an effect, in the model that is scored. */
static void prepare(const lab_projection *p, const lab_score *score, int which, shaped_effect *effect, lab_trial *trial)
{
  const pneu_param_info info = lab_param_info(score->param);
  *effect = (shaped_effect){.p = p, .model = p->u->rig, .param = score->param};
  *trial = (lab_trial){.slope = effect_slope, .context = effect};
  effect->present = (double)*pneu_param_at(&effect->model.params, score->param); /* neutral, but for one that is held */
  trial->usual = lab_score_usual(p->u, score->param);
  trial->up = (double)info.upper - effect->present;
  trial->down = effect->present - (double)info.lower;
  trial->offset = effect->present - (double)info.neutral;
  if (score->shape < 0)
    return;
  trial->shape_value = lab_score_shape(&effect->model.params, score, which);
  *pneu_param_at(&effect->model.params, score->shape) = (pneu_real)trial->shape_value;
}

static int shapes_of(const lab_score *score)
{
  return score->shape >= 0 ? LAB_SCORE_SHAPES : 1;
}

/* Score an effect in every shape, one after the other; those that are `done` already apart.  Returns: the number of
 * slopes that were judged */
static int score_effect(const lab_projection *p, lab_score *score, const char *done, lab_error *all)
{
  lab_error error;
  double *slope = malloc(p->m * sizeof *slope);
  int k, tests = 0;
  if (!slope) {
    lab_fail_memory(&error, "a slope");
    lab_fail_together(all, &error);
    return 0;
  }
  for (k = 0; k < shapes_of(score); k++) {
    shaped_effect effect;
    lab_trial trial;
    if (done[k])
      continue;
    prepare(p, score, k, &effect, &trial);
    tests += lab_score_try(p, &trial, score, slope, all);
  }
  free(slope);
  return tests;
}

/* Whether the model does not have an effect: all is neutral, and nothing of it is fitted.
 * Out:     shape  its first parameter that is only a shape; -1 if none is */
static int is_absent(const lab_unknowns *u, int first, int count, int *shape)
{
  int i;
  *shape = -1;
  for (i = first + count - 1; i >= first; i--) {
    const int j = lab_unknowns_find(u, i);
    const int held = j >= 0 ? lab_unknown_is_held(&u->unknown[j]) : u->nuisance && lab_nuisance_holds(u->nuisance, i);
    const pneu_param_info info = lab_param_info(i);
    if (lab_unknowns_find_onset(u, i) >= 0 ||
        (!held && (j >= 0 || (!info.shape && lab_param_value(&u->rig, i) != (double)info.neutral))))
      return 0;
    if (info.shape == PNEU_FORM_OWN)
      *shape = i;
  }
  return 1;
}

int lab_score_lacks(const lab_unknowns *u, int effect)
{
  int count, shape;
  const int first = pneu_effect_params(effect, &count);
  return is_absent(u, first, count, &shape);
}

/* Whether an effect does anything to a rig at its usual size. */
static int can_act(const lab_rig *rig, int effect)
{
  const pneu_effect *e = pneu_effect_at(effect);
  pneu_real *usual;
  lab_error ignored;
  pneu_model model;
  int i, count;
  if (!e->acts || lab_rig_model(rig, &model, &ignored))
    return 1;
  pneu_effect_params(effect, &count);
  usual = &model.p.effect[model.param_of[effect]];
  for (i = 0; i < count; i++)
    usual[i] = e->param[i].value;
  return e->acts(&model, usual) != PNEU_RESTS;
}

int lab_score_can_be_missing(const lab_rig *rig, int effect)
{
  const char *name = pneu_effect_at(effect)->name;
  if (strncmp(name, "positioner", strlen("positioner")) == 0)
    return strcmp(name, "positioner") != 0 && lab_rig_has_positioner(rig);
  return can_act(rig, effect);
}

/* Whether the logs measure what an effect sets apart: the skew of channels takes two. */
static int is_measured(const lab_unknowns *u, int effect)
{
  int e, several = strcmp(pneu_effect_at(effect)->name, "channel_skew") != 0;
  for (e = 0; e < u->n_runs; e++)
    several |= u->run[e].n_channels > 1;
  return several;
}

/* Every parameter that switches on an effect which the model does not have. */
static void list_effects(const lab_unknowns *u, lab_scores *scores)
{
  int e, i, count, shape;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    if (!is_absent(u, first, count, &shape) || !lab_score_can_be_missing(&u->rig, e) || !is_measured(u, e))
      continue;
    for (i = first; i < first + count && scores->n < LAB_SCORES_MAX; i++) {
      const pneu_param_info info = lab_param_info(i);
      if (info.shape)
        continue;
      scores->of[scores->n].effect = e;
      scores->of[scores->n].param = i;
      scores->of[scores->n++].shape = shape;
    }
  }
}

int lab_score_by_statistic(const void *a, const void *b)
{
  const lab_score *x = a, *y = b;
  if (x->statistic != y->statistic)
    return x->statistic < y->statistic ? 1 : -1;
  return x->param - y->param;
}

/* All shapes of all effects, a little of each.  Out: model  Returns: their number */
static int list_models(const lab_projection *p, const lab_scores *scores, double share, lab_rig *model)
{
  shaped_effect effect;
  lab_trial trial;
  int i, k, n = 0;
  for (i = 0; i < scores->n; i++)
    for (k = 0; k < shapes_of(&scores->of[i]); k++) {
      prepare(p, &scores->of[i], k, &effect, &trial);
      model[n] = effect.model;
      *pneu_param_at(&model[n++].params, effect.param) = (pneu_real)(effect.present + share * trial.usual);
    }
  return n;
}

/* Score what changes little of the states from one run of each experiment, at the beginning of its slope.
 * Out:     done   LAB_SCORE_SHAPES of each score
 *          tests  slopes that were judged */
static int score_together(const lab_projection *p, lab_scores *scores, char *done, int *tests, lab_error *error)
{
  static const double share = 1e-3; /* of the usual size */
  const size_t room = LAB_SCORE_SHAPES * (size_t)scores->n + 1;
  lab_rig *model = malloc(room * sizeof *model);
  double *columns = malloc(room * p->m * sizeof *columns);
  char followed[LAB_SCORES_MAX * LAB_SCORE_SHAPES];
  int i, k, n, status = model && columns ? LAB_OK : lab_fail_memory(error, "scores");
  *tests = 0;
  if (status == LAB_OK)
    status = lab_unknowns_changes_with(p->u, model, list_models(p, scores, share, model), columns, followed, error);
  for (n = 0, i = 0; i < scores->n && status == LAB_OK; i++)
    for (k = 0; k < shapes_of(&scores->of[i]); k++, n++) {
      shaped_effect effect;
      lab_trial trial;
      if (!followed[n] || shows_late(p->u, scores->of[i].param))
        continue;
      prepare(p, &scores->of[i], k, &effect, &trial);
      judge(p, &trial, columns + (size_t)n * p->m, share * trial.usual, &scores->of[i]);
      done[i * LAB_SCORE_SHAPES + k] = 1;
      *tests += 1;
    }
  free(model);
  free(columns);
  return status;
}

int lab_score_effects(const lab_projection *p, lab_scores *scores, lab_error *error)
{
  char done[LAB_SCORES_MAX * LAB_SCORE_SHAPES] = {0};
  int i, tests;
  error->status = LAB_OK;
  memset(scores, 0, sizeof *scores);
  list_effects(p->u, scores);
  if (score_together(p, scores, done, &tests, error))
    return error->status;
#pragma omp parallel for schedule(dynamic) reduction(+ : tests)
  for (i = 0; i < scores->n; i++)
    tests += score_effect(p, &scores->of[i], done + i * LAB_SCORE_SHAPES, error);
  for (i = 0; i < scores->n; i++) {
    scores->of[i].p_value = lab_chi2_tail(scores->of[i].statistic, 1);
    scores->of[i].explained = p->excess > 0 ? scores->of[i].statistic / p->excess : 0;
  }
  scores->tests = tests;
  qsort(scores->of, (size_t)scores->n, sizeof *scores->of, lab_score_by_statistic);
  return error->status;
}
