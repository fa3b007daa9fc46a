#include "recorded_limit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "limit.h"

/* Values, instants, effects, the vent beside the fill orifice, the integral of a loop, and of two sensors zero, gain,
 * lag and drift, and the clock between them. */
enum { INSTRUMENTS = 11, COLUMNS = BLIND_VALUES + BLIND_PIECES + BLIND_AT_ONCE + INSTRUMENTS };

/* Standard deviations of ordinary instruments: shares of the span, 1, s, shares of the span over the log, s. */
static const double zero_known = 0.0025, gain_known = 0.0025, lag_known = 5e-3, drift_known = 0.0025,
                    clock_known = 5e-3;

typedef struct work {
  blind_recorded r;  /* with nothing that soils its log */
  unsigned which;    /* effects of the true rig */
  size_t n, rows, m; /* values of the log; of one channel; with what is known of each column */
  double *y, *over;  /* response, noise of each value */
  double *column, *s;
  int columns;
  double step;
} work;

/* ---- Runs ---- */

/* The trial with a perfect sensor but for its filter, and a perfect logger. */
static blind_recorded cleaned(const blind_recorded *from)
{
  blind_recorded r = *from;
  int i;
  for (i = 0; i < BLIND_SENSORS; i++)
    r.hum[i] = r.colour[i] = r.drift[i] = 0;
  r.rounding = r.jitter = r.lost = r.gap = 0;
  r.bits = 52;
  r.t.declared.pressure_noise = r.t.declared.position_noise = r.t.declared.temperature_noise = 0;
  return r;
}

/* The channels that the trial has, one behind the other. */
static int respond(const work *w, const blind_recorded *r, unsigned which, double *y, lab_error *error)
{
  const second_rig first = blind_recorded_first(r, which), later = blind_recorded_later(r, which);
  blind_fine fine;
  blind_log log;
  int c;
  if (blind_run_recorded(r, &first, &later, w->step, &fine, error))
    return error->status;
  if (blind_spoil(r, &fine, &log, error) == LAB_OK) {
    for (c = 0; c < 3; c++)
      if (r->t.channels & (1 << c)) {
        memcpy(y, c == 0 ? log.p : c == 1 ? log.x : log.T, w->rows * sizeof *y);
        y += w->rows;
      }
    blind_log_free(&log);
  }
  blind_fine_free(&fine);
  return error->status;
}

static int differ(const work *w, const blind_recorded *r, unsigned which, double by, double *out, lab_error *error)
{
  size_t i;
  memset(out, 0, w->m * sizeof *out);
  if (respond(w, r, which, out, error))
    return error->status;
  for (i = 0; i < w->n; i++)
    out[i] = (out[i] - w->y[i]) / (by * w->over[i]);
  return LAB_OK;
}

/* ---- Noise ---- */

static double squared(double x)
{
  return x * x;
}

/* Standard deviation of a value: noise, that with memory as it counts for what is slow, steps of the converter, hum,
 * and the clock's error times the slope. */
static void soil(const blind_recorded *soiled, work *w)
{
  const second_rig *g = &soiled->t.declared;
  const double white[3] = {g->pressure_noise, g->position_noise, g->temperature_noise};
  const double span[3] = {g->supply, g->stroke, 0}, keep = exp(-soiled->spacing / soiled->memory);
  const double late = squared(soiled->rounding) / 12 + squared(soiled->jitter);
  size_t at = 0, i;
  int c;
  for (c = 0; c < 3; c++) {
    double level = squared(white[c]) + squared(1.25 * span[c] / (double)(1L << soiled->bits)) / 12;
    if (!(w->r.t.channels & (1 << c)))
      continue;
    if (c < BLIND_SENSORS)
      level += squared(white[c] * soiled->colour[c]) * (1 + keep) / (1 - keep) + squared(span[c] * soiled->hum[c]) / 2;
    for (i = 0; i < w->rows; i++) {
      const double *y = w->y + at;
      const size_t a = i ? i - 1 : 0, b = i + 1 < w->rows ? i + 1 : i;
      const double slope = (y[b] - y[a]) / ((double)(b - a) * w->r.spacing);
      w->over[at + i] = sqrt(level + late * slope * slope);
    }
    at += w->rows;
  }
}

/* ---- What can be adjusted ---- */

static double *next_column(work *w)
{
  return w->column + (size_t)w->columns++ * w->m;
}

/* The column is of one standard deviation of what is known; that is its own row. */
static void is_known(work *w, double *column)
{
  column[w->n + (size_t)w->columns - 1] = 1;
}

static int is_fitted(int value)
{
  int i;
  for (i = 0; i < BLIND_FITTED; i++)
    if (strcmp(blind_fitted_of[i].name, blind_values[value].name) == 0)
      return 1;
  return 0;
}

