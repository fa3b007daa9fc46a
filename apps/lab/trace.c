#include "trace.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sizes at which a slope is taken, over the usual size; shapes over the usual shape. */
static const double sizes[] = {0.02, 1.0};
static const double shapes[] = {0.3, 1.0, 3.0};
enum { SIZES = sizeof sizes / sizeof *sizes, SHAPES = sizeof shapes / sizeof *shapes };

static const double invisible = 1e-6; /* share of a slope below which it counts as absorbed */
static const double absorbed = 0.02;  /* the same for a knot of a free term, whose neighbours may stand in for it */

double lab_chi2_p(double statistic)
{
  return erfc(sqrt(statistic / 2));
}

/* ---- The fitted model ---- */

static double dot(const double *a, const double *b, size_t m)
{
  double sum = 0;
  size_t i;
#pragma omp simd reduction(+ : sum)
  for (i = 0; i < m; i++)
    sum += a[i] * b[i];
  return sum;
}

static void normalise(double *v, double length, size_t m)
{
  size_t i;
  for (i = 0; i < m; i++)
    v[i] /= length;
}

/* Take the span of n orthonormal columns out of v; a second time where little is left, for rounding.
 * Returns: length left. */
static double project_out(const double *basis, int n, size_t m, double *v)
{
  double before = sqrt(dot(v, v, m)), left = before;
  int j, pass;
  size_t i;
  for (pass = 0; pass < 2; pass++) {
    for (j = 0; j < n; j++) {
      const double *b = basis + (size_t)j * m;
      const double c = dot(b, v, m);
      for (i = 0; i < m; i++)
        v[i] -= c * b[i];
    }
    left = sqrt(dot(v, v, m));
    if (left > 0.1 * before)
      break;
  }
  return left;
}

int lab_scan_open(lab_unknowns *u, lab_scan *s, lab_error *error)
{
  double theta[LAB_FIT_MAX];
  int j, status = LAB_OK;
  memset(s, 0, sizeof *s);
  s->u = u;
  s->m = u->m = u->n_data + (size_t)u->n;
  s->r = malloc(s->m * sizeof *s->r);
  s->basis = malloc((size_t)(u->n + 1) * s->m * sizeof *s->basis);
  if (!s->r || !s->basis)
    return lab_fail_memory(error, "a scan");
  for (j = 0; j < u->n; j++)
    theta[j] = u->unknown[j].value;
  if (lab_unknowns_residuals(u, theta, s->r, error))
    return error->status;
#pragma omp parallel for schedule(dynamic)
  for (j = 0; j < u->n; j++) {
    lab_error mine;
    double *column = s->basis + (size_t)j * s->m;
    const int at = lab_unknowns_slope(u, theta, s->r, j, column, &mine);
    if (at == LAB_NUMERIC)
      memset(column, 0, s->m * sizeof *column);
    else if (at != LAB_OK) {
#pragma omp critical(scan_error)
      *error = mine, status = at;
    }
  }
  for (j = 0; j < u->n && status == LAB_OK; j++) {
    double *column = s->basis + (size_t)j * s->m;
    const double whole = sqrt(dot(column, column, s->m)), left = project_out(s->basis, s->n_basis, s->m, column);
    if (!(left > invisible * whole))
      continue;
    normalise(column, left, s->m);
    if (s->n_basis != j)
      memcpy(s->basis + (size_t)s->n_basis * s->m, column, s->m * sizeof *column);
    s->n_basis++;
  }
  s->chi2 = dot(s->r, s->r, u->n_data);
  s->excess = s->chi2 - (double)u->n_data;
  return status;
}

void lab_scan_close(lab_scan *s)
{
  free(s->r);
  free(s->basis);
  memset(s, 0, sizeof *s);
}

/* Difference of the residuals of another model.  Returns: 0, or -1 where it fails. */
static int difference(const lab_scan *s, const lab_rig *model, double *slope)
{
  lab_error ignored;
  size_t i;
  if (lab_unknowns_residuals_with(s->u, model, slope, &ignored))
    return -1;
  for (i = 0; i < s->m; i++)
    slope[i] -= s->r[i];
  return 0;
}

/* ---- Effects ---- */

/* The statistic of one slope; the candidate keeps it if it is larger than what it has. */
static void judge(const lab_scan *s, double *slope, double step, double room_up, double room_down, lab_candidate *c,
                  double shape_value)
{
  const double whole = sqrt(dot(slope, slope, s->m));
  const double left = whole > 0 ? project_out(s->basis, s->n_basis, s->m, slope) : 0;
  double score, size, statistic;
  if (!(left > invisible * whole))
    return;
  score = dot(slope, s->r, s->m) / left;
  size = -score / left * step; /* r + (size/step) slope is least */
  statistic = score * score;
  if ((size > 0 && !(room_up > 0)) || (size < 0 && !(room_down > 0)))
    statistic = 0;
  if (c->direction && statistic <= c->statistic)
    return;
  if (!c->direction)
    c->direction = malloc(s->m * sizeof *c->direction);
  if (!c->direction)
    return;
  normalise(slope, left, s->m);
  memcpy(c->direction, slope, s->m * sizeof *slope);
  c->statistic = statistic;
  c->size = fmax(fmin(size, room_up), -room_down);
  c->shape_value = shape_value;
  c->visible = left / whole;
}

