#include "logread.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "../base/number.h"

const char *lab_log_quote(const char *text, char shown[LAB_QUOTE])
{
  size_t n;
  for (n = 0; *text && n < LAB_QUOTE - 4; text++)
    shown[n++] = (char)(isprint((unsigned char)*text) ? *text : '?');
  strcpy(shown + n, *text ? "..." : "");
  return shown;
}

/* Work the scale and the offset of the format into a column. */
static void scale_column(const lab_log_format *format, lab_column *column)
{
  const int c = column->channel;
  if (c < 0)
    return;
  column->offset = format->scale[c] * column->offset + format->offset[c];
  column->scale *= format->scale[c];
}

static int read_column(const char *text, const lab_log_format *format, lab_column *column, lab_error *error)
{
  if (lab_column_read(text, format, column, error))
    return error->status;
  scale_column(format, column);
  return LAB_OK;
}

static int has_control(const char *text)
{
  while (*text && !iscntrl((unsigned char)*text))
    text++;
  return *text != '\0';
}

/* ---- The header line, and what stands around it ---- */

/* The file has no header: show log.columns with as many columns as it has. */
static int ask_for_columns(const lab_csv *csv, int cells, lab_error *error)
{
  static const char *const usual[] = {"t [s]", "u [1]", "p [bar]", "x [mm]"};
  char columns[8 * LAB_COLUMN_MAX + 64] = "";
  int i;
  for (i = 0; i < cells && i < LAB_COLUMN_MAX; i++)
    lab_append(columns, sizeof columns, "%s\"%s\"", i ? ", " : "", i < 4 ? usual[i] : "-");
  lab_fail(error, LAB_DATA,
           "expected a header \"name [unit], ...\", found numbers; for a file without a header give log.columns in the "
           "rig file, with its own channels and units: log = { columns = ( %s ); };",
           columns);
  return lab_csv_fail_in(csv, error);
}

/* Step to a line of the file, forward or back. */
static int go_to(lab_csv *csv, int line, lab_error *error)
{
  int more = 1;
  if (csv->line > line)
    lab_csv_restart(csv);
  while (csv->line < line && more)
    if (lab_csv_line(csv, &more, error))
      return error->status;
  return LAB_OK;
}

static int read_headings(lab_csv *csv, const lab_log_format *format, lab_heading *heading, int *n, lab_error *error)
{
  char shown[LAB_QUOTE];
  csv->begin += csv->begin < csv->end && format->comment && *csv->begin == format->comment;
  if (lab_csv_cut(csv, error))
    return error->status;
  if (csv->n > LAB_COLUMN_MAX)
    return lab_fail(error, LAB_DATA, "expected at most %d columns", LAB_COLUMN_MAX);
  for (*n = 0; *n < csv->n; ++*n) {
    const char *text = lab_trim(csv->cell[*n].begin);
    if (has_control(text))
      return lab_fail(error, LAB_DATA, "column %d: expected \"name [unit]\", found \"%s\"", *n + 1,
                      lab_log_quote(text, shown));
    lab_encode_cell(text, heading[*n].text, LAB_HEADING_TEXT);
  }
  return LAB_OK;
}

/* A line below the headings: that of their units, or the first row, which shows which of them are dates or times. */
static int read_below(lab_csv *csv, const lab_log_format *format, int n, lab_heading *heading, int is_units,
                      lab_error *error)
{
  int i;
  if (lab_csv_cut(csv, error))
    return error->status;
  for (i = 0; i < n && i < csv->n && i < LAB_CSV_CELLS; i++) {
    const lab_cell *cell = &csv->cell[i];
    if (is_units)
      lab_encode_cell(lab_trim(cell->begin), heading[i].below, LAB_HEADING_TEXT);
    else if (!lab_stamp_read(cell->begin, cell->end, format->date, &heading[i].stamp))
      heading[i].stamp = (lab_stamp){0};
  }
  return LAB_OK;
}

