/* The virtual rig: laws and effects first, then the integrator with its events, then the measuring chain.
 * SPDX-License-Identifier: MIT */
#include "rig.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define TAU 6.283185307179586476925

/* M and U are the gas, the rest of the first block belongs to effects, then lags of sensors, then integrals for the
 * audit. */
enum {
  M,
  U,
  X,
  V,
  LATE,
  LATER,
  LATEST,
  OPENING,
  INTEGRAL,
  WALL,
  TUBE,
  NEAR,
  IMPULSE,
  FEED,
  BRISTLE,
  HYST,
  CREEP,
  GROWN,
  P_LAG,
  X_LAG,
  T_LAG,
  MASS_IN,
  MASS_OUT,
  H_IN,
  H_OUT,
  HEAT,
  WORK,
  DRY,
  VISCOUS,
  OTHER,
  STATES
};

enum mode { REST, UP, DOWN, FREE /* bristle friction has no rest in mid-travel */ };

/* What a positioner has sent, the latest last, and what it remembers. */
enum { SENT = 512 };
typedef struct {
  double u[SENT], integral, error;
  long cycles;
} controller;

typedef struct {
  const second_rig *rig;
  const second_course *course;
  size_t latest;         /* command: those before it are over */
  controller positioner; /* where the course has one */
  double t, u;           /* u is the command in force during this step */
  double y[STATES];
  enum mode mode;
  double impact;
  long steps, events, forced;
} world;

/* What the laws need of a state. */
typedef struct {
  double P, p, T, V, A; /* absolute, gauge, temperature, volume, effective area */
} chamber;

/* ---- flow laws ---- */

/* Mass flow over upstream pressure, times sqrt(R T): the function of the pressure ratio alone. */
static double flow_function(const second_rig *g, double ratio)
{
  double n = g->gamma;
  double critical = pow(2.0 / (n + 1.0), n / (n - 1.0));
  double choked = sqrt(n) * pow(2.0 / (n + 1.0), (n + 1.0) / (2.0 * (n - 1.0)));
  if (g->flow == SECOND_PAPER)
    return sqrt(2.0 * (1.0 - ratio)); /* Ca sqrt(2 rho1 (P1 - P2)), rho1 = P1/(R T) */
  if (g->flow == SECOND_CHOKED) {
    if (ratio <= critical)
      return choked;
    return sqrt(2.0 * n / (n - 1.0) * (pow(ratio, 2.0 / n) - pow(ratio, (n + 1.0) / n)));
  }
  if (ratio <= g->iso_b)
    return choked;
  double s = (ratio - g->iso_b) / (1.0 - g->iso_b);
  return choked * pow(1.0 - s * s, g->iso_m);
}

/* Flow from pressure Pu at temperature Tu to Pd <= Pu. */
static double orifice_down(const second_rig *g, double area, double Pu, double Tu, double Pd)
{
  double ratio = Pd / Pu, most = 1.0 - g->linear_ratio, share = 1.0;
  if (ratio > most) {
    share = (1.0 - ratio) / g->linear_ratio;
    ratio = most;
  }
  return share * area * Pu / sqrt(g->gas_constant * Tu) * flow_function(g, ratio);
}

/* Signed flow from 1 to 2. */
static double orifice(const second_rig *g, double area, double P1, double T1, double P2, double T2)
{
  if (area <= 0.0 || P1 == P2)
    return 0.0;
  return P1 > P2 ? orifice_down(g, area, P1, T1, P2) : -orifice_down(g, area, P2, T2, P1);
}

/* Orifice in series with a linear resistance r before it (P1 falls) or behind it (P2 rises), P1 > P2:
 * q = f(P1 - r q, P2) or f(P1, P2 + r q). The right side falls with q, so the root is unique; false position finds it.
 */
static double orifice_in_series(const second_rig *g, double area, double P1, double T1, double P2, double r, int before)
{
  double lo = 0.0, hi = orifice(g, area, P1, T1, P2, T1);
  double glo = -hi, ghi = 0.0, q = hi;
  for (int i = 0; i < 100; i++) {
    double a = before ? P1 - r * q : P1, b = before ? P2 : P2 + r * q;
    double e = q - (a > b ? orifice(g, area, a, T1, b, T1) : 0.0);
    if (e > 0.0) {
      hi = q;
      ghi = e;
      glo *= i > 1 ? 0.5 : 1.0;
    } else {
      lo = q;
      glo = e;
      ghi *= i > 1 ? 0.5 : 1.0;
    }
    if (e == 0.0 || hi - lo <= 4.0 * DBL_EPSILON * hi)
      break;
    q = lo - glo * (hi - lo) / (ghi - glo);
    if (!(q > lo && q < hi))
      q = 0.5 * (lo + hi);
  }
  return q;
}

/* Area of the orifice of a line that loses r c q_f by it at the full, choked flow q_f of the fill orifice, taken for
 * little beside the supply pressure Ps: q_f = S a sqrt(Ps r c q_f). The law's a is that of a loss of 1/1000. */
