/* A virtual rig: a second, independent model of a single-acting actuator and its measuring chain.
 *
 * It exists to contradict the library. It shares nothing with it: its gas state is mass and internal energy, its
 * integrator the classical Runge-Kutta method at a fixed small step, and every law and effect is written here again
 * from its equation. SI units throughout; pressures are absolute where the name says so and gauge otherwise.
 *
 *   dm/dt = sum in - sum out,      dU/dt = sum h_in - sum h_out + Q - P A dx/dt,      P = (gamma - 1) U / V(x)
 *   M dv/dt = p A - k (x + x0) - c v - f,      |f| = F when sliding, |f| <= F at rest,      lower <= x <= upper
 *
 * SPDX-License-Identifier: MIT */
#ifndef SECOND_RIG_H
#define SECOND_RIG_H

#include <stddef.h>
#include <stdint.h>

enum second_gas { SECOND_ISOTHERMAL, SECOND_ENERGY /* adiabatic while no heat path is given */ };
enum second_flow { SECOND_PAPER, SECOND_CHOKED, SECOND_ISO6358 };

/* Laws and dimensions first, then the effects: each is absent at zero. */
typedef struct {
  enum second_gas gas;
  enum second_flow flow;
  double area, dead_volume, stroke;    /* m2, m3, m; stroke 0 is a vessel */
  double spring_rate, spring_preload;  /* N/m, m */
  double mass, dry_friction, viscous;  /* kg, N, N s/m */
  double fill_area, vent_area;         /* m2, C*a of either orifice */
  double supply, supply_temperature;   /* Pa gauge, K */
  double ambient, ambient_temperature; /* Pa absolute, K */
  double gas_constant, gamma;          /* J/(kg K), 1 */
  double exponent;                     /* 1, of the chamber in place of gamma: polytropic; 0: gamma */
  double rate_exponent;                /* 1, before the rate of pressure of isothermal gas; 0: 1 */
  double linear_ratio;                 /* flow is linear in dP below this share of upstream pressure */
  double iso_b, iso_m;                 /* critical ratio and exponent of ISO 6358 */
  double step, refine_tolerance;       /* s; step is halved while halving moves P or x by more than this, relative */
  double start_pressure, start_temperature; /* Pa absolute, K; 0: those of the ambient */
  double start_position, start_velocity;    /* m, m/s */

  /* mass and energy */
  double leak_area;                             /* m2, orifice to ambient */
  double porous_leak, crossover;                /* kg/(s Pa2), Pa: P^2 - Pa^2 = q/c + (q/(c p_c))^2 */
  double laminar_leak;                          /* kg/(s Pa2), c (P^2 - Pa^2) */
  double relief_area, relief_from, relief_span; /* m2, Pa gauge, Pa: a leak that opens from a pressure on */
  double heat, heat_natural;                    /* W/K; W/K^(4/3), free convection |dT|^(1/3) dT */
  double wall_capacity, wall_loss;              /* J/K, 0: wall at ambient; W/K from wall to ambient */
  double supply_droop;                          /* Pa s/kg, supply falls by this times the flow */
  double supply_turbulence;                     /* 1, share of that at the fill orifice's full flow, of an orifice */
  double supply_volume;                         /* m3, between that and the transducer, at the supply's temperature */
  double pulsation, pulsation_rate;             /* Pa, Hz: supply + a sin(2 pi f t) */
  double back_pressure;                         /* Pa s/kg, exhaust rises by this times the flow */
  double tube_volume, tube_resistance;          /* m3, Pa s/kg: isothermal volume, then a linear restriction */
  double tube_turbulence;                       /* 1, as that of the supply */
  double line_length, line_friction;            /* 1, l: the chamber's air in two volumes as l to 1, and l times the
                                                   length volume/area of bore between; 1, of a smooth bore's */
  double growth, growth_time;                   /* 1/Pa, s: dead volume grows by this, with the pressure of a lag */

  /* command */
  double transducer_lag, dead_time; /* s */
  double zero, span;                /* m, 1: a positioner sees (1 + span) x + zero */
  double overlap, bend;             /* 1, of the spool; 1, of its flow */

  /* force */
  double stribeck, stribeck_velocity;          /* 1, m/s: F (1 + s exp(-(v/vs)^2)) */
  double bristle_rate, bristle_damping;        /* N/m, N s/m: LuGre in place of Coulomb */
  double friction_position;                    /* 1: F (1 + a x / stroke) */
  double friction_pressure;                    /* N/Pa: F + b |p| */
  double bump, bump_at, bump_width;            /* N, m, m: F + B exp(-((x - xb)/w)^2) */
  double spring_cubic;                         /* N/m3: k3 x^3 */
  double hysteresis, hysteresis_length;        /* N, m: H h, dh = (dx - h |dx|)/length */
  double creep, creep_time;                    /* N/m, s: k (x - y), y follows x with a lag */
  double area_slope;                           /* 1: A (1 - a x / stroke) */
  double travel_limit;                         /* m, upper stop; 0: the stroke */
  double upper_rate, lower_rate, stop_damping; /* N/m, N/m, N s/m: elastic stops; 0: rigid, inelastic */
  double force, force_rate;                    /* N, Hz: a force against the pressure, sin(2 pi f t) */

  /* measuring chain */
  double pressure_bias, pressure_gain, pressure_lag;        /* Pa, 1 (reads 1 + gain), s */
  double position_bias, position_gain, position_lag;        /* m, 1, s */
  double temperature_lag, position_skew;                    /* s, s: position is as old as this */
  double pressure_noise, position_noise, temperature_noise; /* standard deviations */
  double pressure_range, position_range; /* full scale of the 14-bit converters; 0: no quantisation */
  uint64_t seed;
} second_rig;

