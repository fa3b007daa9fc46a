/* A slow loop up and down: hysteresis, and how straight its mean branch is. */
#include <math.h>

#include "metrics_private.h"

enum { GRID = 201, SEARCH = 80 };
static const double whole = 0.8; /* of the stroke that a loop covers at least */
/* Two neighbouring legs, and their positions over the signal that they share. */
typedef struct loop {
  const lab_leg *up, *down;
  double low, high; /* signals between which every point of both is off the stops */
  double s[GRID], x_up[GRID], x_down[GRID];
} loop;

/* Position of a leg at a signal: between the point at which the signal first gets there and the one before. */
static double position_at(const lab_path *path, const lab_leg *leg, double s)
{
  const double way = leg->up ? 1 : -1;
  const lab_point *at = path->point;
  size_t i = leg->begin + 1;
  while (i + 1 < leg->end && way * (at[i].s - s) < 0)
    i++;
  if (at[i].s == at[i - 1].s)
    return at[i].x;
  return at[i - 1].x + (at[i].x - at[i - 1].x) * fmin(fmax((s - at[i - 1].s) / (at[i].s - at[i - 1].s), 0), 1);
}

/* Narrow a range of signals to that of a leg's points off the stops. */
static void narrow(const lab_metrics_work *m, const lab_leg *leg, loop *l)
{
  double low = (double)INFINITY, high = -(double)INFINITY;
  size_t i;
  for (i = leg->begin; i < leg->end; i++) {
    const lab_point *at = &m->path.point[i];
    if (!lab_is_off_stops(m, at->x))
      continue;
    low = fmin(low, at->s);
    high = fmax(high, at->s);
  }
  l->low = fmax(l->low, low);
  l->high = fmin(l->high, high);
}

static void sample(const lab_metrics_work *m, loop *l)
{
  const lab_path *path = &m->path;
  const lab_point *at = path->point;
  const double low = fmax(at[l->up->begin].s, at[l->down->end - 1].s);
  const double high = fmin(at[l->up->end - 1].s, at[l->down->begin].s);
  int i;
  l->low = -(double)INFINITY;
  l->high = (double)INFINITY;
  narrow(m, l->up, l);
  narrow(m, l->down, l);
  for (i = 0; i < GRID; i++) {
    l->s[i] = low + (high - low) * i / (GRID - 1);
    l->x_up[i] = position_at(path, l->up, l->s[i]);
    l->x_down[i] = position_at(path, l->down, l->s[i]);
  }
}

/* The loop of two neighbouring legs that covers most travel.
 * Out:     cover, of slow loops; cover_fast, of all [m] */
static int find_loop(const lab_path *path, loop *l, double *cover, double *cover_any)
{
  int found = 0;
  size_t k;
  *cover = *cover_any = 0;
  for (k = 1; k < path->n_legs; k++) {
    const lab_leg *a = &path->leg[k - 1], *b = &path->leg[k];
    const double both = fmin(lab_leg_travel(path, a), lab_leg_travel(path, b));
    if (path->point[a->begin].run != path->point[b->begin].run || a->up == b->up)
      continue;
    *cover_any = fmax(*cover_any, both);
    if (!a->slow || !b->slow || both <= *cover)
      continue;
    *cover = both;
    l->up = a->up ? a : b;
    l->down = a->up ? b : a;
    found = 1;
  }
  return found;
}

/* ---- The straight line that suits best ---- */

/* Half the spread of x - slope s over the grid; the mean branch off the stops.  Out: n, points taken */
static double misfit(const loop *l, double slope, int *n)
{
  double least = (double)INFINITY, most = -(double)INFINITY;
  int i;
  *n = 0;
  for (i = 0; i < GRID; i++) {
    const double left = (l->x_up[i] + l->x_down[i]) / 2 - slope * l->s[i];
    if (l->s[i] < l->low || l->s[i] > l->high)
      continue;
    least = fmin(least, left);
    most = fmax(most, left);
    ++*n;
  }
  return (most - least) / 2;
}

