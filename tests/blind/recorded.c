#include "recorded.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT(name) offsetof(second_rig, name)

/* ---- The tables ---- */

const blind_share blind_imperfections[BLIND_IMPERFECTIONS] = {
    {"positioner", 0.4}, {"ramps", 0.2},    {"tolerance", 0.25}, {"beyond", 0.25},      {"onset", 0.35},
    {"filter", 0.3},     {"bits", 0.3},     {"rounding", 0.25},  {"jitter", 0.25},      {"hum", 0.2},
    {"colour", 0.2},     {"drift", 0.2},    {"dropouts", 0.25},  {"noise_wrong", 0.15}, {"noise_untold", 0.6},
    {"turbulent", 0.5},  {"integral", 0.5}, {"long_ramps", 0.3},
};

/* Trials of which only the declared values are off, so that what comes of that alone can be seen; which form an effect
 * has is no matter of the log. */
static const double plain_share = 0.1;

/* Tolerances are the documented defaults. Viscous friction is declared in two parts, of which the greater is fitted. */
const blind_value blind_values[BLIND_VALUES] = {
    {"area", "m2", 0.02, 0, {AT(area), 0}},
    {"dead_volume", "m3", 0.3, 0, {AT(dead_volume), 0}},
    {"spring_rate", "N/m", 0.1, 0, {AT(spring_rate), 0}},
    {"spring_preload", "m", 0.1, 0, {AT(spring_preload), 0}},
    {"moving_mass", "kg", 0.2, 0, {AT(mass), 0}},
    {"dry_friction", "N", 0.5, 0, {AT(dry_friction), 0}},
    {"damping", "N.s/m", 0.35, 0, {AT(viscous), 0}},
    {"orifice_area", "1", 0.2, 0, {AT(fill_area), AT(vent_area)}},
    {"supply_pressure", "Pa", 0.02, 0, {AT(supply), 0}},
    {"ambient_pressure", "Pa", 2000, 1, {AT(ambient), 0}},
};
enum { FRICTION = 5, DAMPING, ORIFICE, SUPPLY, AMBIENT };

int blind_value_named(const char *name)
{
  int i;
  for (i = 0; i < BLIND_VALUES; i++)
    if (strcmp(blind_values[i].name, name) == 0)
      return i;
  return -1;
}

double blind_value_of(const second_rig *rig, int value)
{
  second_rig copy = *rig;
  return value == ORIFICE ? 1 : *blind_field(&copy, blind_values[value].field[0]);
}

void blind_value_shift(second_rig *rig, int value, double off)
{
  const blind_value *v = &blind_values[value];
  int k;
  for (k = 0; k < 2 && v->field[k]; k++) {
    double *field = blind_field(rig, v->field[k]);
    *field = v->absolute ? *field + off : *field * off;
  }
}

const char *blind_loop_text(int loop)
{
  static const char *const text[BLIND_LOOPS] = {"open", "u sp p x", "sp p x", "sp x"};
  return text[loop];
}

void blind_imperfection_text(const blind_recorded *r, char *text, size_t size)
{
  size_t used = 0;
  int i;
  *text = '\0';
  for (i = 0; i < BLIND_IMPERFECTIONS; i++)
    if (r->has & (1u << i) && used < size)
      used += (size_t)snprintf(text + used, size - used, "%s%s", used ? "+" : "", blind_imperfections[i].name);
}

int blind_imperfections_read(const char *names, unsigned *bits)
{
  *bits = 0;
  while (*names) {
    const size_t length = strcspn(names, ",");
    int i = 0;
    while (i < BLIND_IMPERFECTIONS &&
           (strlen(blind_imperfections[i].name) != length || strncmp(blind_imperfections[i].name, names, length) != 0))
      i++;
    if (i == BLIND_IMPERFECTIONS)
      return 0;
    *bits |= 1u << i;
    names += length + (names[length] == ',');
  }
  return 1;
}

/* ---- Values ---- */

static int has(const blind_recorded *r, int imperfection)
{
  return (r->has >> imperfection) & 1;
}

/* Standard normal, none beyond two. */
static double normal(blind_chance *c)
{
  for (;;) {
    const double z = blind_normal(c);
    if (fabs(z) <= 2)
      return z;
  }
}

