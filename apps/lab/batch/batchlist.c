#include "batchlist.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "cells.h"
#include "../base/checksum.h"
#include "../base/names.h"
#include "split.h"

static const char marks[] = ",;\t";
static const char reserved[] = "batch.";     /* names of the files beside the folders begin so, */
static const char overview[] = "index.html"; /* but for this one */

/* ---- Columns ---- */

enum column { NAME, RIG, LOG, HOLDOUT, COLUMNS, NOTHING = -1 };

static const char *const column_names[COLUMNS] = {"name", "rig", "log", "holdout"};
static const int is_needed[COLUMNS] = {0, 1, 1, 0};

static char *place_of(lab_entry *e, int column, size_t *size)
{
  char *const place[COLUMNS] = {e->name, e->rig, e->log, e->holdout};
  const size_t sizes[COLUMNS] = {sizeof e->name, sizeof e->rig, sizeof e->log, sizeof e->holdout};
  *size = sizes[column];
  return place[column];
}

/* ---- Lines and cells ---- */

static int fail_at(const lab_list *list, lab_error *error)
{
  return lab_fail_in(error, "%s:%d", list->path, list->line);
}

/* Take a line as it was read.  Out: empty  not 0 for a comment, and for a line without a cell that has something */
static int take_line(lab_list *list, size_t length, int *empty, lab_error *error)
{
  char *text = list->text;
  list->line++;
  if (list->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0)
    memmove(text, text + 3, (length -= 3) + 1);
  if (strlen(text) != length) {
    lab_fail(error, LAB_DATA, "expected text, found a 0 byte (UTF-16? save the list as CSV in UTF-8)");
    return fail_at(list, error);
  }
  text[strcspn(text, "\r\n")] = '\0';
  text += strspn(text, " \t\"");
  *empty = *text == '#' || !text[strspn(text, " \t\",;")];
  return LAB_OK;
}

/* The next line that has something.  Out: more  0 at the end */
static int next_line(lab_list *list, int *more, lab_error *error)
{
  int empty = 1;
  while (empty) {
    ssize_t length;
    errno = 0;
    length = getline(&list->text, &list->room, list->file);
    *more = length >= 0;
    if (!*more)
      return errno ? lab_fail(error, LAB_WORLD, "%s: cannot be read: %s", list->path, strerror(errno)) : LAB_OK;
    if (take_line(list, (size_t)length, &empty, error))
      return error->status;
  }
  return LAB_OK;
}

static int cells_of(lab_list *list, char *cell[LAB_LIST_CELLS], int *n, lab_error *error)
{
  *n = lab_cells_cut(list->text, list->mark, cell, LAB_LIST_CELLS);
  if (*n >= 0)
    return LAB_OK;
  lab_fail(error, LAB_DATA, "a quote \" begins and does not end on this line");
  return fail_at(list, error);
}

/* ---- Header ---- */

static int read_column(lab_list *list, char *cell, lab_error *error)
{
  char *c = cell = lab_trim(cell);
  int i, column;
  for (; *c; c++)
    *c = (char)tolower((unsigned char)*c);
  column = lab_name_index(cell, column_names, COLUMNS, sizeof *column_names);
  for (i = 0; column >= 0 && i < list->n_columns; i++)
    if (list->column[i] == column)
      return lab_fail(error, LAB_DATA, "the column %s is there twice", cell);
  if (column < 0 && *cell)
    return lab_fail(error, LAB_DATA,
                    "expected a header like name,rig,log,holdout; found the unknown column \"%s\"; the nearest known "
                    "one is %s",
                    cell, lab_name_nearest(cell, column_names, COLUMNS, sizeof *column_names));
  list->column[list->n_columns++] = column;
  return LAB_OK;
}

static int has_column(const lab_list *list, int column)
{
  int i, any = 0;
  for (i = 0; i < list->n_columns; i++)
    any |= list->column[i] == column;
  return any;
}

static int read_header(lab_list *list, lab_error *error)
{
  char *cell[LAB_LIST_CELLS];
  const char *mark;
  int i, n, more;
  if (next_line(list, &more, error))
    return error->status;
  if (!more)
    return lab_fail(error, LAB_DATA, "%s: the list is empty; expected a header like name,rig,log,holdout", list->path);
  mark = strpbrk(list->text, marks);
  list->mark = *(mark ? mark : marks);
  if (cells_of(list, cell, &n, error))
    return error->status;
  for (i = 0; i < n; i++)
    if (read_column(list, cell[i], error))
      return fail_at(list, error);
  for (i = 0; i < COLUMNS; i++)
    if (is_needed[i] && !has_column(list, i)) {
      lab_fail(error, LAB_DATA, "expected a header like name,rig,log,holdout; there is no column %s", column_names[i]);
      return fail_at(list, error);
    }
  return LAB_OK;
}

int lab_list_open(lab_list *list, const char *path, lab_error *error)
{
  memset(list, 0, sizeof *list);
  list->path = path;
  list->file = fopen(path, "r");
  if (list->file)
    return read_header(list, error);
  if (errno == ENOENT || errno == ENOTDIR)
    return lab_fail(error, LAB_DATA, "%s: there is no such file; check the name and the folder", path);
  return lab_fail(error, LAB_WORLD, "%s: cannot be read: %s", path, strerror(errno));
}

