#include "log.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "logread.h"
#include "../base/number.h"

/* A command may be a measured one that overshoots a little, and is 1; beyond this it is in other units. */
static const double command_max = 1.05;
static const double set_point_max = 2; /* a set position may lie beyond the stops */

struct reader {
  lab_csv csv;
  lab_log_format *format;
  lab_header header;
  lab_log *log;
  size_t rows;     /* of data seen, taken or not: the clock of a file without t */
  double last_t;   /* [s] of the last row taken */
  int repeats;     /* whether a row has the time of the row before */
  double value;    /* long format: number of the row being read */
  int quantity;    /* long format: its row in format->quantity */
  lab_stamp stamp; /* of the row, where the file has dates */
  lab_stamp first; /* of the first row: its time is 0 */
  lab_error *error;
};

/* ---- Fields and rows ---- */

/* Long format: which quantity is this? */
static int read_word(struct reader *r, const char *word)
{
  char shown[LAB_QUOTE];
  int i;
  for (i = 0; i < r->format->n_quantities; i++)
    if (strcmp(r->format->quantity[i].word, word) == 0) {
      r->quantity = i;
      return LAB_OK;
    }
  return lab_fail(r->error, LAB_DATA, "unknown quantity \"%s\"; it is not in log.quantities",
                  lab_log_quote(word, shown));
}

/* Where columns have weights, those of one channel are added up; its offset counts once. */
static void put_number(struct reader *r, int i, const lab_column *column, double number)
{
  double *at = &r->log->value[column->channel][r->log->n];
  int before = 0, j;
  if (!r->format->weighted) {
    *at = column->scale * number + column->offset;
    return;
  }
  for (j = 0; j < i; j++)
    before |= r->header.column[j].channel == column->channel;
  *at = r->format->weight[i] * column->scale * number + (before ? *at : column->offset);
}

static int is_empty(const lab_cell *cell)
{
  return cell->begin[strspn(cell->begin, " \t")] == '\0';
}

static int read_stamp(struct reader *r, int i)
{
  const lab_cell *cell = &r->csv.cell[i];
  char shown[LAB_QUOTE];
  if (is_empty(cell) || lab_stamp_read(cell->begin, cell->end, r->format->date, &r->stamp))
    return LAB_OK;
  return lab_fail(r->error, LAB_DATA,
                  "column %d \"%s\": expected a date or time as in the first row (%s), found \"%s\"; if the day comes "
                  "first, write into the rig file: log = { date = \"dmy\"; };",
                  i + 1, r->header.text[i], r->format->date ? lab_date_orders[r->format->date] : "time of day",
                  lab_log_quote(cell->begin, shown));
}

/* What may be done about a cell that is no number. */
static const char *number_advice(const struct reader *r, const char *text)
{
  const int comma = strchr(text, ',') != NULL, point = strchr(text, '.') != NULL, decimal = r->format->decimal;
  if (!strpbrk(text, "0123456789") || r->format->thousands)
    return LAB_LEAVE_OUT;
  if (comma && point)
    return decimal == ',' ? "; if points part thousands, write into the rig file: log = { thousands = \".\"; };"
                          : "; if commas part thousands, write into the rig file: log = { thousands = \",\"; };";
  if (comma && decimal == '.')
    return "; if commas are decimal ones, write into the rig file: log = { decimal = \",\"; };";
  return LAB_LEAVE_OUT;
}

static int read_field(struct reader *r, int i)
{
  const lab_column *column = &r->header.column[i];
  const lab_cell *cell = &r->csv.cell[i];
  char shown[LAB_QUOTE];
  double number;
  if (column->channel == LAB_COLUMN_IGNORED)
    return LAB_OK;
  if (column->is_stamp)
    return read_stamp(r, i);
  if (column->channel == LAB_COLUMN_QUANTITY)
    return read_word(r, cell->begin);
  if (lab_number_read(cell->begin, cell->end, r->format->decimal, r->format->thousands, &number) == LAB_NUMBER_BAD)
    return lab_fail(r->error, LAB_DATA, "column %d \"%s\": expected a number, found \"%s\"%s", i + 1, r->header.text[i],
                    lab_log_quote(cell->begin, shown), number_advice(r, cell->begin));
  if (column->channel == LAB_COLUMN_VALUE)
    r->value = number;
  else
    put_number(r, i, column, number);
  return LAB_OK;
}

/* [s] since the first row. A time of day without a date that falls by half a day or more is that of the next day. */
static double stamp_time(struct reader *r)
{
  const double day = 86400, step = 1e-9; /* [s] */
  if (!r->stamp.has_day && !r->stamp.has_time)
    return NAN;
  if (!r->first.has_day && !r->first.has_time)
    r->first = r->stamp;
  if (!r->stamp.has_day) {
    r->stamp.day = (long)floor(r->last_t / day);
    while ((double)(r->stamp.day - r->first.day) * day + r->stamp.second - r->first.second < r->last_t - day / 2)
      r->stamp.day++;
  }
  return round(((double)(r->stamp.day - r->first.day) * day + r->stamp.second - r->first.second) / step) * step;
}

