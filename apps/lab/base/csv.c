#include "csv.h"

#include <ctype.h>
#include <string.h>

/* ---- Lines ---- */

int lab_csv_open(lab_csv *csv, const char *path, lab_error *error)
{
  csv->path = path;
  csv->mark = ',';
  csv->comment = '\0';
  csv->n = 0;
  if (lab_text_read(path, &csv->text, error))
    return error->status;
  lab_csv_restart(csv);
  return LAB_OK;
}

void lab_csv_close(lab_csv *csv)
{
  lab_text_free(&csv->text);
}

void lab_csv_restart(lab_csv *csv)
{
  csv->begin = csv->end = csv->rest = csv->text.data;
  csv->line = 0;
}

int lab_csv_fail_in(const lab_csv *csv, lab_error *error)
{
  return lab_fail_in(error, "%s:%d", csv->path, csv->line);
}

/* Step to the next line.  Returns: 0 after the last one. */
static int step(lab_csv *csv)
{
  const char *const end = csv->text.data + csv->text.size, *stop;
  if (csv->rest >= end)
    return 0;
  stop = memchr(csv->rest, '\n', (size_t)(end - csv->rest));
  csv->begin = csv->rest;
  csv->end = stop ? stop : end;
  csv->rest = csv->end + 1;
  csv->line++;
  if (csv->end > csv->begin && csv->end[-1] == '\r')
    csv->end--;
  return 1;
}

int lab_csv_line(lab_csv *csv, int *more, lab_error *error)
{
  do {
    *more = step(csv);
    if (*more && csv->end - csv->begin > LAB_CSV_LINE) {
      lab_fail(error, LAB_DATA, "expected a line of at most %d bytes, found %ld: this is not a log, a list or a table",
               LAB_CSV_LINE, (long)(csv->end - csv->begin));
      return lab_csv_fail_in(csv, error);
    }
  } while (*more && csv->comment && *csv->begin == csv->comment);
  return LAB_OK;
}

int lab_csv_is_over(const lab_csv *csv)
{
  const char *at = csv->begin;
  while (isspace((unsigned char)*at))
    at++;
  return *at == '\0';
}

size_t lab_csv_lines(const lab_csv *csv)
{
  const char *at = csv->text.data, *const end = at + csv->text.size;
  size_t n = 0;
  for (; at && at < end; n++) {
    const char *mark = memchr(at, '\n', (size_t)(end - at));
    at = mark ? mark + 1 : NULL;
  }
  return n;
}

/* ---- Cells ---- */

/* Move a cell's text to where it begins, without its quotes.
 * In:      at  behind the first quote
 * Returns: the mark or the end behind it; NULL for a quote that does not end */
static char *unquote(char *at, char *end, char mark, lab_cell *cell)
{
  int inside = 1;
  cell->begin = cell->end = at;
  for (; at < end && (inside || *at != mark); at++)
    if (inside && *at == '"' && at[1] != '"') {
      inside = 0;
    } else {
      at += inside && *at == '"'; /* two for one */
      *cell->end++ = *at;
    }
  return inside ? NULL : at;
}

/* Returns: the mark or the end behind the cell; NULL for a quote that does not end */
static char *cut_cell(char *at, char *end, char mark, lab_cell *cell)
{
  char *first = at;
  while (*first == ' ' && mark != ' ')
    first++;
  if (*first == '"')
    return unquote(first + 1, end, mark, cell);
  cell->begin = at;
  at = memchr(at, mark, (size_t)(end - at));
  return cell->end = at ? at : end;
}

int lab_csv_cells(char *at, char *end, char mark, lab_cell *cell, int most)
{
  const int any_number = mark == LAB_CSV_BLANKS;
  lab_cell beyond;
  int n;
  if (any_number) {
    mark = ' ';
    while (at < end && *at == ' ')
      at++;
    while (end > at && end[-1] == ' ')
      end--;
  }
  for (n = 1;; n++) {
    lab_cell *to = n <= most ? &cell[n - 1] : &beyond;
    char *stop = cut_cell(at, end, mark, to);
    if (!stop)
      return -1;
    *to->end = '\0';
    if (stop == end)
      return n;
    at = stop + 1;
    if (any_number)
      at += strspn(at, " ");
  }
}

int lab_csv_cut(lab_csv *csv, lab_error *error)
{
  const size_t length = (size_t)(csv->end - csv->begin);
  memcpy(csv->row, csv->begin, length);
  csv->row[length] = '\0';
  csv->n = lab_csv_cells(csv->row, csv->row + length, csv->mark, csv->cell, LAB_CSV_CELLS);
  if (csv->n < 0)
    return lab_fail(error, LAB_DATA, "a quote \" begins and does not end on this line");
  return LAB_OK;
}
