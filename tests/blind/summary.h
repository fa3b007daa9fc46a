/* From the records of all trials to results/blind.md.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_SUMMARY_H
#define BLIND_SUMMARY_H

#include <stdint.h>

#include "record.h"
#include "stats.h"

/* What closeloop has to reach; the only place where thresholds stand. */
typedef struct blind_bar {
  const char *what;
  int (*counts)(const blind_record *r); /* whether a trial counts */
  int (*hit)(const blind_record *r);
  int at_least; /* 1: hits should be at least `share` of what counts; 0: at most; -1: no bar, a figure only */
  double share;
} blind_bar;
extern const blind_bar blind_bars[];
extern const int blind_bar_count;

blind_count blind_bar_counts(const blind_bar *bar, const blind_record *record, int n);

/* Whether a count meets a bar; one over nothing does. */
int blind_bar_met(const blind_bar *bar, blind_count count);

/* Whether a count speaks against a bar: its 95 % interval lies wholly on the wrong side. A sample too small to tell a
 * share of 0.95 from one of 0.92 still fails where something has broken. */
int blind_bar_refuted(const blind_bar *bar, blind_count count);

/* Records in the order of trials.  Returns: 0, not 0 without memory. */
int blind_summary_write(FILE *file, const blind_record *record, int n, uint64_t seed);

#endif