/* A header whose line was guessed. Rows say how many columns there are. */
static int read_guessed(lab_csv *csv, const lab_log_format *format, const lab_guess *guess, lab_heading *heading,
                        int *n, lab_error *error)
{
  if (go_to(csv, guess->header ? guess->header : guess->data, error))
    return error->status;
  if (!guess->header)
    return ask_for_columns(csv, guess->cells, error);
  if (read_headings(csv, format, heading, n, error) || (guess->units && go_to(csv, guess->units, error)) ||
      (guess->units && read_below(csv, format, *n, heading, 1, error)) || go_to(csv, guess->data, error) ||
      read_below(csv, format, *n, heading, 0, error))
    return lab_csv_fail_in(csv, error);
  *n = guess->cells;
  return go_to(csv, guess->data - 1, error);
}

/* The first row, which shows what is a date, and back to the header. A damaged one shows nothing here. */
static int look_below(lab_csv *csv, const lab_log_format *format, int n, lab_heading *heading, lab_error *error)
{
  const int line = csv->line;
  lab_error damaged;
  int more;
  if (lab_csv_line(csv, &more, &damaged) == LAB_OK && more)
    read_below(csv, format, n, heading, 0, &damaged);
  return go_to(csv, line, error);
}

/* A header in the first line that is no comment. */
static int read_first(lab_csv *csv, const lab_log_format *format, lab_heading *heading, int *n, lab_error *error)
{
  double number;
  int more;
  csv->comment = format->comment;
  if (lab_csv_line(csv, &more, error))
    return error->status;
  if (!more)
    return lab_fail(error, LAB_DATA, "%s: expected a header \"name [unit], ...\", found the end of the file",
                    csv->path);
  if (lab_csv_cut(csv, error))
    return lab_csv_fail_in(csv, error);
  if (lab_number_read(csv->cell->begin, csv->cell->end, format->decimal, format->thousands, &number) ==
      LAB_NUMBER_FINITE) /* a row: the file has no header */
    return ask_for_columns(csv, csv->n, error);
  return read_headings(csv, format, heading, n, error) ? lab_csv_fail_in(csv, error)
                                                       : look_below(csv, format, *n, heading, error);
}

static int fail_in_header(const lab_csv *csv, const lab_guess *guess, lab_error *error)
{
  return lab_fail_in(error, "%s:%d", csv->path, guess->header ? guess->header : csv->line);
}

/* Neither a header as documented nor numbers. */
static int fail_without_rows(const lab_csv *csv, lab_error *error)
{
  const lab_error before = *error;
  return lab_fail(error, LAB_DATA,
                  "%s:%d: %.400s; nor are there rows of numbers. If this is a log, say how it is written: log = { "
                  "delimiter = \";\"; decimal = \",\"; skip_lines = 3; };",
                  csv->path, csv->line, before.text);
}

static int read_columns(lab_csv *csv, lab_log_format *format, const lab_guess *guess, lab_header *header,
                        char said[LAB_READ_AS_TEXT], lab_error *error)
{
  lab_heading heading[LAB_COLUMN_MAX];
  int i, n = 0;
  memset(heading, 0, sizeof heading);
  csv->mark = format->delimiter;
  if (guess->guessed ? read_guessed(csv, format, guess, heading, &n, error)
                     : read_first(csv, format, heading, &n, error))
    return error->status;
  if (guess->guessed) {
    if (lab_long_check(csv, format, guess, heading, error))
      return fail_in_header(csv, guess, error);
    if (go_to(csv, guess->data - 1, error))
      return error->status;
    lab_guess_say(guess, format, said);
  }
  if (lab_map_columns(heading, n, guess->guessed, format, header, said, error))
    return lab_map_is_named(heading, n) || guess->guessed ? fail_in_header(csv, guess, error)
                                                          : fail_without_rows(csv, error);
  for (i = 0; i < n; i++)
    scale_column(format, &header->column[i]);
  return LAB_OK;
}

