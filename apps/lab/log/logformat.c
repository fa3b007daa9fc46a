#include "logformat.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/config.h"
#include "../base/names.h"
#include "../base/units.h"

/* Above every value that a log can have, and an exact integer with those after it. */
static const double lead_code = 1e15;

static const char *const new_run_words[] = {"never", "t drops"};
static const char *const runs_words[] = {"each", "mean"};
static const char *const damaged_words[] = {"error", "drop"};
static const struct mark {
  const char *name;
  char mark;
} marks[] = {{"tab", '\t'}, {"comma", ','}, {"semicolon", ';'}, {"blanks", LAB_CSV_BLANKS}};

enum { MARKS = sizeof marks / sizeof marks[0], SKIP_MAX = 1000000 };

void lab_log_format_default(lab_log_format *format)
{
  int i;
  memset(format, 0, sizeof *format);
  format->skip_lines = -1;
  format->comment = '#';
  format->way_back = -1;
  format->every = 1;
  format->holdout_first = -1;
  format->holdout_from = format->holdout_to = (double)NAN;
  format->from = -INFINITY;
  format->to = INFINITY;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    format->scale[i] = 1;
    format->signal[i].low = format->signal[i].high = NAN;
    format->constant[i] = NAN;
  }
}

/* ---- One reader a key ---- */

/* One character, or its name. */
static int read_mark(const config_setting_t *setting, char *mark, lab_error *error)
{
  const char *text = config_setting_get_string(setting);
  int named = text ? lab_name_index(text, marks, MARKS, sizeof marks[0]) : -1;
  if (!text || (named < 0 && strlen(text) != 1))
    return lab_config_expected(setting, "one character, \"tab\", \"comma\", \"semicolon\" or \"blanks\"", error);
  if (named < 0)
    *mark = *text;
  else
    *mark = marks[named].mark;
  return LAB_OK;
}

static int read_decimal(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  if (read_mark(setting, &format->decimal, error))
    return error->status;
  if (format->decimal != '.' && format->decimal != ',')
    return lab_config_expected(setting, "\".\" or \",\"", error);
  return LAB_OK;
}

static int read_columns(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_list(setting, 1, LAB_COLUMN_MAX, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(setting); i++)
    status = lab_config_text(config_setting_get_elem(setting, (unsigned)i), format->column[i], LAB_COLUMN_TEXT, error);
  if (status == LAB_OK)
    format->n_columns = config_setting_length(setting);
  return status;
}

static int read_time_step(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  return lab_config_quantity(setting, "s", 1e-9, 1e9, &format->time_step, error);
}

static int read_window(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  if (lab_config_list(setting, 2, 2, error) ||
      lab_config_quantity(config_setting_get_elem(setting, 0), "s", -INFINITY, INFINITY, &format->from, error) ||
      lab_config_quantity(config_setting_get_elem(setting, 1), "s", -INFINITY, INFINITY, &format->to, error))
    return error->status;
  if (format->from >= format->to)
    return lab_config_fail(setting, error, "expected a window (from, to), found one from %g s to %g s", format->from,
                           format->to);
  return LAB_OK;
}

/* A text a channel. */
static int read_texts(const config_setting_t *group, char text[LAB_CHANNEL_COUNT][LAB_COLUMN_TEXT], lab_error *error)
{
  int i, status = lab_config_is_group(group, error);
  if (status == LAB_OK)
    status = lab_config_known(group, lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    const int c = lab_name_index(config_setting_name(member), lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]);
    status = lab_config_text(member, text[c], LAB_COLUMN_TEXT, error);
    if (status == LAB_OK && !*text[c])
      status = lab_config_expected(member, "a text", error);
  }
  return status;
}

static int read_map(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  return read_texts(group, format->map, error);
}

