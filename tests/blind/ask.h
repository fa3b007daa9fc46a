/* closeloop as a stranger: a program that is given files and leaves a report.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_ASK_H
#define BLIND_ASK_H

#include "../../apps/lab/base/message.h"

enum { BLIND_FINDS = 8, BLIND_TEXT = 256, BLIND_CANDIDATES = 64 };
typedef char blind_word[48];

/* Since when; NaN where nothing is said of it. */
typedef struct blind_since {
  double t, low, high; /* s */
} blind_since;

/* A declared value that is off, over what is declared; where 0 is declared, itself, in its unit. */
typedef struct blind_deviation {
  blind_word parameter;
  int absolute; /* 0 is declared */
  double ratio, low, high;
  int beyond; /* its tolerance */
  blind_since since;
} blind_deviation;

typedef struct blind_found {
  blind_word effect, equation;
  blind_since since;
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
  blind_word condition; /* "" if the report has none */
  int n_deviations;
  blind_deviation deviation[BLIND_CANDIDATES];
  double cpu; /* s, that the program took */
} blind_answer;

/* Read a report.json.  Returns: LAB_OK; LAB_DATA if it is not one. */
int blind_answer_read(const char *path, blind_answer *answer, lab_error *error);

/* Run closeloop on the logs in a folder, holdout.csv if it is there, and read its report. A run that fails, or computes
 * for more than `seconds` of CPU, is an answer, too: how busy the machine is does not count. Returns: LAB_OK; LAB_WORLD
 * if the program cannot be started. */
int blind_ask(const char *program, const char *folder, int seconds, blind_answer *answer, lab_error *error);

#endif
