/* What becomes of the two edges as the bench set is moved, its width kept.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_BENCHSCAN_H
#define STUDY_BENCHSCAN_H

#include "../../lib/pneu.h"
#include "../lab/base/message.h"

enum { SCAN_POINTS = 25 };

/* What is read at each place of the bench set. */
enum scan_quantity {
  SCAN_FALL_RANGE, /* [1] largest over smallest velocity of the falling edge */
  SCAN_FIRST_OVER, /* [1] smallest velocity of the falling edge over largest of the rising one */
  SCAN_LAST_OVER,  /* [1] smallest velocity of the rising edge over largest of the falling one */
  SCAN_FASTEST,    /* [1] largest velocity of the falling edge over largest of the rising one */
  SCAN_QUANTITIES
};

typedef struct bench_scan {
  double low, width;        /* [Pa] of the bench set itself */
  double from[SCAN_POINTS]; /* [Pa] lower end of the bench set at each point, rising */
  double value[SCAN_QUANTITIES][SCAN_POINTS];
} bench_scan;

/* Parameters with the spring that a bench set implies: k = A (p_h - p_l)/travel, x_0 = p_l A/k [B, Table A1].
 * Where that is more than the 1 m that a model takes, a constant force does the rest.
 * In: low, width [Pa] */
pneu_params bench_params(const pneu_params *base, double low, double width);

/* Chamber pressure [Pa] gauge at which the stem is in balance at x [m], as pneu_balance_pressure; NaN for parameters
 * that are no model. */
double bench_pressure(const pneu_params *p, double x, int direction);

/* Move the bench set that a spring makes from where friction still lets the stem come home to where the supply
 * still carries it to the end.
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int bench_scan_run(const pneu_params *base, const pneu_laws *law, bench_scan *out, lab_error *error);

/* Longest range of the lower end over which a quantity is at most `limit`, its ends linear between points.
 * Out:     from, to [Pa]
 * Returns: 1, or 0 where there is none. */
int bench_scan_range(const bench_scan *scan, int quantity, double limit, double *from, double *to);

/* Lower end [Pa] at which a bench set of some width [Pa] lets both edges take the same time, by simulation to 1e-3
 * of duration; NaN where there is none.
 * Out: asymmetry there */
double bench_equal(const pneu_params *base, const pneu_laws *law, double width, double *asymmetry);

/* Widest bench set [Pa] of equal durations whose asymmetry is at most `limit`, by bisection to 2 %, and its
 * lower end; NaN where there is none between a hundredth of `width` and `width`.
 * Out: low [Pa] */
double bench_alike(const pneu_params *base, const pneu_laws *law, double width, double limit, double *low);

#endif
