/* Position over signal: points at which both stood still, or else every row of a slow record, in legs between turns. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "metrics_private.h"
#include "../base/array.h"

enum { POINTS = 2000, SLICES = 10, HELD_LEAST = 4 };
static const double turn_noise = 6;      /* the signal has turned from so many standard deviations on */
static const double turn_share = 0.0005; /* and from this share of its span on */
static const double cycle_share = 0.05;  /* of the span: the same for legs of cycles */
static const double rest_share = 0.001;  /* of the stroke and of the span: what still moves moves more */
static const double slow = 0.05;         /* [1/s] strokes a second, up to which a leg is slow */

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
    lab_point *at = &path->point[path->n];
    const lab_rest s = lab_rest_of(r, signal, hold->begin, hold->end, noise);
    const lab_rest x = lab_rest_of(r, r->x, hold->begin, hold->end, m->noise_x);
    if (!(s.drift <= rest_share * lab_span(r)) || !(x.drift <= rest_share * r->stroke))
      continue;
    at->s = s.level;
    at->x = x.level;
    at->run = hold->run;
    at->t = r->t[hold->end - 1];
    path->n++;
    off += lab_is_off_stops(m, at->x);
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

/* As many rows as it takes to see a small movement through the noise, if there are so many. */
static size_t rows_a_point(const lab_metrics_work *m)
{
  const double needed = m->least / (rest_share * m->record->stroke);
  return (size_t)fmin(fmax(ceil(needed * needed), 1), 1 + (double)(m->record->n / POINTS));
}

/* Static points of one kind or the other. */
static void choose_points(const lab_metrics_work *m, lab_path *path)
{
  const lab_record *r = m->record;
  const int set = lab_command_is_set(r->command);
  const double *signal = set ? r->u : r->p;
  const size_t each = rows_a_point(m);
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
