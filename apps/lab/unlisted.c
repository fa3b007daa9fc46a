#include "unlisted.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "rigterm.h"
#include "shown.h"

static const double active_share = 0.15; /* of the largest departure: knots below it are not where the term acts */

static const struct {
  const char *equation, *what, *both;
} kinds[PNEU_TERM_EQUATION_COUNT] = {{"mass", "a change of the supply pressure", ""},
                                     {"force", "a force on the stem", ""},
                                     {"force", "dry friction", ", both directions"},
                                     {"mass", "a flow into or out of the chamber", ""},
                                     {"energy", "heat into the gas", ""},
                                     {"sensor", "an error of the pressure sensor", ""},
                                     {"sensor", "an error of the position sensor", ""}};

const char *lab_unlisted_equation(const pneu_term *term)
{
  return kinds[term->equation].equation;
}

const char *lab_unlisted_what(const pneu_term *term)
{
  return kinds[term->equation].what;
}

static int ascending(const void *x, const void *y)
{
  const double a = *(const double *)x, b = *(const double *)y;
  return (a > b) - (a < b);
}

/* The median of the knots. */
static double base_level(const pneu_term *term)
{
  double value[PNEU_TERM_ROOM];
  int i;
  for (i = 0; i < term->n; i++)
    value[i] = (double)term->value[i];
  qsort(value, (size_t)term->n, sizeof *value, ascending);
  return value[term->n / 2];
}

int lab_unlisted_stretch(const pneu_term *term, double *from, double *to, double *level, double *peak)
{
  const double knot = (double)(term->to - term->from) / (term->n - 1);
  int i, first = -1, last = -1;
  *level = term->value[0] == 0 && term->value[term->n - 1] == 0 ? 0 : base_level(term);
  *peak = 0;
  for (i = 0; i < term->n; i++)
    if (fabs((double)term->value[i] - *level) > fabs(*peak))
      *peak = (double)term->value[i] - *level;
  for (i = 0; i < term->n; i++)
    if (fabs((double)term->value[i] - *level) > active_share * fabs(*peak)) {
      first = first < 0 ? i : first;
      last = i;
    }
  *from = (double)term->from + knot * fmax(first, 0);
  *to = (double)term->from + knot * fmax(last, 0);
  return last - first < term->n / 2;
}

/* Largest amplitude of a cycle. */
static double amplitude(const pneu_term *term)
{
  double most = 0;
  int i;
  for (i = 0; i + 1 < term->n; i += 2)
    most = fmax(most, hypot((double)term->value[i], (double)term->value[i + 1]));
  return most;
}

static void say_cycle(const pneu_term *term, char text[LAB_WHERE_TEXT])
{
  const double period = (double)(term->to - term->from);
  char seconds[LAB_SHOWN_TEXT], hertz[LAB_SHOWN_TEXT], most[LAB_SHOWN_TEXT];
  snprintf(text, LAB_WHERE_TEXT, "again and again, every %s (%s); amplitude %s",
           lab_shown_quantity(period, "s", 4, seconds), lab_shown_quantity(1 / period, "Hz", 4, hertz),
           lab_shown_quantity(amplitude(term), lab_term_equations[term->equation].unit, 3, most));
}

const char *lab_unlisted_where(const pneu_term *term, char text[LAB_WHERE_TEXT])
{
  const lab_term_word *argument = &lab_term_arguments[term->argument], *equation = &lab_term_equations[term->equation];
  const lab_shown how = lab_shown_as(argument->unit);
  char low[LAB_SHOWN_TEXT], high[LAB_SHOWN_TEXT], most[LAB_SHOWN_TEXT];
  double from, to, level, peak;
  int is_short, is_local;
  if (term->argument == PNEU_TERM_OVER_CYCLE) {
    say_cycle(term, text);
    return text;
  }
  is_short = lab_unlisted_stretch(term, &from, &to, &level, &peak);
  is_local = is_short || (term->value[0] == 0 && term->value[term->n - 1] == 0);
  snprintf(text, LAB_WHERE_TEXT, "%s%s = %s .. %s %s%s; largest value %s", is_local ? "" : "nearly everywhere, ",
           argument->key, lab_shown_number(how.scale * from, 3, low), lab_shown_number(how.scale * to, 3, high),
           how.unit, kinds[term->equation].both, lab_shown_quantity(peak, equation->unit, 3, most));
  return text;
}
