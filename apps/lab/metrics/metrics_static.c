/* The static figures, from position over signal: points at which both stood still, or else every row of a slow record,
 * in legs between turns. Dead band and resolution are how far the signal must go before the stem goes on, after a turn
 * and without one; hysteresis and linearity are of a slow loop up and down. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/format.h"
#include "metrics_private.h"

enum { POINTS = 2000, SLICES = 10, HELD_LEAST = 4, GAPS = 512, GRID = 201, SEARCH = 80 };
static const double turn_noise = 6;      /* the signal has turned from so many standard deviations on */
static const double turn_share = 0.0005; /* and from this share of its span on */
static const double cycle_share = 0.05;  /* of the span: the same for legs of cycles */
static const double rest_share = 0.001;  /* of the stroke and of the span: what still moves moves more */
static const double slow = 0.05;         /* [1/s] strokes a second, up to which a leg is slow */
static const double moved_share = 0.01;  /* of the stroke: a leg that moves less says nothing of what comes after it */
static const double coarse = 0.1;        /* of the span: a dead band that is not known better is not known */
static const double small_steps = 1.5;   /* times the smallest step of a staircase, up to which steps count as small */
static const double whole = 0.8;         /* of the stroke that a loop covers at least */

static int is_off_stops(const lab_metrics_work *m, double x)
{
  static const double inside = 0.02; /* share of the stroke that counts as the stop, at either end */
  return x > inside * m->record->stroke && x < (1 - inside) * m->record->stroke;
}

static int open_path(lab_path *path, size_t room, lab_error *error)
{
  path->point = malloc((room + 1) * sizeof *path->point);
  path->leg = malloc((room + 1) * sizeof *path->leg);
  return path->point && path->leg ? LAB_OK : lab_fail_memory(error, "figures of merit");
}

void lab_path_free(lab_path *path)
{
  free(path->point);
  free(path->leg);
  memset(path, 0, sizeof *path);
}

double lab_leg_travel(const lab_path *path, const lab_leg *leg)
{
  return fabs(path->point[leg->end - 1].x - path->point[leg->begin].x);
}

/* ---- Points ---- */

/* Points where the command holds and both signal and stem have come to rest.  Returns: how many are off the stops */
static int add_held(const lab_metrics_work *m, const double *signal, double noise, lab_path *path)
{
  const lab_record *r = m->record;
  int off = 0;
  size_t k;
  for (k = 0; k < m->n_holds; k++) {
    const lab_hold *hold = &m->hold[k];
    const lab_rest s = lab_rest_of(r, signal, hold->begin, hold->end, noise);
    const lab_rest x = lab_rest_of(r, r->x, hold->begin, hold->end, m->noise_x);
    if (!(s.drift <= rest_share * lab_span(r)) || !(x.drift <= rest_share * r->stroke))
      continue;
    path->point[path->n++] = (lab_point){hold->run, r->t[hold->end - 1], s.level, x.level};
    off += is_off_stops(m, x.level);
  }
  return off;
}

/* Means of so many rows at a time, of those that have both. */
static void add_rows(const lab_record *r, const double *signal, size_t each, lab_path *path)
{
  int run;
  for (run = 0; run < r->n_runs; run++) {
    lab_point sum = {run, 0, 0, 0};
    size_t i, n = 0;
    for (i = r->first[run]; i < r->first[run + 1]; i++) {
      if (isnan(signal[i]) || isnan(r->x[i]))
        continue;
      sum.t += r->t[i], sum.s += signal[i], sum.x += r->x[i];
      if (++n < each)
        continue;
      path->point[path->n++] = (lab_point){run, sum.t / (double)n, sum.s / (double)n, sum.x / (double)n};
      sum = (lab_point){run, 0, 0, 0};
      n = 0;
    }
  }
}

/* ---- Legs ---- */

static void add_leg(lab_path *path, size_t begin, size_t end)
{
  if (end > begin + 1)
    path->leg[path->n_legs++] = (lab_leg){begin, end, path->point[end - 1].s > path->point[begin].s, 0};
}

/* Cut one run's points where the signal turns by more than `band`; of equals, the last is the turn. */
static void cut_run(lab_path *path, size_t first, size_t end, double band)
{
  const lab_point *at = path->point;
  size_t begin = first, extreme = first, i;
  int way = 0; /* 1 up, -1 down, 0 not known yet */
  for (i = first + 1; i < end; i++) {
    const double move = at[i].s - at[extreme].s;
    if (way == 0 && fabs(move) > band)
      way = move > 0 ? 1 : -1;
    if (way * move < -band) {
      add_leg(path, begin, extreme + 1);
      begin = extreme;
      way = -way;
    }
    if (way * (at[i].s - at[extreme].s) >= 0 && way != 0)
      extreme = i;
  }
  add_leg(path, begin, extreme + 1);
}

static void cut(lab_path *path, double band)
{
  size_t i, first = 0;
  for (i = 1; i <= path->n; i++)
    if (i == path->n || path->point[i].run != path->point[first].run) {
      cut_run(path, first, i, band);
      first = i;
    }
}