/* Channels that the file's name tells. */
static int read_name(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  char mark[LAB_COLUMN_TEXT];
  double scale, offset;
  int c;
  if (read_texts(group, format->name, error))
    return error->status;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (*format->name[c] && lab_column_mark(format->name[c], lab_channel_unit(c, format->command_is_pressure), mark,
                                            &scale, &offset, error))
      return lab_config_fail_in(config_setting_get_member((config_setting_t *)group, lab_channels[c].key), error);
  return LAB_OK;
}

static int read_weights(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_list(setting, 1, LAB_COLUMN_MAX, error);
  for (i = 0; i < LAB_COLUMN_MAX; i++)
    format->weight[i] = 1;
  for (i = 0; status == LAB_OK && i < config_setting_length(setting); i++)
    status = lab_config_quantity(config_setting_get_elem(setting, (unsigned)i), "1", -INFINITY, INFINITY,
                                 &format->weight[i], error);
  format->weighted = status == LAB_OK ? config_setting_length(setting) : 0;
  return status;
}

/* A number a channel, such as `scale` or `constants`, by `read`. */
static int read_channels(const config_setting_t *group, const lab_log_format *format, double *value,
                         int (*read)(const config_setting_t *, const char *, double *, lab_error *), lab_error *error)
{
  int i, status = lab_config_is_group(group, error);
  if (status == LAB_OK)
    status = lab_config_known(group, lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    int channel = lab_name_index(config_setting_name(member), lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]);
    status = read(member, lab_channel_unit(channel, format->command_is_pressure), &value[channel], error);
  }
  return status;
}

static int read_one_scale(const config_setting_t *setting, const char *unit, double *value, lab_error *error)
{
  (void)unit;
  if (lab_config_quantity(setting, "1", -INFINITY, INFINITY, value, error))
    return error->status;
  return *value != 0 ? LAB_OK : lab_config_expected(setting, "a number other than 0", error);
}

static int read_one_constant(const config_setting_t *setting, const char *unit, double *value, lab_error *error)
{
  return lab_config_quantity(setting, unit, -INFINITY, INFINITY, value, error);
}

/* "4..20 mA", or "0..27648" of counts. */
static int read_signal(const config_setting_t *setting, const char *text, lab_signal *signal, lab_error *error)
{
  static const char *const expected = "two numbers and a unit, such as \"4..20 mA\"";
  char first[32], *end;
  const char *dots = strstr(text, "..");
  double scale, offset;
  snprintf(first, sizeof first, "%.*s", (int)(dots - text), text);
  signal->from = strtod(first, &end);
  if (end == first || *end)
    return lab_config_expected(setting, expected, error);
  signal->to = strtod(dots + 2, &end);
  while (*end == ' ')
    end++;
  if (end == dots + 2 || !(fabs(signal->to) < 1e15 && fabs(signal->from) < 1e15) || signal->from == signal->to ||
      strlen(end) >= sizeof signal->unit)
    return lab_config_expected(setting, expected, error);
  snprintf(signal->unit, sizeof signal->unit, "%s", *end ? end : "1");
  if (lab_unit_factor(signal->unit, signal->unit[0] == '1' ? "1" : "A", &scale, &offset, error) != LAB_OK &&
      lab_unit_factor(signal->unit, "V", &scale, &offset, error) != LAB_OK)
    return lab_config_expected(setting, "a signal in mA, V or counts", error);
  return LAB_OK;
}

/* Numbers and signals. */
static int read_scale(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_is_group(group, error);
  if (status == LAB_OK)
    status = lab_config_known(group, lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    const int c = lab_name_index(config_setting_name(member), lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]);
    const char *text = config_setting_get_string(member);
    status = text && strstr(text, "..") ? read_signal(member, text, &format->signal[c], error)
                                        : read_one_scale(member, "1", &format->scale[c], error);
  }
  return status;
}

