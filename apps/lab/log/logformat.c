#include "logformat.h"

#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/config.h"
#include "../base/escape.h"
#include "../base/names.h"
#include "../base/number.h"
#include "../base/units.h"

static const double lead_most = 5e14; /* above every value that a log can have */

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

/* ---- What a key is ---- */

enum kind { MARK, COUNT, CHOICE, TEXTS, NUMBERS, OWN };

/* Of one channel in a group of channels. */
typedef int channel_reader(const config_setting_t *setting, int channel, lab_log_format *format, lab_error *error);

struct log_key {
  const char *name;  /* first member, for lab_name_index */
  enum kind kind;    /* how it is read and written, but for the functions below */
  size_t member;     /* of the format: a char for MARK, an int for COUNT and CHOICE, else one for each channel */
  int lower;         /* COUNT, to SKIP_MAX */
  const void *words; /* CHOICE (names.h) */
  size_t n, stride;
  int always;           /* CHOICE: written also where it is the default */
  channel_reader *each; /* of a group of channels */
  int (*read)(const config_setting_t *, lab_log_format *, lab_error *);
  void (*write)(FILE *, const lab_log_format *);
};

#define MEMBER(name) .member = offsetof(lab_log_format, name)
#define WORDS(table) .words = table, .n = sizeof table / sizeof table[0], .stride = sizeof table[0]

/* ---- Readers ---- */

/* Unit of a channel where its column does not give one. */
static const char *unit_of(const lab_log_format *format, int channel)
{
  return lab_channel_unit(channel, format->command_is_pressure);
}

static int read_channels(const config_setting_t *group, channel_reader *read, lab_log_format *format, lab_error *error)
{
  int i, status = lab_config_known(group, lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0], error);
  for (i = 0; status == LAB_OK && i < config_setting_length(group); i++) {
    const config_setting_t *member = config_setting_get_elem(group, (unsigned)i);
    const char *name = config_setting_name(member);
    status = read(member, lab_name_index(name, lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]), format, error);
  }
  return status;
}