static double line_area(const second_rig *g, double rc)
{
  const double little = 1e-3;
  double n = g->gamma, to_root = 1.0 / sqrt(g->gas_constant * g->supply_temperature);
  double full = sqrt(n) * pow(2.0 / (n + 1.0), (n + 1.0) / (2.0 * (n - 1.0))) * to_root * g->fill_area; /* q_f/Ps */
  double a = flow_function(g, 1.0 - little) * to_root / sqrt(little);
  return sqrt(full / rc) / a;
}

/* Signed flow from 1 to 2 through a line: with q_o of its orifice alone, s = q/q_o solves s^2 + 2 h s = 1, where 2 h is
 * what q_o would lose by friction, over the difference there is. */
static double line(const second_rig *g, double r, double c, double P1, double T1, double P2, double T2)
{
  double drop = P1 - P2, qo, h;
  if (c <= 0.0 || drop == 0.0)
    return drop / r;
  qo = orifice(g, line_area(g, r * c), P1, T1, P2, T2);
  h = r * (1.0 - c) * qo / (2.0 * drop);
  return qo / (h + sqrt(1.0 + h * h));
}

/* Pressure between a line from Ps and an orifice into P < Ps, where both pass the same: the surplus of the orifice
 * rises with that pressure. False position again. */
static double between_line_and_orifice(const second_rig *g, double area, double Ps, double P)
{
  double T = g->supply_temperature, r = g->supply_droop, c = g->supply_turbulence;
  double lo = P, hi = Ps, mid = P;
  double glo = -line(g, r, c, Ps, T, P, T), ghi = orifice(g, area, Ps, T, P, T);
  for (int i = 0; i < 200 && hi - lo > 2.0 * DBL_EPSILON * hi; i++) {
    mid = i % 3 == 2 ? 0.5 * (lo + hi) : lo - glo * (hi - lo) / (ghi - glo); /* the slope is infinite at both ends */
    mid = mid > lo && mid < hi ? mid : 0.5 * (lo + hi);
    double e = orifice(g, area, mid, T, P, T) - line(g, r, c, Ps, T, mid, T);
    if (e == 0.0)
      return mid;
    *(e > 0.0 ? &hi : &lo) = mid;
    *(e > 0.0 ? &ghi : &glo) = e;
  }
  return mid;
}

static double supply_at(const second_rig *g, double t)
{
  return g->ambient + g->supply + g->pulsation * sin(TAU * g->pulsation_rate * t);
}

/* What the transducer draws from the volume of the supply line. */
static double from_volume(const second_rig *g, const double *y, double area, double t, double P, double T, double *d)
{
  double Ts = g->supply_temperature, Pl = y[FEED] * g->gas_constant * Ts / g->supply_volume;
  double q = orifice(g, area, Pl, Ts, P, T);
  d[FEED] = line(g, g->supply_droop, g->supply_turbulence, supply_at(g, t), Ts, Pl, Ts) - q;
  return q;
}

static double from_supply(const second_rig *g, const double *y, double area, double t, double P, double T, double *d)
{
  double Ps = supply_at(g, t), Ts = g->supply_temperature;
  if (g->supply_volume > 0.0)
    return from_volume(g, y, area, t, P, T, d);
  if (g->supply_droop > 0.0 && Ps > P && area > 0.0) {
    if (g->supply_turbulence > 0.0)
      return orifice(g, area, between_line_and_orifice(g, area, Ps, P), Ts, P, Ts);
    return orifice_in_series(g, area, Ps, Ts, P, g->supply_droop, 1);
  }
  return orifice(g, area, Ps, Ts, P, T);
}

static double to_exhaust(const second_rig *g, double area, double P, double T)
{
  if (g->back_pressure > 0.0 && P > g->ambient && area > 0.0)
    return orifice_in_series(g, area, P, T, g->ambient, g->back_pressure, 0);
  return orifice(g, area, P, T, g->ambient, g->ambient_temperature);
}

/* ---- chamber ---- */

static double area_at(const second_rig *g, double x)
{
  return g->stroke > 0.0 ? g->area * (1.0 - g->area_slope * x / g->stroke) : g->area;
}

static double volume_at(const second_rig *g, double x)
{
  return g->dead_volume + 0.5 * (g->area + area_at(g, x)) * x; /* integral of a linear area */
}

/* With what the wall has given way. */
static double volume_of(const second_rig *g, const double *y)
{
  return volume_at(g, y[X]) + g->dead_volume * g->growth * y[GROWN];
}

/* What of it is at the far end of a long chamber, or all. */
static double far_volume(const second_rig *g, const double *y)
{
  return volume_of(g, y) / (1.0 + g->line_length);
}

/* The exponent by which the chamber's air stores energy. */
static double kappa(const second_rig *g)
{
  return g->exponent > 0.0 ? g->exponent : g->gamma;
}

static chamber chamber_of(const second_rig *g, const double *y)
{
  chamber c;
  c.V = far_volume(g, y);
  c.A = area_at(g, y[X]);
  c.P = (kappa(g) - 1.0) * y[U] / c.V;
  c.p = c.P - g->ambient;
  c.T = g->rate_exponent > 0.0 ? g->ambient_temperature : y[U] / y[M] * (kappa(g) - 1.0) / g->gas_constant;
  return c;
}

