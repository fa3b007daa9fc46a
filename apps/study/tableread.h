/* Tables read back, for the report.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_TABLEREAD_H
#define STUDY_TABLEREAD_H

#include "study.h"
#include "table.h"

/* Read a CSV file; every cell is text, empty ones too.
 * Out:     t  to be closed with table_close, also after an error
 * Returns: LAB_OK; LAB_DATA if it is missing or ragged; LAB_WORLD. */
int table_load_file(const char *path, table *t, lab_error *error);

/* The same for a file of the results folder. */
int table_load(const study *s, const char *name, table *t, lab_error *error);

/* Column of a name in the header, its unit in brackets left out.  Returns: -1 if there is none. */
int table_column(const table *t, const char *name);

/* Text of a cell, by row and name of column; "" if there is no such column. */
const char *table_text(const table *t, size_t row, const char *column);

/* Number of a cell; NaN if it is empty or no number. */
double table_number(const table *t, size_t row, const char *column);

#endif