/* ---- Slowness ---- */

/* Median speed over slices of the leg's travel [m/s]: neither a halt nor a slip says how fast it was run. */
static double leg_speed(const lab_path *path, const lab_leg *leg)
{
  const lab_point *at = path->point;
  const double from = at[leg->begin].x, travel = at[leg->end - 1].x - from;
  double speed[SLICES], last = at[leg->begin].t;
  size_t i = leg->begin;
  int k;
  for (k = 0; k < SLICES; k++) {
    const double level = (k + 1.0) / SLICES;
    while (i + 1 < leg->end && (at[i].x - from) / travel < level)
      i++;
    speed[k] = at[i].t > last ? fabs(travel) / SLICES / (at[i].t - last) : (double)INFINITY;
    last = at[i].t;
  }
  return lab_median(speed, SLICES);
}

static void judge_legs(const lab_metrics_work *m, lab_path *path)
{
  size_t k;
  for (k = 0; k < path->n_legs; k++) {
    lab_leg *leg = &path->leg[k];
    leg->slow = path->held || lab_leg_travel(path, leg) < m->least || leg_speed(path, leg) <= slow * m->record->stroke;
  }
}

/* ---- Both paths ---- */

/* Static points of one kind or the other. */
static void choose_points(const lab_metrics_work *m, lab_path *path)
{
  const lab_record *r = m->record;
  const int set = lab_command_is_set(r->command);
  const double *signal = set ? r->u : r->p;
  /* as many rows as it takes to see a small movement through the noise, if there are so many */
  const double needed = m->least / (rest_share * r->stroke);
  const size_t each = (size_t)fmin(fmax(ceil(needed * needed), 1), 1 + (double)(r->n / POINTS));
  const double noise = set ? 0 : m->noise_p;
  path->held = 1;
  path->least = m->least;
  path->noise_s = noise;
  if (add_held(m, signal, noise, path) >= HELD_LEAST)
    return;
  path->n = 0;
  path->held = 0;
  if (set) {
    path->rejected = r->command == LAB_COMMAND_SET_PRESSURE
                         ? "the set pressure has no staircase at whose levels the stem comes to rest"
                         : "the set position has no staircase at whose levels the stem comes to rest";
    return;
  }
  add_rows(r, signal, each, path);
  path->noise_s = noise / sqrt((double)each);
  path->least = fmax(m->least / sqrt((double)each), rest_share * r->stroke);
}

int lab_path_find(lab_metrics_work *m, lab_error *error)
{
  const lab_record *r = m->record;
  if (!(lab_span(r) > 0))
    m->path.rejected = "the bench set, the span of the signal, is not known";
  else if (!r->p && !lab_command_is_set(r->command))
    m->path.rejected = "the record has no chamber pressure, which is the signal of a bare actuator";
  if (open_path(&m->path, r->n, error) || open_path(&m->rows, r->n, error))
    return error->status;
  if (!m->path.rejected)
    choose_points(m, &m->path);
  cut(&m->path, fmax(turn_noise * m->path.noise_s, turn_share * lab_span(r)));
  judge_legs(m, &m->path);
  if (r->p)
    add_rows(r, r->p, 1, &m->rows);
  cut(&m->rows, fmax(turn_noise * m->noise_p, cycle_share * lab_span(r)));
  return LAB_OK;
}

/* ---- Changes of signal that move the stem ---- */

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
    if (!is_off_stops(m, turn->x)) {
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
    if (next == leg->end || !is_off_stops(m, path->point[at].x) || !is_off_stops(m, path->point[next].x))
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

/* ---- A slow loop up and down ---- */

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
    if (!is_off_stops(m, at->x))
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
 * Out:     l          if a slow one is there
 *          cover      of slow loops, cover_any of all [m]; 0: there is none */
static void find_loop(const lab_path *path, loop *l, double *cover, double *cover_any)
{
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
  }
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
  const double stroke = m->record->stroke;
  char reason[LAB_METRIC_TEXT] = "no slow loop: the stem moves faster than 5 % of the travel a second";
  if (cover_any < whole * stroke)
    snprintf(reason, sizeof reason, "no loop over most of the travel: the largest%s covers %.3g %%",
             cover > 0 ? " slow one" : "", 100 * cover_any / stroke);
  lab_metrics_deny(m, LAB_METRIC_HYSTERESIS_DEAD_BAND, LAB_METRIC_LINEARITY, reason);
}

static void report_loop(lab_metrics_work *m)
{
  double cover, cover_any;
  loop l;
  find_loop(&m->path, &l, &cover, &cover_any);
  if (cover >= whole * m->record->stroke) {
    sample(m, &l);
    report(m, &l, cover);
  } else
    deny(m, cover, cover_any);
}

void lab_static_measure(lab_metrics_work *m)
{
  if (m->path.rejected) {
    lab_metrics_deny(m, LAB_METRIC_DEAD_BAND, LAB_METRIC_LINEARITY, m->path.rejected);
    return;
  }
  report_dead_band(m);
  report_resolution(m);
  report_loop(m); /* for which the dead band is known */
}
