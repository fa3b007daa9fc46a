#include "unknowns.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "coarse.h"
#include "descent.h"
#include "../base/noise.h"

static const double two_pi = 6.283185307179586;
static const double uniform_spread = 0.28867513459481287; /* standard deviation of a uniform distribution of width 1 */
static const double slope_step = 1e-3;                    /* of a slope's difference, over what matters; */
static const double knot_spread = 20;                     /* of a knot about 0: it must not run away unseen */
static const double rough_share = 0.3;  /* of the windows with motion: that many rough ones are no accident */
static const double coarse_step = 0.05; /* so long a step where slips come and go on shorter ones */

/* ---- What there is to find ---- */

static lab_unknown *append(lab_unknowns *u)
{
  lab_unknown *x = u->n < LAB_FIT_MAX ? &u->unknown[u->n++] : NULL;
  if (x) {
    memset(x, 0, sizeof *x);
    x->experiment = LAB_ALL_EXPERIMENTS;
  }
  return x;
}

static int no_room(lab_error *error)
{
  return lab_fail(error, LAB_DATA, "more than %d things to fit at once", (int)LAB_FIT_MAX);
}

static void describe_param(lab_unknown *x, int param)
{
  pneu_param_info info;
  x->kind = LAB_UNKNOWN_PARAM;
  x->index = param;
  lab_fit_name(param, x->name);
  if (param == LAB_FIT_ORIFICE_AREA) {
    snprintf(x->unit, sizeof x->unit, "1");
    x->lower = 1e-3;
    x->upper = 1e3;
    x->scale = 1;
    return;
  }
  pneu_param_describe(param, &info);
  snprintf(x->unit, sizeof x->unit, "%s", info.unit);
  x->lower = (double)info.lower;
  x->upper = (double)info.upper;
  x->scale = fabs((double)info.value - (param < PNEU_PARAM_BASE_COUNT || info.shape ? 0 : (double)info.neutral));
}

int lab_unknowns_add(lab_unknowns *u, int param, double value, lab_error *error)
{
  lab_unknown *x = append(u);
  if (!x)
    return no_room(error);
  describe_param(x, param);
  x->value = x->first = fmin(fmax(value, x->lower), x->upper);
  if (param < PNEU_PARAM_BASE_COUNT && x->value != 0)
    x->scale = fabs(x->value);
  if (param != LAB_FIT_ORIFICE_AREA)
    *pneu_param_at(&u->rig.params, param) = (pneu_real)x->value;
  return LAB_OK;
}

static double longest_log(const lab_unknowns *u)
{
  double longest = 0;
  int e;
  for (e = 0; e < u->n_experiments; e++) {
    const double *t = u->experiment[e].log->value[LAB_CHANNEL_TIME] + u->experiment[e].first;
    longest = fmax(longest, t[u->experiment[e].n - 1] - t[0]);
  }
  return longest;
}

/* The period of the last free term. What matters is what turns the phase at the end of the longest log by a radian. */
static void add_period(lab_unknowns *u)
{
  const pneu_term *term = &u->rig.term[u->rig.n_terms];
  const double period = (double)(term->to - term->from);
  lab_unknown *x = append(u);
  x->kind = LAB_UNKNOWN_PERIOD;
  x->term = u->rig.n_terms;
  snprintf(x->name, sizeof x->name, "unlisted_%d.period", x->term + 1);
  snprintf(x->unit, sizeof x->unit, "s");
  x->value = x->first = period;
  x->lower = period / 2;
  x->upper = period * 2;
  x->scale = period * period / (two_pi * fmax(longest_log(u), period));
}

int lab_unknowns_add_term(lab_unknowns *u, const pneu_term *term, double scale, int held, lab_error *error)
{
  const int cycles = term->argument == PNEU_TERM_OVER_CYCLE;
  int i;
  if (u->rig.n_terms == LAB_TERM_MAX || u->n + term->n + cycles > LAB_FIT_MAX)
    return no_room(error);
  u->rig.term[u->rig.n_terms] = *term;
  for (i = held; i < term->n - held; i++) {
    lab_unknown *x = append(u);
    x->kind = LAB_UNKNOWN_KNOT;
    x->term = u->rig.n_terms;
    x->index = i;
    snprintf(x->name, sizeof x->name, "unlisted_%d.%d", x->term + 1, i + 1);
    x->value = x->first = (double)term->value[i];
    x->lower = -1e3 * scale;
    x->upper = 1e3 * scale;
    x->scale = scale;
    x->spread = knot_spread * scale;
  }
  if (cycles)
    add_period(u);
  u->rig.n_terms++;
  return LAB_OK;
}

