/* Measured channels that drive the model, without most of their noise. */
#include "mend.h"

#include <math.h>
#include <stdlib.h>

#include "../base/format.h"
#include "../base/noise.h"
#include "../base/text.h"

/* Sums over the values before each one, less the first, from which straight lines through any stretch of them are
 * fitted; a short stretch late in a long log is a small difference of large ones. */
typedef struct sums {
  long double n, t, tt, y, ty;
} sums;

/* A straight line through values from to end - 1, as it is at a time. */
typedef struct line {
  size_t from, end;
  double value, slope, deviation; /* deviation of the value; SI */
} line;

/* The values of a run that are there. */
typedef struct series {
  size_t n;
  double *t, *y;    /* n; t from the first row on */
  size_t *row;      /* n: of the run */
  sums *before;     /* n + 1 */
  double sigma;     /* of the noise */
  size_t from, end; /* windows reach no further */
} series;

static sums between(const series *s, size_t from, size_t end)
{
  const sums *a = &s->before[from], *b = &s->before[end];
  const sums d = {b->n - a->n, b->t - a->t, b->tt - a->tt, b->y - a->y, b->ty - a->ty};
  return d;
}

static line line_at(const series *all, size_t from, size_t end, double t)
{
  const sums s = between(all, from, end);
  const long double mean = s.t / s.n;
  const double n = (double)s.n, width = (double)(s.tt - s.t * mean), off = (double)(t - mean);
  line l = {from, end, 0, (double)(s.ty - mean * s.y) / width, all->sigma * sqrt(1 / n + off * off / width)};
  l.value = all->y[0] + (double)(s.y / s.n) + off * l.slope;
  return l;
}

/* The line through a window about value i: some sizes below the widest that agrees with all narrower ones (intersection
 * of confidence intervals, Goldenshluger and Nemirovski 1997; Katkovnik 1999), so that a curve has bent off it by less
 * than it scatters. No line where not even three values agree.
 * In:      back, ahead  whether it reaches to either side */
static line about(const series *s, size_t i, int back, int ahead)
{
  enum { BELOW = 4 };            /* sizes, which takes off half */
  static const double reach = 2; /* deviations of an interval */
  const line alone = {i, i + 1, s->y[i], 0, s->sigma};
  line last[BELOW + 1];
  double low = s->y[i] - reach * s->sigma, high = s->y[i] + reach * s->sigma;
  size_t h;
  int k;
  for (k = 0; k <= BELOW; k++)
    last[k] = alone;
  for (h = back && ahead ? 1 : 2; h < s->n; h += 1 + h / 4) {
    const size_t left = back ? h : 0, right = ahead ? h : 0;
    line l;
    if (left > i - s->from || i + right >= s->end)
      break;
    l = line_at(s, i - left, i + right + 1, s->t[i]);
    low = fmax(low, l.value - reach * l.deviation);
    high = fmin(high, l.value + reach * l.deviation);
    if (!(low <= high))
      break;
    for (k = BELOW; k > 0; k--)
      last[k] = last[k - 1];
    last[0] = l;
  }
  return last[BELOW];
}

/* The best of windows on both sides and on either alone, which end at a bend. */
static double smooth_at(const series *s, size_t i)
{
  static const int side[][2] = {{1, 0}, {0, 1}};
  line best = about(s, i, 1, 1);
  int k;
  for (k = 0; k < 2; k++) {
    const line l = about(s, i, side[k][0], side[k][1]);
    if (l.deviation < best.deviation)
      best = l;
  }
  return best.value;
}

/* How far two lines are apart at a time, in deviations. */
static double apart(const series *s, const line *a, const line *b, double t)
{
  const line x = line_at(s, a->from, a->end, t), y = line_at(s, b->from, b->end, t);
  return fabs(x.value - y.value) / hypot(x.deviation, y.deviation);
}

/* Whether the lines before value i and after the next one meet between the two, and are plainly not the same.
 * Out:     bend  where; nowhere if a value is as good a place */
static int bends_after(const series *s, size_t i, lab_bend *bend)
{
  static const double plainly = 3, beside = 0.05; /* deviations; share of the time between two values */
  const line a = about(s, i, 1, 0), b = about(s, i + 1, 0, 1);
  const double dt = s->t[i + 1] - s->t[i], at = (b.value - b.slope * dt - a.value) / (a.slope - b.slope);
  bend->t = at > beside * dt && at < (1 - beside) * dt ? s->t[i] + at : (double)NAN;
  bend->value = a.value + a.slope * at;
  return a.end - a.from >= 3 && b.end - b.from >= 3 && at >= 0 && at <= dt &&
         fmax(apart(s, &a, &b, s->t[i]), apart(s, &a, &b, s->t[i + 1])) > plainly;
}

static int series_open(size_t room, series *s, lab_error *error)
{
  s->n = s->from = 0;
  s->t = malloc(room * sizeof *s->t);
  s->y = malloc(room * sizeof *s->y);
  s->row = malloc(room * sizeof *s->row);
  s->before = malloc((room + 1) * sizeof *s->before);
  return s->t && s->y && s->row && s->before ? LAB_OK : lab_fail_memory(error, "an input without noise");
}

