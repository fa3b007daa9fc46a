/* Counts and what they tell.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_STATS_H
#define BLIND_STATS_H

/* Hits among tries. */
typedef struct blind_count {
  int k, n;
} blind_count;

/* 95 % interval of a probability: Wilson 1927, J. Am. Stat. Assoc. 22:209. No tries: 0 to 1. */
void blind_wilson(blind_count count, double *low, double *high);

/* Value below which the share q of n > 0 values lies, between them by straight lines; sorts the values. */
double blind_quantile(double *value, int n, double q);

/* Smallest size from which on an effect is found at least nine times in ten: isotonic regression of found (0 or 1) on
 * size (Barlow et al. 1972, min-max formula); sorts by size.
 * Returns: NaN where nine in ten is not reached by the last three trials. */
typedef struct blind_sized {
  double size;
  int found;
} blind_sized;
double blind_nine_in_ten(blind_sized *trial, int n);

#endif