/* The rig file gives some of them. Damping is left out, as viscous friction is the sum of two values. */
static void draw_told(blind_chance *c, blind_recorded *r)
{
  int i;
  for (i = 0; i < BLIND_VALUES; i++) {
    const double factor = blind_log_uniform(c, 0.5, 2);
    const int told = blind_uniform(c, 0, 1) < 0.4 && i != DAMPING;
    r->told[i] = has(r, BLIND_TOLERANCE) && told ? factor * blind_values[i].tolerance : 0;
  }
}

double blind_known_to(const blind_recorded *r, int value)
{
  return r->told[value] > 0 ? r->told[value] : blind_values[value].tolerance;
}

/* Within tolerance; of friction at least a third is left. */
static double draw_off(blind_chance *c, const blind_recorded *r, int value)
{
  const double z = normal(c) * blind_known_to(r, value);
  return blind_values[value].absolute ? z : fmax(1 + z, value == DAMPING ? 0.5 : 1.0 / 3);
}

/* 3 to 6 times the tolerance; ambient pressure only falls, with height. */
static double draw_far_off(blind_chance *c, const blind_recorded *r, int value)
{
  const double far = blind_uniform(c, 3, 6) * blind_known_to(r, value);
  const int more = blind_uniform(c, 0, 1) < 0.5;
  return blind_values[value].absolute ? -far : more ? 1 + far : 1 / (1 + far);
}

/* What begins within a log where no effect does: a supply that fails, a stem that sticks, a spring that breaks, an
 * orifice that clogs. */
static const struct fault {
  const char *value;
  double lo, hi;
} faults[] = {
    {"supply_pressure", 0.7, 0.9}, {"dry_friction", 2.5, 4}, {"spring_rate", 0.6, 0.8}, {"orifice_area", 0.4, 0.7}};
enum { FAULTS = sizeof faults / sizeof faults[0] };

/* The stem must come back by its spring. */
static void keep_moving(blind_recorded *r, const second_rig *g)
{
  const double most = 0.7 * g->spring_rate * g->spring_preload;
  if (g->dry_friction > most)
    r->off[FRICTION] *= most / g->dry_friction;
}

static second_rig shifted(const blind_recorded *r, int but)
{
  second_rig g = r->t.declared;
  int i;
  for (i = 0; i < BLIND_VALUES; i++)
    if (i != but)
      blind_value_shift(&g, i, r->off[i]);
  g.vent_area *= r->vent;
  return g;
}

static void draw_values(blind_chance *c, blind_recorded *r)
{
  const int far = blind_below(c, BLIND_VALUES), fault = blind_below(c, FAULTS);
  const double far_off = draw_far_off(c, r, far);
  const double fault_off = blind_uniform(c, faults[fault].lo, faults[fault].hi);
  second_rig g;
  int i;
  r->beyond = r->onset_value = -1;
  for (i = 0; i < BLIND_VALUES; i++)
    r->off[i] = draw_off(c, r, i);
  if (has(r, BLIND_ONSET) && r->t.n_missing == 0)
    r->off[r->beyond = r->onset_value = blind_value_named(faults[fault].value)] = fault_off;
  else if (has(r, BLIND_BEYOND))
    r->off[r->beyond = far] = far_off;
  g = shifted(r, -1);
  keep_moving(r, &g);
  r->t.base = shifted(r, r->onset_value);
}

/* ---- Onset ---- */

/* Effects that may begin within a log: those that are a number in an equation, not a state of their own. */
static const char *const can_begin[] = {
    "chamber_leak",          "laminar_leak",     "porous_leak",       "supply_droop",
    "exhaust_back_pressure", "vent_restriction", "friction_position", "friction_pressure",
    "pressure_bias",         "pressure_gain",    "position_bias",     "position_gain",
};

static int may_begin(const blind_trial *t)
{
  size_t i;
  if (t->n_missing != 1)
    return t->n_missing == 0;
  for (i = 0; i < sizeof can_begin / sizeof can_begin[0]; i++)
    if (strcmp(t->missing[0].effect->name, can_begin[i]) == 0)
      return 1;
  return 0;
}

second_rig blind_recorded_later(const blind_recorded *r, unsigned which)
{
  blind_trial t = r->t;
  if (r->onset_value >= 0)
    t.base = shifted(r, -1);
  return blind_truth(&t, which);
}

