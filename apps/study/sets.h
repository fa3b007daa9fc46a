/* The measured sets: closeloop on each, and one report over all.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SETS_H
#define STUDY_SETS_H

#include <libconfig.h>

#include "alone.h"
#include "table.h"

enum { SETS_MAX = 32, SETS_LOGS_MAX = 32 };

/* How a set went. */
enum sets_state { SETS_ABSENT, SETS_FAILED, SETS_DONE };

typedef struct sets_result {
  const config_setting_t *set; /* its group in the file */
  int state;                   /* enum sets_state */
  double repeat;               /* what the bench repeats of the judged channel (replicates.h), SI; NaN: not known */
  int n_alone;                 /* logs that were fitted by themselves: those fitted, then those held out; 0: none */
  alone_fit alone[SETS_LOGS_MAX];
  alone_fit sensor; /* the channel that was not fitted, through the set's `sensor`; left is 0 where there is none */
} sets_result;

/* Folder of the public data: the environment variable MEASURED, else ../shared/data. */
const char *sets_data_folder(void);

/* Run closeloop on every set whose data are there; one line on stderr for each that is not.
 * In:      list      the list `sets`
 *          data_dir  folder of the data
 *          out_dir   a folder a set is made below it
 * Out:     result, n  SETS_MAX at most
 * Returns: LAB_OK; LAB_DATA for a set that does not say what it must. */
int sets_run(const config_setting_t *list, const char *data_dir, const char *out_dir, sets_result *result, int *n,
             lab_error *error);

/* Write the report: a table over all sets, then a section a set, from their report.json.
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int sets_report(const sets_result *result, int n, const char *out_dir, lab_error *error);

/* ---- What the report takes from their files ---- */

/* A text of a set's group; "" if it has none. */
const char *sets_text(const config_setting_t *set, const char *key);

/* The log of a set at place i, those fitted first, then those held out.  Returns: NULL beyond the last */
const char *sets_log(const config_setting_t *set, int i);

/* Whether a log of that name is fitted, whatever of it is held out. */
int sets_is_fitted(const config_setting_t *set, const char *log);

/* The channel of a quantity ("pressure"): enum lab_channel; -1 if there is none. */
int sets_channel(const char *quantity);

/* Whether every part of model `a` ("x + y") is one of model `b`, in whatever order. */
int sets_within(const char *a, const char *b);

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
