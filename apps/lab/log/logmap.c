#include "logread.h"

#include <stdarg.h>
#include <string.h>

#include "../base/names.h"

/* What is done with a heading that means no channel: it is left out, it is a mistake unless empty, or it is one. */
enum strictness { NOT_STRICT, LENIENT, STRICT };

enum { MAP_TEXT = 320 };

typedef struct naming {
  const lab_heading *heading;
  int n;
  int is_strict; /* enum strictness */
  const lab_log_format *format;
  lab_header *header;
  int taken[LAB_CHANNEL_COUNT];                       /* 1 + column */
  char ask[LAB_CHANNEL_COUNT][LAB_HEADING_TEXT + 16]; /* entries of log.map that the user is to write */
  char why[MAP_TEXT];                                 /* why the first of them is needed; "": none is */
  char said[MAP_TEXT];
  lab_error *error;
} naming;

/* ---- What the user is to write ---- */

void lab_append_quoted(char *text, size_t room, const char *value)
{
  lab_append(text, room, "\"");
  for (; *value; value++)
    lab_append(text, room, strchr("\"\\", *value) ? "\\%c" : "%c", *value);
  lab_append(text, room, "\"");
}

static int fail_asking(naming *m)
{
  char map[LAB_CHANNEL_COUNT * 64] = "";
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    const char *entry = *m->ask[c] ? m->ask[c] : m->format->map[c];
    if (!*entry)
      continue;
    lab_append(map, sizeof map, "%s = ", lab_channels[c].key);
    lab_append_quoted(map, sizeof map, entry);
    lab_append(map, sizeof map, "; ");
  }
  return lab_fail(m->error, LAB_DATA, "%s; write into the rig file: log = { map = { %s}; };", m->why, map);
}

/* Ask for an entry of the map; only the first reason is told. */
static void ask(naming *m, int channel, int column, const char *unit, const char *why, ...) LAB_PRINTF(5, 6);

static void ask(naming *m, int channel, int column, const char *unit, const char *why, ...)
{
  va_list args;
  snprintf(m->ask[channel], sizeof m->ask[channel], *unit ? "%s [%s]" : "%s", m->heading[column].text, unit);
  if (*m->why)
    return;
  va_start(args, why);
  vsnprintf(m->why, sizeof m->why, why, args);
  va_end(args);
}

const char *lab_usual_unit(int channel, const lab_log_format *format)
{
  const char *si = lab_channel_unit(channel, format->command_is_pressure);
  return strcmp(si, "Pa") == 0       ? "bar"
         : strcmp(si, "m") == 0      ? "mm"
         : channel == LAB_CHANNEL_T  ? "degC"
         : channel == LAB_CHANNEL_SP ? "%"
                                     : si;
}

/* ---- Columns ---- */

static int is_free(const naming *m, int i)
{
  return m->header->column[i].channel == LAB_COLUMN_IGNORED;
}

static int is_stamp(const naming *m, int i)
{
  return m->heading[i].stamp.has_day || m->heading[i].stamp.has_time;
}

/* Note what was guessed of a column. */
static void say(naming *m, int channel, int i)
{
  lab_append(m->said, sizeof m->said, "%s%s is \"%s\"%s%s", *m->said ? ", " : "", lab_channels[channel].key,
             m->heading[i].text, *m->heading[i].below ? " in " : "", m->heading[i].below);
  if (m->header->column[i].is_stamp)
    lab_append(m->said, sizeof m->said, " (%s)",
               m->heading[i].stamp.has_day ? lab_date_orders[m->heading[i].stamp.order] : "time of day");
}

/* The unit of a column: that of the map, of the line below or of the name; a position and its set point may be shares
 * or lengths. */
