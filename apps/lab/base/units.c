#include "units.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

/* Loaded once and kept to the end of the program. */
static ut_system *unit_system(void)
{
  static ut_system *units;
  if (!units) {
    ut_set_error_message_handler(ut_ignore);
    units = ut_read_xml(NULL);
  }
  return units;
}

/* UDUNITS reads "m^0.5" as m^0 times 0.5: powers must be whole numbers. */
static int has_broken_power(const char *text)
{
  const char *power = strchr(text, '^');
  while (power) {
    const char *after = power + 1 + strspn(power + 1, "+-0123456789");
    if (*after == '.')
      return 1;
    power = strchr(power + 1, '^');
  }
  return 0;
}

/* Out: unit, to be freed with ut_free. */
static int parse(const char *text, ut_unit **unit, lab_error *error)
{
  char trimmed[LAB_UNIT_TEXT];
  if (!unit_system())
    return lab_fail(error, LAB_WORLD, "the unit database of UDUNITS-2 cannot be read; is libudunits2-data installed?");
  snprintf(trimmed, sizeof trimmed, "%s", text);
  ut_trim(trimmed, UT_UTF8);
  *unit = *trimmed && !has_broken_power(trimmed) ? ut_parse(unit_system(), trimmed, UT_UTF8) : NULL;
  return *unit ? LAB_OK : lab_fail(error, LAB_DATA, "unknown unit \"%s\"", text);
}

/* "kN/m" -> "kg.s-2", to show a dimension. */
static void dimension(const ut_unit *unit, char text[LAB_UNIT_TEXT])
{
  if (ut_format(unit, text, LAB_UNIT_TEXT, UT_ASCII | UT_DEFINITION) < 0)
    snprintf(text, LAB_UNIT_TEXT, "?");
}

static int wrong_dimension(const char *from, const ut_unit *have, const char *to, const ut_unit *want, lab_error *error)
{
  char found[LAB_UNIT_TEXT], expected[LAB_UNIT_TEXT];
  dimension(have, found);
  dimension(want, expected);
  return lab_fail(error, LAB_DATA, "expected a unit like %s (%s), found \"%s\" (%s)", to, expected, from, found);
}

/* Three points tell a line from a logarithm; far ones keep the digits of a scale beside an offset. */
static int line_of(const cv_converter *converter, double *scale, double *offset)
{
  const double far = 1048576;
  double below = cv_convert_double(converter, -far), above = cv_convert_double(converter, far);
  *offset = cv_convert_double(converter, 0.0);
  *scale = *offset == 0 ? cv_convert_double(converter, 1.0) : (above - below) / (2 * far);
  return isfinite(*scale) && *scale != 0 && fabs(above - (*offset + *scale * far)) <= 1e-9 * fabs(*scale) * far;
}

static int factor(const char *from, const ut_unit *have, const char *to, const ut_unit *want, double *scale,
                  double *offset, lab_error *error)
{
  cv_converter *converter;
  int straight;
  if (!ut_are_convertible(have, want))
    return wrong_dimension(from, have, to, want, error);
  converter = ut_get_converter((ut_unit *)have, (ut_unit *)want);
  straight = converter && line_of(converter, scale, offset);
  cv_free(converter);
  return straight ? LAB_OK : lab_fail(error, LAB_DATA, "no straight line leads from the unit \"%s\" to %s", from, to);
}

int lab_unit_factor(const char *from, const char *to, double *scale, double *offset, lab_error *error)
{
  ut_unit *have = NULL, *want = NULL;
  int status;
  *scale = 1;
  *offset = 0;
  if (strcmp(from, to) == 0)
    return LAB_OK;
  status = parse(to, &want, error);
  if (status == LAB_DATA)
    return lab_fail(error, status, "expected the unit %s, found \"%s\"", to, from);
  if (status == LAB_OK)
    status = parse(from, &have, error);
  if (status == LAB_OK)
    status = factor(from, have, to, want, scale, offset, error);
  else if (status == LAB_DATA)
    lab_fail(error, status, "expected a unit like %s, found the unknown unit \"%s\"", to, from);
  ut_free(have);
  ut_free(want);
  return status;
}