static int skip_lines(lab_csv *csv, int n, lab_error *error)
{
  if (go_to(csv, n, error))
    return error->status;
  return csv->line >= n ? LAB_OK
                        : lab_fail(error, LAB_DATA, "%s: expected more than the %d lines to skip, found %d", csv->path,
                                   n, csv->line);
}

/* Columns as the rig file lists them, with the words of a long file. */
static int take_listed(const lab_log_format *format, lab_header *header, lab_error *error)
{
  int i;
  for (i = 0; i < format->n_columns; i++) {
    strcpy(header->text[i], format->column[i]);
    if (read_column(format->column[i], format, &header->column[i], error))
      return lab_fail_in(error, "log.columns: column %d", i + 1);
  }
  header->n = format->n_columns;
  for (i = 0; i < format->n_quantities; i++)
    if (read_column(format->quantity[i].column, format, &header->quantity[i], error))
      return lab_fail_in(error, "log.quantities");
  return LAB_OK;
}

int lab_header_count(const lab_header *header, const lab_log_format *format, int channel)
{
  int i, n = 0;
  for (i = 0; i < header->n; i++)
    n += header->column[i].channel == channel;
  for (i = 0; i < format->n_quantities; i++)
    n += header->quantity[i].channel == channel;
  return n;
}

/* Each channel once, and from one place. */
static int check_channels(const lab_header *header, const lab_log_format *format, lab_error *error)
{
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    int n = lab_header_count(header, format, i);
    if (n > 1 && !format->weighted)
      return lab_fail(error, LAB_DATA,
                      "expected channel %s once, found %d of it; name a column to ignore \"-\", or give log.weights",
                      lab_channels[i].key, n);
    if (n && !isnan(format->constant[i]))
      return lab_fail(error, LAB_DATA, "expected channel %s once, found it as a column and in log.constants",
                      lab_channels[i].key);
  }
  return LAB_OK;
}

static int check_time(const lab_header *header, const lab_log_format *format, lab_error *error)
{
  const int n = lab_header_count(header, format, LAB_CHANNEL_TIME);
  if (!n && !(format->time_step > 0))
    return lab_fail(error, LAB_DATA,
                    "expected a column t, such as \"t [s]\", found none; without one give log.time_step");
  if (n && format->time_step > 0)
    return lab_fail(error, LAB_DATA, "expected a column t or log.time_step, found both");
  return LAB_OK;
}

static int check_long(const lab_header *header, const lab_log_format *format, lab_error *error)
{
  int is_long = format->n_quantities > 0;
  if (lab_header_count(header, format, LAB_COLUMN_QUANTITY) == is_long &&
      lab_header_count(header, format, LAB_COLUMN_VALUE) == is_long)
    return LAB_OK;
  return lab_fail(error, LAB_DATA,
                  "expected one column \"quantity\" and one \"value\" with the group "
                  "log.quantities, or none of the three");
}

int lab_header_read(lab_csv *csv, lab_log_format *format, lab_header *header, char said[LAB_READ_AS_TEXT],
                    lab_error *error)
{
  lab_guess guess;
  int i;
  header->n = header->has_stamps = 0;
  *said = '\0';
  memset(header->quantity, 0, sizeof header->quantity);
  if (lab_guess_form(csv, format, &guess, error) || skip_lines(csv, format->skip_lines, error) ||
      take_listed(format, header, error))
    return error->status;
  csv->mark = format->delimiter;
  if (header->n == 0 && read_columns(csv, format, &guess, header, said, error))
    return error->status;
  csv->comment = format->comment;
  for (i = 0; i < header->n; i++)
    header->has_stamps |= header->column[i].is_stamp;
  if (check_channels(header, format, error) || check_time(header, format, error) || check_long(header, format, error))
    return fail_in_header(csv, &guess, error);
  return LAB_OK;
}
