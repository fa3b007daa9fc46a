/* udunits2.h over the table of table.h. The grammar is that of ut_parse: products are written "m s", "m.s", "m*s" or
 * "m-s", quotients "m/s", powers "s2", "s^2", "s-2" or by raised digits; "K @ 273.15" shifts. SPDX-License-Identifier:
 * MIT */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "table.h"
#include "udunits2.h"

enum { BASES = 7, NAME = 64 };
static const char *const bases[BASES] = {"kg", "m", "s", "K", "A", "mol", "cd"};

struct ut_system {
  int unused;
};
struct ut_unit {
  double scale, offset; /* value in base units = scale value + offset */
  int power[BASES];
};
struct cv_converter {
  double scale, offset;
};

static const ut_unit one = {1, 0, {0}};

ut_error_message_handler *ut_set_error_message_handler(ut_error_message_handler *handler)
{
  return handler;
}

int ut_ignore(const char *format, va_list arguments)
{
  (void)format;
  (void)arguments;
  return 0;
}

ut_system *ut_read_xml(const char *path)
{
  static ut_system units;
  (void)path;
  return &units;
}

char *ut_trim(char *text, ut_encoding encoding)
{
  const size_t begin = strspn(text, " \t\r\n\f\v");
  size_t n = strlen(text + begin);
  (void)encoding;
  memmove(text, text + begin, n + 1);
  while (n > 0 && isspace((unsigned char)text[n - 1]))
    text[--n] = '\0';
  return text;
}

/* ---- Names ---- */

static int is_name(const char *name, int is_symbol, const char *text)
{
  return (is_symbol ? strcmp(name, text) : strcasecmp(name, text)) == 0;
}

static int begins(const char *text, const char *name, int is_symbol)
{
  const size_t n = strlen(name);
  return (is_symbol ? strncmp(text, name, n) : strncasecmp(text, name, n)) == 0;
}

/* "kg.m-1.s-2", of base units; the radian has no dimension. */
static void read_dimension(const char *text, int power[BASES])
{
  memset(power, 0, BASES * sizeof *power);
  while (*text) {
    const size_t n = strcspn(text, ".0123456789-");
    char *end = (char *)text + n;
    const long given = strtol(text + n, &end, 10);
    int i;
    for (i = 0; i < BASES; i++)
      if (strlen(bases[i]) == n && strncmp(bases[i], text, n) == 0)
        power[i] = end == text + n ? 1 : (int)given;
    text = end + (*end == '.');
  }
}

/* Returns: whether the table has it, names before symbols */
static int look_up(const char *name, ut_unit *unit)
{
  int is_symbol, i;
  for (is_symbol = 0; is_symbol < 2; is_symbol++)
    for (i = 0; i < units_row_count; i++) {
      const units_row *row = &units_rows[i];
      if (row->is_symbol == is_symbol && is_name(row->name, is_symbol, name)) {
        unit->scale = row->scale;
        unit->offset = row->offset;
        read_dimension(row->dimension, unit->power);
        return 1;
      }
    }
  return 0;
}

/* The longest prefix with which a text begins, a name before a symbol. */
static const units_prefix *prefix_of(const char *text)
{
  const units_prefix *longest = NULL;
  int is_symbol, i;
  for (is_symbol = 0; is_symbol < 2 && !longest; is_symbol++)
    for (i = 0; i < units_prefix_count; i++) {
      const units_prefix *p = &units_prefixes[i];
      if (p->is_symbol == is_symbol && begins(text, p->name, is_symbol) &&
          (!longest || strlen(p->name) > strlen(longest->name)))
        longest = p;
    }
  return longest;
}

static int find_unit(const char *name, ut_unit *unit)
{
  double scale = 1;
  int symbols = 0;
  while (!look_up(name, unit)) {
    const units_prefix *prefix = prefix_of(name);
    if (!prefix || (prefix->is_symbol && symbols++))
      return 0;
    scale *= prefix->value;
    name += strlen(prefix->name);
  }
  unit->scale *= scale;
  return 1;
}

