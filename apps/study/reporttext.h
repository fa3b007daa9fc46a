/* What several sections of REPORT.md write.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_REPORTTEXT_H
#define STUDY_REPORTTEXT_H

#include <stdio.h>

#include "study.h"

/* Whether a row of a table is of these laws, by its columns gas and flow. */
int report_is_law(const table *t, size_t row, const char *gas, const char *flow);

/* Names of the laws as column heads, and the end of the line: "isothermal, paper". */
void report_law_heads(const study *s, FILE *file);

/* The line below the heads of a table. */
void report_rule(FILE *file, int columns);

/* Name of an actuator's table: that of the subject has none in its file's name.  Out: name  REPORT_NAME_TEXT bytes */
enum { REPORT_NAME_TEXT = LAB_NAME_TEXT + 64 };
void report_table_name(const study *s, int actuator, const char *stem, char *name);

#endif
