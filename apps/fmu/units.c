#include "units.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const fmu_base_names[FMU_BASE_COUNT] = {"kg", "m", "s", "K"};

static const struct {
  const char *symbol;
  int exponent[FMU_BASE_COUNT];
} symbols[] = {
    {"1", {0, 0, 0, 0}},  {"kg", {1, 0, 0, 0}},   {"m", {0, 1, 0, 0}},  {"s", {0, 0, 1, 0}},  {"K", {0, 0, 0, 1}},
    {"N", {1, 1, -2, 0}}, {"Pa", {1, -1, -2, 0}}, {"J", {1, 2, -2, 0}}, {"W", {1, 2, -3, 0}},
};
enum { SYMBOLS = sizeof symbols / sizeof symbols[0] };

static const int *symbol_at(const char *text, size_t length)
{
  int i;
  for (i = 0; i < SYMBOLS; i++)
    if (strlen(symbols[i].symbol) == length && strncmp(text, symbols[i].symbol, length) == 0)
      return symbols[i].exponent;
  return NULL;
}

/* The power behind a symbol: "2" of "m2", or "^1.5", the only form with a fraction; 1 where there is none. */
static double power_at(const char **text)
{
  char *end;
  double power = 1;
  if (**text == '^') {
    power = strtod(*text + 1, &end);
    *text = end;
  } else if (**text >= '0' && **text <= '9') {
    power = (double)strtol(*text, &end, 10);
    *text = end;
  }
  return power;
}

int fmu_unit_exponents(const char *unit, int exponent[FMU_BASE_COUNT])
{
  double sum[FMU_BASE_COUNT] = {0}, sign = 1;
  int i;
  while (*unit) {
    const size_t length = *unit == '1' ? 1 : strcspn(unit, "./^0123456789");
    const int *base = symbol_at(unit, length);
    double power;
    if (!base)
      return 0;
    unit += length;
    power = sign * power_at(&unit);
    for (i = 0; i < FMU_BASE_COUNT; i++)
      sum[i] += power * base[i];
    sign = *unit == '/' ? -1 : 1;
    unit += *unit != '\0';
  }
  for (i = 0; i < FMU_BASE_COUNT; i++) {
    if (sum[i] != floor(sum[i]))
      return 0;
    exponent[i] = (int)sum[i];
  }
  return 1;
}
