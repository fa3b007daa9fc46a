#include "variation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "handover.h"
#include "late.h"

enum { S = PNEU_STATE_MAX, STAGES = 3, N = STAGES * S, SIDES = 2 * S };

/* Lobatto IIIC; the last row is that of the result. */
static const double butcher[STAGES][STAGES] = {
    {1.0 / 6, -1.0 / 3, 1.0 / 6}, {1.0 / 6, 5.0 / 12, -1.0 / 12}, {1.0 / 6, 2.0 / 3, 1.0 / 6}};

enum { EVENTS = 10 }; /* in one row of the schedule: a stem that takes more slips has no slopes */

static const double nothing = 1e-7; /* of the largest so far: a difference that has died out */
static const double fine = 0.005;   /* of it: what a part of a step may be off by on its way */
enum { SHORTENED = 6 };             /* times that parts of one step are, at most: what jumps is not seen closer */

/* One of the runs nearby. Differences have an entry for each of a moving stem's packed vector, whatever the mode. */
typedef struct nearby {
  lab_late late;
  lab_response *change;
  const pneu_model *model; /* that acts */
  pneu_input input;        /* at the beginning of its row */
  double lead;             /* [s] by which its row has lasted longer than the run's */
  int is_off;              /* it cannot be followed */
  int is_same;             /* nothing differs */
  int knows_start;         /* g[0] is there */
  double largest;          /* difference so far, of full scale */
  pneu_real d[STAGES][S];  /* at the start, middle and end of the part of the step */
  pneu_real g[STAGES][S];
  pneu_shown excess[STAGES]; /* of the sensors */
} nearby;

struct lab_variations {
  int n;
  nearby *of;
  const lab_schedule *acts;
  const pneu_model *const *rows;
  const pneu_model *model;
  pneu_input input; /* at the beginning of the row */
  double theta;     /* of the present look, in the part of the step */
  int events;       /* of the stem, in the row */
  int side;         /* of a dead band */
  int is_lost;      /* none can be followed */
  double length;    /* [s] of a part of a step that follows what changes; a step as a rule is shorter */
  /* the part of a step: */
  double from, to; /* shares of the step */
  int shortened;   /* times in this step */
  pneu_state state[STAGES];
  pneu_shown shown[STAGES];
  int is_interpolated; /* samples are taken between the stages */
  pneu_input at[STAGES];
  pneu_real y[STAGES][S], f[STAGES][S], jac[STAGES][S][S];
  double matrix[N][N];                  /* of the linear equations of a step, transposed */
  double weight[N][SIDES];              /* of the stages, at the end and in the middle, transposed */
  pneu_real share[2][1 + STAGES][S][S]; /* of the start and of each g, at the end and in the middle, transposed */
};

/* ---- Differences of states ---- */

static void add(const pneu_model *m, const pneu_real *d, pneu_state *s)
{
  int i, k = 0;
  s->p += d[k++];
  if (m->thermal)
    s->T += d[k++];
  for (i = 0; i < m->n_extra; i++)
    s->extra[i] += d[k++];
  s->x += d[k++];
  s->v += d[k];
}

static void subtract(const pneu_model *m, const pneu_state *a, const pneu_state *b, pneu_real *d)
{
  int i, k = 0;
  d[k++] = a->p - b->p;
  if (m->thermal)
    d[k++] = a->T - b->T;
  for (i = 0; i < m->n_extra; i++)
    d[k++] = a->extra[i] - b->extra[i];
  d[k++] = a->x - b->x;
  d[k] = a->v - b->v;
}

static pneu_state displaced(const pneu_model *m, const pneu_state *s, const pneu_real *d)
{
  pneu_state moved = *s;
  add(m, d, &moved);
  return moved;
}

