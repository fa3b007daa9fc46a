#include "batchlist.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/checksum.h"
#include "../base/escape.h"
#include "../base/names.h"
#include "../log/stamp.h"

static const char reserved[] = "batch.";                          /* names of the files beside the folders begin so, */
static const char *const others[] = {"index.html", "trends.csv"}; /* but for these */
enum { OTHERS = sizeof others / sizeof *others };

/* ---- Columns ---- */

/* Where a line has the cell of a column, and its room. */
#define CELL(name) offsetof(lab_fleet_entry, name), sizeof((lab_fleet_entry *)NULL)->name

static const struct {
  const char *name;
  int is_needed;
  size_t at, size;
} columns[] = {{"name", 0, CELL(name)},
               {"rig", 1, CELL(rig)},
               {"log", 1, CELL(log)},
               {"holdout", 0, CELL(holdout)},
               {"date", 0, CELL(date)}};
enum { COLUMNS = sizeof columns / sizeof *columns, NOTHING = -1 };

/* ---- Lines ---- */

/* A comment, or a line without a cell that has something. */
static int is_empty(const lab_csv *csv)
{
  const char *at = csv->begin + strspn(csv->begin, " \t\"");
  return *at == '#' || at + strspn(at, " \t\",;") >= csv->end;
}

/* The next line that has something.  Out: more  0 at the end */
static int next_line(lab_csv *csv, int *more, lab_error *error)
{
  do {
    if (lab_csv_line(csv, more, error))
      return error->status;
  } while (*more && is_empty(csv));
  return LAB_OK;
}

/* ---- Header ---- */

static int read_column(lab_fleet_list *list, char *cell, lab_error *error)
{
  char *c = cell = lab_trim(cell);
  int i, column;
  for (; *c; c++)
    *c = (char)tolower((unsigned char)*c);
  column = lab_name_index(cell, columns, COLUMNS, sizeof *columns);
  for (i = 0; column >= 0 && i < list->n_columns; i++)
    if (list->column[i] == column)
      return lab_fail(error, LAB_DATA, "the column %s is there twice", cell);
  if (column < 0 && *cell)
    return lab_fail(error, LAB_DATA,
                    "expected a header like name,rig,log,holdout; found the unknown column \"%s\"; the nearest known "
                    "one is %s",
                    cell, lab_name_nearest(cell, columns, COLUMNS, sizeof *columns));
  list->column[list->n_columns++] = column;
  return LAB_OK;
}

static int read_columns(lab_fleet_list *list, lab_error *error)
{
  const char first = list->csv.begin[strcspn(list->csv.begin, ",;\t\r\n")];
  int i, column;
  list->csv.mark = first == ';' || first == '\t' ? first : ',';
  if (lab_csv_cut(&list->csv, error))
    return error->status;
  for (i = 0; i < list->csv.n && i < LAB_CSV_CELLS; i++)
    if (read_column(list, list->csv.cell[i].begin, error))
      return error->status;
  for (column = 0; column < COLUMNS; column++) {
    for (i = 0; i < list->n_columns && list->column[i] != column; i++)
      ;
    if (columns[column].is_needed && i == list->n_columns)
      return lab_fail(error, LAB_DATA, "expected a header like name,rig,log,holdout; there is no column %s",
                      columns[column].name);
  }
  return LAB_OK;
}

int lab_fleet_list_open(lab_fleet_list *list, const char *path, lab_error *error)
{
  int more;
  memset(list, 0, sizeof *list);
  if (lab_csv_open(&list->csv, path, error) || next_line(&list->csv, &more, error))
    return error->status;
  if (!more)
    return lab_fail(error, LAB_DATA, "%s: the list is empty; expected a header like name,rig,log,holdout", path);
  return read_columns(list, error) ? lab_csv_fail_in(&list->csv, error) : LAB_OK;
}

void lab_fleet_list_restart(lab_fleet_list *list)
{
  lab_error never;
  int more;
  lab_csv_restart(&list->csv);
  next_line(&list->csv, &more, &never);
}

void lab_fleet_list_close(lab_fleet_list *list)
{
  lab_csv_close(&list->csv);
}

/* ---- Entries ---- */

/* "../may/p2.csv" is "may-p2". */
static int name_after_log(lab_fleet_entry *e, lab_error *error)
{
  const char *from = e->log;
  size_t length;
  char *dot;
  while (*from == '/' || (*from == '.' && (from[1] == '/' || (from[1] == '.' && from[2] == '/'))))
    from += strcspn(from, "/") + 1;
  length = strcspn(from, ";");
  if (length >= sizeof e->name)
    return lab_fail(error, LAB_DATA,
                    "the log's path is too long to name the line by; give it a name in the column name");
  snprintf(e->name, sizeof e->name, "%.*s", (int)length, from);
  lab_trim(e->name);
  lab_make_plain(e->name);
  lab_make_file_name(e->name);
  dot = strrchr(e->name, '.');
  if (dot && dot > e->name)
    *dot = '\0';
  return LAB_OK;
}

