/* What is left of the measured values for given unknowns, row by row or seen coarsely. */
#include <math.h>
#include <stdlib.h>

#include "coarse.h"
#include "unknowns.h"

static void apply_one(const lab_unknown *x, double value, const pneu_params *declared, lab_rig *rig)
{
  if (x->kind == LAB_UNKNOWN_KNOT) {
    rig->term[x->term].value[x->index] = (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_PERIOD) {
    rig->term[x->term].to = rig->term[x->term].from + (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_PARAM && x->index == LAB_FIT_ORIFICE_AREA) {
    rig->params.fill_area = declared->fill_area * (pneu_real)value;
    rig->params.vent_area = declared->vent_area * (pneu_real)value;
  } else if (x->kind == LAB_UNKNOWN_PARAM) {
    *pneu_param_at(&rig->params, x->index) = (pneu_real)value;
  }
}

void lab_unknowns_apply(const lab_unknowns *u, const double *theta, int experiment, lab_rig *rig)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].experiment == LAB_ALL_EXPERIMENTS || u->unknown[j].experiment == experiment)
      apply_one(&u->unknown[j], theta[j], &u->declared, rig);
}

/* How early each change of command of an experiment was, in its order. */
static void early_of(const lab_unknowns *u, const double *theta, int first, const lab_experiment *e, double *early)
{
  int j;
  size_t i;
  for (i = 0; i < e->n_switches; i++)
    early[i] = e->bracket[i] / 2;
  for (j = 0; j < u->n; j++) {
    const int k = u->unknown[j].index - first;
    if (u->unknown[j].kind == LAB_UNKNOWN_SWITCH && k >= 0 && k < (int)e->n_switches)
      early[k] = theta[j];
  }
}

/* Turn predictions into errors over noise, in place. */
static void weigh(const lab_experiment *e, double *r)
{
  int c;
  size_t i;
  for (c = 0; c < e->n_channels; c++)
    for (i = 0; i < e->n; i++) {
      double *at = &r[(size_t)c * e->n + i];
      const double measured = lab_experiment_measured(e, c, i);
      *at = isnan(measured) ? 0 : (measured - *at) / e->sigma[c];
    }
}

/* Take the memory out of the noise: what is left of each error after the part that the row before it predicts. */
static void whiten(const lab_experiment *e, double *r)
{
  int c;
  size_t i;
  for (c = 0; c < e->n_channels; c++) {
    const double memory = e->memory[c], fresh = 1 / sqrt(1 - memory * memory);
    double *channel = r + (size_t)c * e->n;
    for (i = memory != 0 ? e->n - 1 : 0; i > 0; i--)
      if (channel[i] != 0 && channel[i - 1] != 0)
        channel[i] = fresh * (channel[i] - memory * channel[i - 1]);
  }
}

/* Predictions of one experiment. */
static int predict(const lab_unknowns *u, const lab_rig *model, const double *theta, int e, int first, double *r,
                   lab_error *error)
{
  const lab_experiment *x = &u->experiment[e];
  lab_rig rig = *model;
  double *early = malloc((x->n_switches + 1) * sizeof *early);
  int j, status;
  if (!early)
    return lab_fail_memory(error, "a schedule");
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].experiment == e)
      apply_one(&u->unknown[j], theta[j], &u->declared, &rig);
  early_of(u, theta, first, x, early);
  status = lab_experiment_predict(x, &rig, early, u->tol, r, error);
  free(early);
  return status;
}

static int errors_at(const lab_unknowns *u, const lab_rig *model, const double *theta, int whitened, double *r,
                     lab_error *error)
{
  int e, first = 0;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    if (predict(u, model, theta, e, first, r, error))
      return error->status;
    weigh(x, r);
    if (whitened)
      whiten(x, r);
    r += x->n * (size_t)x->n_channels;
    first += (int)x->n_switches;
  }
  return LAB_OK;
}

/* Residuals of all channels of an experiment, seen coarsely.  Returns: the place after them. */
static double *coarsen(const lab_unknowns *u, const lab_experiment *x, const double *predicted, double *r)
{
  int c;
  for (c = 0; c < x->n_channels; c++) {
    lab_coarse_residuals(x->log->value[x->channel[c]] + x->first, predicted + (size_t)c * x->n, x->n, u->window,
                         x->sigma[c], r);
    r += 2 * lab_coarse_count(x->n, u->window);
  }
  return r;
}

static int coarse_residuals_at(const lab_unknowns *u, const lab_rig *model, const double *theta, double *r,
                               lab_error *error)
{
  double *predicted = malloc((u->n_rows + 1) * sizeof *predicted);
  int e, first = 0, status = predicted ? LAB_OK : lab_fail_memory(error, "a response");
  for (e = 0; e < u->n_experiments && status == LAB_OK; e++) {
    status = predict(u, model, theta, e, first, predicted, error);
    if (status == LAB_OK)
      r = coarsen(u, &u->experiment[e], predicted, r);
    first += (int)u->experiment[e].n_switches;
  }
  free(predicted);
  return status;
}

static size_t count_values(const lab_unknowns *u)
{
  size_t i, count = 0;
  int e, c;
  for (e = 0; e < u->n_experiments; e++)
    for (c = 0; c < u->experiment[e].n_channels; c++)
      for (i = 0; i < u->experiment[e].n; i++)
        count += !isnan(lab_experiment_measured(&u->experiment[e], c, i));
  return count;
}

void lab_unknowns_view(lab_unknowns *u, size_t window)
{
  int e;
  u->window = window;
  u->n_data = window ? 0 : u->n_rows;
  for (e = 0; window && e < u->n_experiments; e++)
    u->n_data += 2 * lab_coarse_count(u->experiment[e].n, window) * (size_t)u->experiment[e].n_channels;
  u->n_values = window ? u->n_data : count_values(u);
  u->m = u->n_data + (size_t)u->n;
}

static int residuals_at(const lab_unknowns *u, const lab_rig *model, const double *theta, double *r, lab_error *error)
{
  int j, status = u->window ? coarse_residuals_at(u, model, theta, r, error) : errors_at(u, model, theta, 1, r, error);
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    r[u->n_data + (size_t)j] = x->spread > 0 ? (x->prior - theta[j]) / x->spread : 0;
  }
  return status;
}

static void present(const lab_unknowns *u, double *theta)
{
  int j;
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
}

int lab_unknowns_residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const lab_unknowns *u = context;
  double now[LAB_FIT_MAX];
  lab_rig model = u->rig;
  if (!theta) {
    present(u, now);
    theta = now;
  }
  lab_unknowns_apply(u, theta, LAB_ALL_EXPERIMENTS, &model);
  return residuals_at(u, &model, theta, r, error);
}

int lab_unknowns_residuals_with(const lab_unknowns *u, const lab_rig *rig, double *r, lab_error *error)
{
  double now[LAB_FIT_MAX];
  present(u, now);
  return residuals_at(u, rig, now, r, error);
}

int lab_unknowns_errors(const lab_unknowns *u, double *r, lab_error *error)
{
  double now[LAB_FIT_MAX];
  present(u, now);
  return errors_at(u, &u->rig, now, 0, r, error);
}