/* What goes on for dt [s] at these rates, of the entries that the mode has. */
static void drift(const pneu_model *m, int mode, const pneu_real *rate, double dt, pneu_state *s)
{
  pneu_real d[S] = {0};
  const int n = pneu_dimension(m, mode);
  int i;
  for (i = 0; i < n; i++)
    d[i] = rate[i] * dt;
  add(m, d, s);
}

static int rates_at(const pneu_model *m, const pneu_state *s, const pneu_input *input, pneu_real *f)
{
  pneu_real y[S];
  pneu_pack(m, s, y);
  return pneu_rhs(m, s, input, y, f);
}

/* ---- The equations of a step ---- */

static void exchange(double *a, double *b, int from, int n)
{
  int j;
  for (j = from; j < n; j++) {
    const double keep = a[j];
    a[j] = b[j];
    b[j] = keep;
  }
}

/* a -= share * b */
static void take_share(double *restrict a, const double *restrict b, double share, int from, int n)
{
  int j;
#pragma omp simd
  for (j = from; j < n; j++)
    a[j] -= share * b[j];
}

/* Gauss with partial pivoting: b, of n_b columns, becomes the solution of a x = b. */
static int solve(int n, double (*a)[N], int n_b, double (*b)[SIDES])
{
  int i, j, k;
  for (k = 0; k < n; k++) {
    int best = k;
    for (i = k + 1; i < n; i++)
      best = fabs(a[i][k]) > fabs(a[best][k]) ? i : best;
    if (!(fabs(a[best][k]) > 0))
      return -1;
    if (best != k) {
      exchange(a[k], a[best], k, n);
      exchange(b[k], b[best], 0, n_b);
    }
    for (i = k + 1; i < n; i++) {
      const double share = a[i][k] / a[k][k];
      if (share != 0) {
        take_share(a[i], a[k], share, k + 1, n);
        take_share(b[i], b[k], share, 0, n_b);
      }
    }
  }
  for (i = n - 1; i >= 0; i--) {
    for (j = i + 1; j < n; j++)
      if (a[i][j] != 0)
        take_share(b[i], b[j], a[i][j], 0, n_b);
    for (j = 0; j < n_b; j++)
      b[i][j] /= a[i][i];
  }
  return 0;
}

/* What the difference at the start, and each stage's g, have in that at one place of a step.
 * In:      weight  of the stages: n columns of the inverse of the equations, transposed, from column `at` on */
static void find_shares(int n, double h, double (*weight)[SIDES], int at, pneu_real (*share)[S][S])
{
  int i, j, s, t;
  for (i = 0; i < n; i++)
    for (j = 0; j < n; j++) {
      double start = 0, stage[STAGES] = {0};
      for (s = 0; s < STAGES; s++) {
        const double w = weight[s * n + j][at + i];
        start += w;
        for (t = 0; t < STAGES; t++)
          stage[t] += butcher[s][t] * w;
      }
      share[0][j][i] = start;
      for (t = 0; t < STAGES; t++)
        share[t + 1][j][i] = h * stage[t];
    }
}

/* The equations of a part of a step, h [s] long, solved for its end and its middle.  Returns: 0, -1 if they cannot be
 */
static int solve_part(struct lab_variations *v, int n, double h)
{
  int s, t, i, j;
  for (s = 0; s < STAGES; s++)
    for (i = 0; i < n; i++)
      for (t = 0; t < STAGES; t++)
        for (j = 0; j < n; j++)
          v->matrix[t * n + j][s * n + i] = (s == t && i == j) - h * butcher[s][t] * v->jac[t][i][j];
  for (i = 0; i < STAGES * n; i++)
    memset(v->weight[i], 0, sizeof v->weight[i]);
  for (i = 0; i < n; i++)
    v->weight[2 * n + i][i] = v->weight[n + i][n + i] = 1; /* the end, the middle */
  if (solve(STAGES * n, v->matrix, 2 * n, v->weight))
    return -1;
  find_shares(n, h, v->weight, 0, v->share[0]);
  find_shares(n, h, v->weight, n, v->share[1]);
  return 0;
}

