#include "spread.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"

/* Singular values below it are no more than errors of central differences of residuals exact to 1e-10: ten times its
 * power of two thirds. */
static const double floor_of_singular = 10 * 2.154434690031884e-7;

/* Chi-square over degrees of freedom up to which a model leaves noise: NOISE_SLIP of the search. */
static const double noise = 1.05 * 1.05;

/* A fit where it ended. Slopes are in units of what matters. */
typedef struct place {
  const lab_fit_problem *problem;
  const lab_fit_param *param;
  const double *theta;
  double unit[LAB_FIT_MAX];
  int held[LAB_FIT_MAX]; /* -1, 1: the data pull it against its lower, upper bound; 0: free */
  double *r, *slope;     /* m, and m * n column by column */
  double chi2;
} place;

/* Singular value decomposition of the slopes of k parameters, columns scaled to unit length. */
typedef struct spectrum {
  int k;
  int of[LAB_FIT_MAX];                /* their places */
  double length[LAB_FIT_MAX];         /* of the column before scaling */
  double *column[LAB_FIT_MAX];        /* m entries each */
  double R[LAB_FIT_MAX][LAB_FIT_MAX]; /* rows: columns of R; orthogonal afterwards, lengths are singular values */
  double V[LAB_FIT_MAX][LAB_FIT_MAX];
  double singular[LAB_FIT_MAX];
} spectrum;

/* R of the columns (modified Gram-Schmidt; Bjorck 1967: as exact as by reflections), which has their singular values.
 * The columns become orthonormal. */
static void factorise(spectrum *s, size_t m)
{
  int j, l;
  size_t i;
  memset(s->R, 0, sizeof s->R);
  for (j = 0; j < s->k; j++) {
    double *q = s->column[j];
    const double length = s->R[j][j] = sqrt(lab_dot(q, q, m));
    for (i = 0; i < m && length > 0; i++)
      q[i] /= length;
    for (l = j + 1; l < s->k; l++) {
      double *other = s->column[l];
      const double along = s->R[l][j] = lab_dot(q, other, m);
      for (i = 0; i < m; i++)
        other[i] -= along * q[i];
    }
  }
}

static void rotate(double *a, double *b, int n, double c, double s)
{
  int i;
  for (i = 0; i < n; i++) {
    const double x = a[i], y = b[i];
    a[i] = c * x - s * y;
    b[i] = s * x + c * y;
  }
}

/* Make columns p and q of R orthogonal (Hestenes 1958).  Returns: whether they were not. */
static int orthogonalise(spectrum *s, int p, int q)
{
  const size_t k = (size_t)s->k;
  const double a = lab_dot(s->R[p], s->R[p], k), b = lab_dot(s->R[q], s->R[q], k);
  const double d = lab_dot(s->R[p], s->R[q], k), zeta = (b - a) / (2 * d);
  double t, c;
  int i;
  if (fabs(d) <= 1e-15 * sqrt(a * b) || d == 0)
    return 0;
  t = (zeta < 0 ? -1 : 1) / (fabs(zeta) + sqrt(1 + zeta * zeta));
  c = 1 / sqrt(1 + t * t);
  rotate(s->R[p], s->R[q], s->k, c, c * t);
  for (i = 0; i < s->k; i++) {
    const double x = s->V[i][p], y = s->V[i][q];
    s->V[i][p] = c * x - c * t * y;
    s->V[i][q] = c * t * x + c * y;
  }
  return 1;
}

static void decompose(spectrum *s, size_t m)
{
  enum { SWEEPS = 60 };
  int sweep, p, q, turned = 1;
  factorise(s, m);
  memset(s->V, 0, sizeof s->V);
  for (p = 0; p < s->k; p++)
    s->V[p][p] = 1;
  for (sweep = 0; sweep < SWEEPS && turned; sweep++)
    for (turned = 0, p = 0; p < s->k; p++)
      for (q = p + 1; q < s->k; q++)
        turned |= orthogonalise(s, p, q);
  for (p = 0; p < s->k; p++)
    s->singular[p] = sqrt(lab_dot(s->R[p], s->R[p], (size_t)s->k));
}

/* ---- Words ---- */

static void undetermined(lab_fit_result *result, const char *format, ...) LAB_PRINTF(2, 3);

/* Put a clause into result->undetermined; cut where it is full. */
static void undetermined(lab_fit_result *result, const char *format, ...)
{
  size_t used = strlen(result->undetermined);
  va_list args;
  if (used && used + 3 < sizeof result->undetermined) {
    strcat(result->undetermined, "; ");
    used += 2;
  }
  va_start(args, format);
  vsnprintf(result->undetermined + used, sizeof result->undetermined - used, format, args);
  va_end(args);
}

