/* Logs and rig files of trials, as closeloop reads them.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_LOGS_H
#define BLIND_LOGS_H

#include <stdio.h>

#include "../../apps/lab/base/outfile.h"
#include "draw.h"

/* Samples of a run; one block of memory, to be freed with blind_rows_free. */
typedef struct blind_rows {
  size_t n;
  double *t, *u, *p, *x, *T;
} blind_rows;

/* Room for a run up to `end` [s].  Returns: LAB_OK; LAB_WORLD without memory */
int blind_rows_open(double end, double spacing, blind_rows *rows, lab_error *error);

/* The columns as the virtual rig fills them. */
second_log blind_rows_log(const blind_rows *rows);

/* A rig whose sensors neither scatter nor round, on another grid. */
second_rig blind_silent(const second_rig *rig, double step);

/* Run a rig under a schedule, with a shorter step where its own is too long for it.
 * Returns: LAB_OK; LAB_NUMERIC if the virtual rig leaves the physical range or gives up following its events. */
int blind_simulate(const second_rig *rig, const blind_schedule *schedule, double spacing, blind_rows *rows,
                   lab_error *error);
void blind_rows_free(blind_rows *rows);

/* Write what a rig file declares; nothing of it tells what a trial is about. */
void blind_write_declared(FILE *file, const second_rig *rig, int channels, int tells_noise);

/* Open a file of a folder to write it. */
int blind_open_in(const char *folder, const char *name, lab_outfile *out, lab_error *error);

/* Write rig.cfg into a folder, which is made. */
int blind_write_rig(const blind_trial *trial, const char *folder, lab_error *error);

/* Write a log into a folder.
 * In:  channels  BLIND_P, ...: those it has */
int blind_write_rows(const blind_rows *rows, int channels, const char *folder, const char *name, lab_error *error);

/* Write rig.cfg, fit.csv and holdout.csv into a folder, which is made. */
int blind_write_logs(const blind_trial *trial, const char *folder, lab_error *error);

#endif