/* ---- Through a step ---- */

static int n_of(const struct lab_variations *v)
{
  return pneu_dimension(v->model, v->state[0].mode);
}

/* What the other model adds to the rates at a stage, seen where the difference was at the start of the step: near equal
 * pressures or a stop the rates have a kink, and what follows the run has to be on the same side of its own.  Returns:
 * 0, -1 */
static int find_excess(const struct lab_variations *v, nearby *k, int stage)
{
  const int n = n_of(v);
  const pneu_state s = displaced(v->model, &v->state[stage], k->d[0]);
  pneu_input input = k->input;
  pneu_real y[S];
  int i, j;
  input.elapsed = v->at[stage].elapsed + k->lead;
  pneu_pack(k->model, &s, y);
  if (pneu_rhs(k->model, &s, &input, y, k->g[stage]) != PNEU_OK)
    return -1;
  for (i = 0; i < n; i++) {
    k->g[stage][i] -= v->f[stage][i];
    for (j = 0; j < n; j++)
      k->g[stage][i] -= v->jac[stage][i][j] * k->d[0][j];
  }
  return 0;
}

/* The difference in the middle of the step, or at its end. */
static void carry(pneu_real (*share)[S][S], int n, const nearby *k, pneu_real *to)
{
  const pneu_real *of[1 + STAGES] = {k->d[0], k->g[0], k->g[1], k->g[2]};
  pneu_real sum[S] = {0};
  int i, j, s;
  for (s = 0; s <= STAGES; s++)
    for (j = 0; j < n; j++)
#pragma omp simd
      for (i = 0; i < n; i++)
        sum[i] += share[s][j][i] * of[s][j];
  memcpy(to, k->d[0], sizeof k->d[0]);
  memcpy(to, sum, (size_t)n * sizeof *to);
}

/* Rates, states and Jacobians of the run at the stages of a part of its step.  Returns: 0, -1 */
static int look_at_part(struct lab_variations *v, const pneu_step_view *view)
{
  const double theta[STAGES] = {v->from, (v->from + v->to) / 2, v->to};
  int s;
  for (s = 0; s < STAGES; s++) {
    v->at[s] = *view->input;
    v->at[s].elapsed += theta[s] * view->h;
    pneu_dense(view, theta[s], &v->state[s]);
    pneu_pack(view->model, &v->state[s], v->y[s]);
    if (theta[s] == 0) {
      memcpy(v->f[s], view->work->f0, sizeof v->f[s]);
      memcpy(v->jac[s], view->work->jac, sizeof v->jac[s]);
    } else if (pneu_rhs(view->model, &v->state[s], &v->at[s], v->y[s], v->f[s]) != PNEU_OK ||
               pneu_jacobian(view->model, &v->state[s], &v->at[s], v->y[s], v->f[s], v->jac[s]) != PNEU_OK)
      return -1;
  }
  return solve_part(v, n_of(v), (v->to - v->from) * view->h);
}

/* Size of a difference, of full scale. */
static double size_of(const pneu_model *m, const pneu_real *d)
{
  pneu_real scale[S];
  double size = 0;
  int i;
  pneu_scales(m, scale);
  for (i = 0; i < m->n_gas + 2; i++)
    size = fmax(size, fabs(d[i]) / scale[i]);
  return size;
}

/* By how much the first stage of a part, h [s] long, is not the start, over what it may be. */
static double error_of(const struct lab_variations *v, const nearby *k, double h)
{
  static const double weight[STAGES] = {1, -2, 1}; /* sixths of the rates */
  const int n = n_of(v);
  const double largest = fmax(k->largest, fmax(size_of(v->model, k->d[0]), size_of(v->model, k->d[2])));
  pneu_real error[S] = {0};
  int s, i, j;
  for (s = 0; s < STAGES; s++)
    for (i = 0; i < n; i++) {
      double rate = k->g[s][i];
      for (j = 0; j < n; j++)
        rate += v->jac[s][i][j] * k->d[s][j];
      error[i] += h / 6 * weight[s] * rate;
    }
  return largest > 0 ? size_of(v->model, error) / (fine * largest) : 0;
}