static const char *name_of(const place *at, int j)
{
  return at->param[j].name;
}

/* One direction in which the residuals do not change: who takes part in it. */
static void remark_direction(const place *at, const spectrum *s, int d, lab_fit_result *result)
{
  char names[200] = "";
  int i;
  for (i = 0; i < s->k; i++) {
    const size_t used = strlen(names);
    if (fabs(s->V[i][d]) < 0.1)
      continue;
    result->state[s->of[i]] = LAB_STATE_UNDETERMINED;
    snprintf(names + used, sizeof names - used, "%s%s", used ? " and " : "", name_of(at, s->of[i]));
  }
  undetermined(result, "only a combination of %s is determined", names);
}

static void remark_wide(const place *at, int j, lab_fit_result *result)
{
  if (result->low[j] < at->problem->lower[j] && result->high[j] > at->problem->upper[j])
    undetermined(result, "the interval of %s is wider than its bounds", name_of(at, j));
}

static void remark_pair(const place *at, int i, int j, lab_fit_result *result)
{
  const double c = result->covariance[i][j] / sqrt(result->covariance[i][i] * result->covariance[j][j]);
  if (fabs(c) > 0.995)
    undetermined(result, "%s and %s are hard to tell apart (correlation %.4f)", name_of(at, i), name_of(at, j), c);
}

/* Whether a parameter is known to a tenth of itself, which is enough whatever it goes with. */
static int is_close(const place *at, const lab_fit_result *result, int j)
{
  return result->deviation[j] < 0.05 * fabs(at->theta[j]);
}

/* Whether priors take part, by which values go together that the data tell apart. */
static int has_silent(const place *at)
{
  int j, any = 0;
  for (j = 0; j < at->problem->n; j++)
    any |= at->param[j].silent;
  return any;
}

static void remark_free(const place *at, lab_fit_result *result)
{
  int i, j;
  for (i = 0; i < result->n; i++) {
    if (result->state[i] != LAB_STATE_FREE || at->param[i].silent)
      continue;
    remark_wide(at, i, result);
    for (j = i + 1; j < result->n; j++)
      if (result->state[j] == LAB_STATE_FREE && !at->param[j].silent &&
          !(has_silent(at) && is_close(at, result, i) && is_close(at, result, j)))
        remark_pair(at, i, j, result);
  }
}

/* ---- Which parameters take part ---- */

/* Sort the parameters into held, without effect, and those of the spectrum. */
static void sort_params(const place *at, lab_fit_result *result, spectrum *s)
{
  const size_t m = at->problem->m;
  size_t i;
  int j;
  for (s->k = 0, j = 0; j < at->problem->n; j++) {
    double *column = at->slope + (size_t)j * m;
    const double length = sqrt(lab_dot(column, column, m));
    result->state[j] = at->held[j] < 0 ? LAB_STATE_AT_LOWER : at->held[j] > 0 ? LAB_STATE_AT_UPPER : LAB_STATE_FREE;
    if (at->held[j]) {
      if (!at->param[j].silent)
        undetermined(result, "%s is at its %s bound", name_of(at, j), at->held[j] < 0 ? "lower" : "upper");
      continue;
    }
    if (!(length > 1e-12 * (1 + sqrt(at->chi2)))) {
      result->state[j] = LAB_STATE_UNDETERMINED;
      undetermined(result, "%s has no effect on the data", name_of(at, j));
      continue;
    }
    for (i = 0; i < m; i++)
      column[i] /= length;
    s->length[s->k] = length;
    s->column[s->k] = column;
    s->of[s->k++] = j;
  }
}

/* The directions that are lost.  Returns: the rank. */
static int note_lost(const place *at, const spectrum *s, lab_fit_result *result)
{
  int d, rank = 0;
  for (d = 0; d < s->k; d++) {
    if (s->singular[d] > floor_of_singular)
      rank++;
    else
      remark_direction(at, s, d, result);
  }
  return rank;
}

/* ---- Numbers ---- */

/* Covariance in z of two members of the spectrum: V S^-2 V', columns scaled back, lost directions left out. */
static double covariance_z(const spectrum *s, int a, int b, double variance)
{
  double sum = 0;
  int d;
  for (d = 0; d < s->k; d++)
    if (s->singular[d] > floor_of_singular)
      sum += s->V[a][d] * s->V[b][d] / (s->singular[d] * s->singular[d]);
  return variance * sum / (s->length[a] * s->length[b]);
}