/* q enters the chamber from air at temperature T_from; if it is negative, -q leaves at the chamber's own. */
static void exchange(const second_rig *g, double *d, double q, double T_from, double T)
{
  double cp = kappa(g) / (kappa(g) - 1.0) * g->gas_constant;
  d[q > 0.0 ? MASS_IN : MASS_OUT] += fabs(q);
  d[q > 0.0 ? H_IN : H_OUT] += cp * fabs(q) * (q > 0.0 ? T_from : T);
}

/* What a positioner sees of the stem, in shares of the stroke. */
static double seen(const second_rig *g, double x)
{
  return ((1.0 + g->span) * x + g->zero) / g->stroke;
}

/* What a positioner sends.  Out: flows, the share of its error that the integral takes up */
static double law(const second_positioner *k, double set, double e, double integral, double rate, double *flows)
{
  double u = k->gain * (e + integral + k->derivative_time * rate);
  int off = set < k->cutoff_low || set > k->cutoff_high;
  *flows = 0.0;
  if (off)
    return set < k->cutoff_low ? -1.0 : 1.0;
  if (k->dead_band > 0.0 && fabs(e) <= k->dead_band)
    return 0.0;
  *flows = fabs(u) < 1.0;
  return fmin(fmax(u, -1.0), 1.0);
}

static int is_continuous(const world *w)
{
  return w->course->positioner && w->course->positioner->cycle == 0.0;
}

/* What is asked of the spool.  Out: d, where a positioner works all the time */
static double asked(const world *w, const double *y, double *d)
{
  const second_rig *g = w->rig;
  const second_positioner *k = w->course->positioner;
  if (!is_continuous(w))
    return w->u;
  double e = w->u - seen(g, y[X]), u;
  double flows;
  u = law(k, w->u, e, y[INTEGRAL], -(1.0 + g->span) * y[V] / g->stroke, &flows);
  d[INTEGRAL] = k->integral_time <= 0.0 ? 0.0 : flows * e / k->integral_time;
  return u;
}

/* The share of the dead time that stands for it within a loop: three lags in a row, each of a third. What a controller
 * that works by turns has sent comes late by the dead time itself. */
static double waits(const world *w)
{
  return is_continuous(w) ? w->rig->dead_time / 3.0 : 0.0;
}

/* What comes of what is asked, dead time later. */
static double arrived(const world *w, const double *y, double ask, double *d)
{
  double wait = waits(w);
  if (wait <= 0.0)
    return ask;
  d[LATE] = (ask - y[LATE]) / wait;
  d[LATER] = (y[LATE] - y[LATER]) / wait;
  d[LATEST] = (y[LATER] - y[LATEST]) / wait;
  return y[LATEST];
}

/* How far a port of the spool is open, the fill port for u and the vent port for -u. */
static double port(const second_rig *g, double u)
{
  double s = u - g->bend * u * (1.0 - fabs(u));
  return fmax(0.0, (s - g->overlap) / (1.0 - g->overlap));
}

/* Air that moves along a bore: its impulse follows the force of the pressures at either end and that of the wall, by
 * Darcy and Weisbach with the friction factor of laminar flow or of a smooth bore, whichever is far the larger. */
static double along_bore(const second_rig *g, double impulse, double rho, double length, double force)
{
  const double viscosity = 1.82e-5, pi = TAU / 2.0;
  double bore = sqrt(4.0 * g->area / pi), speed = impulse / (rho * g->area * length);
  double reynolds = fmax(rho * fabs(speed) * bore / viscosity, 1e-12);
  double factor = pow(pow(64.0 / reynolds, 4.0) + pow(0.3164 * pow(reynolds, -0.25), 4.0), 0.25);
  double shear = factor / 8.0 * rho * speed * fabs(speed);
  return force - g->line_friction * shear * pi * bore * length;
}

/* Transducer into the near end of a long chamber, and from there to the far one, isothermal on the way. */
static void along_chamber(const second_rig *g, const double *y, double t, double fill, double vent, const chamber *c,
                          double *d)
{
  double Ta = g->ambient_temperature, RT = g->gas_constant * Ta, whole = volume_of(g, y);
  double Pn = y[NEAR] * RT / (whole - c->V), length = g->line_length * whole / g->area;
  double q = y[IMPULSE] / length;
  d[NEAR] = from_supply(g, y, fill, t, Pn, Ta, d) - to_exhaust(g, vent, Pn, Ta) - q;
  d[IMPULSE] = along_bore(g, y[IMPULSE], (Pn + c->P) / 2.0 / RT, length, (Pn - c->P) * g->area);
  exchange(g, d, q, Ta, c->T);
}