/* One nearby run passes a part of a step, h [s] long.  Returns: its error, over what it may be */
static double pass_part(struct lab_variations *v, nearby *k, double h)
{
  k->is_off = (!k->knows_start && find_excess(v, k, 0)) || find_excess(v, k, 1) || find_excess(v, k, 2);
  k->knows_start = 1;
  if (k->is_off)
    return 0;
  carry(v->share[0], n_of(v), k, k->d[2]);
  carry(v->share[1], n_of(v), k, k->d[1]);
  return error_of(v, k, h);
}

static int is_moved(const nearby *k)
{
  return !k->is_off && !k->is_same;
}

/* A value inside a part, on the parabola through its values at the stages. */
static double inside(double theta, double start, double middle, double end)
{
  return theta > 0
             ? (1 - theta) * (1 - 2 * theta) * start + 4 * theta * (1 - theta) * middle + theta * (2 * theta - 1) * end
             : start;
}

static void difference_at(const nearby *k, int n, double theta, pneu_real *d)
{
  int i;
  for (i = 0; i < n; i++)
    d[i] = inside(theta, k->d[0][i], k->d[1][i], k->d[2][i]);
}

/* What the sensors of a nearby run show beyond those of the run, which show this.  Returns: 0, -1 */
static int excess_shown(const struct lab_variations *v, const nearby *k, const pneu_state *state, double elapsed,
                        const pneu_real *d, const pneu_shown *shown, pneu_shown *excess)
{
  const pneu_state s = displaced(v->model, state, d);
  pneu_input own = k->input;
  own.elapsed = elapsed + k->lead;
  if (pneu_show(k->model, &s, &own, excess) != PNEU_OK)
    return -1;
  excess->pressure -= shown->pressure;
  excess->temperature -= shown->temperature;
  excess->position -= shown->position;
  excess->force -= shown->force;
  return 0;
}

/* The same at the stages of a step.  Returns: 0, -1 */
static int look_at_stages(const struct lab_variations *v, nearby *k)
{
  int s;
  for (s = 0; s < STAGES; s++)
    if (excess_shown(v, k, &v->state[s], v->at[s].elapsed, k->d[s], &v->shown[s], &k->excess[s]))
      return -1;
  return 0;
}

/* What samples in a step are interpolated between, where there are many. */
void lab_variations_expect(struct lab_variations *v, int samples)
{
  int i, s;
  v->is_interpolated = samples > STAGES && !v->is_lost;
  for (s = 0; s < STAGES && v->is_interpolated; s++)
    v->is_interpolated = pneu_show(v->model, &v->state[s], &v->at[s], &v->shown[s]) == PNEU_OK;
  for (i = 0; i < v->n && v->is_interpolated; i++)
    if (is_moved(&v->of[i]))
      v->of[i].is_off = look_at_stages(v, &v->of[i]) != 0;
}

/* ---- A step, in parts ---- */

/* Follow all to v->to.  Returns: the largest error over what it may be */
static double try_part(struct lab_variations *v, const pneu_step_view *view)
{
  const double h = (v->to - v->from) * view->h;
  double error = 0;
  int k;
  v->is_lost = look_at_part(v, view) != 0;
  for (k = 0; k < v->n && !v->is_lost; k++)
    if (is_moved(&v->of[k]))
      error = fmax(error, pass_part(v, &v->of[k], h));
  return error;
}

static int any_moved(const struct lab_variations *v)
{
  int k, any = 0;
  for (k = 0; k < v->n; k++)
    any |= is_moved(&v->of[k]);
  return any;
}

