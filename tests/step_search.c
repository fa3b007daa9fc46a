/* A search for steps that pneu_step gets wrong: random actuators, laws, effects (none, one, two, three), states and
 * inputs, each step against 64 small ones, against the flows of these and against the pressures that they, supply and
 * compression allow.
 *   step_search FIRST COUNT [show]     cases FIRST.. FIRST + COUNT - 1: the same in every run; show: those that are
 * wrong. Ends with 1 where a step breaks a bound, where a run ends in a state that no step takes, where more are
 * refused, held or wrong than pneu.h says, or one is worse.
 *
 * A step that differs by more than COARSE is wrong unless the start does not tell the end: where starts that lie apart
 * by the step's tolerance, 1e-4 of full scale, end a third as far apart as the step from the small ones, as when a
 * newton decides whether a stem breaks away, the step solves a problem as near as it promises. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lib/pneu.h"

#define COARSE 1e-2 /* of full scale */
#define STARTS 1e-4 /* by which starts lie apart */

enum { SMALL = 64, FINE = 16 * SMALL, DECADES = 5 };

typedef struct scene {
  pneu_model model;
  pneu_input input;
  pneu_state start;
  pneu_real acting; /* the command before the start, which still acts where there is a dead time */
  double dt;
  int effect[3], effects;
} scene;

/* What drives one way from the start: the input, and commands on their way. */
typedef struct drive {
  pneu_input input;
  pneu_delay line;
  pneu_late slot[4];
} drive;

/* 64 small steps: where they end, and what lies on the way. */
typedef struct path {
  pneu_state end;
  double in, out;         /* [kg/s] largest flows */
  double lowest, highest; /* [Pa] abs */
  double volume;          /* [m3] largest */
  int status;
} path;

typedef struct tally {
  long cases, held, refused, strange, lost, sensitive, wrong, unbounded, evaluations;
  long beyond[DECADES], held_beyond[DECADES]; /* by more than 1e-4, 1e-3 ... of full scale */
  double worst;
  long worst_case;
} tally;

/* ---- Draws ---- */

static double uniform(uint64_t *seed, double lo, double hi)
{
  *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  return lo + (hi - lo) * ((double)(*seed >> 11) / 9007199254740992.0);
}

static double by_decades(uint64_t *seed, double lo, double hi)
{
  return lo * pow(hi / lo, uniform(seed, 0, 1));
}

/* One of the ends now and then. */
static double with_ends(uint64_t *seed, double lo, double hi)
{
  const double which = uniform(seed, 0, 1);
  return which < 0.1 ? lo : which < 0.2 ? hi : uniform(seed, lo, hi);
}

static int one_of(uint64_t *seed, int n)
{
  return (int)uniform(seed, 0, n);
}

/* A parameter of an effect: from a tenth to three times its usual size, in its bounds. */
static pneu_real draw_size(uint64_t *seed, const pneu_param_info *info)
{
  const double size = (double)info->value * by_decades(seed, 0.1, 3);
  return (pneu_real)fmax((double)info->lower, fmin((double)info->upper, size));
}

static void draw_effects(uint64_t *seed, scene *s, pneu_params *p)
{
  int i, k;
  s->effects = PNEU_EFFECT_COUNT > 0 ? one_of(seed, 4) : 0;
  for (k = 0; k < s->effects; k++) {
    int count, first;
    s->effect[k] = one_of(seed, PNEU_EFFECT_COUNT);
    first = pneu_effect_params(s->effect[k], &count);
    for (i = first; i < first + count; i++) {
      pneu_param_info info;
      pneu_param_describe(i, &info);
      *pneu_param_at(p, i) = draw_size(seed, &info);
    }
  }
}

