/* Whether a log sticks and slips where the model does not. */
#include <math.h>
#include <stdlib.h>

#include "../base/noise.h"
#include "windowed.h"
#include "unknowns.h"

/* Of the windows with motion. Of 182 recorded trials one has between 0.14 and 0.32; above are periodic forces, and
 * stems that stick and slip from 0.28. */
static const double rough_share = 0.2;

/* Share of the windows in which pressure or position of an experiment is rougher than what the model predicts.
 * In/out:  r  its errors over noise; then what the model predicts */
static double roughness(const lab_run *x, int by_stem, double *r, size_t window)
{
  double share = 0;
  int c;
  size_t i;
  for (c = 0; c < x->n_channels; c++, r += x->n) {
    const double *measured = x->log->value[x->channel[c]] + x->first;
    if (x->channel[c] == LAB_CHANNEL_T || (by_stem && x->channel[c] != LAB_CHANNEL_X))
      continue;
    for (i = 0; i < x->n; i++)
      r[i] = measured[i] - r[i] * x->sigma[c];
    share = fmax(
        share, lab_windowed_roughness(measured, r, x->n, window, fmax(x->sigma[c], lab_smallest_step(measured, x->n))));
  }
  return share;
}

/* The window of the first experiment that is rough; 0 if none is. */
static size_t rough_window(const lab_unknowns *u, int by_stem, double *r)
{
  enum { WINDOWS = 90, SHORTEST = 30, LONGEST = 200 };
  int e;
  for (e = 0; e < u->n_runs; e++) {
    const lab_run *x = &u->run[e];
    const size_t fair = x->n / WINDOWS, w = fair < SHORTEST ? SHORTEST : fair > LONGEST ? LONGEST : fair;
    if (roughness(x, by_stem, r, w) > rough_share)
      return w;
    r += x->n * (size_t)x->n_channels;
  }
  return 0;
}

int lab_unknowns_sticks_and_slips(const lab_unknowns *u, int by_stem, size_t *window, lab_error *error)
{
  double *errors;
  int status;
  *window = 0;
  if (!(u->rig.params.stroke > 0) || u->rig.laws.position_input)
    return LAB_OK;
  errors = malloc((u->n_rows + 1) * sizeof *errors);
  status = errors ? lab_unknowns_errors(u, errors, error) : lab_fail_memory(error, "residuals");
  if (status == LAB_OK)
    *window = rough_window(u, by_stem, errors);
  free(errors);
  return status == LAB_WORLD ? status : LAB_OK;
}
