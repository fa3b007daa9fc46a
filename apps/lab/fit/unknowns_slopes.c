/* What other models, or other values, change in the residuals, to first order, from one run of each experiment. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drive.h"
#include "nuisance.h"

static const double coarser = 10;   /* times the tolerance of the stepper: its errors are none of what is followed */
static const double shorter = 1e-4; /* a slope's step, over that of a difference of two runs: one that is long passes
                                       the edge of a dead band, or a stop, where the rates change at once */

/* One experiment and what is asked for there. */
typedef struct together {
  lab_drive *drive; /* the first is the model as it is */
  lab_run_case *as;
  double **change;
  char *done;
  int *of; /* which of those asked for each is */
  int n;
} together;

static void together_close(together *t)
{
  int i;
  for (i = 0; t->drive && i <= t->n; i++)
    lab_drive_close(&t->drive[i]);
  free(t->drive);
  free(t->as);
  free(t->change);
  free(t->done);
  free(t->of);
}

static int together_open(together *t, int room, lab_error *error)
{
  t->n = 0;
  t->drive = calloc((size_t)room + 1, sizeof *t->drive);
  t->as = calloc((size_t)room + 1, sizeof *t->as);
  t->change = calloc((size_t)room + 1, sizeof *t->change);
  t->done = calloc((size_t)room + 1, sizeof *t->done);
  t->of = calloc((size_t)room + 1, sizeof *t->of);
  return t->drive && t->as && t->change && t->done && t->of ? LAB_OK : lab_fail_memory(error, "slopes");
}

/* Take up a model with its values: the first, or the last that was counted. */
static int take_up(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, together *t,
                   lab_error *error)
{
  lab_drive *d = &t->drive[t->n];
  const int status = lab_drive_open(u, model, theta, e, d, error);
  t->as[t->n] = (lab_run_case){d->episode, d->n, d->early};
  return status;
}

/* Turn what an experiment predicts more into a change of its residuals, in place. */
static void weigh_change(const lab_unknowns *u, int e, double *r)
{
  const lab_run *x = &u->run[e];
  int c;
  size_t i;
  for (c = 0; c < x->n_channels; c++)
    for (i = 0; i < x->n; i++) {
      double *at = &r[(size_t)c * x->n + i];
      *at = isnan(lab_run_measured(x, c, i)) ? 0 : -*at / x->sigma[c];
    }
  lab_unknowns_weigh(u, e, r);
}

/* Runs in which those asked for are followed: as many however many threads there are, because the parts of a step
 * depend on what is followed together. */
static int runs_for(int n)
{
  static const int most = 32; /* in one run */
  return (n + most - 1) / most;
}

