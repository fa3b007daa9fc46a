#include "asymmetry.h"

#include <math.h>

#include "../fit/fit.h"

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

/* What y = a + b exp(-s/T) leaves, T in units of the window, a and b free. */
static int lag_residuals(void *context, const double *log_T, double *r, lab_error *error)
{
  const double *y = context;
  double z[GRID + 1], a, b;
  int i;
  (void)error;
  for (i = 0; i <= GRID; i++)
    z[i] = expm1(-(double)i / GRID * exp(-*log_T));
  line_fit(z, y, &a, &b);
  for (i = 0; i <= GRID; i++)
    r[i] = y[i] - a - b * z[i];
  return LAB_OK;
}

static int lag_slope(void *context, const double *log_T, const double *r, int j, double *column, lab_error *error)
{
  const double step = 1e-4, above = *log_T + step, below = *log_T - step;
  double other[GRID + 1];
  int i;
  (void)r, (void)j;
  lag_residuals(context, &above, column, error);
  lag_residuals(context, &below, other, error);
  for (i = 0; i <= GRID; i++)
    column[i] = (column[i] - other[i]) / (2 * step);
  return LAB_OK;
}

/* Out: misfit  mean square  Returns: T in units of the window, NaN where there is no memory to find it */
static double fit_lag(double *y, double *misfit)
{
  const double lower = log(1e-2), upper = log(1e2);
  const lab_fit_problem problem = {.n = 1,
                                   .m = GRID + 1,
                                   .lower = &lower,
                                   .upper = &upper,
                                   .context = y,
                                   .residuals = lag_residuals,
                                   .slope = lag_slope,
                                   .search = 20,
                                   .enough = 1e-30,
                                   .enough_share = 1e-14};
  double log_T = 0, chi2;
  lab_error error;
  if (lab_fit(&problem, &log_T, &chi2, &error))
    return *misfit = (double)NAN;
  *misfit = chi2 / (GRID + 1);
  return exp(log_T);
}

double lab_asymmetry_lag_time(const lab_edge *e, double *rms)
{
  double y[GRID + 1], misfit = 0;
  const double duration = resample(e, y);
  const double T = fit_lag(y, &misfit) * duration;
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
  *rms = sqrt(misfit);
  return duration / b;
}

/* Trapezoidal rule over y_up - y_down and its size, both brought from 5..95 % to 0..1. A falling stroke's share
 * grows from 0 as well: that is the mirror. */
static void compare_shapes(const double *up, const double *down, lab_asymmetry *out)
{
  const double scale = 1 / (GRID * (window_to - window_from));
  int i;
  out->asymmetry = out->asymmetry_signed = 0;
  for (i = 0; i <= GRID; i++) {
    const double gap = (up[i] - down[i]) * (i == 0 || i == GRID ? 0.5 : 1) * scale;
    out->asymmetry_signed += gap;
    out->asymmetry += fabs(gap);
  }
}

static int check(const lab_edge *e, const char *which, lab_error *error)
{
  if (e->n < 3 || !(fabs(travel(e)) > 0))
    return lab_fail(error, LAB_DATA, "the %s stroke has no travel to compare", which);
  return LAB_OK;
}

int lab_asymmetry_measure(const lab_edge *up, const lab_edge *down, lab_asymmetry *out, lab_error *error)
{
  double y_up[GRID + 1], y_down[GRID + 1], ignored;
  if (check(up, "rising", error) || check(down, "falling", error))
    return error->status;
  out->rise_time = resample(up, y_up);
  out->fall_time = resample(down, y_down);
  out->duration_ratio = out->fall_time / out->rise_time;
  compare_shapes(y_up, y_down, out);
  out->T1 = lab_asymmetry_lag_time(up, &ignored);
  out->T2 = lab_asymmetry_ramp_time(down, &ignored);
  return LAB_OK;
}
