/* The global stage of a fit: DIRECT of NLopt, which divides the box and needs no luck. NLopt may end at a worse point
 * than it has visited, with a rounding error for a status, and ask a rounding error outside of its bounds: the best
 * point is kept here, held within the bounds, and its status is not asked for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <nlopt.h>

#include "../base/clock.h"
#include "fit.h"

typedef struct search {
  const lab_fit_problem *problem;
  nlopt_opt opt;
  double *r;
  double best, best_theta[LAB_FIT_MAX];
  double penalty; /* value where the model fails, finite */
  int status;     /* LAB_OK, or what ended it */
  lab_error *error;
} search;

static double objective(unsigned n, const double *z, double *gradient, void *data)
{
  search *s = data;
  const lab_fit_problem *p = s->problem;
  double theta[LAB_FIT_MAX], chi2;
  unsigned j;
  int status;
  (void)gradient;
  if (lab_cpu_is_spent(p->until))
    nlopt_force_stop(s->opt);
  if (s->status != LAB_OK || lab_cpu_is_spent(p->until)) /* it may ask on after a forced stop */
    return s->penalty;
  for (j = 0; j < n; j++)
    theta[j] = fmin(fmax(z[j], p->lower[j]), p->upper[j]);
  status = lab_fit_evaluate(p, theta, s->r, &chi2, s->error);
  if (status != LAB_OK && status != LAB_NUMERIC) {
    s->status = status;
    nlopt_force_stop(s->opt);
  }
  if (status != LAB_OK)
    return s->penalty;
  if (chi2 < s->best) {
    s->best = chi2;
    memcpy(s->best_theta, theta, n * sizeof *theta);
  }
  return fmin(chi2, s->penalty);
}

static void run(search *s, const double *theta)
{
  const lab_fit_problem *p = s->problem;
  double z[LAB_FIT_MAX], least;
  memcpy(z, theta, (size_t)p->n * sizeof *z);
  nlopt_set_lower_bounds(s->opt, p->lower);
  nlopt_set_upper_bounds(s->opt, p->upper);
  nlopt_set_min_objective(s->opt, objective, s);
  nlopt_set_maxeval(s->opt, p->search);
  nlopt_optimize(s->opt, z, &least);
}

int lab_fit_search(const lab_fit_problem *p, double *theta, lab_error *error)
{
  search s = {.problem = p, .error = error};
  s.r = malloc(p->m * sizeof *s.r);
  s.opt = nlopt_create(NLOPT_GN_DIRECT_L, (unsigned)p->n);
  if (!s.r || !s.opt)
    s.status = lab_fail_memory(error, "the search of a fit");
  else
    s.status = lab_fit_evaluate(p, theta, s.r, &s.best, error);
  if (s.status == LAB_OK) {
    memcpy(s.best_theta, theta, (size_t)p->n * sizeof *theta);
    s.penalty = 1e3 * s.best + 1e-30;
    run(&s, theta);
  }
  if (s.status == LAB_OK)
    memcpy(theta, s.best_theta, (size_t)p->n * sizeof *theta);
  nlopt_destroy(s.opt);
  free(s.r);
  return s.status;
}
