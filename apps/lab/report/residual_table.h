/* What a run of closeloop has to show row by row, collected once for residual.csv, the figures and the page.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RESIDUAL_TABLE_H
#define LAB_RESIDUAL_TABLE_H

#include "report.h"

/* What a residual is looked at over, besides time. */
enum lab_argument { LAB_ARGUMENT_P, LAB_ARGUMENT_X, LAB_ARGUMENT_V, LAB_ARGUMENT_U, LAB_ARGUMENT_COUNT };

typedef struct lab_residual_channel {
  int channel;                        /* enum lab_channel */
  double *measured;                   /* SI; NaN in a gap, as in the arrays below */
  double *predicted[LAB_STAGE_COUNT]; /* SI, as its sensor would show it */
  double *residual[LAB_STAGE_COUNT];  /* [1] measured less predicted, in noise */
} lab_residual_channel;

/* Arrays of n values, the runs one behind the other. */
typedef struct lab_residual_table {
  size_t n;
  int n_runs;
  size_t first[LAB_RUNS_MAX + 1];       /* row with which each run begins, then n */
  double *t;                            /* [s] of the log; of later runs, moved to follow the one before */
  double *argument[LAB_ARGUMENT_COUNT]; /* SI, of the completed model: the noise of what was measured is also
                                           in the residual; u as in the log where it has one */
  double *set_position;                 /* [1] share of the stroke; NaN where a log has none */
  int n_channels;
  lab_residual_channel channel[LAB_CHANNEL_COUNT];
  double *memory;
} lab_residual_table;

/* Collect.
 * Out:     table  to be freed with lab_residual_table_free, also after an error
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_residual_table_collect(const lab_report *report, lab_residual_table *table, lab_error *error);
void lab_residual_table_free(lab_residual_table *table);

/* A channel of the table (enum lab_channel), NULL if no run measures it. */
const lab_residual_channel *lab_residual_table_channel(const lab_residual_table *table, int channel);

/* Key ("p") and unit of an argument. */
const char *lab_argument_key(int argument);
const char *lab_argument_unit(const lab_report *report, int argument);

#endif
