/* One line of batch.csv: what an answer comes to, and what is kept of it in its folder.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BATCHROW_H
#define LAB_BATCHROW_H

#include <stdint.h>
#include <stdio.h>

#include "../report/answer.h"

enum { LAB_ROW_TEXT = 8192 };

/* Cells of a row, after the name. */
enum { LAB_ROW_CHANNELS = 4, LAB_ROW_STAGES = 4 };
enum lab_row_cells {
  LAB_ROW_VERDICT,
  LAB_ROW_FOUND,
  LAB_ROW_SIZE,
  LAB_ROW_ALIKE,
  LAB_ROW_ERRORS, /* of each channel: before, after, held out before, held out after */
  LAB_ROW_LIMITATIONS = LAB_ROW_ERRORS + LAB_ROW_CHANNELS * LAB_ROW_STAGES,
  LAB_ROW_MESSAGE,
  LAB_ROW_CONDITION,
  LAB_ROW_DEVIATIONS, /* "dry_friction x3.7 + pressure_bias 0.5 kPa" */
  LAB_ROW_CELLS
};

/* What a line took. */
typedef struct lab_cost {
  double seconds, cpu; /* [s] on the clock, of a core */
  double memory;       /* [MB] the most that its process had */
} lab_cost;

/* What has become of a line of the list; plain bytes. */
typedef struct lab_outcome {
  int status; /* enum lab_status; not LAB_OK: the verdict is "error" */
  lab_cost cost;
  char row[LAB_ROW_TEXT]; /* the cells after the name, without an end of line */
} lab_outcome;

/* The header of batch.csv, with its end of line. */
void lab_row_header(FILE *file);

/* Out: outcome, but for its cost */
void lab_row_answer(const lab_answer *answer, lab_outcome *outcome);
void lab_row_error(const lab_error *error, lab_outcome *outcome);

/* The same on the disk: the file .done in the folder of the line, whole or absent. */
typedef struct lab_done {
  uint64_t key; /* of all that went into it; 0: to be done again in any case */
  int extent;   /* what was written of the answer */
  lab_outcome outcome;
} lab_done;

/* Read what is in a folder.  Returns: 0 if nothing is, or nothing whole */
int lab_done_read(const char *folder, lab_done *done);

/* Write it; the folder is made.  Returns: LAB_OK, LAB_WORLD. */
int lab_done_write(const char *folder, const lab_done *done, lab_error *error);

void lab_done_remove(const char *folder);

#endif
