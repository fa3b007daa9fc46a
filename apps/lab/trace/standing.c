#include "standing.h"

#include <math.h>
#include <stdlib.h>

enum { FEWEST = 5, NEAR = 3 }; /* rows of a stretch at least; rows either way that tell whether it falls */

/* What a stretch tells: the size of the leak, and how much it counts. */
typedef struct told {
  double leak, weight;
} told;

static int by_leak(const void *a, const void *b)
{
  const double x = ((const told *)a)->leak, y = ((const told *)b)->leak;
  return (x > y) - (x < y);
}

/* In/out:  of  sorted then */
static double weighted_median(told *of, size_t n)
{
  double all = 0, sum = 0;
  size_t i;
  qsort(of, n, sizeof *of, by_leak);
  for (i = 0; i < n; i++)
    all += of[i].weight;
  for (i = 0; i < n && (sum += of[i].weight) < all / 2; i++)
    ;
  return n ? of[i].leak : 0;
}

/* The rig with a leak of some size, and both orifices shut. */
static lab_rig shut(const lab_rig *rig, int leak, double size)
{
  lab_rig leaks = *rig;
  *pneu_param_at(&leaks.params, pneu_param_find("positioner.gain")) = 0;
  *pneu_param_at(&leaks.params, leak) = (pneu_real)size;
  return leaks;
}

/* Mean of a channel and its slope over time in rows first..end - 1.  Out: spread  sum of squares of the times */
static double slope_of(const double *t, const double *value, size_t first, size_t end, double *mean, double *spread)
{
  double mean_t = 0, product = 0;
  size_t i;
  *mean = *spread = 0;
  for (i = first; i < end; i++) {
    mean_t += t[i] / (double)(end - first);
    *mean += value[i] / (double)(end - first);
  }
  for (i = first; i < end; i++) {
    product += (t[i] - mean_t) * (value[i] - *mean);
    *spread += (t[i] - mean_t) * (t[i] - mean_t);
  }
  return product / *spread;
}

/* What rows first..end - 1 tell; its weight is 0 where they tell nothing. */
static told ask(const lab_rig *rig, int leak, const lab_log *log, size_t first, size_t end)
{
  const pneu_params *p = &rig->params;
  double pressure, position, spread;
  told of = {0, 0};
  const double x_slope =
      slope_of(log->value[LAB_CHANNEL_TIME], log->value[LAB_CHANNEL_X], first, end, &position, &spread);
  const double slope =
      slope_of(log->value[LAB_CHANNEL_TIME], log->value[LAB_CHANNEL_P], first, end, &pressure, &spread);
  const double x = fmin(fmax(position, 0), (double)p->stroke), one = (double)lab_param_info(leak).value;
  const double volume = (double)(p->dead_volume + p->area * p->swept_ratio * (pneu_real)x);
  const double swept = (double)(p->area * p->swept_ratio) * x_slope;
  const double lost = -(slope * volume + (pressure + (double)p->ambient_pressure) * swept) /
                      (double)(p->gas_constant * p->ambient_temperature);
  const lab_rig tight = shut(rig, leak, 0), leaks = shut(rig, leak, one);
  const double without = lab_rig_outflow(&tight, pressure, x);
  const double passes = lab_rig_outflow(&leaks, pressure, x) - without;
  if (passes > 0 && isfinite(lost))
    of = (told){one * (lost - without) / passes, spread};
  return of;
}

/* The mean of the rows behind row i less that of those before it: below zero while the pressure falls. */
static double change_at(const double *p, size_t i)
{
  double sum = 0;
  size_t k;
  for (k = 0; k < NEAR; k++)
    sum += p[i + k] - p[i - 1 - k];
  return sum;
}

/* Whether the pressure falls about row i though the stem is not so far up that the positioner would vent. Far below,
 * where it fills, the pressure rises, but for a moment in which the stem breaks away. */
static int falls_shut(const lab_rig *rig, const lab_log *log, double dead_band, size_t i)
{
  static const double within = 0.5; /* of the dead band, for the noise of the position */
  const double *sp = log->value[LAB_CHANNEL_SP], x = log->value[LAB_CHANNEL_X][i];
  return sp[i] == sp[i - 1] && sp[i] > lab_param_value(rig, pneu_param_find("positioner.cutoff_low")) &&
         x / (double)rig->params.stroke - sp[i] < within * dead_band && change_at(log->value[LAB_CHANNEL_P], i) < 0;
}

/* All stretches.  Returns: how many there are */
static size_t ask_all(const lab_unknowns *u, int leak, double since, told *of)
{
  const lab_run *run = u->run;
  const lab_log *log = run->log;
  const double dead_band = lab_param_value(&u->rig, pneu_param_find("positioner.dead_band"));
  const size_t last = run->first + run->n - NEAR; /* whose rows behind it are too few */
  size_t i, first = run->first + NEAR, n = 0;
  for (i = first; i <= last; i++) {
    if (i < last && falls_shut(&u->rig, log, dead_band, i) &&
        (!isfinite(since) || log->value[LAB_CHANNEL_TIME][i] >= since))
      continue;
    if (i >= first + FEWEST + 2 * NEAR) { /* about its ends an orifice may be open */
      of[n] = ask(&u->rig, leak, log, first + NEAR, i - NEAR);
      n += of[n].weight > 0;
    }
    first = i + 1;
  }
  return n;
}

double lab_standing_leak(const lab_unknowns *u, int leak, double since, double *scatter)
{
  const double *const *value = (const double *const *)u->run->log->value;
  told *of = u->run->n > 2 * NEAR ? malloc(u->run->n * sizeof *of) : NULL;
  double size = 0;
  size_t i, n = 0;
  *scatter = HUGE_VAL;
  if (of && value[LAB_CHANNEL_P] && value[LAB_CHANNEL_X] && u->rig.params.stroke > 0 &&
      lab_param_value(&u->rig, pneu_param_find("positioner.dead_band")) > 0)
    n = ask_all(u, leak, since, of);
  size = of ? fmax(weighted_median(of, n), 0) : 0;
  for (i = 0; i < n; i++)
    of[i].leak = fabs(of[i].leak / size - 1);
  if (size > 0)
    *scatter = weighted_median(of, n);
  free(of);
  return size;
}
