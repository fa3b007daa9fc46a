#include "fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/clock.h"
#include "normal.h"

enum { N = LAB_FIT_MAX, STEPS = 40, TRIES = 12, KEPT_TRIES = 3 };

static const double usual_enough = 0.02;      /* of chi-square: no decision hangs on it */
static const double usual_share = 1e-6;       /* of chi-square */
static const double excess_share = 1e-4;      /* of what chi-square has beyond one for each residual */
static const double poor = 0.5;               /* gain over promise below which kept slopes are renewed */
static const double rough = 100, kept = 0.25; /* times `enough` that new slopes promise, and the share of it that is
                                                 kept: where less is, no smooth surface is seen so closely */

/* Where a descent is. */
typedef struct descent {
  const lab_fit_problem *problem;
  double theta[N], trial[N];
  double *r, *r_trial; /* m */
  double *off;         /* m: where the linear model was wrong */
  double *J;           /* m * n, column by column */
  double A[N][N];      /* J'J */
  double damped[N][N]; /* the part of it that a step is solved for */
  double g[N];         /* J'r */
  double chi2, lambda;
  double enough;
} descent;

int lab_fit_evaluate(const lab_fit_problem *p, const double *theta, double *r, double *chi2, lab_error *error)
{
  size_t i = 0;
  if (p->residuals(p->context, theta, r, error))
    return error->status;
  *chi2 = lab_dot(r, r, p->m);
  if (isfinite(*chi2))
    return LAB_OK;
  while (i + 1 < p->m && isfinite(r[i]))
    i++;
  return lab_fail(error, LAB_NUMERIC, "residual %zu of %zu is not finite", i + 1, p->m);
}

int lab_fit_other_slopes(const lab_fit_problem *p, const double *theta, const double *r, double *J, char *done,
                         lab_error *error)
{
  int j, status = LAB_OK;
  if (p->together)
    status = p->together(p->context, theta, J, done, error);
  if (status != LAB_OK && status != LAB_NUMERIC)
    return status;
  status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (j = 0; j < p->n; j++) {
    lab_error mine;
    double *column = J + (size_t)j * p->m;
    if (done[j])
      continue;
    const int spent = lab_cpu_is_spent(p->until);
    const int at = spent ? LAB_NUMERIC : p->slope(p->context, theta, r, j, column, &mine);
    if (at == LAB_NUMERIC)
      memset(column, 0, p->m * sizeof *column);
    else if (at != LAB_OK) {
#pragma omp critical(fit_error)
      *error = mine, status = at;
    }
  }
  return status;
}

int lab_fit_slopes(const lab_fit_problem *p, const double *theta, const double *r, double *J, lab_error *error)
{
  char done[N] = {0};
  return lab_fit_other_slopes(p, theta, r, J, done, error);
}

static int is_zero(const double *column, size_t n)
{
  size_t i = 0;
  while (i < n && column[i] == 0)
    i++;
  return i == n;
}

/* Add what rows of J from `from` on, n of them, have in J'J and J'r: columns that are 0 there have nothing, such as
 * those of what only another log has, or of an instant long past. */
static void add_rows(descent *d, size_t from, size_t n)
{
  const size_t m = d->problem->m;
  const double *J = d->J + from;
  int alive[N], j, k, end;
  for (j = 0; j < d->problem->n; j++) {
    alive[j] = !is_zero(J + (size_t)j * m, n);
    if (!alive[j])
      continue;
    d->g[j] += lab_dot(J + (size_t)j * m, d->r + from, n);
    for (k = 0; k <= j; k = end) {
      end = k + 1;
      while (end <= j && alive[end] == alive[k])
        end++;
      if (alive[k])
        lab_dots(J + (size_t)j * m, J + (size_t)k * m, m, end - k, n, d->A[j] + k);
    }
  }
}

/* What follows from the slopes. */
static void multiply(descent *d)
{
  enum { PART = 256 }; /* rows whose columns are near at hand together */
  const size_t m = d->problem->m;
  const int n = d->problem->n;
  size_t from;
  int j, k;
  memset(d->g, 0, sizeof d->g);
  for (j = 0; j < n; j++)
    memset(d->A[j], 0, (size_t)n * sizeof *d->A[j]);
  for (from = 0; from < m; from += PART)
    add_rows(d, from, m - from < PART ? m - from : PART);
  for (j = 0; j < n; j++)
    for (k = 0; k < j; k++)
      d->A[k][j] = d->A[j][k];
}

