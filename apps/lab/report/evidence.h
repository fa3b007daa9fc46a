/* What a run of closeloop has to show row by row, collected once for the figures and the page.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_EVIDENCE_H
#define LAB_EVIDENCE_H

#include "loopfiles.h"
#include "../base/whiteness.h"

/* What a residual is looked at over, besides time. */
enum lab_argument { LAB_ARGUMENT_P, LAB_ARGUMENT_X, LAB_ARGUMENT_V, LAB_ARGUMENT_U, LAB_ARGUMENT_COUNT };

/* A model: the declared one, and the one that is completed. Equal where nothing was added. */
enum lab_stage { LAB_STAGE_BEFORE, LAB_STAGE_AFTER, LAB_STAGE_COUNT };

typedef struct lab_evidence_channel {
  int channel;                        /* enum lab_channel */
  double sigma;                       /* noise in the first run that measures it, SI */
  double *measured;                   /* SI; NaN in a gap, as in the arrays below */
  double *predicted[LAB_STAGE_COUNT]; /* SI, as its sensor would show it */
  double *residual[LAB_STAGE_COUNT];  /* [1] whitened: measured less predicted, in noise */
  lab_whiteness whiteness[LAB_STAGE_COUNT];
} lab_evidence_channel;

/* Arrays of n values, the runs one behind the other. */
typedef struct lab_evidence {
  size_t n;
  int n_runs;
  size_t *first;                        /* row with which each run begins, then n */
  double *t;                            /* [s] of the log; of later runs, moved to follow the one before */
  double *argument[LAB_ARGUMENT_COUNT]; /* SI, of the completed model; u as in the log */
  int n_channels;
  lab_evidence_channel channel[LAB_CHANNEL_COUNT];
  double *memory;
} lab_evidence;

/* Collect.
 * Out:     evidence  to be freed with lab_evidence_free, also after an error
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_evidence_collect(const lab_story *story, lab_evidence *evidence, lab_error *error);
void lab_evidence_free(lab_evidence *evidence);

/* Key ("p") and unit of an argument. */
const char *lab_argument_key(int argument);
const char *lab_argument_unit(const lab_story *story, int argument);

#endif
