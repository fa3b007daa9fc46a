#include "mend.h"

#include <math.h>
#include <stdlib.h>

#include "../base/array.h"
#include "../base/format.h"
#include "../base/text.h"

enum { BLOCK = 128, LOWEST = BLOCK / 16, LINES = BLOCK / 2 + 1, BLOCKS_FEWEST = 4, HARMONICS = 3 };

static const double two_pi = 6.283185307179586;
static const double uneven = 0.02;  /* of the distance of rows */
static const double clear = 10;     /* times the median of all lines: power of one that stands out */
static const double clipped = 5;    /* median sizes, to which a second difference is cut: strokes do not count */
static const double steady = 0.3;   /* of the amplitude: both halves of a run have it alike */
static const double visible = 0.25; /* of the scatter from row to row: a smaller amplitude does no harm */

static const double grid = 3e-3;  /* of its frequency, by which the mains and a logger's clock may be off */
static const double slowest = 20; /* rows a second: of fewer, most frequencies are what the mains would look like */

/* a cos(w i) + b sin(w i) in row i */
typedef struct wave {
  double w, a, b;
} wave;

/* Second differences, in which what is slow is small, cut where a stroke begins or ends; 0 beside a gap.
 * Returns: their median size, 0 if there are too few */
static double sharpen(const double *y, size_t n, double *d, double *size)
{
  double usual;
  size_t i, m = 0;
  d[0] = d[n - 1] = 0;
  for (i = 1; i + 1 < n; i++) {
    d[i] = y[i + 1] - 2 * y[i] + y[i - 1];
    if (isnan(d[i]))
      d[i] = 0;
    else
      size[m++] = fabs(d[i]);
  }
  usual = m > 0 ? lab_median(size, m) : 0;
  for (i = 0; i < n; i++)
    d[i] = fmin(fmax(d[i], -clipped * usual), clipped * usual);
  return usual;
}

/* Amplitudes of a frequency [rad a row] in n rows, by a turn that goes on from row to row. */
static wave correlate(const double *d, size_t n, double w)
{
  const double c = cos(w), s = sin(w);
  wave v = {w, 0, 0};
  double x = 1, y = 0, scale = w < 0.5 * two_pi ? 2 : 1;
  size_t i;
  for (i = 0; i < n; i++) {
    const double turned = c * x - s * y;
    v.a += d[i] * x;
    v.b += d[i] * y;
    y = s * x + c * y;
    x = turned;
  }
  v.a *= scale / (double)n;
  v.b *= scale / (double)n;
  return v;
}

static double power(wave v)
{
  return v.a * v.a + v.b * v.b;
}

/* What a second difference makes of a swing, by size. */
static double sharpened(double w)
{
  return 4 * sin(w / 2) * sin(w / 2);
}

/* Power of a line as the median over the blocks of a run.  In: room for a value a block */
static double usual_power(const double *d, size_t blocks, int k, double *each)
{
  const double w = two_pi * k / BLOCK;
  size_t b;
  for (b = 0; b < blocks; b++)
    each[b] = power(correlate(d + b * BLOCK, BLOCK, w)) / (sharpened(w) * sharpened(w));
  return lab_median(each, blocks);
}

/* The line that stands out of all.  Returns: its frequency [rad a row], 0 if there is none */
static double line_of(const double *d, size_t n, double *each)
{
  const size_t blocks = n / BLOCK;
  double height[LINES], sorted[LINES];
  int k, best = LOWEST;
  for (k = LOWEST; k < LINES; k++) {
    height[k] = sorted[k - LOWEST] = usual_power(d, blocks, k, each);
    if (height[k] > height[best])
      best = k;
  }
  return height[best] > clear * lab_median(sorted, LINES - LOWEST) ? two_pi * best / BLOCK : 0;
}

/* The frequency within `width` of w that has the most power. */
static double strongest(const double *d, size_t n, double w, double width, double step)
{
  double best = 0, at, found = w;
  for (at = w - width; at <= w + width && at <= 0.5 * two_pi; at += step) {
    const double now = power(correlate(d, n, at));
    if (now > best) {
      best = now;
      found = at;
    }
  }
  return found;
}

/* The frequency near w that has the most power in all rows together: the more rows, the narrower is the line. */
static wave tune(const double *d, size_t n, double w)
{
  double width = two_pi / BLOCK;
  size_t m = BLOCKS_FEWEST * BLOCK;
  for (; m < n; m *= 2) {
    w = strongest(d, m, w, width, two_pi / (16 * (double)m));
    width = two_pi / (4 * (double)m);
  }
  return correlate(d, n, strongest(d, n, w, width, two_pi / (16 * (double)n)));
}

