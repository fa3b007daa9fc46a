#include "logformat.h"
#include "logread.h"

#include <stdio.h>
#include <string.h>

#include "../base/names.h"
#include "../base/units.h"

/* Every name that a column may have. */
static const struct column_name {
  const char *name;
  int channel;
  int absolute; /* a pressure above vacuum */
} column_names[] = {
#define X(name, key, unit, quantity, meaning) {key, LAB_CHANNEL_##name, 0},
    LAB_CHANNEL_LIST(X)
#undef X
        {"p_abs", LAB_CHANNEL_P, 1},
    {"ps_abs", LAB_CHANNEL_PS, 1},
    {"p2_abs", LAB_CHANNEL_P2, 1},
    {"quantity", LAB_COLUMN_QUANTITY, 0},
    {"value", LAB_COLUMN_VALUE, 0},
    {"-", LAB_COLUMN_IGNORED, 0},
};
enum { NAMES = sizeof column_names / sizeof column_names[0] };

/* Cut "name [unit]" into its words.  Out: unit  "" without brackets.  Returns: 0 if it is neither. */
static int split(const char *text, char name[LAB_COLUMN_TEXT], char unit[LAB_COLUMN_TEXT])
{
  char rest[2] = "";
  *unit = '\0';
  if (sscanf(text, " %127[^][ \t] [%127[^][]] %1s", name, unit, rest) == 2)
    return strchr(text, ']') != NULL;
  return sscanf(text, " %127[^][ \t] %1s", name, rest) == 1;
}

/* Whether a position is given as a share of the stroke. */
static int is_share(const char *unit, const lab_log_format *format)
{
  return format->stroke > 0 && (!strcmp(unit, "%") || !strcmp(unit, "percent"));
}

const char *lab_column_unit(int channel, const lab_log_format *format)
{
  const lab_signal *signal = &format->signal[channel];
  return signal->from != signal->to ? signal->unit : lab_channel_unit(channel, format->command_is_pressure);
}

/* SI value = low + (high - low) (signal - from)/(to - from) */
static int read_signal(const char *unit, const lab_signal *signal, lab_column *column, lab_error *error)
{
  const double gain = (signal->high - signal->low) / (signal->to - signal->from);
  if (lab_unit_factor(unit, signal->unit, &column->scale, &column->offset, error))
    return error->status;
  column->scale *= gain;
  column->offset = signal->low + gain * (column->offset - signal->from);
  return LAB_OK;
}

/* Of a signal, what it stands for has to be said. */
static int refuse_unit(const char *text, int channel, const char *unit, const char *usual, lab_error *error)
{
  const char *key = lab_channels[channel].key, *scale = strcmp(unit, "mA") == 0  ? "4..20 mA"
                                                        : strcmp(unit, "V") == 0 ? "0..10 V"
                                                                                 : NULL;
  if (!scale)
    return lab_fail_in(error, "column \"%s\"", text);
  return lab_fail(
      error, LAB_DATA,
      "column \"%s\" is a signal: write into the rig file, with its own range: log = { scale = { %s = \"%s\"; "
      "}; range = { %s = [\"0 %s\", \"%s %s\"]; }; };",
      text, key, scale, key, usual, strcmp(usual, "%") == 0 ? "100" : "1", usual);
}

int lab_column_of(const char *text, int channel, int absolute, const char *unit, const lab_log_format *format,
                  lab_column *column, lab_error *error)
{
  const char *si = lab_channel_unit(channel, format->command_is_pressure);
  static const lab_signal current_loop = {.unit = "mA", .from = 4, .to = 20, .low = 0, .high = 1};
  const lab_signal *signal = &format->signal[channel];
  *column = (lab_column){.channel = channel, .scale = 1};
  if (signal->from == signal->to && channel == LAB_CHANNEL_SP && strcmp(unit, "mA") == 0)
    signal = &current_loop; /* what a positioner takes: 4 to 20 mA for 0 to 100 % (IEC 60381-1, 1982) */
  if (signal->from != signal->to) {
    if (read_signal(unit, signal, column, error))
      return lab_fail_in(error, "column \"%s\"", text);
  } else if (channel == LAB_CHANNEL_TIME && strcmp(unit, "date") == 0)
    column->is_stamp = 1;
  else if (channel == LAB_CHANNEL_X && is_share(unit, format))
    column->scale = 0.01 * format->stroke;
  else if (channel == LAB_CHANNEL_SP && format->stroke > 0 &&
           lab_unit_factor(unit, "m", &column->scale, &column->offset, error) == LAB_OK) {
    column->scale /= format->stroke;
    column->offset /= format->stroke;
  } else if (lab_unit_factor(unit, si, &column->scale, &column->offset, error))
    return refuse_unit(text, channel, unit, lab_usual_unit(channel, format), error);
  column->offset -= absolute ? format->ambient : 0;
  return LAB_OK;
}

int lab_column_is_named(const char *text)
{
  char name[LAB_COLUMN_TEXT], unit[LAB_COLUMN_TEXT];
  return split(text, name, unit) && *unit && lab_name_index(name, column_names, NAMES, sizeof column_names[0]) >= 0;
}

int lab_column_read(const char *text, const lab_log_format *format, lab_column *column, lab_error *error)
{
  char name[LAB_COLUMN_TEXT], unit[LAB_COLUMN_TEXT];
  const struct column_name *found;
  int i;
  if (!split(text, name, unit))
    return lab_fail(error, LAB_DATA, "expected a column \"name [unit]\", found \"%s\"", text);
  i = lab_name_index(name, column_names, NAMES, sizeof column_names[0]);
  if (i < 0)
    return lab_fail(
        error, LAB_DATA,
        "unknown channel \"%s\"; the nearest known one is \"%s\". In the rig file log.map says which channel a "
        "column of another name is, as in map = { t = \"%s [date]\"; }, and \"-\" that it is left out",
        name, lab_name_nearest(name, column_names, NAMES, sizeof column_names[0]), name);
  found = &column_names[i];
  *column = (lab_column){.channel = found->channel, .scale = 1};
  if (found->channel < 0)
    return LAB_OK;
  if (!*unit)
    return lab_fail(error, LAB_DATA, "column \"%s\" has no unit: write \"%s [%s]\" or another unit", text, found->name,
                    lab_channel_unit(found->channel, format->command_is_pressure));
  return lab_column_of(text, found->channel, found->absolute, unit, format, column, error);
}

int lab_column_mark(const char *text, const char *si, char *mark, double *scale, double *offset, lab_error *error)
{
  char unit[LAB_COLUMN_TEXT];
  if (!split(text, mark, unit) || !*unit)
    return lab_fail(error, LAB_DATA, "expected \"mark [unit]\", found \"%s\"", text);
  return lab_unit_factor(unit, si, scale, offset, error);
}
