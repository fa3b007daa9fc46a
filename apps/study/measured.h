/* What the comparisons with public measurements share: where the data are, parameters by name, output.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_MEASURED_H
#define STUDY_MEASURED_H

#include <stddef.h>

#include "../../lib/pneu.h"
#include "../lab/base/message.h"
#include "table.h"

/* Result of a comparison whose data are not on this machine: not an error. */
enum { MEASURED_ABSENT = -1 };

/* Path of a file in a folder.  Returns: LAB_OK, LAB_DATA for one that is too long. */
int measured_join(const char *folder, const char *name, char *path, size_t size, lab_error *error);

/* Folder of the public data: environment variable MEASURED, else ../shared/data. */
const char *measured_folder(void);

/* Path of a data file, and whether it is there. An absent one is announced by a line on stderr.
 * In:      name  below `folder`
 * Out:     path  size bytes
 * Returns: LAB_OK, MEASURED_ABSENT, LAB_DATA for a path that is too long. */
int measured_path(const char *folder, const char *name, char *path, size_t size, lab_error *error);

/* Hand each line of a table to `take`, its header left out. What `take` finds wrong gets file and line in front.
 * In:      take  text without the line's end, 79 bytes at most  Returns: LAB_OK, or what ends the reading
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int measured_lines(const char *path, int (*take)(void *context, const char *text, lab_error *error), void *context,
                   lab_error *error);

/* Place of a parameter of an effect, for pneu_param_at.
 * Returns: its index, or -1 if this build of the library has none of that name. */
int measured_effect_param(const char *effect, const char *param);

/* Write a table to results_dir/name, whole or not at all.  Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int measured_save(const char *results_dir, const char *name, const table *t, lab_error *error);

#endif
