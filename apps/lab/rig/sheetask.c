#include "sheetask.h"

#include <string.h>

#include "../base/text.h"
#include "actuators.h"

static const struct question {
  const char *key, *words;
} questions[] = {
    {"actuator", "Actuator by maker, type and size, if the catalogue has it (fisher-657-40)"},
    {"bench_set", "Bench set: pressures at which the stem begins and ends its stroke (0.2..1.0 bar)"},
    {"stroke", "Stroke (20 mm)"},
    {"area", "Effective area of the diaphragm (400 cm2)"},
    {"dead_volume", "Volume of the empty chamber, with tubes (0.3 dm3)"},
    {"moving_mass", "Mass of stem, plate and plug (5 kg)"},
    {"supply", "Supply pressure, gauge (4 bar)"},
    {"Kv", "Kv of what fills and vents the chamber [m3/h] (0.1)"},
};

/* Whether an answer is one that a draft takes. */
static int is_good(const char *key, const char *value, const char *text, lab_error *error)
{
  lab_sheet_word word[2];
  int n;
  if (strcmp(key, "actuator") == 0)
    return lab_actuator_find(value, error) != NULL;
  return lab_sheet_word_read(text, word, &n, error) == LAB_OK;
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
    if (is_good(q->key, value, text, &error))
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
