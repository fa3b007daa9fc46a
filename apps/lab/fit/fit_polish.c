/* Stage 2: Levenberg-Marquardt (cminpack's lmder, after More 1978) on the parameters that are free, inside a small
 * active-set loop: what ends on a bound with the data pulling outwards is held there and the others are polished
 * again; what is held is released when the data pull it back inside. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cminpack.h>

#include "fit_private.h"

/* The free parameters of a run, as lmder sees them. */
typedef struct polish {
  fit_run *run;
  int k;                 /* free ones */
  int of[LAB_FIT_MAX];   /* their places */
  double z[LAB_FIT_MAX]; /* all of them */
  double penalty;        /* length of a residual where the model fails: lmder then shortens its step */
} polish;

static void choose_free(polish *s)
{
  int j;
  s->k = 0;
  for (j = 0; j < s->run->problem->n; j++)
    if (!s->run->held[j])
      s->of[s->k++] = j;
}

/* Take over lmder's point, held inside the bounds. */
static void place(polish *s, const double *free_z)
{
  int i;
  for (i = 0; i < s->k; i++)
    s->z[s->of[i]] = fmin(fmax(free_z[i], s->run->lower[s->of[i]]), s->run->upper[s->of[i]]);
}

static int residuals_at(polish *s, double *r)
{
  const size_t m = s->run->problem->m;
  double sum;
  size_t i;
  int outcome = fit_evaluate(s->run, s->z, &sum);
  if (outcome == FIT_END)
    return -1;
  for (i = 0; i < m; i++)
    r[i] = outcome == FIT_GOOD ? s->run->r[i] : s->penalty;
  return 0;
}

static int slopes_at(polish *s, const double *r, double *jacobian)
{
  const size_t m = s->run->problem->m;
  int i;
  memcpy(s->run->r, r, m * sizeof *r);
  if (fit_differentiate(s->run, s->z, s->run->held) == FIT_END)
    return -1;
  for (i = 0; i < s->k; i++)
    memcpy(jacobian + (size_t)i * m, s->run->slope + (size_t)s->of[i] * m, m * sizeof *jacobian);
  return 0;
}

static int ask(void *context, int m, int n, const double *z, double *r, double *jacobian, int ldfjac, int flag)
{
  polish *s = context;
  (void)m, (void)n, (void)ldfjac;
  place(s, z);
  return flag == 2 ? slopes_at(s, r, jacobian) : residuals_at(s, r);
}

/* Words of lmder's result. */
static int finish_of(int info)
{
  if (info == 5)
    return LAB_FIT_COUNT_REACHED;
  return info >= 6 ? LAB_FIT_ROUNDOFF : LAB_FIT_CONVERGED;
}

/* One run of lmder from s->z. */
static int levenberg_marquardt(polish *s, double *memory)
{
  static const double xtol = 1e-9, gtol = 0, factor = 100;
  const double ftol = s->run->options->chi2_exact;
  enum { SCALE_BY_COLUMNS = 1, NO_PRINT = 0 };
  const int m = (int)s->run->problem->m, k = s->k;
  double z[LAB_FIT_MAX], diag[LAB_FIT_MAX], qtf[LAB_FIT_MAX], work[3][LAB_FIT_MAX];
  double *r = memory, *work_m = r + m, *jacobian = work_m + m;
  int pivot[LAB_FIT_MAX], i, info, n_residuals, n_slopes;
  for (i = 0; i < k; i++)
    z[i] = s->z[s->of[i]];
  info =
      lmder(ask, s, m, k, z, r, jacobian, m, ftol, xtol, gtol, s->run->options->polish_count * k, diag,
            SCALE_BY_COLUMNS, factor, NO_PRINT, &n_residuals, &n_slopes, pivot, qtf, work[0], work[1], work[2], work_m);
  s->run->finish = finish_of(info);
  return info < 0 ? FIT_END : FIT_GOOD;
}

/* -1, 1: z[j] is on its lower, upper bound. */
static int bound_at(const fit_run *run, const double *z, int j)
{
  const double width = 1e-12 * (1 + fabs(z[j]));
  return z[j] - run->lower[j] <= width ? -1 : run->upper[j] - z[j] <= width;
}

/* Slope of the sum of squares along axis j over its largest possible size: -1 .. 1. */
static double pull(const fit_run *run, int j)
{
  const size_t m = run->problem->m;
  const double *column = run->slope + (size_t)j * m;
  double dot = 0, length = 0;
  size_t i;
  for (i = 0; i < m; i++) {
    dot += column[i] * run->r[i];
    length += column[i] * column[i];
  }
  return length > 0 && run->best > 0 ? dot / sqrt(length * run->best) : 0;
}

/* Hold and release by the signs of the pulls at the best point.
 * Returns: 1 if that changed anything, 0 if not, -1 where the run has ended. */
static int revise(fit_run *run)
{
  static const double negligible = 1e-7;
  double z[LAB_FIT_MAX], sum;
  int j, changed = 0;
  memcpy(z, run->best_z, sizeof z);
  if (fit_evaluate(run, z, &sum) != FIT_GOOD || fit_differentiate(run, z, NULL) == FIT_END)
    return -1;
  for (j = 0; j < run->problem->n; j++) {
    const int bound = bound_at(run, z, j);
    const int held = bound * pull(run, j) < -negligible ? bound : 0;
    changed |= held != run->held[j];
    run->held[j] = held;
  }
  return changed;
}

static int polish_rounds(polish *s, double *memory)
{
  fit_run *run = s->run;
  const int rounds = 2 * run->problem->n + 2;
  int i, changed = 1;
  for (i = 0; i < rounds && changed > 0; i++) {
    choose_free(s);
    memcpy(s->z, run->best_z, sizeof s->z);
    s->penalty = sqrt(1e6 * run->best / (double)run->problem->m) + 1e-15;
    if (s->k && levenberg_marquardt(s, memory) == FIT_END)
      return FIT_END;
    changed = revise(run);
  }
  return changed < 0 ? FIT_END : FIT_GOOD;
}

int fit_polish(fit_run *run)
{
  const size_t m = run->problem->m;
  double *memory = calloc(m * (size_t)(run->problem->n + 2), sizeof *memory);
  polish s;
  int outcome;
  if (run->options->search == LAB_FIT_NONE) {
    free(memory);
    return revise(run) < 0 ? FIT_END : FIT_GOOD;
  }
  if (!memory) {
    run->status = lab_fail_memory(&run->error, "Levenberg-Marquardt");
    return FIT_END;
  }
  s.run = run;
  outcome = polish_rounds(&s, memory);
  free(memory);
  return outcome;
}
