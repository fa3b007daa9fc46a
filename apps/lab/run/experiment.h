/* An experiment: one run of a log beside what a model predicts for it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_EXPERIMENT_H
#define LAB_EXPERIMENT_H

#include "../log/log.h"
#include "../rig/rig.h"
#include "schedule.h"

typedef struct lab_experiment {
  const lab_rig *rig;
  const lab_log *log;
  size_t run, first, n;             /* run of the log, its first row, its rows */
  int n_channels;                   /* measured channels that the model predicts */
  int channel[LAB_CHANNEL_COUNT];   /* enum lab_channel of each */
  double sigma[LAB_CHANNEL_COUNT];  /* their noise, SI */
  double memory[LAB_CHANNEL_COUNT]; /* of the noise: its correlation from row to row, 0 where it is white */
  lab_drive drive;                  /* schedule of inputs, as the log shows them */
  size_t n_switches; /* changes of the command whose instant the log brackets; 0 if other inputs change */
  double *bracket;   /* [s] n_switches: time from the row before each change to the row that shows it */
} lab_experiment;

/* Prepare a run. Noise that the rig does not declare is estimated (noise.h).
 * Out:     e  keeps rig and log; to be closed, also after an error
 * Returns: LAB_OK; LAB_DATA if nothing is measured that the model predicts; LAB_WORLD. */
int lab_experiment_open(const lab_rig *rig, const lab_log *log, size_t run, lab_experiment *e, lab_error *error);
void lab_experiment_close(lab_experiment *e);

/* What a model predicts.
 * In:      rig     its parameters and free terms, in the place of those of the experiment's
 *          early   [s] n_switches: how much before its row each change of command happened; NULL: not at all
 *          tol     local error of the stepper
 * Out:     y       n_channels * n values, SI, channel by channel
 * Returns: LAB_OK; LAB_NUMERIC, also for parameters out of bounds; LAB_WORLD. */
int lab_experiment_predict(const lab_experiment *e, const lab_rig *rig, const double *early, double tol, double *y,
                           lab_error *error);

/* Value measured at row i of channel c (place in e->channel); NaN in a gap. */
double lab_experiment_measured(const lab_experiment *e, int c, size_t i);

#endif