void lab_unknowns_drop(lab_unknowns *u, int param)
{
  pneu_param_info info;
  int j, k;
  for (j = k = 0; j < u->n; j++)
    if (u->unknown[j].kind != LAB_UNKNOWN_PARAM || u->unknown[j].index != param)
      u->unknown[k++] = u->unknown[j];
  u->n = k;
  pneu_param_describe(param, &info);
  *pneu_param_at(&u->rig.params, param) = info.shape ? info.value : info.neutral;
}

static int is_of_term(const lab_unknown *x, int term)
{
  return (x->kind == LAB_UNKNOWN_KNOT || x->kind == LAB_UNKNOWN_PERIOD) && x->term == term;
}

void lab_unknowns_drop_term(lab_unknowns *u)
{
  int j, k;
  u->rig.n_terms--;
  for (j = k = 0; j < u->n; j++)
    if (!is_of_term(&u->unknown[j], u->rig.n_terms))
      u->unknown[k++] = u->unknown[j];
  u->n = k;
}

int lab_unknowns_find(const lab_unknowns *u, int param)
{
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_PARAM && u->unknown[j].index == param)
      return j;
  return -1;
}

/* Room for three effects with their shapes, or a free term. */
enum { SWITCHES_END = LAB_FIT_MAX - 40 };

/* A change of command happened between the row before and the row that shows it: half the bracket, give or take what a
 * uniform distribution has. Those for which there is no room stay at half. */
static void add_switches(lab_unknowns *u)
{
  int e, index = 0;
  for (e = 0; e < u->n_experiments; e++) {
    size_t k;
    for (k = 0; k < u->experiment[e].n_switches; k++, index++) {
      const double bracket = u->experiment[e].bracket[k];
      lab_unknown *x = bracket > 0 && u->n < SWITCHES_END ? append(u) : NULL;
      if (!x)
        continue;
      x->kind = LAB_UNKNOWN_SWITCH;
      x->index = index;
      x->experiment = e;
      snprintf(x->name, sizeof x->name, "switch_%d", index + 1);
      snprintf(x->unit, sizeof x->unit, "s");
      x->value = x->first = x->prior = bracket / 2;
      x->upper = bracket;
      x->scale = bracket;
      x->spread = uniform_spread * bracket;
    }
  }
}

static double declared_value(const lab_rig *rig, int param)
{
  return param == LAB_FIT_ORIFICE_AREA ? 1.0 : (double)*pneu_param_at((pneu_params *)&rig->params, param);
}

/* A parameter that each experiment has for itself. */
static int add_per_log(lab_unknowns *u, const lab_rig *rig, int param, lab_error *error)
{
  int e;
  for (e = 0; e < u->n_experiments; e++) {
    char name[LAB_FIT_TEXT];
    lab_unknown *x;
    if (lab_unknowns_add(u, param, declared_value(rig, param), error))
      return error->status;
    x = &u->unknown[u->n - 1];
    x->experiment = e;
    snprintf(x->name, sizeof x->name, "%.80s.%d", lab_fit_name(param, name), e + 1);
  }
  return LAB_OK;
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

int lab_unknowns_open(const lab_rig *rig, const lab_experiment *experiment, int n_experiments, lab_unknowns *u,
                      lab_error *error)
{
  int j, e;
  memset(u, 0, sizeof *u);
  u->experiment = experiment;
  u->n_experiments = n_experiments;
  u->rig = *rig;
  u->declared = rig->params;
  u->tol = 1e-6;
  for (e = 0; e < n_experiments; e++)
    u->n_rows += experiment[e].n * (size_t)experiment[e].n_channels;
  u->n_data = u->n_rows;
  u->n_values = count_values(u);
  for (j = 0; j < rig->n_fit; j++)
    if (rig->fit_per_log[j] ? add_per_log(u, rig, rig->fit[j], error)
                            : lab_unknowns_add(u, rig->fit[j], declared_value(rig, rig->fit[j]), error))
      return error->status;
  add_switches(u);
  u->m = u->n_data + (size_t)u->n;
  return LAB_OK;
}

/* ---- Residuals ---- */

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

/* Share of the windows in which pressure or position of an experiment is rougher than the model's.
 * In/out:  r  its errors over noise; then what the model predicts */
static double roughness(const lab_experiment *x, double *r, size_t window)
{
  double share = 0;
  int c;
  size_t i;
  for (c = 0; c < x->n_channels; c++, r += x->n) {
    const double *measured = x->log->value[x->channel[c]] + x->first;
    if (x->channel[c] == LAB_CHANNEL_T)
      continue;
    for (i = 0; i < x->n; i++)
      r[i] = measured[i] - r[i] * x->sigma[c];
    share = fmax(share,
                 lab_coarse_roughness(measured, r, x->n, window, fmax(x->sigma[c], lab_smallest_step(measured, x->n))));
  }
  return share;
}

/* The window of the first experiment that is rough; 0 if none is. */
static size_t rough_window(const lab_unknowns *u, double *r)
{
  enum { WINDOWS = 90, SHORTEST = 30, LONGEST = 200 };
  int e;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    const size_t fair = x->n / WINDOWS, w = fair < SHORTEST ? SHORTEST : fair > LONGEST ? LONGEST : fair;
    if (roughness(x, r, w) > rough_share)
      return w;
    r += x->n * (size_t)x->n_channels;
  }
  return 0;
}