/* Transducer, directly or through a tube whose air is at ambient temperature. */
static void transducer(const world *w, const double *y, double t, const chamber *c, double *d)
{
  const second_rig *g = w->rig;
  double ask = arrived(w, y, asked(w, y, d), d), u = g->transducer_lag > 0.0 ? y[OPENING] : ask;
  double fill = port(g, u) * g->fill_area, vent = port(g, -u) * g->vent_area;
  if (g->transducer_lag > 0.0)
    d[OPENING] = (ask - y[OPENING]) / g->transducer_lag;
  if (g->line_length > 0.0) {
    along_chamber(g, y, t, fill, vent, c, d);
    return;
  }
  if (g->tube_volume <= 0.0) {
    exchange(g, d, from_supply(g, y, fill, t, c->P, c->T, d), g->supply_temperature, c->T);
    exchange(g, d, -to_exhaust(g, vent, c->P, c->T), g->ambient_temperature, c->T);
    return;
  }
  double Ta = g->ambient_temperature, Pt = y[TUBE] * g->gas_constant * Ta / g->tube_volume;
  double q = line(g, g->tube_resistance, g->tube_turbulence, Pt, Ta, c->P, c->T);
  d[TUBE] = from_supply(g, y, fill, t, Pt, Ta, d) - to_exhaust(g, vent, Pt, Ta) - q;
  exchange(g, d, q, Ta, c->T);
}

static void leaks(const second_rig *g, const chamber *c, double *d)
{
  double Pa = g->ambient, Ta = g->ambient_temperature, area = g->leak_area;
  if (g->relief_area > 0.0 && c->p > g->relief_from)
    area += g->relief_area * fmin(1.0, (c->p - g->relief_from) / g->relief_span);
  exchange(g, d, -orifice(g, area, c->P, c->T, Pa, Ta), Ta, c->T);
  if (g->porous_leak > 0.0) {
    double s = c->P * c->P - Pa * Pa, half = g->crossover * g->crossover / 2.0;
    double q = g->porous_leak * (sqrt(half * half + 2.0 * half * fabs(s)) - half);
    exchange(g, d, s > 0.0 ? -q : q, Ta, c->T);
  }
  exchange(g, d, -g->laminar_leak * (c->P * c->P - Pa * Pa), Ta, c->T);
}

/* Heat from the wall; the wall has a temperature of its own if it has a capacity. */
static double wall_heat(const second_rig *g, const double *y, const chamber *c, double *d)
{
  double Tw = g->wall_capacity > 0.0 ? y[WALL] : g->ambient_temperature;
  double q = (g->heat + g->heat_natural * cbrt(fabs(Tw - c->T))) * (Tw - c->T);
  if (g->wall_capacity > 0.0)
    d[WALL] = (g->wall_loss * (g->ambient_temperature - Tw) - q) / g->wall_capacity;
  return q;
}

static void gas_rates(const world *w, const double *y, double t, const chamber *c, double *d)
{
  const second_rig *g = w->rig;
  double cv = g->gas_constant / (kappa(g) - 1.0);
  transducer(w, y, t, c, d);
  leaks(g, c, d);
  d[M] = d[MASS_IN] - d[MASS_OUT];
  d[GROWN] = g->growth_time > 0.0 ? (c->p - y[GROWN]) / g->growth_time : 0.0;
  d[WORK] = c->P * (c->A * y[V] + g->dead_volume * g->growth * d[GROWN]);
  if (g->gas == SECOND_ISOTHERMAL) { /* U = m cv Ta; the heat is whatever that takes */
    d[U] = cv * g->ambient_temperature * d[M];
    if (g->rate_exponent > 0.0) /* d(P V)/dt, of V dP/dt = n (R T dM/dt - P dV/dt) */
      d[U] += (g->rate_exponent - 1.0) * (d[U] - d[WORK] / (kappa(g) - 1.0));
    d[HEAT] = d[U] - d[H_IN] + d[H_OUT] + d[WORK];
  } else {
    d[HEAT] = wall_heat(g, y, c, d);
    d[U] = d[H_IN] - d[H_OUT] + d[HEAT] - d[WORK];
  }
}

/* ---- stem ---- */

static double lower_stop(const second_rig *g)
{
  return g->lower_rate > 0.0 ? -HUGE_VAL : 0.0;
}

static double rigid_limit(const second_rig *g)
{
  return g->travel_limit > 0.0 ? g->travel_limit : g->stroke;
}

static double upper_stop(const second_rig *g)
{
  return g->upper_rate > 0.0 ? HUGE_VAL : rigid_limit(g);
}

/* What the stem works against besides main spring and friction: hysteresis, elastic stops, an added force. */
static double other_forces(const second_rig *g, const double *y, double t)
{
  double f = g->hysteresis * y[HYST] + g->creep * (y[X] - y[CREEP]) + g->force * sin(TAU * g->force_rate * t);
  double over = y[X] - rigid_limit(g);
  if (g->upper_rate > 0.0 && over > 0.0)
    f += fmax(0.0, g->upper_rate * over + g->stop_damping * y[V]);
  if (g->lower_rate > 0.0 && y[X] < 0.0)
    f += fmin(0.0, g->lower_rate * y[X] + g->stop_damping * y[V]);
  return f;
}

static double spring_force(const second_rig *g, double x)
{
  return g->spring_rate * (x + g->spring_preload) + g->spring_cubic * x * x * x;
}