/* What the ends of a signal stand for. */
static int read_range(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_is_group(group, error);
  if (status == LAB_OK)
    status = lab_config_known(group, lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    const int c = lab_name_index(config_setting_name(member), lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]);
    const char *unit = lab_channel_unit(c, format->command_is_pressure);
    lab_signal *signal = &format->signal[c];
    status = lab_config_list(member, 2, 2, error);
    if (status == LAB_OK)
      status = lab_config_quantity(config_setting_get_elem(member, 0), unit, -1e15, 1e15, &signal->low, error);
    if (status == LAB_OK)
      status = lab_config_quantity(config_setting_get_elem(member, 1), unit, -1e15, 1e15, &signal->high, error);
    signal->low += 0.0; /* a zero without sign, as it is written */
    signal->high += 0.0;
    if (status == LAB_OK && signal->low == signal->high)
      status = lab_config_expected(member, "two values that differ", error);
  }
  return status;
}

static int read_offset(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  return read_channels(setting, format, format->offset, lab_config_difference, error);
}

static int read_constants(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  if (config_setting_is_group(setting) && config_setting_get_member((config_setting_t *)setting, "t"))
    return lab_config_fail(setting, error, "time cannot be constant; for a file without t give time_step");
  return read_channels(setting, format, format->constant, read_one_constant, error);
}

/* "first p", "last p", or a value with its unit.  Out: value  channel + 1 of the first two, as an infinite code */
static int read_lead_value(const config_setting_t *setting, const char *unit, double *value, lab_error *error)
{
  const char *text = config_setting_get_string(setting);
  const int last = text && strncmp(text, "last ", 5) == 0, first = text && strncmp(text, "first ", 6) == 0;
  int channel;
  if (!first && !last)
    return lab_config_quantity(setting, unit, -lead_code / 2, lead_code / 2, value, error);
  channel = lab_name_index(text + (first ? 6 : 5), lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]);
  if (channel < 0)
    return lab_config_expected(setting, "\"first\" or \"last\" with a channel, such as \"first p\"", error);
  *value = lead_code + (last ? LAB_CHANNEL_COUNT : 0) + channel;
  return LAB_OK;
}

/* Take codes of read_lead_value out of a row. */
static void decode_lead(lab_log_format *format, int row)
{
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const double code = format->lead[row][c] - lead_code;
    format->lead_first[row][c] = format->lead_last[row][c] = 0;
    if (!(code >= 0))
      continue;
    if (code < LAB_CHANNEL_COUNT)
      format->lead_first[row][c] = (int)code + 1;
    else
      format->lead_last[row][c] = (int)code - LAB_CHANNEL_COUNT + 1;
    format->lead[row][c] = NAN;
  }
}

/* One row of `lead`: a group of channels, with t. */
static int read_lead_row(const config_setting_t *setting, lab_log_format *format, int index, lab_error *error)
{
  double *row = format->lead[index];
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    row[c] = NAN;
  if (read_channels(setting, format, row, read_lead_value, error))
    return error->status;
  decode_lead(format, index);
  return isnan(row[LAB_CHANNEL_TIME]) ? lab_config_expected(setting, "a row with its time t", error) : LAB_OK;
}

static int read_lead(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_list(setting, 1, LAB_LEAD_MAX, error);
  for (i = 0; status == LAB_OK && i < config_setting_length(setting); i++) {
    const config_setting_t *row = config_setting_get_elem(setting, (unsigned)i);
    status = read_lead_row(row, format, i, error);
    if (status == LAB_OK && i > 0 && format->lead[i][LAB_CHANNEL_TIME] <= format->lead[i - 1][LAB_CHANNEL_TIME])
      status = lab_config_expected(row, "a time after that of the row before", error);
  }
  format->n_lead = status == LAB_OK ? config_setting_length(setting) : 0;
  return status;
}

