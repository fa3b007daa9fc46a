#include "logheader.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "../base/number.h"

const char *lab_log_show(const char *begin, const char *end, char text[LAB_SHOWN])
{
  size_t n = 0;
  for (; begin < end && n < LAB_SHOWN - 4; begin++)
    text[n++] = (char)(isprint((unsigned char)*begin) ? *begin : '?');
  strcpy(text + n, begin < end ? "..." : "");
  return text;
}

int lab_log_fail_in(const lab_log_source *source, lab_error *error)
{
  return lab_fail_in(error, "%s:%d", source->path, source->lines.number);
}

int lab_log_line(lab_log_source *source, const char **begin, const char **end, int *found, lab_error *error)
{
  char comment = source->format->comment;
  do {
    *found = lab_lines_next(&source->lines, begin, end);
    if (*found && *end - *begin > LAB_LINE_MAX) {
      lab_fail(error, LAB_DATA, "expected a line of at most %d bytes, found %ld: this is not a log", LAB_LINE_MAX,
               (long)(*end - *begin));
      return lab_log_fail_in(source, error);
    }
  } while (*found && comment && *end > *begin && **begin == comment);
  return LAB_OK;
}

const char *lab_log_field(const lab_log_source *source, const char *begin, const char *end)
{
  const char *stop = memchr(begin, source->format->delimiter, (size_t)(end - begin));
  return stop ? stop : end;
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

static int has_control(const char *begin, const char *end)
{
  while (begin < end && !iscntrl((unsigned char)*begin))
    begin++;
  return begin < end;
}

/* One field of the header line, without the quotes and blanks around it. */
static int add_field(const char *begin, const char *end, const lab_log_format *format, double ambient,
                     lab_header *header, lab_error *error)
{
  char text[LAB_COLUMN_TEXT], shown[LAB_SHOWN];
  while (begin < end && (isspace((unsigned char)*begin) || *begin == '"'))
    begin++;
  while (begin < end && (isspace((unsigned char)end[-1]) || end[-1] == '"'))
    end--;
  if (header->n == LAB_COLUMN_MAX)
    return lab_fail(error, LAB_DATA, "expected at most %d columns", LAB_COLUMN_MAX);
  if (end - begin >= LAB_COLUMN_TEXT || has_control(begin, end))
    return lab_fail(error, LAB_DATA, "column %d: expected \"name [unit]\", found \"%s\"", header->n + 1,
                    lab_log_show(begin, end, shown));
  memcpy(text, begin, (size_t)(end - begin));
  text[end - begin] = '\0';
  return add_column(text, format, ambient, header, error);
}

static int split_header(const lab_log_source *source, const char *begin, const char *end, double ambient,
                        lab_header *header, lab_error *error)
{
  for (;;) {
    const char *stop = lab_log_field(source, begin, end);
    if (add_field(begin, stop, source->format, ambient, header, error))
      return lab_log_fail_in(source, error);
    if (stop == end)
      return LAB_OK;
    begin = stop + 1;
  }
}

/* A first line that begins with a number is a row: the file has no header. */
static int begins_with_number(const lab_log_source *source, const char *begin, const char *end)
{
  double value;
  return lab_number_read(begin, lab_log_field(source, begin, end), source->format->decimal, source->format->thousands,
                         &value) == LAB_NUMBER_FINITE;
}

static int read_line(lab_log_source *source, double ambient, lab_header *header, lab_error *error)
{
  const char *begin, *end;
  int found;
  if (lab_log_line(source, &begin, &end, &found, error))
    return error->status;
  if (!found)
    return lab_fail(error, LAB_DATA, "%s: expected a header \"name [unit], ...\", found the end of the file",
                    source->path);
  if (begins_with_number(source, begin, end)) {
    lab_fail(error, LAB_DATA,
             "expected a header \"name [unit], ...\", found numbers; for a file without a header "
             "give log.columns in the rig file");
    return lab_log_fail_in(source, error);
  }
  return split_header(source, begin, end, ambient, header, error);
}

static int skip_lines(lab_log_source *source, lab_error *error)
{
  const char *begin, *end;
  while (source->lines.number < source->format->skip_lines)
    if (!lab_lines_next(&source->lines, &begin, &end))
      return lab_fail(error, LAB_DATA, "%s: expected more than the %d lines to skip, found %d", source->path,
                      source->format->skip_lines, source->lines.number);
  return LAB_OK;
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

int lab_header_read(lab_log_source *source, double ambient, lab_header *header, lab_error *error)
{
  const lab_log_format *format = source->format;
  header->n = 0;
  memset(header->quantity, 0, sizeof header->quantity);
  if (skip_lines(source, error) || take_listed(format, ambient, header, error))
    return error->status;
  if (header->n == 0 && read_line(source, ambient, header, error))
    return error->status;
  if (check_channels(header, format, error) || check_time(header, format, error) || check_long(header, format, error))
    return lab_log_fail_in(source, error);
  return LAB_OK;
}
