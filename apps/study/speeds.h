/* Velocities of a simulated stroke over travel and over chamber pressure.
 *
 * Everything is read between 5 % and 95 % of the travel: before that the stem swings on its gas spring after it has
 * broken away, and the swing has died out by then.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SPEEDS_H
#define STUDY_SPEEDS_H

#include "../../lib/pneu.h"
#include "../lab/base/message.h"
#include "../lab/metrics/asymmetry.h"

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

#endif
