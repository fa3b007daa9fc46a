/* The measured sets: closeloop on each, and one report over all.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SETS_H
#define STUDY_SETS_H

#include <stdio.h>

#include <libconfig.h>

#include "../lab/base/message.h"

enum { SETS_MAX = 32 };

/* How a set went. */
enum sets_state { SETS_ABSENT, SETS_FAILED, SETS_DONE };

typedef struct sets_result {
  const config_setting_t *set; /* its group in the file */
  int state;                   /* enum sets_state */
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

#endif