static int draw_model(uint64_t *seed, scene *s)
{
  pneu_params p;
  pneu_laws law = {0, 0, 0, 0};
  double force;
  pneu_params_default(&p);
  p.area = (pneu_real)by_decades(seed, 2e-3, 0.1);
  p.dead_volume = (pneu_real)by_decades(seed, 1e-6, 1e-3);
  p.stroke = (pneu_real)(one_of(seed, 40) ? by_decades(seed, 5e-3, 0.1) : 0);
  p.supply_pressure = (pneu_real)uniform(seed, 1e5, 7e5);
  force = (double)p.supply_pressure * (double)p.area;
  p.spring_rate = (pneu_real)(uniform(seed, 0.2, 1.2) * force / fmax((double)p.stroke, 5e-3));
  p.spring_preload = (pneu_real)(uniform(seed, 0, 0.5) * (double)p.stroke);
  p.moving_mass = (pneu_real)by_decades(seed, 0.1, 20);
  p.dry_friction = (pneu_real)(with_ends(seed, 0, 0.15) * force);
  p.viscous_friction = (pneu_real)with_ends(seed, 0, 2000);
  p.damping = (pneu_real)with_ends(seed, 0, 2000);
  p.fill_area = (pneu_real)by_decades(seed, 1e-7, 1e-5);
  p.vent_area = (pneu_real)by_decades(seed, 1e-7, 1e-5);
  p.proportional_band = (pneu_real)(one_of(seed, 8) ? 0 : uniform(seed, 1e4, 1e5));
  law.gas = one_of(seed, PNEU_GAS_COUNT);
  law.flow = one_of(seed, PNEU_FLOW_COUNT);
  p.critical_ratio = (pneu_real)with_ends(seed, 0, 0.9);
  p.subsonic_index = (pneu_real)with_ends(seed, 0.2, 1);
  law.pressure_input = one_of(seed, 32) == 0;
  law.position_input = one_of(seed, 32) == 0;
  draw_effects(seed, s, &p);
  return pneu_model_init(&s->model, &p, &law, NULL);
}

static void draw_input(uint64_t *seed, const pneu_model *m, pneu_input *input)
{
  const double supply = (double)m->p.supply_pressure;
  pneu_input_default(m, input);
  input->u = (pneu_real)(m->p.proportional_band > 0 ? with_ends(seed, 0, supply) : with_ends(seed, -1, 1));
  if (!one_of(seed, 4))
    input->supply_pressure = (pneu_real)uniform(seed, 0, 1.2 * supply);
  if (!one_of(seed, 4))
    input->force = (pneu_real)(uniform(seed, -0.3, 0.3) * supply * (double)m->p.area);
  if (m->law.pressure_input)
    input->pressure_rate = (pneu_real)uniform(seed, -1e6, 1e6);
  if (m->law.position_input)
    input->position_rate = (pneu_real)(uniform(seed, -1, 1) * (double)m->p.stroke);
}

static void begin(const pneu_input *input, pneu_real acting, drive *d)
{
  d->input = *input;
  d->input.delay = &d->line;
  pneu_delay_begin(&d->line, d->slot, sizeof d->slot / sizeof d->slot[0], acting);
}

/* At rest, or somewhere in a run, or thrown there. */
static int draw_start(uint64_t *seed, scene *s)
{
  const pneu_model *m = &s->model;
  const double supply = (double)m->p.supply_pressure;
  pneu_options options;
  pneu_workspace work;
  pneu_input before;
  drive d;
  const int kind = one_of(seed, 4);
  int status;
  memset(&work, 0, sizeof work);
  memset(&s->start, 0, sizeof s->start);
  draw_input(seed, m, &before);
  status = pneu_state_rest(m, (pneu_real)with_ends(seed, 0, supply), m->p.ambient_temperature,
                           (pneu_real)with_ends(seed, 0, (double)m->p.stroke), &before, &s->start);
  s->acting = before.u;
  begin(&before, before.u, &d);
  pneu_options_default(&options);
  options.tol = (pneu_real)1e-4;
  if (status == PNEU_OK && kind > 0)
    status = pneu_run(m, &s->start, &d.input, (pneu_real)by_decades(seed, 1e-3, 5e-2), &options, NULL, &work);
  if (kind == 3) {
    s->start.v = (pneu_real)(uniform(seed, -10, 10) * (double)m->p.stroke);
    s->start.p = (pneu_real)uniform(seed, -0.9 * (double)m->p.ambient_pressure, 1.5 * supply);
    if (m->thermal)
      s->start.T = (pneu_real)uniform(seed, 250, 400);
  }
  return status;
}

static int draw_scene(long number, scene *s)
{
  uint64_t seed = (uint64_t)number * UINT64_C(0x9E3779B97F4A7C15) + 12345;
  int status;
  uniform(&seed, 0, 1);
  seed ^= seed >> 29;
  uniform(&seed, 0, 1);
  memset(s, 0, sizeof *s);
  status = draw_model(&seed, s);
  if (status == PNEU_OK)
    status = draw_start(&seed, s);
  draw_input(&seed, &s->model, &s->input);
  s->dt = by_decades(&seed, 1e-4, 5e-3);
  if (s->model.law.position_input)
    s->start.x = (pneu_real)(0.3 * (double)s->model.p.stroke + 0.2 * (double)s->start.x);
  return status;
}

/* ---- Steps ---- */

static int step(const scene *s, const drive *d, pneu_state *state, double dt, pneu_stats *stats)
{
  pneu_workspace work;
  int status;
  memset(&work, 0, sizeof work);
  status = pneu_step(&s->model, state, &d->input, (pneu_real)dt, &work);
  *stats = work.stats;
  return status;
}

