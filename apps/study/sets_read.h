/* What the report over the measured sets takes from their files.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SETS_READ_H
#define STUDY_SETS_READ_H

#include <cjson/cJSON.h>

#include "sets.h"
#include "table.h"

/* A text of a set's group; "" if it has none. */
const char *sets_text(const config_setting_t *set, const char *key);

/* report.json of a set.  Returns: NULL if there is none; else to be freed with cJSON_Delete */
cJSON *sets_json(const char *out_dir, const config_setting_t *set);

/* A member of an object, by the keys on the way to it, which end with NULL; NULL if there is none, also for an object
 * that is NULL. */
const cJSON *sets_at(const cJSON *at, ...);

/* A number or text of an object; NaN or NULL if there is none. */
double sets_number(const cJSON *at, const char *key);
const char *sets_words(const cJSON *at, const char *key);

/* The error of a channel. */
typedef struct sets_error {
  double value, in_noise; /* value in the unit asked for; NaN where the report has none */
} sets_error;

/* In: errors  an object of channels ("pressure"), each with rmse, unit and in_noise */
sets_error sets_error_of(const cJSON *errors, const char *channel, const char *unit);

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
