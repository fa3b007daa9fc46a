/* When a change, or what was found, begins within a log.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ONSET_H
#define LAB_ONSET_H

#include "score.h"

/* An instant [s of the log], with its 95 % interval. */
typedef struct lab_onset {
  int known; /* 0: there is none, and it acts from the first row, or to the last */
  double t, low, high;
} lab_onset;

enum { LAB_ONSET_PLACES = 8 }; /* stretches of a run between which a change may begin or end, at first sight */

/* Find when a change begins, and fit again, until it stays where it is; what is found begins between rows.
 * In:      anywhere  0: near where it is
 * In/out, Out, Returns: as lab_onset_find */
int lab_onset_settle(lab_unknowns *u, int change, int anywhere, double *chi2, lab_onset *begin, lab_error *error);

/* Where that is no worse, let a change act throughout.
 * In/out, Out, Returns: as lab_onset_find */
int lab_onset_extend(lab_unknowns *u, int change, double level, double *chi2, lab_onset *begin, lab_error *error);

/* Settle, then extend.
 * In:      change  place of a fitted LAB_UNKNOWN_CHANGE that the last run alone has, or of a LAB_UNKNOWN_ONSET of the
 *                  only run, seen row by row
 *          level   p-value that the improvement has to pass
 * In/out:  u       fitted again
 *          chi2    of it
 * Out:     begin
 * Returns: as lab_unknowns_fit. */
int lab_onset_find(lab_unknowns *u, int change, double level, double *chi2, lab_onset *begin, lab_error *error);

/* Chi-square over the row at which something begins or ends. */
typedef struct lab_onset_profile {
  /* Returns: LAB_OK; else no row is looked at any more */
  int (*look)(void *context, size_t row, double *chi2, lab_error *error);
  void *context;
  size_t n; /* rows */
} lab_onset_profile;

/* The instant of the best row, and the interval in which chi-square stays within what 95 % allow, give or take a row.
 * In:      t          of the rows
 *          least      chi-square at the best one
 * Out:     low, high  the rows that it reaches to
 * Returns: as look */
int lab_onset_enclose(const lab_onset_profile *profile, const double *t, size_t best, double least, size_t *low,
                      size_t *high, lab_onset *onset, lab_error *error);

#endif