static double spring_energy(const second_rig *g, double x)
{
  double s = x + g->spring_preload, q = x * x;
  return 0.5 * g->spring_rate * s * s + 0.25 * g->spring_cubic * q * q;
}

/* Magnitude of dry friction at velocity v. */
static double dry_friction(const second_rig *g, double x, double v, double p)
{
  double f = g->dry_friction;
  if (g->stroke > 0.0)
    f *= 1.0 + g->friction_position * x / g->stroke;
  f += g->friction_pressure * fabs(p);
  if (g->bump_width > 0.0) {
    double s = (x - g->bump_at) / g->bump_width;
    f += g->bump * exp(-s * s);
  }
  if (g->stribeck_velocity > 0.0) {
    double s = v / g->stribeck_velocity;
    f *= 1.0 + g->stribeck * exp(-s * s);
  }
  return f;
}

/* Force left over for friction and inertia; friction must carry all of it at rest. */
static double push(const second_rig *g, const double *y, double t, const chamber *c)
{
  return c->p * c->A - spring_force(g, y[X]) - other_forces(g, y, t);
}

/* Friction of the present mode. LuGre: f = s0 z + s1 dz/dt, dz/dt = v - s0 |v| z / F(v). */
static double friction(const world *w, const double *y, const chamber *c, double *d)
{
  const second_rig *g = w->rig;
  double f = dry_friction(g, y[X], y[V], c->p);
  if (w->mode == UP || w->mode == DOWN)
    return w->mode == UP ? f : -f;
  d[BRISTLE] = y[V] - g->bristle_rate * fabs(y[V]) * y[BRISTLE] / f;
  return g->bristle_rate * y[BRISTLE] + g->bristle_damping * d[BRISTLE];
}

static void stem_rates(const world *w, const double *y, double t, const chamber *c, double *d)
{
  const second_rig *g = w->rig;
  if (g->creep_time > 0.0)
    d[CREEP] = (y[X] - y[CREEP]) / g->creep_time;
  if (w->mode == REST)
    return;
  double f = friction(w, y, c, d), v = y[V];
  d[X] = v;
  d[V] = (push(g, y, t, c) - g->viscous * v - f) / g->mass;
  d[DRY] = f * v;
  d[VISCOUS] = g->viscous * v * v;
  d[OTHER] = other_forces(g, y, t) * v;
  if (g->hysteresis_length > 0.0)
    d[HYST] = (v - y[HYST] * fabs(v)) / g->hysteresis_length;
}

static void sensor_rates(const second_rig *g, const double *y, const chamber *c, double *d)
{
  if (g->pressure_lag > 0.0)
    d[P_LAG] = (c->p - y[P_LAG]) / g->pressure_lag;
  if (g->position_lag > 0.0)
    d[X_LAG] = (y[X] - y[X_LAG]) / g->position_lag;
  if (g->temperature_lag > 0.0)
    d[T_LAG] = (c->T - y[T_LAG]) / g->temperature_lag;
}

static void rates(const world *w, const double *y, double t, double *d)
{
  chamber c = chamber_of(w->rig, y);
  memset(d, 0, STATES * sizeof *d);
  gas_rates(w, y, t, &c, d);
  stem_rates(w, y, t, &c, d);
  sensor_rates(w->rig, y, &c, d);
}

/* ---- integrator ---- */

static void runge_kutta(const world *w, const double *y, double h, double *out)
{
  double k[4][STATES], s[STATES];
  rates(w, y, w->t, k[0]);
  for (int stage = 1; stage < 4; stage++) {
    double part = stage < 3 ? 0.5 * h : h;
    for (int i = 0; i < STATES; i++)
      s[i] = y[i] + part * k[stage - 1][i];
    rates(w, s, w->t + part, k[stage]);
  }
  for (int i = 0; i < STATES; i++)
    out[i] = y[i] + h / 6.0 * (k[0][i] + 2.0 * (k[1][i] + k[2][i]) + k[3][i]);
  /* exactly, lest rounding warm the gas over millions of steps */
  if (w->rig->gas == SECOND_ISOTHERMAL && w->rig->rate_exponent <= 0.0)
    out[U] = out[M] * w->rig->gas_constant / (kappa(w->rig) - 1.0) * w->rig->ambient_temperature;
}

/* One step; with refinement on, two halves instead of one while that makes a difference. */
static void advance(const world *w, const double *y, double h, int depth, double *out)
{
  const second_rig *g = w->rig;
  runge_kutta(w, y, h, out);
  if (g->refine_tolerance <= 0.0 || depth == 0)
    return;
  double half[STATES], twice[STATES];
  world second = *w;
  second.t += 0.5 * h;
  runge_kutta(w, y, 0.5 * h, half);
  runge_kutta(&second, half, 0.5 * h, twice);
  double dU = fabs(twice[U] - out[U]) / out[U], dx = fabs(twice[X] - out[X]) / (g->stroke > 0.0 ? g->stroke : 1.0);
  memcpy(out, twice, sizeof twice);
  if (dU <= g->refine_tolerance && dx <= g->refine_tolerance)
    return;
  advance(w, y, 0.5 * h, depth - 1, half);
  advance(&second, half, 0.5 * h, depth - 1, out);
}