static void put_stamp(struct reader *r)
{
  int i;
  for (i = 0; i < r->header.n; i++)
    if (r->header.column[i].is_stamp && r->header.column[i].channel == LAB_CHANNEL_TIME)
      put_number(r, i, &r->header.column[i], stamp_time(r));
}

static int read_row(struct reader *r)
{
  int i;
  if (lab_csv_cut(&r->csv, r->error))
    return r->error->status;
  if (r->header.has_stamps)
    r->stamp = (lab_stamp){0};
  for (i = 0; i < r->header.n && i < r->csv.n; i++)
    if (read_field(r, i))
      return r->error->status;
  if (r->csv.n != r->header.n)
    return lab_fail(r->error, LAB_DATA, "expected %d fields, found %d" LAB_LEAVE_OUT, r->header.n, r->csv.n);
  if (r->header.has_stamps)
    put_stamp(r);
  return LAB_OK;
}

/* Put constants, or gaps, where the row may bring nothing. */
static void clear_row(struct reader *r)
{
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    if (r->log->value[i])
      r->log->value[i][r->log->n] = r->format->constant[i];
  if (r->format->time_step > 0)
    r->log->value[LAB_CHANNEL_TIME][r->log->n] = (double)r->rows * r->format->time_step;
}

/* Long format: the number goes to the channel of its quantity.  Returns: 0 if that is to be ignored. */
static int place_value(struct reader *r)
{
  const lab_column *column = &r->header.quantity[r->quantity];
  if (r->format->n_quantities == 0)
    return 1;
  if (column->channel < 0)
    return 0;
  r->log->value[column->channel][r->log->n] = column->scale * r->value + column->offset;
  return 1;
}

/* ---- What a row must satisfy ---- */

static int check_command(struct reader *r)
{
  const int command = lab_log_command(r->log);
  double now;
  if (command < 0 || r->format->n_quantities)
    return LAB_OK;
  now = r->log->value[command][r->log->n];
  if (isnan(now))
    return lab_fail(r->error, LAB_DATA, "channel %s: expected a number, found a gap; %s holds until the next row%s",
                    lab_channels[command].key, lab_channels[command].key, LAB_LEAVE_OUT);
  if (command == LAB_CHANNEL_SP && fabs(now) > set_point_max)
    return lab_fail(r->error, LAB_DATA, "channel sp: expected a share of the stroke, found %g; is its unit %%?", now);
  if (command == LAB_CHANNEL_U && !r->format->command_is_pressure && fabs(now) > command_max)
    return lab_fail(
        r->error, LAB_DATA,
        "channel u: expected -1..1, found %g; is its unit %%, or a pressure (transducer.proportional_band)?", now);
  return LAB_OK;
}

/* Time must grow within a run, which begins at the first row, or where the format says. Rows of one time may be those
 * of a clock that goes in steps, unless the format asks for damaged rows to be left out. */
static int check_time(struct reader *r, double t)
{
  if (isnan(t))
    return lab_fail(r->error, LAB_DATA, "channel t: expected a number, found a gap");
  if (r->log->n == 0 || (r->format->new_run == LAB_RUN_T_DROPS && t < r->last_t)) {
    r->log->run[r->log->n_runs++] = r->log->n;
    return LAB_OK;
  }
  if (t > r->last_t || r->format->n_quantities > 0)
    return LAB_OK;
  if (t < r->last_t || r->format->damaged == LAB_DAMAGED_DROP)
    return lab_fail(r->error, LAB_DATA, LAB_EXPECTED_LATER, r->last_t, t,
                    t < r->last_t ? "; if a run begins here: log.new_run = \"t drops\"" : "", LAB_LEAVE_OUT);
  r->repeats = 1;
  return LAB_OK;
}

/* Take the row just read into the log, unless it is outside the window. */
static int take_row(struct reader *r)
{
  double t = r->log->value[LAB_CHANNEL_TIME][r->log->n];
  if (t < r->format->from || t > r->format->to) {
    r->log->outside++;
    return LAB_OK;
  }
  if (check_command(r) || check_time(r, t))
    return r->error->status;
  r->last_t = t;
  r->log->line[r->log->n++] = r->csv.line;
  return LAB_OK;
}

/* ---- The whole file ---- */