/* One character, or its name. */
static int read_mark(const config_setting_t *setting, char *mark, lab_error *error)
{
  const char *text = config_setting_get_string(setting);
  int named = text ? lab_name_index(text, marks, MARKS, sizeof marks[0]) : -1;
  if (!text || (named < 0 && strlen(text) != 1))
    return lab_config_expected(setting, "one character, \"tab\", \"comma\", \"semicolon\" or \"blanks\"", error);
  *mark = named < 0 ? *text : marks[named].mark;
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

/* One channel of a group: a text. */
static int read_text(const config_setting_t *setting, char text[LAB_COLUMN_TEXT], lab_error *error)
{
  if (lab_config_text(setting, text, LAB_COLUMN_TEXT, error))
    return error->status;
  return *text ? LAB_OK : lab_config_expected(setting, "a text", error);
}

static int read_map(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  return read_text(setting, format->map[c], error);
}

/* A channel that the file's name tells. */
static int read_name(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  char mark[LAB_COLUMN_TEXT];
  double scale, offset;
  if (read_text(setting, format->name[c], error))
    return error->status;
  return lab_column_mark(format->name[c], unit_of(format, c), mark, &scale, &offset, error)
             ? lab_config_fail_in(setting, error)
             : LAB_OK;
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

/* A number or a signal. */
static int read_scale(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  const char *text = config_setting_get_string(setting);
  if (text && strstr(text, ".."))
    return read_signal(setting, text, &format->signal[c], error);
  if (lab_config_quantity(setting, "1", -INFINITY, INFINITY, &format->scale[c], error))
    return error->status;
  return format->scale[c] != 0 ? LAB_OK : lab_config_expected(setting, "a number other than 0", error);
}

/* What the ends of a signal stand for. */
static int read_range(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  const char *unit = unit_of(format, c);
  lab_signal *signal = &format->signal[c];
  if (lab_config_list(setting, 2, 2, error) ||
      lab_config_quantity(config_setting_get_elem(setting, 0), unit, -1e15, 1e15, &signal->low, error) ||
      lab_config_quantity(config_setting_get_elem(setting, 1), unit, -1e15, 1e15, &signal->high, error))
    return error->status;
  signal->low += 0.0; /* a zero without sign, as it is written */
  signal->high += 0.0;
  return signal->low != signal->high ? LAB_OK : lab_config_expected(setting, "two values that differ", error);
}

static int read_offset(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  return lab_config_difference(setting, unit_of(format, c), &format->offset[c], error);
}

static int read_constant(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  if (c == LAB_CHANNEL_TIME)
    return lab_config_fail(config_setting_parent(setting), error,
                           "time cannot be constant; for a file without t give time_step");
  return lab_config_quantity(setting, unit_of(format, c), -INFINITY, INFINITY, &format->constant[c], error);
}

/* "first p", "last p", or a value with its unit, in the row of the lead that is being read. */
static int read_lead_value(const config_setting_t *setting, int c, lab_log_format *format, lab_error *error)
{
  const int row = format->n_lead;
  const char *text = config_setting_get_string(setting);
  const int last = text && strncmp(text, "last ", 5) == 0, first = text && strncmp(text, "first ", 6) == 0;
  int channel;
  if (!first && !last)
    return lab_config_quantity(setting, unit_of(format, c), -lead_most, lead_most, &format->lead[row][c], error);
  channel = lab_name_index(text + (first ? 6 : 5), lab_channels, LAB_CHANNEL_COUNT, sizeof lab_channels[0]);
  if (channel < 0)
    return lab_config_expected(setting, "\"first\" or \"last\" with a channel, such as \"first p\"", error);
  (first ? format->lead_first : format->lead_last)[row][c] = channel + 1;
  return LAB_OK;
}

/* Rows, each a group of channels with t. */
static int read_lead(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  int *i = &format->n_lead, c;
  if (lab_config_list(setting, 1, LAB_LEAD_MAX, error))
    return error->status;
  for (*i = 0; *i < config_setting_length(setting); ++*i) {
    const config_setting_t *row = config_setting_get_elem(setting, (unsigned)*i);
    const double *t = &format->lead[*i][LAB_CHANNEL_TIME];
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      format->lead[*i][c] = NAN;
    if (read_channels(row, read_lead_value, format, error))
      return error->status;
    if (isnan(*t))
      return lab_config_expected(row, "a row with its time t", error);
    if (*i > 0 && *t <= format->lead[*i - 1][LAB_CHANNEL_TIME])
      return lab_config_expected(row, "a time after that of the row before", error);
  }
  return LAB_OK;
}

/* One word and its column, a member of a group or a pair of a list: a word may have any bytes there. */
static int read_quantity(const config_setting_t *member, int is_pair, lab_long_quantity *quantity, lab_error *error)
{
  const config_setting_t *column = is_pair ? config_setting_get_elem(member, 1) : member;
  if (!is_pair && strlen(config_setting_name(member)) >= sizeof quantity->word)
    return lab_config_fail(member, error, "expected a word of less than %zu bytes", sizeof quantity->word);
  if (!is_pair)
    strcpy(quantity->word, config_setting_name(member));
  else if (lab_config_list(member, 2, 2, error) ||
           lab_config_text(config_setting_get_elem(member, 0), quantity->word, sizeof quantity->word, error))
    return error->status;
  return lab_config_text(column, quantity->column, sizeof quantity->column, error);
}

static int read_quantities(const config_setting_t *setting, lab_log_format *format, lab_error *error)
{
  const int is_list = config_setting_is_list(setting);
  int i, status = is_list ? LAB_OK : lab_config_is_group(setting, error);
  if (status == LAB_OK && config_setting_length(setting) > LAB_QUANTITY_MAX)
    return lab_config_fail(setting, error, "expected at most %d quantities", LAB_QUANTITY_MAX);
  for (i = 0; status == LAB_OK && i < config_setting_length(setting); i++)
    status = read_quantity(config_setting_get_elem(setting, (unsigned)i), is_list, &format->quantity[i], error);
  if (status == LAB_OK)
    format->n_quantities = config_setting_length(setting);
  return status;
}

/* ---- What differs where a log is held out ---- */

static int read_holdout(const config_setting_t *group, lab_log_format *format, lab_error *error)
{
  static const char *const keys[] = {"window", "first"};
  const config_setting_t *member[2];
  lab_log_format out = *format;
  if (lab_config_members(group, keys, 2, 0, member, error) || (member[0] && read_window(member[0], &out, error)) ||
      (member[1] && lab_config_count(member[1], 0, SKIP_MAX, &out.first, error)))
    return error->status;
  format->holdout_from = member[0] ? out.from : (double)NAN;
  format->holdout_to = member[0] ? out.to : (double)NAN;
  format->holdout_first = member[1] ? out.first : -1;
  return LAB_OK;
}

void lab_log_format_turn(lab_log_format *format, int channel, double whole)
{
  int i;
  format->scale[channel] *= -1;
  format->offset[channel] = whole - format->offset[channel];
  format->constant[channel] = whole - format->constant[channel];
  for (i = 0; i < format->n_lead; i++)
    format->lead[i][channel] = whole - format->lead[i][channel];
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

/* ---- Writers, of what is not left out ---- */

static void write_mark(FILE *file, const char *key, char mark)
{
  if (!mark)
    return;
  fprintf(file, "  %s = ", key);
  lab_put_config(file, mark == '\t' ? "tab" : mark == LAB_CSV_BLANKS ? "blanks" : (char[]){mark, '\0'});
  fputs(";\n", file);
}

static void write_columns(FILE *file, const lab_log_format *format)
{
  int i;
  for (i = 0; i < format->n_columns; i++) {
    fputs(i ? ", " : "  columns = ( ", file);
    lab_put_config(file, format->column[i]);
  }
  if (format->n_columns)
    fputs(" );\n", file);
}

static void write_time_step(FILE *file, const lab_log_format *format)
{
  char number[LAB_NUMBER_TEXT];
  if (format->time_step > 0)
    fprintf(file, "  time_step = \"%s s\";\n", lab_number_write(format->time_step, number));
}

/* A number a channel, those that are as usual left out. */
static void write_numbers(FILE *file, const char *key, const lab_log_format *format, const double *value,
                          const double *usual)
{
  char number[LAB_NUMBER_TEXT];
  int i, any = 0;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    if (value[i] == usual[i] || isnan(value[i]))
      continue;
    if (!any++)
      fprintf(file, "  %s = {", key);
    fprintf(file, " %s = \"%s %s\";", lab_channels[i].key, lab_number_write(value[i], number), unit_of(format, i));
  }
  if (any)
    fputs(" };\n", file);
}

/* Scales and signals. */
static void write_scale(FILE *file, const lab_log_format *format)
{
  char a[LAB_NUMBER_TEXT], b[LAB_NUMBER_TEXT];
  int i, any = 0;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    const lab_signal *s = &format->signal[i];
    const int is_signal = s->from != s->to;
    if (!is_signal && format->scale[i] == 1)
      continue;
    fputs(any++ ? "" : "  scale = {", file);
    if (is_signal)
      fprintf(file, " %s = \"%s..%s %s\";", lab_channels[i].key, lab_number_write(s->from, a),
              lab_number_write(s->to, b), s->unit);
    else
      fprintf(file, " %s = \"%s 1\";", lab_channels[i].key, lab_number_write(format->scale[i], a));
  }
  fputs(any ? " };\n" : "", file);
}

/* What the ends of signals stand for. */
static void write_range(FILE *file, const lab_log_format *format)
{
  char a[LAB_NUMBER_TEXT], b[LAB_NUMBER_TEXT];
  int i, any = 0;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    const lab_signal *s = &format->signal[i];
    if (s->from != s->to)
      fprintf(file, "%s %s = [\"%s %s\", \"%s %s\"];", any++ ? "" : "  range = {", lab_channels[i].key,
              lab_number_write(s->low, a), unit_of(format, i), lab_number_write(s->high, b), unit_of(format, i));
  }
  fputs(any ? " };\n" : "", file);
}

