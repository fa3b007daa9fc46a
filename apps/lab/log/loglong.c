#include "logread.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "../base/number.h"

/* Rows that are looked at, at most and at least; columns of a file in long form, at most. */
enum { LOOK = 64, FEW = 6, WIDE = 16, WORD_TEXT = sizeof((lab_long_quantity *)0)->word };

/* What the cells of a column are. */
typedef struct kinds {
  int numbers, stamps, words, changes; /* words that are another than in the row before */
  int n, last;                         /* different words; that of the row before */
  char word[LAB_QUANTITY_MAX][WORD_TEXT];
} kinds;

typedef struct survey {
  const lab_log_format *format;
  const lab_heading *heading;
  int rows, n;
  kinds column[WIDE];
} survey;

static void note_word(kinds *k, const char *text)
{
  int i;
  for (i = 0; i < k->n && strcmp(k->word[i], text) != 0; i++)
    ;
  if (strlen(text) >= WORD_TEXT || i == LAB_QUANTITY_MAX)
    return;
  if (i == k->n)
    strcpy(k->word[k->n++], text);
  k->changes += k->words > 0 && i != k->last;
  k->last = i;
  k->words++;
}

static void note_cell(const survey *s, kinds *k, const lab_cell *cell)
{
  lab_stamp stamp = {0};
  double value;
  char text[LAB_HEADING_TEXT];
  if (lab_number_read(cell->begin, cell->end, s->format->decimal, s->format->thousands, &value) != LAB_NUMBER_BAD)
    k->numbers++;
  else if (lab_stamp_read(cell->begin, cell->end, s->format->date, &stamp))
    k->stamps++;
  else {
    lab_encode_cell(lab_trim(cell->begin), text, sizeof text);
    note_word(k, text);
  }
}

static int look(lab_csv *csv, survey *s, lab_error *error)
{
  int i, more = 1;
  while (s->rows < LOOK) {
    if (lab_csv_line(csv, &more, error))
      return error->status;
    if (!more)
      return LAB_OK;
    if (lab_csv_cut(csv, error))
      return error->status;
    for (i = 0; i < s->n && i < csv->n; i++)
      note_cell(s, &s->column[i], &csv->cell[i]);
    s->rows++;
  }
  return LAB_OK;
}

/* The first column of which all cells are so; -1 for none. */
static int find(const survey *s, int (*is)(const survey *s, const kinds *k))
{
  int i = 0;
  while (i < s->n && !is(s, &s->column[i]))
    i++;
  return i < s->n ? i : -1;
}

/* A few words, of which one follows another: a state would stay what it is for many rows. */
static int names_quantities(const survey *s, const kinds *k)
{
  return k->words == s->rows && k->n >= 2 && 2 * k->changes >= s->rows;
}

static int is_time(const survey *s, const kinds *k)
{
  return k->stamps == s->rows;
}

static int is_number(const survey *s, const kinds *k)
{
  return k->numbers == s->rows;
}

/* A heading that says that it is one, in English, German or French. */
static int is_value(const survey *s, const kinds *k)
{
  static const char *const words[] = {"value", "wert", "valeur"};
  char text[LAB_HEADING_TEXT];
  size_t i;
  int any = 0;
  snprintf(text, sizeof text, "%s", s->heading[k - s->column].text);
  for (i = 0; text[i]; i++)
    text[i] = (char)tolower((unsigned char)text[i]);
  for (i = 0; i < sizeof words / sizeof words[0]; i++)
    any |= strstr(text, words[i]) != NULL;
  return any && is_number(s, k);
}

/* ---- What the user is to write ---- */

/* "sp [%]", or "-" for a word that means nothing, or what another means already. */
static void column_for(const survey *s, const char *word, int taken[LAB_CHANNEL_COUNT], char column[LAB_COLUMN_TEXT])
{
  char unit[LAB_COLUMN_TEXT];
  int absolute = 0, channel = lab_name_channel(word, "", 0, s->format, &absolute);
  strcpy(column, "-");
  if (channel < 0 || channel == LAB_CHANNEL_TIME || taken[channel]++)
    return;
  if (!lab_name_unit(word, lab_channel_unit(channel, s->format->command_is_pressure), unit, &absolute))
    snprintf(unit, sizeof unit, "%s", lab_usual_unit(channel, s->format));
  snprintf(column, LAB_COLUMN_TEXT, "%s%s [%.20s]", lab_channels[channel].key, absolute ? "_abs" : "", unit);
}

static int answer(const survey *s, const lab_guess *guess, int word, int time, int value, lab_error *error)
{
  const kinds *k = &s->column[word];
  char columns[WIDE * 24] = "", quantities[LAB_QUANTITY_MAX * (WORD_TEXT + 40)] = "", column[LAB_COLUMN_TEXT];
  int i, taken[LAB_CHANNEL_COUNT] = {0};
  for (i = 0; i < s->n; i++)
    lab_append(columns, sizeof columns, "%s\"%s\"", i ? ", " : "",
               i == word    ? "quantity"
               : i == time  ? "t [date]"
               : i == value ? "value"
                            : "-");
  for (i = 0; i < k->n; i++) {
    column_for(s, k->word[i], taken, column);
    lab_append(quantities, sizeof quantities, "%s(", i ? ", " : "");
    lab_append_quoted(quantities, sizeof quantities, k->word[i]);
    lab_append(quantities, sizeof quantities, ", \"%s\")", column);
  }
  return lab_fail(
      error, LAB_DATA,
      "a row holds one value, and column %d \"%s\" says of what; say which channel each is, with its unit, "
      "or \"-\"; write into the rig file: log = { skip_lines = %d; columns = ( %s ); quantities = ( %s ); };",
      word + 1, s->heading[word].text, guess->header, columns, quantities);
}

int lab_long_check(lab_csv *csv, const lab_log_format *format, const lab_guess *guess, const lab_heading *heading,
                   lab_error *error)
{
  survey *s = calloc(1, sizeof *s);
  int word, time, value, status = s ? LAB_OK : lab_fail_memory(error, "a log");
  if (status == LAB_OK) {
    s->format = format;
    s->heading = heading;
    s->n = guess->cells < WIDE ? guess->cells : WIDE;
    status = look(csv, s, error);
  }
  if (status == LAB_OK && s->rows >= FEW) {
    word = find(s, names_quantities);
    time = find(s, is_time);
    value = find(s, is_value);
    value = value < 0 ? find(s, is_number) : value;
    if (word >= 0 && time >= 0 && value >= 0)
      status = answer(s, guess, word, time, value, error);
  }
  free(s);
  return status;
}