static void series_close(series *s)
{
  free(s->t);
  free(s->y);
  free(s->row);
  free(s->before);
}

/* In:      t, y  n values, with gaps */
static void series_fill(const double *t, const double *y, size_t n, series *s)
{
  static const sums none = {0, 0, 0, 0, 0};
  size_t i;
  s->before[0] = none;
  for (i = 0; i < n; i++) {
    const double at = t[i] - t[0];
    sums *next = &s->before[s->n + 1];
    if (isnan(y[i]))
      continue;
    s->t[s->n] = at;
    s->row[s->n] = i;
    s->y[s->n] = y[i];
    *next = s->before[s->n++];
    next->n += 1;
    next->t += at;
    next->tt += (long double)at * at;
    next->y += y[i] - s->y[0];
    next->ty += (long double)at * (y[i] - s->y[0]);
  }
}

/* The noise of a channel: as declared, or what the log shows if that is less. Where none is declared only a pressure in
 * many rows that drives a stem shows its own: rows far apart differ by more, and a position that a motor drives, or the
 * pressure beside it, may ripple. */
static int noise_of(const lab_rig *rig, const lab_log *log, size_t run, int channel, double *sigma, lab_error *error)
{
  enum { MANY = 200 };
  const size_t first = log->run[run], n = log->run[run + 1] - first;
  const int is_declared = !isnan(rig->noise[channel]);
  *sigma = 0;
  if (!is_declared && (channel != LAB_CHANNEL_P || rig->input[LAB_CHANNEL_X] || n < MANY))
    return LAB_OK;
  if (lab_noise_estimate(log->value[channel] + first, n, sigma, error))
    return error->status;
  *sigma = isnan(*sigma) ? 0 : is_declared ? fmin(*sigma, rig->noise[channel]) : *sigma;
  return LAB_OK;
}

/* Smooth values from..end - 1. */
static void replace(const series *s, double *y)
{
  size_t i;
  for (i = s->from; i < s->end; i++)
    y[s->row[i]] = smooth_at(s, i);
}

/* In/out:  y     the rows of the run
 * Out:     bend  after these, where neither it nor the next is a gap */
static void smooth_series(series *s, double begin, double *y, lab_bend *bend)
{
  const size_t n = s->n;
  size_t i;
  s->from = 0;
  for (i = 0; i + 1 < n; i++) {
    lab_bend found;
    s->end = n;
    if (!bends_after(s, i, &found))
      continue;
    if (s->row[i + 1] == s->row[i] + 1 && !isnan(found.t))
      bend[s->row[i]] = (lab_bend){begin + found.t, found.value};
    s->end = i + 1;
    replace(s, y);
    s->from = i + 1;
  }
  s->end = n;
  replace(s, y);
}

/* Out:     sigma  0: there is no noise, and the channel stays as it is */
static int smooth(const lab_rig *rig, lab_log *log, size_t run, int channel, double *sigma, lab_error *error)
{
  const size_t first = log->run[run], n = log->run[run + 1] - first;
  const double *t = log->value[LAB_CHANNEL_TIME] + first;
  series s;
  int status = noise_of(rig, log, run, channel, sigma, error);
  if (status != LAB_OK || !(*sigma > 0))
    return status;
  s.sigma = *sigma;
  status = series_open(n, &s, error);
  if (status == LAB_OK) {
    series_fill(t, log->value[channel] + first, n, &s);
    smooth_series(&s, t[0], log->value[channel] + first, log->bend[channel] + first);
  }
  series_close(&s);
  return status;
}

/* Room for the bends of a channel, and none so far. */
static int open_bends(lab_log *log, int channel, lab_error *error)
{
  lab_bend *bend = malloc(log->n * sizeof *bend);
  size_t i;
  if (!bend)
    return lab_fail_memory(error, "an input without noise");
  for (i = 0; i < log->n; i++)
    bend[i].t = bend[i].value = (double)NAN;
  log->bend[channel] = bend;
  return LAB_OK;
}

int lab_log_smooth_inputs(const lab_rig *rig, lab_log *log, lab_limitations *limitations, lab_error *error)
{
  static const int channels[] = {LAB_CHANNEL_P, LAB_CHANNEL_X};
  size_t run, c;
  for (c = 0; c < sizeof channels / sizeof channels[0]; c++) {
    const int channel = channels[c];
    char size[LAB_FORMAT_TEXT];
    double sigma;
    if (!rig->input[channel] || !log->value[channel])
      continue;
    if (open_bends(log, channel, error))
      return error->status;
    for (run = 0; run < log->n_runs; run++) {
      if (smooth(rig, log, run, channel, &sigma, error))
        return error->status;
      log->smoothed[channel] = fmax(log->smoothed[channel], sigma);
    }
    lab_format_brief(log->smoothed[channel], lab_channels[channel].unit, size);
    if (log->smoothed[channel] > 0)
      lab_limitation(
          limitations,
          "%s: channel %s drives the model, without its noise of %s; what that leaves counts as noise of what follows.",
          lab_file_name(log->path), lab_channels[channel].key, size);
  }
  return LAB_OK;
}