static void write_quantities(FILE *file, const lab_log_format *format)
{
  int i;
  for (i = 0; i < format->n_quantities; i++) {
    fputs(i ? ", (" : "  quantities = ( (", file);
    lab_put_config(file, format->quantity[i].word);
    fputs(", ", file);
    lab_put_config(file, format->quantity[i].column);
    fputs(")", file);
  }
  if (format->n_quantities)
    fputs(" );\n", file);
}

static void write_weights(FILE *file, const lab_log_format *format)
{
  char number[LAB_NUMBER_TEXT];
  int i;
  for (i = 0; i < format->weighted; i++) {
    const char *quote =
        fabs(format->weight[i]) < INT_MAX ? "" : "\""; /* libconfig takes it for an int without a point */
    fprintf(file, "%s%s%s%s%s", i ? ", " : "  weights = ( ", quote, lab_number_write(format->weight[i], number),
            *quote ? " 1" : "", quote);
  }
  if (format->weighted)
    fputs(" );\n", file);
}

static void put_window(FILE *file, double from, double to)
{
  char first[LAB_NUMBER_TEXT], last[LAB_NUMBER_TEXT];
  fprintf(file, " window = ( \"%s s\", \"%s s\" );", lab_number_write(from, first), lab_number_write(to, last));
}

