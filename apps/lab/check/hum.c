#include "mend.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/format.h"
#include "../base/text.h"

enum { ROWS_FEWEST = 512, HARMONICS = 3, NEIGHBOURS = 16 };

static const double two_pi = 6.283185307179586;
static const double clear = 40;   /* times what its neighbours explain: a line that stands out */
static const double apart = 0.01; /* of the frequency: from neighbour to neighbour */
static const double clipped = 5;  /* median sizes, to which a second difference is cut: strokes do not count */
static const double steady = 0.3; /* of the amplitude: both halves of a run have it alike */
static const double visible =
    0.12;                         /* of the median of these, of white noise a fifth, or a twelfth: less does no harm */
static const double white = 1.65; /* median second difference of white noise, over its deviation */
static const double weak = 1.5;   /* deviations of the noise: in values a stronger wave may be the rig's */
static const double grid = 3e-3;  /* of its frequency, by which the mains and a logger's clock may be off */
static const double slowest = 20; /* rows a second: of fewer, most frequencies are what the mains would look like */
static const double mains[] = {50, 60};                       /* Hz */
static const double lowest = 1.0 / 16;                        /* periods a row: what is slower may be the rig's */
static const double slowest_left = 8, lowest_left = 1.0 / 50; /* of what a model leaves, in which strokes are small */

/* Rows of a run: times, and values of a channel, or second differences, in which what is slow is small; NaN at a gap.
 */
typedef struct rows {
  const double *t, *d;
  size_t n;
  size_t order; /* 2: second differences; 0: values */
} rows;

/* a cos(2 pi f t) + b sin(2 pi f t) */
typedef struct wave {
  double f, a, b;
  double explained; /* of the squares of `rows.d` */
} wave;

static void differentiate(const double *y, size_t n, size_t order, double *d)
{
  size_t i;
  if (order == 0) {
    memcpy(d, y, n * sizeof *d);
    return;
  }
  d[0] = d[n - 1] = (double)NAN;
  for (i = 1; i + 1 < n; i++)
    d[i] = y[i + 1] - 2 * y[i] + y[i - 1];
}

/* The same, cut where a stroke begins or ends.  Returns: their median size, 0 if there are none */
static double sharpen(const double *y, size_t n, size_t order, double *d, double *size)
{
  double usual;
  size_t i, m = 0;
  differentiate(y, n, order, d);
  for (i = 0; i < n; i++)
    if (!isnan(d[i]))
      size[m++] = fabs(d[i]);
  usual = m > 0 ? lab_median(size, m) : 0;
  for (i = 0; i < n; i++)
    if (fabs(d[i]) > clipped * usual)
      d[i] = copysign(clipped * usual, d[i]);
  return usual;
}

/* The wave of a frequency [Hz] in n rows from a row on, by least squares: rows need not be even. */
static wave fit_wave(const rows *r, size_t from, size_t n, double f)
{
  static const double ridge = 1e-9; /* where every row is at the same phase, one of the two is not seen */
  double c[3] = {0}, s[3] = {0}, cc = 0, ss = 0, cs = 0, cd = 0, sd = 0, det;
  wave v = {f, 0, 0, 0};
  size_t i;
  for (i = 0; i < n; i++) {
    const double angle = two_pi * f * r->t[from + i];
    double x, y;
    c[0] = c[1], c[1] = c[2], c[2] = cos(angle);
    s[0] = s[1], s[1] = s[2], s[2] = sin(angle);
    if (i < r->order || isnan(r->d[from + i - r->order / 2]))
      continue;
    x = r->order ? c[2] - 2 * c[1] + c[0] : c[2];
    y = r->order ? s[2] - 2 * s[1] + s[0] : s[2];
    cc += x * x;
    ss += y * y;
    cs += x * y;
    cd += x * r->d[from + i - r->order / 2];
    sd += y * r->d[from + i - r->order / 2];
  }
  cc += ridge * (cc + ss);
  ss += ridge * (cc + ss);
  det = cc * ss - cs * cs;
  if (det > 0) {
    v.a = (ss * cd - cs * sd) / det;
    v.b = (cc * sd - cs * cd) / det;
    v.explained = v.a * cd + v.b * sd;
  }
  return v;
}

