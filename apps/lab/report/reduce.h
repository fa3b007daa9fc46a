/* Long series made short enough to draw, without hiding a peak.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REDUCE_H
#define LAB_REDUCE_H

#include <stddef.h>

typedef struct lab_point {
  double at, value; /* value NaN: the line breaks */
  size_t row;       /* of the series */
} lab_point;

/* A series to draw. */
typedef struct lab_line {
  size_t n;
  const double *at, *value; /* `at` growing; a value that is NaN is left out */
  int n_runs;
  const size_t *first; /* rows of the runs, growing */
} lab_line;

/* The envelope of a series: of the values in each of `columns` equal parts of its axis the lowest and the highest,
 * in the order in which they came. The line breaks where a new run begins and over gaps wider than a fiftieth of
 * the axis and four times what is usual between two values.
 * Out:     point  room for 3 * columns + n_runs entries
 * Returns: their number. */
size_t lab_envelope(const lab_line *line, int columns, lab_point *point);

typedef struct lab_bin {
  size_t n;
  double mean; /* of the values, NaN in an empty bin */
} lab_bin;

/* Means of `value` in n_bins equal parts of from..to of `at`; NaN of either is left out. */
void lab_bin_means(const double *at, const double *value, size_t n, double from, double to, int n_bins, lab_bin *bin);

#endif