static void write_window(FILE *file, const lab_log_format *format)
{
  if (!isfinite(format->from))
    return;
  fputc(' ', file);
  put_window(file, format->from, format->to);
  fputc('\n', file);
}

static void write_holdout(FILE *file, const lab_log_format *format)
{
  const int window = !isnan(format->holdout_from), first = format->holdout_first >= 0;
  if (window || first)
    fputs("  holdout = {", file);
  if (window)
    put_window(file, format->holdout_from, format->holdout_to);
  if (first)
    fprintf(file, " first = %d;", format->holdout_first);
  if (window || first)
    fputs(" };\n", file);
}

static void write_texts(FILE *file, const char *key, const char *text)
{
  int c, any = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++, text += LAB_COLUMN_TEXT)
    if (*text) {
      if (any++)
        fputc(';', file);
      else
        fprintf(file, "  %s = {", key);
      fprintf(file, " %s = ", lab_channels[c].key);
      lab_put_config(file, text);
    }
  if (any)
    fputs("; };\n", file);
}

static void write_lead(FILE *file, const lab_log_format *format)
{
  char number[LAB_NUMBER_TEXT];
  int i, c;
  for (i = 0; i < format->n_lead; i++) {
    fputs(i ? ", {" : "  lead = ( {", file);
    for (c = 0; c < LAB_CHANNEL_COUNT; c++)
      if (format->lead_first[i][c] || format->lead_last[i][c])
        fprintf(file, " %s = \"%s %s\";", lab_channels[c].key, format->lead_first[i][c] ? "first" : "last",
                lab_channels[format->lead_first[i][c] + format->lead_last[i][c] - 1].key);
      else if (!isnan(format->lead[i][c]))
        fprintf(file, " %s = \"%s %s\";", lab_channels[c].key, lab_number_write(format->lead[i][c], number),
                unit_of(format, c));
    fputs(" }", file);
  }
  if (format->n_lead)
    fputs(" );\n", file);
}

/* ---- All keys ---- */

