/* closeloop as a stranger: a program that is given files and leaves a report.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_ASK_H
#define BLIND_ASK_H

#include "../../apps/lab/base/message.h"

enum { BLIND_FINDS = 8, BLIND_TEXT = 256, BLIND_CANDIDATES = 64 };
typedef char blind_word[48];

typedef struct blind_found {
  blind_word effect, equation;
  int n_alike;
  blind_word alike[BLIND_CANDIDATES]; /* indistinguishable_from */
} blind_found;

/* What a report says. Errors are over the noise, root mean square over the channels; NaN where there are none. */
typedef struct blind_answer {
  blind_word verdict;     /* as in report.json; "timeout", "failed" */
  char words[BLIND_TEXT]; /* of a failure */
  int n_found, n_unlisted, n_small, n_candidates;
  blind_found found[BLIND_FINDS];
  blind_word unlisted[BLIND_FINDS];       /* equations */
  blind_word small[BLIND_CANDIDATES];     /* significant_but_small */
  blind_word candidate[BLIND_CANDIDATES]; /* of the first scan, best first */
  double statistic[BLIND_CANDIDATES];
  double before, after, holdout_before, holdout_after;
} blind_answer;

/* Read a report.json.  Returns: LAB_OK; LAB_DATA if it is not one. */
int blind_answer_read(const char *path, blind_answer *answer, lab_error *error);

/* Run closeloop on the logs in a folder and read its report. A run that fails or takes longer than `timeout` [s] is an
 * answer, too.
 * Returns: LAB_OK; LAB_WORLD if the program cannot be started. */
int blind_ask(const char *program, const char *folder, double timeout, blind_answer *answer, lab_error *error);

#endif