/* Not negative while the mode lasts. At rest: friction, or a stop, can carry the push. Moving: no reversal, no stop. */
static double guard(const world *w, const double *y, double t)
{
  const second_rig *g = w->rig;
  double low = lower_stop(g), high = upper_stop(g);
  if (w->mode == UP)
    return fmin(y[V], high - y[X]);
  if (w->mode == DOWN)
    return fmin(-y[V], y[X] - low);
  if (w->mode == FREE)
    return fmin(high - y[X], y[X] - low);
  chamber c = chamber_of(g, y);
  double n = push(g, y, t, &c), f = dry_friction(g, y[X], 0.0, c.p), least = HUGE_VAL;
  if (g->bristle_rate > 0.0) {
    n -= g->bristle_rate * y[BRISTLE];
    f = 0.0;
  }
  if (y[X] < high)
    least = f - n;
  if (y[X] > low)
    least = fmin(least, f + n);
  return least;
}

/* Velocity is zero, or a stop took it: where does the stem go? */
static void settle(world *w)
{
  const second_rig *g = w->rig;
  double *y = w->y, low = lower_stop(g), high = upper_stop(g);
  if (y[X] >= high || y[X] <= low || w->mode != FREE) {
    w->impact += 0.5 * g->mass * y[V] * y[V];
    y[V] = 0.0;
  }
  y[X] = fmin(fmax(y[X], low), high);
  w->mode = REST;
  if (g->bristle_rate > 0.0 && y[X] > low && y[X] < high)
    w->mode = FREE;
  else if (guard(w, y, w->t) < 0.0) {
    chamber c = chamber_of(g, y);
    double n = push(g, y, w->t, &c);
    w->mode = g->bristle_rate > 0.0 ? FREE : n > 0.0 ? UP : DOWN;
  }
}

/* Fraction of the step after which the mode has just ended, by bisection on repeated steps; `out` is the state there.
 */
static double cross(const world *w, double h, double *out)
{
  double lo = 0.0, hi = 1.0, trial[STATES];
  for (int i = 0; i < 60 && (hi - lo) * h > DBL_EPSILON * 1e-3; i++) {
    double mid = 0.5 * (lo + hi);
    advance(w, w->y, mid * h, 8, trial);
    if (guard(w, trial, w->t + mid * h) < 0.0) {
      hi = mid;
      memcpy(out, trial, sizeof trial);
    } else {
      lo = mid;
    }
  }
  return hi;
}

/* One step of the grid, through as many events as it holds; after too many the rest of it ignores events and is
 * counted. */
static void step_through(world *w, double h)
{
  const int too_many = 40;
  double left = h, next[STATES];
  for (int tries = 0; left > 0.0; tries++) {
    advance(w, w->y, left, 8, next);
    w->steps++;
    w->forced += tries == too_many;
    if (tries == too_many || guard(w, next, w->t + left) >= 0.0) {
      memcpy(w->y, next, sizeof next);
      return;
    }
    double part = cross(w, left, next) * left;
    memcpy(w->y, next, sizeof next);
    w->t += part;
    left -= part;
    w->events++;
    settle(w);
  }
}

/* ---- measuring chain ---- */

/* PCG-XSH-RR, 64 bits of state; then Box and Muller. */
static uint32_t draw(uint64_t *state)
{
  uint64_t s = *state;
  *state = s * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
  uint32_t mixed = (uint32_t)(((s >> 18) ^ s) >> 27), turn = (uint32_t)(s >> 59);
  return (mixed >> turn) | (mixed << ((32u - turn) & 31u));
}

static double gauss(uint64_t *state)
{
  double a = (draw(state) + 0.5) / 4294967296.0, b = (draw(state) + 0.5) / 4294967296.0;
  return sqrt(-2.0 * log(a)) * cos(TAU * b);
}

static double quantise(double y, double range)
{
  double q = range / 16384.0;
  return range > 0.0 ? floor(y / q + 0.5) * q : y;
}

static void sample(const world *w, const second_log *log, size_t i, double t, double u, uint64_t *noise)
{
  const second_rig *g = w->rig;
  chamber c = chamber_of(g, w->y);
  double p = g->pressure_lag > 0.0 ? w->y[P_LAG] : c.p, T = g->temperature_lag > 0.0 ? w->y[T_LAG] : c.T;
  p = (1.0 + g->pressure_gain) * p + g->pressure_bias + g->pressure_noise * gauss(&noise[0]);
  T += g->temperature_noise * gauss(&noise[2]);
  if (log->t)
    log->t[i] = t;
  if (log->u)
    log->u[i] = u;
  if (log->p)
    log->p[i] = quantise(p, g->pressure_range);
  if (log->T)
    log->T[i] = T;
  if (log->m)
    log->m[i] = w->y[M];
  if (log->v)
    log->v[i] = w->y[V];
}

