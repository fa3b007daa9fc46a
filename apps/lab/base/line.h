/* A straight line through values whose standard deviations are known: weighted least squares, point by point.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LINE_H
#define LAB_LINE_H

/* Begins as {0}. */
typedef struct lab_line {
  int n;
  double weight, middle, level; /* sum of weights; weighted means of place and value */
  double xx, xy, yy;            /* weighted sums of squares and products about these */
} lab_line;

/* Add a point.  In: deviation  of `value`, > 0 */
void lab_line_add(lab_line *line, double at, double value, double deviation);

/* Whether there are points at two places at least, without which there is no slope. */
int lab_line_is_there(const lab_line *line);

double lab_line_slope(const lab_line *line);
double lab_line_value(const lab_line *line, double at);

/* Of the values about the line, over their deviations: about 1 if these tell all; 0 where two points show none. */
double lab_line_scatter(const lab_line *line);

/* Half the interval of the slope: by the deviations of the values; by their scatter, with Student's t, where that is
 * wider, so that it holds whether or not the deviations tell all.
 * In:      p  probability that the interval leaves out the truth, 0 < p < 1 */
double lab_line_half(const lab_line *line, double p);

/* Where the line reaches a value, and where the ends of its interval do (E. C. Fieller 1954, J. R. Stat. Soc. B 16,
 * 175).
 * In:      p   as of lab_line_half
 * Out:     at  place, lower end, upper end
 * Returns: 0 if the interval has no end, as the slope may be 0. */
int lab_line_reaches(const lab_line *line, double value, double p, double at[3]);

#endif
