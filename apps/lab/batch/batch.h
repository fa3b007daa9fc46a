/* A fleet run: closeloop on every line of a list (batchlist.h), some at once, each in a process of its own.
 *
 * In the folder: batch.csv, a line each in the list's order; batch.cost.csv, the time and memory that each took;
 * trends.csv, how rigs go on whose lines have dates;
 * <name>/report.json or all files of the answer; <name>/.done, what has become of the line and a checksum of all that
 * went into it, by which the next run knows what it need not do again. batch.csv is written when the list is done, and
 * depends neither on how many worked at once, nor on how often the run was stopped, nor on the folder that it was
 * started in.
 *
 * Memory: the list itself, 16 bytes a line while it is checked; half a kB a line for its row on the page, and
 * 0.3 kB for each value of a dated line.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BATCH_H
#define LAB_BATCH_H

#include "../report/answer.h"

typedef struct lab_batch_options {
  const char *list;
  const char *out; /* folder; NULL: results/<name of the list> */
  double alpha, min_gain;
  int extent;  /* enum lab_output: what to write of each answer */
  int at_once; /* 0: as many as are usual */
  int quiet;
  int budget;        /* [s] of CPU for a line, at least 1: more is an error of the line */
  int memory;        /* [MB] for a line: more is an error of the line */
  long room;         /* [byte] on the disk for each file of a line: the same */
  int allow_include; /* 0: a rig file with @include is an error of its line */
} lab_batch_options;

/* Run; says on standard output what came out. Paths in the list are taken from its folder, to which the process moves.
 * Returns: LAB_OK; LAB_DATA for a bad list; the worst status of a line; LAB_WORLD. */
int lab_batch_run(const lab_batch_options *options, lab_error *error);

#endif