static int find_unit(const naming *m, int i, int channel, const char *own, char unit[LAB_COLUMN_TEXT], int *absolute)
{
  const lab_heading *h = &m->heading[i];
  const int is_signal = m->format->signal[channel].from != m->format->signal[channel].to;
  const char *si = lab_column_unit(channel, m->format);
  const char *other = is_signal ? si : channel == LAB_CHANNEL_X ? "1" : channel == LAB_CHANNEL_SP ? "m" : si;
  const char *const texts[] = {h->below, h->text};
  char bracket[LAB_HEADING_TEXT + 2];
  int k;
  if (*own) {
    snprintf(unit, LAB_COLUMN_TEXT, "%s", own);
    return 1;
  }
  for (k = 0; k < 2; k++) {
    snprintf(bracket, sizeof bracket, k == 0 && !strpbrk(texts[k], "[(") ? "[%s]" : "%s", texts[k]);
    if (lab_name_unit(bracket, si, unit, absolute) || lab_name_unit(bracket, other, unit, absolute))
      return 1;
  }
  if (is_signal)
    snprintf(unit, LAB_COLUMN_TEXT, "%s", si); /* the key has said it */
  return is_signal;
}

static int has_unit_of(const naming *m, int i, int channel)
{
  char unit[LAB_COLUMN_TEXT];
  int absolute = 0;
  return find_unit(m, i, channel, "", unit, &absolute);
}

/* Make column i a channel.
 * In:      own  its unit as log.map has it, or "" */
static int take(naming *m, int i, int channel, int absolute, const char *own)
{
  char unit[LAB_COLUMN_TEXT];
  m->taken[channel] = i + 1;
  if (channel == LAB_CHANNEL_TIME && is_stamp(m, i) && !*own) {
    m->header->column[i] = (lab_column){LAB_CHANNEL_TIME, 1, 0, 1};
    return LAB_OK;
  }
  if (find_unit(m, i, channel, own, unit, &absolute))
    return lab_column_of(m->heading[i].text, channel, absolute, unit, m->format, &m->header->column[i], m->error);
  ask(m, channel, i, lab_usual_unit(channel, m->format),
      "column %d \"%s\" has no unit of %s; say which it is in place of the one below", i + 1, m->heading[i].text,
      lab_channels[channel].quantity);
  return LAB_OK;
}

/* ---- By log.map ---- */

/* Whether an entry of the map names a heading.  Out: own  the unit that it gives beyond that, or "" */
static int names(const char *entry, const char *heading, char own[LAB_COLUMN_TEXT])
{
  const size_t n = strlen(heading);
  const char *rest = entry + n, *end;
  *own = '\0';
  if (strncmp(entry, heading, n) != 0)
    return 0;
  if (!*rest || n == LAB_HEADING_TEXT - 1)
    return 1;
  rest += strspn(rest, " ");
  end = strchr(rest, ']');
  if (*rest != '[' || !end || end[1])
    return 0;
  snprintf(own, LAB_COLUMN_TEXT, "%.*s", (int)(end - rest - 1), rest + 1);
  return 1;
}

static int no_such_column(naming *m, int channel)
{
  char list[MAP_TEXT] = "";
  const char *text[LAB_COLUMN_MAX];
  int i;
  for (i = 0; i < m->n; i++) {
    text[i] = m->heading[i].text;
    lab_append(list, sizeof list, "%s\"%s\"", i ? ", " : "", text[i]);
  }
  return lab_fail(m->error, LAB_DATA, "log.map.%s: no column is named \"%s\"; the nearest is \"%s\" of %s",
                  lab_channels[channel].key, m->format->map[channel],
                  lab_name_nearest(m->format->map[channel], text, (size_t)m->n, sizeof text[0]), list);
}

static int take_mapped(naming *m)
{
  char own[LAB_COLUMN_TEXT];
  int c, i, absolute;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    if (!*m->format->map[c])
      continue;
    for (i = 0; i < m->n && !names(m->format->map[c], m->heading[i].text, own); i++)
      ;
    if (i == m->n)
      return no_such_column(m, c);
    lab_name_channel(m->heading[i].text, m->heading[i].below, 0, m->format, &absolute);
    if (take(m, i, c, absolute, own))
      return m->error->status;
  }
  return LAB_OK;
}

/* ---- By name ---- */

