/* What becomes of the two edges as the bench set is moved, its width kept.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_BENCHSCAN_H
#define STUDY_BENCHSCAN_H

#include "../lab/rig/rig.h"
#include "speeds.h"

enum { SCAN_POINTS = 25 };

/* What is read at each place of the bench set. */
enum scan_quantity {
  SCAN_FALL_RANGE, /* [1] largest over smallest velocity of the falling edge */
  SCAN_FIRST_OVER, /* [1] smallest velocity of the falling edge over largest of the rising one */
  SCAN_LAST_OVER,  /* [1] smallest velocity of the rising edge over largest of the falling one */
  SCAN_DURATIONS,  /* [1] fall over rise */
  SCAN_ASYMMETRY,  /* [1] as lab_asymmetry */
  SCAN_QUANTITIES
};

typedef struct bench_scan {
  double low, width;               /* [Pa] the bench set itself */
  double nominal[SCAN_QUANTITIES]; /* there */
  double from[SCAN_POINTS];        /* [Pa] lower end of the bench set at each point, rising */
  double value[SCAN_QUANTITIES][SCAN_POINTS];
} bench_scan;

/* Parameters with the spring that a bench set implies: k = A (p_h - p_l)/travel, x_0 = p_l A/k [B, Table A1].
 * In: low, width [Pa] */
pneu_params bench_params(const pneu_params *base, double low, double width);

/* Bench set of a rig [Pa]: that of Table A1 where the rig is an actuator of the paper, else what its spring makes. */
void bench_of_rig(const lab_rig *rig, double *low, double *width);

/* Move the bench set of a rig from where friction still lets the stem come home to where the supply still
 * carries it to the end.
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int bench_scan_run(const lab_rig *rig, const pneu_laws *law, bench_scan *out, lab_error *error);

/* Longest range of the lower end over which a quantity is at most `limit`, its ends linear between points.
 * Out:     from, to [Pa]
 * Returns: 1, or 0 where there is none. */
int bench_scan_range(const bench_scan *scan, int quantity, double limit, double *from, double *to);

/* Largest or smallest value of a quantity over the scan. */
double bench_scan_max(const bench_scan *scan, int quantity);
double bench_scan_min(const bench_scan *scan, int quantity);

/* Lower end [Pa] at which both edges take the same time, by simulation to 1e-3 of duration; NaN where there is none.
 * Out: asymmetry there */
double bench_scan_equal(const bench_scan *scan, const pneu_params *base, const pneu_laws *law, double *asymmetry);

#endif
