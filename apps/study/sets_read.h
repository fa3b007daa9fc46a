/* What the report over the measured sets takes from their files.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SETS_READ_H
#define STUDY_SETS_READ_H

#include <cjson/cJSON.h>

#include "sets.h"

enum { SETS_PATH_TEXT = 1024, SETS_CELL_TEXT = 96, SETS_NAMES_TEXT = 512 };

/* A text of a set's group; "" if it has none. */
const char *sets_text(const config_setting_t *set, const char *key);

/* report.json of a set.  Returns: NULL if there is none; else to be freed with cJSON_Delete */
cJSON *sets_json(const char *out_dir, const config_setting_t *set);

/* A member of an object; NULL if there is none, also for an object that is NULL. */
const cJSON *sets_member(const cJSON *at, const char *key);

/* A number of an object; NaN if there is none. */
double sets_number(const cJSON *at, const char *key);

/* The error of a channel. */
typedef struct sets_error {
  double value, in_noise; /* value in the unit asked for; NaN where the report has none */
} sets_error;

/* In: errors  an object of channels ("pressure"), each with rmse, unit and in_noise */
sets_error sets_error_of(const cJSON *errors, const char *channel, const char *unit);

/* The four errors of a channel. */
typedef struct sets_errors {
  sets_error before, after, held_before, held_after;
} sets_errors;

sets_errors sets_errors_of(const cJSON *json, const char *channel, const char *unit);

/* Standard deviation of the sensor, as the report counted with it; NaN where it has none. */
double sets_noise(const sets_errors *e);

/* "0.123", "4711", "-" for NaN.  Out: cell  SETS_CELL_TEXT bytes  Returns: cell */
const char *sets_digits(char *cell, double value);

/* Names of what was found, joined by ", "; "" if nothing.  Out: names  SETS_NAMES_TEXT bytes  Returns: names */
const char *sets_names(char *names, const cJSON *json);

/* Why no effect may be named, whatever is left: a sentence of closeloop.  Returns: NULL if there is no such reason */
const char *sets_doubt(const cJSON *json);

/* Logs held out, and how many of them the completed model predicts better than the declared one.
 * Out:     worse  names of the others, joined by ", "; SETS_NAMES_TEXT bytes
 * Returns: number of logs, 0 if the report does not tell them apart */
int sets_held_logs(const cJSON *json, const char *channel, int *better, char *worse);

/* The model on the way whose error held out is lowest, where that of the final one is higher, to the digits shown.
 * Returns: NULL where the final one is lowest, or nothing was held out */
const cJSON *sets_best_on_the_way(const cJSON *json, const char *channel, const char *unit);

/* Whether every part of model `a` ("x + y") is one of model `b`, in whatever order. */
int sets_within(const char *a, const char *b);

/* Whether they have the same parts. */
int sets_same_model(const char *a, const char *b);

#endif
