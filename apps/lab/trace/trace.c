#include "trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"

/* A slope is taken at the usual size of a parameter and, where that changes the residual by far more than can just be
 * seen, at shorter ones until it does not; at a small one where the usual one fails. */
static const double far_more = 40, just_seen = 20, small = 0.02;
static const double shapes[] = {0.3, 1.0, 3.0}; /* over the usual shape */
enum { SHAPES = sizeof shapes / sizeof *shapes, SIZES = 3 };

/* The statistic of one slope; the candidate keeps it if it is larger than what it has. */
static void judge(const lab_scan *s, double *slope, double step, double room_up, double room_down, lab_candidate *c,
                  double shape_value)
{
  const double whole = sqrt(lab_dot(slope, slope, s->m)), left = lab_scan_visible(s, slope);
  double score, size, statistic;
  if (!(left > 0))
    return;
  score = lab_dot(slope, s->r, s->m) / left;
  size = -score / left * step; /* r + (size/step) slope is least */
  statistic = score * score;
  if ((size > 0 && !(room_up > 0)) || (size < 0 && !(room_down > 0))) {
    c->against = fmax(c->against, statistic);
    statistic = 0;
  }
  if (c->visible > 0 && statistic <= c->statistic)
    return;
  c->statistic = statistic;
  c->size = fmax(fmin(size, room_up), -room_down);
  c->shape_value = shape_value;
  c->visible = left / whole;
}

/* Difference of residuals for a step of the candidate's parameter. */
static int slope_of(const lab_scan *s, const lab_candidate *c, double value, double shape_value, double *slope,
                    lab_error *error)
{
  lab_rig model = s->u->rig;
  *pneu_param_at(&model.params, c->param) = (pneu_real)value;
  if (c->shape >= 0)
    *pneu_param_at(&model.params, c->shape) = (pneu_real)shape_value;
  return lab_scan_difference(s, &model, slope, error);
}

/* One shape of a candidate.  Returns: the number of slopes that were judged */
static int try_shape(const lab_scan *s, lab_candidate *c, double shape_value, double *slope, lab_error *all)
{
  pneu_param_info info;
  lab_error error;
  double neutral, step;
  int i, tests = 0;
  pneu_param_describe(c->param, &info);
  neutral = (double)info.neutral;
  step = (double)info.value - neutral;
  for (i = 0; i < SIZES; i++) {
    double length;
    if (slope_of(s, c, neutral + step, shape_value, slope, &error)) {
      lab_fail_together(all, &error);
      step *= small;
      continue;
    }
    length = sqrt(lab_dot(slope, slope, s->m));
    judge(s, slope, step, (double)info.upper - neutral, neutral - (double)info.lower, c, shape_value);
    tests++;
    if (!(length > far_more))
      break;
    step *= just_seen / length;
  }
  return tests;
}

static int try_candidate(const lab_scan *s, lab_candidate *c, lab_error *all)
{
  lab_error error;
  double *slope = malloc(s->m * sizeof *slope);
  pneu_param_info shape = {0};
  int k, tests = 0;
  if (!slope) {
    lab_fail_memory(&error, "a slope");
    lab_fail_together(all, &error);
    return 0;
  }
  if (c->shape >= 0)
    pneu_param_describe(c->shape, &shape);
  for (k = 0; k < (c->shape >= 0 ? SHAPES : 1); k++)
    tests += try_shape(s, c, fmin(fmax(shapes[k] * (double)shape.value, (double)shape.lower), (double)shape.upper),
                       slope, all);
  c->p_value = lab_chi2_tail(c->statistic, 1);
  c->explained = s->excess > 0 ? c->statistic / s->excess : 0;
  free(slope);
  return tests;
}

static int is_neutral(const pneu_params *params, int effect)
{
  int i, count;
  const int first = pneu_effect_params(effect, &count);
  for (i = 0; i < count; i++) {
    pneu_param_info info;
    pneu_param_describe(first + i, &info);
    if (!info.shape && *pneu_param_at((pneu_params *)params, first + i) != info.neutral)
      return 0;
  }
  return 1;
}

/* Whether one of these parameters is fitted already. */
static int is_unknown(const lab_unknowns *u, int first, int count)
{
  int i, any = 0;
  for (i = 0; i < count; i++)
    any |= lab_unknowns_find(u, first + i) >= 0;
  return any;
}

/* Every parameter that switches on an effect which the model does not have. */
static void list_candidates(const lab_unknowns *u, lab_trace_result *result)
{
  int e, i, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    int shape = -1;
    pneu_param_info info;
    if (!is_neutral(&u->rig.params, e) || is_unknown(u, first, count))
      continue;
    for (i = count - 1; i >= 0; i--) {
      pneu_param_describe(first + i, &info);
      if (info.shape)
        shape = first + i;
    }
    for (i = 0; i < count && result->n < LAB_TRACE_MAX; i++) {
      pneu_param_describe(first + i, &info);
      if (info.shape)
        continue;
      result->candidate[result->n].effect = e;
      result->candidate[result->n].param = first + i;
      result->candidate[result->n++].shape = shape;
    }
  }
}

static int by_statistic(const void *a, const void *b)
{
  const lab_candidate *x = a, *y = b;
  if (x->statistic != y->statistic)
    return x->statistic < y->statistic ? 1 : -1;
  return x->param - y->param;
}

int lab_trace_effects(const lab_scan *s, lab_trace_result *result, lab_error *error)
{
  int i, tests = 0;
  error->status = LAB_OK;
  memset(result, 0, sizeof *result);
  list_candidates(s->u, result);
#pragma omp parallel for schedule(dynamic) reduction(+ : tests)
  for (i = 0; i < result->n; i++)
    tests += try_candidate(s, &result->candidate[i], error);
  result->tests = tests;
  qsort(result->candidate, (size_t)result->n, sizeof *result->candidate, by_statistic);
  return error->status;
}
