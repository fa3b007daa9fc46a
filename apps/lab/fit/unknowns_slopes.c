/* What other models, or other values, change in the residuals, to first order, from one run of each experiment. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drive.h"
#include "linear.h"
#include "nuisance.h"

static const double coarser = 10;   /* times the tolerance of the stepper: its errors are none of what is followed */
static const double shorter = 1e-4; /* a slope's step, over that of a difference of two runs: one that is long passes
                                       the edge of a dead band, or a stop, where the rates change at once */

/* What is asked for: a model with its values, where one of its unknowns acts, or everywhere, and where to put what it
 * changes. */
typedef struct asked {
  const lab_rig *model;
  const double *theta;
  const lab_unknown *of; /* NULL: everywhere */
  double *change;        /* u->m values */
  char is_lost;          /* it cannot be had */
} asked;

/* One experiment and what is followed there. */
typedef struct together {
  lab_drive *drive; /* the first is the model as it is */
  lab_run_case *as;
  double **change;
  char *done;
  int *which; /* of those asked for each is */
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
  free(t->which);
}

static int together_open(together *t, int room, lab_error *error)
{
  t->n = 0;
  t->drive = calloc((size_t)room + 1, sizeof *t->drive);
  t->as = calloc((size_t)room + 1, sizeof *t->as);
  t->change = calloc((size_t)room + 1, sizeof *t->change);
  t->done = calloc((size_t)room + 1, sizeof *t->done);
  t->which = calloc((size_t)room + 1, sizeof *t->which);
  return t->drive && t->as && t->change && t->done && t->which ? LAB_OK : lab_fail_memory(error, "slopes");
}

/* Take up a model with its values: the first, or the last that was counted. */
static int take_up(const lab_unknowns *u, const asked *a, int e, together *t, lab_error *error)
{
  lab_drive *d = &t->drive[t->n];
  const int status = lab_drive_open(u, a->model, a->theta, e, d, error);
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

/* In/out: ask  is_lost */
static int follow(const lab_unknowns *u, int e, together *t, asked *ask, lab_error *error)
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
    ask[t->which[i]].is_lost |= status != LAB_OK || !t->done[i];
    if (status == LAB_OK && t->done[i])
      weigh_change(u, e, t->change[i]);
  }
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Those of one experiment, from value `from` on of each change.  In/out: ask  n of them */
static int vary_run(const lab_unknowns *u, const asked *base, asked *ask, int n, int e, size_t from, lab_error *error)
{
  together t;
  int i, status = together_open(&t, n, error);
  if (status == LAB_OK)
    status = take_up(u, base, e, &t, error);
  for (i = 0; i < n && status == LAB_OK; i++) {
    if (ask[i].is_lost || (ask[i].of && !lab_unknown_acts(ask[i].of, e)))
      continue;
    t.which[t.n] = i;
    t.change[t.n++] = ask[i].change + from;
    status = take_up(u, &ask[i], e, &t, error);
  }
  if (status == LAB_OK)
    status = follow(u, e, &t, ask, error);
  together_close(&t);
  return status;
}

/* The same of one that is followed to first order anyway: other values are all that differs. */
static void vary_linear(const lab_unknowns *u, const asked *base, asked *ask, int n, int e, size_t from)
{
  int i;
  for (i = 0; i < n; i++) {
    if (ask[i].is_lost || (ask[i].of && !lab_unknown_acts(ask[i].of, e)))
      continue;
    lab_linear_change(u, e, base->theta, ask[i].theta, ask[i].change + from);
    lab_unknowns_weigh(u, e, ask[i].change + from);
  }
}

/* Those of all experiments. */
static int vary(const lab_unknowns *u, const asked *base, asked *ask, int n, lab_error *error)
{
  size_t from = 0;
  int e, status = LAB_OK;
  for (e = 0; e < u->n_runs && status == LAB_OK; from += lab_unknowns_residuals_in(u, e), e++)
    if (lab_linear_has(u, e))
      vary_linear(u, base, ask, n, e, from);
    else
      status = vary_run(u, base, ask, n, e, from, error);
  return status;
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

int lab_unknowns_changes_with(const lab_unknowns *u, const lab_rig *model, int n, double *change, char *done,
                              lab_error *error)
{
  double now[LAB_FIT_MAX];
  const asked base = {&u->rig, now, NULL, NULL, 0};
  asked *ask = malloc(((size_t)n + 1) * sizeof *ask);
  int i, status = ask ? LAB_OK : lab_fail_memory(error, "slopes");
  memset(done, 0, (size_t)n);
  lab_unknowns_values(u, now);
  for (i = 0; i < n && status == LAB_OK; i++)
    ask[i] = (asked){&model[i], now, NULL, change + (size_t)i * u->m, 0};
  if (status == LAB_OK && u->window == 0) {
    status = vary(u, &base, ask, n, error);
    for (i = 0; i < n && status == LAB_OK; i++)
      done[i] = !ask[i].is_lost && finish(u, 1, ask[i].change);
  }
  free(ask);
  return status;
}

/* Models with one unknown moved each, and the values that they are of. */
typedef struct moved {
  lab_rig model;
  double theta[LAB_FIT_MAX];
} moved;

static void move(const lab_unknowns *u, const double *theta, int j, double step, moved *to)
{
  memcpy(to->theta, theta, (size_t)u->n * sizeof *theta);
  to->theta[j] += step;
  to->model = u->rig;
  lab_unknowns_apply(u, to->theta, LAB_ALL_RUNS, &to->model);
}

/* In:  at  room for u->n and one more */
static int slopes_at(const lab_unknowns *u, const double *theta, moved *at, double *J, char *done, lab_error *error)
{
  asked base, ask[LAB_FIT_MAX];
  double step[LAB_FIT_MAX];
  int j;
  move(u, theta, 0, 0, &at[u->n]);
  base = (asked){&at[u->n].model, at[u->n].theta, NULL, NULL, 0};
  for (j = 0; j < u->n; j++) {
    double *column = J + (size_t)j * u->m;
    step[j] = shorter * lab_unknowns_slope_step(u, theta, j);
    move(u, theta, j, step[j], &at[j]);
    ask[j] = (asked){&at[j].model, at[j].theta, &u->unknown[j], column, done[j]};
    if (!done[j])
      memset(column, 0, u->m * sizeof *column);
  }
  if (vary(u, &base, ask, u->n, error))
    return error->status;
  for (j = 0; j < u->n; j++) {
    if (ask[j].is_lost)
      continue;
    done[j] = (char)finish(u, 1 / step[j], ask[j].change);
    lab_unknowns_slope_of_prior(u, j, ask[j].change);
  }
  return LAB_OK;
}

int lab_unknowns_slopes_together(void *context, const double *theta, double *J, char *done, lab_error *error)
{
  const lab_unknowns *u = context;
  moved *at;
  int status;
  if (u->window || u->n == 0)
    return LAB_OK;
  at = malloc((size_t)(u->n + 1) * sizeof *at);
  status = at ? slopes_at(u, theta, at, J, done, error) : lab_fail_memory(error, "slopes");
  free(at);
  return status;
}
