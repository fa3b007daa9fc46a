/* Tables of numbers as CSV.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TABLE_H
#define LAB_TABLE_H

#include <stddef.h>
#include <stdio.h>

typedef struct lab_table_column {
  const char *title;   /* "p [kPa]" */
  double scale;        /* what is written is scale * value */
  const double *value; /* as many as there are rows */
} lab_table_column;

/* Write the header line, titles joined by commas. Errors of the stream are left to lab_out_close. */
void lab_table_header(FILE *file, const lab_table_column *column, int n_columns);

/* Write rows to ten digits; NaN becomes an empty field. */
void lab_table_rows(FILE *file, const lab_table_column *column, int n_columns, size_t n_rows);

#endif
