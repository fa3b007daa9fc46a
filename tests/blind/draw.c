#include "draw.h"

#include <math.h>
#include <string.h>

#define AT(name) offsetof(second_rig, name)

/* "damping" is drawn as a part of the viscous term; a share of that is the same direction. */
const blind_fitted blind_fitted_of[BLIND_FITTED] = {
    {"orifice_area", 0.2, {AT(fill_area), AT(vent_area)}},
    {"dry_friction", 0.2, {AT(dry_friction), 0}},
    {"spring_rate", 0.1, {AT(spring_rate), 0}},
    {"spring_preload", 0.1, {AT(spring_preload), 0}},
    {"damping", 0.13, {AT(viscous), 0}}, /* of the sum; 0.2 of damping, which is two thirds of it */
};

void blind_scale_fitted(second_rig *rig, int which, double factor)
{
  int k;
  for (k = 0; k < 2 && blind_fitted_of[which].field[k]; k++)
    *blind_field(rig, blind_fitted_of[which].field[k]) *= factor;
}

/* ---- Rigs ---- */

static second_rig r1_400(blind_chance *c)
{
  second_rig g = second_rig_default_r1_400();
  (void)c;
  g.dead_volume = 40e-6;
  return g;
}

static second_rig a37_13(blind_chance *c)
{
  second_rig g = second_rig_default_37_13();
  (void)c;
  g.dead_volume = 120e-6;
  return g;
}

/* A spring-and-diaphragm actuator of 50 to 900 cm2 with a bench set that leaves room at both ends of the supply, so
 * that it makes its whole stroke also when spring and friction are a fifth stronger than declared. */
static second_rig any_actuator(blind_chance *c)
{
  second_rig g = second_rig_default_r1_400();
  double low, high, filling_time;
  g.area = blind_log_uniform(c, 50e-4, 900e-4);
  g.stroke = blind_log_uniform(c, 10e-3, 60e-3);
  g.dead_volume = g.area * g.stroke * blind_log_uniform(c, 0.04, 0.3);
  g.supply = blind_log_uniform(c, 140e3, 600e3);
  low = g.supply * blind_uniform(c, 0.12, 0.3);
  high = g.supply * blind_uniform(c, 0.5, 0.7);
  g.spring_rate = (high - low) * g.area / g.stroke;
  g.spring_preload = low * g.area / g.spring_rate;
  g.dry_friction = g.supply * g.area * blind_uniform(c, 0.02, 0.06);
  g.viscous = g.supply * g.area * blind_log_uniform(c, 0.05, 0.2); /* 0.05 to 0.2 of full force at 1 m/s */
  g.mass = blind_log_uniform(c, 0.5, 5);
  filling_time = blind_uniform(c, 2.5, 6);
  g.fill_area = 1;
  g.fill_area = g.vent_area = (g.dead_volume + g.area * g.stroke) * (g.supply + g.ambient) /
                              (g.gas_constant * g.ambient_temperature * blind_full_flow(&g) * filling_time);
  return g;
}

static const struct actuator {
  const char *name;
  second_rig (*make)(blind_chance *c);
  double share;
} actuators[] = {{"R1-400", r1_400, 0.4}, {"37-13", a37_13, 0.3}, {"drawn", any_actuator, 0.3}};

static void draw_actuator(blind_chance *c, blind_trial *t)
{
  double at = blind_uniform(c, 0, 1);
  int i = 0;
  while (i < 2 && at > actuators[i].share)
    at -= actuators[i++].share;
  t->actuator = actuators[i].name;
  t->declared = actuators[i].make(c);
}

/* Converters of 14 bits span 125 % of supply and stroke; noise is half to twice 0.08 % of the one and 0.1 % of the
 * other. */
static void draw_sensors(blind_chance *c, second_rig *g)
{
  g->pressure_range = 1.25 * g->supply;
  g->position_range = 1.25 * g->stroke;
  g->pressure_noise = 8e-4 * g->supply * blind_log_uniform(c, 0.5, 2);
  g->position_noise = 1e-3 * g->stroke * blind_log_uniform(c, 0.5, 2);
  g->temperature_noise = blind_log_uniform(c, 0.1, 0.4);
  g->seed = blind_bits(c) >> 8;
}

