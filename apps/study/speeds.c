#include "speeds.h"

#include <math.h>

#include "stroke.h"

static const double window_from = 0.05, window_to = 0.95;

double speed_position(int i)
{
  return window_from + (window_to - window_from) * i / (SPEED_POINTS - 1);
}

/* State of the curve between samples i - 1 and i where it passes x. */
static void read_at(const stroke_curve *c, size_t i, double x, double *v, double *p)
{
  const double part = (x - c->x[i - 1]) / (c->x[i] - c->x[i - 1]);
  *v = fabs(c->v[i - 1] + part * (c->v[i] - c->v[i - 1]));
  *p = c->p[i - 1] + part * (c->p[i] - c->p[i - 1]);
}

static double arrival(const stroke_curve *c)
{
  const double near = 1e-6 * fabs(c->x[c->n - 1] - c->x[0]); /* a stop is met to the accuracy of an event */
  size_t i = 0;
  while (fabs(c->x[i] - c->x[c->n - 1]) > near)
    i++;
  return fabs(c->v[i]);
}

/* Entries in the order in which the stem passes them; `sign` is that of the motion. */
static void read_edge(const stroke_curve *c, int sign, speed_edge *e)
{
  const double from = c->x[0], travel = c->x[c->n - 1] - from;
  size_t at = 1;
  int i;
  for (i = 0; i < SPEED_POINTS; i++) {
    const double x = from + travel * speed_position(i);
    const int entry = sign > 0 ? i : SPEED_POINTS - 1 - i;
    while (at + 1 < c->n && sign * c->x[at] < sign * x)
      at++;
    read_at(c, at, x, &e->v[entry], &e->p[entry]);
  }
  e->arrival = arrival(c);
}

/* Trapezoidal rule over -A p dx. */
static double work_on_air(const stroke_curve *c, double area)
{
  double sum = 0;
  size_t i;
  for (i = 1; i < c->n; i++)
    sum -= 0.5 * (c->p[i] + c->p[i - 1]) * (c->x[i] - c->x[i - 1]);
  return area * sum;
}

int speeds_measure(const pneu_params *params, const pneu_laws *law, speed_pair *out, lab_error *error)
{
  stroke_pair pair;
  int status = stroke_sample(params, params, law, &pair, error);
  if (status == LAB_OK) {
    const lab_edge rising = stroke_edge(&pair.up), falling = stroke_edge(&pair.down);
    status = lab_asymmetry_measure(&rising, &falling, &out->shape, error);
  }
  if (status == LAB_OK) {
    read_edge(&pair.up, 1, &out->up);
    read_edge(&pair.down, -1, &out->down);
    out->returned = work_on_air(&pair.down, params->area);
  }
  stroke_pair_free(&pair);
  return status;
}

int speed_fastest(const speed_edge *e)
{
  int i, best = 0;
  for (i = 1; i < SPEED_POINTS; i++)
    if (e->v[i] > e->v[best])
      best = i;
  return best;
}

double speed_max(const speed_edge *e)
{
  return e->v[speed_fastest(e)];
}

double speed_min(const speed_edge *e)
{
  double least = e->v[0];
  int i;
  for (i = 1; i < SPEED_POINTS; i++)
    least = fmin(least, e->v[i]);
  return least;
}

/* Pressure grows with position on either edge: the spring balances it. */
double speed_at_pressure(const speed_edge *e, double p)
{
  int i = 1;
  if (!(p >= e->p[0] && p <= e->p[SPEED_POINTS - 1]))
    return (double)NAN;
  while (i + 1 < SPEED_POINTS && e->p[i] < p)
    i++;
  return e->v[i - 1] + (e->v[i] - e->v[i - 1]) * (p - e->p[i - 1]) / (e->p[i] - e->p[i - 1]);
}

double speed_exponent(const speed_edge *e, double P_a)
{
  double n = SPEED_POINTS, sx = 0, sy = 0, sxx = 0, sxy = 0;
  int i;
  for (i = 0; i < SPEED_POINTS; i++) {
    const double x = log(e->p[i] + P_a), y = log(e->v[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double speed_crossing(const speed_pair *pair)
{
  const speed_edge *up = &pair->up, *down = &pair->down;
  int i = SPEED_POINTS - 1;
  double lead = (double)NAN, before;
  for (; i >= 0; i--) {
    before = lead;
    lead = speed_at_pressure(down, up->p[i]) - up->v[i];
    if (lead < 0)
      return isnan(before) ? (double)NAN : up->p[i] + (up->p[i + 1] - up->p[i]) * lead / (lead - before);
  }
  return (double)NAN;
}