/* The best wave within `width` of a frequency in the first n rows. */
static wave strongest(const rows *r, size_t n, double f, double width)
{
  const double step = 1 / (16 * (r->t[n - 1] - r->t[0]));
  wave best = fit_wave(r, 0, n, f);
  double at;
  for (at = f - width; at <= f + width; at += step) {
    const wave v = fit_wave(r, 0, n, at);
    best = v.explained > best.explained ? v : best;
  }
  return best;
}

/* The best wave near a frequency in all rows: the more rows, the narrower is the line. */
static wave tune(const rows *r, double f)
{
  double width = grid * f;
  size_t m = ROWS_FEWEST;
  for (; m < r->n; m *= 2) {
    f = strongest(r, m, f, width).f;
    width = 1 / (4 * (r->t[m - 1] - r->t[0]));
  }
  return strongest(r, r->n, f, width);
}

static int stands_out(const rows *r, const wave *v)
{
  double beside[NEIGHBOURS];
  int k;
  for (k = 0; k < NEIGHBOURS; k++)
    beside[k] =
        fit_wave(r, 0, r->n, v->f * (1 + apart * (k < NEIGHBOURS / 2 ? k - NEIGHBOURS / 2 : k + 1 - NEIGHBOURS / 2)))
            .explained;
  return v->explained > clear * lab_median(beside, NEIGHBOURS);
}

/* Whether both halves of a run have it, in the same phase. */
static int is_steady(const rows *r, const wave *v)
{
  const size_t half = r->n / 2;
  const wave first = fit_wave(r, 0, half, v->f), last = fit_wave(r, half, r->n - half, v->f);
  return hypot(first.a - last.a, first.b - last.b) < 2 * steady * hypot(v->a, v->b);
}

/* Whether the command has a line there too, by what noise would have: a set position that goes up in steps. What
 * follows it is no hum.  In: d  room for a run */
static int is_commanded(const double *u, const rows *r, double f, double *d)
{
  const rows commanded = {r->t, d, r->n, 2};
  double sum = 0;
  size_t i;
  differentiate(u, r->n, 2, d);
  for (i = 0; i < r->n; i++)
    sum += isnan(d[i]) ? 0 : d[i] * d[i];
  return fit_wave(&commanded, 0, r->n, f).explained > clear * 2 * sum / (double)r->n;
}

/* What sampling at a rate [1/s] makes of a frequency [Hz]. */
static double sampled(double f, double rate)
{
  return fabs(f - rate * floor(f / rate + 0.5));
}

int lab_may_be_hum(double f, double rate)
{
  int i, any = 0;
  for (i = 0; i < 2; i++) {
    const double seen = sampled(mains[i], rate), off = grid * mains[i];
    any |= rate > slowest && seen > off && fabs(f - seen) < off;
  }
  return any;
}

/* One line off one channel of a run, of which u is the command, or NULL.  Returns: it; a and b are 0 if there is none
 */
static wave remove_line(const double *t, double *y, const double *u, size_t n, double f, size_t order, double *room)
{
  static const wave none = {0, 0, 0, 0};
  double *d = room;
  const double most = order ? HUGE_VAL : weak / white * sharpen(y, n, 2, d, room + n);
  const double usual = sharpen(y, n, order, d, room + n);
  const rows r = {t, d, n, order};
  wave v;
  size_t i;
  if (!(usual > 0))
    return none;
  v = tune(&r, f);
  if (!(hypot(v.a, v.b) > visible * usual && hypot(v.a, v.b) < most) || !stands_out(&r, &v) || !is_steady(&r, &v) ||
      (u && is_commanded(u, &r, v.f, room + n)))
    return none;
  for (i = 0; i < n; i++)
    y[i] -= v.a * cos(two_pi * v.f * t[i]) + v.b * sin(two_pi * v.f * t[i]);
  return v;
}