/* Whether both halves of a run have it, in the same phase. */
static int is_steady(const double *d, size_t n, wave v)
{
  const size_t half = n / 2;
  const wave first = correlate(d, half, v.w);
  const double c = first.a - v.a, s = first.b - v.b;
  return c * c + s * s < steady * steady * power(v);
}

/* Whether the command has a line there too, by what noise would have: a set position that goes up in steps. What
 * follows it is no hum. */
static int is_commanded(const double *u, size_t n, double w, double *d)
{
  double sum = 0;
  size_t i;
  d[0] = d[n - 1] = 0;
  for (i = 1; i + 1 < n; i++) {
    d[i] = u[i + 1] - 2 * u[i] + u[i - 1];
    sum += d[i] * d[i];
  }
  return power(correlate(d, n, w)) > clear * 4 * sum / ((double)n * (double)n);
}

/* Whether rows that come at a rate [1/s] show the mains, or an harmonic, as a line at w [rad a row]. */
static int is_of_mains(double w, double rate)
{
  static const double mains[] = {50, 60};
  int i, k, any = 0;
  for (i = 0; i < 2; i++)
    for (k = 1; k <= HARMONICS; k++) {
      const double f = k * mains[i], seen = fabs(f - rate * floor(f / rate + 0.5));
      any |= fabs(seen - w / two_pi * rate) < grid * f;
    }
  return any;
}

/* One line off one channel of a run, of which u is the command, or NULL.  Returns: its amplitude; 0 if there is none.
 * Out: w */
static double remove_line(double *y, const double *u, size_t n, double rate, double *room, double *w)
{
  double *d = room, *each = room + n, usual = sharpen(y, n, d, each), size;
  wave v;
  size_t i;
  if (!(usual > 0) || !((*w = line_of(d, n, each)) > 0))
    return 0;
  v = tune(d, n, *w);
  size = sqrt(power(v)) / sharpened(v.w);
  if (!is_of_mains(v.w, rate) || !is_steady(d, n, v) || !(sqrt(power(v)) > visible * usual) ||
      (u && is_commanded(u, n, v.w, each)))
    return 0;
  for (i = 0; i < n; i++)
    y[i] += (v.a * cos(v.w * (double)i) + v.b * sin(v.w * (double)i)) / sharpened(v.w);
  *w = v.w;
  return size;
}

/* Rows at equal distances, and not too few a second. */
static int is_even(const double *t, size_t n)
{
  const double step = (t[n - 1] - t[0]) / (double)(n - 1);
  size_t i;
  for (i = 1; i < n; i++)
    if (fabs(t[i] - t[i - 1] - step) > uneven * step)
      return 0;
  return step * slowest < 1;
}

static void remove_from(lab_log *log, size_t run, int channel, double *room)
{
  const size_t first = log->run[run], n = log->run[run + 1] - first;
  const double *t = log->value[LAB_CHANNEL_TIME] + first;
  const int command = lab_log_command(log);
  const double *u = command < 0 ? NULL : log->value[command] + first;
  const double rate = (double)(n - 1) / (t[n - 1] - t[0]);
  int k;
  for (k = 0; k < HARMONICS; k++) {
    double w = 0;
    const double size = remove_line(log->value[channel] + first, u, n, rate, room, &w);
    if (!(size > log->hum[channel].amplitude))
      continue;
    log->hum[channel].amplitude = size;
    log->hum[channel].frequency = w / two_pi * rate;
  }
}

static void say(const lab_log *log, int channel, lab_limitations *limitations)
{
  char amplitude[LAB_FORMAT_TEXT], frequency[LAB_FORMAT_TEXT];
  lab_limitation(limitations, "%s: %s hums, %s at %s Hz; that was taken off.", lab_file_name(log->path),
                 lab_channels[channel].key,
                 lab_format_brief(log->hum[channel].amplitude, lab_channels[channel].unit, amplitude),
                 lab_format_number(log->hum[channel].frequency, 3, frequency));
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
      if (n >= BLOCKS_FEWEST * BLOCK && is_even(log->value[LAB_CHANNEL_TIME] + first, n))
        remove_from(log, run, c, room);
    }
    if (log->hum[c].amplitude > 0)
      say(log, c, limitations);
  }
  free(room);
  return LAB_OK;
}
