#include "onset_score.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/quantile.h"
#include "../fit/drift.h"
#include "../fit/nuisance.h"
#include "decide.h"

enum { PLACES = 64 }; /* of a run at which anything may begin */

/* Faults of a valve that come at once: a supply or a spring that fails, a packing that seizes, an orifice that clogs, a
 * leak, a sensor that is knocked, a lever that slips, a positioner that is set otherwise. What a design has, such as a
 * tube, does not begin. A vent area that changes is vent_restriction. */
static const char *const values[] = {"supply_pressure", "dry_friction", "spring_rate",    "spring_preload",
                                     "orifice_area",    "fill_area",    "positioner.gain"};
static const char *const effects[] = {
    "chamber_leak",      "laminar_leak",      "porous_leak",     "supply_droop",    "exhaust_back_pressure",
    "vent_restriction",  "pressure_bias",     "pressure_gain",   "position_bias",   "position_gain",
    "friction_position", "friction_pressure", "positioner_zero", "positioner_span", "positioner_dead_band"};

/* ---- A model with one value changed ---- */

static void add(lab_rig *rig, int param, double size)
{
  if (param == LAB_PARAM_ORIFICE_AREA) {
    rig->params.fill_area *= (pneu_real)(1 + size);
    rig->params.vent_area *= (pneu_real)(1 + size);
    return;
  }
  *pneu_param_at(&rig->params, param) += (pneu_real)size;
}

/* What is tried first: an effect's usual size, a fifth of a value; into the side where there is room. */
static double first_step(const lab_rig *rig, int param)
{
  static const double share = 0.2;
  const pneu_param_info info = lab_param_info(param);
  const double now = lab_param_value(rig, param);
  if (param == LAB_PARAM_ORIFICE_AREA)
    return -share;
  if (param < PNEU_PARAM_BASE_COUNT)
    return param == PNEU_PARAM_dry_friction ? share * now : -share * now;
  return now + (double)(info.value - info.neutral) < (double)info.upper ? (double)(info.value - info.neutral)
                                                                        : (double)(info.neutral - info.value);
}

/* ---- Every place of one slope ---- */

/* A run's residual, open to every slope: neither what is known to a tolerance nor a drift follows it yet. Taking a
 * drift out is symmetric, so that it may be done to what a slope is multiplied by. */
typedef struct scan {
  const lab_projection *p;
  lab_unknowns open; /* without nuisance and drift */
  lab_run run;       /* its only run */
  double *before;    /* open.m residuals */
  size_t n;          /* rows */
  int first, last;   /* places at which it may begin */
  double *r;         /* the residual of p */
  double *column;    /* n_columns that are projected out of every slope, and what the residual has along each */
  double *along;
  int n_columns;
} scan;

/* Sums over the rows of one place of a run, all channels. */
static double sum_at(const scan *s, const double *a, const double *b, int place)
{
  const size_t first = s->n * (size_t)place / PLACES, end = s->n * (size_t)(place + 1) / PLACES;
  double sum = 0;
  int c;
  for (c = 0; c < s->run.n_channels; c++)
    sum += lab_dot(a + (size_t)c * s->n + first, b + (size_t)c * s->n + first, end - first);
  return sum;
}

/* What the rows from a place on have along one direction, which is taken off both sums.
 * In:      r  along it */
static void take_off(const scan *s, const double *column, double r, const double *slope, double along[PLACES],
                     double length2[PLACES])
{
  double c = 0;
  int k;
  for (k = PLACES - 1; k >= 0; k--) {
    c += sum_at(s, column, slope, k);
    along[k] -= r * c;
    length2[k] -= c * c;
  }
}

/* The same of the drift of a channel, which is taken out but for its tolerance. */
static void take_drift_off(const scan *s, int channel, const double *slope, double length2[PLACES])
{
  const double *v = s->p->u->run[0].drift + (size_t)channel * s->n, *of = slope + (size_t)channel * s->n;
  const double share = 2 - lab_dot(v, v, s->n);
  double c = 0;
  int k;
  for (k = PLACES - 1; k >= 0; k--) {
    const size_t first = s->n * (size_t)k / PLACES, end = s->n * (size_t)(k + 1) / PLACES;
    c += lab_dot(v + first, of + first, end - first);
    length2[k] -= share * c * c;
  }
}