int lab_unknowns_rough(const lab_unknowns *u, size_t *window, lab_error *error)
{
  double *errors;
  int status;
  *window = 0;
  if (!(u->rig.params.stroke > 0) || u->rig.laws.position_input)
    return LAB_OK;
  errors = malloc((u->n_rows + 1) * sizeof *errors);
  status = errors ? lab_unknowns_errors(u, errors, error) : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    *window = rough_window(u, errors);
  free(errors);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* A difference into the side where there is room, with a step that is small beside what matters. */
int lab_unknowns_slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const lab_unknowns *u = context;
  const lab_unknown *x = &u->unknown[j];
  double at[LAB_FIT_MAX], step = (u->window ? coarse_step : slope_step) * (x->scale > 0 ? x->scale : 1);
  size_t i;
  memcpy(at, theta, (size_t)u->n * sizeof *at);
  if (theta[j] + step > x->upper)
    step = -step;
  at[j] = theta[j] + step;
  if (lab_unknowns_residuals(context, at, column, error))
    return error->status;
  for (i = 0; i < u->m; i++)
    column[i] = (column[i] - r[i]) / (at[j] - theta[j]);
  return LAB_OK;
}

/* ---- Fits ---- */

int lab_unknowns_fit(lab_unknowns *u, int steps, double *chi2, lab_error *error)
{
  double theta[LAB_FIT_MAX], lower[LAB_FIT_MAX], upper[LAB_FIT_MAX], own;
  unsigned char lasting[LAB_FIT_MAX];
  lab_descent problem = {u->n, 0, steps, lower, upper, lasting, u, lab_unknowns_residuals, lab_unknowns_slope};
  int j;
  u->m = problem.m = u->n_data + (size_t)u->n;
  for (j = 0; j < u->n; j++) {
    lower[j] = u->unknown[j].lower;
    upper[j] = u->unknown[j].upper;
    lasting[j] = u->unknown[j].kind == LAB_UNKNOWN_SWITCH;
  }
  present(u, theta);
  if (lab_descend(&problem, theta, chi2 ? chi2 : &own, error))
    return error->status;
  for (j = 0; j < u->n; j++)
    u->unknown[j].value = theta[j];
  lab_unknowns_apply(u, theta, LAB_ALL_EXPERIMENTS, &u->rig);
  return LAB_OK;
}

/* All columns of the slopes, in parallel; 0 where the model fails. Signature of fit.h. */
static int slopes(void *context, const double *theta, const double *r, double *slope, lab_error *error)
{
  lab_unknowns *u = context;
  int j, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (j = 0; j < u->n; j++) {
    lab_error mine;
    double *column = slope + (size_t)j * u->m;
    const int at = lab_unknowns_slope(u, theta, r, j, column, &mine);
    if (at == LAB_NUMERIC)
      memset(column, 0, u->m * sizeof *column);
    else if (at != LAB_OK) {
#pragma omp critical(slope_error)
      *error = mine, status = at;
    }
  }
  return status;
}

int lab_unknowns_spread(lab_unknowns *u, lab_fit_result *result, lab_error *error)
{
  lab_fit_param param[LAB_FIT_MAX];
  lab_fit_problem problem = {u->n, param, 0, lab_unknowns_residuals, slopes, u, NULL, 1};
  lab_fit_options options;
  int j;
  memset(result, 0, sizeof *result);
  if (u->n == 0)
    return LAB_OK;
  u->m = problem.m = u->n_data + (size_t)u->n;
  for (j = 0; j < u->n; j++) {
    const lab_unknown *x = &u->unknown[j];
    param[j] = (lab_fit_param){x->name, x->unit, x->value, x->lower, x->upper, 0, x->scale};
  }
  lab_fit_options_default(&options);
  options.search = LAB_FIT_NONE;
  return lab_fit_run(&problem, &options, result, error);
}