static int read_rows(struct reader *r)
{
  int more, status;
  while ((status = lab_csv_line(&r->csv, &more, r->error)) == LAB_OK && more && !lab_csv_is_over(&r->csv)) {
    clear_row(r);
    r->rows++;
    if (read_row(r) || (place_value(r) && take_row(r))) {
      if (r->error->status != LAB_DATA || r->format->damaged != LAB_DAMAGED_DROP)
        return lab_csv_fail_in(&r->csv, r->error);
      r->log->dropped++;
    }
  }
  return status;
}

static int allocate(struct reader *r, size_t rows)
{
  lab_log *log = r->log;
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    int present = lab_header_count(&r->header, r->format, i) > 0 || !isnan(r->format->constant[i]);
    if (!present && i != LAB_CHANNEL_TIME)
      continue;
    log->value[i] = malloc(rows * sizeof *log->value[i]);
    if (!log->value[i])
      return lab_fail_memory(r->error, log->path);
  }
  log->line = malloc(rows * sizeof *log->line);
  log->run = malloc((rows + 1) * sizeof *log->run); /* a run has a row at least */
  return log->line && log->run ? LAB_OK : lab_fail_memory(r->error, log->path);
}

/* An opening is open at most. */
static void clip_command(lab_log *log, const lab_log_format *format)
{
  double *u = format->command_is_pressure ? NULL : log->value[LAB_CHANNEL_U];
  size_t i;
  for (i = 0; u && i < log->n; i++)
    u[i] = u[i] > 1 ? 1 : u[i] < -1 ? -1 : u[i];
}

static int finish(struct reader *r)
{
  lab_log *log = r->log;
  if (log->n == 0)
    return lab_fail(
        r->error, LAB_DATA,
        "%s: expected rows of data, found none behind the header (%zu left out as damaged, %zu outside log.window)",
        log->path, log->dropped, log->outside);
  if (r->format->n_quantities && lab_log_join(log, r->error))
    return r->error->status;
  log->run[log->n_runs] = log->n;
  if (r->repeats && lab_log_part_repeats(log, r->error))
    return r->error->status;
  clip_command(log, r->format);
  return lab_log_shape(log, r->format, r->error);
}

static int read_file(struct reader *r, const char *path)
{
  r->log->path = strdup(path);
  if (!r->log->path)
    return lab_fail_memory(r->error, path);
  if (lab_csv_open(&r->csv, path, r->error) ||
      lab_header_read(&r->csv, r->format, &r->header, r->log->read_as, r->error) || allocate(r, lab_csv_lines(&r->csv)))
    return r->error->status;
  if (read_rows(r))
    return r->error->status;
  return finish(r);
}

/* Channels that the file's name tells become constants. */
static int take_name(const char *path, lab_log_format *format, lab_error *error)
{
  const char *file = lab_file_name(path);
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    char mark[LAB_COLUMN_TEXT], *end = NULL;
    const char *at;
    double scale, offset, number;
    if (!*format->name[c])
      continue;
    if (lab_column_mark(format->name[c], lab_channel_unit(c, format->command_is_pressure), mark, &scale, &offset,
                        error))
      return error->status;
    at = strstr(file, mark);
    number = at ? strtod(at + strlen(mark), &end) : 0;
    if (!at || end == at + strlen(mark))
      return lab_fail(error, LAB_DATA, "%s: expected \"%s\" and a number in the file's name (log.name.%s)", path, mark,
                      lab_channels[c].key);
    format->constant[c] = format->scale[c] * (scale * number + offset) + format->offset[c];
  }
  return LAB_OK;
}

int lab_log_read(const char *path, const lab_log_format *format, double ambient, lab_log *log, lab_error *error)
{
  lab_log_format own = *format;
  struct reader r = {.format = &own, .log = log, .error = error};
  int status;
  own.ambient = ambient;
  memset(log, 0, sizeof *log);
  status = take_name(path, &own, error);
  if (status == LAB_OK)
    status = read_file(&r, path);
  lab_csv_close(&r.csv);
  if (status != LAB_OK)
    lab_log_free(log);
  return status;
}

void lab_log_free(lab_log *log)
{
  int i;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    free(log->value[i]);
    free(log->bend[i]);
  }
  free(log->path);
  free(log->line);
  free(log->run);
  memset(log, 0, sizeof *log);
}

int lab_log_command(const lab_log *log)
{
  return log->value[LAB_CHANNEL_U] ? LAB_CHANNEL_U : log->value[LAB_CHANNEL_SP] ? LAB_CHANNEL_SP : -1;
}

int lab_log_command_changes(const lab_log *log, size_t first, size_t last)
{
  const int command = lab_log_command(log);
  const double *u = command < 0 ? NULL : log->value[command];
  size_t i;
  for (i = first; u && i < last; i++)
    if (u[i + 1] != u[i])
      return 1;
  return 0;
}

void lab_log_copy_row(lab_log *log, size_t from, size_t to)
{
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (log->value[c])
      log->value[c][to] = log->value[c][from];
  log->line[to] = log->line[from];
}
