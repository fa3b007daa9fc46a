/* What limits the conclusions of a run of closeloop: sentences for the report.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REMARKS_H
#define LAB_REMARKS_H

#include "message.h"

enum { LAB_REMARK_MAX = 32, LAB_REMARK_TEXT = 512, LAB_SENTENCE_TEXT = LAB_REMARK_TEXT + 64 };

typedef struct lab_remarks {
  int n; /* texts */
  char text[LAB_REMARK_MAX][LAB_REMARK_TEXT];
  int doubt; /* 1 + the text for which no effect may be named; 0: none */
} lab_remarks;

/* Add a sentence. Beyond LAB_REMARK_MAX the last one says that there are more. */
void lab_remark(lab_remarks *remarks, const char *format, ...) LAB_PRINTF(2, 3);

/* Add a sentence that forbids naming an effect: the verdict is "undecided". */
void lab_remark_doubt(lab_remarks *remarks, const char *format, ...) LAB_PRINTF(2, 3);

/* Add those of a log that is only held out: they limit, but forbid nothing. */
void lab_remarks_join(lab_remarks *remarks, const lab_remarks *held_out);

#endif
