/* What is measured on simulated strokes to try the paper's conclusions; thresholds are in conclusions.c.
 * Every function adds the values that have to pass, those of cases looked for to break the statement among them;
 * where there is a condition that may save it, also the values under that condition, and its words.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_CONCLUSIONS_MEASURE_H
#define STUDY_CONCLUSIONS_MEASURE_H

#include "benchscan.h"
#include "finding.h"
#include "speeds.h"
#include "study.h"

struct conclusion;

/* What several conclusions share, under one pair of laws. */
typedef struct conclusion_trial {
  const study *s;
  int gas, flow;
  int n;                                  /* actuators of the study */
  speed_pair nominal[STUDY_ACTUATOR_MAX]; /* each as its rig file says */
  bench_scan scan[STUDY_ACTUATOR_MAX];
} conclusion_trial;

/* Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD, as all functions below. */
int conclusion_trial_run(const study *s, int gas, int flow, conclusion_trial *t, lab_error *error);

typedef int conclusion_measure(const conclusion_trial *t, const struct conclusion *c, finding *f, lab_error *error);

conclusion_measure conclusion_inverse; /* saved by P_1 >> P_2: ten times the supply, a tenth of the orifice */
conclusion_measure conclusion_rise_range;
conclusion_measure conclusion_supply;    /* saved by a range of supplies that spans at least a factor of two */
conclusion_measure conclusion_last_rise; /* saved by a stop beyond the reach of the supply */
conclusion_measure conclusion_vacuum;
conclusion_measure conclusion_fixed_range; /* subject of the study on 6 and on 12 springs of Table 1, F = 0 */
conclusion_measure conclusion_fall_range;  /* saved by the place of the bench set */
conclusion_measure conclusion_fall_supply;
conclusion_measure conclusion_last_fall; /* broken by a preload below friction */
conclusion_measure conclusion_fall_change;
conclusion_measure conclusion_first_over;
conclusion_measure conclusion_last_over; /* broken and saved by the place of the bench set */
conclusion_measure conclusion_crossing;  /* without friction, travel prolonged to 97 % of the supply */
conclusion_measure conclusion_symmetric; /* saved where durations are meant */
conclusion_measure conclusion_fastest;   /* saved where the rising edge is meant */
conclusion_measure conclusion_largest_efficiency;
conclusion_measure conclusion_efficiency;

#endif
