/* The cells of the study, an actuator under one pair of laws each, and the tables that they fill.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_GRID_H
#define STUDY_GRID_H

#include "study.h"

typedef struct study_cell {
  const study *s;
  int index, actuator; /* from 0: among the cells, of the study's actuators */
  int law;             /* from 0: among the laws of an actuator */
  const lab_rig *rig;
  pneu_laws laws;
  const char *gas, *flow; /* their keys */
} study_cell;

/* Which cells there are. */
typedef struct study_grid {
  enum study_actuators { STUDY_ALL, STUDY_PRINTED, STUDY_SUBJECT, STUDY_SUBJECT_AND_TWIN } actuators;
  enum study_laws { STUDY_EVERY_LAW, STUDY_GAS_LAWS, STUDY_ONE_LAW } laws; /* GAS: each with the first law of flow */
} study_grid;

/* Do something in every cell, on all cores.
 * Returns: LAB_OK, or the error of the first cell in order that fails, with its actuator and laws in front. */
int study_each(const study *s, const study_grid *grid,
               int (*visit)(const study_cell *cell, void *context, lab_error *error), void *context, lab_error *error);

enum { STUDY_OUTPUTS = 6 };

/* A product: files that are put together from the rows of its cells. */
typedef struct study_tables {
  study_grid grid;
  /* Append to tables that are opened with their headers, one for each output. */
  int (*rows)(const study_cell *cell, table *t, lab_error *error);
  struct study_output {
    const char *file, *header;
    enum study_order { STUDY_BY_CELL, STUDY_BY_ACTUATOR, STUDY_BY_ROW } order; /* the first rows of all cells of .., */
    enum study_scope { STUDY_WHOLE, STUDY_ACTUATOR_FILE, STUDY_CELL_FILE } scope; /* then the second ones */
    int digits;                                                                   /* of numbers; 0: those of a table */
  } out[STUDY_OUTPUTS];
} study_tables;

/* Make and save them. Where a file is an actuator's its name is <file>.csv for the subject and <file>_<actuator>.csv
 * for the others; where it is a cell's, <file>_<actuator>_<gas>_<flow>.csv.
 * Returns: as study_each, or LAB_WORLD. */
int study_make(const study *s, const study_tables *tables, lab_error *error);

#endif
