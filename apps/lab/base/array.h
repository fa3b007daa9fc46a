/* What is done to an array of numbers again and again.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ARRAY_H
#define LAB_ARRAY_H

#include <stddef.h>

/* Sum of products; in as many parts as the machine's vectors have places, so that the last digits depend on it. */
double lab_dot(const double *a, const double *b, size_t n);

/* sum[k] += a . (b + k stride), for every one of the columns of b, of n entries each. */
void lab_dots(const double *a, const double *b, size_t stride, int columns, size_t n, double *sum);

/* Take the span of n orthonormal columns, `stride` apart, of m entries out of v; a second time where little is left,
 * for rounding. Returns: length left. */
double lab_project_out(const double *basis, int n, size_t stride, size_t m, double *v);

/* Sort, smallest first; no NaN. */
void lab_sort(double *value, size_t n);

/* Sort, and take the median: of an even number the mean of the two in the middle.
 * In:  n  at least 1 */
double lab_median(double *value, size_t n);

/* Lowest and highest, NaN left out; without any value infinity and its negative.  Returns: 0 if there is none. */
int lab_range(const double *value, size_t n, double *low, double *high);

#endif