/* ---- The grammar ---- */

static int parse_shift(const char **at, ut_unit *unit);

static void multiply(ut_unit *a, const ut_unit *b, int power)
{
  int i;
  a->scale *= pow(b->scale, power);
  a->offset = 0;
  for (i = 0; i < BASES; i++)
    a->power[i] += power * b->power[i];
}

static const char *skip_blanks(const char *at)
{
  return at + strspn(at, " \t");
}

/* A letter, or a byte of a character beyond ASCII that is neither a raised digit nor the dot of a product. */
static int is_letter(const char *at)
{
  const unsigned char c = (unsigned char)*at;
  if (c < 0x80)
    return isalpha(c) || c == '_' || c == '%' || c == '\'' || c == '"';
  return strncmp(at, "\xC2\xB2", 2) != 0 && strncmp(at, "\xC2\xB3", 2) != 0 && strncmp(at, "\xC2\xB9", 2) != 0 &&
         strncmp(at, "\xC2\xB7", 2) != 0 && strncmp(at, "\xE2\x81", 2) != 0;
}

/* A name ends with a letter; digits may stand within.  Returns: its length */
static size_t name_length(const char *at)
{
  size_t n = 0, i;
  for (i = 0; is_letter(at + i) || (i > 0 && isdigit((unsigned char)at[i])); i++) {
    if (!at[i])
      break;
    if (is_letter(at + i))
      n = i + 1;
  }
  return n;
}

static int parse_name(const char **at, ut_unit *unit)
{
  const size_t n = name_length(*at);
  char name[NAME];
  if (n == 0 || n >= NAME)
    return 0;
  memcpy(name, *at, n);
  name[n] = '\0';
  *at += n;
  return find_unit(name, unit);
}

static int parse_basic(const char **at, ut_unit *unit)
{
  char *end;
  if (**at == '(') {
    (*at)++;
    if (!parse_shift(at, unit))
      return 0;
    *at = skip_blanks(*at);
    return *(*at)++ == ')';
  }
  if (is_letter(*at))
    return parse_name(at, unit);
  if (!isdigit((unsigned char)(*at)[strspn(*at, "+-.")]))
    return 0;
  *unit = one;
  unit->scale = strtod(*at, &end);
  *at = end;
  return unit->scale != 0;
}

/* Raised digits: the bytes after a sign of its own.  Returns: whether there were some */
static int parse_raised(const char **at, int *power)
{
  static const char *const digits[] = {"\xE2\x81\xB0", "\xC2\xB9",     "\xC2\xB2",     "\xC2\xB3",     "\xE2\x81\xB4",
                                       "\xE2\x81\xB5", "\xE2\x81\xB6", "\xE2\x81\xB7", "\xE2\x81\xB8", "\xE2\x81\xB9"};
  const int negative = strncmp(*at, "\xE2\x81\xBB", 3) == 0;
  int value = 0, i, seen = 0;
  *at += negative ? 3 : 0;
  for (i = 0; i < 10; i++)
    if (strncmp(*at, digits[i], strlen(digits[i])) == 0) {
      value = 10 * value + i;
      *at += strlen(digits[i]);
      seen = 1;
      i = -1;
    }
  *power = negative ? -value : value;
  return seen;
}

/* Returns: whether there is a power */
static int parse_power(const char **at, int *power)
{
  const char *from = *at;
  char *end;
  if (parse_raised(at, power))
    return 1;
  from += *from == '^' ? 1 : strncmp(from, "**", 2) == 0 ? 2 : 0;
  if (!isdigit((unsigned char)from[*from == '-' || *from == '+']))
    return 0;
  *power = (int)strtol(from, &end, 10);
  *at = end;
  return abs(*power) < 256;
}

