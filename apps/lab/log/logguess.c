#include "logread.h"

#include <ctype.h>
#include <string.h>

#include "../base/number.h"

enum {
  SAMPLE = 256,           /* lines looked at */
  SAMPLE_BYTES = 1 << 18, /* and bytes of them */
  BETWEEN = 4,            /* lines with words that may stand between header and rows */
  LONGER = 3              /* cells that a header may have beyond those of a row */
};

static const char delimiters[] = ",;\t|\1"; /* the first of equals wins */
static const char decimals[] = ".,";

typedef struct span {
  const char *begin, *end;
  int line;
} span;

typedef struct sample {
  lab_csv *csv;
  const lab_log_format *format;
  int first; /* line from which they are looked at */
  int n;
  span line[SAMPLE];
} sample;

/* ---- Lines ---- */

static int take_sample(lab_csv *csv, const lab_log_format *format, sample *s, lab_error *error)
{
  size_t bytes = 0;
  int more = 1;
  s->csv = csv;
  s->format = format;
  s->n = 0;
  while (s->n < SAMPLE && bytes < SAMPLE_BYTES) {
    if (lab_csv_line(csv, &more, error))
      return s->n > 0 ? LAB_OK : error->status;
    if (!more)
      break;
    bytes += (size_t)(csv->end - csv->begin);
    if (csv->line > format->skip_lines)
      s->line[s->n++] = (span){csv->begin, csv->end, csv->line};
  }
  return LAB_OK;
}

static int is_comment(const sample *s, int i)
{
  return s->format->comment && s->line[i].begin < s->line[i].end && *s->line[i].begin == s->format->comment;
}

/* Cut a line, without the mark of a comment.  Returns: its cells; 0 for none */
static int cut(const sample *s, int i, char delimiter)
{
  lab_csv *csv = s->csv;
  lab_error ignored;
  csv->begin = s->line[i].begin + (is_comment(s, i) ? 1 : 0);
  csv->end = s->line[i].end;
  csv->mark = delimiter;
  return lab_csv_cut(csv, &ignored) || csv->n > LAB_CSV_CELLS ? 0 : csv->n;
}

/* ---- Marks ---- */

/* "0,5 1,5": two numbers, where blanks are not the mark. */
static int has_two_numbers(const char *text)
{
  const char *blank = strchr(text, ' ');
  return blank && blank > text && isdigit((unsigned char)blank[-1]) &&
         isdigit((unsigned char)blank[strspn(blank, " ")]);
}

/* How well a cell looks with a decimal mark: a number or a date counts, and digits with a mark that belongs to neither
 * speak against it. */
static int worth(const lab_cell *cell, char decimal, const lab_log_format *format)
{
  lab_stamp stamp = {0};
  double value;
  int kind = lab_number_read(cell->begin, cell->end, decimal, format->thousands, &value);
  if (kind != LAB_NUMBER_BAD)
    return kind == LAB_NUMBER_FINITE ? 2 : 0;
  if (lab_stamp_read(cell->begin, cell->end, format->date, &stamp))
    return 2;
  if (has_two_numbers(cell->begin))
    return -6;
  return strpbrk(cell->begin, "0123456789") && strpbrk(cell->begin, ",;\t|.") ? -3 : 0;
}

/* What a line is worth as a row; 0 if it is none. */
static int worth_of_row(const sample *s, int i, char delimiter, char decimal)
{
  const int n = is_comment(s, i) ? 0 : cut(s, i, delimiter);
  int k, sum = 0;
  for (k = 0; k < n; k++)
    sum += worth(&s->csv->cell[k], decimal, s->format);
  return sum > 0 ? sum : 0;
}

typedef struct rows {
  int worth, first, cells; /* `first` counts in the sample */
  char delimiter, decimal;
} rows;

/* The best stretch of rows with the same number of cells. */
static rows best_rows(const sample *s, char delimiter, char decimal)
{
  rows best = {0, 0, 0, delimiter, decimal}, now = best;
  int i;
  for (i = 0; i < s->n; i++) {
    const int sum = worth_of_row(s, i, delimiter, decimal);
    if (is_comment(s, i))
      continue;
    if (sum == 0 || s->csv->n != now.cells || now.worth == 0)
      now = (rows){0, i, sum ? s->csv->n : 0, delimiter, decimal};
    now.worth += sum;
    if (now.worth > best.worth)
      best = now;
  }
  return best;
}

/* "sep=;" in the first line, as Excel has it. */
static char told_delimiter(const sample *s)
{
  const span *line = &s->line[0];
  return s->n > 0 && line->end - line->begin >= 5 && strncmp(line->begin, "sep=", 4) == 0 ? line->begin[4] : '\0';
}