/* In the order of reading and writing. */
static const struct log_key log_keys[] = {
    {.name = "delimiter", .kind = MARK, MEMBER(delimiter)},
    {.name = "decimal", .kind = MARK, MEMBER(decimal), .read = read_decimal},
    {.name = "thousands", .kind = MARK, MEMBER(thousands)},
    {.name = "comment", .kind = MARK, MEMBER(comment)},
    {.name = "skip_lines", .kind = COUNT, MEMBER(skip_lines)},
    {.name = "map", .kind = TEXTS, MEMBER(map), .each = read_map},
    {.name = "date", .kind = CHOICE, MEMBER(date), WORDS(lab_date_orders)},
    {.name = "columns", .kind = OWN, .read = read_columns, .write = write_columns},
    {.name = "time_step", .kind = OWN, .read = read_time_step, .write = write_time_step},
    {.name = "window", .kind = OWN, .read = read_window, .write = write_window},
    {.name = "new_run", .kind = CHOICE, MEMBER(new_run), WORDS(new_run_words), .always = 1},
    {.name = "damaged", .kind = CHOICE, MEMBER(damaged), WORDS(damaged_words), .always = 1},
    {.name = "scale", .kind = OWN, .each = read_scale, .write = write_scale},
    {.name = "range", .kind = OWN, .each = read_range, .write = write_range},
    {.name = "offset", .kind = NUMBERS, MEMBER(offset), .each = read_offset},
    {.name = "constants", .kind = NUMBERS, MEMBER(constant), .each = read_constant},
    {.name = "quantities", .kind = OWN, .read = read_quantities, .write = write_quantities},
    {.name = "every", .kind = COUNT, MEMBER(every), .lower = 1},
    {.name = "first", .kind = COUNT, MEMBER(first)},
    {.name = "holdout", .kind = OWN, .read = read_holdout, .write = write_holdout},
    {.name = "name", .kind = TEXTS, MEMBER(name), .each = read_name},
    {.name = "weights", .kind = OWN, .read = read_weights, .write = write_weights},
    {.name = "way_back", .kind = CHOICE, MEMBER(way_back), WORDS(lab_channels)},
    {.name = "runs", .kind = CHOICE, MEMBER(runs), WORDS(runs_words)},
    {.name = "lead", .kind = OWN, .read = read_lead, .write = write_lead},
};
enum { LOG_KEYS = sizeof log_keys / sizeof log_keys[0] };

static int read_key(const config_setting_t *setting, const struct log_key *key, lab_log_format *format,
                    lab_error *error)
{
  void *const member = (char *)format + key->member;
  if (key->read)
    return key->read(setting, format, error);
  if (key->each)
    return read_channels(setting, key->each, format, error);
  if (key->kind == MARK)
    return read_mark(setting, member, error);
  if (key->kind == COUNT)
    return lab_config_count(setting, key->lower, SKIP_MAX, member, error);
  return lab_config_choice(setting, key->words, key->n, key->stride, member, error);
}

/* ---- Checks over keys ---- */

/* Column texts must be readable now, not at the first log. */
static int check_columns(const config_setting_t *group, const lab_log_format *format, lab_error *error)
{
  lab_column column;
  int i;
  for (i = 0; i < format->n_columns; i++)
    if (lab_column_read(format->column[i], format, &column, error))
      return lab_config_fail_in(lab_config_member(group, "columns"), error);
  for (i = 0; i < format->n_quantities; i++)
    if (lab_column_read(format->quantity[i].column, format, &column, error))
      return lab_config_fail_in(lab_config_member(group, "quantities"), error);
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
  int i, status = lab_config_known(group, log_keys, LOG_KEYS, sizeof log_keys[0], error);
  for (i = 0; status == LAB_OK && i < LOG_KEYS; i++) {
    const config_setting_t *member = lab_config_member(group, log_keys[i].name);
    if (member)
      status = read_key(member, &log_keys[i], format, error);
  }
  return status == LAB_OK ? check_format(group, format, error) : status;
}

/* ---- Writing ---- */

static const char *word_of(const struct log_key *key, int which)
{
  return *(const char *const *)((const char *)key->words + (size_t)which * key->stride);
}

static void write_key(FILE *file, const struct log_key *key, const lab_log_format *format, const lab_log_format *usual)
{
  const void *const member = (const char *)format + key->member, *const other = (const char *)usual + key->member;
  switch (key->kind) {
  case MARK:
    write_mark(file, key->name, *(const char *)member);
    break;
  case COUNT:
    if (*(const int *)member != *(const int *)other)
      fprintf(file, "  %s = %d;\n", key->name, *(const int *)member);
    break;
  case CHOICE:
    if (*(const int *)member != *(const int *)other || key->always)
      fprintf(file, "  %s = \"%s\";\n", key->name, word_of(key, *(const int *)member));
    break;
  case TEXTS:
    write_texts(file, key->name, member);
    break;
  case NUMBERS:
    write_numbers(file, key->name, format, member, other);
    break;
  default:
    key->write(file, format);
  }
}

void lab_log_format_write(FILE *file, const lab_log_format *format)
{
  lab_log_format usual;
  int i;
  lab_log_format_default(&usual);
  fputs("log = {\n", file);
  for (i = 0; i < LOG_KEYS; i++)
    write_key(file, &log_keys[i], format, &usual);
  fputs("};\n", file);
}