/* Damped step for the unknowns in `of`, the others moved by `step` already. */
static int solve_free(descent *d, const int *of, int k, const int *is_free, double *step)
{
  const int n = d->problem->n;
  double b[N];
  int i, j;
  for (i = 0; i < k; i++) {
    for (j = 0; j < k; j++)
      d->damped[i][j] = d->A[of[i]][of[j]];
    d->damped[i][i] += d->lambda * d->damped[i][i] + 1e-300;
    b[i] = -d->g[of[i]];
    for (j = 0; j < n; j++)
      if (!is_free[j])
        b[i] -= d->A[of[i]][j] * step[j];
  }
  if (lab_solve_positive(k, N, &d->damped[0][0], b))
    return -1;
  for (i = 0; i < k; i++)
    step[of[i]] = b[i];
  return 0;
}

/* A step that stays within the bounds: what would leave them goes onto its bound, and the rest is solved again. What
 * stands on a bound and is pulled outwards does not take part.  Returns: 0, or -1 if there is no step. */
static int bounded_step(descent *d, double *step)
{
  const lab_fit_problem *p = d->problem;
  int is_free[N], of[N], j, k, hit = 1;
  for (j = 0; j < p->n; j++) {
    step[j] = 0;
    is_free[j] =
        d->A[j][j] > 0 && !(d->theta[j] <= p->lower[j] && d->g[j] > 0) && !(d->theta[j] >= p->upper[j] && d->g[j] < 0);
  }
  while (hit) {
    for (j = k = 0; j < p->n; j++)
      if (is_free[j])
        of[k++] = j;
    if (k == 0)
      return 0;
    if (solve_free(d, of, k, is_free, step))
      return -1;
    for (hit = 0, j = 0; j < k; j++) {
      const int at = of[j];
      const double to = d->theta[at] + step[at], bound = fmin(fmax(to, p->lower[at]), p->upper[at]);
      if (bound != to) {
        step[at] = bound - d->theta[at];
        is_free[at] = 0;
        hit = 1;
      }
    }
  }
  return 0;
}

/* Decrease of chi-square that the linear model promises. */
static double promise(const descent *d, const double *step)
{
  const int n = d->problem->n;
  double sum = 0;
  int i, j;
  for (i = 0; i < n; i++) {
    double row = 0;
    for (j = 0; j < n; j++)
      row += d->A[i][j] * step[j];
    sum -= step[i] * (2 * d->g[i] + row);
  }
  return sum;
}

/* What a step has shown of the slopes: the least change of them that agrees with it, each slope over its size. */
static void learn(descent *d)
{
  const lab_fit_problem *p = d->problem;
  double step[N], length2 = 0;
  size_t i;
  int j;
  for (j = 0; j < p->n; j++) {
    step[j] = d->trial[j] - d->theta[j];
    length2 += d->A[j][j] * step[j] * step[j];
  }
  for (i = 0; i < p->m; i++)
    d->off[i] = d->r_trial[i] - d->r[i];
  for (j = 0; j < p->n; j++)
    for (i = 0; step[j] != 0 && i < p->m; i++)
      d->off[i] -= d->J[(size_t)j * p->m + i] * step[j];
  for (j = 0; j < p->n; j++) {
    const double share = length2 > 0 ? d->A[j][j] * step[j] / length2 : 0;
    for (i = 0; share != 0 && i < p->m; i++)
      d->J[(size_t)j * p->m + i] += share * d->off[i];
  }
}

static void accept(descent *d, double chi2)
{
  double *keep = d->r;
  d->r = d->r_trial;
  d->r_trial = keep;
  memcpy(d->theta, d->trial, sizeof d->theta);
  d->chi2 = chi2;
}

/* How a step ended: the fit goes on; the slopes promise no gain worth having; no step that they propose is one. */
enum { GOES_ON, PROMISES_NO_MORE, FAILS };

/* The share of chi-square that is not worth a step. Where others begin, the end of the valley counts; a brief fit of a
 * model that leaves much only has to tell it from its rivals. */
static double enough_of(const descent *d)
{
  const lab_fit_problem *p = d->problem;
  const double share = (p->enough_share > 0 ? p->enough_share : usual_share) * d->chi2;
  return p->is_brief ? fmax(share, excess_share * (d->chi2 - (double)p->m)) : share;
}