static rows guess_marks(const sample *s)
{
  const char given = s->format->delimiter ? s->format->delimiter : told_delimiter(s);
  const char delimiter[2] = {given, '\0'}, decimal[2] = {s->format->decimal, '\0'};
  rows best = {0};
  const char *a, *b;
  for (a = given ? delimiter : delimiters; *a && !(*a == LAB_CSV_BLANKS && best.cells > 1);
       a++) /* blanks if all else fails */
    for (b = *decimal ? decimal : decimals; *b; b++) {
      const rows found = best_rows(s, *a, *b);
      if (found.worth > best.worth && (!s->format->n_columns || found.cells == s->format->n_columns))
        best = found;
    }
  return best;
}

/* ---- Header ---- */

static int is_blank(const lab_csv *csv)
{
  int k;
  for (k = 0; k < csv->n && k < LAB_CSV_CELLS; k++)
    if (*lab_trim(csv->cell[k].begin))
      return 0;
  return 1;
}

static int all_units(const lab_csv *csv)
{
  int k, any = 0;
  for (k = 0; k < csv->n; k++) {
    const char *text = lab_trim(csv->cell[k].begin);
    if (*text && !lab_name_is_unit(text))
      return 0;
    any |= *text != '\0';
  }
  return any;
}

/* Whether a line may be a header of rows with so many cells: words, and no number in front. */
static int may_be_header(const sample *s, int i, const rows *found)
{
  const int n = cut(s, i, found->delimiter);
  double value;
  return n >= found->cells - 1 && n <= found->cells + LONGER && !is_blank(s->csv) &&
         lab_number_read(s->csv->cell->begin, s->csv->cell->end, found->decimal, 0, &value) != LAB_NUMBER_FINITE;
}

/* The next line above that may be a header, not many lines with words away; -1 if there is none. */
static int header_above(const sample *s, int from, const rows *found)
{
  int i, words = 0;
  for (i = from - 1; i >= 0 && words < BETWEEN; i--) {
    if (may_be_header(s, i, found))
      return i;
    words += cut(s, i, found->delimiter) > 0 && !is_blank(s->csv);
  }
  return -1;
}

static void guess_header(const sample *s, const rows *found, lab_guess *guess)
{
  const int header = header_above(s, found->first, found);
  int above;
  if (header < 0)
    return;
  guess->header = s->line[header].line;
  cut(s, header, found->delimiter);
  if (!all_units(s->csv))
    return;
  above = header_above(s, header, found);
  if (above < 0 || above + 1 < header)
    return;
  guess->units = guess->header;
  guess->header = s->line[above].line;
}

/* ---- All ---- */

/* Whether the first line that is no comment is a header as pneu-rig(5) has it. */
static int is_documented(const sample *s)
{
  const lab_log_format *f = s->format;
  int i = 0, k, n;
  if ((f->delimiter && f->delimiter != ',') || (f->decimal && f->decimal != '.'))
    return 0;
  while (i < s->n && is_comment(s, i))
    i++;
  n = i < s->n ? cut(s, i, ',') : 0;
  for (k = 0; k < n; k++)
    if (lab_column_is_named(lab_trim(s->csv->cell[k].begin)))
      return 1;
  return 0;
}

static void set_marks(lab_log_format *format, char delimiter, char decimal)
{
  if (!format->delimiter)
    format->delimiter = delimiter;
  if (!format->decimal)
    format->decimal = decimal;
}

static void guess_form(const sample *s, lab_log_format *format, lab_guess *guess)
{
  const int all_given = format->delimiter && format->decimal && (format->skip_lines >= 0 || format->n_columns);
  rows found = {0};
  if (!all_given && (format->n_columns || !is_documented(s)))
    found = guess_marks(s);
  guess->guessed = found.worth > 0 && !format->n_columns;
  set_marks(format, found.worth > 0 ? found.delimiter : ',', found.worth > 0 ? found.decimal : '.');
  if (!guess->guessed)
    return;
  guess->data = s->line[found.first].line;
  guess->cells = found.cells;
  guess_header(s, &found, guess);
}

int lab_guess_form(lab_csv *csv, lab_log_format *format, lab_guess *guess, lab_error *error)
{
  sample s;
  memset(guess, 0, sizeof *guess);
  if (take_sample(csv, format, &s, error))
    return error->status;
  guess_form(&s, format, guess);
  lab_csv_restart(csv);
  return LAB_OK;
}

void lab_guess_say(const lab_guess *guess, const lab_log_format *format, char text[LAB_READ_AS_TEXT])
{
  static const char *const names[] = {"commas", "semicolons", "tabs", "bars", "blanks"};
  const char *which = strchr(delimiters, format->delimiter);
  snprintf(text, LAB_READ_AS_TEXT, "read with %s between cells, decimal %s",
           which ? names[which - delimiters] : "log.delimiter", format->decimal == ',' ? "commas" : "points");
  if (guess->header)
    lab_append(text, LAB_READ_AS_TEXT, ", header in line %d", guess->header);
  if (guess->units)
    lab_append(text, LAB_READ_AS_TEXT, ", units in line %d", guess->units);
}
