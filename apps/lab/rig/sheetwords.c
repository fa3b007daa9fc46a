#include "sheetwords.h"

#include <stdio.h>
#include <string.h>

#include "../base/names.h"
#include "../base/text.h"
#include "rigkeys.h"

/* Words beside the keys of rigkeys.h. */
static const struct sheet_key {
  const char *name, *group, *key;
} sheet_keys[] = {
    {"bench_set", "actuator", "bench_set"},
    {"supply", "supply", "pressure"},
    {"ambient", "ambient", "pressure"},
    {"tube.length", "tube", "length"},
    {"tube.bore", "tube", "bore"},
#define ORIFICE(key)                                                                                                   \
  {"fill." key, "transducer.fill", key},                                                                               \
  {                                                                                                                    \
    "vent." key, "transducer.vent", key                                                                                \
  }
    ORIFICE("Kv"),
    ORIFICE("Cv"),
    ORIFICE("C"),
    ORIFICE("b"),
    ORIFICE("Qn"),
    ORIFICE("xT"),
    ORIFICE("p1"),
    ORIFICE("p2"),
#undef ORIFICE
};
enum { SHEET_KEYS = sizeof sheet_keys / sizeof sheet_keys[0], NAMES = 128 };

/* "area", or "supply.pressure" where two groups have the key. */
static int is_key(const lab_key *row, const char *name)
{
  const size_t group = strlen(row->group);
  int i, alone = 1;
  if (strncmp(name, row->group, group) == 0 && name[group] == '.' && strcmp(name + group + 1, row->key) == 0)
    return 1;
  for (i = 0; i < lab_key_count; i++)
    alone &= &lab_keys[i] == row || strcmp(lab_keys[i].key, row->key) != 0;
  return alone && strcmp(name, row->key) == 0;
}

static int unknown(const char *name, lab_error *error)
{
  const char *names[NAMES];
  int i, n = 0;
  for (i = 0; i < SHEET_KEYS; i++)
    names[n++] = sheet_keys[i].name;
  for (i = 0; i < lab_key_count && n < NAMES; i++)
    names[n++] = lab_keys[i].key;
  return lab_fail(error, LAB_USAGE, "--sheet: unknown key \"%s\"; the nearest known one is \"%s\"", name,
                  lab_name_nearest(name, names, (size_t)n, sizeof names[0]));
}

/* Find where a name belongs.  Out: word without value, up to two  Returns: how many */
static int find(const char *name, lab_sheet_word word[2])
{
  int i, n = 0;
  for (i = 0; i < lab_key_count; i++)
    if (is_key(&lab_keys[i], name)) {
      word[0] = (lab_sheet_word){lab_keys[i].group, lab_keys[i].key, ""};
      return 1;
    }
  for (i = 0; i < SHEET_KEYS && n < 2; i++)
    if (strcmp(name, sheet_keys[i].name) == 0 ||
        (strchr(sheet_keys[i].group, '.') && strcmp(name, sheet_keys[i].key) == 0))
      word[n++] = (lab_sheet_word){sheet_keys[i].group, sheet_keys[i].key, ""};
  return n;
}

/* "0.2..1.0 bar" or "0.2 bar, 1.0 bar" as a list of two; the first takes the unit of the second if it has none. */
static int put_pair(char *text, char value[LAB_SHEET_VALUE])
{
  static const char *const marks[] = {"..", " to ", ",", ";"};
  char *second = NULL;
  size_t i, n;
  for (i = 0; i < sizeof marks / sizeof marks[0] && !second; i++)
    if ((second = strstr(text, marks[i]))) {
      *second = '\0';
      second += strlen(marks[i]);
    }
  if (!second)
    return 0;
  text = lab_trim(text);
  second = lab_trim(second);
  n = strspn(second, "+-0123456789.eE");
  return snprintf(value, LAB_SHEET_VALUE, "[\"%s%s\", \"%s\"]", text,
                  text[strspn(text, "+-0123456789.eE ")] ? "" : second + n, second) < LAB_SHEET_VALUE;
}

int lab_sheet_word_read(const char *text, lab_sheet_word word[2], int *n, lab_error *error)
{
  char copy[LAB_SHEET_VALUE], *mark;
  int i, good = 1;
  if (strlen(text) >= sizeof copy - 4 || strpbrk(text, "\"\\\n"))
    return lab_fail(error, LAB_USAGE, "--sheet: expected key=value without quotes, in at most %d bytes",
                    (int)sizeof copy - 5);
  strcpy(copy, text);
  mark = strchr(copy, '=');
  if (!mark)
    return lab_fail(error, LAB_USAGE, "--sheet: expected key=value, such as \"area=400 cm2\", found \"%s\"", text);
  *mark++ = '\0';
  *n = find(lab_trim(copy), word);
  if (*n == 0)
    return unknown(lab_trim(copy), error);
  for (i = 0; i < *n && good; i++)
    if (strcmp(word[i].key, "bench_set") == 0)
      good = put_pair(mark, word[i].value);
    else
      snprintf(word[i].value, sizeof word[i].value, "\"%s\"", lab_trim(mark));
  return good ? LAB_OK
              : lab_fail(error, LAB_USAGE, "--sheet: expected two pressures, such as \"bench_set=0.2..1.0 bar\"");
}
