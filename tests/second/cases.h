/* Small experiments on the virtual rig that have a closed form. Include after check.h.
 * SPDX-License-Identifier: MIT */
#ifndef SECOND_CASES_H
#define SECOND_CASES_H

#include "rig.h"

enum { CASE_SAMPLES = 4001 };

/* Channels of the latest run. */
static struct {
  double t[CASE_SAMPLES], u[CASE_SAMPLES], p[CASE_SAMPLES], x[CASE_SAMPLES], T[CASE_SAMPLES], m[CASE_SAMPLES],
      v[CASE_SAMPLES];
  size_t n;
} got;

/* Commands u_cmd from t_cmd on. */
static inline second_audit case_schedule(const second_rig *g, const double *t_cmd, const double *u_cmd, size_t n,
                                         double t_end, double dt)
{
  const second_log log = {got.t, got.u, got.p, got.x, got.T, got.m, got.v};
  second_audit audit;
  got.n = second_samples(t_end, dt);
  assert_true(got.n <= CASE_SAMPLES);
  assert_int_equal(second_run(g, t_cmd, u_cmd, n, t_end, dt, &log, &audit), 0);
  assert_int_equal(audit.forced, 0);
  return audit;
}

/* Command u from the start. */
static inline second_audit case_run(const second_rig *g, double u, double t_end, double dt)
{
  const double t0 = 0.0;
  return case_schedule(g, &t0, &u, 1, t_end, dt);
}

/* One litre without a stem. */
static inline second_rig case_vessel(enum second_gas gas, enum second_flow flow)
{
  second_rig g = second_rig_default_r1_400();
  g.gas = gas;
  g.flow = flow;
  g.stroke = 0.0;
  g.dead_volume = 1e-3;
  g.step = 100e-6;
  return g;
}

/* A chamber so large that its pressure, gauge p, stays; a stem with a metre to go and nothing but mass on it. */
static inline second_rig case_held(double p)
{
  second_rig g = second_rig_default_r1_400();
  g.dead_volume = 1e9;
  g.stroke = 1.0;
  g.spring_rate = g.spring_preload = g.viscous = g.dry_friction = 0.0;
  g.start_pressure = g.ambient + p;
  g.step = 100e-6;
  return g;
}

/* The same with a spring and enough damping to creep to where it balances. */
static inline second_rig case_balance(double p)
{
  second_rig g = case_held(p);
  g.spring_rate = 1e5;
  g.viscous = 3000.0;
  return g;
}

/* R T of the ambient, and choked flow in sqrt(R T) m'/(Ca P). */
static inline double case_rt(const second_rig *g)
{
  return g->gas_constant * g->ambient_temperature;
}

static inline double case_choked(const second_rig *g)
{
  double n = g->gamma;
  return sqrt(n * pow(2.0 / (n + 1.0), (n + 1.0) / (n - 1.0)));
}

static inline double case_last(const double *channel)
{
  return channel[got.n - 1];
}

#endif
