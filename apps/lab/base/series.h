/* Columns of numbers as CSV.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SERIES_H
#define LAB_SERIES_H

#include <stddef.h>
#include <stdio.h>

typedef struct lab_series_column {
  const char *title;   /* "p [kPa]" */
  double scale;        /* what is written is scale * value + offset */
  const double *value; /* as many as there are rows */
  double offset;
} lab_series_column;

/* Write the header line, titles joined by commas. Errors of the stream are left to lab_out_close. */
void lab_series_header(FILE *file, const lab_series_column *column, int n_columns);

/* Write rows to ten digits; NaN becomes an empty field. */
void lab_series_rows(FILE *file, const lab_series_column *column, int n_columns, size_t n_rows);

#endif
