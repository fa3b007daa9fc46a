#include "table.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/csv.h"
#include "../lab/base/escape.h"

enum { LINE_TEXT = 2048 };

/* ---- Rows ---- */

/* Room for one more row; doubling keeps the cost of a row constant.  Returns: 0 without memory, now or before. */
static int make_room(table *t)
{
  size_t room = t->room ? 2 * t->room : 64 * t->columns;
  table_cell *cell;
  if (t->failed || t->n + t->columns <= t->room)
    return !t->failed;
  cell = realloc(t->cell, room * sizeof *cell);
  t->failed = !cell;
  if (!cell)
    return 0;
  t->cell = cell;
  t->room = room;
  return 1;
}

static void fill_cell(table *t, const char *text, double number)
{
  table_cell *cell = &t->cell[t->n++];
  cell->number = number;
  cell->text = text ? strdup(text) : NULL;
  t->failed |= text && !cell->text;
}

static void fill_texts(table *t, const lab_cell *cell)
{
  size_t i;
  if (!make_room(t))
    return;
  for (i = 0; i < t->columns; i++)
    fill_cell(t, cell[i].begin, (double)NAN);
}

/* A row of texts from a line of CSV, its LF left out; the first one says how many columns there are. */
static void add_line(table *t, const char *line)
{
  char text[LINE_TEXT];
  lab_cell cell[LAB_CSV_CELLS];
  const size_t length = strcspn(line, "\n");
  int n;
  assert(length < LINE_TEXT);
  memcpy(text, line, length);
  text[length] = '\0';
  n = lab_csv_cells(text, text + length, ',', cell, LAB_CSV_CELLS);
  t->columns = t->n ? t->columns : (size_t)n;
  assert(n > 0 && n <= LAB_CSV_CELLS && (size_t)n == t->columns);
  fill_texts(t, cell);
}

void table_open(table *t, const char *header)
{
  table_load_lines(&header, 1, t);
}

void table_load_lines(const char *const *line, size_t n, table *t)
{
  size_t i;
  memset(t, 0, sizeof *t);
  for (i = 0; i < n; i++)
    add_line(t, line[i]);
}

void table_close(table *t)
{
  size_t i;
  for (i = 0; i < t->n; i++)
    free(t->cell[i].text);
  free(t->cell);
  memset(t, 0, sizeof *t);
}

void table_row(table *t, const char *kinds, ...)
{
  va_list args;
  assert(strlen(kinds) == t->columns);
  if (!make_room(t))
    return;
  va_start(args, kinds);
  for (; *kinds; kinds++) {
    if (*kinds == 's')
      fill_cell(t, va_arg(args, const char *), (double)NAN);
    else
      fill_cell(t, NULL, va_arg(args, double));
  }
  va_end(args);
}

void table_copy_row(table *t, const table *from, size_t row)
{
  size_t i;
  assert(from->columns == t->columns);
  if (row >= table_rows(from) || !make_room(t))
    return;
  for (i = 0; i < t->columns; i++) {
    const table_cell *cell = table_at(from, row, i);
    fill_cell(t, cell->text, cell->number);
  }
}

size_t table_rows(const table *t)
{
  return t->n ? t->n / t->columns - 1 : 0;
}

/* ---- Cells ---- */

const table_cell *table_at(const table *t, size_t row, size_t column)
{
  assert(row < table_rows(t) && column < t->columns);
  return &t->cell[(row + 1) * t->columns + column];
}

int table_column(const table *t, const char *name)
{
  const size_t length = strlen(name);
  size_t i;
  for (i = 0; i < t->columns; i++) {
    const char *title = t->cell[i].text;
    if (!strncmp(title, name, length) && (!title[length] || !strncmp(title + length, " [", 2)))
      return (int)i;
  }
  return -1;
}

const char *table_text(const table *t, size_t row, const char *column)
{
  const int i = table_column(t, column);
  const char *text = i < 0 ? NULL : table_at(t, row, (size_t)i)->text;
  return text ? text : "";
}

int table_is(const table *t, size_t row, const char *column, const char *text)
{
  return strcmp(table_text(t, row, column), text) == 0;
}

double table_number(const table *t, size_t row, const char *column)
{
  const char *text = table_text(t, row, column);
  char *end;
  const double value = strtod(text, &end);
  return end == text ? (double)NAN : value;
}

/* ---- Files ---- */

static int load_row(const lab_csv *csv, table *t, lab_error *error)
{
  if (csv->line == 1)
    t->columns = (size_t)(csv->n < LAB_CSV_CELLS ? csv->n : LAB_CSV_CELLS);
  if ((size_t)csv->n != t->columns)
    return lab_fail(error, LAB_DATA, "expected %d fields, as in the header", (int)t->columns);
  fill_texts(t, csv->cell);
  return t->failed ? lab_fail_memory(error, csv->path) : LAB_OK;
}

static int load_rows(lab_csv *csv, table *t, lab_error *error)
{
  int more, status;
  while ((status = lab_csv_line(csv, &more, error)) == LAB_OK && more)
    if (lab_csv_cut(csv, error) || load_row(csv, t, error))
      return lab_csv_fail_in(csv, error);
  return status;
}

int table_load_file(const char *path, table *t, lab_error *error)
{
  lab_csv csv;
  int status;
  memset(t, 0, sizeof *t);
  status = lab_csv_open(&csv, path, error);
  if (status == LAB_OK)
    status = load_rows(&csv, t, error);
  lab_csv_close(&csv);
  return status;
}

static void write_cell(const table_cell *cell, int digits, FILE *file)
{
  if (cell->text)
    lab_put_cell(file, cell->text);
  else if (!isnan(cell->number))
    fprintf(file, "%.*g", digits ? digits : 9, cell->number + 0.0); /* -0 + 0 = 0 */
}

int table_write(const table *t, FILE *file, lab_error *error)
{
  size_t i;
  if (t->failed)
    return lab_fail_memory(error, "a table of results");
  for (i = 0; i < t->n; i++) {
    write_cell(&t->cell[i], t->digits, file);
    fputc((i + 1) % t->columns ? ',' : '\n', file);
  }
  if (fflush(file) || ferror(file))
    return lab_fail(error, LAB_WORLD, "cannot write a table: %s", strerror(errno));
  return LAB_OK;
}
