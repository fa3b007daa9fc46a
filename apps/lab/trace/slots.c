#include "slots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cycles.h"
#include "../fit/descent.h"
#include "../base/array.h"

static const double lines = 1000;    /* cycles looked at, about */
static const double absorbed = 0.02; /* share of a knot's slope for which its neighbours may stand in */

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
      1e-2 * (double)p->supply_pressure, force, force, flow, 1, 1e-3 * (double)p->supply_pressure,
      1e-3 * (double)p->stroke};
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
static void try_slot(const lab_scan *s, lab_slot *slot, lab_error *all)
{
  lab_rig model = s->u->rig;
  pneu_term *term = &model.term[model.n_terms++];
  double *columns = malloc((size_t)slot->term.n * s->m * sizeof *columns);
  lab_error error;
  int i;
  if (!columns) {
    lab_fail_memory(&error, "the slopes of a free term");
    lab_fail_together(all, &error);
    return;
  }
  *term = slot->term;
  for (i = 0; i < slot->term.n; i++) {
    double *column = columns + (size_t)slot->degrees * s->m, whole, left, score;
    term->value[i] = (pneu_real)(0.05 * slot->scale);
    if (lab_scan_difference(s, &model, column, &error))
      lab_fail_together(all, &error);
    else {
      whole = sqrt(lab_dot(column, column, s->m));
      left = lab_scan_project_out(s->basis, s->n_basis, s->m, column);
      left = fmin(left, lab_scan_project_out(columns, slot->degrees, s->m, column));
      if (left > absorbed * whole && whole > 1e-3) {
        lab_scan_normalise(column, left, s->m);
        score = lab_dot(column, s->r, s->m);
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

/* ---- Cycles ---- */

static const int cyclic[] = {PNEU_TERM_SUPPLY, PNEU_TERM_FORCE};
enum { CYCLIC = sizeof cyclic / sizeof *cyclic, EACH = 3 };

static void prepare_cycle(const lab_unknowns *u, int equation, double period, lab_slot *slot)
{
  const struct place place = {equation, PNEU_TERM_OVER_CYCLE, 2};
  prepare_slot(u, &place, slot);
  slot->term.to = (pneu_real)period;
}

/* Statistic of the two amplitudes, and the amplitudes themselves. */
static void try_cycle(const lab_scan *s, lab_slot *slot, lab_error *all)
{
  lab_rig model = s->u->rig;
  pneu_term *term = &model.term[model.n_terms++];
  double *column[2] = {malloc(s->m * sizeof(double)), malloc(s->m * sizeof(double))};
  const double step = 0.05 * slot->scale;
  double gram[4], score[2], size[2];
  lab_error error = {LAB_OK, ""};
  int i, good = column[0] && column[1];
  if (!good)
    lab_fail_memory(&error, "the slopes of a cycle");
  *term = slot->term;
  for (i = 0; good && i < 2; i++) {
    term->value[i] = (pneu_real)step;
    good = lab_scan_difference(s, &model, column[i], &error) == LAB_OK && lab_scan_visible(s, column[i]) > 0;
    term->value[i] = 0;
  }
  for (i = 0; good && i < 4; i++)
    gram[i] = lab_dot(column[i / 2], column[i % 2], s->m);
  for (i = 0; good && i < 2; i++)
    size[i] = score[i] = -lab_dot(column[i], s->r, s->m);
  if (good && lab_solve_positive(2, 2, gram, size) == 0) {
    slot->degrees = 3; /* the period is one */
    slot->statistic = size[0] * score[0] + size[1] * score[1];
    for (i = 0; i < 2; i++)
      slot->term.value[i] = (pneu_real)(size[i] * step);
  }
  lab_fail_together(all, &error);
  free(column[0]);
  free(column[1]);
}

/* The best few cycles in each equation.  In/out: n  entries of slot */
static void try_cycles(const lab_scan *s, lab_slot *slot, int *n, lab_error *error)
{
  lab_slot all[CYCLIC * LAB_CYCLES_MAX];
  double period[LAB_CYCLES_MAX];
  int i, k, found;
  if (lab_cycles_find(s->u, s->r, period, &found, error))
    return;
  for (i = 0; i < CYCLIC * found; i++)
    prepare_cycle(s->u, cyclic[i / found], period[i % found], &all[i]);
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < CYCLIC * found; i++)
    try_cycle(s, &all[i], error);
  for (k = 0; k < CYCLIC; k++) {
    qsort(&all[(size_t)k * (size_t)found], (size_t)found, sizeof *all, by_surplus);
    for (i = 0; i < found && i < EACH && all[k * found + i].degrees > 0; i++)
      slot[(*n)++] = all[k * found + i];
  }
}

double lab_slot_tests(const pneu_term *term)
{
  return term->argument == PNEU_TERM_OVER_CYCLE ? lines : 1;
}

int lab_slots_try(const lab_scan *s, lab_slot slot[LAB_SLOT_MAX], int *n, lab_error *error)
{
  const int vessel = !(s->u->rig.params.stroke > 0);
  int i;
  *n = 0;
  if (s->u->rig.n_terms == LAB_TERM_MAX)
    return LAB_OK;
  for (i = 0; i < PLACES; i++)
    if ((size_t)places[i].knots * rows_per_knot > s->u->n_rows)
      continue;
    else if (!vessel || places[i].argument == PNEU_TERM_OVER_PRESSURE || places[i].argument == PNEU_TERM_OVER_OPENING)
      prepare_slot(s->u, &places[i], &slot[(*n)++]);
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < *n; i++)
    try_slot(s, &slot[i], error);
  if (error->status == LAB_OK && !vessel && s->u->window == 0)
    try_cycles(s, slot, n, error);
  qsort(slot, (size_t)*n, sizeof *slot, by_surplus);
  return error->status;
}
