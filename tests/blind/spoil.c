#include "spoil.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../../apps/lab/base/outfile.h"

/* ---- The run ---- */

/* A ramp is a staircase with a step a millisecond, the positioner's cycle: coarser steps would each be a kick to its
 * derivative, which no row of the log shows. It ends exactly, lest it pass a cut-off by rounding. */
static const double stair = 1e-3;

static size_t stairs_of(const blind_move *m)
{
  return m->ramp > stair ? (size_t)(m->ramp / stair) : 1;
}

static size_t add_move(const blind_move *m, double from, double *t, double *u)
{
  const size_t stairs = stairs_of(m);
  size_t i;
  for (i = 0; i < stairs; i++) {
    t[i] = m->t + m->ramp * (double)i / (double)stairs;
    u[i] = i + 1 < stairs ? from + (m->to - from) * (double)(i + 1) / (double)stairs : m->to;
  }
  return stairs;
}

/* The moves of a run as steps of the command.  Out: course  its t_cmd is to be freed, and keeps u_cmd */
static int add_moves(const blind_recorded *r, second_course *course, lab_error *error)
{
  double *t, *u, from = 0;
  size_t n = 0;
  int i;
  for (i = 0; i < r->n_moves; i++)
    n += stairs_of(&r->move[i]);
  t = malloc((2 * n + 1) * sizeof *t);
  if (!t)
    return lab_fail_memory(error, "a course");
  u = t + n;
  for (i = 0; i < r->n_moves; i++) {
    course->n += add_move(&r->move[i], from, t + course->n, u + course->n);
    from = r->move[i].to;
  }
  course->t_cmd = t;
  course->u_cmd = u;
  return LAB_OK;
}

/* Command or set position at t, as it is meant. */
static double meant(const blind_recorded *r, double t)
{
  double from = 0, to = 0;
  int i;
  for (i = 0; i < r->n_moves && r->move[i].t <= t; i++) {
    const double since = t - r->move[i].t;
    from = to;
    to = r->move[i].to;
    if (since < r->move[i].ramp)
      return from + (to - from) * since / r->move[i].ramp;
  }
  return to;
}

static int open_fine(const blind_recorded *r, blind_fine *f, lab_error *error)
{
  const double longest = 1e-3;
  f->spacing = r->spacing / ceil(r->spacing / longest - 1e-9);
  return blind_rows_open(r->end, f->spacing, &f->rows, error);
}

int blind_run_recorded(const blind_recorded *r, const second_rig *first, const second_rig *later, double step,
                       blind_fine *f, lab_error *error)
{
  static const int halvings = 4;
  second_course course = {.change = r->onset};
  second_log log;
  second_audit audit;
  int i, done = 0;
  if (add_moves(r, &course, error))
    return error->status;
  if (open_fine(r, f, error)) {
    free((double *)course.t_cmd);
    return error->status;
  }
  log = blind_rows_log(&f->rows);
  course.positioner = r->loop == BLIND_OPEN ? NULL : &r->positioner;
  for (i = 0; i <= halvings && !done; i++, step /= 2) {
    const second_rig a = blind_silent(first, step), b = blind_silent(later, step);
    course.later = isnan(r->onset) ? NULL : &b;
    done = !second_follow(&a, &course, r->end, f->spacing, &log, &audit) && audit.forced == 0;
  }
  free((double *)course.t_cmd);
  if (done)
    return LAB_OK;
  blind_fine_free(f);
  return lab_fail(error, LAB_NUMERIC, "the virtual rig cannot follow its events, whatever the step");
}

void blind_fine_free(blind_fine *f)
{
  blind_rows_free(&f->rows);
}

/* ---- Sensors ---- */

/* First-order filter of samples between which the signal goes by straight lines: exact. */
static void filter(double *y, size_t n, double spacing, double lag)
{
  const double keep = exp(-spacing / lag), lead = lag / spacing * (1 - keep);
  double before = y[0], state = y[0];
  size_t i;
  for (i = 1; i < n; i++) {
    const double now = y[i];
    state = keep * state + (lead - keep) * before + (1 - lead) * now;
    before = now;
    y[i] = state;
  }
}

double blind_at(const double *y, size_t n, double spacing, double t)
{
  const double at = fmin(fmax(t / spacing, 0), (double)(n - 1));
  const size_t i = (size_t)at < n - 1 ? (size_t)at : n - 2;
  return y[i] + (at - (double)i) * (y[i + 1] - y[i]);
}

static double rounded(double y, double quantum)
{
  return quantum > 0 ? floor(y / quantum + 0.5) * quantum : y;
}

/* Noise, white and with memory, hum, drift and the converter's steps, on top of what a sensor shows at its instants.
 * In:  span  supply or stroke, a converter's range is 125 % of it */
