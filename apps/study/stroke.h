/* Simulated strokes of a model up and down, and what is measured on them.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_STROKE_H
#define STUDY_STROKE_H

#include "../../lib/pneu.h"
#include "../lab/base/message.h"
#include "../lab/metrics/asymmetry.h"

/* ---- Flow laws beside the library's ----
 *
 * Air that flows in proportion to the pressure difference whatever its density: the counterfactual of hypothesis 6,
 * q = area sqrt(2/(R T_a)) (p_up - p_down), T_a ambient. */

/* In the place of enum pneu_flow_law; LINEAR_CHOKED_FLOW holds p_down at the nozzle's critical pressure below that. */
enum { LINEAR_FLOW = PNEU_FLOW_COUNT, LINEAR_CHOKED_FLOW };

/* As pneu_model_init; laws->flow may be one of these, too. */
int linear_model_init(pneu_model *model, const pneu_params *p, const pneu_laws *laws, int *bad);

/* ---- A full stroke ---- */

/* A simulated stroke: dense output of the stepper, at most 20 ms apart. */
typedef struct stroke_curve {
  size_t n, room; /* samples in use, samples allocated */
  double *t;      /* [s] from the change of command */
  double *x;      /* [m] */
  double *v;      /* [m/s] */
  double *p;      /* [Pa] gauge */
  int full;       /* out of memory */
} stroke_curve;

typedef struct stroke_pair {
  stroke_curve up, down;
} stroke_pair;

/* Fill from rest on the lower stop until nothing moves, then vent until nothing moves, by the library's stepper at
 * tol 1e-8.
 * In:      up, down  parameters on either way; the same of an actuator that has no others on its way down
 * Out:     pair      free with stroke_pair_free, also after a failure
 * Returns: LAB_OK, LAB_DATA (parameters out of bounds), LAB_NUMERIC, LAB_WORLD. */
int stroke_sample(const pneu_params *up, const pneu_params *down, const pneu_laws *law, stroke_pair *pair,
                  lab_error *error);
void stroke_pair_free(stroke_pair *pair);

/* A stroke as the measures take it. */
lab_edge stroke_edge(const stroke_curve *s);

/* Sample and measure.  Returns: as stroke_sample; LAB_DATA also without travel. */
int stroke_measure(const pneu_params *up, const pneu_params *down, const pneu_laws *law, lab_asymmetry *out,
                   lab_error *error);

/* ---- Its velocities over travel and over chamber pressure ----
 *
 * Everything is read between 5 % and 95 % of the travel: before that the stem swings on its gas spring after it has
 * broken away, and the swing has died out by then. */

enum { SPEED_POINTS = 181 }; /* every half percent of travel */

/* One edge; entry i belongs to speed_position(i) whichever way the stem goes. */
typedef struct speed_edge {
  double v[SPEED_POINTS]; /* [m/s] positive both ways */
  double p[SPEED_POINTS]; /* [Pa] gauge */
  double arrival;         /* [m/s] with which the stem reaches the end of its travel */
} speed_edge;

typedef struct speed_pair {
  speed_edge up, down;
  lab_asymmetry shape;
  double returned; /* [J] work of the stem on the air over the whole falling edge, gauge */
} speed_pair;

/* Simulate both edges and read them.
 * Returns: LAB_OK, LAB_DATA (parameters out of bounds, or no travel), LAB_NUMERIC, LAB_WORLD. */
int speeds_measure(const pneu_params *params, const pneu_laws *law, speed_pair *out, lab_error *error);

/* Position of entry i over travel, 0.05 to 0.95 from the lower end. */
double speed_position(int i);

/* Extremes [m/s], and the entry of the largest velocity. */
double speed_max(const speed_edge *e);
double speed_min(const speed_edge *e);
int speed_fastest(const speed_edge *e);

/* Velocity [m/s] at a chamber pressure [Pa] gauge, linear between entries; NaN outside the range of pressure. */
double speed_at_pressure(const speed_edge *e, double p);

/* Slope of ln v over ln P, P absolute, by least squares over the entries.  In: P_a [Pa] */
double speed_exponent(const speed_edge *e, double P_a);

/* Lowest pressure [Pa] gauge from which the falling edge is the faster one at the same pressure; NaN where neither
 * edge is always below it. */
double speed_crossing(const speed_pair *pair);

/* ---- The work that a loaded actuator does in a cycle ---- */

typedef struct load_cycle {
  double work_up;   /* [J] on the load while the stem rises */
  double work_down; /* [J] while it falls */
  double air;       /* [kg] taken from the supply, filled to it at the end of the travel */
} load_cycle;

/* Rise and fall against a load that, with the spring, always holds the stem back by a little less than the air (up)
 * or pushes against it by a little less than the spring (down): the load is set anew every 20 ms, as a dynamometer
 * would, from the position at that moment. Filling ends at supply pressure.
 * In:      margin  force left to move the stem, over supply pressure times area
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC (also where the stem does not get through). */
int load_cycle_run(const pneu_params *params, const pneu_laws *law, double margin, load_cycle *out, lab_error *error);

#endif