/* Of a standard deviation, or of a size, over which slopes are taken: so small that what can be told from nothing is
 * not told, and that a positioner hardly ever comes to rest a cycle sooner for it. */
static const double slope_part = 1e-7;

static int value_columns(work *w, lab_error *error)
{
  int i;
  for (i = 0; i < BLIND_VALUES; i++) {
    blind_recorded r = w->r;
    const double by = slope_part * blind_known_to(&r, i);
    double *c = next_column(w);
    blind_value_shift(&r.t.declared, i, blind_values[i].absolute ? by : 1 + by);
    blind_value_shift(&r.t.base, i, blind_values[i].absolute ? by : 1 + by);
    if (differ(w, &r, w->which, slope_part, c, error))
      return error->status;
    if (!is_fitted(i))
      is_known(w, c);
  }
  return LAB_OK;
}

static int vent_column(work *w, lab_error *error)
{
  blind_recorded r = w->r;
  double *c = next_column(w);
  r.t.declared.vent_area *= 1 + slope_part * BLIND_VENT_KNOWN;
  r.t.base.vent_area *= 1 + slope_part * BLIND_VENT_KNOWN;
  if (differ(w, &r, w->which, slope_part, c, error))
    return error->status;
  is_known(w, c);
  return LAB_OK;
}

/* Where a loop has worked before, by the standard deviation of what it leaves. */
static int integral_column(work *w, lab_error *error)
{
  blind_recorded r = w->r;
  double *c;
  if (!(r.has & (1u << BLIND_INTEGRAL)))
    return LAB_OK;
  c = next_column(w);
  r.positioner.integral_start += slope_part * BLIND_INTEGRAL_OPENS / sqrt(3) / r.positioner.gain;
  if (differ(w, &r, w->which, slope_part, c, error))
    return error->status;
  is_known(w, c);
  return LAB_OK;
}

/* Where the stem is held, the set position is known at every row. */
static int instant_columns(work *w, lab_error *error)
{
  const double spread = w->r.spacing / sqrt(12);
  int i;
  for (i = 0; i < w->r.n_moves && w->r.loop == BLIND_OPEN; i++) {
    blind_recorded r = w->r;
    double *c = next_column(w);
    r.move[i].t += slope_part * spread;
    if (differ(w, &r, w->which, slope_part, c, error))
      return error->status;
    is_known(w, c);
  }
  return LAB_OK;
}

/* Effects by a small part of their size; a law that is switched has no slope. */
static int effect_columns(work *w, lab_error *error)
{
  int i;
  for (i = 0; i < w->r.t.n_missing; i++) {
    blind_recorded r = w->r;
    double *c = next_column(w);
    memset(c, 0, w->m * sizeof *c);
    if (r.t.missing[i].effect->lo == r.t.missing[i].effect->hi)
      continue;
    r.t.missing[i].size *= 1 + slope_part;
    if (differ(w, &r, w->which, slope_part, c, error))
      return error->status;
  }
  return LAB_OK;
}

/* One channel's column: what its sensor would add by one standard deviation. */
enum error_of_sensor { ZERO, GAIN, LAG, DRIFT };

static void instrument_column(work *w, size_t at, double span, int error_of, double by)
{
  const double *y = w->y + at;
  double *c = next_column(w);
  size_t i;
  memset(c, 0, w->m * sizeof *c);
  for (i = 0; i < w->rows; i++) {
    const size_t a = i ? i - 1 : 0, b = i + 1 < w->rows ? i + 1 : i;
    const double slope = (y[b] - y[a]) / ((double)(b - a) * w->r.spacing);
    const double one = error_of == ZERO   ? span
                       : error_of == GAIN ? y[i]
                       : error_of == LAG  ? -slope
                                          : span * (double)i / (double)w->rows;
    c[at + i] = by * one / w->over[at + i];
  }
  is_known(w, c);
}

/* The clock between two channels is a lag of one of them of either sign. */
static void instrument_columns(work *w)
{
  const double span[BLIND_SENSORS] = {w->r.t.declared.supply, w->r.t.declared.stroke};
  size_t at = 0;
  int c;
  for (c = 0; c < BLIND_SENSORS; c++) {
    if (!(w->r.t.channels & (1 << c)))
      continue;
    instrument_column(w, at, span[c], ZERO, zero_known);
    instrument_column(w, at, span[c], GAIN, gain_known);
    instrument_column(w, at, span[c], LAG, lag_known);
    instrument_column(w, at, span[c], DRIFT, drift_known);
    if (c == 1)
      instrument_column(w, at, span[c], LAG, clock_known);
    at += w->rows;
  }
}

/* ---- Statistics ---- */

/* Values first, then effects, then the vent. */
static int columns(work *w, lab_error *error)
{
  if (value_columns(w, error) || effect_columns(w, error) || vent_column(w, error) || integral_column(w, error) ||
      instant_columns(w, error))
    return error->status;
  instrument_columns(w);
  return LAB_OK;
}

