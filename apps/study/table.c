/* Tables of results: growth, CSV.
 * SPDX-License-Identifier: MIT */
#include "table.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static char *copy_of(const char *text)
{
  size_t size = strlen(text) + 1;
  char *copy = malloc(size);
  return copy ? memcpy(copy, text, size) : NULL;
}

static size_t count_columns(const char *header)
{
  size_t n = 1;
  for (; *header; header++)
    n += *header == ',';
  return n;
}

void table_open(table *t, const char *header)
{
  memset(t, 0, sizeof *t);
  t->columns = count_columns(header);
  t->header = copy_of(header);
  t->failed = !t->header;
}

void table_close(table *t)
{
  size_t i;
  for (i = 0; i < t->n; i++)
    free(t->cell[i].text);
  free(t->cell);
  free(t->header);
  memset(t, 0, sizeof *t);
}

/* room for one more row; doubling keeps the cost of a row constant */
static int make_room(table *t)
{
  size_t room = t->room ? 2 * t->room : 64 * t->columns;
  table_cell *cell;
  if (t->n + t->columns <= t->room)
    return 1;
  cell = realloc(t->cell, room * sizeof *cell);
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
  cell->text = text ? copy_of(text) : NULL;
  t->failed |= text && !cell->text;
}

void table_row(table *t, const char *kinds, ...)
{
  va_list args;
  assert(strlen(kinds) == t->columns);
  if (t->failed || !make_room(t)) {
    t->failed = 1;
    return;
  }
  va_start(args, kinds);
  for (; *kinds; kinds++) {
    if (*kinds == 's')
      fill_cell(t, va_arg(args, const char *), (double)NAN);
    else
      fill_cell(t, NULL, va_arg(args, double));
  }
  va_end(args);
}

void table_row_of_text(table *t, const char *const *text)
{
  size_t i;
  if (t->failed || !make_room(t)) {
    t->failed = 1;
    return;
  }
  for (i = 0; i < t->columns; i++)
    fill_cell(t, text[i], (double)NAN);
}

size_t table_rows(const table *t)
{
  return t->n / t->columns;
}

const table_cell *table_at(const table *t, size_t row, size_t column)
{
  assert(row < table_rows(t) && column < t->columns);
  return &t->cell[row * t->columns + column];
}

static void write_text(const char *text, FILE *file)
{
  if (!strpbrk(text, ",\"\r\n")) {
    fputs(text, file);
    return;
  }
  fputc('"', file);
  for (; *text; text++)
    fputs(*text == '"' ? "\"\"" : (char[]){*text, '\0'}, file);
  fputc('"', file);
}

static void write_cell(const table_cell *cell, FILE *file)
{
  if (cell->text)
    write_text(cell->text, file);
  else if (!isnan(cell->number))
    fprintf(file, "%.9g", cell->number + 0.0); /* -0 + 0 = 0 */
}

int table_write(const table *t, FILE *file, lab_error *error)
{
  size_t i;
  if (t->failed)
    return lab_fail_memory(error, "a table of results");
  fprintf(file, "%s\n", t->header);
  for (i = 0; i < t->n; i++) {
    write_cell(&t->cell[i], file);
    fputc((i + 1) % t->columns ? ',' : '\n', file);
  }
  if (fflush(file) || ferror(file))
    return lab_fail(error, LAB_WORLD, "cannot write a table: %s", strerror(errno));
  return LAB_OK;
}
