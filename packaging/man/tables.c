/* The tables in the pages of the manual, in mdoc, from the lists that library and programs themselves use.
 *   tables NAME     for the line "@TABLE NAME" of a page
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include "../../apps/lab/rig/rigkeys.h"

/* Text as roff takes it: some characters are others in print, and a point within a line ends no sentence. */
static void put(const char *text)
{
  static const struct {
    char plain;
    const char *roff;
  } special[] = {{'-', "\\-"}, {'\\', "\\e"}, {'^', "\\(ha"}, {'~', "\\(ti"}, {'`', "\\(ga"}, {'\'', "\\(aq"}};
  size_t i;
  for (; *text; text++) {
    for (i = 0; i < sizeof special / sizeof *special && special[i].plain != *text; i++)
      ;
    if (i < sizeof special / sizeof *special)
      fputs(special[i].roff, stdout);
    else
      putchar(*text);
    if (*text == '.' && text[1] == ' ')
      fputs("\\&", stdout);
  }
}

/* Nothing for a plain number. */
static const char *unit_of(const pneu_param_info *info)
{
  return strcmp(info->unit, "1") ? info->unit : "";
}

static void put_quantity(const char *before, double value, const pneu_param_info *info)
{
  char text[64];
  snprintf(text, sizeof text, "%.6g%s%s", value, *unit_of(info) ? " " : "", unit_of(info));
  fputs(before, stdout);
  put(text);
}

/* Meaning, default and bounds: the lines below an item. */
static void put_parameter(const pneu_param_info *info, const char *what_value, double value)
{
  put(info->meaning);
  fputs(".\n", stdout);
  put_quantity(what_value, value, info);
  put_quantity("; ", (double)info->lower, info);
  put_quantity(" to ", (double)info->upper, info);
  fputs(".\n", stdout);
}

/* The parameters of a group of the rig file. */
static int group(const char *name)
{
  int i, n = 0;
  for (i = 0; i < lab_key_count; i++) {
    pneu_param_info info;
    if (strcmp(lab_keys[i].group, name) || lab_keys[i].kind != LAB_KEY_PARAM)
      continue;
    if (n++ == 0)
      puts(".Bl -tag -width Ds -compact");
    printf(".It Ic %s\n", lab_keys[i].key);
    pneu_param_describe(lab_keys[i].param, &info);
    put_parameter(&info, "Default ", (double)info.value);
  }
  if (n)
    puts(".El");
  return n;
}

/* The keys of the positioner's group. */
static int positioner(void)
{
  int i, first = pneu_param_find("positioner.gain"), count;
  pneu_effect_params(pneu_effect_of(first), &count);
  puts(".Bl -tag -width Ds -compact");
  for (i = first; i < first + count; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    printf(".It Ic %s\n", info.name);
    put_parameter(&info, "Default ", (double)info.value);
  }
  puts(".El");
  return count;
}

static void effect(int i)
{
  const pneu_effect *e = pneu_effect_at(i);
  int k, count, first = pneu_effect_params(i, &count);
  printf(".It Ic %s\n", e->name);
  put(e->what);
  fputs("\nEquation: ", stdout);
  put(e->equation);
  fputs(".\nIts absence shows as: ", stdout);
  put(e->footprint);
  fputs(".\nSource: ", stdout);
  put(e->source);
  fputs(".\n.Bl -tag -width Ds -compact\n", stdout);
  for (k = 0; k < count; k++) {
    pneu_param_info info;
    pneu_param_describe(first + k, &info);
    printf(".It Ic %s\n", info.name);
    put_parameter(&info, info.shape ? "A shape; usually " : "Usually ", (double)info.value);
    put_quantity("Neutral: ", (double)info.neutral, &info);
    fputs(".\n", stdout);
  }
  puts(".El");
}

static int effects(void)
{
  int i;
  puts(".Bl -tag -width Ds");
  for (i = 0; i < PNEU_EFFECT_COUNT; i++)
    effect(i);
  puts(".El");
  return PNEU_EFFECT_COUNT;
}

/* A list of words: in a file, with a unit, what they mean. */
typedef struct word {
  const char *key, *unit, *text;
} word;

static const word gases[] = {
#define X(name, key, text) {key, "", text},
    PNEU_GAS_LIST(X)
#undef X
};

static const word flows[] = {
#define X(name, key, text) {key, "", text},
    PNEU_FLOW_LIST(X)
#undef X
};

static const word equations[] = {
#define X(name, key, unit, text) {key, unit, text},
    PNEU_TERM_EQUATION_LIST(X)
#undef X
};

static const word arguments[] = {
#define X(name, key, unit, text) {key, unit, text},
    PNEU_TERM_ARGUMENT_LIST(X)
#undef X
};

static const word channels[] = {
#define X(name, key, unit, quantity, meaning) {key, unit, meaning},
    LAB_CHANNEL_LIST(X)
#undef X
};

static const word statuses[] = {
#define X(name, code, text) {#name, "", text},
    PNEU_STATUS_LIST(X)
#undef X
};

#define WORDS(name)                                                                                                    \
  {                                                                                                                    \
#name, name, sizeof name / sizeof *name                                                                            \
  }
static const struct {
  const char *name;
  const word *row;
  size_t n;
} lists[] = {WORDS(gases), WORDS(flows), WORDS(equations), WORDS(arguments), WORDS(channels), WORDS(statuses)};

static int list(const char *name)
{
  size_t i, k;
  for (i = 0; i < sizeof lists / sizeof *lists; i++) {
    if (strcmp(lists[i].name, name))
      continue;
    puts(".Bl -tag -width Ds -compact");
    for (k = 0; k < lists[i].n; k++) {
      const word *w = &lists[i].row[k];
      fputs(".It Ic ", stdout);
      put(w->key);
      if (*w->unit)
        printf(" Bq \\&%s", w->unit); /* "Pa" is a macro too */
      putchar('\n');
      put(w->text);
      fputs(".\n", stdout);
    }
    puts(".El");
    return 1;
  }
  return 0;
}

int main(int argc, char **argv)
{
  const char *name = argc == 2 ? argv[1] : "";
  if ((strcmp(name, "effects") == 0 ? effects() : 0) || (strcmp(name, "positioner") == 0 ? positioner() : 0) ||
      list(name) || group(name))
    return 0;
  fprintf(stderr, "tables: no table \"%s\"\n", name);
  return 1;
}
