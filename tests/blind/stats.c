#include "stats.h"

#include <math.h>
#include <stdlib.h>

void blind_wilson(blind_count count, double *low, double *high)
{
  const double z = 1.959963984540054, n = count.n, p = count.n ? count.k / n : 0.5;
  const double centre = n * p + z * z / 2, half = z * sqrt(n * p * (1 - p) + z * z / 4);
  *low = count.k == 0 ? 0 : (centre - half) / (n + z * z);
  *high = count.k == count.n ? 1 : (centre + half) / (n + z * z);
}

static int by_value(const void *a, const void *b)
{
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

double blind_quantile(double *value, int n, double q)
{
  double at = q * (n - 1), part = at - floor(at);
  int i = (int)at;
  qsort(value, (size_t)n, sizeof *value, by_value);
  return i + 1 < n ? (1 - part) * value[i] + part * value[i + 1] : value[n - 1];
}

static int by_size(const void *a, const void *b)
{
  return by_value(&((const blind_sized *)a)->size, &((const blind_sized *)b)->size);
}

/* Level of the isotonic fit at trial i, by the min-max formula: the largest over starts up to i of the least mean over
 * ends from i. */
static double level_at(const blind_sized *trial, int n, int i)
{
  double level = 0;
  int a, b;
  for (a = 0; a <= i; a++) {
    double sum = 0, least = 1;
    for (b = a; b < n; b++) {
      sum += trial[b].found;
      if (b >= i)
        least = fmin(least, sum / (b - a + 1));
    }
    level = fmax(level, least);
  }
  return level;
}

double blind_nine_in_ten(blind_sized *trial, int n)
{
  const int few = 3;
  int i;
  qsort(trial, (size_t)n, sizeof *trial, by_size);
  for (i = 0; i + few <= n; i++)
    if (level_at(trial, n, i) >= 0.9)
      return trial[i].size;
  return NAN;
}
