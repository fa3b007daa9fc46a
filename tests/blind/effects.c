#include "effects.h"

#include <math.h>
#include <string.h>

/* ---- Scales ---- */

static double fill_area(const second_rig *g)
{
  return g->fill_area;
}

static double piston_area(const second_rig *g)
{
  return g->area;
}

static double stroke(const second_rig *g)
{
  return g->stroke;
}

static double supply(const second_rig *g)
{
  return g->supply;
}

static double dry_friction(const second_rig *g)
{
  return g->dry_friction;
}

static double dead_volume(const second_rig *g)
{
  return g->dead_volume;
}

static double spring_rate(const second_rig *g)
{
  return g->spring_rate;
}

/* A wall that gives way by the dead volume itself at supply pressure. */
static double per_supply(const second_rig *g)
{
  return 1 / g->supply;
}

static double chamber_volume(const second_rig *g)
{
  return g->dead_volume + g->area * g->stroke;
}

/* A cubic spring that gives at full stroke what the spring itself gives. */
static double cubic(const second_rig *g)
{
  return g->spring_rate / (g->stroke * g->stroke);
}

double blind_full_flow(const second_rig *g)
{
  const double choked = 0.6847; /* sqrt(gamma) (2/(gamma + 1))^3 for air */
  return choked * g->fill_area * (g->supply + g->ambient) / sqrt(g->gas_constant * g->supply_temperature);
}

double blind_filling_time(const second_rig *g)
{
  return chamber_volume(g) * (g->supply + g->ambient) / (g->gas_constant * g->ambient_temperature * blind_full_flow(g));
}

/* A resistance that takes the whole supply pressure at full flow. */
static double resistance(const second_rig *g)
{
  return g->supply / blind_full_flow(g);
}

/* A laminar gap that passes the full flow at supply pressure. */
static double laminar(const second_rig *g)
{
  const double P = g->supply + g->ambient;
  return blind_full_flow(g) / (P * P - g->ambient * g->ambient);
}

/* A film that carries as much heat per kelvin as the full flow does. */
static double film(const second_rig *g)
{
  return blind_full_flow(g) * g->gas_constant * g->gamma / (g->gamma - 1);
}

static double film_resistance(const second_rig *g)
{
  return 1 / film(g);
}

/* ---- Effects that are more than a number in a field ---- */

static void choke(second_rig *g, double size)
{
  (void)size;
  g->flow = SECOND_CHOKED;
}

static void insulate(second_rig *g, double size)
{
  g->gas = SECOND_ENERGY;
  g->heat = 1 / size;
}

static void compress_by_power(second_rig *g, double size)
{
  g->gas = SECOND_ENERGY;
  g->exponent = 1 + size;
}

static void bend_bristles(second_rig *g, double size)
{
  g->bristle_rate = g->dry_friction / size;
}

static void soften_stops(second_rig *g, double size)
{
  g->lower_rate = g->upper_rate = 1 / size;
}

static void shorten_travel(second_rig *g, double size)
{
  g->travel_limit = g->stroke - size;
}

static void restrict_vent(second_rig *g, double size)
{
  g->vent_area *= 1 - size;
}

static void warm_wall(second_rig *g, double size)
{
  g->wall_capacity = 1 / size;
}

static void narrow_supply(second_rig *g, double size)
{
  g->supply_droop = size;
  g->supply_turbulence = 1;
}

static void narrow_tube(second_rig *g, double size)
{
  g->tube_resistance = size;
  g->tube_turbulence = 1;
}

/* ---- The table ---- */

#define AT(name) offsetof(second_rig, name)

