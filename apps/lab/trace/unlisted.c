#include "unlisted.h"

#include <math.h>
#include <stdio.h>

#include "../rig/rigterm.h"
#include "../base/shown.h"
#include "../base/array.h"

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

static int ends_at_zero(const pneu_term *term)
{
  return term->value[0] == 0 && term->value[term->n - 1] == 0;
}

/* Knots first..end-1 that count. A fit that finds anything leaves no knot at exactly 0: at one end alone, such knots
 * lie where no log has been. At both ends they are held there; and more than half of them are the level. */
static void knots_reached(const pneu_term *term, int *first, int *end)
{
  int low = 0, high = term->n;
  while (low < high && term->value[low] == 0)
    low++;
  while (high > low && term->value[high - 1] == 0)
    high--;
  if (ends_at_zero(term) || high - low < term->n / 2 + 1) {
    low = 0;
    high = term->n;
  }
  *first = low;
  *end = high;
}

/* The median of n values. */
static double median(const pneu_real *from, int n)
{
  double value[PNEU_TERM_ROOM];
  int i;
  for (i = 0; i < n; i++)
    value[i] = (double)from[i];
  lab_sort(value, (size_t)n);
  return value[n / 2];
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

static int all_of_cycle(const pneu_term *term, double *from, double *to, double *level, double *peak)
{
  *from = (double)term->from;
  *to = (double)term->to;
  *level = 0;
  *peak = amplitude(term);
  return 0;
}

int lab_unlisted_stretch(const pneu_term *term, double *from, double *to, double *level, double *peak)
{
  const double knot = (double)(term->to - term->from) / (term->n - 1);
  int i, begin, end, first = -1, last = -1;
  if (term->argument == PNEU_TERM_OVER_CYCLE)
    return all_of_cycle(term, from, to, level, peak);
  knots_reached(term, &begin, &end);
  *level = ends_at_zero(term) ? 0 : median(term->value + begin, end - begin);
  *peak = 0;
  for (i = begin; i < end; i++)
    if (fabs((double)term->value[i] - *level) > fabs(*peak))
      *peak = (double)term->value[i] - *level;
  for (i = begin; i < end; i++)
    if (fabs((double)term->value[i] - *level) > active_share * fabs(*peak)) {
      first = first < 0 ? i : first;
      last = i;
    }
  *from = (double)term->from + knot * fmax(first, 0);
  *to = (double)term->from + knot * fmax(last, 0);
  return last - first < (end - begin) / 2;
}

/* In seconds however short: beside a frequency, a factor of 1000 would only disturb. */
static void say_cycle(const pneu_term *term, char text[LAB_WHERE_TEXT])
{
  const double period = (double)(term->to - term->from);
  char seconds[LAB_SHOWN_TEXT], hertz[LAB_SHOWN_TEXT], most[LAB_SHOWN_TEXT];
  snprintf(text, LAB_WHERE_TEXT, "again and again, every %s s (%s Hz); amplitude %s",
           lab_shown_number(period, 3, seconds), lab_shown_number(1 / period, 3, hertz),
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
  is_local = is_short || ends_at_zero(term);
  snprintf(text, LAB_WHERE_TEXT, "%s%s = %s .. %s%s%s%s; largest value %s", is_local ? "" : "nearly everywhere, ",
           argument->key, lab_shown_number(how.scale * from, 3, low), lab_shown_number(how.scale * to, 3, high),
           *how.unit ? " " : "", how.unit, kinds[term->equation].both,
           lab_shown_quantity(peak, equation->unit, 3, most));
  return text;
}
