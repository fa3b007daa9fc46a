/* What a log can show at best: the size of an effect at which the projected statistic reaches 25.
 *
 * The statistic of an effect is |s'|^2: s is what the effect does to the log, over the noise, and s' what is left of s
 * when everything that can be adjusted has done its best to explain it: the five fitted parameters, the instants at
 * which the command changed, which the log gives to within a row, and the other effect of a pair. Everything is a
 * difference of two noise-free runs of the virtual rig; nothing of the library takes part.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_LIMIT_H
#define BLIND_LIMIT_H

#include "logs.h"

#define BLIND_LIMIT_STATISTIC 25.0

/* Limit of one missing effect of a trial.
 * Out:     size       at which the statistic is 25, positive
 *          statistic  at the size of the trial
 * Error:   the statistic is taken to grow as the square of the size between the limit and where it was last computed,
 *          which is at the limit to within a few per cent for effects that are smooth. */
int blind_limit(const blind_trial *trial, int which, double *size, double *statistic, lab_error *error);

/* Squared length of s with the n columns of `column` (m values each, overwritten) projected out. For the tests. */
double blind_projected(double *column, int n, double *s, size_t m);

#endif
