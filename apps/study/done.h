/* What has been made, from what: one line a product in the file .done of the results folder.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_DONE_H
#define STUDY_DONE_H

#include "../lab/base/message.h"

enum { DONE_MAX = 128, DONE_TEXT = 2048 };

typedef struct done_line {
  char product[64];
  unsigned long long key;
  char files[DONE_TEXT]; /* names in the folder, separated by blanks */
} done_line;

typedef struct done {
  char path[1200];
  char folder[1100];
  int n;
  done_line line[DONE_MAX];
} done;

/* Read the record; none is an empty one. */
void done_read(done *d, const char *folder);

/* Whether a product was made with this key and all its files are still there. */
int done_is_fresh(const done *d, const char *product, unsigned long long key);

/* Forget a product that is about to be made again, lest an end in the midst of it leave a record that is not true.
 * Returns: LAB_OK, LAB_WORLD. */
int done_forget(done *d, const char *product, lab_error *error);

/* Note that a product has been made, and write the record.  Returns: LAB_OK, LAB_WORLD. */
int done_note(done *d, const char *product, unsigned long long key, const char *files, lab_error *error);

#endif