static void look(const scene *s, const drive *d, path *way)
{
  const double p = (double)way->end.p + (double)s->model.p.ambient_pressure;
  pneu_output seen;
  if (pneu_observe(&s->model, &way->end, &d->input, &seen) != PNEU_OK) {
    way->status = PNEU_RETRY_STATE;
    return;
  }
  way->in = fmax(way->in, (double)seen.mass_in);
  way->out = fmax(way->out, (double)seen.mass_out);
  way->lowest = fmin(way->lowest, p);
  way->highest = fmax(way->highest, p);
  way->volume = fmax(way->volume, (double)pneu_volume(&s->model, way->end.x));
}

/* A stem that is held may stand where its bounce squeezes the gas, and longer than the small steps do: what the
 * orifices let at the pressure at which it ends counts too. */
static void add_held_flow(const scene *s, const drive *d, const pneu_state *end, path *way)
{
  pneu_output seen;
  if (pneu_observe(&s->model, end, &d->input, &seen) != PNEU_OK)
    return;
  way->in = fmax(way->in, (double)seen.mass_in);
  way->out = fmax(way->out, (double)seen.mass_out);
}

/* Held small steps are as good a comparison as any: they are few, and differ more from the step. */
static path walk(const scene *s, const pneu_state *start, int n)
{
  path way = {*start, 0, 0, 1e30, 0, 0, PNEU_OK};
  pneu_stats stats;
  drive d;
  int i;
  begin(&s->input, s->acting, &d);
  look(s, &d, &way);
  for (i = 0; i < n && way.status == PNEU_OK; i++) {
    const int status = step(s, &d, &way.end, s->dt / n, &stats);
    way.status = status < 0 ? status : PNEU_OK;
    look(s, &d, &way);
  }
  return way;
}

/* Largest difference of two states, in units of full scale. */
static double apart(const scene *s, const pneu_state *a, const pneu_state *b)
{
  const pneu_model *m = &s->model;
  pneu_real scale[PNEU_STATE_MAX];
  double d;
  int i;
  pneu_scales(m, scale);
  d = fabs((double)a->p - (double)b->p) / (double)scale[0];
  if (m->thermal)
    d = fmax(d, fabs((double)a->T - (double)b->T) / (double)scale[1]);
  for (i = 0; i < m->n_extra; i++)
    d = fmax(d, fabs((double)a->extra[i] - (double)b->extra[i]) / (1 + fabs((double)b->extra[i])));
  if (m->p.stroke > 0) {
    d = fmax(d, fabs((double)a->x - (double)b->x) / (double)scale[m->n_gas]);
    d = fmax(d, fabs((double)a->v - (double)b->v) / (double)scale[m->n_gas + 1]);
  }
  return d;
}

/* Entry i of a start, moved. */
static void move(const pneu_model *m, int i, double by, pneu_state *start)
{
  if (i == 0)
    start->p += (pneu_real)by * m->scale[0];
  else if (i == 1)
    start->x = (pneu_real)fmax((double)m->lower_stop,
                               fmin((double)m->upper_stop, (double)start->x + by * (double)m->scale[2]));
  else if (i == 2)
    start->v += (pneu_real)by * m->scale[3];
  else
    start->extra[i - 3] += (pneu_real)by;
}

/* How far from `end` starts end that differ by STARTS in one entry. */
static double spread(const scene *s, const pneu_state *end)
{
  double most = 0;
  int i;
  for (i = 0; i < 2 * (3 + s->model.n_extra); i++) {
    pneu_state start = s->start;
    path way;
    move(&s->model, i / 2, i % 2 ? STARTS : -STARTS, &start);
    way = walk(s, &start, SMALL);
    if (way.status == PNEU_OK)
      most = fmax(most, apart(s, &way.end, end));
  }
  return most;
}

/* Whether no more gas has passed than the orifices let, with room for flows between the looks, and its pressure is what
 * supply, ambient and the compression of the step allow. */
static int is_bounded(const scene *s, const pneu_state *end, const path *way)
{
  const pneu_model *m = &s->model;
  const double mass = (double)pneu_mass(m, end), start = (double)pneu_mass(m, &s->start);
  const double ambient = (double)m->p.ambient_pressure, p = (double)end->p + ambient;
  const double full = (double)m->scale[0] * (double)pneu_volume(m, m->upper_stop) /
                      ((double)m->p.gas_constant * (double)m->p.ambient_temperature);
  const double room = 1e-3 * full + 0.1 * start, squeezed = way->volume / (double)pneu_volume(m, end->x);
  if (m->law.pressure_input)
    return 1;
  return mass <= start + 1.5 * way->in * s->dt + room && mass >= start - 1.5 * way->out * s->dt - room &&
         p >= 0.5 * fmin(way->lowest, ambient) &&
         p <= 1.5 * fmax(way->highest, (double)s->input.supply_pressure + ambient) * pow(squeezed, 1.67);
}

