/* The fit: checks, starts, the choice among them. */
#include "fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fit_private.h"

void lab_fit_options_default(lab_fit_options *options)
{
  memset(options, 0, sizeof *options);
  options->search = LAB_FIT_BOBYQA;
  options->starts = 1;
  options->threads = 1;
  options->search_count = 8;
  options->polish_count = 200;
  options->chi2_exact = 1e-10;
  options->precision = 1e-10;
}

/* ---- Checks ---- */

static int check_param(const lab_fit_param *p, int bounded, lab_error *error)
{
  if (!isfinite(p->start) || !(p->start >= p->lower && p->start <= p->upper))
    return lab_fail(error, LAB_DATA, "%s: the start %g %s is not within its bounds %g .. %g", p->name, p->start,
                    p->unit, p->lower, p->upper);
  if (!(p->lower < p->upper))
    return lab_fail(error, LAB_DATA, "%s: the bounds %g .. %g %s leave nothing to fit", p->name, p->lower, p->upper,
                    p->unit);
  if (p->log_scaled && !(p->lower > 0))
    return lab_fail(error, LAB_DATA, "%s: on a logarithmic scale the lower bound %g %s must be above 0", p->name,
                    p->lower, p->unit);
  if (bounded && !isfinite(p->upper - p->lower))
    return lab_fail(error, LAB_DATA, "%s: a search from many starts needs finite bounds", p->name);
  return LAB_OK;
}

static int check_options(const lab_fit_options *o, lab_error *error)
{
  if (o->starts < 1 || o->threads < 1 || o->search_count < 1 || o->polish_count < 1)
    return lab_fail(error, LAB_DATA, "starts, threads and counts of a fit must be at least 1");
  if (!(o->precision >= 1e-16 && o->precision <= 1e-2))
    return lab_fail(error, LAB_DATA, "precision of the residuals must be within 1e-16 .. 1e-2");
  return LAB_OK;
}

static int check(const lab_fit_problem *problem, const lab_fit_options *options, lab_error *error)
{
  int j;
  size_t i;
  if (problem->n < 1 || problem->n > LAB_FIT_MAX)
    return lab_fail(error, LAB_DATA, "%d parameters to fit, expected 1 .. %d", problem->n, LAB_FIT_MAX);
  if (problem->m < (size_t)problem->n || problem->m > 100000000)
    return lab_fail(error, LAB_DATA, "%d parameters cannot be fitted to %zu values", problem->n, problem->m);
  for (j = 0; j < problem->n; j++)
    if (check_param(&problem->param[j], options->starts > 1 || options->search == LAB_FIT_CRS, error))
      return error->status;
  for (i = 0; problem->sigma && i < problem->m; i++)
    if (!(problem->sigma[i] > 0 && isfinite(problem->sigma[i])))
      return lab_fail(error, LAB_DATA, "standard deviation %zu is %g, expected a number above 0", i + 1,
                      problem->sigma[i]);
  return check_options(options, error);
}

/* ---- Starts ---- */

/* Element `index` of van der Corput's sequence in a base: evenly spread over 0..1. */
static double spread_evenly(int index, int base)
{
  double value = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base)
    value += digit * (index % base);
  return value;
}

/* Where start `index` begins: at param.start, then along Halton's sequence through the box. */
static void start_point(const fit_run *run, int index, double *z)
{
  static const int prime[LAB_FIT_MAX] = {2,  3,  5,  7,  11, 13, 17, 19, 23, 29, 31, 37,
                                         41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89};
  int j;
  for (j = 0; j < run->problem->n; j++)
    z[j] = index == 0 ? 0 : run->lower[j] + (run->upper[j] - run->lower[j]) * spread_evenly(index, prime[j]);
}

/* What is kept of a start. */
typedef struct outcome {
  int status; /* LAB_OK: it gave a point */
  int finish;
  double sum;
  double z[LAB_FIT_MAX], step[LAB_FIT_MAX];
  int held[LAB_FIT_MAX];
  long evaluations, failed;
  lab_error error;
} outcome;

