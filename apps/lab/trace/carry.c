#include "carry.h"

#include <math.h>
#include <stdlib.h>

#include "../base/clock.h"
#include "../fit/errors.h"

/* One run alone with what it has for itself, or all others with their unknowns.
 * In:      run  room for them, used as long as `part` is */
static void take_part(const lab_unknowns *u, int one, int alone, lab_run *run, lab_unknowns *part)
{
  int e, j, n = 0;
  *part = *u;
  part->slopes = NULL;
  part->run = run;
  part->n_rows = 0;
  for (e = 0; e < u->n_runs; e++)
    if ((e == one) == alone) {
      run[n++] = u->run[e];
      part->n_rows += u->run[e].n * (size_t)u->run[e].n_channels;
    }
  part->n_runs = n;
  for (n = j = 0; j < u->n; j++) {
    lab_unknown x = u->unknown[j];
    if ((x.run == one) != alone)
      continue;
    x.run = alone ? 0 : x.run - (x.run > one);
    part->unknown[n++] = x;
  }
  part->n = n;
  lab_unknowns_view(part, 0);
}

/* Sum of squares on one run of a model that is fitted to the others.
 * In/out:  run, less  room for that
 * Out:     sum        infinite where it cannot be followed */
static int predict_left(const lab_unknowns *u, int left, lab_run *run, lab_unknowns *less, double *sum,
                        lab_error *error)
{
  enum { STEPS = 5 };
  lab_rig model;
  lab_errors errors;
  int status;
  take_part(u, left, 0, run, less);
  status = lab_unknowns_fit(less, STEPS, NULL, error);
  if (status == LAB_OK) {
    model = less->rig;
    take_part(u, left, 1, run, less);
    less->rig = model;
    status = less->n > 0 ? lab_unknowns_fit(less, STEPS, NULL, error) : LAB_OK;
  }
  if (status == LAB_OK)
    status = lab_loop_errors(less, &errors, error);
  *sum = status == LAB_OK ? errors.chi2 : (double)INFINITY;
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_carry_over(const lab_candidate *c, double *of_run, lab_error *error)
{
  lab_run *run = calloc((size_t)c->u.n_runs, sizeof *run);
  lab_unknowns *less = malloc(sizeof *less);
  int e, status = run && less ? LAB_OK : lab_fail_memory(error, "the runs but one");
  for (e = 0; e < c->u.n_runs && status == LAB_OK; e++)
    status = predict_left(&c->u, e, run, less, &of_run[e], error);
  free(less);
  free(run);
  return status;
}

/* The same of all runs. */
static int carry_over_all(const lab_candidate *c, double *sum, lab_error *error)
{
  double *of_run = malloc((size_t)c->u.n_runs * sizeof *of_run);
  int e, status = of_run ? lab_carry_over(c, of_run, error) : lab_fail_memory(error, "errors of runs");
  for (*sum = 0, e = 0; e < c->u.n_runs && status == LAB_OK; e++)
    *sum += of_run[e];
  free(of_run);
  return status;
}

int lab_carry_is_better(const double *other, const double *present, int n)
{
  double mean = 0, squares = 0;
  int e;
  for (e = 0; e < n; e++)
    mean += (present[e] - other[e]) / n;
  for (e = 0; e < n; e++)
    squares += pow(present[e] - other[e] - mean, 2);
  return mean == (double)INFINITY || mean > sqrt(squares / n / (n - 1));
}

int lab_carry_is_asked(const lab_candidate *c)
{
  return c->u.n_runs >= lab_count(LAB_CARRY_RUNS) && c->u.window == 0 && !lab_is_noise(&c->quality);
}

/* A candidate without one of what was found, where that carries over better.
 * In/out:  c, error_of  it and its error on runs left out */
static int try_without(lab_candidate *c, int which, double *error_of, int *any, lab_error *error)
{
  lab_candidate *without = malloc(sizeof *without);
  double sum = INFINITY;
  int status = without ? lab_candidate_leave_out(c, which, without, error) : lab_fail_memory(error, "a candidate");
  if (status == LAB_OK && without->quality.fitted)
    status = carry_over_all(without, &sum, error);
  if (status == LAB_OK && sum < *error_of && !lab_cpu_is_spent(c->u.until)) {
    *c = *without;
    *error_of = sum;
    *any = 1;
  }
  free(without);
  return status;
}

int lab_carry_prune(lab_candidate *c, int *any, lab_error *error)
{
  double sum = INFINITY;
  int i, status = LAB_OK;
  *any = 0;
  if (c->n_found == 0 || !lab_carry_is_asked(c) || lab_cpu_is_spent(c->u.until))
    return LAB_OK;
  status = carry_over_all(c, &sum, error);
  for (i = c->n_found - 1; i >= 0 && status == LAB_OK && !lab_cpu_is_spent(c->u.until); i--)
    if (c->found[i].term < 0 || i == c->n_found - 1)
      status = try_without(c, i, &sum, any, error);
  return status;
}
