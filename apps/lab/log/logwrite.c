#include "logformat.h"

#include <limits.h>
#include <math.h>

#include "../base/escape.h"
#include "../base/number.h"

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

/* A number a channel, those equal to `dflt` left out. */
static void write_channels(FILE *file, const char *key, const lab_log_format *format, const double *value, double dflt)
{
  char number[LAB_NUMBER_TEXT];
  int i, any = 0;
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    if (value[i] == dflt || isnan(value[i]))
      continue;
    if (!any++)
      fprintf(file, "  %s = {", key);
    fprintf(file, " %s = \"%s %s\";", lab_channels[i].key, lab_number_write(value[i], number),
            lab_channel_unit(i, format->command_is_pressure));
  }
  if (any)
    fputs(" };\n", file);
}

/* Scales and signals, and what the ends of these stand for. */
static void write_scale(FILE *file, const lab_log_format *format)
{
  char a[LAB_NUMBER_TEXT], b[LAB_NUMBER_TEXT];
  int i, any = 0, signals = 0;
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
    signals |= is_signal;
  }
  fputs(any ? " };\n" : "", file);
  fputs(signals ? "  range = {" : "", file);
  for (i = 0; i < LAB_CHANNEL_COUNT; i++) {
    const lab_signal *s = &format->signal[i];
    const char *unit = lab_channel_unit(i, format->command_is_pressure);
    if (s->from != s->to)
      fprintf(file, " %s = [\"%s %s\", \"%s %s\"];", lab_channels[i].key, lab_number_write(s->low, a), unit,
              lab_number_write(s->high, b), unit);
  }
  fputs(signals ? " };\n" : "", file);
}

static void write_quantities(FILE *file, const lab_log_format *format)
{
  int i;
  for (i = 0; i < format->n_quantities; i++) {
    fprintf(file, "%s %s = ", i ? ";" : "  quantities = {", format->quantity[i].word);
    lab_put_config(file, format->quantity[i].column);
  }
  if (format->n_quantities)
    fputs("; };\n", file);
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

static void write_window(FILE *file, double from, double to)
{
  char first[LAB_NUMBER_TEXT], last[LAB_NUMBER_TEXT];
  fprintf(file, " window = ( \"%s s\", \"%s s\" );", lab_number_write(from, first), lab_number_write(to, last));
}

static void write_held_out(FILE *file, const lab_log_format *format)
{
  const int window = !isnan(format->holdout_from), first = format->holdout_first >= 0;
  if (format->first > 0)
    fprintf(file, "  first = %d;\n", format->first);
  if (window || first)
    fputs("  holdout = {", file);
  if (window)
    write_window(file, format->holdout_from, format->holdout_to);
  if (first)
    fprintf(file, " first = %d;", format->holdout_first);
  if (window || first)
    fputs(" };\n", file);
}

/* A text a channel. */
static void write_texts(FILE *file, const char *key, const char text[LAB_CHANNEL_COUNT][LAB_COLUMN_TEXT])
{
  int c, any = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (*text[c]) {
      if (any++)
        fputc(';', file);
      else
        fprintf(file, "  %s = {", key);
      fprintf(file, " %s = ", lab_channels[c].key);
      lab_put_config(file, text[c]);
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
                lab_channel_unit(c, format->command_is_pressure));
    fputs(" }", file);
  }
  if (format->n_lead)
    fputs(" );\n", file);
}

void lab_log_format_write(FILE *file, const lab_log_format *format)
{
  char number[LAB_NUMBER_TEXT];
  fputs("log = {\n", file);
  write_mark(file, "delimiter", format->delimiter);
  write_mark(file, "decimal", format->decimal);
  write_mark(file, "thousands", format->thousands);
  write_mark(file, "comment", format->comment);
  if (format->skip_lines >= 0)
    fprintf(file, "  skip_lines = %d;\n", format->skip_lines);
  write_texts(file, "map", format->map);
  if (format->date)
    fprintf(file, "  date = \"%s\";\n", lab_date_orders[format->date]);
  write_columns(file, format);
  if (format->time_step > 0)
    fprintf(file, "  time_step = \"%s s\";\n", lab_number_write(format->time_step, number));
  if (isfinite(format->from)) {
    fputc(' ', file);
    write_window(file, format->from, format->to);
    fputc('\n', file);
  }
  fprintf(file, "  new_run = \"%s\";\n", format->new_run == LAB_RUN_T_DROPS ? "t drops" : "never");
  fprintf(file, "  damaged = \"%s\";\n", format->damaged == LAB_DAMAGED_DROP ? "drop" : "error");
  write_scale(file, format);
  write_channels(file, "offset", format, format->offset, 0);
  write_channels(file, "constants", format, format->constant, NAN);
  write_quantities(file, format);
  if (format->every > 1)
    fprintf(file, "  every = %d;\n", format->every);
  write_held_out(file, format);
  write_texts(file, "name", format->name);
  write_weights(file, format);
  if (format->way_back >= 0)
    fprintf(file, "  way_back = \"%s\";\n", lab_channels[format->way_back].key);
  if (format->runs == LAB_RUNS_MEAN)
    fputs("  runs = \"mean\";\n", file);
  write_lead(file, format);
  fputs("};\n", file);
}
