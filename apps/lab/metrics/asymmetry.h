/* How differently an actuator moves up and down, as numbers.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ASYMMETRY_H
#define LAB_ASYMMETRY_H

#include <stddef.h>

#include "../base/message.h"

/* One stroke, from the first sample at rest to the last at rest. */
typedef struct lab_edge {
  size_t n;
  const double *t; /* [s] increasing */
  const double *x; /* [m], or any unit of travel; the two edges need not agree */
} lab_edge;

typedef struct lab_asymmetry {
  double rise_time;        /* [s] from 5 % to 95 % of travel, up */
  double fall_time;        /* [s] down */
  double duration_ratio;   /* [1] fall over rise */
  double asymmetry;        /* [1] integral over s = 0..1 of |y_up - y_down|: both strokes scaled to unit time and
                              unit travel between 5 % and 95 %, the falling one mirrored; 0: same shape */
  double asymmetry_signed; /* [1] integral of y_up - y_down: the same size where the strokes do not cross, above 0
                              where the rise runs above the mirrored fall; contributions of opposite ways add up */
  double T1;               /* [s] time constant of k exp(-tau s)/(T s + 1) fitted to the rising stroke */
  double T2;               /* [s] of k exp(-tau s)/(T s), k = travel, fitted to the falling stroke */
} lab_asymmetry;

/* Compare two strokes.
 * Returns: LAB_OK; LAB_DATA if a stroke has fewer than three samples or no travel. */
int lab_asymmetry_measure(const lab_edge *up, const lab_edge *down, lab_asymmetry *out, lab_error *error);

/* Time constant of a first-order lag with delay and free gain, least squares over 5 % to 95 % of the travel:
 * the time constant is searched, gain and delay follow linearly.
 * Out:     rms  over travel
 * Returns: [s]; at a hundred times the stroke time the stroke is as good as straight. */
double lab_asymmetry_lag_time(const lab_edge *e, double *rms);

/* Time for the whole travel at the slope of the straight line fitted over the same window [s]. */
double lab_asymmetry_ramp_time(const lab_edge *e, double *rms);

#endif