second_rig blind_recorded_first(const blind_recorded *r, unsigned which)
{
  const int begins = !isnan(r->onset) && r->onset_value < 0;
  return blind_truth(&r->t, begins ? 0 : which);
}

/* ---- Lines ---- */

static int any_line(const blind_trial *t)
{
  int i, any = 0;
  for (i = 0; i < t->n_missing; i++)
    any |= blind_turbulent_of(t->missing[i].effect) != NULL;
  return any;
}

/* A line that begins within the log is a supply's and holds no air, which would have been there before. */
static void draw_lines(blind_chance *c, blind_recorded *r)
{
  int i;
  for (i = 0; i < r->t.n_missing; i++) {
    blind_missing *m = &r->t.missing[i];
    const blind_effect *line = blind_turbulent_of(m->effect);
    if (!line || !has(r, BLIND_TURBULENT))
      continue;
    m->effect = line;
    blind_draw_missing(c, &r->t, i);
    if (has(r, BLIND_ONSET))
      m->shape[0] = 0;
  }
}

/* ---- Commands ---- */

/* The schedule of the clean trial, in the time that this rig takes; ramps last up to half a move. */
static void open_moves(blind_chance *c, double clean_time, blind_recorded *r)
{
  const double faster = blind_filling_time(&r->t.base) / clean_time;
  const blind_schedule *s = &r->t.fit;
  size_t i;
  r->n_moves = (int)s->n;
  r->end = s->end * faster;
  for (i = 0; i < s->n; i++) {
    const double next = i + 1 < s->n ? s->t[i + 1] : s->end, share = blind_uniform(c, 0.1, 0.5);
    r->move[i] = (blind_move){s->t[i] * faster, s->u[i], has(r, BLIND_RAMPS) ? share * (next - s->t[i]) * faster : 0};
  }
}

/* Set positions over the whole stroke, some at its ends; a fifth of the moves are slow, all where there are ramps. */
static void set_moves(blind_chance *c, blind_recorded *r)
{
  const double time = blind_filling_time(&r->t.base);
  double t = 0.5 + blind_uniform(c, 0, 1);
  int i;
  r->n_moves = 12;
  for (i = 0; i < r->n_moves; i++) {
    const double at = blind_uniform(c, 0, 1), to = blind_uniform(c, 0.08, 0.92), slow = blind_uniform(c, 0, 1);
    const double hold = time * blind_uniform(c, 0.8, 2.4), ramp = hold * blind_uniform(c, 0.2, 0.6);
    r->move[i].t = t;
    r->move[i].to = at < 0.12 ? 0 : at < 0.22 ? 1 : floor(to * 200 + 0.5) / 200;
    r->move[i].ramp = has(r, BLIND_RAMPS) || slow < 0.2 ? ramp : 0;
    t += hold;
  }
  r->end = t;
}

/* From the first set position slowly to the other side of the stroke, in half of the trials with as long a way back,
 * over a third of the log or more; moves that would fall into that are not made. */
static void draw_long_ramps(blind_chance *c, blind_recorded *r)
{
  const double share = blind_uniform(c, 1.0 / 3, 1), side = blind_uniform(c, 0.05, 0.3);
  const int ways = blind_uniform(c, 0, 1) < 0.5 ? 1 : 2;
  const double begins = r->move[1].t, lasts = fmin(share * r->end, r->end - begins), way = lasts / ways;
  const double from = r->move[0].to, to = from < 0.5 ? 1 - side : side;
  int next = 1;
  if (r->loop == BLIND_OPEN)
    r->has &= ~(1u << BLIND_LONG_RAMPS);
  if (!has(r, BLIND_LONG_RAMPS))
    return;
  while (next < r->n_moves && r->move[next].t < begins + lasts)
    next++;
  memmove(&r->move[1 + ways], &r->move[next], (size_t)(r->n_moves - next) * sizeof r->move[0]);
  r->n_moves += 1 + ways - next;
  r->move[1] = (blind_move){begins, to, way};
  if (ways == 2)
    r->move[2] = (blind_move){begins + way, from, way};
}

/* A slow logger keeps on longer, with longer holds, up to some minutes. What takes minutes is run in longer steps,
 * where no effect asks for short ones. */