/* Arrays for the samples; any may be NULL. p, x and T are as measured, m and v are the truth. */
typedef struct {
  double *t, *u, *p, *x, *T, *m, *v;
} second_log;

/* A positioner: at every cycle, or all the time, with e = set position - x in shares of the stroke, it sends
 *   u = clip(gain (e + integral of e over integral_time + derivative_time de/dt), -1, 1),
 * 0 where |e| is within the dead band; set below cutoff_low it vents, above cutoff_high it fills. The integral stands
 * still within the dead band, beyond the cut-offs and while u is clipped. */
typedef struct {
  double gain, integral_time, derivative_time; /* 1, s (0: no integral), s */
  double integral_start;                       /* 1, of the integral, where there is one */
  double dead_band, cutoff_low, cutoff_high;   /* shares of the stroke */
  double cycle;                                /* s; 0: none, and dead time is that of the set position */
} second_positioner;

/* What is done to a rig during a run. */
typedef struct {
  const double *t_cmd, *u_cmd; /* u_cmd[i] holds from t_cmd[i], 0 before; with a positioner it is the set position */
  size_t n;
  const second_positioner *positioner; /* NULL: none */
  const second_rig *later; /* the rig from `change` on; it has no states that the first has not. NULL: none */
  double change;           /* s */
} second_course;

/* Integrals over the run and both ends of it. Over a run
 *   mass_end - mass_start = mass_in - mass_out
 *   energy_end - energy_start = enthalpy_in - enthalpy_out + heat - gas_work
 *   gas_work - ambient * (volume_end - volume_start) = kinetic + spring (ends) + dry + viscous + impact + other
 */
typedef struct {
  double mass_start, mass_end, energy_start, energy_end, volume_start, volume_end;
  double kinetic_start, kinetic_end, spring_start, spring_end;
  double mass_in, mass_out, enthalpy_in, enthalpy_out, heat, gas_work;
  double dry, viscous, impact, other; /* other: hysteresis, elastic stops, added force */
  long steps, events, forced;         /* forced: steps that gave up following their events, 0 in a sound run */
} second_audit;

/* Table A1 of the paper, as printed: isothermal, flow by Eq. (8). */
second_rig second_rig_default_r1_400(void);
second_rig second_rig_default_37_13(void);

/* Samples second_run will write. */
size_t second_samples(double t_end, double dt_sample);

/* Samples are at i dt_sample up to t_end, the last one ends the audit; u is what was sent, not what dead time makes of
 * it. log and audit may be NULL. Equal arguments give equal bits. 0: done, 1: the state left the physical range. */
int second_follow(const second_rig *rig, const second_course *course, double t_end, double dt_sample,
                  const second_log *log, second_audit *audit);

/* The same of commands alone. */
int second_run(const second_rig *rig, const double *t_cmd, const double *u_cmd, size_t n, double t_end,
               double dt_sample, const second_log *log, second_audit *audit);

#endif