static void keep(const fit_run *run, outcome *out)
{
  out->status = run->status != LAB_OK ? run->status : isfinite(run->best) ? LAB_OK : LAB_NUMERIC;
  out->finish = run->finish;
  out->sum = run->best;
  memcpy(out->z, run->best_z, sizeof out->z);
  memcpy(out->step, run->step, sizeof out->step);
  memcpy(out->held, run->held, sizeof out->held);
  out->evaluations = run->evaluations;
  out->failed = run->failed;
  out->error = run->error;
}

static void run_start(const lab_fit_problem *problem, const lab_fit_options *options, int index, outcome *out)
{
  fit_run run;
  double z[LAB_FIT_MAX];
  out->status = fit_open(&run, problem, options, &out->error);
  if (out->status != LAB_OK)
    return;
  start_point(&run, index, z);
  if (fit_search(&run, z, (unsigned long)index + 1) == FIT_GOOD)
    fit_polish(&run);
  keep(&run, out);
  fit_close(&run);
}

static void run_starts(const lab_fit_problem *problem, const lab_fit_options *options, outcome *out)
{
  int i;
#pragma omp parallel for schedule(dynamic) num_threads(options->threads) if (options->threads > 1)
  for (i = 0; i < options->starts; i++)
    run_start(problem, options, i, &out[i]);
}

/* ---- Choice ---- */

/* The lowest sum of squares; of equals the first start, so that the order of the threads does not matter. An error
 * other than a failing model ends the fit, wherever it happened.  Returns: LAB_OK or the status. */
static int choose(const lab_fit_problem *problem, const outcome *out, int starts, int *best, lab_error *error)
{
  int i;
  *best = -1;
  for (i = 0; i < starts; i++) {
    if (out[i].status != LAB_OK && out[i].status != LAB_NUMERIC) {
      *error = out[i].error;
      return out[i].status;
    }
    if (out[i].status == LAB_OK && (*best < 0 || out[i].sum < out[*best].sum * (1 - 1e-9)))
      *best = i;
  }
  if (*best >= 0)
    return LAB_OK;
  *error = out[0].error;
  error->status = LAB_NUMERIC;
  return lab_fail_in(error, "the model cannot be fitted: it fails at %s, %s = %g %s",
                     starts > 1 ? "every start" : "the start", problem->param[0].name, problem->param[0].start,
                     problem->param[0].unit);
}

static void count(const outcome *out, int starts, int best, lab_fit_result *result)
{
  int i;
  for (i = 0; i < starts; i++) {
    result->evaluations += out[i].evaluations;
    result->failed += out[i].failed;
    result->starts += out[i].status == LAB_OK;
    result->agree += out[i].status == LAB_OK && out[i].sum <= out[best].sum * (1 + 1e-6) + 1e-20;
  }
}

/* Intervals and remarks of the best start. */
static int describe(const lab_fit_problem *problem, const lab_fit_options *options, const outcome *best,
                    lab_fit_result *result, lab_error *error)
{
  fit_run run;
  if (fit_open(&run, problem, options, error))
    return error->status;
  memcpy(run.best_z, best->z, sizeof run.best_z);
  memcpy(run.step, best->step, sizeof run.step);
  memcpy(run.held, best->held, sizeof run.held);
  run.best = best->sum;
  result->finish = best->finish;
  if (fit_spread(&run, result) == FIT_END) {
    *error = run.error;
    error->status = run.status ? run.status : LAB_NUMERIC;
  }
  result->evaluations += run.evaluations;
  fit_close(&run);
  return error->status;
}

int lab_fit_run(const lab_fit_problem *problem, const lab_fit_options *options, lab_fit_result *result,
                lab_error *error)
{
  lab_fit_options usual;
  outcome *out;
  int best, status;
  lab_fit_options_default(&usual);
  if (!options)
    options = &usual;
  memset(result, 0, sizeof *result);
  if (check(problem, options, error))
    return error->status;
  result->n = problem->n;
  result->m = problem->m;
  if (!(out = calloc((size_t)options->starts, sizeof *out)))
    return lab_fail_memory(error, "the starts of a fit");
  run_starts(problem, options, out);
  error->status = LAB_OK;
  status = choose(problem, out, options->starts, &best, error);
  if (status == LAB_OK) {
    count(out, options->starts, best, result);
    status = describe(problem, options, &out[best], result, error);
  }
  free(out);
  return status;
}