/* Laws as declared; what an effect asks for comes first. */
static void draw_laws(blind_chance *c, int setting, second_rig *g)
{
  const double at = blind_uniform(c, 0, 1), gas = blind_uniform(c, 0, 1), b = blind_uniform(c, 0.2, 0.5);
  const double film = blind_log_uniform(c, 0.5, 5);
  g->flow = setting == BLIND_PAPER_FLOW || at < 0.25 ? SECOND_PAPER : at < 0.75 ? SECOND_CHOKED : SECOND_ISO6358;
  g->iso_b = g->flow == SECOND_ISO6358 ? b : g->iso_b;
  g->gas = setting == BLIND_ADIABATIC || setting == BLIND_FILM || (setting == BLIND_ANY && gas < 0.2)
               ? SECOND_ENERGY
               : SECOND_ISOTHERMAL;
  if (setting == BLIND_FILM)
    g->heat = film * blind_full_flow(g) * g->gas_constant * g->gamma / (g->gamma - 1);
}

/* ---- Commands ---- */

/* A piece of a schedule: command, and duration over the time in which the full flow would fill the whole chamber. */
typedef struct piece {
  double u, share;
} piece;

/* A full stroke and back, then pieces with holds between them, as in the logs of the virtual rig. */
static const piece fit_pieces[] = {{1, 1.1},   {-1, 1.22}, {0, 0.1},  {1, 0.17}, {0, 0.34}, {1, 0.19}, {0, 0.40},
                                   {-1, 0.14}, {0, 0.33},  {1, 0.33}, {0, 0.29}, {-1, 0.2}, {0, 0.33}, {-1, 0.75}};
static const piece holdout_pieces[] = {{1, 0.25}, {0, 0.25}, {-1, 0.12}, {0, 0.18},  {1, 0.46}, {0, 0.38}, {-1, 0.29},
                                       {0, 0.24}, {1, 0.55}, {-1, 0.83}, {0.5, 0.2}, {0, 0.34}, {1, 0.33}, {-1, 0.85}};
enum { PIECES = sizeof fit_pieces / sizeof fit_pieces[0] };

/* Durations vary by a sixth; where `partial`, half of the openings after the first two are not full, and last longer.
 */
static void draw_schedule(blind_chance *c, const piece *pieces, double time, double spacing, int partial,
                          blind_schedule *s)
{
  double t = 0.4 + blind_uniform(c, 0, spacing);
  int i;
  memset(s, 0, sizeof *s);
  for (i = 0; i < PIECES; i++) {
    const double open = blind_uniform(c, 0.3, 1), chance = blind_uniform(c, 0, 1);
    const double share = partial && i > 1 && chance < 0.5 ? open : 1;
    s->t[i] = t;
    s->u[i] = floor(pieces[i].u * share * 100 + 0.5) / 100;
    t += time * pieces[i].share * blind_uniform(c, 0.85, 1.15) / (pieces[i].u != 0 ? sqrt(share) : 1);
  }
  s->n = PIECES;
  s->end = floor(t / spacing) * spacing;
}

static void draw_commands(blind_chance *c, blind_trial *t)
{
  const double time = blind_filling_time(&t->base); /* whoever makes the log sees the stem arrive */
  const int partial = blind_uniform(c, 0, 1) < 0.5;
  t->spacing = 4e-3 + 0.25e-3 * blind_below(c, 5);
  draw_schedule(c, fit_pieces, time, t->spacing, partial, &t->fit);
  draw_schedule(c, holdout_pieces, time, t->spacing, partial, &t->holdout);
}

/* ---- What is missing ---- */

/* The kind of a trial goes by its number, so that any twenty trials in a row have the right share of each. */
static const char kinds[] = "NSSUSPSSNSSUSPSNSUSP";
enum { PERIOD = sizeof kinds - 1 };

int blind_kind_of(int number)
{
  switch (kinds[number % PERIOD]) {
  case 'S':
    return BLIND_SINGLE;
  case 'P':
    return BLIND_PAIR;
  case 'U':
    return BLIND_UNLISTED;
  default:
    return BLIND_NOTHING;
  }
}

/* Trials of the same kind before this one: effects are taken in turn, so that each is drawn as often as the others. */
static int turn_of(int number)
{
  const char kind = kinds[number % PERIOD];
  int i, before = 0, period = 0;
  for (i = 0; i < PERIOD; i++) {
    period += kinds[i] == kind;
    before += kinds[i] == kind && i < number % PERIOD;
  }
  return number / PERIOD * period + before;
}

/* Two effects that leave different traces and do not ask for different declarations; choked flow is no effect of a
 * size, and takes no part. */
static int go_together(const blind_effect *a, const blind_effect *b)
{
  if (strcmp(a->family, b->family) == 0 || a->lo == a->hi || b->lo == b->hi)
    return 0;
  return a->setting == BLIND_ANY || b->setting == BLIND_ANY;
}