/* ---- Tally ---- */

static void say_state(const char *what, const pneu_state *at)
{
  printf("   %s p %.7g T %.5g x %.7g v %.5g extra %.4g %s\n", what, (double)at->p, (double)at->T, (double)at->x,
         (double)at->v, (double)at->extra[0], pneu_mode_text(at->mode));
}

static void say(const char *what, long number, const scene *s, const pneu_state *end, const path *way, double d)
{
  int k;
  printf("%s: case %ld, %.3g s, apart by %.3g, %s, %s", what, number, s->dt, d, pneu_gas_key(s->model.law.gas),
         pneu_flow_key(s->model.law.flow));
  for (k = 0; k < s->effects; k++)
    printf(" %s", pneu_effect_at(s->effect[k])->name);
  printf("\n");
  say_state("from ", &s->start);
  say_state("step ", end);
  say_state("small", &way->end);
}

/* Difference from the small steps, or from smaller ones where these are nearer; 0 where the start does not tell the
 * end. */
static double judge(const scene *s, const pneu_state *end, path *way, double d, tally *t)
{
  const path fine = walk(s, &s->start, FINE);
  if (fine.status == PNEU_OK && apart(s, end, &fine.end) < d) {
    d = apart(s, end, &fine.end);
    *way = fine;
  }
  if (d <= COARSE || d > 3 * spread(s, &way->end))
    return d;
  t->sensitive++;
  return 0;
}

static void try_case(long number, int show, tally *t)
{
  scene s;
  pneu_state end;
  pneu_stats stats;
  drive driven;
  path way;
  double d;
  int i, status;
  if (draw_scene(number, &s) != PNEU_OK)
    return;
  t->cases++;
  end = s.start;
  begin(&s.input, s.acting, &driven);
  status = step(&s, &driven, &end, s.dt, &stats);
  way = walk(&s, &s.start, SMALL);
  t->evaluations += stats.rhs;
  t->refused += status < 0;
  t->strange += status == PNEU_E_NONFINITE;
  t->held += status > 0;
  t->lost += way.status != PNEU_OK;
  if (status < 0 && show)
    say("refused", number, &s, &end, &way, 0);
  if (status < 0 || way.status != PNEU_OK)
    return;
  d = apart(&s, &end, &way.end);
  if (status > 0)
    add_held_flow(&s, &driven, &end, &way);
  if (!is_bounded(&s, &end, &way)) {
    t->unbounded++;
    say("out of bounds", number, &s, &end, &way, d);
  }
  if (status == PNEU_OK && !(d <= COARSE))
    d = judge(&s, &end, &way, d, t);
  for (i = 0; i < DECADES; i++)
    (status > 0 ? t->held_beyond : t->beyond)[i] += !(d <= pow(10, i - 4));
  if (status > 0)
    return;
  if (!(d <= COARSE)) {
    t->wrong++;
    if (show)
      say("wrong", number, &s, &end, &way, d);
  }
  if (!(d <= t->worst)) {
    t->worst = d;
    t->worst_case = number;
  }
}

int main(int argc, char **argv)
{
  const long first = argc > 1 ? atol(argv[1]) : 0, count = argc > 2 ? atol(argv[2]) : 10000;
  tally t;
  long i;
  memset(&t, 0, sizeof t);
  for (i = first; i < first + count; i++)
    try_case(i, argc > 3, &t);
  printf("step_search: %ld steps, %.1f evaluations each: %ld refused (%ld as out of range), %ld held, %ld not told by "
         "their start, %ld wrong "
         "(worst %.2g, case %ld), %ld out of bounds, %ld without comparison\n",
         t.cases, (double)t.evaluations / (double)t.cases, t.refused, t.strange, t.held, t.sensitive, t.wrong, t.worst,
         t.worst_case, t.unbounded, t.lost);
  for (i = 0; i < DECADES; i++)
    printf("  beyond %g of full scale: %ld with PNEU_OK, %ld with PNEU_HELD\n", pow(10, (double)i - 4), t.beyond[i],
           t.held_beyond[i]);
  return t.unbounded > 0 || t.strange > 0 || t.refused > 1 + t.cases / 100000 || t.held > 1 + t.cases / 200 ||
         t.wrong > 2 + t.cases / 25000 || !(t.worst < 0.5);
}
