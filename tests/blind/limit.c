#include "limit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMNS_MAX = BLIND_FITTED + BLIND_COMMANDS + BLIND_AT_ONCE };

/* ---- Projection ---- */

static double dot(const double *a, const double *b, size_t m)
{
  double sum = 0;
  size_t i;
  for (i = 0; i < m; i++)
    sum += a[i] * b[i];
  return sum;
}

static void take_out(const double *unit, double *s, size_t m)
{
  const double share = dot(unit, s, m);
  size_t i;
  for (i = 0; i < m; i++)
    s[i] -= share * unit[i];
}

/* Gram and Schmidt, each column twice. */
double blind_projected(double *column, int n, double *s, size_t m)
{
  int j, k;
  for (j = 0; j < n; j++) {
    double *c = column + (size_t)j * m;
    const double before = dot(c, c, m);
    double length;
    size_t i;
    for (k = 0; k < 2 * j; k++)
      take_out(column + (size_t)(k % j) * m, c, m);
    length = dot(c, c, m);
    length = length > 1e-20 * before ? 1 / sqrt(length) : 0; /* 0: nothing new in it */
    for (i = 0; i < m; i++)
      c[i] *= length;
  }
  for (k = 0; k < 2 * n; k++)
    take_out(column + (size_t)(k % n) * m, s, m);
  return dot(s, s, m);
}

/* ---- Noise-free runs ---- */

/* Channels of a run, over their noise, one behind the other; behind them room for what is known of the instants. */
static int respond(const blind_trial *t, const second_rig *rig, const blind_schedule *s, double step, double *y,
                   lab_error *error)
{
  const double sigma[3] = {t->base.pressure_noise, t->base.position_noise, t->base.temperature_noise};
  const second_rig g = blind_silent(rig, step);
  blind_rows rows;
  int c;
  size_t i;
  if (blind_simulate(&g, s, t->spacing, &rows, error))
    return error->status;
  for (c = 0; c < 3; c++)
    if (t->channels & (1 << c)) {
      const double *from = c == 0 ? rows.p : c == 1 ? rows.x : rows.T;
      for (i = 0; i < rows.n; i++)
        *y++ = from[i] / sigma[c];
    }
  blind_rows_free(&rows);
  return LAB_OK;
}

/* ---- Slopes ---- */

typedef struct work {
  const blind_trial *t;
  second_rig reference; /* all but the effect in question */
  size_t n, m;          /* values of the log; with those of the instants */
  double step;          /* [s] of slopes, then of the effect */
  int columns;
  double *base, *s, *column;
} work;

/* Response of a rig less that of the reference, which has the same steps, over the change that was made. */
static int differ(const work *w, const second_rig *rig, const blind_schedule *s, double over, double *y,
                  lab_error *error)
{
  size_t i;
  memset(y, 0, w->m * sizeof *y);
  if (respond(w->t, rig, s, w->step, y, error))
    return error->status;
  for (i = 0; i < w->n; i++)
    y[i] = (y[i] - w->base[i]) / over;
  return LAB_OK;
}

static double *next_column(work *w)
{
  return w->column + (size_t)w->columns++ * w->m;
}

static int fitted_columns(work *w, lab_error *error)
{
  const double share = 1e-3;
  int j;
  for (j = 0; j < BLIND_FITTED; j++) {
    second_rig g = w->reference;
    blind_scale_fitted(&g, j, 1 + share);
    if (differ(w, &g, &w->t->fit, share, next_column(w), error))
      return error->status;
  }
  return LAB_OK;
}

/* An instant is known to within the row that shows it: a uniform distribution, whose standard deviation is the unit of
 * its column and of the value behind the log's. The difference is over a part of that, lest it reach the next row. */
static int instant_columns(work *w, lab_error *error)
{
  const double spread = w->t->spacing / sqrt(12), part = 0.1;
  size_t k;
  for (k = 0; k < w->t->fit.n; k++) {
    blind_schedule s = w->t->fit;
    double *c = next_column(w);
    s.t[k] += part * spread;
    if (differ(w, &w->reference, &s, part, c, error))
      return error->status;
    c[w->n + k] = 1;
  }
  return LAB_OK;
}

