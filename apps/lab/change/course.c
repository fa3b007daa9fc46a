#include "course.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../base/clock.h"

enum { STEPS = 8, PLACES = 16, LEVELS = 4 }; /* steps at most; rows and levels at which one is tried */
static const double much = 0.1;              /* share of what is left that a step has to explain */
static const double gross = 0.1;             /* share of the excess of chi-square that a failure leaves, at most */
static const double failing = 0.5; /* share of the supply whose loss is a failure; and of the loss, while it lasts */

/* A model whose last unknowns are steps. */
typedef struct follower {
  lab_unknowns u;
  int run, first; /* place of the first step */
  double supply;  /* [Pa] without the steps */
  double chi2;    /* of the run, and of what is known of the steps */
} follower;

/* One way to go on: a step that is cut at a row, or all of it at row 0, and the level of its one half. */
typedef struct option {
  int step, late; /* late: of the half after the row */
  size_t row;
  double level;
} option;

static const double *times_of(const follower *f, size_t *n)
{
  const lab_run *x = &f->u.run[f->run];
  *n = x->n;
  return x->log->value[LAB_CHANNEL_TIME] + x->first;
}

/* Chi-square of the run; as good as none where the model fails.  Returns: LAB_OK, LAB_WORLD */
static int judge(follower *f, lab_error *error)
{
  double theta[LAB_FIT_MAX], *r = malloc((f->u.m + 1) * sizeof *r);
  const lab_run *x = &f->u.run[f->run];
  const size_t n = x->n * (size_t)x->n_channels;
  int status = r ? LAB_OK : lab_fail_memory(error, "residuals");
  lab_unknowns_values(&f->u, theta);
  if (status == LAB_OK)
    status = lab_unknowns_residuals_of(&f->u, theta, f->first, r, error);
  f->chi2 = status == LAB_OK ? lab_dot(r + f->u.n_data - n, r + f->u.n_data - n, n) : HUGE_VAL;
  free(r);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Take an option.  Returns: as judge */
static int apply(const option *o, follower *f, lab_error *error)
{
  lab_unknown *x = &f->u.unknown[o->step], *y = x;
  size_t n;
  const double *t = times_of(f, &n);
  if (o->row > 0) {
    y = &f->u.unknown[f->u.n++];
    *y = *x;
    y->from = x->to = t[o->row];
    lab_unknowns_view(&f->u, 0);
  }
  (o->late ? y : x)->value = o->level;
  return judge(f, error);
}

/* Chi-square with an option; as good as none where it cannot be. */
static double chi2_with(const follower *f, const option *o, lab_error *all)
{
  const lab_unknown *x = &f->u.unknown[o->step];
  lab_error error = {LAB_OK, ""};
  double chi2 = HUGE_VAL;
  size_t n;
  const double *t = times_of(f, &n);
  follower *g;
  if (o->row >= n || o->level > 0 || o->level < -f->supply ||
      (o->row > 0 && !(x->from < t[o->row] && t[o->row] < x->to)))
    return HUGE_VAL;
  g = malloc(sizeof *g);
  if (!g)
    lab_fail_memory(&error, "a step");
  if (g) {
    *g = *f;
    if (apply(o, g, &error) == LAB_OK)
      chi2 = g->chi2;
  }
  lab_fail_together(all, &error);
  free(g);
  return chi2;
}

/* The best of all halves of all steps at all levels. */
static double choose(const follower *f, option *best, lab_error *error)
{
  const int n_steps = f->u.n - f->first, n = n_steps * PLACES * 2 * LEVELS;
  size_t rows;
  double least = HUGE_VAL;
  int i, at = n; /* of equal ones the first, whichever thread is faster */
  times_of(f, &rows);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    option o = {f->first + i / (2 * LEVELS * PLACES), i / LEVELS % 2,
                rows * (size_t)(i / (2 * LEVELS) % PLACES) / PLACES, -f->supply * (i % LEVELS) / (LEVELS - 1)};
    const double chi2 = o.row > 0 || o.late ? chi2_with(f, &o, error) : HUGE_VAL;
#pragma omp critical
    if (chi2 < least || (chi2 == least && i < at)) {
      least = chi2;
      at = i;
      *best = o;
    }
  }
  return least;
}