static void choose_effects(blind_chance *c, blind_trial *t)
{
  const int listed = blind_listed_count(), turn = turn_of(t->number);
  t->n_missing = t->kind == BLIND_NOTHING ? 0 : t->kind == BLIND_PAIR ? 2 : 1;
  if (t->kind == BLIND_SINGLE)
    t->missing[0].effect = &blind_effects[turn % listed];
  if (t->kind == BLIND_UNLISTED)
    t->missing[0].effect = &blind_effects[listed + turn % (blind_effect_count - listed)];
  while (t->kind == BLIND_PAIR && !t->missing[0].effect) {
    const blind_effect *a = &blind_effects[blind_below(c, listed)], *b = &blind_effects[blind_below(c, listed)];
    if (go_together(a, b)) {
      t->missing[0].effect = a;
      t->missing[1].effect = b;
    }
  }
}

void blind_draw_missing(blind_chance *c, blind_trial *t, int which)
{
  blind_missing *m = &t->missing[which];
  const blind_effect *e = m->effect;
  const double sign = blind_uniform(c, 0, 1) < 0.5 && e->either_sign ? -1 : 1;
  int i;
  m->size = sign * blind_log_uniform(c, e->lo, e->hi) * blind_scale_of(e->scale, &t->base);
  for (i = 0; i < BLIND_SHAPES && e->shape[i].name; i++)
    m->shape[i] = blind_log_uniform(c, e->shape[i].lo, e->shape[i].hi) * blind_scale_of(e->shape[i].scale, &t->base);
  if (e->step > 0)
    t->step = fmin(t->step, e->step);
}

/* Mostly both channels, sometimes one; those that the effects are seen in are never left out. */
static int draw_channels(blind_chance *c, const blind_trial *t)
{
  const double at = blind_uniform(c, 0, 1);
  int i, channels = at < 0.8 ? BLIND_P | BLIND_X : at < 0.9 ? BLIND_X : BLIND_P;
  for (i = 0; i < t->n_missing; i++)
    channels |= t->missing[i].effect->channels;
  return channels;
}

static int setting_of(const blind_trial *t)
{
  int i, setting = BLIND_ANY;
  for (i = 0; i < t->n_missing; i++)
    if (t->missing[i].effect->setting != BLIND_ANY)
      setting = t->missing[i].effect->setting;
  return setting;
}

void blind_draw(uint64_t seed, int number, blind_trial *t)
{
  const double usual_step = 4e-5;
  blind_chance c = blind_chance_of(seed, (uint64_t)number);
  int i;
  memset(t, 0, sizeof *t);
  t->number = number;
  t->kind = blind_kind_of(number);
  t->tells_noise = 1;
  choose_effects(&c, t);
  t->channels = draw_channels(&c, t);
  draw_actuator(&c, t);
  draw_laws(&c, setting_of(t), &t->declared);
  draw_sensors(&c, &t->declared);
  t->base = t->declared;
  for (i = 0; i < BLIND_FITTED; i++)
    blind_scale_fitted(&t->base, i, 1 + blind_uniform(&c, -1, 1) * blind_fitted_of[i].off);
  draw_commands(&c, t);
  t->step = usual_step;
  for (i = 0; i < t->n_missing; i++)
    blind_draw_missing(&c, t, i);
}

second_rig blind_truth(const blind_trial *t, unsigned which)
{
  second_rig g = t->base;
  int i;
  g.step = t->step;
  for (i = 0; i < t->n_missing; i++)
    if (which & (1u << i))
      blind_effect_apply(t->missing[i].effect, t->missing[i].size, t->missing[i].shape, &g);
  return g;
}

const char *blind_kind_text(int kind)
{
  static const char *const text[BLIND_KINDS] = {"nothing", "single", "pair", "unlisted"};
  return text[kind];
}

const char *blind_gas_text(int gas)
{
  static const char *const text[] = {[SECOND_ISOTHERMAL] = "isothermal", [SECOND_ENERGY] = "energy"};
  return text[gas];
}

const char *blind_flow_text(int flow)
{
  static const char *const text[] = {
      [SECOND_PAPER] = "paper", [SECOND_CHOKED] = "choked", [SECOND_ISO6358] = "iso6358"};
  return text[flow];
}

const char *blind_channels_text(int channels)
{
  static const char *const text[] = {"", "p", "x", "px", "T", "pT", "xT", "pxT"};
  return text[channels];
}
