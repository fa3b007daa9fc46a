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
    {"diameter", "actuator", "diameter"},
    {"travel", "actuator", "stroke"},
    {"fail", "actuator", "fail"},
    {"supply", "supply", "pressure"},
    {"ambient", "ambient", "pressure"},
    {"tube.length", "tube", "length"},
    {"tube.bore", "tube", "bore"},
#define POSITIONER(key)                                                                                                \
  {                                                                                                                    \
    "positioner." key, "positioner", key                                                                               \
  }
    POSITIONER("gain"),
    POSITIONER("integral_time"),
    POSITIONER("derivative_time"),
    POSITIONER("dead_band"),
    POSITIONER("cutoff_low"),
    POSITIONER("cutoff_high"),
    POSITIONER("integral_start"),
#undef POSITIONER
    {"Kvs", "transducer.fill", "Kv"},
    {"Kvs", "transducer.vent", "Kv"},
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

/* A key that more groups than one have: with which to write it.  Out: list  Returns: how many there are */
static int list_groups(const char *name, char list[LAB_SHEET_VALUE])
{
  int i, n = 0;
  for (*list = '\0', i = 0; i < lab_key_count; i++)
    if (strcmp(lab_keys[i].key, name) == 0)
      lab_append(list, LAB_SHEET_VALUE, "%s\"%s.%s\"", n++ ? " or " : "", lab_keys[i].group, name);
  return n;
}

