/* One question to closeloop, from files to the answer: what does the model of a rig lack that would explain its logs?
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ANSWER_H
#define LAB_ANSWER_H

#include "../check/logs.h"
#include "report.h"

enum { LAB_USUAL_BUDGET = 60 }; /* [s] of CPU, for one question */

typedef struct lab_request {
  const char *rig;        /* path of the rig file */
  const char *const *log; /* paths of the logs to fit */
  int n_logs;
  const char *const *holdout; /* paths of those to judge on */
  int n_holdout;
  const char *const *baseline; /* paths of logs of the rig as it was */
  int n_baseline;
  double alpha, min_gain; /* see lab_search_options */
  double budget;          /* [s] of CPU after which the best answer so far is given; 0: none */
  void (*on_progress)(void *context, const char *what); /* told what is being done; may be NULL */
  void *context;
} lab_request;

/* Logs, and a model fitted to them and completed. */
typedef struct lab_completion {
  lab_logs logs;
  lab_unknowns declared, completed;
  lab_search_result result;
} lab_completion;

typedef struct lab_answer {
  lab_rig rig, rig_held; /* as declared; the same for logs held out */
  lab_completion now;
  lab_completion then;             /* of the baseline; nothing without one */
  lab_logs held;                   /* logs held out */
  lab_changes changes;             /* since then */
  lab_metrics measured, predicted; /* figures of merit of the runs fitted, and of the completed model there */
  lab_report report;               /* all of it; points into this struct */
} lab_answer;

/* Read, fit, trace, add, judge.
 * Out:     answer  to be freed; NULL after an error
 * Returns: LAB_OK; LAB_DATA for a bad file; LAB_NUMERIC, LAB_WORLD. */
int lab_answer_find(const lab_request *request, lab_answer **answer, lab_error *error);
void lab_answer_free(lab_answer *answer);

/* How much of an answer to write; each is more than the one before. */
enum lab_output {
  LAB_WRITE_JSON,   /* report.json */
  LAB_WRITE_PLAIN,  /* everything but figures as SVG */
  LAB_WRITE_DRAWN,  /* everything that can be written: figures if there is gnuplot */
  LAB_WRITE_FIGURES /* everything; without gnuplot, LAB_WORLD */
};

/* Write into a folder, which is made; all files at once, as far as Ctrl-C is concerned.
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_answer_write(const lab_answer *answer, const char *folder, int extent, lab_error *error);

/* Remove from a folder what lab_answer_write may have left there. */
void lab_answer_remove(const char *folder);

/* Whether a folder has what is written to such an extent. */
int lab_answer_is_there(const char *folder, int extent);

#endif