/* In/out: lost  those that cannot be had */
static int follow(const lab_unknowns *u, int e, together *t, char *lost, lab_error *error)
{
  const int runs = runs_for(t->n);
  int i, k, status = LAB_OK;
#pragma omp parallel for schedule(static, 1) if (runs > 1)
  for (k = 0; k < runs; k++) {
    const int from = k * t->n / runs, n = (k + 1) * t->n / runs - from;
    lab_error mine;
    const int at =
        lab_run_vary(&u->run[e], t->as, t->as + 1 + from, n, coarser * u->tol, t->change + from, t->done + from, &mine);
    if (at != LAB_OK) {
#pragma omp critical(slopes_error)
      *error = mine, status = at;
    }
  }
  for (i = 0; i < t->n; i++) {
    lost[t->of[i]] |= status != LAB_OK || !t->done[i];
    if (status == LAB_OK && t->done[i])
      weigh_change(u, e, t->change[i]);
  }
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Behind the data of a change: what is projected out, and priors, which have no part in it.  Returns: whether it is
 * finite */
static int finish(const lab_unknowns *u, double scale, double *change)
{
  int good = 1;
  size_t i;
  for (i = 0; i < u->n_data; i++) {
    change[i] *= scale;
    good &= isfinite(change[i]) != 0;
  }
  memset(change + u->n_data, 0, (u->m - u->n_data) * sizeof *change);
  if (u->nuisance)
    lab_nuisance_project(u->nuisance, change);
  return good;
}

int lab_unknowns_changes_with(const lab_unknowns *u, const lab_rig *const *model, int n, double *const *change,
                              char *done, lab_error *error)
{
  double now[LAB_FIT_MAX];
  char *lost = calloc((size_t)n + 1, 1);
  size_t from = 0;
  int e, i, status = lost ? LAB_OK : lab_fail_memory(error, "slopes");
  memset(done, 0, (size_t)n);
  for (i = 0; i < u->n; i++)
    now[i] = u->unknown[i].value;
  for (e = 0; e < u->n_runs && status == LAB_OK && u->window == 0; from += lab_unknowns_residuals_in(u, e), e++) {
    together t;
    status = together_open(&t, n, error);
    if (status == LAB_OK)
      status = take_up(u, &u->rig, now, e, &t, error);
    for (i = 0; i < n && status == LAB_OK; i++) {
      if (lost[i])
        continue;
      t.of[t.n] = i;
      t.change[t.n++] = change[i] + from;
      status = take_up(u, model[i], now, e, &t, error);
    }
    if (status == LAB_OK)
      status = follow(u, e, &t, lost, error);
    together_close(&t);
  }
  for (i = 0; i < n && status == LAB_OK && u->window == 0; i++)
    done[i] = !lost[i] && finish(u, 1, change[i]);
  free(lost);
  return status;
}

/* Take up the model with another value of unknown j. */
static int take_up_step(const lab_unknowns *u, const double *theta, int j, double step, int e, together *t,
                        lab_error *error)
{
  double at[LAB_FIT_MAX];
  lab_rig *model = malloc(sizeof *model);
  int status = model ? LAB_OK : lab_fail_memory(error, "a model");
  if (status == LAB_OK) {
    memcpy(at, theta, (size_t)u->n * sizeof *at);
    at[j] += step;
    *model = u->rig;
    lab_unknowns_apply(u, at, LAB_ALL_RUNS, model);
    status = take_up(u, model, at, e, t, error);
  }
  free(model);
  return status;
}

/* Those of one experiment, from value `from` on of each column.  In/out: lost  those that cannot be had, or are not
 * asked for */
static int vary_run(const lab_unknowns *u, const double *theta, const double *step, int e, size_t from, double *J,
                    char *lost, lab_error *error)
{
  together t;
  int j, status = together_open(&t, u->n, error);
  if (status == LAB_OK)
    status = take_up_step(u, theta, 0, 0, e, &t, error);
  for (j = 0; j < u->n && status == LAB_OK; j++) {
    if (lost[j] || !lab_unknown_acts(&u->unknown[j], e))
      continue;
    t.of[t.n] = j;
    t.change[t.n++] = J + (size_t)j * u->m + from;
    status = take_up_step(u, theta, j, step[j], e, &t, error);
  }
  if (status == LAB_OK)
    status = follow(u, e, &t, lost, error);
  together_close(&t);
  return status;
}

int lab_unknowns_slopes_together(void *context, const double *theta, double *J, char *done, lab_error *error)
{
  const lab_unknowns *u = context;
  double step[LAB_FIT_MAX];
  char lost[LAB_FIT_MAX];
  size_t from = 0;
  int e, j;
  if (u->window || u->n == 0)
    return LAB_OK;
  memcpy(lost, done, sizeof lost);
  for (j = 0; j < u->n; j++) {
    step[j] = shorter * lab_unknowns_slope_step(u, theta, j);
    if (!done[j])
      memset(J + (size_t)j * u->m, 0, u->m * sizeof *J);
  }
  for (e = 0; e < u->n_runs; from += lab_unknowns_residuals_in(u, e), e++)
    if (vary_run(u, theta, step, e, from, J, lost, error))
      return error->status;
  for (j = 0; j < u->n; j++) {
    double *column = J + (size_t)j * u->m;
    if (lost[j])
      continue;
    done[j] = (char)finish(u, 1 / step[j], column);
    lab_unknowns_slope_of_prior(u, j, column);
  }
  return LAB_OK;
}
