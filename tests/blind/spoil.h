/* From what a rig does to what is recorded of it: sensors, converters, clock and logger as they are.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_SPOIL_H
#define BLIND_SPOIL_H

#include "logs.h"
#include "recorded.h"

/* What a rig does, evenly spaced and finer than any log; to be freed with blind_fine_free. */
typedef struct blind_fine {
  double spacing; /* s */
  blind_rows rows;
} blind_fine;

/* Run a rig as a trial drives it, from `first` to `later` at its onset, if it has one.
 * In:      step  of the generator [s], halved where that is too long
 * Returns: LAB_OK; LAB_NUMERIC if the rig cannot be followed. */
int blind_run_recorded(const blind_recorded *trial, const second_rig *first, const second_rig *later, double step,
                       blind_fine *fine, lab_error *error);
void blind_fine_free(blind_fine *fine);

/* A log: NaN where a field is empty; to be freed with blind_log_free. */
typedef struct blind_log {
  size_t n;
  double *t, *at, *u, *sp, *p, *x, *T; /* `at`: true instants of the samples; sp: share of the stroke */
} blind_log;

/* Record what was run.  Returns: LAB_OK, LAB_WORLD without memory */
int blind_spoil(const blind_recorded *trial, const blind_fine *fine, blind_log *log, lab_error *error);
void blind_log_free(blind_log *log);

/* A linear interpolation between samples. */
double blind_at(const double *y, size_t n, double spacing, double t);

/* Write rig.cfg and fit.csv into a folder, which is made.  Out: n_rows */
int blind_write_recorded(const blind_recorded *trial, const char *folder, size_t *n_rows, lab_error *error);

/* Truth of many trials, as a table. */
void blind_truth_header(FILE *file);
void blind_truth_write(FILE *file, const blind_recorded *trial, size_t n_rows);

#endif
