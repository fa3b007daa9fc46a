/* Stage 1: NLopt, which has no method for least squares but finds the valley. It may return a worse point than it
 * visited, one that is outside the bounds by a rounding, or the status ROUNDOFF_LIMITED: none of that matters here,
 * as fit_evaluate clips and keeps the best. */
#include <math.h>

#include <nlopt.h>

#include "fit_private.h"

/* What the objective needs. */
typedef struct search {
  fit_run *run;
  nlopt_opt opt;
  double penalty; /* value where the model fails: finite, as quadratic models cannot bear infinity */
} search;

static double objective(unsigned n, const double *z, double *gradient, void *data)
{
  search *s = data;
  double sum;
  int outcome;
  (void)n, (void)gradient;
  if (s->run->status != LAB_OK) /* some methods ask on after a forced stop */
    return s->penalty;
  outcome = fit_evaluate(s->run, z, &sum);
  if (outcome == FIT_END)
    nlopt_force_stop(s->opt);
  return outcome == FIT_GOOD && sum < s->penalty ? sum : s->penalty;
}

/* The algorithm; BOBYQA's quadratic model needs two dimensions. */
static nlopt_algorithm algorithm(const lab_fit_options *options, int n)
{
  if (options->search == LAB_FIT_CRS)
    return NLOPT_GN_CRS2_LM;
  return options->search == LAB_FIT_BOBYQA && n > 1 ? NLOPT_LN_BOBYQA : NLOPT_LN_SBPLX;
}

/* A quarter of a unit, or of the box where that is less. */
static void first_steps(const fit_run *run, double *step)
{
  int j;
  for (j = 0; j < run->problem->n; j++)
    step[j] = 0.25 * fmin(1, run->upper[j] - run->lower[j]);
}

static void run_search(search *s, const double *start)
{
  const lab_fit_options *o = s->run->options;
  const int n = s->run->problem->n;
  double z[LAB_FIT_MAX], step[LAB_FIT_MAX], sum;
  int j;
  for (j = 0; j < n; j++)
    z[j] = start[j];
  first_steps(s->run, step);
  nlopt_set_lower_bounds(s->opt, s->run->lower);
  nlopt_set_upper_bounds(s->opt, s->run->upper);
  nlopt_set_min_objective(s->opt, objective, s);
  nlopt_set_initial_step(s->opt, step);
  nlopt_set_maxeval(s->opt, o->search_count * n);
  nlopt_set_ftol_rel(s->opt, 1e-5); /* rough: the polish follows */
  nlopt_set_xtol_rel(s->opt, 1e-5);
  nlopt_optimize(s->opt, z, &sum);
}

int fit_search(fit_run *run, const double *z, unsigned long seed)
{
  search s;
  double sum;
  int outcome = fit_evaluate(run, z, &sum);
  if (outcome != FIT_GOOD || run->options->search <= LAB_FIT_POLISH_ONLY)
    return outcome;
  s.run = run;
  s.penalty = 1e3 * sum + 1e-30;
  s.opt = nlopt_create(algorithm(run->options, run->problem->n), (unsigned)run->problem->n);
  if (!s.opt) {
    run->status = lab_fail_memory(&run->error, "NLopt");
    return FIT_END;
  }
  nlopt_srand(seed); /* NLopt's generator is one a thread */
  run_search(&s, z);
  nlopt_destroy(s.opt);
  return run->status == LAB_OK ? FIT_GOOD : FIT_END;
}
