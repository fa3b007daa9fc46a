/* Trials: tests of a rig that could be recorded next, as command schedules built for the rig at hand.
 *
 * A template says how far to open and up to which travel; the times follow from a simulation of the rig. Every trial
 * begins at rest under its first command: on the lower stop, or, where that command fills, after filling for long.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TEST_PLAN_H
#define LAB_TEST_PLAN_H

#include "../rig/rig.h"

enum { LAB_TEST_PLAN_STEPS = 32, LAB_TEST_PLAN_MAX = 24 };

typedef struct lab_test_plan {
  const char *text;              /* "hold at 80 % travel with both orifices shut for 10 s" */
  int n;                         /* commands */
  double t[LAB_TEST_PLAN_STEPS]; /* [s] command u[i] is given at t[i], the first at 0 */
  double u[LAB_TEST_PLAN_STEPS]; /* [1] */
  double duration;               /* [s] */
} lab_test_plan;

typedef struct lab_test_plans {
  int n;
  lab_test_plan plan[LAB_TEST_PLAN_MAX];
  lab_test_plan usual; /* fill and vent, the test that everybody records */
  double settle;       /* [s] after which a rig that fills is at rest */
} lab_test_plans;

/* Build every template for a rig. Left out are those that its supply cannot drive to the travel they ask for, and those
 * of more than five minutes.
 * Returns: LAB_OK; LAB_DATA with the reason where no command moves a stem: a vessel, a driven pressure or position, a
 *          transducer that regulates pressure, a supply too weak. */
int lab_test_plans_build(const lab_rig *rig, lab_test_plans *plans, lab_error *error);

/* State at rest in which a trial begins.
 * In:      input   under which it rests
 *          settle  [s]
 * Returns: LAB_OK, LAB_NUMERIC. */
int lab_test_plan_start(const pneu_model *model, const pneu_input *input, double settle, pneu_state *state,
                        lab_error *error);

#endif