static void fill_covariance(const place *at, const spectrum *s, double variance, lab_fit_result *result)
{
  int a, b;
  for (a = 0; a < s->k; a++)
    for (b = 0; b < s->k; b++) {
      const int i = s->of[a], j = s->of[b];
      if (result->state[i] == LAB_STATE_FREE && result->state[j] == LAB_STATE_FREE)
        result->covariance[i][j] = covariance_z(s, a, b, variance) * at->unit[i] * at->unit[j];
    }
}

/* ---- What is left in stretches ---- */

/* How the fitted value of member a follows the data: its change is the product of this and of Q' dr. */
static void find_influence(const spectrum *s, int a, double *influence)
{
  int d, l;
  memset(influence, 0, (size_t)s->k * sizeof *influence);
  for (d = 0; d < s->k; d++)
    for (l = 0; l < s->k && s->singular[d] > floor_of_singular; l++)
      influence[l] += s->V[a][d] * s->R[d][l] / (s->singular[d] * s->singular[d] * s->length[a]);
}

enum {
  STRETCHES = 64, /* of all residuals */
  SHORTEST = 8    /* residuals of one */
};

/* Out: along  Q' r of each stretch */
static void sum_stretches(const place *at, const spectrum *s, double along[STRETCHES][LAB_FIT_MAX])
{
  const size_t m = at->problem->m;
  int i, l;
  for (i = 0; i < STRETCHES; i++) {
    const size_t first = m * (size_t)i / STRETCHES, n = m * (size_t)(i + 1) / STRETCHES - first;
    for (l = 0; l < s->k; l++)
      along[i][l] = lab_dot(s->column[l] + first, at->r + first, n);
  }
}

/* Variance in z of member a where what is left comes in stretches of a sign: that of the sum over stretches, each taken
 * for one value (Liang and Zeger 1986). */
static double variance_by_stretches(const spectrum *s, double along[STRETCHES][LAB_FIT_MAX], int a)
{
  double influence[LAB_FIT_MAX], sum = 0;
  int i;
  find_influence(s, a, influence);
  for (i = 0; i < STRETCHES; i++) {
    const double change = lab_dot(influence, along[i], (size_t)s->k);
    sum += change * change;
  }
  return sum;
}

/* Where more than noise is left the covariance grows by as much as stretches ask for. */
static void widen_by_stretches(const place *at, const spectrum *s, lab_fit_result *result)
{
  double wider[LAB_FIT_MAX], along[STRETCHES][LAB_FIT_MAX];
  int a, b;
  sum_stretches(at, s, along);
  for (a = 0; a < s->k; a++) {
    const int i = s->of[a];
    const double own = result->covariance[i][i] / (at->unit[i] * at->unit[i]);
    wider[a] = own > 0 ? sqrt(fmax(1, variance_by_stretches(s, along, a) / own)) : 1;
  }
  for (a = 0; a < s->k; a++)
    for (b = 0; b < s->k; b++)
      result->covariance[s->of[a]][s->of[b]] *= wider[a] * wider[b];
}

static void fill_interval(const place *at, int j, lab_fit_result *result)
{
  const double half = lab_student_quantile(0.975, (double)INFINITY) * sqrt(result->covariance[j][j]);
  result->deviation[j] = sqrt(result->covariance[j][j]);
  result->low[j] = at->theta[j] - half;
  result->high[j] = at->theta[j] + half;
}

/* How far from its bound a parameter is with 95 %, in z: the data pull it beyond, with this slope and curvature of half
 * the sum of squares, so that what is left on this side is the tail of a normal distribution. */
static double reach(double slope, double curvature, double variance)
{
  const double deviation = sqrt(variance / curvature), beyond = slope / curvature / deviation;
  const double tail = 0.05 * lab_student_probability(-beyond, (double)INFINITY);
  if (tail < 1e-6) /* so far out it is an exponential */
    return log(20) * variance / slope;
  return deviation * (-lab_student_quantile(tail, (double)INFINITY) - beyond);
}

/* The interval of a parameter at a bound: from there to what the data allow, the free ones following. */
static void fill_one_side(const place *at, const spectrum *s, int j, double variance, lab_fit_result *result)
{
  const double lower = at->problem->lower[j], upper = at->problem->upper[j];
  const size_t m = at->problem->m;
  const int side = at->held[j] < 0 ? 1 : -1;
  double *column = at->slope + (size_t)j * m, curvature, far, end;
  size_t i;
  int d;
  for (d = 0; d < s->k; d++) {
    const double along = lab_dot(s->column[d], column, m);
    for (i = 0; i < m; i++)
      column[i] -= along * s->column[d][i];
  }
  curvature = lab_dot(column, column, m);
  far = side * reach(fmax(side * lab_dot(column, at->r, m), 0), curvature, variance);
  end = curvature > 0 ? fmin(fmax(at->theta[j] + at->unit[j] * far, lower), upper) : side > 0 ? upper : lower;
  *(side > 0 ? &result->high[j] : &result->low[j]) = end;
}