static int read_quantities(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_is_group(setting, error);
  if (status == LAB_OK && config_setting_length(setting) > LAB_QUANTITY_MAX)
    return lab_config_fail(setting, error, "expected at most %d quantities", LAB_QUANTITY_MAX);
  for (i = 0; status == LAB_OK && i < config_setting_length(setting); i++) {
    const config_setting_t *member = config_setting_get_elem(setting, (unsigned)i);
    lab_long_quantity *quantity = &format->quantity[i];
    if (strlen(config_setting_name(member)) >= sizeof quantity->word)
      return lab_config_fail(member, error, "expected a word of less than %zu bytes", sizeof quantity->word);
    strcpy(quantity->word, config_setting_name(member));
    status = lab_config_text(member, quantity->column, sizeof quantity->column, error);
  }
  if (status == LAB_OK)
    format->n_quantities = config_setting_length(setting);
  return status;
}

/* ---- What differs where a log is held out ---- */

static int read_holdout(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  static const char *const keys[] = {"window", "first"};
  const config_setting_t *window, *first;
  lab_log_format out = *format;
  if (lab_config_is_group(group, error) || lab_config_known(group, keys, 2, sizeof keys[0], error))
    return error->status;
  window = config_setting_get_member((config_setting_t *)group, "window");
  first = config_setting_get_member((config_setting_t *)group, "first");
  if ((window && read_window(window, &out, error)) ||
      (first && lab_config_count(first, 0, SKIP_MAX, &out.first, error)))
    return error->status;
  format->holdout_from = window ? out.from : (double)NAN;
  format->holdout_to = window ? out.to : (double)NAN;
  format->holdout_first = first ? out.first : -1;
  return LAB_OK;
}

void lab_log_format_hold_out(lab_log_format *format)
{
  if (!isnan(format->holdout_from)) {
    format->from = format->holdout_from;
    format->to = format->holdout_to;
  }
  if (format->holdout_first >= 0)
    format->first = format->holdout_first;
}

/* ---- All keys ---- */

enum kind { MARK, COUNT, CHOICE, OWN };

#define MEMBER(name) .member = offsetof(lab_log_format, name)
#define WORDS(table) .words = table, .n = sizeof table / sizeof table[0], .stride = sizeof table[0]

static const struct log_key {
  const char *name;
  enum kind kind;
  size_t member;     /* of the format: a char for MARK, an int for COUNT and CHOICE */
  int lower;         /* COUNT, to SKIP_MAX */
  const void *words; /* CHOICE (names.h) */
  size_t n, stride;
  int (*read)(const config_setting_t *, lab_log_format *, lab_error *); /* OWN */
} log_keys[] = {
    {.name = "delimiter", .kind = MARK, MEMBER(delimiter)},
    {.name = "decimal", .kind = OWN, .read = read_decimal},
    {.name = "thousands", .kind = MARK, MEMBER(thousands)},
    {.name = "comment", .kind = MARK, MEMBER(comment)},
    {.name = "skip_lines", .kind = COUNT, MEMBER(skip_lines)},
    {.name = "map", .kind = OWN, .read = read_map},
    {.name = "date", .kind = CHOICE, MEMBER(date), WORDS(lab_date_orders)},
    {.name = "columns", .kind = OWN, .read = read_columns},
    {.name = "time_step", .kind = OWN, .read = read_time_step},
    {.name = "window", .kind = OWN, .read = read_window},
    {.name = "new_run", .kind = CHOICE, MEMBER(new_run), WORDS(new_run_words)},
    {.name = "damaged", .kind = CHOICE, MEMBER(damaged), WORDS(damaged_words)},
    {.name = "scale", .kind = OWN, .read = read_scale},
    {.name = "range", .kind = OWN, .read = read_range},
    {.name = "offset", .kind = OWN, .read = read_offset},
    {.name = "constants", .kind = OWN, .read = read_constants},
    {.name = "quantities", .kind = OWN, .read = read_quantities},
    {.name = "weights", .kind = OWN, .read = read_weights},
    {.name = "first", .kind = COUNT, MEMBER(first)},
    {.name = "name", .kind = OWN, .read = read_name},
    {.name = "holdout", .kind = OWN, .read = read_holdout},
    {.name = "every", .kind = COUNT, MEMBER(every), .lower = 1},
    {.name = "way_back", .kind = CHOICE, MEMBER(way_back), WORDS(lab_channels)},
    {.name = "runs", .kind = CHOICE, MEMBER(runs), WORDS(runs_words)},
    {.name = "lead", .kind = OWN, .read = read_lead},
};
enum { LOG_KEYS = sizeof log_keys / sizeof log_keys[0] };

