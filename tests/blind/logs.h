/* Logs and rig files of trials, as closeloop reads them.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_LOGS_H
#define BLIND_LOGS_H

#include "../../apps/lab/message.h"
#include "draw.h"

/* Samples of a run; one block of memory, to be freed with blind_rows_free. */
typedef struct blind_rows {
  size_t n;
  double *t, *u, *p, *x, *T;
} blind_rows;

/* Run a rig under a schedule.
 * Returns: LAB_OK; LAB_NUMERIC if the virtual rig leaves the physical range or gives up following its events. */
int blind_simulate(const second_rig *rig, const blind_schedule *schedule, double spacing, blind_rows *rows,
                   lab_error *error);
void blind_rows_free(blind_rows *rows);

/* Write rig.cfg, fit.csv and holdout.csv into a folder. */
int blind_write_logs(const blind_trial *trial, const char *folder, lab_error *error);

#endif