static void fill_intervals(const place *at, const spectrum *s, double variance, lab_fit_result *result)
{
  int j;
  for (j = 0; j < result->n; j++) {
    const int unknown = result->state[j] == LAB_STATE_UNDETERMINED;
    result->low[j] = unknown ? at->problem->lower[j] : at->theta[j];
    result->high[j] = unknown ? at->problem->upper[j] : at->theta[j];
    result->deviation[j] = unknown ? (double)INFINITY : 0;
    if (at->held[j])
      fill_one_side(at, s, j, variance, result);
    if (result->state[j] == LAB_STATE_FREE)
      fill_interval(at, j, result);
  }
}

/* What is beyond the bounds is no part of an interval. */
static void clip_intervals(const place *at, lab_fit_result *result)
{
  int j;
  for (j = 0; j < result->n; j++) {
    result->low[j] = fmax(result->low[j], at->problem->lower[j]);
    result->high[j] = fmin(result->high[j], at->problem->upper[j]);
  }
}

/* ---- The place ---- */

static double unit_of(const lab_fit_param *p, double theta, double lower, double upper)
{
  if (p->scale > 0)
    return p->scale;
  if (theta != 0)
    return fabs(theta);
  return isfinite(upper - lower) ? 0.01 * (upper - lower) : 1;
}

/* -1, 1: on its lower, upper bound, with the data pulling outwards by more than rounding. */
static int held_at(const place *at, int j)
{
  static const double width = 1e-12, negligible = 1e-7; /* in units; of the largest possible pull */
  const lab_fit_problem *p = at->problem;
  const double *column = at->slope + (size_t)j * p->m;
  const double dot = lab_dot(column, at->r, p->m), length = lab_dot(column, column, p->m);
  const double pull = length > 0 && at->chi2 > 0 ? dot / sqrt(length * at->chi2) : 0;
  const int bound = (at->theta[j] - p->lower[j]) / at->unit[j] <= width   ? -1
                    : (p->upper[j] - at->theta[j]) / at->unit[j] <= width ? 1
                                                                          : 0;
  return bound * pull < -negligible ? bound : 0;
}

static int look(place *at, lab_error *error)
{
  const lab_fit_problem *p = at->problem;
  size_t i;
  int j;
  if (lab_fit_evaluate(p, at->theta, at->r, &at->chi2, error) || lab_fit_slopes(p, at->theta, at->r, at->slope, error))
    return error->status;
  for (j = 0; j < p->n; j++) {
    at->unit[j] = unit_of(&at->param[j], at->theta[j], p->lower[j], p->upper[j]);
    for (i = 0; i < p->m; i++)
      at->slope[(size_t)j * p->m + i] *= at->unit[j];
    at->held[j] = held_at(at, j);
  }
  return LAB_OK;
}

/* Takes the columns of the slopes apart. */
static void describe(place *at, lab_fit_result *result)
{
  spectrum s;
  double degrees, variance;
  result->chi2 = at->chi2;
  sort_params(at, result, &s);
  decompose(&s, at->problem->m);
  degrees = (double)at->problem->m - note_lost(at, &s, result);
  result->reduced_chi2 = degrees > 0 ? at->chi2 / degrees : (double)NAN;
  variance = degrees > 0 ? fmax(1, result->reduced_chi2) : 1;
  fill_covariance(at, &s, variance, result);
  if (variance > noise && at->problem->m >= STRETCHES * SHORTEST)
    widen_by_stretches(at, &s, result);
  fill_intervals(at, &s, variance, result);
  remark_free(at, result);
  clip_intervals(at, result);
}

int lab_fit_spread(const lab_fit_problem *problem, const lab_fit_param *param, const double *theta,
                   lab_fit_result *result, lab_error *error)
{
  place at = {.problem = problem, .param = param, .theta = theta};
  int status;
  memset(result, 0, sizeof *result);
  result->n = problem->n;
  if (problem->n == 0)
    return LAB_OK;
  at.r = malloc(problem->m * sizeof *at.r);
  at.slope = malloc(problem->m * (size_t)problem->n * sizeof *at.slope);
  status = at.r && at.slope ? look(&at, error) : lab_fail_memory(error, "the intervals of a fit");
  if (status == LAB_OK)
    describe(&at, result);
  free(at.r);
  free(at.slope);
  return status;
}

const char *lab_fit_state_text(int state)
{
  static const char *const text[] = {"free", "at its lower bound", "at its upper bound", "undetermined"};
  return state >= 0 && state < 4 ? text[state] : "unknown";
}