/* Difference of residuals for a step of the candidate's parameter. */
static int slope_of(const lab_scan *s, const lab_candidate *c, double value, double shape_value, double *slope)
{
  lab_rig model = s->u->rig;
  *pneu_param_at(&model.params, c->param) = (pneu_real)value;
  if (c->shape >= 0)
    *pneu_param_at(&model.params, c->shape) = (pneu_real)shape_value;
  return difference(s, &model, slope);
}

static int try_candidate(const lab_scan *s, lab_candidate *c)
{
  double *slope = malloc(s->m * sizeof *slope);
  pneu_param_info info, shape = {0};
  int i, k, tests = 0;
  if (!slope)
    return 0;
  pneu_param_describe(c->param, &info);
  if (c->shape >= 0)
    pneu_param_describe(c->shape, &shape);
  for (k = 0; k < (c->shape >= 0 ? SHAPES : 1); k++)
    for (i = 0; i < SIZES; i++) {
      const double shape_value =
          c->shape >= 0 ? fmin(fmax(shapes[k] * (double)shape.value, (double)shape.lower), (double)shape.upper) : 0;
      const double step = sizes[i] * (double)(info.value - info.neutral);
      if (slope_of(s, c, (double)info.neutral + step, shape_value, slope))
        continue;
      judge(s, slope, step, (double)(info.upper - info.neutral), (double)(info.neutral - info.lower), c, shape_value);
      tests++;
    }
  c->p_value = lab_chi2_p(c->statistic);
  c->explained = s->excess > 0 ? c->statistic / s->excess : 0;
  free(slope);
  return tests;
}

static int is_neutral(const pneu_params *params, int effect)
{
  int i, count;
  const int first = pneu_effect_params(effect, &count);
  for (i = 0; i < count; i++) {
    pneu_param_info info;
    pneu_param_describe(first + i, &info);
    if (!info.shape && *pneu_param_at((pneu_params *)params, first + i) != info.neutral)
      return 0;
  }
  return 1;
}

/* Every parameter that switches on an effect which the model does not have. */
static void list_candidates(const lab_unknowns *u, lab_trace_result *result)
{
  int e, i, count;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    int shape = -1;
    pneu_param_info info;
    if (!is_neutral(&u->rig.params, e))
      continue;
    for (i = count - 1; i >= 0; i--) {
      pneu_param_describe(first + i, &info);
      if (info.shape)
        shape = first + i;
    }
    for (i = 0; i < count && result->n < LAB_TRACE_MAX; i++) {
      pneu_param_describe(first + i, &info);
      if (info.shape)
        continue;
      result->candidate[result->n].effect = e;
      result->candidate[result->n].param = first + i;
      result->candidate[result->n++].shape = shape;
    }
  }
}

static int by_statistic(const void *a, const void *b)
{
  const lab_candidate *x = a, *y = b;
  if (x->statistic != y->statistic)
    return x->statistic < y->statistic ? 1 : -1;
  return x->param - y->param;
}

void lab_trace_effects(const lab_scan *s, lab_trace_result *result)
{
  int i, tests = 0;
  memset(result, 0, sizeof *result);
  result->chi2 = s->chi2;
  result->excess = s->excess;
  list_candidates(s->u, result);
#pragma omp parallel for schedule(dynamic) reduction(+ : tests)
  for (i = 0; i < result->n; i++)
    tests += try_candidate(s, &result->candidate[i]);
  result->tests = tests;
  qsort(result->candidate, (size_t)result->n, sizeof *result->candidate, by_statistic);
}

void lab_trace_close(lab_trace_result *result)
{
  int i;
  for (i = 0; i < result->n; i++)
    free(result->candidate[i].direction);
  result->n = 0;
}

double lab_trace_likeness(const lab_trace_result *result, size_t m, int a, int b)
{
  const double *x = result->candidate[a].direction, *y = result->candidate[b].direction;
  return x && y ? fabs(dot(x, y, m)) : 0;
}

/* ---- Slots ---- */

/* Where something without a name may act, and how finely it is looked at. */
static const struct place {
  int equation, argument, knots;
} places[] = {
    {PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 25},      {PNEU_TERM_FORCE, PNEU_TERM_OVER_POSITION, 25},
    {PNEU_TERM_FRICTION, PNEU_TERM_OVER_PRESSURE, 13},      {PNEU_TERM_FORCE, PNEU_TERM_OVER_PRESSURE, 13},
    {PNEU_TERM_FORCE, PNEU_TERM_OVER_VELOCITY, 9},          {PNEU_TERM_FLOW, PNEU_TERM_OVER_PRESSURE, 17},
    {PNEU_TERM_FLOW, PNEU_TERM_OVER_POSITION, 17},          {PNEU_TERM_FLOW, PNEU_TERM_OVER_OPENING, 9},
    {PNEU_TERM_HEAT, PNEU_TERM_OVER_PRESSURE, 9},           {PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_PRESSURE, 13},
    {PNEU_TERM_SHOWN_POSITION, PNEU_TERM_OVER_POSITION, 13}};
