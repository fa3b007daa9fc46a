#include "unknowns.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double two_pi = 6.283185307179586;
static const double uniform_spread = 0.28867513459481287; /* standard deviation of a uniform distribution of width 1 */
static const double knot_spread = 20;                     /* of a knot about 0: it must not run away unseen */

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
  for (j = 0; j < rig->n_fit; j++)
    if (rig->fit_per_log[j] ? add_per_log(u, rig, rig->fit[j], error)
                            : lab_unknowns_add(u, rig->fit[j], declared_value(rig, rig->fit[j]), error))
      return error->status;
  add_switches(u);
  lab_unknowns_view(u, 0);
  return LAB_OK;
}
