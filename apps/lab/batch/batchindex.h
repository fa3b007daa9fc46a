/* index.html beside batch.csv: what a batch comes to, the worst first, with a link to each report.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BATCHINDEX_H
#define LAB_BATCHINDEX_H

#include "batchrow.h"
#include "trends.h"

/* A line of the list, as the page shows it. */
typedef struct lab_index_entry {
  char *name, *row; /* row: as in lab_outcome */
  const char *page; /* what was written about it, NULL: nothing */
  int severity;     /* 0: the worst */
  double gain;      /* error before over that after, of the channel that is worst */
  int line;         /* of those in the list */
} lab_index_entry;

/* Begins as {0}. */
typedef struct lab_index {
  int n;
  lab_index_entry *entry;
} lab_index;

/* Returns: LAB_OK; LAB_WORLD without memory. */
int lab_index_add(lab_index *index, const char *name, const lab_done *done, lab_error *error);
void lab_index_free(lab_index *index);

/* Sort and write the page.
 * In:      list    path of the list, whose file name is the heading
 *          trends  of its rigs
 *          folder  of the batch
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int lab_index_write(lab_index *index, const char *list, const lab_trends *trends, const char *folder, lab_error *error);

#endif