static int is_mapped(const naming *m, int channel)
{
  return channel >= 0 && *m->format->map[channel];
}

static void take_named(naming *m)
{
  lab_error ignored;
  int i;
  for (i = 0; i < m->n; i++) {
    lab_column column;
    if (!is_free(m, i) || lab_column_read(m->heading[i].text, m->format, &column, &ignored) ||
        is_mapped(m, column.channel))
      continue;
    m->header->column[i] = column;
    if (column.channel >= 0)
      m->taken[column.channel] = i + 1;
  }
}

/* ---- By words ---- */

/* Whether a heading is "name [unit]" or "name (unit)", be the name known or not. */
static int has_form(const char *text)
{
  const size_t n = strlen(text);
  return n > 0 && strchr("])", text[n - 1]);
}

/* A date and a time of day, in either order, are time together.  Returns: 1 if they are that */
static int join_day(naming *m, int a, int b)
{
  const lab_stamp *x = &m->heading[a].stamp, *y = &m->heading[b].stamp;
  if (x->has_day && !x->has_time && !y->has_day && y->has_time) {
    m->header->column[a] = (lab_column){LAB_COLUMN_DAY, 1, 0, 1};
    say(m, LAB_CHANNEL_TIME, a);
    return 1;
  }
  return 0;
}

/* Of two columns that may be a channel, the one that says more of its unit; -1 where that settles nothing. */
static int better(const naming *m, int channel, int a, int b)
{
  const int with_a = (channel == LAB_CHANNEL_TIME && is_stamp(m, a)) || has_unit_of(m, a, channel);
  const int with_b = (channel == LAB_CHANNEL_TIME && is_stamp(m, b)) || has_unit_of(m, b, channel);
  return with_a == with_b ? -1 : with_a ? a : b;
}

/* The column that a channel's words lead to; -1 for none. */
static int find_by_words(naming *m, int channel, int *absolute)
{
  int i, found = -1, other;
  for (i = 0; i < m->n; i++) {
    if (!is_free(m, i) || (m->is_strict && !has_form(m->heading[i].text) && !is_stamp(m, i)) ||
        lab_name_channel(m->heading[i].text, m->heading[i].below, is_stamp(m, i), m->format, absolute) != channel)
      continue;
    if (found < 0 || join_day(m, found, i)) {
      found = i;
      continue;
    }
    if (join_day(m, i, found))
      continue;
    other = better(m, channel, found, i);
    if (other < 0)
      ask(m, channel, found, "", "columns \"%s\" and \"%s\" may both be %s (%s): say which is", m->heading[found].text,
          m->heading[i].text, lab_channels[channel].key, lab_channels[channel].quantity);
    found = other < 0 ? found : other;
  }
  if (found >= 0)
    lab_name_channel(m->heading[found].text, m->heading[found].below, is_stamp(m, found), m->format, absolute);
  return found;
}

static int take_by_words(naming *m)
{
  int c, i, absolute = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++) {
    if (m->taken[c] || is_mapped(m, c))
      continue;
    i = find_by_words(m, c, &absolute);
    if (i >= 0 && take(m, i, c, absolute, ""))
      return m->error->status;
    if (i >= 0)
      say(m, c, i);
  }
  return LAB_OK;
}

/* ---- All ---- */

/* In a file with a header as documented, what means no channel is a mistake. */
static int check_all_mean(naming *m)
{
  int i;
  for (i = 0; i < m->n; i++) {
    const char *text = m->heading[i].text;
    lab_column column;
    if (is_free(m, i) && (*text || m->is_strict == STRICT) && lab_column_read(text, m->format, &column, m->error))
      return lab_fail_in(m->error, "column %d", i + 1);
  }
  return LAB_OK;
}

static void say_left_out(naming *m)
{
  int i, any = 0;
  for (i = 0; i < m->n; i++)
    if (is_free(m, i) && *m->heading[i].text && strcmp(m->heading[i].text, "-") != 0)
      lab_append(m->said, sizeof m->said, "%s\"%s\"",
                 any++      ? ", "
                 : *m->said ? "; left out: "
                            : "left out: ",
                 m->heading[i].text);
}

