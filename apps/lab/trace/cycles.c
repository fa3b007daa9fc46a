#include "cycles.h"

#include <math.h>
#include <stdlib.h>

#include "../base/array.h"

static const double two_pi = 6.283185307179586;
static const double clear = 3; /* times its surroundings: a line that stands out less is no cycle */
enum { CELLS = 2048, FEWEST_CYCLES = 3, ROWS_PER_CYCLE = 8, OVERSAMPLED = 4, AROUND = 48 };

/* Lines at equal distances in frequency, f = (first + i) step. */
typedef struct spectrum {
  size_t n, first;
  double step;
  double *power;  /* of one channel */
  double *height; /* of the channel that stands out most */
} spectrum;

static double length_of(const lab_experiment *x)
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  return t[x->n - 1] - t[0];
}

/* Means of the residual over cells of equal duration.  Returns: their number. */
static size_t fill_cells(const lab_experiment *x, const double *r, double cell[CELLS])
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  const size_t n = x->n < CELLS ? x->n : CELLS;
  unsigned count[CELLS] = {0};
  size_t i, k;
  for (k = 0; k < n; k++)
    cell[k] = 0;
  for (i = 0; i < x->n; i++) {
    k = (size_t)((double)n * (t[i] - t[0]) / (t[x->n - 1] - t[0]));
    k = k < n ? k : n - 1;
    cell[k] += r[i];
    count[k]++;
  }
  for (k = 0; k < n; k++)
    cell[k] /= count[k] ? count[k] : 1;
  return n;
}

/* Add the power of one channel of one log. */
static void add_power(const spectrum *s, const lab_experiment *x, const double *r)
{
  double cell[CELLS];
  const size_t n = fill_cells(x, r, cell);
  const double spacing = length_of(x) / (double)n;
  size_t i, k;
  for (i = 0; i < s->n; i++) {
    const double angle = two_pi * (double)(s->first + i) * s->step * spacing, c1 = cos(angle), s1 = sin(angle);
    double c = 1, sine = 0, re = 0, im = 0;
    for (k = 0; k < n; k++) {
      const double next = c * c1 - sine * s1;
      re += cell[k] * c;
      im += cell[k] * sine;
      sine = sine * c1 + c * s1;
      c = next;
    }
    s->power[i] += (re * re + im * im) / (double)n;
  }
}

/* Power over the median of its surroundings. */
static double prominence(const spectrum *s, size_t i)
{
  double around[2 * AROUND + 1];
  const size_t from = i > AROUND ? i - AROUND : 0, to = i + AROUND < s->n ? i + AROUND : s->n - 1;
  size_t k;
  for (k = from; k <= to; k++)
    around[k - from] = s->power[k];
  lab_sort(around, to - from + 1);
  return s->power[i] / (around[(to - from) / 2] + 1);
}

/* Keep the highest peaks, in order. */
static void keep(double period[LAB_CYCLES_MAX], double rank[LAB_CYCLES_MAX], int *n, double candidate, double value)
{
  int i;
  if (*n == LAB_CYCLES_MAX && rank[*n - 1] >= value)
    return;
  for (i = *n < LAB_CYCLES_MAX ? (*n)++ : *n - 1; i > 0 && rank[i - 1] < value; i--) {
    rank[i] = rank[i - 1];
    period[i] = period[i - 1];
  }
  rank[i] = value;
  period[i] = candidate;
}

/* Lines that every log resolves. */
static int lay_out(const lab_unknowns *u, spectrum *s, lab_error *error)
{
  double longest = 0, fastest = INFINITY, last;
  int e;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    const double length = length_of(x), cells = (double)(x->n < CELLS ? x->n : CELLS);
    longest = fmax(longest, length);
    fastest = fmin(fastest, cells / (ROWS_PER_CYCLE * length));
  }
  s->step = 1 / (OVERSAMPLED * longest);
  s->first = (size_t)OVERSAMPLED * FEWEST_CYCLES;
  last = fastest / s->step;
  s->n = last > (double)s->first ? (size_t)last - s->first + 1 : 0;
  s->power = calloc(s->n + 1, sizeof *s->power);
  s->height = calloc(s->n + 1, sizeof *s->height);
  return s->power && s->height ? LAB_OK : lab_fail_memory(error, "the spectrum of a residual");
}

/* See how far the lines of one channel stand out. */
static void look_at_channel(const lab_unknowns *u, const double *r, int channel, spectrum *s)
{
  size_t i;
  int e, c;
  for (i = 0; i < s->n; i++)
    s->power[i] = 0;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    for (c = 0; c < x->n_channels; c++, r += x->n)
      if (x->channel[c] == channel && length_of(x) > 0)
        add_power(s, x, r);
  }
  for (i = 0; i < s->n; i++)
    s->height[i] = fmax(s->height[i], prominence(s, i));
}

int lab_cycles_find(const lab_unknowns *u, const double *r, double *period, int *n, lab_error *error)
{
  double rank[LAB_CYCLES_MAX];
  spectrum s;
  size_t i;
  const int status = lay_out(u, &s, error);
  int channel;
  *n = 0;
  if (status == LAB_OK && s.n > 2) {
    for (channel = 0; channel < LAB_CHANNEL_COUNT; channel++)
      look_at_channel(u, r, channel, &s);
    for (i = 1; i + 1 < s.n; i++)
      if (s.height[i] > clear && s.height[i] > s.height[i - 1] && s.height[i] >= s.height[i + 1])
        keep(period, rank, n, 1 / ((double)(s.first + i) * s.step), s.height[i]);
  }
  free(s.power);
  free(s.height);
  return status;
}