enum { PLACES = sizeof places / sizeof *places };

static const size_t rows_per_knot = 20; /* at least: a knot must not follow single rows */
static const double flow_share = 0.04;  /* of the largest flow: a free flow that matters */

/* Largest pressure, and 98 % of the speeds, that the logs show. */
static void ranges(const lab_unknowns *u, double *pressure, double *speed)
{
  const double stroke = (double)u->rig.params.stroke;
  int e;
  size_t i;
  *pressure = (double)u->rig.params.supply_pressure;
  *speed = 0;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    const double *p = x->log->value[LAB_CHANNEL_P], *at = x->log->value[LAB_CHANNEL_X],
                 *t = x->log->value[LAB_CHANNEL_TIME];
    for (i = 0; p && i < x->n; i++)
      *pressure = fmax(*pressure, p[x->first + i]);
    for (i = 32; at && i < x->n; i += 16) /* over 32 rows, so that noise and stick-slip do not count */
      *speed = fmax(*speed, fabs(at[x->first + i] - at[x->first + i - 32]) / (t[x->first + i] - t[x->first + i - 32]));
  }
  if (!(*speed > 0))
    *speed = stroke > 0 ? stroke : 1;
}

/* Flow [kg/s] through the open fill orifice into an empty chamber. */
static double choked_flow(const lab_unknowns *u)
{
  const pneu_params *p = &u->rig.params;
  lab_error ignored;
  pneu_model model;
  if (lab_rig_model(&u->rig, &model, &ignored))
    return 0;
  return (double)(p->fill_area * (p->supply_pressure + p->ambient_pressure) * model.choked_gain) /
         sqrt((double)p->supply_temperature);
}

static void prepare_slot(const lab_unknowns *u, const struct place *place, lab_slot *slot)
{
  const pneu_params *p = &u->rig.params;
  const double force = fmax((double)p->dry_friction, 1e-3 * (double)(p->area * p->supply_pressure));
  const double flow = flow_share * choked_flow(u);
  const double scales[PNEU_TERM_EQUATION_COUNT] = {
      force, force, flow, 1, 1e-3 * (double)p->supply_pressure, 1e-3 * (double)p->stroke};
  double pressure, speed;
  memset(slot, 0, sizeof *slot);
  ranges(u, &pressure, &speed);
  slot->term.equation = place->equation;
  slot->term.argument = place->argument;
  slot->term.n = place->knots;
  slot->scale = scales[place->equation];
  slot->term.to = (pneu_real)(place->argument == PNEU_TERM_OVER_POSITION   ? (double)p->stroke
                              : place->argument == PNEU_TERM_OVER_PRESSURE ? pressure
                              : place->argument == PNEU_TERM_OVER_VELOCITY ? speed
                                                                           : 1);
  slot->term.from =
      place->argument == PNEU_TERM_OVER_VELOCITY || place->argument == PNEU_TERM_OVER_OPENING ? -slot->term.to : 0;
}

/* Project the residual on the span of the knots' slopes. */
static void try_slot(const lab_scan *s, lab_slot *slot)
{
  lab_rig model = s->u->rig;
  pneu_term *term = &model.term[model.n_terms++];
  double *columns = malloc((size_t)slot->term.n * s->m * sizeof *columns);
  int i;
  *term = slot->term;
  for (i = 0; columns && i < slot->term.n; i++) {
    double *column = columns + (size_t)slot->degrees * s->m, whole, left, score;
    term->value[i] = (pneu_real)(0.05 * slot->scale);
    if (difference(s, &model, column) == 0) {
      whole = sqrt(dot(column, column, s->m));
      left = project_out(s->basis, s->n_basis, s->m, column);
      left = fmin(left, project_out(columns, slot->degrees, s->m, column));
      if (left > absorbed * whole && whole > 1e-3) {
        normalise(column, left, s->m);
        score = dot(column, s->r, s->m);
        slot->statistic += score * score;
        slot->degrees++;
      }
    }
    term->value[i] = 0;
  }
  free(columns);
}

static double surplus(const lab_slot *slot)
{
  return slot->statistic - slot->degrees;
}

static int by_surplus(const void *a, const void *b)
{
  const double x = surplus(a), y = surplus(b);
  return x < y ? 1 : x > y ? -1 : 0;
}

int lab_trace_slots(const lab_scan *s, lab_slot slot[LAB_SLOT_MAX])
{
  const int vessel = !(s->u->rig.params.stroke > 0);
  int i, n = 0;
  if (s->u->rig.n_terms == LAB_TERM_MAX)
    return 0;
  for (i = 0; i < PLACES; i++)
    if ((size_t)places[i].knots * rows_per_knot > s->u->n_rows)
      continue;
    else if (!vessel || places[i].argument == PNEU_TERM_OVER_PRESSURE || places[i].argument == PNEU_TERM_OVER_OPENING)
      prepare_slot(s->u, &places[i], &slot[n++]);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    try_slot(s, &slot[i]);
  qsort(slot, (size_t)n, sizeof *slot, by_surplus);
  return n;
}
