#include "errors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drift.h"

void lab_errors_none(lab_errors *errors)
{
  int c;
  memset(errors, 0, sizeof *errors);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    errors->rmse[c] = errors->in_noise[c] = (double)NAN;
}

/* Sums over one channel of all experiments. */
static void channel_error(const lab_unknowns *u, const double *r, int channel, lab_errors *errors)
{
  double noise2 = 0, unit2 = 0;
  size_t n = 0;
  int e, c;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    for (c = 0; c < x->n_channels; c++) {
      size_t i;
      for (i = 0; x->channel[c] == channel && i < x->n; i++) {
        const double z = r[(size_t)c * x->n + i], weight = x->weight[(size_t)c * x->n + i];
        if (isnan(lab_run_measured(x, c, i)) || weight == 0)
          continue;
        noise2 += pow(z * weight, 2);
        unit2 += z * z * x->sigma[c] * x->sigma[c];
        n++;
      }
    }
    r += x->n * (size_t)x->n_channels;
  }
  if (n == 0)
    return;
  errors->rmse[channel] = sqrt(unit2 / (double)n);
  errors->in_noise[channel] = sqrt(noise2 / (double)n);
  errors->chi2 += noise2;
  errors->n += n;
}

/* Errors from residuals that `of` fills in. */
static int sum_up(const lab_unknowns *u, int (*of)(const lab_unknowns *, double *, lab_error *), lab_errors *errors,
                  lab_error *error)
{
  double *r = malloc((u->n_rows + u->m + 1) * sizeof *r);
  int c, status;
  lab_errors_none(errors);
  if (!r)
    return lab_fail_memory(error, "residuals");
  status = of(u, r, error);
  for (c = 0; status == LAB_OK && c < LAB_CHANNEL_COUNT; c++)
    channel_error(u, r, c, errors);
  free(r);
  return status;
}

int lab_loop_errors(const lab_unknowns *u, lab_errors *errors, lab_error *error)
{
  return sum_up(u, lab_unknowns_errors, errors, error);
}

int lab_errors_without_drift(const lab_unknowns *u, lab_errors *errors, lab_error *error)
{
  return sum_up(u, lab_drift_errors, errors, error);
}
