#include "batchindex.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <cjson/cJSON.h>

#include "../base/csv.h"
#include "../base/escape.h"
#include "../base/outfile.h"
#include "../base/format.h"
#include "../base/json.h"
#include "../base/names.h"
#include "../base/template.h"
#include "../base/text.h"

/* Verdicts, the worst first; where nothing is missing, what deviates comes before what does not. */
static const char *const severities[] = {"error", "unlisted", "effect", "deviates", "undecided", "none"};
enum { SEVERITIES = sizeof severities / sizeof *severities };

/* Of the errors of a channel (enum lab_row_cells). */
enum { BEFORE, AFTER, HELD_BEFORE, HELD_AFTER };

/* ---- Rows ---- */

/* A row cut into its cells. */
typedef struct cut_row {
  char text[LAB_ROW_TEXT];
  lab_cell cell[LAB_ROW_CELLS];
} cut_row;

static void cut(const char *row, cut_row *to)
{
  static char empty[] = "";
  int n;
  snprintf(to->text, sizeof to->text, "%s", row);
  n = lab_csv_cells(to->text, to->text + strlen(to->text), ',', to->cell, LAB_ROW_CELLS);
  for (n = n < 0 ? 0 : n; n < LAB_ROW_CELLS; n++)
    to->cell[n].begin = empty;
}

/* The error of the worst channel.  Returns: NaN if there is none */
static double worst(const cut_row *row, int stage)
{
  double most = (double)NAN;
  int c;
  for (c = 0; c < LAB_ROW_CHANNELS; c++) {
    const char *cell = row->cell[LAB_ROW_ERRORS + c * LAB_ROW_STAGES + stage].begin;
    if (*cell)
      most = fmax(most, strtod(cell, NULL));
  }
  return most;
}

static int severity_of(const cut_row *row)
{
  const char *condition = row->cell[LAB_ROW_CONDITION].begin, *verdict = row->cell[LAB_ROW_VERDICT].begin;
  int s;
  if (!strcmp(verdict, severities[SEVERITIES - 1]) && !strcmp(condition, lab_condition_text(LAB_CONDITION_DEVIATES)))
    verdict = condition;
  s = lab_name_index(verdict, severities, SEVERITIES, sizeof *severities);
  return s < 0 ? SEVERITIES - 1 : s;
}

/* ---- Order ---- */

int lab_index_add(lab_index *index, const char *name, const lab_done *done, lab_error *error)
{
  lab_index_entry *entry = realloc(index->entry, (size_t)(index->n + 1) * sizeof *entry);
  cut_row row;
  double gain;
  if (!entry)
    return lab_fail_memory(error, "index.html");
  index->entry = entry;
  entry += index->n;
  cut(done->outcome.row, &row);
  /* below the noise one error is as good as another */
  gain = fmax(worst(&row, BEFORE), 1) / fmax(worst(&row, AFTER), 1);
  *entry = (lab_index_entry){.name = strdup(name),
                             .row = strdup(done->outcome.row),
                             .page = done->outcome.status != LAB_OK    ? NULL
                                     : done->extent >= LAB_WRITE_PLAIN ? "report.html"
                                                                       : "report.json",
                             .severity = severity_of(&row),
                             .gain = isfinite(gain) ? gain : 0,
                             .line = index->n};
  index->n++;
  return entry->name && entry->row ? LAB_OK : lab_fail_memory(error, "index.html");
}

void lab_index_free(lab_index *index)
{
  int i;
  for (i = 0; i < index->n; i++) {
    free(index->entry[i].name);
    free(index->entry[i].row);
  }
  free(index->entry);
  memset(index, 0, sizeof *index);
}

static int by_severity(const void *a, const void *b)
{
  const lab_index_entry *p = a, *q = b;
  if (p->severity != q->severity)
    return p->severity - q->severity;
  if (p->gain != q->gain)
    return p->gain < q->gain ? 1 : -1;
  return p->line - q->line;
}

/* ---- Cells ---- */

static void put_text(FILE *file, const char *text)
{
  fputs("<td>", file);
  lab_put_html(file, text);
  fputs("</td>", file);
}

static void put_error(FILE *file, double error)
{
  put_text(file, isnan(error) ? "" : LAB_NUMBER(error, 3));
}