/* Ranges run from what cannot be seen to what nobody overlooks; in the middle stands the usual size. */
const blind_effect blind_effects[] = {
    /* mass */
    {"chamber_leak", "mass", "leak", "m2", 1e-4, 0.05, fill_area, .field = AT(leak_area)},
    {"laminar_leak", "mass", "leak", "kg/s/Pa2", 1e-4, 0.05, laminar, .field = AT(laminar_leak)},
    {"porous_leak", "mass", "leak", "kg/s/Pa2", 1e-4, 0.05, laminar, .field = AT(porous_leak),
     .shape = {{"crossover", AT(crossover), 0.5, 2, supply}}},
    {"choked_flow", "mass", "flow law", "1", 1, 1, .apply = choke, .setting = BLIND_PAPER_FLOW},
    {"supply_droop", "mass", "fill", "Pa.s/kg", 1e-4, 0.2, resistance, .field = AT(supply_droop)},
    {"exhaust_back_pressure", "mass", "vent", "Pa.s/kg", 2e-4, 0.2, resistance, .field = AT(back_pressure)},
    {"vent_restriction", "mass", "vent", "1", 1e-4, 0.3, .either_sign = 1, .apply = restrict_vent},
    {"connecting_tube", "mass", "line", "Pa.s/kg", 2e-3, 0.2, resistance, .field = AT(tube_resistance),
     .shape = {{"tube_volume", AT(tube_volume), 0.3, 1, dead_volume}}, .step = 2e-5},
    /* energy */
    {"heat_transfer", "energy", "heat", "K/W", 5e-4, 2, film_resistance, .apply = insulate,
     .setting = BLIND_ISOTHERMAL},
    {"heat_transfer", "energy", "heat", "W/K", 1e-3, 2, film, .field = AT(heat), .setting = BLIND_ADIABATIC},
    {"chamber_exponent", "energy", "heat", "1", 1e-3, 0.3, .apply = compress_by_power, .setting = BLIND_ISOTHERMAL},
    {"wall_temperature", "energy", "heat", "K/J", 1e-3, 0.2, .apply = warm_wall,
     .shape = {{"wall_loss", AT(wall_loss), 0.3, 3}}, .setting = BLIND_FILM},
    /* command */
    {"transducer_lag", "command", "delay", "s", 2e-4, 0.1, .field = AT(transducer_lag)},
    {"dead_time", "command", "delay", "s", 2e-4, 0.1, .field = AT(dead_time)},
    /* force */
    {"stribeck_friction", "force", "sticking", "1", 0.01, 1, .field = AT(stribeck),
     .shape = {{"stribeck_velocity", AT(stribeck_velocity), 5e-4, 3e-3}}, .step = 2e-5},
    {"presliding", "force", "sticking", "m", 1e-6, 5e-4, .apply = bend_bristles,
     .shape = {{"bristle_damping", AT(bristle_damping), 300, 3000}}, .step = 2e-5},
    {"friction_position", "force", "friction", "1", 1e-3, 1, .either_sign = 1, .field = AT(friction_position)},
    {"friction_pressure", "force", "friction", "m2", 1e-4, 0.02, piston_area, .field = AT(friction_pressure)},
    {"spring_hardening", "force", "bend", "N/m3", 3e-4, 0.1, cubic, .either_sign = 1, .field = AT(spring_cubic)},
    {"spring_hysteresis", "force", "sticking", "N", 3e-3, 1, dry_friction, .field = AT(hysteresis),
     .shape = {{"hysteresis_length", AT(hysteresis_length), 0.02, 0.2, stroke}}},
    {"area_variation", "force", "bend", "1", 3e-4, 0.15, .either_sign = 1, .field = AT(area_slope)},
    {"travel_limit", "force", "stops", "m", 3e-5, 0.2, stroke, .apply = shorten_travel},
    {"stop_compliance", "force", "stops", "m/N", 2e-10, 1e-7, .apply = soften_stops,
     .shape = {{"stop_damping", AT(stop_damping), 3e3, 3e4}}, .step = 2e-5},
    /* sensor */
    {"pressure_bias", "sensor", "pressure sensor", "Pa", 5e-5, 0.02, supply, .either_sign = 1,
     .field = AT(pressure_bias), .channels = BLIND_P},
    {"pressure_gain", "sensor", "pressure sensor", "1", 1e-4, 0.05, .either_sign = 1, .field = AT(pressure_gain),
     .channels = BLIND_P},
    {"pressure_lag", "sensor", "pressure sensor", "s", 2e-4, 0.1, .field = AT(pressure_lag), .channels = BLIND_P},
    {"position_bias", "sensor", "position sensor", "m", 5e-5, 0.02, stroke, .either_sign = 1,
     .field = AT(position_bias), .channels = BLIND_X},
    {"position_gain", "sensor", "position sensor", "1", 1e-4, 0.05, .either_sign = 1, .field = AT(position_gain),
     .channels = BLIND_X},
    {"position_lag", "sensor", "position delay", "s", 2e-4, 0.1, .field = AT(position_lag), .channels = BLIND_X},
    {"channel_skew", "sensor", "position delay", "s", 1e-4, 0.1, .either_sign = 1, .field = AT(position_skew),
     .channels = BLIND_P | BLIND_X},
    {"temperature_lag", "sensor", "temperature sensor", "s", 1e-4, 2, .field = AT(temperature_lag),
     .channels = BLIND_P | BLIND_X | BLIND_T, .setting = BLIND_FILM},
    /* what gives way slowly */
    {"chamber_creep", "mass", "volume", "1/Pa", 1e-3, 0.3, per_supply, .field = AT(growth),
     .shape = {{"volume_time", AT(growth_time), 0.3, 5, blind_filling_time}}},
    {"spring_creep", "force", "creep", "N/m", 1e-3, 0.5, spring_rate, .field = AT(creep),
     .shape = {{"creep_time", AT(creep_time), 0.3, 5, blind_filling_time}}},

    /* not in the catalogue */
    {"unlisted:friction_bump", "force", "", "N", 2e-3, 2, dry_friction, .field = AT(bump),
     .shape = {{"bump_at", AT(bump_at), 0.2, 0.8, stroke}, {"bump_width", AT(bump_width), 0.02, 0.1, stroke}}},
    {"unlisted:relief_valve", "mass", "", "m2", 2e-4, 0.3, fill_area, .field = AT(relief_area),
     .shape = {{"relief_from", AT(relief_from), 0.4, 0.8, supply},
               {"relief_span", AT(relief_span), 0.05, 0.2, supply}}},
    {"unlisted:supply_pulsation", "mass", "", "Pa", 2e-4, 0.1, supply, .field = AT(pulsation),
     .shape = {{"pulsation_rate", AT(pulsation_rate), 0.3, 3}}},
    {"unlisted:periodic_force", "force", "", "N", 1e-3, 1, dry_friction, .field = AT(force),
     .shape = {{"force_rate", AT(force_rate), 0.3, 3}}},
};
const int blind_effect_count = sizeof blind_effects / sizeof blind_effects[0];

