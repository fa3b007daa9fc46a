/* The words of a data sheet, asked for one after the other.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SHEETASK_H
#define LAB_SHEETASK_H

#include <stdio.h>

#include "sheetwords.h"

enum { LAB_QUESTIONS = 8 };

typedef struct lab_sheet_answers {
  char text[LAB_QUESTIONS][LAB_SHEET_VALUE]; /* "key=value" */
  int n;
} lab_sheet_answers;

/* Ask; an empty line leaves a question open, a wrong answer is asked for again, the end of `in` ends it.
 * In:      in, out  where answers come from, and where questions go
 * Out:     answers  as lab_draft_write takes them */
void lab_sheet_ask(FILE *in, FILE *out, lab_sheet_answers *answers);

#endif
