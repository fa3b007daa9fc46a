/* What is computed in closed form: figures 5 to 8 and the table of the paper's numbers.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_NUMBERS_H
#define STUDY_NUMBERS_H

#include "study.h"

/* results/paper_numbers.csv, fig05.csv .. fig08.csv */
int numbers_make(const study *s, lab_error *error);

#endif
