#include "benchscan.h"

#include <math.h>
#include <string.h>

#include "paper.h"
#include "stroke.h"

pneu_params bench_params(const pneu_params *base, double low, double width)
{
  pneu_params p = *base;
  p.spring_rate = p.area * width / p.stroke;
  p.spring_preload = p.area * low / p.spring_rate;
  return p;
}

void bench_of_rig(const lab_rig *rig, double *low, double *width)
{
  const pneu_params *p = &rig->params;
  int i;
  *low = p->spring_rate * p->spring_preload / p->area;
  *width = p->spring_rate * p->stroke / p->area;
  for (i = 0; i < PAPER_ACTUATOR_COUNT; i++) {
    const paper_actuator printed = paper_actuator_printed(i);
    if (!strcmp(printed.key, rig->name)) {
      *low = printed.bench_low;
      *width = printed.bench_high - printed.bench_low;
    }
  }
}

static int measure(const pneu_params *p, const pneu_laws *law, double value[SCAN_QUANTITIES], lab_error *error)
{
  speed_pair pair;
  if (speeds_measure(p, law, &pair, error))
    return error->status;
  value[SCAN_FALL_RANGE] = speed_max(&pair.down) / speed_min(&pair.down);
  value[SCAN_FIRST_OVER] = speed_min(&pair.down) / speed_max(&pair.up);
  value[SCAN_LAST_OVER] = speed_min(&pair.up) / speed_max(&pair.down);
  value[SCAN_DURATIONS] = pair.shape.duration_ratio;
  value[SCAN_ASYMMETRY] = pair.shape.asymmetry;
  return LAB_OK;
}

int bench_scan_run(const lab_rig *rig, const pneu_laws *law, bench_scan *out, lab_error *error)
{
  const double friction = 1.1 * rig->params.dry_friction / rig->params.area;
  double value[SCAN_QUANTITIES], top;
  pneu_params p;
  int i, q;
  bench_of_rig(rig, &out->low, &out->width);
  p = bench_params(&rig->params, out->low, out->width);
  if (measure(&p, law, out->nominal, error))
    return error->status;
  top = fmax(p.supply_pressure - out->width - friction, out->low);
  for (i = 0; i < SCAN_POINTS; i++) {
    out->from[i] = friction + (top - friction) * i / (SCAN_POINTS - 1);
    p = bench_params(&rig->params, out->from[i], out->width);
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

double bench_scan_max(const bench_scan *scan, int quantity)
{
  double value = scan->value[quantity][0];
  int i;
  for (i = 1; i < SCAN_POINTS; i++)
    value = fmax(value, scan->value[quantity][i]);
  return value;
}

double bench_scan_min(const bench_scan *scan, int quantity)
{
  double value = scan->value[quantity][0];
  int i;
  for (i = 1; i < SCAN_POINTS; i++)
    value = fmin(value, scan->value[quantity][i]);
  return value;
}

/* Regula falsi in the logarithm of the duration ratio, which falls nearly straight as the bench set goes up. */
double bench_scan_equal(const bench_scan *scan, const pneu_params *base, const pneu_laws *law, double *asymmetry)
{
  const double *ratio = scan->value[SCAN_DURATIONS];
  int i = 0, tries;
  double a, b, fa, fb, at = (double)NAN;
  while (i + 1 < SCAN_POINTS && (ratio[i] > 1) == (ratio[i + 1] > 1))
    i++;
  if (i + 1 >= SCAN_POINTS)
    return (double)NAN;
  a = scan->from[i], b = scan->from[i + 1], fa = log(ratio[i]), fb = log(ratio[i + 1]);
  for (tries = 0; tries < 20; tries++) {
    pneu_params p = bench_params(base, at = a - fa * (b - a) / (fb - fa), scan->width);
    lab_asymmetry r;
    lab_error ignored;
    double f;
    if (stroke_measure(&p, law, &r, &ignored))
      return (double)NAN;
    *asymmetry = r.asymmetry;
    f = log(r.duration_ratio);
    if (fabs(f) < 1e-3)
      return at;
    if ((f > 0) == (fa > 0))
      a = at, fa = f;
    else
      b = at, fb = f;
  }
  return (double)NAN;
}