/* The other effects of the trial, by a fiftieth of their size; a law that is switched has no slope. */
static int other_columns(work *w, int which, lab_error *error)
{
  const double share = 0.02;
  int i;
  for (i = 0; i < w->t->n_missing; i++) {
    blind_trial other = *w->t;
    second_rig g;
    if (i == which || other.missing[i].effect->lo == other.missing[i].effect->hi)
      continue;
    other.missing[i].size *= 1 + share;
    g = blind_truth(&other, (unsigned)BLIND_ALL & ~(1u << which));
    if (differ(w, &g, &w->t->fit, share, next_column(w), error))
      return error->status;
  }
  return LAB_OK;
}

/* Slopes are smooth: a coarse grid will do, unless an effect that stays needs a fine one. */
static int slopes(work *w, int which, lab_error *error)
{
  const double coarse = 2e-4;
  int i;
  w->step = coarse;
  for (i = 0; i < w->t->n_missing; i++)
    if (i != which && w->t->missing[i].effect->step > 0)
      w->step = 3 * w->t->step;
  if (respond(w->t, &w->reference, &w->t->fit, w->step, w->base, error) || fitted_columns(w, error) ||
      instant_columns(w, error))
    return error->status;
  return other_columns(w, which, error);
}

/* ---- The limit ---- */

/* Statistic at a size. The columns are orthogonal after the first call, which does them no harm. */
static int statistic_at(work *w, int which, double size, double *statistic, lab_error *error)
{
  blind_trial sized = *w->t;
  second_rig g;
  sized.missing[which].size = size;
  g = blind_truth(&sized, BLIND_ALL);
  if (differ(w, &g, &w->t->fit, 1, w->s, error))
    return error->status;
  *statistic = blind_projected(w->column, w->columns, w->s, w->m);
  return LAB_OK;
}

/* From the statistic at one size to the size at which it is 25, and again from there, within the range that is drawn.
 */
static int find_limit(work *w, int which, double *size, double *statistic, lab_error *error)
{
  const blind_missing *m = &w->t->missing[which];
  const blind_effect *e = m->effect;
  const double scale = blind_scale_of(e->scale, &w->t->base), sign = m->size < 0 ? -1 : 1;
  const int rounds = e->lo == e->hi ? 0 : 3;
  double at = fabs(m->size), here;
  int i;
  w->step = 3 * w->t->step;
  if (respond(w->t, &w->reference, &w->t->fit, w->step, w->base, error) ||
      statistic_at(w, which, m->size, statistic, error))
    return error->status;
  here = *statistic;
  *size = at * sqrt(BLIND_LIMIT_STATISTIC / here);
  for (i = 0; i < rounds && fabs(log(*size / at)) > log(1.3); i++) {
    at = fmin(fmax(*size, e->lo * scale), e->hi * scale);
    if (statistic_at(w, which, sign * at, &here, error))
      return error->status;
    *size = at * sqrt(BLIND_LIMIT_STATISTIC / here);
  }
  return LAB_OK;
}

int blind_limit(const blind_trial *t, int which, double *size, double *statistic, lab_error *error)
{
  work w = {0};
  int status;
  w.t = t;
  w.reference = blind_truth(t, (unsigned)BLIND_ALL & ~(1u << which));
  w.n = second_samples(t->fit.end, t->spacing) * strlen(blind_channels_text(t->channels));
  w.m = w.n + BLIND_COMMANDS;
  w.base = calloc((COLUMNS_MAX + 2) * w.m, sizeof *w.base);
  if (!w.base)
    return lab_fail_memory(error, "sensitivities");
  w.s = w.base + w.m;
  w.column = w.s + w.m;
  status = slopes(&w, which, error);
  if (status == LAB_OK)
    status = find_limit(&w, which, size, statistic, error);
  free(w.base);
  return status;
}
