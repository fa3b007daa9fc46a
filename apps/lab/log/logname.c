#include "logread.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "../base/units.h"

enum { WORDS_TEXT = LAB_COLUMN_TEXT + 2 };

/* ---- Units ---- */

/* Units that loggers write and UDUNITS does not read, or reads as another one. */
static const struct unit_word {
  const char *word, *unit;
} unit_words[] = {
    {"kg/cm2", "98066.5 Pa"}, /* technical atmosphere, kgf/cm2 (ISO 80000-4) */
    {"kgf/cm2", "98066.5 Pa"},
    {"c", "degC"},
    {"deg c", "degC"},
    {"grad c", "degC"},
    {"f", "degF"},
    {"deg f", "degF"},
    {"sec", "s"},
    {"secs", "s"},
    {"sek", "s"},
    {"sekunden", "s"},
    {"msec", "ms"},
    {"pct", "%"},
    {"prozent", "%"},
    {"% open", "%"},
    {"percent open", "%"},
};
enum { UNIT_WORDS = sizeof unit_words / sizeof unit_words[0] };

/* Whether a word is a unit into which `si` goes; a word of the table only where it fits. */
static int unit_of(const char *word, const char *si, char unit[LAB_COLUMN_TEXT], int *absolute)
{
  lab_error ignored;
  double scale, offset;
  int i, above_vacuum = 0;
  const char *known = lab_unit_of_pressure(word, &above_vacuum);
  for (i = 0; !known && i < UNIT_WORDS; i++)
    if (lab_unit_is_word(word, unit_words[i].word))
      known = unit_words[i].unit;
  if (known && lab_unit_factor(known, si, &scale, &offset, &ignored) == LAB_OK) {
    strcpy(unit, known);
    *absolute |= above_vacuum;
    return 1;
  }
  if (!*word || isdigit((unsigned char)*word) || lab_unit_factor(word, si, &scale, &offset, &ignored) != LAB_OK)
    return 0;
  snprintf(unit, LAB_COLUMN_TEXT, "%s", word);
  return 1;
}

/* The text between the last pair of marks, blanks dropped.  Returns: 0 if there is none */
static int between(const char *text, char open, char shut, char word[LAB_COLUMN_TEXT])
{
  const char *begin = strrchr(text, open), *end = strrchr(text, shut);
  if (open == '(' && end) /* "(bar(g))": the first one that is not shut before the last */
    begin = strchr(text, open);
  if (!begin || !end || end < begin)
    return 0;
  begin += 1 + strspn(begin + 1, " ");
  while (end > begin && end[-1] == ' ')
    end--;
  snprintf(word, LAB_COLUMN_TEXT, "%.*s", end > begin ? (int)(end - begin) : 0, begin);
  return *word != '\0';
}

/* The text behind the last of these marks. */
static int behind(const char *text, const char *mark, char word[LAB_COLUMN_TEXT])
{
  const char *at, *last = NULL;
  for (at = strstr(text, mark); at; at = strstr(at + 1, mark))
    last = at;
  if (!last)
    return 0;
  last += strlen(mark);
  snprintf(word, LAB_COLUMN_TEXT, "%s", last + strspn(last, " "));
  return *word != '\0';
}

int lab_name_unit(const char *text, const char *si, char unit[LAB_COLUMN_TEXT], int *absolute)
{
  static const char *const marks[] = {" in ", " / ", ", ", "/", " ", "_"};
  char word[LAB_COLUMN_TEXT];
  size_t i;
  *unit = '\0';
  if ((between(text, '[', ']', word) && unit_of(word, si, unit, absolute)) ||
      (between(text, '(', ')', word) && unit_of(word, si, unit, absolute)))
    return 1;
  for (i = 0; i < sizeof marks / sizeof marks[0]; i++)
    if (behind(text, marks[i], word) && unit_of(word, si, unit, absolute))
      return 1;
  return 0;
}

int lab_name_is_unit(const char *text)
{
  static const char *const bases[] = {"s", "Pa", "1", "m", "K", "N", "V", "A"};
  char word[LAB_COLUMN_TEXT], unit[LAB_COLUMN_TEXT];
  int absolute = 0;
  size_t i;
  snprintf(word, sizeof word, "%s", text);
  if (*text == '[' || *text == '(')
    between(text, *text, *text == '[' ? ']' : ')', word);
  for (i = 0; i < sizeof bases / sizeof bases[0]; i++)
    if (unit_of(word, bases[i], unit, &absolute))
      return 1;
  return 0;
}

/* ---- Words ---- */

