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
  unsigned counts, hits; /* a trial counts, or is a hit, that has one of these traits */
  int at_least;          /* 1: hits should be at least `share` of what counts; 0: at most; -1: no bar, a figure only */
  double share;
} blind_bar;

/* Those of a series, and what traits a trial of it has, a bit each. */
typedef struct blind_bar_list {
  const blind_bar *bar;
  int n;
  unsigned (*traits_of)(const blind_record *r);
} blind_bar_list;
extern const blind_bar_list blind_bars;
unsigned blind_mark(int has, unsigned trait); /* the trait, or 0 */

blind_count blind_bar_counts(const blind_bar_list *bars, int bar, const blind_record *record, int n);

enum blind_bar_word {
  BLIND_BAR_REFUTED, /* the 95 % interval lies wholly on the wrong side */
  BLIND_BAR_MISSED,  /* the share does, but so small a sample may be chance */
  BLIND_BAR_REACHED, /* the share lies on the right side, its interval not wholly */
  BLIND_BAR_SHOWN    /* the interval does */
};

/* How a count stands to a bar; one over nothing reaches it.  Returns: enum blind_bar_word */
int blind_bar_word(const blind_bar *bar, blind_count count);

/* The table of totals: its head with the rows of all bars, and a row. */
void blind_bar_table(FILE *file, const blind_bar_list *bars, const blind_record *record, int n);
void blind_bar_row(FILE *file, const blind_bar *bar, blind_count count);

/* Records in the order of trials.
 * In:      what  sets these trials apart from others, in a sentence; "" for nothing
 * Returns: 0, not 0 without memory. */
int blind_summary_write(FILE *file, const blind_record *record, int n, uint64_t seed, const char *what);

#endif
