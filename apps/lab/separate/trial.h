/* Trials: tests of a rig that could be recorded next, as command schedules built for the rig at hand.
 *
 * A template says how far to open and up to which travel; the times follow from a simulation of the rig. Every trial
 * begins at rest under its first command: on the lower stop, or, where that command fills, after filling for long.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TRIAL_H
#define LAB_TRIAL_H

#include "../rig/rig.h"

enum { LAB_TRIAL_STEPS = 32, LAB_TRIAL_MAX = 24, LAB_TRIAL_TEXT = 128 };

typedef struct lab_trial {
  char text[LAB_TRIAL_TEXT]; /* "hold at 80 % travel with both orifices shut for 10 s" */
  int n;                     /* commands */
  double t[LAB_TRIAL_STEPS]; /* [s] command u[i] is given at t[i], the first at 0 */
  double u[LAB_TRIAL_STEPS]; /* [1] */
  double duration;           /* [s] */
} lab_trial;

typedef struct lab_trials {
  int n;
  lab_trial trial[LAB_TRIAL_MAX];
  lab_trial usual; /* fill and vent, the test that everybody records */
  double settle;   /* [s] after which a rig that fills is at rest */
} lab_trials;

/* Build every template for a rig. Left out are those that its supply cannot drive to the travel they ask for, and those
 * of more than five minutes.
 * Returns: LAB_OK; LAB_DATA with the reason where no command moves a stem: a vessel, a driven pressure or position, a
 *          transducer that regulates pressure, a supply too weak. */
int lab_trials_build(const lab_rig *rig, lab_trials *trials, lab_error *error);

/* State at rest in which a trial begins.
 * In:      input   under which it rests
 *          settle  [s]
 * Returns: LAB_OK, LAB_NUMERIC. */
int lab_trial_start(const pneu_model *model, const pneu_input *input, double settle, pneu_state *state,
                    lab_error *error);

#endif
