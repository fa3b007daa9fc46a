/* The study: what its file declares, and the products that it makes.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_STUDY_H
#define STUDY_STUDY_H

#include "../lab/base/message.h"
#include "../lab/rig/rig.h"
#include "table.h"

enum {
  STUDY_ACTUATOR_MAX = 8,
  STUDY_LAW_MAX = 8,
  STUDY_BENCH_MAX = 16,
  STUDY_PATH_TEXT = 1024,
  STUDY_FILE_TEXT = 3 * LAB_NAME_TEXT
};

/* Values of the varied quantity, in equal steps. */
typedef struct study_range {
  double from, to; /* in the SI unit of the hypothesis */
  int points;
} study_range;

typedef struct study_bench {
  double low, high; /* [Pa] gauge */
} study_bench;

/* Names of the files that a product has saved, separated by blanks. */
typedef struct study_saved {
  char names[2048];
} study_saved;

typedef struct study {
  char file[STUDY_PATH_TEXT];           /* the configuration */
  char results[STUDY_PATH_TEXT];        /* folder */
  int n_actuators, n_printed;           /* all; those with the parameters of Table A1 as printed, which come first */
  lab_rig actuator[STUDY_ACTUATOR_MAX]; /* then those whose spring follows from the bench set */
  int subject;                          /* index of the actuator that the hypotheses are tried on */
  int n_gas, gas[STUDY_LAW_MAX];
  int n_flow, flow[STUDY_LAW_MAX];
  double confirmed_below; /* [1] */
  study_range range[5];   /* of H1, H2, H3, -, H5 */
  int n_benches;
  study_bench bench[STUDY_BENCH_MAX];
  study_saved *saved; /* NULL: nobody asks */
} study;

/* Read a study file.
 * Returns: LAB_OK; LAB_DATA with file, line, key; LAB_WORLD. */
int study_read(const char *path, study *s, lab_error *error);

/* The folder of the study file, where its rig files and figures are; "." if its path has none.  Out: folder */
void study_folder(const study *s, char folder[STUDY_PATH_TEXT]);

/* Write a table to a file of the results folder, whole or not at all.  Returns: LAB_OK, LAB_WORLD. */
int study_save(const study *s, const char *name, const table *t, lab_error *error);

/* Read a table of the results folder.  Out, Returns: as table_load_file */
int table_load(const study *s, const char *name, table *t, lab_error *error);

/* Tell whoever asks that a file of the results folder has been written. */
void study_note_saved(const study *s, const char *name);

/* The laws of a rig with other chamber and flow laws. */
pneu_laws study_laws(const lab_rig *rig, int gas, int flow);

#endif
