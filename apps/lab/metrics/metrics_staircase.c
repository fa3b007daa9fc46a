/* Dead band and resolution: how far the signal must go before the stem goes on, after a turn and without one. */
#include <math.h>
#include <stdlib.h>

#include "../base/format.h"
#include "metrics_private.h"

enum { GAPS = 512 };
static const double moved_share = 0.01; /* of the stroke: a leg that moves less says nothing of what comes after it */
static const double coarse = 0.1;       /* of the span: a dead band that is not known better is not known */
static const double small_steps = 1.5;  /* times the smallest step of a staircase, up to which steps count as small */

/* A change of signal that it took to move the stem [Pa]. */
typedef struct gap {
  double size, error;
  double last; /* step of the record with which it came */
  int single;  /* not 0: no larger than the steps of the record allow to see */
} gap;

typedef struct gaps {
  gap gap[GAPS];
  int n;
} gaps;

/* First point of a leg after `from` at which the stem has visibly moved on from x; leg->end if none. */
static size_t first_move(const lab_path *path, const lab_leg *leg, size_t from, double x)
{
  const double way = leg->up ? 1 : -1;
  size_t i = from + 1;
  while (i < leg->end && way * (path->point[i].x - x) <= path->least)
    i++;
  return i;
}

/* It moved at some signal between the points before and at i: half way, give or take. */
static void add_gap(const lab_metrics_work *m, gaps *g, double from, size_t i, int single)
{
  const lab_path *path = &m->path;
  const double now = path->point[i].s, before = path->point[i - 1].s, last = fabs(now - before);
  if (g->n < GAPS)
    g->gap[g->n++] = (gap){fabs((now + before) / 2 - from), last / 2 + 2 * path->noise_s, last, single};
}

/* What moving by what can be seen takes, where nothing sticks. */
static double seen(const lab_metrics_work *m)
{
  return m->path.least / m->record->stroke * lab_span(m->record);
}

static int ascending(const void *a, const void *b)
{
  const double x = ((const gap *)a)->size, y = ((const gap *)b)->size;
  return (x > y) - (x < y);
}

/* Sort by size.  Returns: the largest error */
static double sort_gaps(gaps *g)
{
  double most = 0;
  int i;
  for (i = 0; i < g->n; i++)
    most = fmax(most, g->gap[i].error);
  qsort(g->gap, (size_t)g->n, sizeof *g->gap, ascending);
  return most;
}

/* Of a staircase, keep the movements that came with its smallest steps: they tell most. */
static void keep_smallest(const lab_path *path, gaps *g)
{
  double least = (double)INFINITY;
  int i, n = 0;
  if (!path->held)
    return;
  for (i = 0; i < g->n; i++)
    least = fmin(least, g->gap[i].last);
  for (i = 0; i < g->n; i++)
    if (g->gap[i].last <= small_steps * least)
      g->gap[n++] = g->gap[i];
  g->n = n;
}

/* How a static signal is written: a set position is a share of the stroke. */
static lab_format written(const lab_metrics_work *m)
{
  return m->record->command == LAB_COMMAND_SET_POSITION ? (lab_format){100, "%"} : lab_format_as("Pa");
}

/* Set a figure to the median, over the span. */
static void give_median(lab_metrics_work *m, int metric, const gaps *g, double error, const char *of)
{
  const double span = lab_span(m->record);
  const lab_format as = written(m);
  lab_metric_set(m, metric, 100 * g->gap[g->n / 2].size / span, 100 * error / span,
                 "median of %d %s: %.3g to %.3g %s of a span of %.4g %s", g->n, of, as.scale * g->gap[0].size,
                 as.scale * g->gap[g->n - 1].size, as.unit, as.scale * span, as.unit);
}

/* Set a figure that is at most `size` of the signal. */
static void give_bound(lab_metrics_work *m, int metric, double size, const char *words)
{
  const double span = lab_span(m->record);
  const lab_format as = written(m);
  lab_metric_set(m, metric, 100 * size / span, 0, "%.3g %s of %.4g %s %s", as.scale * size, as.unit, as.scale * span,
                 as.unit, words);
  m->metrics->metric[metric].at_most = 1;
}

/* ---- Dead band ---- */