/* Smallest misfit over the slope, which is convex in it: golden section.  Out: slope [m/Pa] */
static double best_line(const lab_metrics_work *m, const loop *l, double *slope, int *n)
{
  const double golden = 0.6180339887498949, rated = m->record->stroke / lab_span(m->record);
  double a = 0, b = 4 * rated;
  int i;
  for (i = 0; i < SEARCH; i++) {
    const double c = b - golden * (b - a), d = a + golden * (b - a);
    if (misfit(l, c, n) < misfit(l, d, n))
      b = d;
    else
      a = c;
  }
  *slope = (a + b) / 2;
  return misfit(l, *slope, n);
}

/* ---- Figures ---- */

static double widest(const loop *l)
{
  double most = 0;
  int i;
  for (i = 0; i < GRID; i++)
    most = fmax(most, fabs(l->x_down[i] - l->x_up[i]));
  return most;
}

static void report_hysteresis(lab_metrics_work *m, double both, double error, double gain)
{
  const lab_metric *band = &m->metrics->metric[LAB_METRIC_DEAD_BAND];
  if (isnan(band->value))
    lab_metric_absent(m, LAB_METRIC_HYSTERESIS, "it takes the dead band, and there: %.150s", band->text);
  else
    lab_metric_set(m, LAB_METRIC_HYSTERESIS, fmax(both - gain * band->value, 0), error + gain * band->uncertainty,
                   "%.3g %% less the dead band of %.3g %% times the gain %.3g", both, band->value, gain);
}

static void report(lab_metrics_work *m, const loop *l, double cover)
{
  const double stroke = m->record->stroke, noise = m->path.held ? 0 : m->noise_x;
  const double both = 100 * widest(l) / stroke, error = 100 * (2 * noise + m->path.least) / stroke;
  double slope, straight;
  int n;
  straight = best_line(m, l, &slope, &n);
  lab_metric_set(m, LAB_METRIC_HYSTERESIS_DEAD_BAND, both, error, "loop over %.3g %% of the travel, %s",
                 100 * cover / stroke, m->path.held ? "from points at rest" : "run slowly");
  if (n < GRID / 4) {
    lab_metric_absent(m, LAB_METRIC_LINEARITY, "too little of the loop lies between the stops");
    slope = stroke / lab_span(m->record);
  } else
    lab_metric_set(m, LAB_METRIC_LINEARITY, 100 * straight / stroke, error, "mean branch between the stops, gain %.3g",
                   slope * lab_span(m->record) / stroke);
  report_hysteresis(m, both, error, slope * lab_span(m->record) / stroke);
}

static void deny(lab_metrics_work *m, double cover, double cover_any)
{
  static const int of_loop[] = {LAB_METRIC_HYSTERESIS_DEAD_BAND, LAB_METRIC_HYSTERESIS, LAB_METRIC_LINEARITY};
  const double stroke = m->record->stroke;
  size_t i;
  for (i = 0; i < sizeof of_loop / sizeof *of_loop; i++)
    if (m->path.rejected)
      lab_metric_absent(m, of_loop[i], "%s", m->path.rejected);
    else if (cover_any >= whole * stroke)
      lab_metric_absent(m, of_loop[i], "no slow loop: the stem moves faster than 5 %% of the travel a second");
    else
      lab_metric_absent(m, of_loop[i], "no loop over most of the travel: the largest%s covers %.3g %%",
                        cover > 0 ? " slow one" : "", 100 * fmax(cover, cover_any) / stroke);
}

void lab_loop_measure(lab_metrics_work *m)
{
  double cover = 0, cover_any = 0;
  loop l;
  if (m->path.rejected || !find_loop(&m->path, &l, &cover, &cover_any) || cover < whole * m->record->stroke) {
    deny(m, cover, cover_any);
    return;
  }
  sample(m, &l);
  report(m, &l, cover);
}