/* One step downhill, damped until it is one. Of kept slopes there are few tries: where these fail, it is they that are
 * wrong.
 * In:      fresh    whether the slopes are those of this place
 * Out:     quality  gain over promise
 *          end      how it ended */
static int step_down(descent *d, int fresh, double *quality, int *end, lab_error *error)
{
  const int most = fresh ? TRIES : KEPT_TRIES;
  const lab_fit_problem *p = d->problem;
  const double least = fmax(d->enough, enough_of(d)), lambda = d->lambda;
  double step[N];
  int j, tries;
  *end = FAILS;
  for (tries = 0; tries < most && !lab_cpu_is_spent(p->until); tries++) {
    double promised, chi2, gain;
    int status;
    if (bounded_step(d, step)) {
      d->lambda = fmax(10 * d->lambda, 1e-12);
      continue;
    }
    promised = promise(d, step);
    if (!(promised > least)) {
      *end = PROMISES_NO_MORE;
      return LAB_OK;
    }
    for (j = 0; j < p->n; j++)
      d->trial[j] = fmin(fmax(d->theta[j] + step[j], p->lower[j]), p->upper[j]);
    status = lab_fit_evaluate(p, d->trial, d->r_trial, &chi2, error);
    if (status != LAB_OK && status != LAB_NUMERIC)
      return status;
    gain = d->chi2 - chi2;
    if (status == LAB_OK && gain > 0) {
      *quality = gain / promised;
      *end = gain < least || (fresh && promised < rough * d->enough && *quality < kept) ? PROMISES_NO_MORE : GOES_ON;
      d->lambda *= *quality > 0.75 ? 0.1 : *quality < 0.25 ? 4 : 1;
      learn(d);
      accept(d, chi2);
      return LAB_OK;
    }
    d->lambda = fmax(8 * d->lambda, 1e-3);
  }
  if (!fresh)
    d->lambda = lambda; /* damping mends no slopes */
  return LAB_OK;
}

static int descend(descent *d, lab_error *error)
{
  const lab_fit_problem *p = d->problem;
  const int most = p->steps > 0 ? p->steps : STEPS;
  int steps = 0, end = GOES_ON, fresh = !p->is_known;
  char done[N];
  double quality = 1;
  if (lab_fit_evaluate(p, d->theta, d->r, &d->chi2, error))
    return error->status;
  if (!fresh) {
    memcpy(done, p->is_known, (size_t)p->n);
    if (lab_fit_other_slopes(p, d->theta, d->r, d->J, done, error))
      return error->status;
  }
  while (steps < most && !lab_cpu_is_spent(p->until)) {
    if (fresh && lab_fit_slopes(p, d->theta, d->r, d->J, error))
      return error->status;
    multiply(d);
    if (step_down(d, fresh, &quality, &end, error))
      return error->status;
    if (end != GOES_ON && (fresh || (p->is_brief && end == PROMISES_NO_MORE)))
      break;
    steps += end == GOES_ON; /* that kept slopes lead nowhere is no step */
    /* before it ends, once more with slopes that are all new */
    fresh = end != GOES_ON || quality < poor || p->is_rough;
  }
  return LAB_OK;
}

int lab_fit(const lab_fit_problem *problem, double *theta, double *chi2, lab_error *error)
{
  const size_t m = problem->m, n = (size_t)problem->n;
  descent *d = calloc(1, sizeof *d);
  double *memory = malloc(((problem->slopes ? 0 : n) + 3) * m * sizeof *memory);
  int status = d && memory ? LAB_OK : lab_fail_memory(error, "a fit");
  if (status == LAB_OK) {
    d->problem = problem;
    d->enough = problem->enough > 0 ? problem->enough : usual_enough;
    d->lambda = 1e-6;
    d->r = memory;
    d->r_trial = memory + m;
    d->off = memory + 2 * m;
    d->J = problem->slopes ? problem->slopes : memory + 3 * m;
    memcpy(d->theta, theta, n * sizeof *theta);
    if (problem->search > 0)
      status = lab_fit_search(problem, d->theta, error);
  }
  if (status == LAB_OK)
    status = descend(d, error);
  if (status == LAB_OK) {
    memcpy(theta, d->theta, n * sizeof *theta);
    *chi2 = d->chi2;
  }
  free(memory);
  free(d);
  return status;
}
