/* What drives a run for given unknowns: its models, one after the other, and the instants of its commands.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DRIVE_H
#define LAB_DRIVE_H

#include "unknowns.h"

typedef struct lab_drive {
  lab_episode episode[LAB_EPISODES_MAX];
  int n;
  lab_rig *rig;  /* of the episodes */
  double *early; /* [s] by which each change of command comes before its row */
} lab_drive;

/* In:      model  with what all runs share
 *          theta  n values, of which those count that are the run's own
 * Out:     drive  to be closed, also after an error
 * Returns: LAB_OK, LAB_WORLD. */
int lab_drive_open(const lab_unknowns *u, const lab_rig *model, const double *theta, int run, lab_drive *drive,
                   lab_error *error);
void lab_drive_close(lab_drive *drive);

/* Put the value of one unknown into a model. */
void lab_unknown_apply(const lab_unknown *x, double value, const pneu_params *declared, lab_rig *rig);

/* Whether an unknown acts in a run. */
int lab_unknown_acts(const lab_unknown *x, int run);

#endif