double lab_variations_step(struct lab_variations *v, const pneu_step_view *view, double from)
{
  double error, factor;
  v->from = from;
  v->to = 1;
  v->is_lost = v->is_lost || v->events > EVENTS;
  if (v->is_lost || !any_moved(v))
    return 1;
  if (from == 0)
    v->shortened = 0;
  for (;;) {
    v->to = fmin(1, from + v->length / view->h);
    error = try_part(v, view);
    factor = 0.9 / cbrt(error);
    if (!(error > 1) || v->shortened == SHORTENED)
      break;
    v->shortened++;
    v->length = (v->to - from) * view->h * fmax(factor, 0.1);
  }
  v->length = fmax(v->length, (v->to - from) * view->h * fmin(fmax(factor, 2), 5));
  return v->to;
}

void lab_variations_look(struct lab_variations *v, double theta)
{
  v->theta = v->to > v->from ? fmin((theta - v->from) / (v->to - v->from), 1) : 1;
}

/* Whether the nearby run is driven as the run is. */
static int is_driven_alike(const struct lab_variations *v, const nearby *k)
{
  const pneu_input *a = &k->input, *b = &v->input;
  return k->model == v->model && (k->lead == 0 || a->u_rate == 0) && a->u == b->u && a->u_rate == b->u_rate &&
         a->supply_pressure == b->supply_pressure && a->force == b->force && a->pressure_rate == b->pressure_rate &&
         a->position_rate == b->position_rate && a->set_position == b->set_position;
}

static void note_same(const struct lab_variations *v, nearby *k)
{
  k->is_same = is_driven_alike(v, k) && size_of(v->model, k->d[0]) <= nothing * k->largest;
  if (k->is_same)
    memset(k->d, 0, sizeof k->d);
}

void lab_variations_pass(struct lab_variations *v)
{
  int i;
  v->theta = 0;
  for (i = 0; i < v->n; i++) {
    nearby *k = &v->of[i];
    if (!is_moved(k))
      continue;
    memcpy(k->d[0], k->d[2], sizeof k->d[0]);
    memcpy(k->g[0], k->g[2], sizeof k->g[0]);
    k->largest = fmax(k->largest, size_of(v->model, k->d[0]));
    k->knows_start = 1;
    note_same(v, k);
  }
}

/* ---- Events ---- */

/* Which event of the stem has ended the step: if it slides the one that is nearer, at rest the stronger push. */
static int event_of(const struct lab_variations *v, const pneu_real *g, int n_events)
{
  const int mode = v->state[2].mode;
  if (n_events < 2)
    return 0;
  if (mode == PNEU_MODE_UP || mode == PNEU_MODE_DOWN)
    return fabs(g[1]) * v->model->scale[3] < fabs(g[0]) * v->model->scale[2];
  return g[1] > g[0];
}

/* Rate of an event's function along the run. */
static double rate_of_event(const struct lab_variations *v, int which, const pneu_real *g)
{
  static const double back = 1e-7; /* [s] */
  pneu_state s = v->state[2];
  pneu_input input = v->at[2];
  pneu_real y[S], before[PNEU_EVENT_MAX];
  drift(v->model, s.mode, v->f[2], -back, &s);
  input.elapsed -= back;
  pneu_pack(v->model, &s, y);
  return pneu_events(v->model, &s, &input, y, before) > which ? (g[which] - before[which]) / back : 0;
}

/* One nearby run passes the event.  In: rate of the event's function; after, f  the run's state and rates behind it */
static int pass_event(const struct lab_variations *v, nearby *k, int which, const pneu_real *g, double rate,
                      const pneu_state *after, const pneu_real *f)
{
  pneu_state s = displaced(v->model, &v->state[2], k->d[0]), end = *after;
  pneu_input input = k->input;
  pneu_real y[S], own[PNEU_EVENT_MAX];
  double late;
  input.elapsed = v->at[2].elapsed + k->lead;
  pneu_pack(k->model, &s, y);
  if (pneu_events(k->model, &s, &input, y, own) <= which)
    return -1;
  late = rate > 0 ? -(own[which] - g[which]) / rate : 0;
  drift(v->model, s.mode, v->f[2], late, &s);
  pneu_switch(k->model, &input, which, &s);
  drift(v->model, after->mode, f, late, &end);
  subtract(v->model, &s, &end, k->d[0]);
  return isfinite(late) ? 0 : -1;
}

