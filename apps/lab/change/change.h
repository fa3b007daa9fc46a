/* What has changed in a rig since its baseline was recorded.
 *
 * The model that was completed on the baseline is fitted to the old and the new logs together. What is known to differ
 * from day to day on a sound rig (repeat.h) may differ between them within its spread. What a search of the new logs
 * makes likely (suspect.h) is taken up first if it explains them. Then every parameter that can change, and every
 * effect, is scored as a difference that the new logs alone have; the best are refitted and taken up one after the
 * other, until no score passes at `alpha` over all of them (Bonferroni). What the baseline's model cannot describe on
 * the baseline itself counts as noise with memory. SPDX-License-Identifier: MIT */
#ifndef LAB_CHANGE_H
#define LAB_CHANGE_H

#include "suspect.h"

enum lab_since { LAB_SINCE_CANNOT_TELL, LAB_SINCE_UNCHANGED, LAB_SINCE_CHANGED };

/* "cannot tell", "unchanged", "changed" */
const char *lab_since_text(int condition);

enum { LAB_CHANGES_MAX = 4, LAB_CHANGE_LEADERS = 5, LAB_WHY_TEXT = 512 };

/* One thing that has changed, in SI. */
typedef struct lab_change {
  int param;                   /* as in pneu_param_describe, or LAB_PARAM_ORIFICE_AREA */
  double then, now, low, high; /* 95 % interval of now: it has what is not known of then, and what the model leaves */
  double statistic, p_value;   /* chi-square that it alone explains, the others being there: of the difference */
  lab_onset begin, end;        /* where it does not act throughout the new log */
  int n_alike;                 /* other changes that explain it as well */
  int alike[LAB_CHANGE_LEADERS];
} lab_change;

typedef struct lab_changes {
  int condition; /* enum lab_since */
  int n;         /* the most certain first */
  lab_change change[LAB_CHANGES_MAX];
  int tests;              /* scores in all */
  double level;           /* p-value that one has to pass */
  double then, now;       /* [1] what is left of either, over what counts as noise */
  char why[LAB_WHY_TEXT]; /* why it cannot be told, or what remains; "" where all is well */
} lab_changes;

/* Name of what changed, by its parameter: that of the effect, or of the parameter. */
const char *lab_change_name(int param, char name[LAB_PARAM_NAME_TEXT]);
const char *lab_change_unit(const lab_change *change);

/* What is compared with what. */
typedef struct lab_comparison {
  const lab_unknowns *then; /* completed on the baseline, fitted, row by row */
  int decided;              /* not 0: it leaves only noise there */
  const lab_run *now;       /* n_now runs of the new logs, of the same rig */
  int n_now;
  const lab_suspect
      *suspect; /* n_suspects differences to be asked first: one that explains the new logs needs no others */
  int n_suspects;
  double alpha; /* chance of naming a change where there is none */
} lab_comparison;

/* Compare.  Returns: LAB_OK; LAB_DATA if there are too many runs; LAB_NUMERIC, LAB_WORLD. */
int lab_changes_find(const lab_comparison *of, lab_changes *changes, lab_error *error);

#endif
