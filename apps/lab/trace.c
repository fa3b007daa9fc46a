#include "trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sizes at which a slope is taken, over the usual size; shapes over the usual shape. */
static const double sizes[] = {0.02, 1.0};
static const double shapes[] = {0.3, 1.0, 3.0};
enum { SIZES = sizeof sizes / sizeof *sizes, SHAPES = sizeof shapes / sizeof *shapes };

static const double invisible = 1e-6; /* share of a slope below which it counts as absorbed */

/* What a scan works on. */
typedef struct scan {
  lab_unknowns *u;
  size_t m;
  double *r;     /* residual */
  double *basis; /* n_basis orthonormal columns that span J */
  int n_basis;
  double excess;
} scan;

double lab_chi2_p(double statistic)
{
  return erfc(sqrt(statistic / 2));
}

static double dot(const double *a, const double *b, size_t m)
{
  double sum = 0;
  size_t i;
  for (i = 0; i < m; i++)
    sum += a[i] * b[i];
  return sum;
}

/* Take the span of the basis out of v, twice for rounding.  Returns: length left. */
static double project_out(const scan *s, double *v)
{
  int j, pass;
  size_t i;
  for (pass = 0; pass < 2; pass++)
    for (j = 0; j < s->n_basis; j++) {
      const double *b = s->basis + (size_t)j * s->m;
      const double c = dot(b, v, s->m);
      for (i = 0; i < s->m; i++)
        v[i] -= c * b[i];
    }
  return sqrt(dot(v, v, s->m));
}

static void normalise(double *v, double length, size_t m)
{
  size_t i;
  for (i = 0; i < m; i++)
    v[i] /= length;
}

/* Residual, slopes, and an orthonormal basis of their span, in place of the slopes. */
static int open_scan(lab_unknowns *u, scan *s, lab_error *error)
{
  double theta[LAB_FIT_MAX];
  int j;
  memset(s, 0, sizeof *s);
  s->u = u;
  s->m = u->m = u->n_data + (size_t)u->n;
  s->r = malloc(s->m * sizeof *s->r);
  s->basis = malloc((size_t)(u->n + 1) * s->m * sizeof *s->basis);
  if (!s->r || !s->basis)
    return lab_fail_memory(error, "a scan");
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
  if (lab_unknowns_residuals(u, theta, s->r, error) || lab_unknowns_slopes(u, theta, s->r, s->basis, error))
    return error->status;
  for (j = 0; j < u->n; j++) {
    double *column = s->basis + (size_t)j * s->m;
    const double whole = sqrt(dot(column, column, s->m)), left = project_out(s, column);
    if (!(left > invisible * whole))
      continue;
    normalise(column, left, s->m);
    if (s->n_basis != j)
      memcpy(s->basis + (size_t)s->n_basis * s->m, column, s->m * sizeof *column);
    s->n_basis++;
  }
  return LAB_OK;
}

static void close_scan(scan *s)
{
  free(s->r);
  free(s->basis);
}

/* The statistic of one slope; the candidate keeps it if it is larger than what it has. */
static void judge(const scan *s, double *slope, double step, double room_up, double room_down, lab_candidate *c,
                  double shape_value)
{
  const double whole = sqrt(dot(slope, slope, s->m)), left = whole > 0 ? project_out(s, slope) : 0;
  double score, size, statistic;
  if (!(left > invisible * whole))
    return;
  score = dot(slope, s->r, s->m) / left;
  size = -score / left * step; /* r + (size/step) slope is least */
  statistic = score * score;
  if ((size > 0 && !(room_up > 0)) || (size < 0 && !(room_down > 0)))
    statistic = 0;
  if (c->direction && statistic <= c->statistic)
    return;
  if (!c->direction)
    c->direction = malloc(s->m * sizeof *c->direction);
  if (!c->direction)
    return;
  normalise(slope, left, s->m);
  memcpy(c->direction, slope, s->m * sizeof *slope);
  c->statistic = statistic;
  c->size = fmax(fmin(size, room_up), -room_down);
  c->shape_value = shape_value;
  c->visible = left / whole;
}

/* Difference of residuals for a step of the candidate's parameter. */
static int slope_of(const scan *s, const lab_candidate *c, double value, double shape_value, double *slope)
{
  pneu_params p = s->u->params;
  lab_error ignored;
  size_t i;
  *pneu_param_at(&p, c->param) = (pneu_real)value;
  if (c->shape >= 0)
    *pneu_param_at(&p, c->shape) = (pneu_real)shape_value;
  if (lab_unknowns_residuals_with(s->u, &p, slope, &ignored))
    return -1;
  for (i = 0; i < s->m; i++)
    slope[i] -= s->r[i];
  return 0;
}

static int try_candidate(const scan *s, lab_candidate *c)
{
  double *slope = malloc(s->m * sizeof *slope);
  pneu_param_info info, shape = {0};
  int i, k, tests = 0;
  if (!slope)
    return 0;
  pneu_param_describe(c->param, &info);
  if (c->shape >= 0)
    pneu_param_describe(c->shape, &shape);
  for (k = 0; k < (c->shape >= 0 ? SHAPES : 1); k++)
    for (i = 0; i < SIZES; i++) {
      const double shape_value =
          c->shape >= 0 ? fmin(fmax(shapes[k] * (double)shape.value, (double)shape.lower), (double)shape.upper) : 0;
      const double step = sizes[i] * (double)(info.value - info.neutral);
      if (slope_of(s, c, (double)info.neutral + step, shape_value, slope))
        continue;
      judge(s, slope, step, (double)(info.upper - info.neutral), (double)(info.neutral - info.lower), c, shape_value);
      tests++;
    }
  c->p_value = lab_chi2_p(c->statistic);
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

/* Every parameter that switches on an effect which the model does not have. */
static void list_candidates(const lab_unknowns *u, lab_trace_result *result)
{
  int e, i, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    int shape = -1;
    pneu_param_info info;
    if (!is_neutral(&u->params, e))
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

int lab_trace_effects(lab_unknowns *u, lab_trace_result *result, lab_error *error)
{
  scan s;
  int i, tests = 0, status = open_scan(u, &s, error);
  memset(result, 0, sizeof *result);
  if (status == LAB_OK) {
    result->chi2 = dot(s.r, s.r, u->n_data);
    result->excess = s.excess = result->chi2 - (double)u->n_data;
    list_candidates(u, result);
#pragma omp parallel for schedule(dynamic) reduction(+ : tests)
    for (i = 0; i < result->n; i++)
      tests += try_candidate(&s, &result->candidate[i]);
    result->tests = tests;
    qsort(result->candidate, (size_t)result->n, sizeof *result->candidate, by_statistic);
  }
  close_scan(&s);
  return status;
}

void lab_trace_close(lab_trace_result *result)
{
  int i;
  for (i = 0; i < result->n; i++)
    free(result->candidate[i].direction);
  result->n = 0;
}

double lab_trace_likeness(const lab_trace_result *result, size_t m, int a, int b)
{
  const double *x = result->candidate[a].direction, *y = result->candidate[b].direction;
  return x && y ? fabs(dot(x, y, m)) : 0;
}
