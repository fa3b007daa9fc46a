#include "number.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum {
  FIELD_MAX = 128, /* longest number with its marks */
  EXACT_POWER = 22 /* largest power of ten that a double holds exactly */
};

static const double power_of_ten[EXACT_POWER + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/* Go on from `digits` over the digits at `at`.  Returns: what stands behind them */
static const char *read_digits(const char *at, const char *end, uint64_t *digits)
{
  for (; at < end && (unsigned)(*at - '0') <= 9; at++)
    *digits = 10 * *digits + (unsigned)(*at - '0');
  return at;
}

/* Digits with at most one decimal mark and no exponent, short enough that one division rounds once
 * (Clinger 1990).  Returns: 1, or 0 where the slow way must decide. */
static int read_plain(const char *at, const char *end, char decimal, double *value)
{
  const uint64_t exact = (uint64_t)1 << 53;
  const int negative = *at == '-';
  const char *begin = at + negative, *mark;
  uint64_t digits = 0;
  ptrdiff_t places = 0;
  if (end - begin > 17)
    return 0;
  at = mark = read_digits(begin, end, &digits);
  if (at < end && *at == decimal) {
    at = read_digits(mark + 1, end, &digits);
    places = at - mark - 1;
  }
  if (at < end || mark - begin + places == 0 || digits >= exact)
    return 0;
  *value = places > 0 ? (double)digits / power_of_ten[places] : (double)digits;
  if (negative)
    *value = -*value;
  return 1;
}

/* The number without thousands marks and with a point.  Returns: its length, or 0 if it is too long. */
static size_t tidy(const char *begin, const char *end, char decimal, char thousands, char out[FIELD_MAX])
{
  const char *at, *last = NULL;
  size_t n = 0;
  if (end - begin >= FIELD_MAX)
    return 0;
  for (at = begin; at < end; at++)
    if (*at == decimal)
      last = at;
  for (at = begin; at < end; at++)
    if (*at == decimal && (at == last || decimal != thousands))
      out[n++] = '.';
    else if (*at != thousands)
      out[n++] = *at;
  out[n] = '\0';
  return n;
}

static int read_any(const char *begin, const char *end, char decimal, char thousands, double *value)
{
  char text[FIELD_MAX];
  char *stop;
  size_t n = tidy(begin, end, decimal, thousands, text);
  if (n == 0 || strspn(text, "+-.0123456789eE") != n)
    return LAB_NUMBER_BAD;
  *value = strtod(text, &stop);
  return *stop == '\0' && isfinite(*value) ? LAB_NUMBER_FINITE : LAB_NUMBER_BAD;
}

int lab_number_read(const char *begin, const char *end, char decimal, char thousands, double *value)
{
  while (begin < end && (*begin == ' ' || *begin == '\t'))
    begin++;
  while (begin < end && (end[-1] == ' ' || end[-1] == '\t'))
    end--;
  if (begin == end || (end - begin == 3 && strncasecmp(begin, "nan", 3) == 0)) {
    *value = NAN;
    return LAB_NUMBER_GAP;
  }
  if (!thousands && read_plain(begin, end, decimal, value))
    return LAB_NUMBER_FINITE;
  return read_any(begin, end, decimal, thousands, value);
}

const char *lab_number_write(double value, char *text)
{
  int digits;
  for (digits = 15; digits <= 17; digits++) {
    snprintf(text, LAB_NUMBER_TEXT, "%.*g", digits, value);
    if (strtod(text, NULL) == value)
      break;
  }
  return text;
}
