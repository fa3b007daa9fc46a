#include "benchscan.h"

#include <math.h>

#include "stroke.h"

pneu_params bench_params(const pneu_params *base, double low, double width)
{
  pneu_params p = *base;
  p.spring_rate = p.area * width / p.stroke;
  p.spring_preload = fmin(p.area * low / p.spring_rate, 1.0);
  p.external_force += p.area * low - p.spring_rate * p.spring_preload;
  return p;
}

double bench_pressure(const pneu_params *p, double x, int direction)
{
  static const pneu_laws any;
  pneu_model model;
  pneu_input input;
  if (pneu_model_init(&model, p, &any, NULL) != PNEU_OK)
    return (double)NAN;
  pneu_input_default(&model, &input);
  return pneu_balance_pressure(&model, x, &input, direction);
}

/* Lowest and highest lower end [Pa] at which the stem still moves both ways. */
static void limits(const pneu_params *p, double width, double *low, double *high)
{
  *low = 1.1 * p->dry_friction / p->area;
  *high = p->supply_pressure - width - *low;
}

static int measure(const pneu_params *p, const pneu_laws *law, double value[SCAN_QUANTITIES], lab_error *error)
{
  speed_pair pair;
  if (speeds_measure(p, law, &pair, error))
    return error->status;
  value[SCAN_FALL_RANGE] = speed_max(&pair.down) / speed_min(&pair.down);
  value[SCAN_FIRST_OVER] = speed_min(&pair.down) / speed_max(&pair.up);
  value[SCAN_LAST_OVER] = speed_min(&pair.up) / speed_max(&pair.down);
  value[SCAN_FASTEST] = speed_max(&pair.down) / speed_max(&pair.up);
  return LAB_OK;
}

int bench_scan_run(const pneu_params *base, const pneu_laws *law, bench_scan *out, lab_error *error)
{
  double value[SCAN_QUANTITIES] = {0}, bottom, top;
  pneu_params p;
  int i, q;
  out->low = bench_pressure(base, 0, 0);
  out->width = base->spring_rate * base->stroke / base->area;
  limits(base, out->width, &bottom, &top);
  top = fmax(top, out->low);
  for (i = 0; i < SCAN_POINTS; i++) {
    out->from[i] = bottom + (top - bottom) * i / (SCAN_POINTS - 1);
    p = bench_params(base, out->from[i], out->width);
    if (measure(&p, law, value, error))
      return lab_fail_in(error, "bench set from %.4g Pa", out->from[i]);
    for (q = 0; q < SCAN_QUANTITIES; q++)
      out->value[q][i] = value[q];
  }
  return LAB_OK;
}

/* Place between points i and i + 1 where the value passes `limit`; the end itself where there is no such i. */
static double passes(const bench_scan *s, int q, int i, double limit)
{
  if (i < 0 || i + 1 >= SCAN_POINTS)
    return s->from[i < 0 ? 0 : SCAN_POINTS - 1];
  return s->from[i] + (s->from[i + 1] - s->from[i]) * (limit - s->value[q][i]) / (s->value[q][i + 1] - s->value[q][i]);
}

int bench_scan_range(const bench_scan *scan, int quantity, double limit, double *from, double *to)
{
  const double *value = scan->value[quantity];
  int first = 0, best = 0, i;
  for (i = 0; i <= SCAN_POINTS; i++) {
    if (i < SCAN_POINTS && value[i] <= limit)
      continue;
    if (i - first > best) {
      best = i - first;
      *from = passes(scan, quantity, first - 1, limit);
      *to = passes(scan, quantity, i - 1, limit);
    }
    first = i + 1;
  }
  return best > 0;
}

/* ln of the duration ratio on a bench set; NaN where it cannot be had. */
static double log_durations(const pneu_params *base, const pneu_laws *law, double low, double width, double *asymmetry)
{
  const pneu_params p = bench_params(base, low, width);
  lab_asymmetry r;
  lab_error ignored;
  if (stroke_measure(&p, &p, law, &r, &ignored))
    return (double)NAN;
  *asymmetry = r.asymmetry;
  return log(r.duration_ratio);
}

/* Regula falsi; the value of an end that stays is halved (Illinois), because it falls steeply at both ends. */
double bench_equal(const pneu_params *base, const pneu_laws *law, double width, double *asymmetry)
{
  double a, b, fa, fb, f, at;
  int tries, kept = 0;
  *asymmetry = (double)NAN;
  limits(base, width, &a, &b);
  fa = log_durations(base, law, a, width, asymmetry);
  fb = log_durations(base, law, b, width, asymmetry);
  for (tries = 0; tries < 40 && fa > 0 && fb < 0; tries++) {
    at = a - fa * (b - a) / (fb - fa);
    f = log_durations(base, law, at, width, asymmetry);
    if (fabs(f) < 1e-3)
      return at;
    if (f > 0) {
      a = at, fa = f;
      fb /= kept == 1 ? 2 : 1;
    } else {
      b = at, fb = f;
      fa /= kept == -1 ? 2 : 1;
    }
    kept = f > 0 ? 1 : -1;
  }
  return (double)NAN;
}

double bench_alike(const pneu_params *base, const pneu_laws *law, double width, double limit, double *low)
{
  double wide = width, narrow = width / 100, asymmetry;
  *low = bench_equal(base, law, narrow, &asymmetry);
  if (isnan(*low) || asymmetry > limit)
    return (double)NAN;
  while (wide / narrow > 1.02) {
    const double middle = sqrt(wide * narrow), at = bench_equal(base, law, middle, &asymmetry);
    if (!isnan(at) && asymmetry <= limit)
      narrow = middle, *low = at;
    else
      wide = middle;
  }
  return narrow;
}