int lab_list_restart(lab_list *list, lab_error *error)
{
  rewind(list->file);
  list->line = list->n_columns = 0;
  return read_header(list, error);
}

void lab_list_close(lab_list *list)
{
  if (list->file)
    fclose(list->file);
  free(list->text);
  memset(list, 0, sizeof *list);
}

/* ---- Entries ---- */

/* "../may/p2.csv" is "may-p2". */
static int name_after_log(lab_entry *e, lab_error *error)
{
  const char *from = e->log;
  size_t length, i;
  char *dot;
  while (*from == '/' || (*from == '.' && (from[1] == '/' || (from[1] == '.' && from[2] == '/'))))
    from += strcspn(from, "/") + 1;
  length = strcspn(from, ";");
  if (length >= sizeof e->name)
    return lab_fail(error, LAB_DATA,
                    "the log's path is too long to name the line by; give it a name in the column name");
  snprintf(e->name, sizeof e->name, "%.*s", (int)length, from);
  lab_trim(e->name);
  for (i = 0; e->name[i]; i++)
    if (e->name[i] == '/' || e->name[i] == '\\')
      e->name[i] = '-';
  dot = strrchr(e->name, '.');
  if (dot && dot > e->name)
    *dot = '\0';
  return LAB_OK;
}

/* A name is that of a folder. */
static int check_name(const lab_entry *e, lab_error *error)
{
  const char *c;
  int bad = e->name[0] == '.' || !e->name[0] || strncmp(e->name, reserved, strlen(reserved)) == 0 ||
            strcmp(e->name, overview) == 0;
  for (c = e->name; *c; c++)
    bad |= *c == '/' || *c == '\\' || iscntrl((unsigned char)*c);
  return !bad ? LAB_OK
              : lab_fail(error, LAB_DATA,
                         "\"%s\" cannot be a name: it becomes that of a folder, so no / or \\, and it does not begin "
                         "with . or %s and is not %s",
                         e->name, reserved, overview);
}

static int fill(const lab_list *list, char *cell[LAB_LIST_CELLS], int n, lab_entry *e, lab_error *error)
{
  int i;
  for (i = 0; i < n; i++) {
    const char *text = lab_trim(cell[i]);
    const int column = i < list->n_columns ? list->column[i] : NOTHING;
    size_t size;
    char *place;
    if (!*text)
      continue;
    if (column == NOTHING)
      return lab_fail(error, LAB_DATA,
                      "cell %d, \"%s\", has no column in the header; a cell with %s in it goes in quotes", i + 1, text,
                      list->mark == '\t'  ? "a tab"
                      : list->mark == ',' ? ","
                                          : ";");
    place = place_of(e, column, &size);
    if (strlen(text) >= size)
      return lab_fail(error, LAB_DATA, "column %s: expected at most %d bytes, found %d", column_names[column],
                      (int)size - 1, (int)strlen(text));
    strcpy(place, text);
  }
  for (i = 0; i < COLUMNS; i++) {
    size_t size;
    if (is_needed[i] && !*place_of(e, i, &size))
      return lab_fail(error, LAB_DATA, "column %s is empty; every line needs a rig file and a log", column_names[i]);
  }
  return *e->name || name_after_log(e, error) == LAB_OK ? check_name(e, error) : error->status;
}

int lab_list_next(lab_list *list, lab_entry *entry, int *more, lab_error *error)
{
  char *cell[LAB_LIST_CELLS];
  int n;
  const int status = next_line(list, more, error);
  if (status != LAB_OK || !*more)
    return status;
  memset(entry, 0, sizeof *entry);
  entry->line = list->line;
  if (cells_of(list, cell, &n, error))
    return error->status;
  return fill(list, cell, n, entry, error) ? fail_at(list, error) : LAB_OK;
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

static int read_names(lab_list *list, called **names, int *n, lab_error *error)
{
  lab_entry entry;
  int more, room = 0;
  for (*n = 0;; ++*n) {
    const int status = lab_list_next(list, &entry, &more, error);
    if (status != LAB_OK || !more)
      return status;
    if (*n == room) {
      called *grown = realloc(*names, (size_t)(room = 2 * room + 256) * sizeof *grown);
      if (!grown)
        return lab_fail_memory(error, list->path);
      *names = grown;
    }
    (*names)[*n].name = lab_checksum_text(LAB_CHECKSUM_SEED, entry.name);
    (*names)[*n].line = entry.line;
  }
}

int lab_list_check(lab_list *list, int *n, lab_error *error)
{
  called *names = NULL;
  int status = read_names(list, &names, n, error);
  if (status == LAB_OK && *n == 0)
    status = lab_fail(error, LAB_DATA, "%s: there is a header and no line after it", list->path);
  if (status == LAB_OK)
    status = find_double(names, *n, list->path, error);
  free(names);
  return status == LAB_OK ? lab_list_restart(list, error) : status;
}
