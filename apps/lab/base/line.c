#include "line.h"

#include <math.h>

#include "quantile.h"

/* Means are updated and sums taken about them (B. P. Welford 1962, Technometrics 4, 419): dates are large beside their
 * differences. */
void lab_line_add(lab_line *line, double at, double value, double deviation)
{
  const double weight = 1 / (deviation * deviation), dx = at - line->middle, dy = value - line->level;
  line->n++;
  line->weight += weight;
  line->middle += weight / line->weight * dx;
  line->level += weight / line->weight * dy;
  line->xx += weight * dx * (at - line->middle);
  line->xy += weight * dx * (value - line->level);
  line->yy += weight * dy * (value - line->level);
}

int lab_line_is_there(const lab_line *line)
{
  return line->xx > 0;
}

double lab_line_slope(const lab_line *line)
{
  return line->xy / line->xx;
}

double lab_line_value(const lab_line *line, double at)
{
  return line->level + lab_line_slope(line) * (at - line->middle);
}

double lab_line_scatter(const lab_line *line)
{
  return line->n > 2 ? sqrt(fmax(line->yy - line->xy * lab_line_slope(line), 0) / (line->n - 2)) : 0;
}

/* Half an interval, in deviations. */
static double width(const lab_line *line, double p)
{
  const double normal = lab_student_quantile(1 - 0.5 * p, HUGE_VAL);
  return line->n < 3 ? normal : fmax(normal, lab_line_scatter(line) * lab_student_quantile(1 - 0.5 * p, line->n - 2));
}

double lab_line_half(const lab_line *line, double p)
{
  return width(line, p) / sqrt(line->xx);
}

int lab_line_reaches(const lab_line *line, double value, double p, double at[3])
{
  /* about the middle: (level + slope x - value)^2 <= width^2 (1/weight + x^2/xx) is a x^2 + 2 b x + c <= 0 */
  const double slope = lab_line_slope(line), off = line->level - value, square = pow(width(line, p), 2);
  const double a = slope * slope - square / line->xx, b = slope * off, c = off * off - square / line->weight;
  const double root = sqrt(fmax(b * b - a * c, 0));
  if (a <= 0)
    return 0;
  at[0] = line->middle - off / slope;
  at[1] = line->middle + (-b - root) / a;
  at[2] = line->middle + (-b + root) / a;
  return 1;
}
