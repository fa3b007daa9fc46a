#include "noise.h"

#include <math.h>
#include <stdlib.h>

#include "array.h"

/* Second difference of white noise has 6 times its variance; the median of |z| is 0.6745 for a normal z. */
static const double second_difference = 2.449489742783178;
static const double median_of_size = 0.6744897501960817;
enum { FEWEST = 8 };

double lab_smallest_step(const double *value, size_t n)
{
  double step = HUGE_VAL;
  size_t i;
  for (i = 1; i < n; i++) {
    const double d = fabs(value[i] - value[i - 1]);
    if (d > 0 && d < step)
      step = d;
  }
  return isfinite(step) ? step : 0;
}

double lab_resolution(const double *value, size_t n)
{
  static const double off = 0.1, most = 1000, nearly_all = 0.95; /* of a step; steps; of the differences */
  const double step = lab_smallest_step(value, n);
  double whole = 0, all = 0;
  size_t i;
  for (i = 1; i < n && step > 0; i++) {
    const double d = fabs(value[i] - value[i - 1]) / step;
    if (!(d > 0 && d < most))
      continue;
    all++;
    whole += fabs(d - nearbyint(d)) < off;
  }
  return all >= FEWEST && whole >= nearly_all * all ? step : 0;
}

/* Median of sizes, which come in whole steps: those of one step lie evenly between half a step less and half a step
 * more.  In: step  0: in none */
static double median_in_steps(double *size, size_t n, double step)
{
  const double middle = lab_median(size, n), low = fmax(middle - 0.5 * step, 0), high = middle + 0.5 * step;
  size_t i, below = 0, within = 0;
  for (i = 0; i < n && step > 0; i++) {
    below += size[i] < low;
    within += size[i] >= low && size[i] < high;
  }
  return within > 0 ? low + (high - low) * (0.5 * (double)n - (double)below) / (double)within : middle;
}

int lab_noise_estimate(const double *value, size_t n, double *noise, lab_error *error)
{
  double *size = malloc((n ? n : 1) * sizeof *size);
  size_t i, m = 0;
  if (!size)
    return lab_fail_memory(error, "the noise of a channel");
  *noise = (double)NAN;
  for (i = 2; i < n; i++) {
    const double d = value[i] - 2 * value[i - 1] + value[i - 2];
    if (!isnan(d))
      size[m++] = fabs(d);
  }
  if (m >= FEWEST)
    *noise = fmax(median_in_steps(size, m, lab_resolution(value, n)) / (second_difference * median_of_size),
                  lab_smallest_step(value, n) / 4);
  free(size);
  return LAB_OK;
}