static void sample_position(const world *w, const second_log *log, size_t i, uint64_t *noise)
{
  const second_rig *g = w->rig;
  double x = g->position_lag > 0.0 ? w->y[X_LAG] : w->y[X];
  x = (1.0 + g->position_gain) * x + g->position_bias + g->position_noise * gauss(&noise[1]);
  if (log->x)
    log->x[i] = quantise(x, g->position_range);
}

/* ---- run ---- */

static void start(world *w)
{
  const second_rig *g = w->rig;
  const second_positioner *k = w->course->positioner;
  double P = g->start_pressure > 0.0 ? g->start_pressure : g->ambient;
  double T = g->start_temperature > 0.0 ? g->start_temperature : g->ambient_temperature, *y = w->y, rate[STATES];
  y[X] = g->start_position;
  y[V] = g->start_velocity;
  if (g->lower_rate > 0.0 && y[X] == 0.0) /* the preload sits in the stop */
    y[X] = -g->spring_rate * g->spring_preload / (g->spring_rate + g->lower_rate);
  y[CREEP] = y[X];
  y[GROWN] = P - g->ambient;
  y[M] = P * far_volume(g, y) / (g->gas_constant * T);
  y[NEAR] = P * (volume_of(g, y) - far_volume(g, y)) / (g->gas_constant * g->ambient_temperature);
  y[U] = y[M] * g->gas_constant / (kappa(g) - 1.0) * T;
  y[TUBE] = P * g->tube_volume / (g->gas_constant * g->ambient_temperature);
  y[FEED] = supply_at(g, 0.0) * g->supply_volume / (g->gas_constant * g->supply_temperature);
  y[WALL] = g->ambient_temperature;
  y[P_LAG] = P - g->ambient;
  y[X_LAG] = y[X];
  if (k && k->integral_time > 0.0)
    y[INTEGRAL] = w->positioner.integral = k->integral_start;
  y[LATE] = y[LATER] = y[LATEST] = y[OPENING] = asked(w, y, rate);
  y[T_LAG] = T;
  w->mode = y[V] > 0.0 ? UP : DOWN;
  if (g->bristle_rate > 0.0)
    w->mode = FREE;
  if (y[V] == 0.0)
    settle(w);
}

/* A margin of rounding lets sums of times meet their changes. */
static const double margin = 1e-12;

/* Command sent at t, that is after a change at t. */
static double sent(const world *w, double t)
{
  const second_course *c = w->course;
  size_t i = w->latest;
  while (i < c->n && c->t_cmd[i] <= t + margin)
    i++;
  return i ? c->u_cmd[i - 1] : 0.0;
}

/* One cycle of the positioner, at w->t. */
static void control(world *w, const second_positioner *k)
{
  controller *c = &w->positioner;
  double set = sent(w, w->t), e = set - seen(w->rig, w->y[X]), rate = (e - c->error) / k->cycle;
  double share = k->integral_time > 0.0 ? k->cycle / k->integral_time : 0.0;
  double flows, u = law(k, set, e, c->integral + share * e, c->cycles ? rate : 0.0, &flows);
  c->integral += flows * share * e;
  c->error = e;
  c->u[c->cycles++ % SENT] = u;
}

/* Command at the valve at t, or at a positioner that works all the time: as sent; of one that works by turns what it sent
 * a dead time ago. */
static double command(const world *w, double t)
{
  const second_positioner *k = w->course->positioner;
  double delay = w->rig->dead_time;
  long cycle;
  if (!k || is_continuous(w))
    return sent(w, k ? t : t - delay);
  cycle = (long)floor((t - delay + margin) / k->cycle);
  return cycle < 0 ? 0.0 : w->positioner.u[cycle % SENT];
}

/* Where the command or the rig changes next. */
static double next_change(const world *w, double t, double limit)
{
  const second_course *c = w->course;
  double delay = is_continuous(w) ? 0.0 : w->rig->dead_time;
  double cycle = c->positioner ? c->positioner->cycle : 0.0; /* 0: none */
  size_t i = w->latest;
  if (c->later && w->rig != c->later)
    limit = fmin(limit, c->change);
  if (cycle > 0.0) {
    double begins = cycle * (double)w->positioner.cycles;
    double arrives = cycle * (floor((t - delay + margin) / cycle) + 1.0) + delay;
    return fmin(limit, fmin(begins, arrives > t + margin ? arrives : begins));
  }
  while (i < c->n && c->t_cmd[i] + delay <= t + margin)
    i++;
  return i < c->n ? fmin(c->t_cmd[i] + delay, limit) : limit;
}

/* What happens at w->t. */
static void take_turns(world *w)
{
  const second_course *c = w->course;
  double longest = w->rig->dead_time + fmax(0.0, w->rig->position_skew);
  if (c->later && w->t + margin >= c->change)
    w->rig = c->later;
  while (w->latest + 1 < c->n && c->t_cmd[w->latest + 1] + longest <= w->t)
    w->latest++;
  if (c->positioner && !is_continuous(w) && c->positioner->cycle * (double)w->positioner.cycles <= w->t + margin)
    control(w, c->positioner);
}

