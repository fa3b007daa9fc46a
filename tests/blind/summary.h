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

enum blind_bar_word {
  BLIND_BAR_REFUTED, /* the 95 % interval lies wholly on the wrong side */
  BLIND_BAR_MISSED,  /* the share does, but so small a sample may be chance */
  BLIND_BAR_REACHED, /* the share lies on the right side, its interval not wholly */
  BLIND_BAR_SHOWN    /* the interval does */
};

/* How a count stands to a bar; one over nothing reaches it.  Returns: enum blind_bar_word */
int blind_bar_word(const blind_bar *bar, blind_count count);

/* The table of totals: its head, and a row. */
void blind_bar_header(FILE *file);
void blind_bar_row(FILE *file, const blind_bar *bar, blind_count count);

/* Records in the order of trials.
 * In:      what  sets these trials apart from others, in a sentence; "" for nothing
 * Returns: 0, not 0 without memory. */
int blind_summary_write(FILE *file, const blind_record *record, int n, uint64_t seed, const char *what);

#endif