/* A kink, a filter, a valve or a fitting, which takes 0.3 to 30 % of the supply pressure at full flow. Supply lines
 * hold 17 to 250 mL beside a chamber of 0.84 L. Air that follows within a tenth of a millisecond needs short steps. */
static const blind_effect turbulent[] = {
    {"supply_droop", "mass", "fill", "Pa.s/kg", 3e-3, 0.3, resistance, .apply = narrow_supply,
     .shape = {{"supply_volume", AT(supply_volume), 0.02, 0.3, chamber_volume}}, .step = 2e-5},
    {"connecting_tube", "mass", "line", "Pa.s/kg", 3e-3, 0.3, resistance, .apply = narrow_tube,
     .shape = {{"tube_volume", AT(tube_volume), 0.3, 1, dead_volume}}, .step = 2e-5},
};

/* ---- What is asked of it ---- */

int blind_is_listed(const blind_effect *effect)
{
  return strncmp(effect->name, "unlisted:", 9) != 0;
}

int blind_listed_count(void)
{
  int n = 0;
  while (n < blind_effect_count && blind_is_listed(&blind_effects[n]))
    n++;
  return n;
}

const blind_effect *blind_effect_named(const char *name)
{
  int i;
  for (i = 0; i < blind_effect_count; i++)
    if (strcmp(blind_effects[i].name, name) == 0)
      return &blind_effects[i];
  return NULL;
}

const blind_effect *blind_turbulent_of(const blind_effect *effect)
{
  size_t i;
  for (i = 0; i < sizeof turbulent / sizeof turbulent[0]; i++)
    if (strcmp(turbulent[i].name, effect->name) == 0)
      return &turbulent[i];
  return NULL;
}

double blind_scale_of(blind_scale *scale, const second_rig *rig)
{
  return scale ? scale(rig) : 1;
}

double *blind_field(second_rig *rig, size_t offset)
{
  return (double *)(void *)((char *)rig + offset);
}

void blind_effect_apply(const blind_effect *effect, double size, const double *shape, second_rig *rig)
{
  int i;
  if (effect->apply)
    effect->apply(rig, size);
  else
    *blind_field(rig, effect->field) = size;
  for (i = 0; i < BLIND_SHAPES && effect->shape[i].name; i++)
    *blind_field(rig, effect->shape[i].field) = shape[i];
}
