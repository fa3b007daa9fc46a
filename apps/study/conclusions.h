/* The 18 conclusions of the paper, tried on simulated strokes under every law of the study.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_CONCLUSIONS_H
#define STUDY_CONCLUSIONS_H

#include "conclusions_measure.h"
#include "study.h"
#include "table.h"

enum { CONCLUSIONS = 18 };

/* A conclusion as a statement that can be tested; study/PAPER.md, section 9, says why so. */
typedef struct conclusion {
  int number;       /* of the paper */
  const char *what; /* is measured */
  double low, high; /* between which it lies if the conclusion is right */
  int (*measure)(const conclusion_trial *t, const struct conclusion *c, finding *f, lab_error *error);
} conclusion;

extern const conclusion conclusions[CONCLUSIONS];

/* Fill a table `conclusion,gas,flow,verdict,evidence`: by conclusion, then by law in the order of the study. The
 * table is opened here, and to be closed by the caller whatever is returned.
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int conclusions_table(const study *s, table *t, lab_error *error);

/* Write conclusions.csv.  Returns: as conclusions_table. */
int conclusions_make(const study *s, lab_error *error);

#endif