static void stretch(blind_recorded *r)
{
  const double usual = 4e-5, long_step = 1e-4;
  const double rows = 300, longest = 300, least = rows * r->spacing;
  const double factor = fmax(1, fmin(least, longest) / r->end);
  int i;
  for (i = 0; i < r->n_moves; i++) {
    r->move[i].t *= factor;
    r->move[i].ramp *= factor;
  }
  r->end *= factor;
  if (r->loop != BLIND_OPEN && r->t.step >= usual)
    r->t.step = long_step;
}

static void draw_positioner(blind_chance *c, second_positioner *k)
{
  const double kind = blind_uniform(c, 0, 1), integral = blind_log_uniform(c, 5, 60);
  const double derivative = blind_log_uniform(c, 0.02, 0.2), cut = blind_uniform(c, 0, 1);
  k->gain = floor(blind_log_uniform(c, 5, 40) * 10 + 0.5) / 10;
  k->integral_time = kind < 0.3 ? floor(integral * 10 + 0.5) / 10 : 0;
  k->derivative_time = kind > 0.8 ? floor(derivative * 1000 + 0.5) / 1000 : 0;
  k->dead_band = floor(blind_log_uniform(c, 0.1, 1) * 100 + 0.5) / 1e4;
  k->cutoff_low = cut < 0.6 ? 0.01 : 0;
  k->cutoff_high = cut < 0.6 ? 0.99 : 1;
  k->cycle = 1e-3;
}

static void draw_integral(blind_chance *c, blind_recorded *r)
{
  const double opens = blind_uniform(c, -BLIND_INTEGRAL_OPENS, BLIND_INTEGRAL_OPENS);
  if (r->loop == BLIND_OPEN || r->positioner.integral_time == 0)
    r->has &= ~(1u << BLIND_INTEGRAL);
  r->positioner.integral_start = has(r, BLIND_INTEGRAL) ? opens / r->positioner.gain : 0;
}

/* Rows a second of each way to log; a whole number of milliseconds, or of a fifth of one, between rows. */
static double draw_spacing(blind_chance *c, int loop)
{
  static const double least[BLIND_LOOPS] = {20, 50, 5, 1};
  const double rate = blind_log_uniform(c, least[loop], 200), unit = rate > 50 ? 2e-4 : 1e-3;
  return floor(1 / rate / unit + 0.5) * unit;
}

/* ---- Sensors and logger ---- */

/* One of the sensors, or both. */
static void draw_sensors(blind_chance *c, int any, double lo, double hi, double of[BLIND_SENSORS])
{
  const int which = 1 + blind_below(c, 3);
  int i;
  for (i = 0; i < BLIND_SENSORS; i++) {
    const double size = blind_log_uniform(c, lo, hi);
    of[i] = any && which & (1 << i) ? size : 0;
  }
}

static void draw_filters(blind_chance *c, blind_recorded *r)
{
  const double both = blind_uniform(c, 5e-3, 30e-3), other = blind_uniform(c, 5e-3, 30e-3);
  const int alike = blind_uniform(c, 0, 1) < 0.5;
  r->filter[0] = has(r, BLIND_FILTER) ? both : 0;
  r->filter[1] = !has(r, BLIND_FILTER) ? 0 : alike ? both : other;
}

/* Time is rounded to one of these, where rows stay apart. */
static const double roundings[] = {1e-3, 2e-3, 5e-3, 10e-3};

static void draw_logger(blind_chance *c, blind_recorded *r)
{
  const double jitter = blind_log_uniform(c, 0.3e-3, 3e-3), lost = blind_uniform(c, 0.003, 0.03);
  const double at = blind_uniform(c, 0.2, 0.8), gap = blind_uniform(c, 0.2, 1);
  const double told = blind_log_uniform(c, 0.4, 2.5), memory = blind_log_uniform(c, 0.02, 0.5);
  const int bits = 10 + blind_below(c, 3);
  int which = blind_below(c, 4);
  while (which > 0 && roundings[which] > r->spacing)
    which--;
  r->rounding = has(r, BLIND_ROUNDING) ? roundings[which] : 0;
  r->jitter = has(r, BLIND_JITTER) ? fmin(jitter, 0.2 * r->spacing) : 0;
  r->bits = has(r, BLIND_BITS) ? bits : 14;
  r->lost = has(r, BLIND_DROPOUTS) ? lost : 0;
  r->gap_at = at * r->end;
  r->gap = has(r, BLIND_DROPOUTS) ? fmin(gap, 0.02 * r->end) : 0;
  r->memory = memory;
  r->noise_told = has(r, BLIND_NOISE_UNTOLD) ? 0 : has(r, BLIND_NOISE_WRONG) ? told : 1;
}

