#include "asymmetry.h"

#include <math.h>

#include <nlopt.h>

enum { GRID = 400 };
static const double window_from = 0.05, window_to = 0.95;

static double travel(const lab_edge *e)
{
  return e->x[e->n - 1] - e->x[0];
}

/* Travelled share of sample i, 0 at the start and 1 at the end. */
static double share(const lab_edge *e, size_t i)
{
  return (e->x[i] - e->x[0]) / travel(e);
}

/* Time at which the share is first reached, linear between samples [s]. */
static double crossing(const lab_edge *e, double level)
{
  size_t i = 1;
  double before, after;
  while (i + 1 < e->n && share(e, i) < level)
    i++;
  before = share(e, i - 1);
  after = share(e, i);
  return e->t[i - 1] + (e->t[i] - e->t[i - 1]) * (after > before ? (level - before) / (after - before) : 0);
}

/* Shares at GRID + 1 equally spaced times between the window's crossings. */
static double resample(const lab_edge *e, double *y)
{
  const double from = crossing(e, window_from), to = crossing(e, window_to);
  size_t at = 1;
  int i;
  for (i = 0; i <= GRID; i++) {
    const double t = from + (to - from) * i / GRID;
    while (at + 1 < e->n && e->t[at] < t)
      at++;
    y[i] = share(e, at - 1) + (share(e, at) - share(e, at - 1)) * (t - e->t[at - 1]) / (e->t[at] - e->t[at - 1]);
  }
  return to - from;
}

/* Straight line y = a + b z through points.  Returns: mean square of what is left. */
static double line_fit(const double *z, const double *y, double *a, double *b)
{
  double n = GRID + 1, sz = 0, sy = 0, szz = 0, szy = 0, left = 0;
  int i;
  for (i = 0; i <= GRID; i++) {
    sz += z[i];
    sy += y[i];
    szz += z[i] * z[i];
    szy += z[i] * y[i];
  }
  *b = (n * szy - sz * sy) / (n * szz - sz * sz);
  *a = (sy - *b * sz) / n;
  for (i = 0; i <= GRID; i++) {
    const double r = y[i] - *a - *b * z[i];
    left += r * r;
  }
  return left / n;
}

/* Mean square left by y = a + b exp(-s/T), T in units of the window, a and b free. */
static double lag_misfit(unsigned n, const double *log_T, double *gradient, void *data)
{
  const double *y = data;
  double z[GRID + 1], a, b;
  int i;
  (void)n, (void)gradient;
  for (i = 0; i <= GRID; i++)
    z[i] = expm1(-(double)i / GRID * exp(-*log_T));
  return line_fit(z, y, &a, &b);
}

static double fit_lag(const double *y, double *misfit)
{
  nlopt_opt opt = nlopt_create(NLOPT_LN_SBPLX, 1);
  double log_T = 0;
  nlopt_set_lower_bounds1(opt, log(1e-2));
  nlopt_set_upper_bounds1(opt, log(1e2));
  nlopt_set_min_objective(opt, lag_misfit, (void *)y);
  nlopt_set_xtol_abs1(opt, 1e-8);
  nlopt_set_maxeval(opt, 500);
  nlopt_optimize(opt, &log_T, misfit);
  nlopt_destroy(opt);
  return exp(log_T);
}

double lab_asymmetry_lag_time(const lab_edge *e, double *rms)
{
  double y[GRID + 1], misfit = 0;
  const double duration = resample(e, y);
  const double T = fit_lag(y, &misfit) * duration;
  if (rms)
    *rms = sqrt(misfit);
  return T;
}

double lab_asymmetry_ramp_time(const lab_edge *e, double *rms)
{
  double y[GRID + 1], s[GRID + 1], a, b, misfit;
  const double duration = resample(e, y);
  int i;
  for (i = 0; i <= GRID; i++)
    s[i] = (double)i / GRID;
  misfit = line_fit(s, y, &a, &b);
  if (rms)
    *rms = sqrt(misfit);
  return duration / b;
}

/* Trapezoidal rule over |y_up - y_down|, both brought from 5..95 % to 0..1. A falling stroke's share grows
 * from 0 as well: that is the mirror. */
static double shape_distance(const double *up, const double *down)
{
  double sum = 0;
  int i;
  for (i = 0; i <= GRID; i++)
    sum += fabs(up[i] - down[i]) * (i == 0 || i == GRID ? 0.5 : 1);
  return sum / GRID / (window_to - window_from);
}

static int check(const lab_edge *e, const char *which, lab_error *error)
{
  if (e->n < 3 || !(fabs(travel(e)) > 0))
    return lab_fail(error, LAB_DATA, "the %s stroke has no travel to compare", which);
  return LAB_OK;
}

int lab_asymmetry_measure(const lab_edge *up, const lab_edge *down, lab_asymmetry *out, lab_error *error)
{
  double y_up[GRID + 1], y_down[GRID + 1];
  if (check(up, "rising", error) || check(down, "falling", error))
    return error->status;
  out->rise_time = resample(up, y_up);
  out->fall_time = resample(down, y_down);
  out->duration_ratio = out->fall_time / out->rise_time;
  out->asymmetry = shape_distance(y_up, y_down);
  out->T1 = lab_asymmetry_lag_time(up, &out->lag_error);
  out->T2 = lab_asymmetry_ramp_time(down, &out->ramp_error);
  return LAB_OK;
}
