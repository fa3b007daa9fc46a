#include "logheader.h"

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

/* A column with the scale and the offset of the format worked in. */
static int read_column(const char *text, const lab_log_format *format, double ambient, lab_column *column,
                       lab_error *error)
{
  const lab_column_frame frame = {ambient, format->stroke, format->command_is_pressure};
  double scale, offset;
  if (lab_column_read(text, &frame, column, error))
    return error->status;
  if (column->channel < 0)
    return LAB_OK;
  scale = format->scale[column->channel];
  offset = format->offset[column->channel];
  column->offset = scale * column->offset + offset;
  column->scale *= scale;
  return LAB_OK;
}

static int add_column(const char *text, const lab_log_format *format, double ambient, lab_header *header,
                      lab_error *error)
{
  int i = header->n++;
  strcpy(header->text[i], text);
  if (read_column(text, format, ambient, &header->column[i], error))
    return lab_fail_in(error, "column %d", header->n);
  return LAB_OK;
}

static int has_control(const char *text)
{
  while (*text && !iscntrl((unsigned char)*text))
    text++;
  return *text != '\0';
}

/* A cell of the header line. */
static int add_cell(const lab_cell *cell, const lab_log_format *format, double ambient, lab_header *header,
                    lab_error *error)
{
  const char *text = lab_trim(cell->begin);
  char shown[LAB_QUOTE];
  if (strlen(text) >= LAB_COLUMN_TEXT || has_control(text))
    return lab_fail(error, LAB_DATA, "column %d: expected \"name [unit]\", found \"%s\"", header->n + 1,
                    lab_log_quote(text, shown));
  return add_column(text, format, ambient, header, error);
}

/* A first line that begins with a number is a row: the file has no header. */
static int begins_with_number(const lab_cell *cell, const lab_log_format *format)
{
  double value;
  return lab_number_read(cell->begin, cell->end, format->decimal, format->thousands, &value) == LAB_NUMBER_FINITE;
}

static int read_cells(lab_csv *csv, const lab_log_format *format, double ambient, lab_header *header, lab_error *error)
{
  int i;
  if (lab_csv_cut(csv, error))
    return error->status;
  if (begins_with_number(csv->cell, format))
    return lab_fail(error, LAB_DATA,
                    "expected a header \"name [unit], ...\", found numbers; for a file without a header "
                    "give log.columns in the rig file");
  for (i = 0; i < csv->n; i++) {
    if (i == LAB_COLUMN_MAX)
      return lab_fail(error, LAB_DATA, "expected at most %d columns", LAB_COLUMN_MAX);
    if (add_cell(&csv->cell[i], format, ambient, header, error))
      return error->status;
  }
  return LAB_OK;
}

static int read_line(lab_csv *csv, const lab_log_format *format, double ambient, lab_header *header, lab_error *error)
{
  int more;
  if (lab_csv_line(csv, &more, error))
    return error->status;
  if (!more)
    return lab_fail(error, LAB_DATA, "%s: expected a header \"name [unit], ...\", found the end of the file",
                    csv->path);
  return read_cells(csv, format, ambient, header, error) ? lab_csv_fail_in(csv, error) : LAB_OK;
}

static int skip_lines(lab_csv *csv, int n, lab_error *error)
{
  int more = 1;
  while (csv->line < n && more)
    if (lab_csv_line(csv, &more, error))
      return error->status;
  return more ? LAB_OK
              : lab_fail(error, LAB_DATA, "%s: expected more than the %d lines to skip, found %d", csv->path, n,
                         csv->line);
}

/* Columns as the rig file lists them, with the words of a long file. */
static int take_listed(const lab_log_format *format, double ambient, lab_header *header, lab_error *error)
{
  int i;
  for (i = 0; i < format->n_columns; i++)
    if (add_column(format->column[i], format, ambient, header, error))
      return lab_fail_in(error, "log.columns");
  for (i = 0; i < format->n_quantities; i++)
    if (read_column(format->quantity[i].column, format, ambient, &header->quantity[i], error))
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
  int n = lab_header_count(header, format, LAB_CHANNEL_TIME);
  if (!n && !(format->time_step > 0))
    return lab_fail(error, LAB_DATA, "expected a column t, such as \"t [s]\", found none");
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

int lab_header_read(lab_csv *csv, const lab_log_format *format, double ambient, lab_header *header, lab_error *error)
{
  header->n = 0;
  memset(header->quantity, 0, sizeof header->quantity);
  if (skip_lines(csv, format->skip_lines, error) || take_listed(format, ambient, header, error))
    return error->status;
  csv->mark = format->delimiter;
  csv->comment = format->comment;
  if (header->n == 0 && read_line(csv, format, ambient, header, error))
    return error->status;
  if (check_channels(header, format, error) || check_time(header, format, error) || check_long(header, format, error))
    return lab_csv_fail_in(csv, error);
  return LAB_OK;
}