/* The order of the dates in the file. */
static void set_date(const naming *m, lab_log_format *format)
{
  int i;
  for (i = 0; i < m->n; i++)
    if (m->header->column[i].is_stamp && m->heading[i].stamp.has_day)
      format->date = m->heading[i].stamp.order;
}

int lab_map_is_named(const lab_heading *heading, int n)
{
  int i;
  for (i = 0; i < n; i++)
    if (lab_column_is_named(heading[i].text))
      return 1;
  return 0;
}

static int is_any_mapped(const naming *m)
{
  int c, any = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    any |= is_mapped(m, c);
  return any;
}

/* Whether there is more than time. */
static int is_any_measured(const naming *m)
{
  int c, any = 0;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    any |= c != LAB_CHANNEL_TIME && (m->taken[c] || is_mapped(m, c));
  return any;
}

/* What a log usually has. */
static const int usual[] = {LAB_CHANNEL_U, LAB_CHANNEL_P, LAB_CHANNEL_X};
enum { USUAL = sizeof usual / sizeof usual[0] };

/* The next of what a log usually has that is not asked for and goes with the unit of a column, if that has one of
 * theirs; -1: none. */
static int next_usual(const naming *m, int i)
{
  int k, any = 0;
  for (k = 0; k < USUAL; k++)
    any |= has_unit_of(m, i, usual[k]);
  for (k = 0; k < USUAL; k++)
    if (!*m->ask[usual[k]] && (!any || has_unit_of(m, i, usual[k])))
      return usual[k];
  return -1;
}

/* Ask for what a log usually has, of the columns that are left, in their order. */
static void ask_for_measured(naming *m)
{
  int i, channel;
  for (i = 0; i < m->n; i++) {
    if (!is_free(m, i) || !*m->heading[i].text || m->taken[LAB_CHANNEL_TIME] == i + 1 ||
        (i == 0 && *m->ask[LAB_CHANNEL_TIME]) || (channel = next_usual(m, i)) < 0)
      continue;
    ask(m, channel, i, has_unit_of(m, i, channel) ? "" : lab_usual_unit(channel, m->format),
        "none of the columns is known to be a command, a pressure or a position; say which are, and what a 1 in them "
        "is");
  }
}

static int name_all(naming *m)
{
  if (take_mapped(m))
    return m->error->status;
  take_named(m);
  if (take_by_words(m) || (m->is_strict && check_all_mean(m)))
    return m->error->status;
  if (!m->is_strict && !m->taken[LAB_CHANNEL_TIME] && !(m->format->time_step > 0))
    ask(m, LAB_CHANNEL_TIME, 0, "s", "none of the columns is known to be time; say which is, and its unit");
  if (!m->is_strict && !is_any_measured(m))
    ask_for_measured(m);
  if (*m->why)
    return fail_asking(m);
  say_left_out(m);
  return LAB_OK;
}

int lab_map_columns(const lab_heading *heading, int n, int guessed, lab_log_format *format, lab_header *header,
                    char said[LAB_READ_AS_TEXT], lab_error *error)
{
  naming m = {.heading = heading, .n = n, .format = format, .header = header, .error = error};
  int i;
  header->n = n;
  for (i = 0; i < n; i++) {
    header->column[i] = (lab_column){LAB_COLUMN_IGNORED, 1, 0, 0};
    snprintf(header->text[i], LAB_COLUMN_TEXT, "%s", heading[i].text);
  }
  m.is_strict =
      (lab_map_is_named(heading, n) || !guessed) && !is_any_mapped(&m) ? guessed ? LENIENT : STRICT : NOT_STRICT;
  if (name_all(&m))
    return error->status;
  set_date(&m, format);
  if (*m.said)
    lab_append(said, LAB_READ_AS_TEXT, "%s%s", *said ? "; " : "", m.said);
  return LAB_OK;
}
