#include "errors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void clear_errors(lab_errors *errors)
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
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    for (c = 0; c < x->n_channels; c++) {
      size_t i;
      for (i = 0; x->channel[c] == channel && i < x->n; i++) {
        const double z = r[(size_t)c * x->n + i];
        if (isnan(lab_experiment_measured(x, c, i)))
          continue;
        noise2 += z * z;
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

int lab_loop_errors(const lab_unknowns *u, lab_errors *errors, lab_error *error)
{
  double *r = malloc((u->n_rows + 1) * sizeof *r);
  int c, status;
  clear_errors(errors);
  if (!r)
    return lab_fail_memory(error, "residuals");
  status = lab_unknowns_errors(u, r, error);
  for (c = 0; status == LAB_OK && c < LAB_CHANNEL_COUNT; c++)
    channel_error(u, r, c, errors);
  free(r);
  return status;
}
