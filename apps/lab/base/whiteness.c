#include "whiteness.h"

#include <math.h>
#include <string.h>

#include "quantile.h"

static const double level = 0.01; /* p-value */

/* Sum of products of values `lag` rows apart.  Out: pairs */
static double products(const lab_stretch *stretch, int n_stretches, size_t lag, size_t *pairs)
{
  double sum = 0;
  int s;
  *pairs = 0;
  for (s = 0; s < n_stretches; s++) {
    const double *r = stretch[s].value;
    size_t i;
    for (i = 0; i + lag < stretch[s].n; i++)
      if (!isnan(r[i]) && !isnan(r[i + lag])) {
        sum += r[i] * r[i + lag];
        ++*pairs;
      }
  }
  return sum;
}

static int lags_for(size_t n)
{
  const double usual = n > 0 ? floor(10 * log10((double)n)) : 0;
  return (int)fmin(fmin(usual, floor((double)n / 4)), LAB_WHITENESS_LAGS);
}

void lab_whiteness_test(const lab_stretch *stretch, int n_stretches, lab_whiteness *w)
{
  double total, scale;
  int k;
  memset(w, 0, sizeof *w);
  w->statistic = w->p_value = (double)NAN;
  total = products(stretch, n_stretches, 0, &w->n);
  if (!(total > 0))
    return;
  w->lags = lags_for(w->n);
  w->correlation[0] = 1;
  scale = (double)w->n * ((double)w->n + 2);
  for (k = 1; k <= w->lags; k++) {
    size_t pairs;
    w->correlation[k] = products(stretch, n_stretches, (size_t)k, &pairs) / total;
    w->deviation[k] = sqrt((double)pairs / scale);
    w->degrees += pairs > 0;
  }
  if (w->degrees == 0)
    return;
  w->statistic = 0;
  for (k = 1; k <= w->lags; k++)
    if (w->deviation[k] > 0)
      w->statistic += pow(w->correlation[k] / w->deviation[k], 2);
  w->p_value = lab_chi2_tail(w->statistic, w->degrees);
}

int lab_is_white(const lab_whiteness *w)
{
  return w->p_value >= level;
}

int lab_is_coloured(const lab_whiteness *w)
{
  return w->p_value < level;
}