/* Move row and level to where chi-square is least. */
static double refine(const follower *f, option *o, double least, lab_error *error)
{
  static const int side[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
  double by_level = f->supply / (2 * LEVELS);
  size_t rows, by_row;
  int k;
  times_of(f, &rows);
  for (by_row = (rows + 2 * PLACES - 1) / (2 * PLACES); by_row > 0;) {
    option best = *o;
    double before = least;
    for (k = 0; k < 4; k++) {
      option at = *o;
      double chi2;
      if (side[k][0] != 0 && (o->row == 0 || o->row + by_row >= rows || o->row <= by_row))
        continue;
      at.row += side[k][0] > 0 ? by_row : side[k][0] < 0 ? -by_row : 0;
      at.level += side[k][1] * by_level;
      chi2 = chi2_with(f, &at, error);
      if (chi2 < least) {
        least = chi2;
        best = at;
      }
    }
    *o = best;
    if (least < before)
      continue;
    by_row /= 2;
    by_level /= 2;
  }
  return least;
}

/* Steps as long as they explain much.  Out: course->n_free */
static int take_steps(follower *f, lab_course *course, lab_error *error)
{
  const size_t expected = f->u.run[f->run].n * (size_t)f->u.run[f->run].n_channels;
  error->status = LAB_OK;
  while (f->u.n - f->first < STEPS && f->u.n < LAB_FIT_MAX && f->chi2 > (double)expected &&
         !lab_cpu_is_spent(f->u.until)) {
    option best;
    double least = choose(f, &best, error);
    if (isfinite(least))
      least = refine(f, &best, least, error);
    if (error->status != LAB_OK)
      return error->status;
    if (!(f->chi2 - least > much * (f->chi2 - (double)expected)))
      break;
    course->n_free += best.row > 0 ? 2 : 1;
    if (apply(&best, f, error))
      return error->status;
  }
  return LAB_OK;
}

static double lowest(const follower *f)
{
  double least = 0;
  int j;
  for (j = f->first; j < f->u.n; j++)
    least = fmin(least, f->u.unknown[j].value);
  return least;
}

static int fails(const follower *f, int step)
{
  return f->u.unknown[step].value < failing * lowest(f);
}

/* A boundary between two steps, tried at one row after the other. */
typedef struct boundary {
  follower f;
  int before, after;
} boundary;

static int look(void *context, size_t row, double *chi2, lab_error *error)
{
  boundary *b = context;
  size_t n;
  const double at = times_of(&b->f, &n)[row];
  *chi2 = HUGE_VAL;
  if (!(b->f.u.unknown[b->before].from < at && at < b->f.u.unknown[b->after].to))
    return LAB_OK;
  b->f.u.unknown[b->before].to = b->f.u.unknown[b->after].from = at;
  if (judge(&b->f, error))
    return error->status;
  *chi2 = b->f.chi2;
  return LAB_OK;
}

static size_t row_at(const double *t, size_t n, double at)
{
  size_t i = 0;
  while (i + 1 < n && t[i] < at)
    i++;
  return i;
}

/* The instant between two steps, with its interval.  Out: low, high  rows */
static int place(const follower *f, int before, int after, lab_onset *onset, size_t *low, size_t *high,
                 lab_error *error)
{
  boundary *b = malloc(sizeof *b);
  size_t n;
  const double *t = times_of(f, &n);
  int status = b ? LAB_OK : lab_fail_memory(error, "an onset");
  if (b) {
    const lab_onset_profile profile = {look, b, n};
    b->f = *f;
    b->before = before;
    b->after = after;
    status = lab_onset_enclose(&profile, t, row_at(t, n, f->u.unknown[after].from), f->chi2, low, high, onset, error);
  }
  free(b);
  return status;
}

/* The step that fails first, or last; -1 if none does. */
static int outermost(const follower *f, int last)
{
  int j, at = -1;
  for (j = f->first; j < f->u.n; j++)
    if (fails(f, j) && (at < 0 || (f->u.unknown[j].from > f->u.unknown[at].from) == last))
      at = j;
  return at;
}

static int neighbour(const follower *f, int step, int later)
{
  int j;
  for (j = f->first; j < f->u.n; j++)
    if (later ? f->u.unknown[j].from == f->u.unknown[step].to : f->u.unknown[j].to == f->u.unknown[step].from)
      return j;
  return -1;
}

static int find_begin(const follower *f, lab_course *course, lab_error *error)
{
  const int step = outermost(f, 0), before = neighbour(f, step, 0);
  size_t low, high;
  return before < 0 ? LAB_OK : place(f, before, step, &course->begin, &low, &high, error);
}

/* Where it does not come back by itself, as soon as the log allows that it has. */
static int find_end(follower *f, lab_course *course, lab_error *error)
{
  const int step = outermost(f, 1);
  int after = neighbour(f, step, 1), status;
  size_t n, low, high;
  const double *t = times_of(f, &n);
  const int open = after < 0;
  if (open) {
    option back = {step, 1, n - 1, 0};
    if (f->u.n == LAB_FIT_MAX)
      return LAB_OK;
    if (apply(&back, f, error))
      return error->status;
    after = f->u.n - 1;
  }
  status = place(f, step, after, &course->end, &low, &high, error);
  if (status == LAB_OK && high + 1 >= n) {
    f->u.unknown[step].to = f->u.unknown[after].from = course->end.t = t[low];
    course->end.known = low + 1 < n;
  }
  return status;
}

static int describe(follower *f, lab_course *course, lab_error *error)
{
  if (judge(f, error) || find_begin(f, course, error) || find_end(f, course, error))
    return error->status;
  return LAB_OK;
}

/* The run with a step that is none. */
static int begin(const lab_unknowns *u, int run, follower *f, lab_error *error)
{
  int j;
  f->u = *u;
  f->run = run;
  f->first = u->n;
  f->supply = (double)u->rig.params.supply_pressure;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_CHANGE && u->unknown[j].index == PNEU_PARAM_supply_pressure)
      f->supply += u->unknown[j].value;
  if (lab_unknowns_add_change(&f->u, PNEU_PARAM_supply_pressure, run, 0, error))
    return error->status;
  f->u.unknown[f->first].upper = 0;
  f->u.unknown[f->first].spread = f->supply; /* the log does not see it while there is enough of it */
  lab_unknowns_view(&f->u, 0);
  return judge(f, error);
}

/* Whether what the steps say is a failure: the supply is mostly gone, and that explains nearly all that was left. */
static int is_failure(const follower *f, double before)
{
  const double expected = (double)(f->u.run[f->run].n * (size_t)f->u.run[f->run].n_channels);
  return lowest(f) < -failing * f->supply && f->chi2 - expected < gross * (before - expected);
}

int lab_course_follow(lab_unknowns *u, int run, lab_course *course, lab_error *error)
{
  follower *f = calloc(1, sizeof *f);
  int status = f ? begin(u, run, f, error) : lab_fail_memory(error, "a course");
  const double before = f ? f->chi2 : 0;
  memset(course, 0, sizeof *course);
  if (status == LAB_OK)
    status = take_steps(f, course, error);
  if (status == LAB_OK && !is_failure(f, before))
    course->n_free = 0;
  if (status == LAB_OK && course->n_free > 0)
    status = lab_unknowns_fit(&f->u, LAB_ROUNDS_ALL, NULL, error);
  if (status == LAB_OK && lowest(f) == 0)
    course->n_free = 0;
  if (status == LAB_OK && course->n_free > 0)
    status = describe(f, course, error);
  if (status == LAB_OK && course->n_free > 0)
    *u = f->u;
  free(f);
  return status;
}