/* The name, with a link to what was written about it. */
static void put_name(FILE *file, const lab_index_entry *entry)
{
  fputs("<th scope=\"row\">", file);
  if (entry->page) {
    fputs("<a href=\"", file);
    lab_put_address(file, entry->name);
    fprintf(file, "/%s\">", entry->page);
  }
  lab_put_html(file, entry->name);
  fputs(entry->page ? "</a></th>" : "</th>", file);
}

/* "1.36e-08 m2 + 3 K/W": each size as engineers write it; what is no size as it is */
static void put_sizes(FILE *file, char *text)
{
  const char *plus = "";
  fputs("<td>", file);
  while (text && *text) {
    char *next = strstr(text, " + "), *unit;
    double value;
    if (next) {
      *next = '\0';
      next += 3;
    }
    value = strtod(text, &unit);
    fputs(plus, file);
    lab_put_html(file, unit > text && *unit == ' ' && strlen(unit) < 24 ? LAB_QUANTITY(value, unit + 1, 4) : text);
    plus = " + ";
    text = next;
  }
  fputs("</td>", file);
}

static void put_row(FILE *file, const lab_index_entry *entry)
{
  const char *severity = severities[entry->severity];
  cut_row row;
  cut(entry->row, &row);
  fputs("<tr>", file);
  put_name(file, entry);
  fprintf(file, "<td><span class=\"badge %s\">%s</span></td>", severity, severity);
  put_text(file, row.cell[LAB_ROW_FOUND].begin);
  put_sizes(file, row.cell[LAB_ROW_SIZE].begin);
  put_text(file, row.cell[LAB_ROW_ALIKE].begin);
  put_error(file, worst(&row, BEFORE));
  put_error(file, worst(&row, AFTER));
  put_error(file, worst(&row, HELD_AFTER));
  put_text(file, strcmp(row.cell[LAB_ROW_LIMITATIONS].begin, "0") ? row.cell[LAB_ROW_LIMITATIONS].begin : "");
  put_text(file, row.cell[LAB_ROW_MESSAGE].begin);
  put_text(file, row.cell[LAB_ROW_DEVIATIONS].begin);
  fputs("</tr>\n", file);
}

/* ---- The page ---- */

/* "12 error" and so on */
static void add_counts(const lab_index *index, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "counts");
  int s, i;
  for (s = 0; s < SEVERITIES; s++) {
    int n = 0;
    cJSON *item;
    for (i = 0; i < index->n; i++)
      n += index->entry[i].severity == s;
    if (n == 0)
      continue;
    item = lab_json_append(list);
    lab_json_put(item, "n", "%d", n);
    lab_json_put(item, "kind", "%s", severities[s]);
  }
}

/* The template on both sides of its place for the rows, which may be many. */
static int put_page(const lab_index *index, const cJSON *page, char *template, FILE *file, lab_error *error)
{
  static const char place[] = "<!-- rows -->\n";
  char *rows = strstr(template, place);
  int i;
  if (!rows)
    return lab_fail(error, LAB_DATA, "template: no place for the rows");
  *rows = '\0';
  if (lab_template_write(file, template, page, error))
    return error->status;
  for (i = 0; i < index->n; i++)
    put_row(file, &index->entry[i]);
  return lab_template_write(file, rows + strlen(place), page, error);
}

int lab_index_write(lab_index *index, const char *list, const lab_trends *trends, const char *folder, lab_error *error)
{
  cJSON *page = cJSON_CreateObject();
  char *template = lab_page_text("index", page);
  lab_outfile out;
  int status = template ? LAB_OK : lab_fail_memory(error, "index.html");
  lab_json_put(page, "list", "%s", lab_file_name(list));
  lab_json_put(page, "lines", "%d line%s", index->n, index->n == 1 ? "" : "s");
  lab_json_put(page, "version", "%s", PNEU_VERSION);
  add_counts(index, page);
  lab_trends_page(trends, page);
  qsort(index->entry, (size_t)index->n, sizeof *index->entry, by_severity);
  if (status == LAB_OK && (status = lab_out_open(&out, LAB_IN_FOLDER(folder, "index.html"), error)) == LAB_OK)
    status = lab_out_end(&out, put_page(index, page, template, out.file, error), error);
  cJSON_Delete(page);
  free(template);
  return status;
}
