/* closeloop, simulate and the draft of a rig file for programs in other languages: texts in, texts out. No file is read
 * or written but UDUNITS' table of units. Every text has a name, by which messages and the report call it.
 *
 * One call at a time in a process: callers in several threads take turns. A call uses as many threads as OpenMP gives.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_API_H
#define LAB_API_H

#include "../base/message.h"
#include "../base/text.h"

/* What is asked of closeloop; 0 and NULL mean the usual. */
typedef struct lab_api_request {
  lab_text_given rig;        /* a rig file */
  const lab_text_given *log; /* to fit; a table in any form that closeloop reads */
  const lab_text_given *holdout;
  const lab_text_given *baseline;
  int n_logs, n_holdout, n_baseline;
  double alpha;    /* chance of naming anything when nothing is missing, 0 < alpha <= 0.5; usual: 0.01 */
  double min_gain; /* share of the error that an effect must save to be added, 0 < min_gain < 1; usual: 0.02 */
  double budget;   /* [s] of CPU, > 0, after which the best answer so far is given; usual: 60 */
  void (*on_progress)(void *context, const char *what); /* told what is being done, from the thread of the call */
  void *context;
} lab_api_request;

/* What closeloop answers, each as in the file of that name; the first is what it prints. */
typedef struct lab_api_answer {
  char *sentence, *json, *html, *model, *residual;
} lab_api_answer;

/* Close the loop.
 * Out:     answer  to be freed with lab_api_free_answer; empty after an error
 * Returns: LAB_OK; LAB_DATA for texts that are at fault; LAB_USAGE for a request that is; LAB_NUMERIC; LAB_WORLD, also
 *          after lab_api_stop. */
int lab_api_closeloop(const lab_api_request *request, lab_api_answer *answer, lab_error *error);
void lab_api_free_answer(lab_api_answer *answer);

/* From any thread, while another is in lab_api_closeloop: end it, within a second or a few. */
void lab_api_stop(void);

/* What a model predicts at the rows of a log.
 * In:      log  NULL: the standard experiment, 15 s of filling and 15 s of venting
 * Out:     csv  to be freed with lab_api_free; NULL after an error
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_api_simulate(const lab_text_given *rig, const lab_text_given *log, char **csv, lab_error *error);

/* A rig file for a log and a data sheet.
 * In:      sheet  n texts "key=value", as of closeloop --init --sheet
 * Out:     rig    to be freed with lab_api_free; NULL after an error
 * Returns: LAB_OK, LAB_DATA, LAB_USAGE for a word that is none, LAB_WORLD. */
int lab_api_draft(const lab_text_given *log, const char *const *sheet, int n, char **rig, lab_error *error);

void lab_api_free(char *text);

/* Of the library, "major.minor.patch". */
const char *lab_api_version(void);

#endif
