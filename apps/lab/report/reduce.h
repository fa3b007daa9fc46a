/* Long series made short enough to draw, without hiding a peak.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REDUCE_H
#define LAB_REDUCE_H

#include <stddef.h>

typedef struct lab_point {
  double at, value; /* value NaN: the line breaks */
  size_t row;       /* of the series */
} lab_point;

/* The envelope of a series: of the values in each of `columns` equal parts of from..to the lowest and the highest,
 * in the order in which they came. The line breaks where a new run begins and over gaps wider than a fiftieth of
 * the axis and four times what is usual between two values.
 * In:      at, value  n of each, `at` growing, within from..to; a value that is NaN is left out
 *          first      n_runs first rows of runs, growing
 * Out:     point      room for 3 * columns + n_runs entries
 * Returns: their number. */
size_t lab_envelope(const double *at, const double *value, size_t n, const size_t *first, int n_runs, double from,
                    double to, int columns, lab_point *point);

typedef struct lab_bin {
  size_t n;
  double at, mean; /* centre; mean of the values, NaN in an empty bin */
} lab_bin;

/* Means of `value` in n_bins equal parts of from..to of `at`; NaN of either is left out. */
void lab_bin_means(const double *at, const double *value, size_t n, double from, double to, int n_bins, lab_bin *bin);

/* Lowest and highest, NaN left out.  Returns: 0 if there is no value. */
int lab_range(const double *value, size_t n, double *low, double *high);

#endif
