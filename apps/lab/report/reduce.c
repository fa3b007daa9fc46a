#include "reduce.h"

#include <math.h>

/* A line is drawn over a gap that is no wider than this share of the axis, or than so many times what is usual between
 * two values: a channel that is measured now and then is no row of gaps. */
static const double widest_gap = 0.02, usual_gaps = 4;

/* A column in the making: rows of its lowest and highest value. */
typedef struct column {
  int index; /* -1: none yet */
  size_t low, high, last;
} column;

static size_t put_column(const column *c, const double *at, const double *value, lab_point *point)
{
  const size_t first = c->low < c->high ? c->low : c->high, second = c->low < c->high ? c->high : c->low;
  point[0] = (lab_point){at[first], value[first], first};
  if (first == second)
    return 1;
  point[1] = (lab_point){at[second], value[second], second};
  return 2;
}

static int column_of(double at, double from, double to, int columns)
{
  const int index = to > from ? (int)floor((at - from) / (to - from) * columns) : 0;
  return index < 0 ? 0 : index < columns ? index : columns - 1;
}

/* The widest gap over which the line of a series is drawn. */
static double widest(const lab_line *line, double from, double to)
{
  size_t i, values = 0;
  for (i = 0; i < line->n; i++)
    values += !isnan(line->value[i]);
  return (to - from) * fmax(widest_gap, values > 1 ? usual_gaps / (double)(values - 1) : 0);
}

size_t lab_envelope(const lab_line *line, int columns, lab_point *point)
{
  const double *at = line->at, *value = line->value, from = at[0], to = at[line->n - 1];
  const double too_wide = widest(line, from, to);
  column c = {-1, 0, 0, 0};
  size_t i, used = 0;
  int run = 0;
  for (i = 0; i < line->n; i++) {
    int index, breaks = 0;
    for (; run < line->n_runs && line->first[run] <= i; run++)
      breaks = 1;
    if (breaks && c.index >= 0) {
      used += put_column(&c, at, value, point + used);
      point[used++] = (lab_point){at[c.last], (double)NAN, c.last};
      c.index = -1;
    }
    if (isnan(value[i]))
      continue;
    index = column_of(at[i], from, to, columns);
    if (c.index >= 0 && index != c.index) {
      used += put_column(&c, at, value, point + used);
      if (i > c.last + 1 && at[i] - at[c.last] > too_wide)
        point[used++] = (lab_point){at[c.last], (double)NAN, c.last};
    }
    if (index != c.index)
      c = (column){index, i, i, i};
    c.low = value[i] < value[c.low] ? i : c.low;
    c.high = value[i] > value[c.high] ? i : c.high;
    c.last = i;
  }
  return c.index >= 0 ? used + put_column(&c, at, value, point + used) : used;
}

void lab_bin_means(const double *at, const double *value, size_t n, double from, double to, int n_bins, lab_bin *bin)
{
  size_t i;
  int b;
  for (b = 0; b < n_bins; b++)
    bin[b] = (lab_bin){0, 0};
  for (i = 0; i < n; i++)
    if (!isnan(at[i]) && !isnan(value[i])) {
      lab_bin *mine = &bin[column_of(at[i], from, to, n_bins)];
      mine->mean += value[i];
      mine->n++;
    }
  for (b = 0; b < n_bins; b++)
    bin[b].mean = bin[b].n ? bin[b].mean / (double)bin[b].n : (double)NAN;
}
