/* The section of one measured set in the report over all.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SETS_SECTION_H
#define STUDY_SETS_SECTION_H

#include <stdio.h>

#include "sets_read.h"

/* Write the section: what was declared, the errors before and after, what was found and why, what is left and where.
 * In:      json  its report; NULL if it did not run
 * Returns: LAB_OK; LAB_DATA if its rig file cannot be read; LAB_WORLD. */
int sets_section(FILE *file, const sets_result *r, const cJSON *json, const char *out_dir, lab_error *error);

#endif
