#include "format.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "names.h"
#include "text.h"

/* SI as in pneu_param_describe and lab_channels, and what engineers say. */
static const struct {
  const char *si;
  lab_format shown;
} units[] = {
    {"1", {1, ""}},
    {"s", {1e3, "ms"}},
    {"Pa", {1e-3, "kPa"}},
    {"m", {1e3, "mm"}},
    {"m2", {1e6, "mm²"}},
    {"m3", {1e6, "cm³"}},
    {"m/s", {1e3, "mm/s"}},
    {"N/m", {1e-3, "N/mm"}},
    {"N.s/m", {1, "N·s/m"}},
    {"m/N", {1e6, "mm/kN"}},
    {"N/m3", {1e-9, "N/mm³"}},
    {"J/kg/K", {1, "J/(kg·K)"}},
    {"Pa.s/kg", {1, "Pa·s/kg"}},
    {"W/K^1.333333333333333", {1, "W/K^(4/3)"}},
};

lab_format lab_format_as(const char *unit)
{
  const int i = lab_name_index(unit, units, sizeof units / sizeof *units, sizeof *units);
  return i < 0 ? (lab_format){1, unit} : units[i].shown;
}

const char *lab_format_number(double value, int digits, char text[LAB_FORMAT_TEXT])
{
  const double size = fabs(value);
  char rounded[LAB_FORMAT_TEXT];
  int power;
  if (!isfinite(value))
    return strcpy(text, "-");
  snprintf(rounded, sizeof rounded, "%.*e", digits - 1, value);
  power = atoi(strchr(rounded, 'e') + 1);
  if (size == 0)
    strcpy(text, "0");
  else if (power < -4 || power > 6)
    snprintf(text, LAB_FORMAT_TEXT, "%.*ge%d", digits, strtod(rounded, NULL) / pow(10, power), power);
  else
    snprintf(text, LAB_FORMAT_TEXT, "%.*f", power < digits - 1 ? digits - 1 - power : 0, strtod(rounded, NULL));
  return text;
}

const char *lab_format_quantity(double value, const char *unit, int digits, char text[LAB_FORMAT_TEXT])
{
  const lab_format shown = lab_format_as(unit);
  lab_format_number(value * shown.scale, digits, text);
  if (*shown.unit)
    lab_append(text, LAB_FORMAT_TEXT, " %s", shown.unit);
  return text;
}

const char *lab_format_brief(double value, const char *unit, char text[LAB_FORMAT_TEXT])
{
  const lab_format shown = lab_format_as(unit);
  snprintf(text, LAB_FORMAT_TEXT, "%.4g %s", shown.scale * value, shown.unit);
  return text;
}

const char *lab_format_p(double p, char text[LAB_FORMAT_TEXT])
{
  if (p < 1e-300)
    return strcpy(text, "below 1e-300");
  return lab_format_number(p, 2, text);
}