/* A name is that of a folder. */
static int check_name(const lab_fleet_entry *e, lab_error *error)
{
  const int bad = e->name[0] == '.' || !e->name[0] || strncmp(e->name, reserved, strlen(reserved)) == 0 ||
                  lab_name_index(e->name, others, OTHERS, sizeof *others) >= 0 || strpbrk(e->name, "/\\") ||
                  !lab_is_plain(e->name);
  return !bad ? LAB_OK
              : lab_fail(error, LAB_DATA,
                         "\"%s\" cannot be a name: it becomes that of a folder, so no / or \\, it does not begin "
                         "with . or %s and is not %s or %s, and it is UTF-8 without control characters",
                         e->name, reserved, others[0], others[1]);
}

/* Only as ISO 8601 has it, with the year first: 3/4/2026 is another day on either side of the ocean. */
static void read_date(lab_fleet_entry *e)
{
  lab_stamp stamp = {0};
  const int is_iso = strspn(e->date, "0123456789") == 4 && e->date[4] == '-';
  if (!*e->date)
    return;
  if (!is_iso || !lab_stamp_read(e->date, e->date + strlen(e->date), LAB_DATE_YMD, &stamp) || !stamp.has_day)
    snprintf(e->wrong, sizeof e->wrong,
             "line %d of the list, column date: expected a date like 2026-05-04 or 2026-05-04T13:30Z, found \"%s\"",
             e->line, e->date);
  e->day = (double)stamp.day + stamp.second / 86400;
}

static int fill(const lab_fleet_list *list, lab_fleet_entry *e, lab_error *error)
{
  const lab_csv *csv = &list->csv;
  int i;
  for (i = 0; i < csv->n && i < LAB_CSV_CELLS; i++) {
    const char *text = lab_trim(csv->cell[i].begin);
    const int column = i < list->n_columns ? list->column[i] : NOTHING;
    if (!*text)
      continue;
    if (column == NOTHING)
      return lab_fail(error, LAB_DATA,
                      "cell %d, \"%s\", has no column in the header; a cell with %s in it goes in quotes", i + 1, text,
                      csv->mark == '\t'  ? "a tab"
                      : csv->mark == ',' ? ","
                                         : ";");
    if (strlen(text) >= columns[column].size)
      return lab_fail(error, LAB_DATA, "column %s: expected at most %d bytes, found %d", columns[column].name,
                      (int)columns[column].size - 1, (int)strlen(text));
    strcpy((char *)e + columns[column].at, text);
  }
  for (i = 0; i < COLUMNS; i++)
    if (columns[i].is_needed && !*((const char *)e + columns[i].at))
      return lab_fail(error, LAB_DATA, "column %s is empty; every line needs a rig file and a log", columns[i].name);
  read_date(e);
  if (!*e->name && name_after_log(e, error))
    return error->status;
  return check_name(e, error);
}

int lab_fleet_list_next(lab_fleet_list *list, lab_fleet_entry *entry, int *more, lab_error *error)
{
  const int status = next_line(&list->csv, more, error);
  if (status != LAB_OK || !*more)
    return status;
  memset(entry, 0, sizeof *entry);
  entry->line = list->csv.line;
  if (lab_csv_cut(&list->csv, error) || fill(list, entry, error))
    return lab_csv_fail_in(&list->csv, error);
  return LAB_OK;
}

/* ---- The whole list ---- */

/* Names by their checksums, so that a long list takes little memory. */
typedef struct called {
  uint64_t name;
  int line;
} called;

static int by_name(const void *a, const void *b)
{
  const called *p = a, *q = b;
  return p->name != q->name ? (p->name > q->name) - (p->name < q->name) : p->line - q->line;
}

static int find_double(called *names, int n, const char *path, lab_error *error)
{
  int i;
  qsort(names, (size_t)n, sizeof *names, by_name);
  for (i = 1; i < n; i++)
    if (names[i].name == names[i - 1].name)
      return lab_fail(error, LAB_DATA,
                      "%s:%d: line %d has the same name; give each a name of its own in the column name", path,
                      names[i].line, names[i - 1].line);
  return LAB_OK;
}

static int read_names(lab_fleet_list *list, called **names, int *n, lab_error *error)
{
  lab_fleet_entry entry;
  int more, status;
  for (*n = 0; (status = lab_fleet_list_next(list, &entry, &more, error)) == LAB_OK && more; ++*n) {
    called *grown = realloc(*names, (size_t)(*n + 1) * sizeof *grown);
    if (!grown)
      return lab_fail_memory(error, list->csv.path);
    *names = grown;
    grown[*n] = (called){lab_checksum_text(LAB_CHECKSUM_SEED, entry.name), entry.line};
  }
  return status;
}

int lab_fleet_list_check(lab_fleet_list *list, int *n, lab_error *error)
{
  called *names = NULL;
  int status = read_names(list, &names, n, error);
  if (status == LAB_OK && *n == 0)
    status = lab_fail(error, LAB_DATA, "%s: there is a header and no line after it", list->csv.path);
  if (status == LAB_OK)
    status = find_double(names, *n, list->csv.path, error);
  free(names);
  lab_fleet_list_restart(list);
  return status;
}
