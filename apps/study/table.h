/* A table in memory, written as CSV and read back: what every result of the study passes through.
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

/* Cells row by row, the names of the columns first. Running out of memory is remembered and reported by table_write, so
 * that rows can be added without a check on each. */
typedef struct table {
  size_t columns;
  size_t n, room; /* cells in use, cells allocated */
  table_cell *cell;
  int failed;
  int digits; /* of its numbers in the file; 0: nine */
} table;

/* Start an empty table.  In: header, as it will stand in the file: "flow,p_over_pa [1]"  Out: t */
void table_open(table *t, const char *header);

/* Give the memory back; t may be opened again. */
void table_close(table *t);

/* Append a row.
 * In: kinds  one letter a column: 's' takes a const char *, 'g' takes a double */
void table_row(table *t, const char *kinds, ...);

/* Append a copy of a row of a table with as many columns; nothing where it has no such row. */
void table_copy_row(table *t, const table *from, size_t row);

/* Read a CSV file; every cell is text, empty ones too.
 * Out:     t  to be closed, also after an error
 * Returns: LAB_OK; LAB_DATA if it is missing or ragged; LAB_WORLD. */
int table_load_file(const char *path, table *t, lab_error *error);

/* The same of lines that the program carries; each ends with its LF. */
void table_load_lines(const char *const *line, size_t n, table *t);

/* Rows in the table, the names of the columns not counted. */
size_t table_rows(const table *t);

/* Cell in `row` and `column`, both counted from 0 and within the table. */
const table_cell *table_at(const table *t, size_t row, size_t column);

/* Column of a name in the header, its unit in brackets left out.  Returns: -1 if there is none. */
int table_column(const table *t, const char *name);

/* Text of a cell, by row and name of column; "" if there is no such column. */
const char *table_text(const table *t, size_t row, const char *column);

/* Whether that text is this one. */
int table_is(const table *t, size_t row, const char *column, const char *text);

/* Number of a cell that is text; NaN if it is empty or no number. */
double table_number(const table *t, size_t row, const char *column);

/* Write header and rows. NaN is an empty field, infinities are inf and
 * -inf; a text with a comma, a quote or a line break is quoted as RFC 4180 says.
 * Returns: LAB_OK or LAB_WORLD. */
int table_write(const table *t, FILE *file, lab_error *error);

#endif