void lab_variations_event(struct lab_variations *v, const pneu_state *after)
{
  pneu_real y[S], g[PNEU_EVENT_MAX], f[S];
  const int is_edge = after->side != v->side;
  int n_events, which, i, is_lost;
  double rate;
  v->side = after->side;
  v->events += !is_edge;
  if (v->is_lost)
    return;
  pneu_pack(v->model, &v->state[2], y);
  n_events = pneu_events(v->model, &v->state[2], &v->at[2], y, g);
  which = is_edge ? PNEU_EVENT_EDGE : event_of(v, g, n_events);
  rate = rate_of_event(v, which, g);
  is_lost = n_events == 0 || rates_at(v->model, after, &v->at[2], f) != PNEU_OK;
  for (i = 0; i < v->n; i++) {
    nearby *k = &v->of[i];
    if (!is_moved(k))
      continue;
    k->knows_start = 0;
    k->is_off = is_lost || pass_event(v, k, which, g, rate, after, f);
  }
}

/* ---- Rows ---- */

/* One nearby run passes to row i.  In: f, f_after  rates of the run before and behind; not looked at where both pass at
 * once */
static int pass_row(struct lab_variations *v, nearby *k, size_t i, const pneu_model *was, const pneu_state *before,
                    const pneu_state *after, const pneu_real *f, const pneu_real *f_after)
{
  const double late = k->late.schedule.t[i] - v->acts->t[i];
  pneu_state s = displaced(was, before, k->d[0]), end = *after;
  k->input = k->late.schedule.input[i];
  k->lead = k->input.elapsed - v->input.elapsed - late;
  if (late != 0)
    drift(was, s.mode, f, late, &s);
  if (k->model != k->late.rows[i]) {
    if (lab_hand_over(k->model, k->late.rows[i], &k->input, &s) != PNEU_OK)
      return -1;
    k->model = k->late.rows[i];
  }
  pneu_settle(k->model, &k->input, &s);
  if (late != 0)
    drift(v->model, after->mode, f_after, late, &end);
  memset(k->d, 0, sizeof k->d);
  subtract(v->model, &s, &end, k->d[0]);
  k->knows_start = 0;
  note_same(v, k);
  return 0;
}

static int any_late(const struct lab_variations *v, size_t i)
{
  int k, any = 0;
  for (k = 0; k < v->n; k++)
    any |= !v->of[k].is_off && v->of[k].late.schedule.t[i] != v->acts->t[i];
  return any;
}

void lab_variations_row(struct lab_variations *v, size_t i, const pneu_state *before, const pneu_state *after)
{
  const pneu_model *was = v->model;
  pneu_input end = v->input;
  pneu_real f[S] = {0}, f_after[S] = {0};
  int k, is_lost = 0;
  if (i > 0)
    end.elapsed += v->acts->t[i] - v->acts->t[i - 1];
  v->model = v->rows[i];
  v->input = v->acts->input[i];
  v->theta = 0;
  v->events = 0;
  v->side = after->side;
  if (v->is_lost)
    return;
  if (any_late(v, i))
    is_lost = rates_at(was, before, &end, f) != PNEU_OK || rates_at(v->model, after, &v->input, f_after) != PNEU_OK;
  for (k = 0; k < v->n; k++)
    if (!v->of[k].is_off)
      v->of[k].is_off = is_lost || pass_row(v, &v->of[k], i, was, before, after, f, f_after);
}

