/* What a model leaves: whether it is white, and whether it is noise, only more of it than was declared. */
#include <math.h>
#include <stdlib.h>

#include "../base/array.h"
#include "unknowns.h"

static const double most = 1.5;  /* times the declared noise: beyond that the declaration means something else */
static const double even = 0.85; /* of the root mean square: noise has its size everywhere, not in bursts */
static const double alike = 1.1; /* times the least: at rest, in slow and in quick motion */
static const double slow = 0.5, quick = 5; /* times the noise, that a prediction changes over 2 REACH rows */
enum { PACES = 3, REACH = 3, FEWEST = 100 };
static const double median_of_size = 0.6744897501960817; /* of a normal value */

/* Residuals of one channel of all experiments, as stretches; gaps, which are 0, as NaN.  Returns: stretches */
static int gather(const lab_unknowns *u, int channel, double *r, lab_stretch *stretch)
{
  int e, c, n = 0;
  size_t i;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++, r += u->run[e].n) {
      if (u->run[e].channel[c] != channel)
        continue;
      for (i = 0; i < u->run[e].n; i++)
        if (r[i] == 0)
          r[i] = (double)NAN;
      stretch[n++] = (lab_stretch){r, u->run[e].n};
    }
  return n;
}

/* Of even size throughout, and no more than can be a mistake in the noise.  In: size  room for all values */
static int is_even(const lab_stretch *stretch, int n, double *size)
{
  double sum = 0, rms;
  size_t i, m = 0;
  int k;
  for (k = 0; k < n; k++)
    for (i = 0; i < stretch[k].n; i++)
      if (!isnan(stretch[k].value[i])) {
        size[m++] = fabs(stretch[k].value[i]);
        sum += stretch[k].value[i] * stretch[k].value[i];
      }
  rms = m > 0 ? sqrt(sum / (double)m) : 0;
  return m > 0 && rms < most && lab_median(size, m) / median_of_size > even * rms;
}

/* What is left of a value, over the noise: a row whose time is uncertain counts for less where it moves. Of noise that
 * is whitened nothing is told. */
static double left_at(const lab_run *x, int c, const double *r, size_t i)
{
  return r[i] / x->weight[(size_t)c * x->n + i];
}

static double predicted(const lab_run *x, int c, const double *r, size_t i)
{
  return lab_run_measured(x, c, i) / x->sigma[c] - left_at(x, c, r, i);
}

/* Squares of what is left of one channel of a run, at rest, in slow and in quick motion.  In/out: sum, n  of each */
static void add_rows(const lab_run *x, int c, const double *r, double sum[PACES], size_t n[PACES])
{
  size_t i;
  for (i = REACH; i + REACH < x->n; i++) {
    const double change = fabs(predicted(x, c, r, i + REACH) - predicted(x, c, r, i - REACH));
    const double left = left_at(x, c, r, i);
    const int pace = (change > slow) + (change > quick);
    if (isnan(change + left))
      continue;
    sum[pace] += left * left;
    n[pace]++;
  }
}

/* See lab_residual_stats.  In: r  of all channels, with gaps as NaN */
static int is_steady(const lab_unknowns *u, int channel, const double *r)
{
  double sum[PACES] = {0}, all = 0, least = HUGE_VAL, largest = 0;
  size_t n[PACES] = {0}, rows = 0;
  int e, c, k, paces = 0;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++, r += u->run[e].n)
      if (u->run[e].channel[c] == channel && u->run[e].colour[c].memory != 0)
        return 0;
      else if (u->run[e].channel[c] == channel)
        add_rows(&u->run[e], c, r, sum, n);
  for (k = 0; k < PACES; k++) {
    all += sum[k];
    rows += n[k];
    if (n[k] < FEWEST)
      continue;
    least = fmin(least, sum[k] / (double)n[k]);
    largest = fmax(largest, sum[k] / (double)n[k]);
    paces++;
  }
  return n[0] >= FEWEST && paces > 1 && all < most * most * (double)rows && largest < alike * alike * least;
}

static void look(const lab_unknowns *u, double *r, double *size, lab_stretch *stretch,
                 lab_residual_stats left[LAB_CHANNEL_COUNT])
{
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const int n = gather(u, c, r, stretch);
    lab_whiteness_test(stretch, n, &left[c].whiteness);
    left[c].even = is_even(stretch, n, size);
    left[c].steady = is_steady(u, c, r);
  }
}

int lab_unknowns_residual_stats(const lab_unknowns *u, lab_residual_stats left[LAB_CHANNEL_COUNT], lab_error *error)
{
  double *r = malloc((u->m + 1) * sizeof *r), *size = malloc((u->n_rows + 1) * sizeof *size);
  lab_stretch *stretch = malloc((size_t)(u->n_runs + 1) * sizeof *stretch);
  int status = r && size && stretch ? LAB_OK : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    status = lab_unknowns_residuals((void *)u, NULL, r, error);
  if (status == LAB_OK)
    look(u, r, size, stretch, left);
  free(r);
  free(size);
  free(stretch);
  return status;
}

int lab_residual_stats_coloured(const lab_residual_stats left[LAB_CHANNEL_COUNT])
{
  int c, n = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    n += lab_is_coloured(&left[c].whiteness);
  return n;
}

int lab_residual_stats_white(const lab_residual_stats left[LAB_CHANNEL_COUNT])
{
  int c, white = 1;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    white = white && (left[c].whiteness.n == 0 || lab_is_white(&left[c].whiteness));
  return white;
}

static int is_noise(const lab_residual_stats *left)
{
  return left->whiteness.n == 0 || (left->even && lab_is_white(&left->whiteness));
}

int lab_residual_stats_noise(const lab_residual_stats left[LAB_CHANNEL_COUNT])
{
  int c, noise = 1;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    noise = noise && is_noise(&left[c]);
  return noise;
}

int lab_residual_stats_of_sensors(const lab_residual_stats left[LAB_CHANNEL_COUNT])
{
  int c, all = 1;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    all = all && (is_noise(&left[c]) || left[c].steady);
  return all;
}
