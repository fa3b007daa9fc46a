#include "linear.h"

#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"

/* Views of the runs, every row of which weighs the same.  In: weight  ones, for the rows and channels of any run */
static void open_plain(const lab_unknowns *u, double *weight, lab_run *run, lab_unknowns *plain)
{
  int e;
  *plain = *u;
  plain->run = run;
  plain->nuisance = NULL;
  plain->slopes = NULL;
  for (e = 0; e < u->n_runs; e++) {
    run[e] = u->run[e];
    run[e].weight = weight;
    run[e].drift = NULL;
    memset(run[e].colour, 0, sizeof run[e].colour);
  }
  lab_unknowns_count(plain);
}

/* From residuals to errors in SI, in place. */
static void to_errors(const lab_unknowns *u, double *r)
{
  size_t i;
  int e, c;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++)
      for (i = 0; i < u->run[e].n; i++)
        *r++ *= u->run[e].sigma[c];
}

/* In:      plain  of open_plain
 * Out:     r, J   room for its residuals, and for their slopes */
static int simulate(lab_unknowns *plain, double *r, double *J, lab_linear *l, lab_error *error)
{
  char done[LAB_FIT_MAX];
  int j;
  for (j = 0; j < plain->n; j++)
    done[j] = plain->unknown[j].kind == LAB_UNKNOWN_INSTANT;
  if (lab_unknowns_residuals(plain, NULL, r, error) || lab_unknowns_slopes(plain, r, done, J, error))
    return error->status;
  if (lab_cpu_is_spent(plain->until))
    return lab_fail(error, LAB_NUMERIC, "no time to follow the runs");
  memcpy(l->error, r, l->rows * sizeof *r);
  to_errors(plain, l->error);
  for (j = 0; j < plain->n; j++) {
    double *to = l->slope + (size_t)l->n * l->rows;
    if (plain->unknown[j].kind == LAB_UNKNOWN_INSTANT)
      continue;
    memcpy(to, J + (size_t)j * plain->m, l->rows * sizeof *J);
    to_errors(plain, to);
    l->theta[l->n++] = plain->unknown[j].value;
  }
  return LAB_OK;
}

int lab_linear_open(const lab_unknowns *u, lab_linear *l, lab_error *error)
{
  lab_unknowns *plain = malloc(sizeof *plain);
  lab_run *run = malloc((size_t)(u->n_runs + 1) * sizeof *run);
  double *weight, *r, *J;
  size_t i;
  int status;
  *l = (lab_linear){.n_runs = u->n_runs, .rows = u->n_rows};
  weight = malloc((l->rows + 1) * sizeof *weight);
  r = malloc((u->m + 1) * sizeof *r);
  J = malloc(((size_t)u->n * u->m + 1) * sizeof *J);
  l->error = malloc((l->rows + 1) * sizeof *l->error);
  l->slope = malloc(((size_t)u->n * l->rows + 1) * sizeof *l->slope);
  for (i = 0; weight && i < l->rows; i++)
    weight[i] = 1;
  status = plain && run && weight && r && J && l->error && l->slope ? LAB_OK : lab_fail_memory(error, "runs");
  if (status == LAB_OK) {
    open_plain(u, weight, run, plain);
    status = simulate(plain, r, J, l, error);
  }
  free(plain);
  free(run);
  free(weight);
  free(r);
  free(J);
  return status;
}

void lab_linear_close(lab_linear *l)
{
  free(l->error);
  free(l->slope);
}

int lab_linear_has(const lab_unknowns *u, int e)
{
  return u->linear && !u->window && e < u->linear->n_runs;
}

/* Add what errors [SI] in the rows of run e change from theta to another. */
static void move(const lab_unknowns *u, size_t first, size_t n, const double *theta, const double *other, double *r)
{
  const lab_linear *l = u->linear;
  size_t i;
  int j;
  for (j = 0; j < l->n; j++) {
    const double *slope = l->slope + (size_t)j * l->rows + first, by = other[j] - theta[j];
    for (i = 0; i < n && by != 0; i++)
      r[i] += by * slope[i];
  }
}

/* From SI to noises of run x, in place. */
static void over_noise(const lab_run *x, double *r)
{
  size_t i;
  int c;
  for (c = 0; c < x->n_channels; c++)
    for (i = 0; i < x->n; i++)
      *r++ /= x->sigma[c];
}

static size_t first_of(const lab_unknowns *u, int e)
{
  size_t first = 0;
  while (--e >= 0)
    first += lab_unknowns_residuals_in(u, e);
  return first;
}

void lab_linear_errors(const lab_unknowns *u, int e, const double *theta, double *r)
{
  const size_t first = first_of(u, e), n = lab_unknowns_residuals_in(u, e);
  memcpy(r, u->linear->error + first, n * sizeof *r);
  move(u, first, n, u->linear->theta, theta, r);
  over_noise(&u->run[e], r);
}

void lab_linear_change(const lab_unknowns *u, int e, const double *theta, const double *other, double *change)
{
  const size_t n = lab_unknowns_residuals_in(u, e);
  memset(change, 0, n * sizeof *change);
  move(u, first_of(u, e), n, theta, other, change);
  over_noise(&u->run[e], change);
}