/* From the present time to `end`, stopping at every change of the command. */
static int travel(world *w, double end)
{
  while (w->t < end) {
    double from = w->t, to;
    take_turns(w);
    to = next_change(w, from, end);
    w->u = command(w, from);
    double steps = ceil((to - from) / w->rig->step - 1e-9);
    steps = steps < 1.0 ? 1.0 : steps;
    for (double i = 0.0; i < steps; i += 1.0) {
      w->t = from + (to - from) * (i / steps);
      step_through(w, (to - from) / steps);
      if (!(w->y[M] > 0.0 && w->y[U] > 0.0 && isfinite(w->y[X]) && isfinite(w->y[V])))
        return 1;
    }
    w->t = to;
  }
  return 0;
}

static void close_audit(const world *w, const double *y0, second_audit *a)
{
  const second_rig *g = w->rig;
  const double *y = w->y;
  *a = (second_audit){
      .mass_start = y0[M],
      .mass_end = y[M],
      .energy_start = y0[U],
      .energy_end = y[U],
      .volume_start = volume_of(g, y0),
      .volume_end = volume_of(g, y),
      .kinetic_start = 0.5 * g->mass * y0[V] * y0[V],
      .kinetic_end = 0.5 * g->mass * y[V] * y[V],
      .spring_start = spring_energy(g, y0[X]),
      .spring_end = spring_energy(g, y[X]),
      .mass_in = y[MASS_IN],
      .mass_out = y[MASS_OUT],
      .enthalpy_in = y[H_IN],
      .enthalpy_out = y[H_OUT],
      .heat = y[HEAT],
      .gas_work = y[WORK],
      .dry = y[DRY],
      .viscous = y[VISCOUS],
      .impact = w->impact,
      .other = y[OTHER],
      .steps = w->steps,
      .events = w->events,
      .forced = w->forced,
  };
}

size_t second_samples(double t_end, double dt_sample)
{
  return (size_t)floor(t_end / dt_sample + 1e-6) + 1;
}

/* The log shows the command as sent. */
static double shown(const world *w, double t)
{
  long last = w->positioner.cycles - 1;
  if (!w->course->positioner || is_continuous(w))
    return sent(w, t);
  return last < 0 ? 0.0 : w->positioner.u[last % SENT];
}

int second_follow(const second_rig *rig, const second_course *course, double t_end, double dt_sample,
                  const second_log *log, second_audit *audit)
{
  world w = {.rig = rig, .course = course};
  size_t samples = second_samples(t_end, dt_sample), ip = 0, ix = 0;
  uint64_t noise[3] = {rig->seed * 3 + 1, rig->seed * 3 + 2, rig->seed * 3 + 3};
  static const second_log nowhere;
  const second_log *out = log ? log : &nowhere;
  double y0[STATES];
  for (int i = 0; i < 3; i++)
    for (int k = 0; k < 8; k++)
      draw(&noise[i]);
  start(&w);
  memcpy(y0, w.y, sizeof y0);
  while (ip < samples || ix < samples) {
    double tp = ip < samples ? (double)ip * dt_sample : HUGE_VAL;
    double tx = ix < samples ? (double)ix * dt_sample - rig->position_skew : HUGE_VAL;
    if (travel(&w, fmin(tp, tx)))
      return 1;
    if (tx <= w.t)
      sample_position(&w, out, ix++, noise);
    if (tp <= w.t) /* the log shows the command as sent */
      sample(&w, out, ip++, tp, shown(&w, tp), noise);
  }
  if (audit)
    close_audit(&w, y0, audit);
  return 0;
}

int second_run(const second_rig *rig, const double *t_cmd, const double *u_cmd, size_t n, double t_end,
               double dt_sample, const second_log *log, second_audit *audit)
{
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = n};
  return second_follow(rig, &course, t_end, dt_sample, log, audit);
}

second_rig second_rig_default_r1_400(void)
{
  second_rig g = {0};
  g.gas = SECOND_ISOTHERMAL;
  g.flow = SECOND_PAPER;
  g.area = 0.04;
  g.dead_volume = 2e-6;
  g.stroke = 0.02;
  g.spring_rate = 400e3;
  g.spring_preload = 0.01;
  g.mass = 2.0;
  g.dry_friction = 480.0;
  g.viscous = 500.0 + 1000.0;
  g.fill_area = g.vent_area = 0.893e-6;
  g.supply = 400e3;
  g.ambient = 101325.0;
  g.supply_temperature = g.ambient_temperature = 298.15;
  g.gas_constant = 8.31446 / 0.02896;
  g.gamma = 1.4;
  g.linear_ratio = 5e-4;
  g.iso_b = 0.528;
  g.iso_m = 0.5;
  g.step = 20e-6;
  return g;
}

second_rig second_rig_default_37_13(void)
{
  second_rig g = second_rig_default_r1_400();
  g.area = 0.0677;
  g.dead_volume = 4e-6;
  g.stroke = 0.0381;
  g.spring_rate = 120e3;
  g.spring_preload = 0.00762;
  g.fill_area = g.vent_area = 2.177e-6;
  g.supply = 140e3;
  return g;
}