/* Every line off n rows of a channel from `first` on.
 * In:      slow   periods a row that tell a line from what the rig does
 *          order  as of rows
 * In/out:  y     those rows, or what is left of them
 * Returns: how many lines */
static int remove_from(lab_log *log, size_t first, size_t n, int channel, double slow, size_t order, double *y,
                       double *room, double rate)
{
  const int command = lab_log_command(log);
  const double *u = command < 0 ? NULL : log->value[command] + first;
  int i, k, lines = 0;
  for (i = 0; i < 2; i++)
    for (k = 1; k <= (order ? HARMONICS : 1); k++) {
      const double f = k * mains[i];
      wave v = {0, 0, 0, 0};
      if (sampled(f, rate) > slow * rate)
        v = remove_line(log->value[LAB_CHANNEL_TIME] + first, y, u, n, f, order, room);
      lines += v.a != 0 || v.b != 0;
      if (!(hypot(v.a, v.b) > log->hum[channel].amplitude))
        continue;
      log->hum[channel].amplitude = hypot(v.a, v.b);
      log->hum[channel].frequency = v.f;
    }
  return lines;
}

static void say(const lab_log *log, int channel, lab_limitations *limitations)
{
  char amplitude[LAB_FORMAT_TEXT], frequency[LAB_FORMAT_TEXT];
  lab_limitation(limitations, "%s: %s hums, %s at %s Hz; that was taken off.", lab_file_name(log->path),
                 lab_channels[channel].key,
                 lab_format_brief(log->hum[channel].amplitude, lab_channels[channel].unit, amplitude),
                 lab_format_number(log->hum[channel].frequency, 3, frequency));
}

/* Rows a second, but for those that are missing. */
static double rate_of(const double *t, size_t n, double *room)
{
  size_t i;
  for (i = 0; i + 1 < n; i++)
    room[i] = t[i + 1] - t[i];
  return 1 / lab_median(room, n - 1);
}

int lab_log_remove_hum(lab_log *log, lab_limitations *limitations, lab_error *error)
{
  static const int channels[] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_T, LAB_CHANNEL_FORCE};
  double *room = malloc((2 * log->n + 1) * sizeof *room);
  size_t run, k;
  if (!room)
    return lab_fail_memory(error, log->path);
  for (k = 0; k < sizeof channels / sizeof *channels; k++) {
    const int c = channels[k];
    for (run = 0; run < log->n_runs && log->value[c]; run++) {
      const size_t first = log->run[run], n = log->run[run + 1] - first;
      const double rate = n >= ROWS_FEWEST ? rate_of(log->value[LAB_CHANNEL_TIME] + first, n, room) : 0;
      if (rate > slowest)
        remove_from(log, first, n, c, lowest, 2, log->value[c] + first, room, rate);
    }
    if (log->hum[c].amplitude > 0)
      say(log, c, limitations);
  }
  free(room);
  return LAB_OK;
}

int lab_log_remove_hum_left(lab_log *log, size_t first, size_t n, int channel, const double *left, int *lines,
                            lab_limitations *limitations, lab_error *error)
{
  double *y = malloc((3 * n + 1) * sizeof *y), *value = log->value[channel] + first;
  double rate;
  size_t i;
  int order;
  *lines = 0;
  if (!y)
    return lab_fail_memory(error, log->path);
  rate = n >= ROWS_FEWEST ? rate_of(log->value[LAB_CHANNEL_TIME] + first, n, y) : 0;
  memcpy(y, left, n * sizeof *y);
  for (order = 2; rate > slowest_left && order >= 0; order -= 2)
    *lines += remove_from(log, first, n, channel, lowest_left, (size_t)order, y, y + n, rate);
  for (i = 0; i < n; i++)
    value[i] += y[i] - left[i];
  if (*lines > 0)
    say(log, channel, limitations);
  free(y);
  return LAB_OK;
}
