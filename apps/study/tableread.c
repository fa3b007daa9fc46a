#include "tableread.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/text.h"

enum { FIELD_TEXT = 4096, COLUMN_MAX = 64 };

/* One field of a line, quotes resolved (RFC 4180).  Returns: where the next one starts, NULL at the end of the line. */
static const char *field(const char *at, const char *end, char *out)
{
  const int quoted = at < end && *at == '"';
  size_t n = 0;
  for (at += quoted; at < end; at++) {
    if (quoted && *at == '"') {
      if (at + 1 < end && at[1] == '"')
        at++;
      else
        break;
    } else if (!quoted && *at == ',') {
      break;
    }
    if (n + 1 < FIELD_TEXT)
      out[n++] = *at;
  }
  out[n] = 0;
  while (at < end && *at != ',')
    at++;
  return at < end ? at + 1 : NULL;
}

/* The cells of a line, as one row. */
static int add_line(table *t, const char *begin, const char *end)
{
  static char text[COLUMN_MAX][FIELD_TEXT];
  const char *cell[COLUMN_MAX], *at = begin;
  size_t n = 0;
  while (at && n < COLUMN_MAX) {
    at = field(at, end, text[n]);
    cell[n] = text[n];
    n++;
  }
  if (n != t->columns)
    return -1;
  table_row_of_text(t, cell);
  return 0;
}

int table_load_file(const char *path, table *t, lab_error *error)
{
  char header[FIELD_TEXT];
  const char *begin, *end;
  lab_lines lines;
  lab_text text;
  int status = LAB_OK;
  table_open(t, "");
  if (lab_text_read(path, &text, error))
    return error->status;
  lab_lines_start(&lines, &text);
  lab_lines_next(&lines, &begin, &end);
  snprintf(header, sizeof header, "%.*s", (int)(end - begin), begin);
  table_close(t);
  table_open(t, header);
  while (status == LAB_OK && lab_lines_next(&lines, &begin, &end))
    if (add_line(t, begin, end))
      status =
          lab_fail(error, LAB_DATA, "%s:%d: expected %d fields, as in the header", path, lines.number, (int)t->columns);
  lab_text_free(&text);
  return status == LAB_OK && t->failed ? lab_fail_memory(error, path) : status;
}

int table_load(const study *s, const char *name, table *t, lab_error *error)
{
  char path[STUDY_PATH_TEXT + 64];
  snprintf(path, sizeof path, "%s/%s", s->results, name);
  return table_load_file(path, t, error);
}

int table_column(const table *t, const char *name)
{
  const char *at = t->header;
  const size_t length = strlen(name);
  int i;
  for (i = 0; at; i++) {
    if (!strncmp(at, name, length) && (at[length] == ',' || at[length] == 0 || !strncmp(at + length, " [", 2)))
      return i;
    at = strchr(at, ',');
    at = at ? at + 1 : NULL;
  }
  return -1;
}

const char *table_text(const table *t, size_t row, const char *column)
{
  const int i = table_column(t, column);
  const char *text = i < 0 ? NULL : table_at(t, row, (size_t)i)->text;
  return text ? text : "";
}

double table_number(const table *t, size_t row, const char *column)
{
  const char *text = table_text(t, row, column);
  char *end;
  const double value = strtod(text, &end);
  return end == text ? (double)NAN : value;
}