/* ---- Samples ---- */

static void interpolate(const nearby *k, double theta, pneu_shown *excess)
{
  const pneu_shown *e = k->excess;
  excess->pressure = inside(theta, e[0].pressure, e[1].pressure, e[2].pressure);
  excess->temperature = inside(theta, e[0].temperature, e[1].temperature, e[2].temperature);
  excess->position = inside(theta, e[0].position, e[1].position, e[2].position);
  excess->force = inside(theta, e[0].force, e[1].force, e[2].force);
}

/* Memory that stays 0 is not touched. */
static void put(double *column, size_t i, double value)
{
  if (value != 0)
    column[i] = value;
}

void lab_variations_take(struct lab_variations *v, size_t i, const pneu_state *state, const pneu_input *input,
                         const pneu_shown *shown, int of_position, int of_rest)
{
  pneu_real d[S];
  pneu_shown excess;
  int k;
  for (k = 0; k < v->n && !v->is_lost; k++) {
    nearby *of = &v->of[k];
    if (!is_moved(of))
      continue;
    if (v->is_interpolated && v->theta > 0)
      interpolate(of, v->theta, &excess);
    else {
      difference_at(of, v->model->n_gas + 2, v->theta, d);
      of->is_off = excess_shown(v, of, state, input->elapsed, d, shown, &excess) != 0;
    }
    if (of_position)
      put(of->change->x, i, excess.position);
    if (!of_rest)
      continue;
    put(of->change->p, i, excess.pressure);
    put(of->change->T, i, excess.temperature);
    put(of->change->force, i, excess.force);
  }
}

/* ---- From beginning to end ---- */

void lab_variations_close(struct lab_variations *v, int without_result)
{
  int i;
  for (i = 0; v && v->of && i < v->n; i++) {
    lab_late_close(&v->of[i].late);
    if (without_result || v->is_lost || v->of[i].is_off)
      lab_response_free(v->of[i].change);
  }
  if (v)
    free(v->of);
  free(v);
}

int lab_variations_open(const lab_simulation *run, const lab_simulation *nearby_run, int n, lab_response *change,
                        struct lab_variations **variations, lab_error *error)
{
  struct lab_variations *v = *variations = calloc(1, sizeof *v);
  int i, status = LAB_OK;
  memset(change, 0, (size_t)n * sizeof *change);
  if (!v || !(v->of = calloc((size_t)n, sizeof *v->of)))
    return lab_fail_memory(error, "variations of a run");
  v->n = n;
  for (i = 0; i < n; i++)
    v->of[i].change = &change[i];
  for (i = 0; i < n && status == LAB_OK; i++) {
    nearby *k = &v->of[i];
    k->model = nearby_run[i].rows[0];
    subtract(k->model, nearby_run[i].start, run->start, k->d[0]);
    status = lab_response_allocate(k->change, run->n, 1, error);
    if (status == LAB_OK)
      status = lab_late_open(&nearby_run[i], k->model, &k->late, error);
  }
  return status;
}

/* Whether a nearby run has the states and the rows of the run, and shows them at the same times. */
static int can_follow(const struct lab_variations *v, const nearby *k)
{
  size_t i;
  int can = k->late.schedule.n == v->acts->n;
  for (i = 0; can && i < v->acts->n; i++)
    can = k->late.rows[i] == v->rows[i] || (lab_states_agree(k->late.rows[i], v->rows[i]) &&
                                            k->late.rows[i]->position_skew == v->rows[i]->position_skew);
  return can;
}

void lab_variations_begin(struct lab_variations *v, const lab_schedule *acts, const pneu_model *const *rows)
{
  int i;
  v->acts = acts;
  v->rows = rows;
  v->model = rows[0];
  v->length = HUGE_VAL;
  for (i = 0; i < v->n; i++)
    v->of[i].is_off = !can_follow(v, &v->of[i]);
}