int lab_unit_dimension(const char *unit, char text[LAB_UNIT_TEXT], lab_error *error)
{
  ut_unit *parsed = NULL;
  if (parse(unit, &parsed, error))
    return error->status;
  dimension(parsed, text);
  ut_free(parsed);
  return LAB_OK;
}

int lab_unit_is_word(const char *word, const char *other)
{
  while (*word && tolower((unsigned char)*word) == *other)
    word++, other++;
  return !*word && !*other;
}

const char *lab_unit_of_pressure(const char *word, int *absolute)
{
  static const struct {
    const char *word, *unit;
    int absolute;
  } words[] = {{"barg", "bar", 0},   {"bar g", "bar", 0},   {"bar(g)", "bar", 0},  {"bara", "bar", 1},
               {"bar a", "bar", 1},  {"bar(a)", "bar", 1},  {"bar abs", "bar", 1}, {"mbarg", "mbar", 0},
               {"mbara", "mbar", 1}, {"kpag", "kPa", 0},    {"kpa(g)", "kPa", 0},  {"kpaa", "kPa", 1},
               {"kpa(a)", "kPa", 1}, {"kpa abs", "kPa", 1}, {"psig", "psi", 0},    {"psi(g)", "psi", 0},
               {"psia", "psi", 1},   {"psi(a)", "psi", 1}};
  size_t i;
  for (i = 0; i < sizeof words / sizeof *words; i++)
    if (lab_unit_is_word(word, words[i].word)) {
      *absolute = words[i].absolute;
      return words[i].unit;
    }
  return NULL;
}

/* What follows a number: "/4 in" makes 1 a quarter. */
static const char *take_fraction(const char *text, double *number)
{
  char *end;
  double below;
  if (text[0] != '/' || !isdigit((unsigned char)text[1]))
    return text;
  below = strtod(text + 1, &end);
  if (!(below > 0) || !isfinite(below))
    return text;
  *number /= below;
  return end;
}

/* The number in front of a quantity.  Returns: where the unit begins, or NULL without a decimal number. */
static const char *leading_number(const char *text, double *number)
{
  char *end;
  const char *unit, *digit = text + strspn(text, " \t");
  digit += *digit == '+' || *digit == '-';
  if (!isdigit((unsigned char)*digit) && *digit != '.')
    return NULL;
  if (digit[0] == '0' && tolower((unsigned char)digit[1]) == 'x')
    return NULL;
  *number = strtod(text, &end);
  if (end <= digit || !isfinite(*number))
    return NULL;
  unit = take_fraction(end, number);
  return unit + strspn(unit, " \t");
}

/* A value without the rounding of a change of unit: 40 cm^3 are 4e-05 m3 and not 4.000000000000001e-05. */
static double tidied(double value)
{
  char text[32];
  snprintf(text, sizeof text, "%.15g", value);
  return strtod(text, NULL);
}

static int quantity(const char *text, const char *unit, int difference, double *value, lab_error *error)
{
  double number, scale, offset;
  const char *given = leading_number(text, &number), *plain;
  int status, absolute = 0;
  if (!given)
    return lab_fail(error, LAB_DATA, "expected a number and a unit like %s, found \"%s\"", unit, text);
  plain = lab_unit_of_pressure(given, &absolute);
  given = plain && !absolute ? plain : given;
  status = lab_unit_factor(*given ? given : unit, unit, &scale, &offset, error);
  if (status == LAB_OK) {
    *value = scale * number + (difference ? 0 : offset);
    if (*value != number)
      *value = tidied(*value);
  }
  return status;
}

int lab_quantity(const char *text, const char *unit, double *value, lab_error *error)
{
  return quantity(text, unit, 0, value, error);
}

int lab_quantity_difference(const char *text, const char *unit, double *value, lab_error *error)
{
  return quantity(text, unit, 1, value, error);
}
