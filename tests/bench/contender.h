/* What is simulated, and who simulates it.
 *
 * Contenders in C are the stepper and CVODE. Those of rivals.py join through the same table of functions; the structs
 * here have their mirrors there.
 * SPDX-License-Identifier: MIT */
#ifndef BENCH_CONTENDER_H
#define BENCH_CONTENDER_H

#include <stddef.h>

#include "../../lib/pneu.h"

/* A model and its commands. */
typedef struct bench_case {
  const pneu_model *model;
  int n; /* stretches of constant command */
  const double *duration, *command;
  size_t rows; /* samples at i * spacing */
  double spacing;
} bench_case;

/* Four parameters to be found from measured pressure and position. */
enum { BENCH_FITTED = 4 };
typedef struct bench_fit {
  pneu_model model; /* as bench_fit_apply made it */
  bench_case task;
  const double *p, *x; /* measured, task.rows each */
  double sigma_p, sigma_x;
} bench_fit;

typedef struct bench_contender {
  const char *name;
  /* Run a case from rest, with p [Pa] and x [m] at its samples where they are not NULL.  Returns: seconds, NaN on
   * failure. */
  double (*simulate)(const bench_case *task, double tol, double *p, double *x);
  /* Fit from theta.  In/out: theta, factors on the declared values.  Returns: seconds, NaN on failure; the function
   * may be NULL. */
  double (*fit)(bench_fit *fit, double tol, double *theta);
  /* Evaluate the right-hand side many times.  Returns: seconds for one; the function may be NULL. */
  double (*rates)(const bench_case *task);
} bench_contender;

enum { BENCH_STEPPER, BENCH_CVODE, BENCH_OWN, BENCH_CONTENDERS_MAX = 8 };
extern const bench_contender bench_own[BENCH_OWN];

/* The laws that are timed. */
enum { BENCH_LAWS = 4 };
typedef struct bench_law {
  int gas, flow;
} bench_law;
extern const bench_law bench_laws[BENCH_LAWS];

/* The R1-400 under a law; fails never, the parameters are the defaults. */
void bench_model(int law, pneu_model *model);

/* The standard experiment: half a second shut, 15 s of filling, 15 s of venting, a row every 10 ms. */
void bench_fill_and_vent(const pneu_model *model, bench_case *task);

/* The case by the reference: CVODE at 1e-12.  Out: p, x; may be NULL.  Returns: 0, or -1 on failure */
int bench_reference(const bench_case *task, double *p, double *x);

/* Modes by the reference, for rivals that cannot find events.
 * Out:     time, mode  when each began, and which; the start and each change of command begin one as well
 * Returns: their number, -1 on failure or where there are more than `room` */
int bench_modes(const bench_case *task, int room, double *time, int *mode);

/* For rivals in another language: a base parameter of the model, "gas" or "flow" by name (NaN where there is none);
 * distance of the rows of a Jacobian. */
double bench_value(const pneu_model *model, const char *name);
int bench_stride(void);

#endif
