/* Finished trials, one line each, so that a run that was stopped goes on where it was.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_JOURNAL_H
#define BLIND_JOURNAL_H

#include "../../apps/lab/base/message.h"
#include "record.h"

typedef struct blind_journal {
  FILE *file;
  blind_record *record; /* each as its line reads, so that it does not matter in which run it was made */
  int n, room, recorded;
} blind_journal;

/* Take up the journal at a path if its first line is `key`, else begin it anew. A line that a stop cut short is left
 * out.
 * In:      room      trials 0 to room - 1 are taken up
 *          recorded  as in record.h
 * Out:     journal  to be closed, also after an error
 * Returns: LAB_OK, LAB_WORLD. */
int blind_journal_open(blind_journal *journal, const char *path, const char *key, int room, int recorded,
                       lab_error *error);
void blind_journal_close(blind_journal *journal);

/* Whether a trial is in it. */
int blind_journal_has(const blind_journal *journal, int trial);

/* Append a record; its line is written when this returns. Not reentrant. */
int blind_journal_add(blind_journal *journal, const blind_record *record, lab_error *error);

/* Put the records in the order of their trials. */
void blind_journal_sort(blind_journal *journal);

#endif