static void draw_spoils(blind_chance *c, blind_recorded *r)
{
  int i;
  draw_filters(c, r);
  draw_logger(c, r);
  draw_sensors(c, has(r, BLIND_HUM), 3e-4, 2e-3, r->hum);
  r->mains = blind_uniform(c, 49.95, 50.05);
  draw_sensors(c, has(r, BLIND_COLOUR), 0.5, 2, r->colour);
  draw_sensors(c, has(r, BLIND_DRIFT), 1e-3, 5e-3, r->drift);
  for (i = 0; i < BLIND_SENSORS; i++)
    r->drift[i] *= blind_uniform(c, 0, 1) < 0.5 ? -1 : 1;
}

/* ---- The whole ---- */

static void draw_kinds(blind_chance *c, blind_chance *apart, unsigned without, blind_recorded *r)
{
  const int plain = blind_uniform(c, 0, 1) < plain_share;
  int i;
  for (i = 0; i < BLIND_IMPERFECTIONS; i++) {
    const int drawn = blind_uniform(i < BLIND_TURBULENT ? c : apart, 0, 1) < blind_imperfections[i].share;
    if (drawn && (!plain || i == BLIND_TURBULENT) && !(without & (1u << i)))
      r->has |= 1u << i;
  }
  if (!may_begin(&r->t))
    r->has &= ~(1u << BLIND_ONSET);
  if (has(r, BLIND_NOISE_UNTOLD))
    r->has &= ~(1u << BLIND_NOISE_WRONG);
  if (has(r, BLIND_ONSET) && r->t.n_missing == 0) /* which is beyond */
    r->has &= ~(1u << BLIND_BEYOND);
  if (!any_line(&r->t))
    r->has &= ~(1u << BLIND_TURBULENT);
}

/* Which channels a loop is logged with; those that the effects are seen in are never left out. */
static void draw_loop(blind_chance *c, blind_recorded *r)
{
  const double at = blind_uniform(c, 0, 1);
  int i, wanted = 0;
  for (i = 0; i < r->t.n_missing; i++)
    wanted |= r->t.missing[i].effect->channels;
  if (!has(r, BLIND_POSITIONER))
    return;
  r->loop = at < 0.25 ? BLIND_LOOP_U : at < 0.65 || wanted & BLIND_P ? BLIND_LOOP_P : BLIND_LOOP_X;
  r->t.channels = (r->loop == BLIND_LOOP_X ? BLIND_X : BLIND_P | BLIND_X) | (wanted & BLIND_T);
}

void blind_draw_recorded(uint64_t seed, int number, unsigned without, blind_recorded *r)
{
  blind_chance c = blind_chance_of(seed + 1000003, (uint64_t)number);
  blind_chance of_vent = blind_chance_of(seed + 2000003, (uint64_t)number);
  blind_chance apart = blind_chance_of(seed + 3000003, (uint64_t)number);
  double clean_time, at;
  memset(r, 0, sizeof *r);
  blind_draw(seed, number, &r->t);
  clean_time = blind_filling_time(&r->t.base);
  draw_kinds(&c, &apart, without, r);
  draw_loop(&c, r);
  draw_told(&c, r);
  r->vent = 1 + BLIND_VENT_KNOWN * normal(&of_vent);
  draw_values(&c, r);
  draw_lines(&apart, r);
  r->spacing = draw_spacing(&c, r->loop);
  draw_positioner(&c, &r->positioner);
  draw_integral(&apart, r);
  if (r->loop == BLIND_OPEN)
    open_moves(&c, clean_time, r);
  else
    set_moves(&c, r);
  draw_long_ramps(&apart, r);
  stretch(r);
  at = blind_uniform(&c, 0.3, 0.7) * r->end;
  r->onset = has(r, BLIND_ONSET) ? at : (double)NAN;
  draw_spoils(&c, r);
  r->seed = blind_bits(&c);
}
