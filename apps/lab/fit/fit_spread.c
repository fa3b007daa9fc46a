/* What the data say about each parameter: singular values, covariance, intervals, and in words what they do not
 * determine. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fit_private.h"
#include "../base/quantile.h"
#include "../base/array.h"

/* Singular value decomposition of the slopes of k parameters, columns scaled to unit length. */
typedef struct spectrum {
  int k;
  int of[LAB_FIT_MAX];                /* their places */
  double length[LAB_FIT_MAX];         /* of the column before scaling */
  double *column[LAB_FIT_MAX];        /* m entries each */
  double R[LAB_FIT_MAX][LAB_FIT_MAX]; /* rows: columns of R; orthogonal afterwards, lengths are singular values */
  double V[LAB_FIT_MAX][LAB_FIT_MAX];
  double singular[LAB_FIT_MAX];
  double floor; /* singular values below it are no more than errors of the differences */
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

static void remark(lab_fit_result *result, const char *format, ...) LAB_PRINTF(2, 3);

/* Put a sentence into result->remark; cut where it is full. */
static void remark(lab_fit_result *result, const char *format, ...)
{
  size_t used = strlen(result->remark);
  va_list args;
  if (used && used + 3 < sizeof result->remark) {
    strcat(result->remark, "; ");
    used += 2;
  }
  va_start(args, format);
  vsnprintf(result->remark + used, sizeof result->remark - used, format, args);
  va_end(args);
}

static const char *name_of(const fit_run *run, int j)
{
  return run->problem->param[j].name;
}

/* One direction in which the residuals do not change: who takes part in it. */
static void remark_direction(const fit_run *run, const spectrum *s, int d, lab_fit_result *result)
{
  char names[200] = "";
  int i;
  for (i = 0; i < s->k; i++) {
    const size_t used = strlen(names);
    if (fabs(s->V[i][d]) < 0.1)
      continue;
    result->state[s->of[i]] = LAB_FIT_UNDETERMINED;
    snprintf(names + used, sizeof names - used, "%s%s", used ? " and " : "", name_of(run, s->of[i]));
  }
  remark(result, "only a combination of %s is determined", names);
}

static void remark_wide(const fit_run *run, int j, lab_fit_result *result)
{
  const lab_fit_param *p = &run->problem->param[j];
  if (p->log_scaled) {
    if (result->high[j] > 100 * result->low[j])
      remark(result, "%s is known only within a factor of %.2g either way", p->name,
             sqrt(result->high[j] / result->low[j]));
  } else if (result->low[j] < p->lower && result->high[j] > p->upper) {
    remark(result, "the interval of %s is wider than its bounds", p->name);
  }
}

static void remark_pair(const fit_run *run, int i, int j, lab_fit_result *result)
{
  const double c = result->covariance[i][j] / sqrt(result->covariance[i][i] * result->covariance[j][j]);
  if (fabs(c) > 0.995)
    remark(result, "%s and %s are hard to tell apart (correlation %.4f)", name_of(run, i), name_of(run, j), c);
}

static void remark_free(const fit_run *run, lab_fit_result *result)
{
  int i, j;
  for (i = 0; i < result->n; i++) {
    if (result->state[i] != LAB_FIT_FREE)
      continue;
    remark_wide(run, i, result);
    for (j = i + 1; j < result->n; j++)
      if (result->state[j] == LAB_FIT_FREE)
        remark_pair(run, i, j, result);
  }
}

/* ---- Which parameters take part ---- */

/* Sort the parameters into held, without effect, and those of the spectrum. */
static void sort_params(const fit_run *run, lab_fit_result *result, spectrum *s)
{
  const size_t m = run->problem->m;
  size_t i;
  int j;
  for (s->k = 0, j = 0; j < run->problem->n; j++) {
    double *column = run->slope + (size_t)j * m;
    const double length = sqrt(lab_dot(column, column, m));
    result->state[j] = run->held[j] < 0 ? LAB_FIT_AT_LOWER : run->held[j] > 0 ? LAB_FIT_AT_UPPER : LAB_FIT_FREE;
    if (run->held[j]) {
      remark(result, "%s is at its %s bound", name_of(run, j), run->held[j] < 0 ? "lower" : "upper");
      continue;
    }
    if (!(length > 1e-12 * (1 + sqrt(run->best)))) {
      result->state[j] = LAB_FIT_UNDETERMINED;
      remark(result, "%s has no effect on the data", name_of(run, j));
      continue;
    }
    for (i = 0; i < m; i++)
      column[i] /= length;
    s->length[s->k] = length;
    s->column[s->k] = column;
    s->of[s->k++] = j;
  }
}

/* Singular values, largest first, and the directions that are lost.  Returns: the rank. */
static int note_singular(const fit_run *run, const spectrum *s, lab_fit_result *result)
{
  int d, e, rank = 0;
  for (d = 0; d < s->k; d++) {
    const double value = s->singular[d];
    for (e = d; e > 0 && result->singular[e - 1] < value; e--)
      result->singular[e] = result->singular[e - 1];
    result->singular[e] = value;
    if (value > s->floor)
      rank++;
    else
      remark_direction(run, s, d, result);
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
    if (s->singular[d] > s->floor)
      sum += s->V[a][d] * s->V[b][d] / (s->singular[d] * s->singular[d]);
  return variance * sum / (s->length[a] * s->length[b]);
}

/* d theta / dz */
static double stretch(const fit_run *run, const lab_fit_result *result, int j)
{
  return run->problem->param[j].log_scaled ? result->theta[j] : run->unit[j];
}

static void fill_covariance(const fit_run *run, const spectrum *s, double variance, lab_fit_result *result)
{
  int a, b;
  for (a = 0; a < s->k; a++)
    for (b = 0; b < s->k; b++) {
      const int i = s->of[a], j = s->of[b];
      if (result->state[i] == LAB_FIT_FREE && result->state[j] == LAB_FIT_FREE)
        result->covariance[i][j] = covariance_z(s, a, b, variance) * stretch(run, result, i) * stretch(run, result, j);
    }
}

static void fill_interval(const fit_run *run, int j, lab_fit_result *result)
{
  const lab_fit_param *p = &run->problem->param[j];
  const double theta = result->theta[j], half = result->quantile * sqrt(result->covariance[j][j]);
  result->deviation[j] = sqrt(result->covariance[j][j]);
  result->low[j] = p->log_scaled ? theta * exp(-half / theta) : theta - half;
  result->high[j] = p->log_scaled ? theta * exp(half / theta) : theta + half;
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
static void fill_one_side(const fit_run *run, const spectrum *s, int j, double variance, lab_fit_result *result)
{
  const lab_fit_param *p = &run->problem->param[j];
  const size_t m = run->problem->m;
  const int side = run->held[j] < 0 ? 1 : -1;
  double *column = run->slope + (size_t)j * m, theta = result->theta[j], curvature, far;
  size_t i;
  int d;
  for (d = 0; d < s->k; d++) {
    const double along = lab_dot(s->column[d], column, m);
    for (i = 0; i < m; i++)
      column[i] -= along * s->column[d][i];
  }
  curvature = lab_dot(column, column, m);
  far = side * reach(fmax(side * lab_dot(column, run->r, m), 0), curvature, variance);
  theta = p->log_scaled ? theta * exp(far) : theta + run->unit[j] * far;
  theta = curvature > 0 ? fmin(fmax(theta, p->lower), p->upper) : side > 0 ? p->upper : p->lower;
  *(side > 0 ? &result->high[j] : &result->low[j]) = theta;
}

static void fill_intervals(const fit_run *run, const spectrum *s, double variance, lab_fit_result *result)
{
  int j;
  for (j = 0; j < result->n; j++) {
    const lab_fit_param *p = &run->problem->param[j];
    result->low[j] = result->state[j] == LAB_FIT_UNDETERMINED ? p->lower : result->theta[j];
    result->high[j] = result->state[j] == LAB_FIT_UNDETERMINED ? p->upper : result->theta[j];
    result->deviation[j] = result->state[j] == LAB_FIT_UNDETERMINED ? (double)INFINITY : 0;
    if (run->held[j])
      fill_one_side(run, s, j, variance, result);
    if (result->state[j] != LAB_FIT_FREE)
      continue;
    result->n_free++;
    fill_interval(run, j, result);
  }
}

/* What is beyond the bounds is no part of an interval. */
static void clip_intervals(const fit_run *run, lab_fit_result *result)
{
  int j;
  for (j = 0; j < result->n; j++) {
    result->low[j] = fmax(result->low[j], run->problem->param[j].lower);
    result->high[j] = fmin(result->high[j], run->problem->param[j].upper);
  }
}

/* Degrees of freedom, what they make of the sum of squares, and the width of an interval.
 * Returns: the variance of a residual over sigma. */
static double noise_level(const fit_run *run, int rank, lab_fit_result *result)
{
  const double degrees = (double)run->problem->m - rank;
  result->degrees = degrees;
  result->reduced_chi2 = degrees > 0 ? result->chi2 / degrees : (double)NAN;
  result->quantile =
      lab_student_quantile(0.975, run->problem->sigma_known || !(degrees > 0) ? (double)INFINITY : degrees);
  if (!(degrees > 0))
    return run->problem->sigma_known ? 1 : (double)INFINITY;
  return run->problem->sigma_known ? fmax(1, result->reduced_chi2) : result->reduced_chi2;
}

/* Sums over the residuals at the best point. */
static void fill_errors(const fit_run *run, lab_fit_result *result)
{
  const lab_fit_problem *p = run->problem;
  double sum = 0;
  size_t i;
  for (i = 0; i < p->m; i++) {
    const double r = run->r[i] * (p->sigma ? p->sigma[i] : 1);
    sum += r * r;
  }
  result->rmse = sqrt(sum / (double)p->m);
}

int fit_spread(fit_run *run, lab_fit_result *result)
{
  spectrum s;
  double z[LAB_FIT_MAX], variance;
  memcpy(z, run->best_z, sizeof z);
  if (fit_evaluate(run, z, &result->chi2) != FIT_GOOD || fit_differentiate(run, z, NULL) == FIT_END)
    return FIT_END;
  fit_theta(run, z, result->theta);
  fill_errors(run, result);
  sort_params(run, result, &s);
  s.floor = 10 * cbrt(run->options->precision * run->options->precision); /* error of a central difference */
  decompose(&s, run->problem->m);
  variance = noise_level(run, note_singular(run, &s, result), result);
  fill_covariance(run, &s, variance, result);
  fill_intervals(run, &s, variance, result);
  remark_free(run, result);
  clip_intervals(run, result);
  return FIT_GOOD;
}
