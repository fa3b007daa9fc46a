/* A table in memory, written as CSV: what every result of the study passes through.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_TABLE_H
#define STUDY_TABLE_H

#include <stddef.h>
#include <stdio.h>

#include "../lab/base/message.h"

/* A cell is text, or a number where text is NULL. */
typedef struct table_cell {
  char *text;
  double number;
} table_cell;

/* Cells row by row. Running out of memory is remembered and reported by table_write, so that rows
 * can be added without a check on each. */
typedef struct table {
  char *header; /* column names, comma separated, units in brackets */
  size_t columns;
  size_t n, room; /* cells in use, cells allocated */
  table_cell *cell;
  int failed;
} table;

/* Start an empty table.  In: header, as it will stand in the file: "flow,p_over_pa [1]"  Out: t */
void table_open(table *t, const char *header);

/* Give the memory back; t may be opened again. */
void table_close(table *t);

/* Append a row.
 * In: kinds  one letter a column: 's' takes a const char *, 'g' takes a double */
void table_row(table *t, const char *kinds, ...);

/* Append a row of texts, as many as there are columns. */
void table_row_of_text(table *t, const char *const *text);

/* Rows in the table. */
size_t table_rows(const table *t);

/* Cell in `row` and `column`, both counted from 0 and within the table. */
const table_cell *table_at(const table *t, size_t row, size_t column);

/* Write header and rows. Numbers have nine digits, NaN is an empty field, infinities are inf and
 * -inf; a text with a comma, a quote or a line break is quoted as RFC 4180 says.
 * Returns: LAB_OK or LAB_WORLD. */
int table_write(const table *t, FILE *file, lab_error *error);

#endif
