/* The products of the study, each made once: a run that was cut short goes on with what is missing.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_PRODUCTS_H
#define STUDY_PRODUCTS_H

#include "study.h"

typedef struct study_run {
  int force;   /* make everything again */
  int quiet;   /* no words on stderr */
  int figures; /* 0: tables only */
} study_run;

/* Make the products that are missing, or whose configuration, data or program has changed since they were made.
 * Tables first, then figures (gnuplot), then the report.
 * Returns: LAB_OK, or the first error; what was made before it stays. */
int products_make(study *s, const study_run *run, lab_error *error);

#endif
