/* The products of the study, each made once: a run that was cut short goes on with what is missing.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_PRODUCTS_H
#define STUDY_PRODUCTS_H

#include "grid.h"

typedef struct study_run {
  int force;   /* make everything again */
  int quiet;   /* no words on stderr */
  int figures; /* 0: tables only */
} study_run;

/* Make the products that are missing, or whose configuration, data or program has changed since they were made.
 * Tables first, then figures (gnuplot), then the report. What was made from what is in the file .done of the results
 * folder, one line a product.
 * Returns: LAB_OK, or the first error; what was made before it stays. */
int products_make(study *s, const study_run *run, lab_error *error);

/* ---- Tables that are put together from cells ---- */

/* step_<actuator>_<gas>_<flow>.csv, the standard experiment of every actuator in every law; fig04.csv, the large step
 * of the subject; fig13.csv, fig14.csv, those of both actuators in every law, the second without its upper limiter. */
extern const study_tables step_responses;

extern const study_tables static_characteristic; /* fig11.csv: travel over pressure, up and down */

/* fig15.csv to fig19.csv: the subject over the range of each hypothesis; influence.csv: the range of what that changes,
 * also of its twin, whose spring follows from the bench set. */
extern const study_tables sweeps;

/* hypotheses.csv, and hypotheses_<actuator>.csv for all but the subject: the verdicts; hypotheses_thresholds.csv: those
 * of all by other shares. */
extern const study_tables verdicts;

extern const study_tables spring_and_air; /* spring_and_air.csv: each without the other */

/* directions.csv: down over up of the spring rate (its force at rest kept) and of the orifice, with durations and
 * asymmetry; the last row of the orifice is the one that makes both strokes last equally long. */
extern const study_tables directions;

/* eq1.csv: time constants of lag and ramp, and what each leaves (rms over travel). The ramp is the limit of the lag for
 * a long time constant: it suffices where it leaves no more than the lag, or than 1 % of the travel. */
extern const study_tables edges;

/* attribution.csv, attribution_cells.csv (all combinations), and likewise for all but the subject. */
extern const study_tables attribution;

extern const study_tables agreement; /* agreement.csv: the stepper against CVODE, and balances of mass and energy */

/* ---- Others.  Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD ---- */

/* conclusions.csv, conclusions_actuators.csv, conclusions_thresholds.csv: the 18 conclusions. */
int conclusions_make(const study *s, lab_error *error);

/* REPORT.md, from the tables of the results folder; LAB_DATA where one is missing. */
int report_make(const study *s, lab_error *error);

#endif
