/* What has become of a line of a list, on the disk: the file .done in its folder, whole or absent.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BATCHDONE_H
#define LAB_BATCHDONE_H

#include <stdint.h>

#include "batchrow.h"

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