static void soil(const blind_recorded *r, int sensor, double span, double noise, blind_chance *c, blind_log *l,
                 double *y)
{
  const double keep = exp(-r->spacing / r->memory), phase = blind_uniform(c, 0, 6.283185307179586);
  double slow = blind_normal(c);
  size_t i;
  for (i = 0; i < l->n; i++) {
    y[i] += noise * (blind_normal(c) + r->colour[sensor] * slow);
    y[i] += span * (r->hum[sensor] * sin(6.283185307179586 * r->mains * l->at[i] + phase) +
                    r->drift[sensor] * l->at[i] / r->end);
    y[i] = rounded(y[i], 1.25 * span / (double)(1L << r->bits));
    slow = keep * slow + sqrt(1 - keep * keep) * blind_normal(c);
  }
}

/* ---- Logger ---- */

/* Samples of a sensor at the instants of the log. */
static int take(const blind_fine *f, const double *from, double lag, blind_log *l, double *to, lab_error *error)
{
  const size_t n = f->rows.n;
  double *y = malloc(n * sizeof *y);
  size_t i;
  if (!y)
    return lab_fail_memory(error, "a sensor");
  memcpy(y, from, n * sizeof *y);
  if (lag > 0)
    filter(y, n, f->spacing, lag);
  for (i = 0; i < l->n; i++)
    to[i] = blind_at(y, n, f->spacing, l->at[i]);
  free(y);
  return LAB_OK;
}

static void clock_in(const blind_recorded *r, blind_chance *c, blind_log *l)
{
  size_t i;
  for (i = 0; i < l->n; i++) {
    const double t = (double)i * r->spacing;
    l->at[i] = i ? t + r->jitter * fmax(-2.4, fmin(2.4, blind_normal(c))) : 0;
    l->t[i] = rounded(t, r->rounding);
  }
}

/* The command as the logger shows it: what was sent last. */
static void command_in(const blind_recorded *r, const blind_fine *f, blind_log *l)
{
  size_t i;
  for (i = 0; i < l->n; i++) {
    const double wanted = meant(r, l->at[i]);
    const size_t at = (size_t)fmin(l->at[i] / f->spacing + 1e-9, (double)(f->rows.n - 1));
    l->sp[i] = wanted;
    l->u[i] = r->loop == BLIND_OPEN ? wanted : f->rows.u[at];
  }
}

/* Empty fields of both sensors, and rows that are not there, one of them long. */
static void drop_out(const blind_recorded *r, blind_chance *c, blind_log *l)
{
  double *const column[] = {l->t, l->at, l->u, l->sp, l->p, l->x, l->T};
  size_t i, kept = 0;
  int k;
  for (i = 0; i < l->n; i++) {
    const double row = blind_uniform(c, 0, 1), p = blind_uniform(c, 0, 1), x = blind_uniform(c, 0, 1);
    const int in_gap = l->at[i] > r->gap_at && l->at[i] < r->gap_at + r->gap;
    if (i > 0 && (row < r->lost / 2 || in_gap))
      continue;
    for (k = 0; k < 7; k++)
      column[k][kept] = column[k][i];
    if (p < r->lost)
      l->p[kept] = NAN;
    if (x < r->lost)
      l->x[kept] = NAN;
    kept++;
  }
  l->n = kept;
}

int blind_spoil(const blind_recorded *r, const blind_fine *f, blind_log *l, lab_error *error)
{
  const second_rig *g = &r->t.declared;
  blind_chance c = blind_chance_of(r->seed, 0);
  const double as_it_is = 0;
  size_t i;
  memset(l, 0, sizeof *l);
  l->n = second_samples(r->end, r->spacing);
  l->t = malloc(7 * l->n * sizeof *l->t);
  if (!l->t)
    return lab_fail_memory(error, "a log");
  l->at = l->t + l->n;
  l->u = l->at + l->n;
  l->sp = l->u + l->n;
  l->p = l->sp + l->n;
  l->x = l->p + l->n;
  l->T = l->x + l->n;
  clock_in(r, &c, l);
  command_in(r, f, l);
  if (take(f, f->rows.p, r->filter[0], l, l->p, error) || take(f, f->rows.x, r->filter[1], l, l->x, error) ||
      take(f, f->rows.T, as_it_is, l, l->T, error)) {
    blind_log_free(l);
    return error->status;
  }
  soil(r, 0, g->supply, g->pressure_noise, &c, l, l->p);
  soil(r, 1, g->stroke, g->position_noise, &c, l, l->x);
  for (i = 0; i < l->n; i++)
    l->T[i] += g->temperature_noise * blind_normal(&c);
  drop_out(r, &c, l);
  return LAB_OK;
}

void blind_log_free(blind_log *l)
{
  free(l->t);
  memset(l, 0, sizeof *l);
}
