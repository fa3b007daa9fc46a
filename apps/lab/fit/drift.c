#include "drift.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/format.h"
#include "../rig/tolerance.h"

/* The tolerance of a channel's drift over a run, SI; 0: it has none. */
static double tolerance_of(const lab_run *x, int c)
{
  const int channel = x->channel[c];
  return channel == LAB_CHANNEL_P   ? lab_tolerance(x->rig, LAB_PRESSURE_DRIFT)
         : channel == LAB_CHANNEL_X ? lab_tolerance(x->rig, LAB_POSITION_DRIFT)
                                    : 0;
}

/* What one tolerance of drift adds to one channel, over the noise; 0 where nothing was measured.
 * Out:     line  x->n values */
static void draw_line(const lab_run *x, int c, double *line)
{
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first, whole = t[x->n - 1] - t[0];
  const double tolerance = tolerance_of(x, c);
  size_t i;
  for (i = 0; i < x->n; i++) {
    const double share = whole > 0 && !isnan(lab_run_measured(x, c, i)) ? (t[i] - t[0]) / whole : 0;
    line[i] = share * tolerance / x->sigma[c];
  }
}

/* One channel: from w to v, of which I - v v' is (I + w w')^(-1/2). */
static void open_channel(const lab_run *x, int c, double *v)
{
  double length2, scale;
  size_t i;
  draw_line(x, c, v);
  lab_run_weigh(x, c, v);
  length2 = lab_dot(v, v, x->n);
  scale = length2 > 0 ? sqrt((1 - 1 / sqrt(1 + length2)) / length2) : 0;
  for (i = 0; i < x->n; i++)
    v[i] *= scale;
}

int lab_drift_open(lab_run *x, lab_error *error)
{
  int c;
  if (!x->drift)
    x->drift = malloc(((size_t)x->n_channels * x->n + 1) * sizeof *x->drift);
  if (!x->drift)
    return lab_fail_memory(error, "a drift");
  for (c = 0; c < x->n_channels; c++)
    open_channel(x, c, x->drift + (size_t)c * x->n);
  return LAB_OK;
}

void lab_drift_take_out(const lab_run *x, double *r)
{
  size_t i, k;
  int c;
  for (c = 0; x->drift && c < x->n_channels; c++) {
    const double *v = x->drift + (size_t)c * x->n, along = lab_dot(v, r + (size_t)c * x->n, x->n);
    for (i = 0, k = (size_t)c * x->n; along != 0 && i < x->n; i++, k++)
      r[k] -= along * v[i];
  }
}

/* Take its most likely line out of one channel.  In/out: r  errors over noise  In: room  for 2 n values */
static void subtract_line(const lab_run *x, int c, double *r, double *room)
{
  double *line = room, *left = room + x->n, drift;
  size_t i;
  draw_line(x, c, line);
  memcpy(left, r, x->n * sizeof *left);
  lab_run_weigh(x, c, line);
  lab_run_weigh(x, c, left);
  drift = lab_dot(line, left, x->n) / (1 + lab_dot(line, line, x->n));
  draw_line(x, c, line);
  for (i = 0; i < x->n; i++)
    r[i] -= drift * line[i];
}

int lab_drift_errors(const lab_unknowns *u, double *r, lab_error *error)
{
  double *room = malloc((2 * u->n_rows + 1) * sizeof *room);
  int e, c, status = room ? lab_unknowns_errors(u, r, error) : lab_fail_memory(error, "a drift");
  for (e = 0; e < u->n_runs && status == LAB_OK; e++)
    for (c = 0; c < u->run[e].n_channels; c++, r += u->run[e].n)
      if (u->run[e].drift)
        subtract_line(&u->run[e], c, r, room);
  free(room);
  return status;
}

/* Drift of a channel in tolerances, from a residual without it.  Out: deviation  its standard deviation */
static double found(const lab_run *x, int c, const double *r, double *deviation)
{
  const double *v = x->drift + (size_t)c * x->n;
  const double length2 = lab_dot(v, v, x->n), w = sqrt(1 / ((1 - length2) * (1 - length2)) - 1);
  *deviation = 1 - length2;
  return length2 > 0 ? lab_dot(v, r, x->n) * w / sqrt(length2) * (1 - length2) : 0;
}

double lab_drift_strain(const lab_unknowns *u, const double *r)
{
  double most = 0, ignored;
  int e, c;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++, r += u->run[e].n)
      if (u->run[e].drift)
        most = fmax(most, fabs(found(&u->run[e], c, r, &ignored)));
  return most;
}

/* The largest drift of a channel that shows, SI; 0: none does. */
static double largest(const lab_unknowns *u, int channel, const double *r)
{
  static const double shows = 3, matters = 0.2; /* deviations; tolerances */
  double most = 0;
  int e, c;
  for (e = 0; e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++, r += u->run[e].n) {
      const lab_run *x = &u->run[e];
      double deviation, drift;
      if (!x->drift || x->channel[c] != channel)
        continue;
      drift = found(x, c, r, &deviation);
      if (fabs(drift) > fmax(shows * deviation, matters))
        most = fabs(drift * tolerance_of(x, c)) > fabs(most) ? drift * tolerance_of(x, c) : most;
    }
  return most;
}

int lab_drift_say(const lab_unknowns *u, lab_limitations *limitations, lab_error *error)
{
  char text[LAB_FORMAT_TEXT];
  double *r = malloc((u->m + 1) * sizeof *r);
  int channel, status = r ? lab_unknowns_residuals((void *)u, NULL, r, error) : lab_fail_memory(error, "residuals");
  for (channel = 0; channel < LAB_CHANNEL_COUNT && status == LAB_OK; channel++) {
    const double drift = u->window ? 0 : largest(u, channel, r);
    if (drift != 0)
      lab_limitation(limitations, "Something as slow as a sensor of %s that drifts by %s over a run is taken out.",
                     lab_channels[channel].key, lab_format_quantity(drift, lab_channels[channel].unit, 2, text));
  }
  free(r);
  return status;
}