/* What names mean; the first row that fits decides. A word of three letters or fewer must stand alone. */
enum { ROW_WORDS = 15, LONE = 3 };
static const struct name_row {
  int channel;
  const char *word[ROW_WORDS];
} name_rows[] = {
    {LAB_COLUMN_IGNORED,
     {"ambient", "umgebung", "atmos", "baro", "differential", "delta", "deviation", "abweichung", "error", "fehler",
      "status", "quality", "validity", "comment", "drive"}},
    {LAB_CHANNEL_TIME, {"x value"}},
    {LAB_CHANNEL_PS, {"supply", "zuluft", "versorgung", "speise"}},
    {LAB_CHANNEL_T, {" temp"}},
    {LAB_CHANNEL_FORCE, {"force", "kraft"}},
    {LAB_CHANNEL_SP, {"setpoint", "set point", "set position", "target", "demand", "soll", "stellsignal", "sp"}},
    {LAB_CHANNEL_U, {"command", "cmd", "solenoid", "befehl", "valve signal", "magnetventil", "u"}},
    {LAB_CHANNEL_SP, {"consigne"}},
    {LAB_CHANNEL_U, {"commande"}},
    {LAB_CHANNEL_PS, {"alimentation"}},
    {LAB_CHANNEL_X, {"course"}},
    {LAB_CHANNEL_P, {"pression"}},
    {LAB_CHANNEL_TIME, {"temps"}},
    {LAB_CHANNEL_X,
     {"travel", "position", "pos", "hub", "weg", "stellung", "istwert", " stem", "stroke", "displacement", "lvdt",
      "feedback", "pv", "x"}},
    {LAB_CHANNEL_P, {"pressure", "press", "druck", "p1", "p"}},
    {LAB_CHANNEL_TIME, {"time", "zeit", "date", "datum", "elapsed", "second", "t"}}};
enum { NAME_ROWS = sizeof name_rows / sizeof name_rows[0] };

/* " word word ": small letters, what is neither letter nor digit as one blank, what is in brackets left out. */
static void words_of(const char *text, char words[WORDS_TEXT])
{
  size_t n = 0;
  words[n++] = ' ';
  for (; *text && n < WORDS_TEXT - 2 && *text != '[' && *text != '('; text++)
    if (isalnum((unsigned char)*text) || (unsigned char)*text >= 0x80)
      words[n++] = (char)tolower((unsigned char)*text);
    else if (words[n - 1] != ' ')
      words[n++] = ' ';
  words[n++] = ' ';
  words[n] = '\0';
}

static int has_word(const char *words, const char *word)
{
  char alone[32];
  snprintf(alone, sizeof alone, strlen(word) <= LONE ? " %s " : "%s", word);
  return strstr(words, alone) != NULL;
}

static int has_word_of(const char *words, const struct name_row *row)
{
  int i, any = 0;
  for (i = 0; i < ROW_WORDS && row->word[i]; i++)
    any |= has_word(words, row->word[i]);
  return any;
}

/* Whether a channel can be what a column holds: dates are time, and a unit must fit. */
static int fits(int channel, const char *text, const char *below, int is_stamp, const lab_log_format *format,
                int *absolute)
{
  const char *si = lab_column_unit(channel, format);
  char unit[LAB_COLUMN_TEXT];
  const int bracket = strpbrk(text, "[(%") != NULL;
  if (is_stamp)
    return channel == LAB_CHANNEL_TIME;
  if (lab_name_unit(*below ? below : text, si, unit, absolute) || (*below && unit_of(below, si, unit, absolute)))
    return 1;
  if ((channel == LAB_CHANNEL_X && lab_name_unit(text, "1", unit, absolute)) ||
      (channel == LAB_CHANNEL_SP && lab_name_unit(text, "m", unit, absolute)))
    return 1;
  return !bracket && !*below;
}

int lab_name_channel(const char *text, const char *below, int is_stamp, const lab_log_format *format, int *absolute)
{
  char words[WORDS_TEXT];
  int i;
  words_of(text, words);
  *absolute = 0;
  for (i = 0; i < NAME_ROWS; i++) {
    const int channel = name_rows[i].channel;
    if (!has_word_of(words, &name_rows[i]))
      continue;
    if (channel < 0)
      return LAB_COLUMN_IGNORED;
    if (fits(channel, text, below, is_stamp, format, absolute)) {
      *absolute |= strcmp(lab_channel_unit(channel, 0), "Pa") == 0 && strstr(words, " abs") != NULL;
      return channel;
    }
    *absolute = 0;
  }
  return !is_stamp && *below && fits(LAB_CHANNEL_TIME, text, below, 0, format, absolute) ? LAB_CHANNEL_TIME
                                                                                         : LAB_COLUMN_IGNORED;
}