/* Keep the best place for a slope that was taken over a step. */
static void judge(const scan *s, const double *slope, double step, double up, double down, double *throughout,
                  lab_score *score)
{
  double along[PLACES], length2[PLACES], a = 0, whole = 0;
  int j, k;
  for (k = PLACES - 1; k >= 0; k--) {
    along[k] = a += sum_at(s, slope, s->r, k);
    length2[k] = whole += sum_at(s, slope, slope, k);
  }
  for (j = 0; s->p->u->run[0].drift && j < s->run.n_channels; j++)
    take_drift_off(s, j, slope, length2);
  for (j = 0; j < s->n_columns; j++)
    take_off(s, s->column + (size_t)j * s->open.n_data, s->along[j], slope, along, length2);
  for (k = 0; k < PLACES; k++) {
    const double size = -along[k] / length2[k] * step, statistic = along[k] * along[k] / length2[k];
    if (!(length2[k] > pow(lab_constant(LAB_INVISIBLE), 2) * whole) || (size > 0 && !(up > 0)) ||
        (size < 0 && !(down > 0)))
      continue;
    if (k == 0)
      *throughout = fmax(*throughout, statistic);
    else if (s->first <= k && k <= s->last && statistic > score->statistic) {
      score->statistic = statistic;
      score->size = fmax(fmin(size, up), -down);
      score->onset = s->n * (size_t)k / PLACES;
    }
  }
}

/* How far a parameter may change either way. */
static void room_of(const scan *s, int param, double *up, double *down)
{
  const double now = lab_param_value(&s->open.rig, param);
  const int is_share = param == LAB_PARAM_ORIFICE_AREA;
  *up = is_share ? HUGE_VAL : (double)lab_param_info(param).upper - now;
  *down = is_share ? 1 : now - (double)lab_param_info(param).lower;
}

/* Score one of them by differences, at shorter steps where one changes far too much.  Returns: how many slopes */
static int score_one(const scan *s, double *throughout, lab_score *score, double *slope, lab_error *all)
{
  double up, down, step = first_step(&s->open.rig, score->param);
  lab_error error;
  int tries, n = 0;
  room_of(s, score->param, &up, &down);
  for (tries = 0; tries < lab_count(LAB_SLOPE_SIZES); tries++) {
    lab_rig model = s->open.rig;
    double length;
    add(&model, score->param, step);
    if (lab_unknowns_change_with(&s->open, &model, s->before, slope, &error)) {
      lab_fail_together(all, &error);
      step *= lab_constant(LAB_SLOPE_SMALL);
      continue;
    }
    length = sqrt(lab_dot(slope, slope, s->open.n_data));
    judge(s, slope, step, up, down, throughout, score);
    n++;
    if (!(length > lab_constant(LAB_SLOPE_LONG)))
      break;
    step *= lab_constant(LAB_SLOPE_SEEN) / length;
  }
  return n;
}

/* ---- All that may begin ---- */

static void list_one(int param, int effect, lab_onset_scores *all)
{
  all->of[all->n].param = param;
  all->of[all->n].effect = effect;
  all->of[all->n++].shape = -1;
}

/* A declared value; an orifice that is none cannot clog, nor a positioner be set. */
static void list_values(const lab_unknowns *u, lab_onset_scores *all)
{
  size_t i;
  for (i = 0; i < sizeof values / sizeof *values; i++) {
    const int param = lab_param_index(values[i]);
    if (param >= 0 && lab_param_value(&u->rig, param) != 0)
      list_one(param, -1, all);
  }
}

static void list_effects(const lab_unknowns *u, lab_onset_scores *all)
{
  size_t i;
  for (i = 0; i < sizeof effects / sizeof *effects; i++) {
    const int effect = pneu_effect_find(effects[i]);
    if (effect >= 0 && lab_score_can_be_missing(&u->rig, effect))
      list_one(pneu_effect_params(effect, NULL), effect, all);
  }
}

/* One direction that is projected out.  In: r  what the residual has along it */
static void add_column(scan *s, const double *from, double r)
{
  double *column = s->column + (size_t)s->n_columns * s->open.n_data;
  memcpy(column, from, s->open.n_data * sizeof *column);
  lab_drift_take_out(&s->p->u->run[0], column);
  s->along[s->n_columns++] = r;
}

static void add_columns(scan *s)
{
  const lab_projection *p = s->p;
  const lab_nuisance *h = p->u->nuisance;
  int j;
  for (j = 0; j < p->n_basis; j++) {
    const double *column = p->basis + (size_t)j * p->m;
    add_column(s, column, lab_dot(column, p->r, p->m));
  }
  for (j = 0; h && j < h->n; j++)
    add_column(s, h->basis + (size_t)j * (h->n_data + LAB_FIT_MAX), 0);
  memcpy(s->r, p->r, s->open.n_data * sizeof *s->r);
  lab_drift_take_out(&p->u->run[0], s->r);
}