static int parse_factor(const char **at, ut_unit *unit)
{
  ut_unit basic;
  int power = 1;
  if (!parse_basic(at, &basic))
    return 0;
  *unit = basic;
  if (parse_power(at, &power)) {
    *unit = one;
    multiply(unit, &basic, power);
  }
  return 1;
}

/* A mark between factors.  Returns: 1 of a product, -1 of a quotient, 0: none */
static int parse_mark(const char **at)
{
  const char *mark = skip_blanks(*at);
  const int blank = mark > *at;
  if (*mark == '/' || (strncasecmp(mark, "per", 3) == 0 && isspace((unsigned char)mark[3]))) {
    *at = skip_blanks(mark + (*mark == '/' ? 1 : 3));
    return -1;
  }
  if (strchr("@)", *mark))
    return 0;
  if (strncmp(mark, "\xC2\xB7", 2) == 0)
    mark += 2;
  else if (strchr(".*-", *mark))
    mark++;
  else if (!blank && *mark != '(' && !is_letter(mark))
    return 0;
  *at = skip_blanks(mark);
  return 1;
}

static int parse_product(const char **at, ut_unit *unit)
{
  int sign;
  if (!parse_factor(at, unit))
    return 0;
  while (**at && (sign = parse_mark(at)) != 0) {
    ut_unit factor;
    if (!parse_factor(at, &factor))
      return 0;
    multiply(unit, &factor, sign);
  }
  return 1;
}

static int parse_shift(const char **at, ut_unit *unit)
{
  const char *mark;
  char *end;
  *at = skip_blanks(*at);
  if (!parse_product(at, unit))
    return 0;
  mark = skip_blanks(*at);
  if (*mark != '@')
    return 1;
  unit->offset += unit->scale * strtod(mark + 1, &end);
  *at = end;
  return end > mark + 1;
}

ut_unit *ut_parse(const ut_system *units, const char *text, ut_encoding encoding)
{
  ut_unit *unit = malloc(sizeof *unit);
  (void)units;
  (void)encoding;
  if (unit)
    *unit = one;
  if (unit && (!*text || parse_shift(&text, unit)) && !*skip_blanks(text))
    return unit;
  free(unit);
  return NULL;
}

void ut_free(ut_unit *unit)
{
  free(unit);
}

int ut_format(const ut_unit *unit, char *text, size_t size, unsigned options)
{
  size_t n = 0;
  int i, first = 1;
  (void)options;
  text[0] = '\0';
  if (unit->scale != 1)
    n += (size_t)snprintf(text, size, "%.15g", unit->scale);
  for (i = 0; i < BASES && n < size; i++) {
    if (unit->power[i] == 0)
      continue;
    n += (size_t)snprintf(text + n, size - n, "%s%s", !first ? "." : n > 0 ? " " : "", bases[i]);
    first = 0;
    if (unit->power[i] != 1 && n < size)
      n += (size_t)snprintf(text + n, size - n, "%d", unit->power[i]);
  }
  if (n == 0)
    n = (size_t)snprintf(text, size, "1");
  if (unit->offset != 0 && n < size)
    n += (size_t)snprintf(text + n, size - n, " @ %.15g", unit->offset / unit->scale);
  return n < size ? (int)n : -1;
}

/* ---- Values ---- */

int ut_are_convertible(const ut_unit *a, const ut_unit *b)
{
  return memcmp(a->power, b->power, sizeof a->power) == 0;
}

cv_converter *ut_get_converter(ut_unit *from, ut_unit *to)
{
  cv_converter *converter = ut_are_convertible(from, to) ? malloc(sizeof *converter) : NULL;
  if (converter) {
    converter->scale = from->scale / to->scale;
    converter->offset = (from->offset - to->offset) / to->scale;
  }
  return converter;
}

double cv_convert_double(const cv_converter *converter, double value)
{
  return converter->scale * value + converter->offset;
}

void cv_free(cv_converter *converter)
{
  free(converter);
}
