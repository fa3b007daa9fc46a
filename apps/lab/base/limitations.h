/* What limits the conclusions of a run of closeloop: sentences for the report.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LIMITATIONS_H
#define LAB_LIMITATIONS_H

#include "message.h"

enum { LAB_LIMITATION_MAX = 32, LAB_LIMITATION_TEXT = 512, LAB_SENTENCE_TEXT = 4 * LAB_LIMITATION_TEXT };

typedef struct lab_limitations {
  int n; /* texts */
  char text[LAB_LIMITATION_MAX][LAB_LIMITATION_TEXT];
  int doubt; /* 1 + the text for which no effect may be named; 0: none */
} lab_limitations;

/* Add a sentence, once. Beyond LAB_LIMITATION_MAX the last one says that there are more. */
void lab_limitation(lab_limitations *limitations, const char *format, ...) LAB_PRINTF(2, 3);

/* Add a sentence that forbids naming an effect: the verdict is "undecided". */
void lab_limitation_no_verdict(lab_limitations *limitations, const char *format, ...) LAB_PRINTF(2, 3);

/* Add those of a log that is only held out: they limit, but forbid nothing. */
void lab_limitations_join(lab_limitations *limitations, const lab_limitations *held_out);

#endif