static int open_scan(const lab_projection *p, size_t from, size_t to, scan *s, lab_error *error)
{
  const size_t columns = (size_t)(p->n_basis + (p->u->nuisance ? p->u->nuisance->n : 0)) + 1;
  s->p = p;
  s->open = *p->u;
  s->run = p->u->run[0];
  s->run.drift = NULL;
  s->open.run = &s->run;
  s->open.nuisance = NULL;
  s->n = s->run.n;
  s->first = (int)(from * PLACES / s->n);
  s->last = to < s->n ? (int)(to * PLACES / s->n) : PLACES - 1;
  lab_unknowns_count(&s->open);
  s->before = malloc(s->open.m * sizeof *s->before);
  s->r = malloc(s->open.n_data * sizeof *s->r);
  s->column = malloc(columns * s->open.n_data * sizeof *s->column);
  s->along = malloc(columns * sizeof *s->along);
  if (!s->before || !s->r || !s->column || !s->along)
    return lab_fail_memory(error, "a scan");
  add_columns(s);
  return lab_unknowns_residuals(&s->open, NULL, s->before, error);
}

static void close_scan(scan *s)
{
  free(s->before);
  free(s->r);
  free(s->column);
  free(s->along);
}

/* Score those that can be had from one run.  Out: done  of each */
static int score_together(const scan *s, lab_onset_scores *all, double *slopes, char *done, lab_error *error)
{
  static const double share = 1e-3; /* of the usual step */
  lab_rig *model = malloc((size_t)all->n * sizeof *model);
  double up, down;
  int i, status = model ? LAB_OK : lab_fail_memory(error, "models");
  for (i = 0; i < all->n && status == LAB_OK; i++) {
    model[i] = s->open.rig;
    add(&model[i], all->of[i].param, share * first_step(&s->open.rig, all->of[i].param));
  }
  if (status == LAB_OK)
    status = lab_unknowns_changes_with(&s->open, model, all->n, slopes, done, error);
  for (i = 0; i < all->n && status == LAB_OK; i++) {
    if (!done[i])
      continue;
    room_of(s, all->of[i].param, &up, &down);
    judge(s, slopes + (size_t)i * s->open.m, share * first_step(&s->open.rig, all->of[i].param), up, down,
          &all->throughout, &all->of[i]);
    all->tests++;
  }
  free(model);
  return status;
}

/* Score the others, each by runs of its own. */
static int score_others(const scan *s, lab_onset_scores *all, double *slopes, const char *done, lab_error *error)
{
  double throughout = all->throughout;
  int i, tests = 0;
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic) reduction(+ : tests) reduction(max : throughout)
  for (i = 0; i < all->n; i++) {
    double own = 0;
    if (done[i])
      continue;
    tests += score_one(s, &own, &all->of[i], slopes + (size_t)i * s->open.m, error);
    throughout = fmax(throughout, own);
  }
  all->throughout = throughout;
  all->tests += tests;
  return error->status;
}

static int score_all(const scan *s, lab_onset_scores *all, lab_error *error)
{
  double *slopes = malloc((size_t)all->n * s->open.m * sizeof *slopes);
  char done[LAB_ONSET_SCORES_MAX];
  int i, status = slopes ? LAB_OK : lab_fail_memory(error, "slopes");
  if (status == LAB_OK)
    status = score_together(s, all, slopes, done, error);
  if (status == LAB_OK)
    status = score_others(s, all, slopes, done, error);
  free(slopes);
  all->tests *= s->last - s->first + 1;
  for (i = 0; i < all->n; i++) {
    all->of[i].p_value = lab_chi2_tail(all->of[i].statistic, 1);
    all->of[i].explained = s->p->excess > 0 ? all->of[i].statistic / s->p->excess : 0;
  }
  qsort(all->of, (size_t)all->n, sizeof *all->of, lab_score_by_statistic);
  return status;
}

double lab_onset_scores_level(const lab_onset_scores *all, double alpha)
{
  return alpha / (all->tests > 0 ? all->tests : 1);
}

void lab_onset_scores_list(const lab_unknowns *u, lab_onset_scores *all)
{
  memset(all, 0, sizeof *all);
  list_values(u, all);
  list_effects(u, all);
}

int lab_onset_scores_find(const lab_projection *p, size_t from, size_t to, lab_onset_scores *all, lab_error *error)
{
  scan *s = calloc(1, sizeof *s);
  int status = s ? open_scan(p, from, to, s, error) : lab_fail_memory(error, "a scan");
  lab_onset_scores_list(p->u, all);
  if (status == LAB_OK)
    status = score_all(s, all, error);
  if (s)
    close_scan(s);
  free(s);
  return status;
}
