#include "instants.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "unknowns.h"

enum { GROUPS = 8 }; /* instants that stand so many apart are moved together */

static const double died_out = 1e-3; /* share of the change that may be left where the next instant is moved */

/* The instants of a run and what is predicted about them. */
typedef struct scene {
  const lab_unknowns *u;
  const double *theta;
  int run, n;
  int of[LAB_FIT_MAX]; /* unknowns, in the order of time */
  size_t offset;       /* of the run's residuals */
  double *errors;      /* of the run, not weighted */
} scene;

static size_t size_of(const lab_run *x)
{
  return x->n * (size_t)x->n_channels;
}

/* The first row that instant k can change; the end of the run behind the last. */
static size_t row_of(const scene *s, int k)
{
  const lab_run *x = &s->u->run[s->run];
  const double *t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  size_t low = 0, high = x->n;
  double from;
  int at;
  if (k >= s->n)
    return x->n;
  at = s->u->unknown[s->of[k]].index;
  from = x->inputs.schedule.t[at + 1] - x->bracket[at];
  while (low < high) {
    const size_t middle = (low + high) / 2;
    if (t[middle] < from)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

static double energy(const lab_run *x, const double *change, size_t from, size_t to)
{
  double sum = 0;
  int c;
  for (c = 0; c < x->n_channels; c++)
    sum += lab_dot(change + (size_t)c * x->n + from, change + (size_t)c * x->n + from, to - from);
  return sum;
}

/* Whether the change by instant k dies out before the next one of its group. */
static int dies_out(const scene *s, int k, const double *change)
{
  const lab_run *x = &s->u->run[s->run];
  const size_t from = row_of(s, k), last = row_of(s, k + GROUPS - 1), to = row_of(s, k + GROUPS);
  return to == x->n || energy(x, change, last, to) <= died_out * energy(x, change, from, to);
}

/* The column of instant k from the rows that are its own. */
static void take_column(const scene *s, int k, const double *change, double *column)
{
  const lab_run *x = &s->u->run[s->run];
  const size_t from = row_of(s, k), to = row_of(s, k + GROUPS);
  const double step = lab_unknowns_slope_step(s->u, s->theta, s->of[k]);
  size_t i;
  int c;
  memset(column, 0, s->u->m * sizeof *column);
  for (c = 0; c < x->n_channels; c++)
    for (i = from; i < to; i++)
      column[s->offset + (size_t)c * x->n + i] = change[(size_t)c * x->n + i] / step;
  lab_unknowns_weigh(s->u, s->run, column + s->offset);
  lab_unknowns_slope_of_prior(s->u, s->of[k], column);
}

/* Move every instant of a group. What does not die out is in the rows of the next one too.
 * In:  room  for the errors of the run */
static void move_group(const scene *s, int group, double *room, double *J, char *done)
{
  double at[LAB_FIT_MAX];
  lab_error ignored; /* each is tried by itself */
  size_t i;
  int k, alone = 1;
  memcpy(at, s->theta, (size_t)s->u->n * sizeof *at);
  for (k = group; k < s->n; k += GROUPS)
    at[s->of[k]] += lab_unknowns_slope_step(s->u, s->theta, s->of[k]);
  if (lab_unknowns_errors_of(s->u, at, s->run, room, &ignored))
    return;
  for (i = 0; i < size_of(&s->u->run[s->run]); i++)
    room[i] -= s->errors[i];
  for (k = group; k < s->n; k += GROUPS) {
    const int was_alone = alone;
    alone = dies_out(s, k, room);
    done[s->of[k]] = (char)(was_alone && alone);
    if (done[s->of[k]])
      take_column(s, k, room, J + (size_t)s->of[k] * s->u->m);
  }
}

static void find_instants(scene *s)
{
  int j;
  for (s->n = j = 0; j < s->u->n; j++) {
    const lab_unknown *x = &s->u->unknown[j];
    if (x->kind == LAB_UNKNOWN_INSTANT && x->run == s->run && x->index != LAB_ALL_INSTANTS)
      s->of[s->n++] = j;
  }
}

/* Whether most instants of the first group were had. */
static int pays(const scene *s, const char *done)
{
  int k, n = 0, had = 0;
  for (k = 0; k < s->n; k += GROUPS, n++)
    had += done[s->of[k]] != 0;
  return 2 * had > n;
}

/* The instants of a run, if they are so many that it pays. */
static int slopes_of_run(scene *s, double *J, char *done, lab_error *error)
{
  const size_t size = size_of(&s->u->run[s->run]);
  double *room;
  int g, status = LAB_OK;
  find_instants(s);
  if (s->n <= 2 * GROUPS)
    return LAB_OK;
  if (!(room = malloc((GROUPS + 1) * size * sizeof *room)))
    return lab_fail_memory(error, "slopes");
  s->errors = room + GROUPS * size;
  status = lab_unknowns_errors_of(s->u, s->theta, s->run, s->errors, error);
  if (status == LAB_OK)
    move_group(s, 0, room, J, done);
#pragma omp parallel for schedule(dynamic)
  for (g = 1; g < (pays(s, done) ? GROUPS : 1); g++)
    move_group(s, g, room + (size_t)g * size, J, done);
  free(room);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

int lab_instants_slopes(void *context, const double *theta, double *J, char *done, lab_error *error)
{
  const lab_unknowns *u = context;
  scene s = {.u = u, .theta = theta};
  int status = LAB_OK;
  for (s.run = 0; s.run < u->n_runs && status == LAB_OK && !u->window && !u->nuisance; s.run++) {
    status = slopes_of_run(&s, J, done, error);
    s.offset += size_of(&u->run[s.run]);
  }
  return status;
}