static void collect_turns(const lab_metrics_work *m, gaps *g, int *fast, int *at_stop)
{
  const lab_path *path = &m->path;
  size_t k;
  for (k = 1; k < path->n_legs; k++) {
    const lab_leg *before = &path->leg[k - 1], *leg = &path->leg[k];
    const lab_point *turn = &path->point[leg->begin];
    const double moved = fabs(turn->x - path->point[before->begin].x);
    size_t i;
    if (path->point[before->begin].run != turn->run)
      continue;
    if (!lab_is_off_stops(m, turn->x)) {
      ++*at_stop;
      continue;
    }
    i = first_move(path, leg, leg->begin, turn->x);
    if (moved < moved_share * m->record->stroke || i == leg->end)
      continue;
    if (before->slow && leg->slow)
      add_gap(m, g, turn->s, i, 0);
    else
      ++*fast;
  }
}

static void report_dead_band(lab_metrics_work *m)
{
  const char *signal = lab_metrics_static_signal(m->record->command);
  gaps g = {.n = 0};
  int fast = 0, at_stop = 0;
  double error;
  collect_turns(m, &g, &fast, &at_stop);
  if (g.n == 0 && fast > 0)
    lab_metric_absent(m, LAB_METRIC_DEAD_BAND,
                      "the stem passes all %d turns of the %s faster than 5 %% of the travel a second", fast, signal);
  else if (g.n == 0)
    lab_metric_absent(m, LAB_METRIC_DEAD_BAND, "the %s does not turn between the stops, between movements both ways%s",
                      signal, at_stop ? "; on a stop it does" : "");
  if (g.n == 0)
    return;
  keep_smallest(&m->path, &g);
  error = sort_gaps(&g) + seen(m);
  if (error > coarse * lab_span(m->record))
    lab_metric_absent(m, LAB_METRIC_DEAD_BAND,
                      "the %s runs through the dead band between rows: these tell it within %.3g %s either way", signal,
                      written(m).scale * error, written(m).unit);
  else if (g.gap[g.n / 2].size > error)
    give_median(m, LAB_METRIC_DEAD_BAND, &g, error, g.n == 1 ? "turn" : "turns");
  else
    give_bound(m, LAB_METRIC_DEAD_BAND, g.gap[g.n / 2].size + error, "are enough to move the stem back");
}

/* ---- Resolution ---- */

/* Movements that follow the first one of a leg, in its direction. */
static void collect_moves(const lab_metrics_work *m, const lab_leg *leg, gaps *g)
{
  const lab_path *path = &m->path;
  size_t at = first_move(path, leg, leg->begin, path->point[leg->begin].x), next;
  for (; at < leg->end; at = next) {
    next = first_move(path, leg, at, path->point[at].x);
    if (next == leg->end || !lab_is_off_stops(m, path->point[at].x) || !lab_is_off_stops(m, path->point[next].x))
      continue;
    add_gap(m, g, path->point[at].s, next,
            next == at + 1 || fabs(path->point[next].s - path->point[at].s) <= 2 * seen(m));
  }
}

/* Where most of the smallest changes moved the stem, they are all that is known. */
static void give_resolution(lab_metrics_work *m, gaps *g)
{
  const double error = sort_gaps(g);
  const gap *median = &g->gap[g->n / 2];
  int i, single = 0;
  for (i = 0; i < g->n; i++)
    single += g->gap[i].single;
  if (2 * single <= g->n) {
    give_median(m, LAB_METRIC_RESOLUTION, g, error, "movements");
    return;
  }
  give_bound(m, LAB_METRIC_RESOLUTION, median->size + median->error,
             "move the stem; smaller changes were not tried, or cannot be seen");
}

static void report_resolution(lab_metrics_work *m)
{
  const char *signal = lab_metrics_static_signal(m->record->command);
  gaps g = {.n = 0};
  int fast = 0;
  size_t k;
  for (k = 0; k < m->path.n_legs; k++)
    if (m->path.leg[k].slow)
      collect_moves(m, &m->path.leg[k], &g);
    else
      fast++;
  keep_smallest(&m->path, &g);
  if (g.n > 0)
    give_resolution(m, &g);
  else if (fast > 0)
    lab_metric_absent(m, LAB_METRIC_RESOLUTION,
                      "the %s changes slowly nowhere: the stem is faster than 5 %% of the travel a second", signal);
  else
    lab_metric_absent(m, LAB_METRIC_RESOLUTION,
                      "the %s does not move the stem twice in the same direction between the stops", signal);
}

void lab_staircase_measure(lab_metrics_work *m)
{
  if (m->path.rejected) {
    lab_metrics_absent(m, LAB_METRIC_DEAD_BAND, LAB_METRIC_RESOLUTION, m->path.rejected);
    return;
  }
  report_dead_band(m);
  report_resolution(m);
}