static int unknown(const char *name, lab_error *error)
{
  const char *names[NAMES];
  char list[LAB_SHEET_VALUE];
  int i, n = 0;
  for (i = 0; i < SHEET_KEYS; i++)
    names[n++] = sheet_keys[i].name;
  for (i = 0; i < lab_key_count && n < NAMES; i++)
    names[n++] = lab_keys[i].key;
  if (strcmp(name, "tube") == 0)
    return lab_fail(error, LAB_USAGE, "--sheet: expected \"tube.length=2 m\" \"tube.bore=4 mm\", each by itself");
  if (list_groups(name, list) > 0)
    return lab_fail(error, LAB_USAGE, "--sheet: which \"%s\"? Write %s", name, list);
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

/* ---- Actuators and positioners by name ---- */

static const char fisher[] = "Fisher Bulletin 61.1:657, table 1 (largest travel), and 61.1:657 Size i (usual range)";
static const char fisher_large[] =
    "Fisher 657 sizes 80 and 100, instruction manual D100307X012, table 1 (largest travel)";
static const char masoneilan[] =
    "Masoneilan 37/38, instruction manual, GE Oil & Gas 2015, page 4 (largest stroke, usual range)";
static const char polna[] = "Polna, multi-spring actuators P/R, data sheet (the first of the ranges)";
static const char hora[] = "HORA PA-N 160 and PA-N 280, manual, table 1: stroke volume over stroke, total less stroke "
                           "volume";
static const char siemens[] = "Siemens Powers No. 4, technical instructions 155-032P25, specifications";

/* Of the ranges that a maker offers the first is taken; the plate of the actuator has the right one. */
static const lab_product actuators[] = {
    {"fisher-657-30", {"area=297 cm2", "stroke=19 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-34", {"area=445 cm2", "stroke=29 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-40", {"area=445 cm2", "stroke=38 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-45", {"area=677 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-46", {"area=1006 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-50", {"area=677 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-60", {"area=1006 cm2", "stroke=51 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-70", {"area=1419 cm2", "stroke=76 mm", "bench_set=0.2..1.0 bar"}, fisher},
    {"fisher-657-80", {"area=1761 cm2", "stroke=76 mm"}, fisher_large},
    {"fisher-657-100", {"area=2902 cm2", "stroke=102 mm"}, fisher_large},
    {"masoneilan-37-9", {"area=45 in^2", "stroke=0.75 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-11", {"area=71 in^2", "stroke=1 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-13", {"area=105 in^2", "stroke=1.5 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-15", {"area=145 in^2", "stroke=2 in", "bench_set=3..15 psi"}, masoneilan},
    {"masoneilan-37-18", {"area=200 in^2", "stroke=2.5 in", "bench_set=3..15 psi"}, masoneilan},
    {"polna-p-250", {"area=250 cm2", "stroke=20 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-630-20", {"area=630 cm2", "stroke=20 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-630-38", {"area=630 cm2", "stroke=38 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-1000-38", {"area=1000 cm2", "stroke=38 mm", "bench_set=20..100 kPa"}, polna},
    {"polna-p-1000-63", {"area=1000 cm2", "stroke=63 mm", "bench_set=20..100 kPa"}, polna},
    {"hora-pa-n-160-10", {"area=160 cm2", "stroke=10 mm", "dead_volume=0.18 dm3"}, hora},
    {"hora-pa-n-160-20", {"area=160 cm2", "stroke=20 mm", "dead_volume=0.18 dm3"}, hora},
    {"hora-pa-n-280-20", {"area=280 cm2", "stroke=20 mm", "dead_volume=0.48 dm3"}, hora},
    {"hora-pa-n-280-30", {"area=280 cm2", "stroke=30 mm", "dead_volume=0.48 dm3"}, hora},
    {"siemens-powers-4", {"area=71 cm2", "stroke=102 mm", "bench_set=21..50 kPa"}, siemens},
};

/* What fills and vents a chamber, at full deviation. */
static const lab_product positioners[] = {
    {"abb-tzidc",
     {"Qn=10 m3/h", "p1=6 bar", "p2=0 bar"},
     "ABB TZIDC, operating instruction 42/18-84-EN, 9.3.3 (at 6 bar; venting is not said, and taken alike)"},
    {"badger-meter-srd",
     {"Qn=7500 l/h", "p1=6 bar", "p2=0 bar"},
     "Badger Meter SRD/SRI, functional specifications, air output without booster (at 6 bar; both ways)"},
    {"badger-meter-srd-spool",
     {"Qn=18000 l/h", "p1=6 bar", "p2=0 bar"},
     "Badger Meter SRD/SRI, functional specifications, air output with spool valve (at 6 bar; both ways)"},
    {"samson-3730",
     {"fill.Qn=8.5 m3/h", "vent.Qn=14 m3/h", "p1=6 bar", "p2=0 bar"},
     "Samson 3730, EB 8384-3, technical data (at a difference of 6 bar)"},
    {"siemens-sipart-ps2",
     {"fill.Kv=0.1", "vent.Kv=0.2"},
     "Siemens SIPART PS2, operating instructions A5E00074631-AE, pneumatic data (not the versions Ex d)"},
};

/* A product that the catalogue does not have: what it has, all of it or what has the text in its name. */
static int unlisted(const char *kind, const char *text, const lab_product *of, size_t n, lab_error *error)
{
  char list[sizeof error->text - 200] = "";
  size_t i, like = 0;
  for (i = 0; i < n; i++)
    like += strstr(of[i].name, text) != NULL;
  for (i = 0; i < n; i++)
    if (like == 0 || strstr(of[i].name, text))
      lab_append(list, sizeof list, "%s%s", *list ? ", " : "", of[i].name);
  return lab_fail(error, LAB_USAGE, "--sheet: no %s \"%.80s\"; known ones%s: %s", kind, text, like ? " like it" : "",
                  list);
}

#define PRODUCTS(table)                                                                                                \
  {                                                                                                                    \
    table, sizeof table / sizeof table[0]                                                                              \
  }
int lab_product_read(const char *text, int *kind, const lab_product **product, lab_error *error)
{
  static const char *const words[LAB_PRODUCT_KINDS] = {"actuator", "positioner"};
  static const struct {
    const lab_product *of;
    size_t n;
  } tables[LAB_PRODUCT_KINDS] = {PRODUCTS(actuators), PRODUCTS(positioners)};
  const size_t length = strcspn(text, "=");
  int i;
  for (*kind = 0; *kind < LAB_PRODUCT_KINDS; (*kind)++)
    if (text[length] && strlen(words[*kind]) == length && strncmp(text, words[*kind], length) == 0)
      break;
  if (*kind == LAB_PRODUCT_KINDS)
    return LAB_OK;
  text += length + 1;
  i = lab_name_index(text, tables[*kind].of, tables[*kind].n, sizeof **product);
  if (i < 0)
    return unlisted(words[*kind], text, tables[*kind].of, tables[*kind].n, error);
  *product = &tables[*kind].of[i];
  return LAB_OK;
}

/* ---- Questions ---- */

static const struct question {
  const char *key, *words;
} questions[] = {
    {"actuator", "Actuator by maker, type and size, if the catalogue has it (fisher-657-40)"},
    {"bench_set", "Bench set: pressures at which the stem begins and ends its stroke (0.2..1.0 bar)"},
    {"stroke", "Stroke (20 mm)"},
    {"area", "Effective area of the diaphragm (400 cm2)"},
    {"fail", "Where the spring takes the valve when the air fails (close, open)"},
    {"dead_volume", "Volume of the empty chamber, with tubes (0.3 dm3)"},
    {"moving_mass", "Mass of stem, plate and plug (5 kg)"},
    {"supply", "Supply pressure, gauge (4 bar)"},
    {"positioner", "Positioner by maker and type, if the catalogue has it (samson-3730)"},
    {"Kv", "Else Kv of what fills and vents the chamber [m3/h] (0.1)"},
};

/* Whether an answer is one that a draft takes. */
static int is_good(const char *text, lab_error *error)
{
  const lab_product *product;
  lab_sheet_word word[2];
  int n, kind;
  if (lab_product_read(text, &kind, &product, error))
    return 0;
  return kind < LAB_PRODUCT_KINDS || lab_sheet_word_read(text, word, &n, error) == LAB_OK;
}

/* Returns: 0 at the end of the answers */
static int ask(const struct question *q, FILE *in, FILE *out, lab_sheet_answers *answers)
{
  char line[LAB_SHEET_VALUE / 2], *text = answers->text[answers->n], *value;
  lab_error error = {LAB_OK, ""};
  for (;;) {
    fprintf(out, "%s: ", q->words);
    fflush(out);
    if (!fgets(line, sizeof line, in))
      return 0;
    value = lab_trim(line);
    if (!*value)
      return 1;
    snprintf(text, LAB_SHEET_VALUE, "%s=%s", q->key, value);
    if (is_good(text, &error))
      break;
    fprintf(out, "%s\n", error.text);
  }
  answers->n++;
  return 1;
}

void lab_sheet_ask(FILE *in, FILE *out, lab_sheet_answers *answers)
{
  int i, goes_on = 1;
  answers->n = 0;
  fputs("What does the data sheet say? Leave open what it does not say.\n", out);
  for (i = 0; i < LAB_QUESTIONS && goes_on; i++)
    goes_on = ask(&questions[i], in, out, answers);
}