static int read_key(const config_setting_t *setting, const struct log_key *key, lab_log_format *format,
                    lab_error *error)
{
  void *const member = (char *)format + key->member;
  switch (key->kind) {
  case MARK:
    return read_mark(setting, member, error);
  case COUNT:
    return lab_config_count(setting, key->lower, SKIP_MAX, member, error);
  case CHOICE:
    return lab_config_choice(setting, key->words, key->n, key->stride, member, error);
  default:
    return key->read(setting, format, error);
  }
}

/* ---- Checks over keys ---- */

/* Column texts must be readable now, not at the first log. */
static int check_columns(const config_setting_t *group, const lab_log_format *format, lab_error *error)
{
  const lab_column_frame frame = {0, format->stroke, format->command_is_pressure, format->signal};
  lab_column column;
  int i;
  for (i = 0; i < format->n_columns; i++)
    if (lab_column_read(format->column[i], &frame, &column, error))
      return lab_config_fail_in(config_setting_get_member((config_setting_t *)group, "columns"), error);
  for (i = 0; i < format->n_quantities; i++)
    if (lab_column_read(format->quantity[i].column, &frame, &column, error))
      return lab_config_fail_in(config_setting_get_member((config_setting_t *)group, "quantities"), error);
  return LAB_OK;
}

static int check_format(const config_setting_t *group, const lab_log_format *format, lab_error *error)
{
  int i;
  if (format->delimiter && format->delimiter == format->decimal)
    return lab_config_fail(group, error, "delimiter and decimal are both \"%c\": give one of them", format->decimal);
  if (format->delimiter && format->delimiter == format->thousands)
    return lab_config_fail(group, error, "delimiter and thousands are both \"%c\"", format->delimiter);
  if (format->n_quantities && (format->new_run != LAB_RUN_NEVER || format->time_step > 0))
    return lab_config_fail(group, error, "quantities (long format) go with neither new_run nor time_step");
  if (format->weighted && format->weighted != format->n_columns)
    return lab_config_fail(group, error, "expected a weight for each of the %d columns, found %d", format->n_columns,
                           format->weighted);
  if (format->way_back >= 0 && !(format->time_step > 0))
    return lab_config_fail(group, error, "way_back needs time_step: rows that are reversed have no time of their own");
  if (format->runs == LAB_RUNS_MEAN && format->new_run == LAB_RUN_NEVER)
    return lab_config_fail(group, error, "runs = \"mean\" needs new_run, which says where a run begins");
  for (i = 0; i < LAB_CHANNEL_COUNT; i++)
    if ((format->signal[i].from != format->signal[i].to) == isnan(format->signal[i].low))
      return lab_config_fail(group, error,
                             "channel %s: scale = \"4..20 mA\" and range = [\"0 bar\", \"6 bar\"] go together",
                             lab_channels[i].key);
  for (i = 0; i < LAB_CHANNEL_COUNT && format->n_columns; i++)
    if (*format->map[i])
      return lab_config_fail(group, error, "map names columns of a header, columns says that there is none: give one");
  return check_columns(group, format, error);
}

int lab_log_format_read(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_is_group(group, error);
  if (status == LAB_OK)
    status = lab_config_known(group, log_keys, LOG_KEYS, sizeof log_keys[0], error);
  for (i = 0; status == LAB_OK && i < LOG_KEYS; i++) {
    const config_setting_t *member = config_setting_get_member((config_setting_t *)group, log_keys[i].name);
    if (member)
      status = read_key(member, &log_keys[i], format, error);
  }
  return status == LAB_OK ? check_format(group, format, error) : status;
}