/* Of w->s, when all but one of the columns have explained what they can.  Out: result */
static int statistic(work *w, int but, double *result, lab_error *error)
{
  const size_t size = (size_t)w->columns * w->m;
  double *column = malloc(size * sizeof *column);
  if (!column)
    return lab_fail_memory(error, "columns");
  memcpy(column, w->column, size * sizeof *column);
  memset(column + (size_t)but * w->m, 0, w->m * sizeof *column);
  *result = blind_projected(column, w->columns, w->s, w->m);
  free(column);
  return LAB_OK;
}

/* By its slope, as an interval is: what is off by more than that changes nothing in how well it is known.
 * In:  off  in what the column is of */
static int slope_statistic(work *w, int column, double off, double *result, lab_error *error)
{
  const double *slope = w->column + (size_t)column * w->m;
  size_t i;
  for (i = 0; i < w->m; i++)
    w->s[i] = i < w->n ? slope[i] * off : 0;
  return statistic(w, column, result, error);
}

static int value_statistic(work *w, int value, double *result, lab_error *error)
{
  const double off = blind_values[value].absolute ? w->r.off[value] : 1 - 1 / w->r.off[value];
  return slope_statistic(w, value, off / blind_known_to(&w->r, value), result, error);
}

/* Its column is behind those of the effects. */
static int vent_statistic(work *w, double *result, lab_error *error)
{
  const double off = 1 - 1 / w->r.vent;
  return slope_statistic(w, BLIND_VALUES + w->r.t.n_missing, off / BLIND_VENT_KNOWN, result, error);
}

/* Of an effect less by `by`.  In: by  its size, or less */
static int effect_statistic(work *w, int effect, double by, double *result, lab_error *error)
{
  blind_recorded r = w->r;
  const int all = fabs(by) > 0.99 * fabs(r.t.missing[effect].size);
  r.t.missing[effect].size -= by;
  if (differ(w, &r, all ? (unsigned)BLIND_ALL & ~(1u << effect) : w->which, -1, w->s, error))
    return error->status;
  return statistic(w, BLIND_VALUES + effect, result, error);
}

/* The statistic at the size of the trial, as if it grew with the square of the size from where it can just be seen: a
 * large effect is not all that its slope says. */
static int effect_at_limit(work *w, int effect, double *result, lab_error *error)
{
  const blind_missing *m = &w->r.t.missing[effect];
  const int rounds = m->effect->lo == m->effect->hi ? 1 : 3;
  double by = m->size, here, limit;
  int i;
  for (i = 0; i < rounds; i++) {
    if (effect_statistic(w, effect, by, &here, error))
      return error->status;
    *result = here * m->size * m->size / (by * by);
    limit = fabs(by) * sqrt(BLIND_LIMIT_STATISTIC / here);
    if (limit > 0.7 * fabs(by))
      break;
    by = copysign(limit, m->size);
  }
  return LAB_OK;
}

/* Slopes are smooth: a coarse grid will do, unless an effect needs a fine one. */
static double coarse(const blind_trial *t)
{
  const double usual = 2e-4;
  int i;
  for (i = 0; i < t->n_missing; i++)
    if (t->missing[i].effect->step > 0)
      return 3 * t->step;
  return usual;
}

static int all_statistics(const blind_recorded *r, work *w, blind_visible *v, lab_error *error)
{
  int i, status = respond(w, &w->r, w->which, w->y, error);
  if (status == LAB_OK)
    soil(r, w);
  if (status == LAB_OK)
    status = columns(w, error);
  for (i = 0; i < r->t.n_missing && status == LAB_OK; i++)
    status = effect_at_limit(w, i, &v->effect[i], error);
  for (i = 0; i < BLIND_VALUES && status == LAB_OK; i++)
    status = value_statistic(w, i, &v->value[i], error);
  return status == LAB_OK ? vent_statistic(w, &v->vent, error) : status;
}

int blind_recorded_visible(const blind_recorded *r, blind_visible *v, lab_error *error)
{
  work w = {.r = cleaned(r), .which = BLIND_ALL, .step = coarse(&r->t)};
  int status;
  error->status = LAB_OK;
  memset(v, 0, sizeof *v);
  w.rows = second_samples(r->end, r->spacing);
  w.n = w.rows * strlen(blind_channels_text(r->t.channels));
  w.m = w.n + COLUMNS;
  w.y = calloc((COLUMNS + 3) * w.m, sizeof *w.y);
  if (!w.y)
    return lab_fail_memory(error, "sensitivities");
  w.over = w.y + w.m;
  w.s = w.over + w.m;
  w.column = w.s + w.m;
  status = all_statistics(r, &w, v, error);
  free(w.y);
  return status;
}
