/* Models, runs and samples that the tests of the library share.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_FIXTURE_H
#define TESTS_FIXTURE_H

#include "check.h"
#include "../lib/pneu.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

/* Tolerance of runs that are compared with closed forms. */
#define FIXTURE_TOL TOL(1e-10, 1e-5)

/* The actuators of [B, Table A1]. */
enum { FIXTURE_R1_400, FIXTURE_37_13, FIXTURE_ACTUATORS };

/* What pneu_observe says, in double. */
typedef struct fixture_sample {
  double t, p, T, x, v, m, opening, in, out, heat, supply, friction;
  double shown_p, shown_T, shown_x; /* by the sensors */
  int mode, choked;
} fixture_sample;

/* A constant input for some time. */
typedef struct fixture_stretch {
  double duration;
  pneu_input input;
} fixture_stretch;

enum { FIXTURE_EVENTS = 64 };

/* Events of a run: when, where, from which mode to which. */
typedef struct fixture_events {
  int n;
  double t[FIXTURE_EVENTS], p[FIXTURE_EVENTS], x[FIXTURE_EVENTS];
  int before[FIXTURE_EVENTS], after[FIXTURE_EVENTS];
} fixture_events;

pneu_params fixture_params(int actuator);

/* A vessel of given volume [m3] with orifices of 1 mm2. */
pneu_params fixture_vessel(double volume);

/* Skip a test that needs an effect which this build has trimmed away. */
void fixture_need(const char *effect);

/* Set a parameter by its name; fails the test where there is none. */
void fixture_set(pneu_params *p, const char *name, double value);

/* Initialised model; fails the test on error. */
pneu_model fixture_model(const pneu_params *p, int gas, int flow);
pneu_model fixture_r1_400(int gas, int flow);
pneu_model fixture_model_roles(const pneu_params *p, int gas, int flow, int pressure_input, int position_input);

/* Isothermal, driven by pressure. */
pneu_model fixture_pressed(const pneu_params *p);

/* The R1-400 with quick orifices of 4 mm2, choked, and one parameter set; name NULL: none. */
pneu_model fixture_quick(int gas, const char *name, double value);

pneu_input fixture_input(const pneu_model *model, double u);

/* A free term that comes every `period` [s]. */
pneu_term fixture_cycle(int equation, double period, double cosine, double sine);

/* The default ones but for the tolerance. */
pneu_options fixture_options(double tol);

/* At rest at ambient temperature. */
pneu_state fixture_rest(const pneu_model *model, double pressure, double position, const pneu_input *input);

fixture_sample fixture_look(const pneu_model *model, const pneu_state *state, const pneu_input *input);

/* A model, what drives it, and where it is. */
typedef struct fixture_rig {
  pneu_model m;
  pneu_input input;
  pneu_state s;
} fixture_rig;

/* At rest under a command, as by fixture_rest. */
fixture_rig fixture_at(pneu_model model, double u, double pressure, double position);

fixture_sample fixture_see(const fixture_rig *rig);

/* Run for `duration`, without input->delay under a command that has been acting; fails the test unless the run
 * succeeds. Out: events (may be NULL) */
void fixture_run(const pneu_model *model, pneu_state *state, const pneu_input *input, double duration, double tol,
                 fixture_events *events);
void fixture_go(fixture_rig *rig, double duration, double tol, fixture_events *events);

/* Steps that the standard experiment takes, at tol 1e-6 (single: 1e-4); fails the test unless the run succeeds. */
long fixture_steps(const pneu_model *model);

/* Run through the stretches, with a sample every dt from time 0, by dense output.
 * Returns: the number of samples, <= capacity. */
int fixture_trace(const pneu_model *model, pneu_state *state, const fixture_stretch *stretch, int n, double dt,
                  double tol, fixture_sample *sample, int capacity);

/* Largest difference of two traces, as the sensors show them, over stroke, supply and ambient temperature. */
double fixture_apart(const fixture_sample *a, const fixture_sample *b, int n);

/* The standard experiment: shut 0.5 s, fill 15 s, vent 15 s.  Out: 3 stretches */
void fixture_standard(const pneu_model *model, fixture_stretch *stretch);

/* Uniform in lo..hi, the same sequence in every build. */
double fixture_random(uint64_t *seed, double lo, double hi);

/* Nearly normal, by the sum of twelve: mean 0, variance 1. */
double fixture_normal(uint64_t *seed);

/* log2 of the ratio of two errors: the observed order when the step was halved. */
double fixture_order(double coarse, double fine);

#endif
