/* Where what is left of the error is: residual.csv of closeloop, run by run.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SETS_LEFT_H
#define STUDY_SETS_LEFT_H

#include <stddef.h>

#include "table.h"

/* What the completed model leaves of a channel in one run: measured less predicted, SI. */
typedef struct sets_left {
  size_t n;              /* measured values; 0 if the run has none of the channel */
  double rms, mean;      /* NaN without values */
  double worst, worst_t; /* the largest, with its sign, and when [s] */
  double lag1;           /* autocorrelation at lag 1: 0 for white noise, 1 for a slow wave */
} sets_left;

/* Number of runs in the table. */
int sets_left_runs(const table *residual);

/* In:      residual  residual.csv as table_load_file reads it
 *          run       from 1
 *          key       of the channel ("p")
 * Returns: LAB_OK; LAB_WORLD without memory. */
int sets_left_of(const table *residual, int run, const char *key, sets_left *left, lab_error *error);

#endif
