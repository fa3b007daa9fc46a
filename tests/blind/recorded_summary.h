/* From the records of the trials "as recorded" to results/blind_recorded.md.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_RECORDED_SUMMARY_H
#define BLIND_RECORDED_SUMMARY_H

#include "summary.h"

/* What closeloop has to reach on logs as they are recorded. */
extern const blind_bar_list blind_recorded_bars;

/* Records in the order of trials.
 * In:      seconds  of CPU that closeloop had for each
 * Returns: 0, not 0 without memory. */
int blind_recorded_summary_write(FILE *file, const blind_record *record, int n, uint64_t seed, int seconds);

/* A table of the trials that were not right, or whose deviations or onset were not. */
void blind_recorded_misses(FILE *file, const blind_record *record, int n);

#endif
