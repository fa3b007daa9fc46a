/* The section of REPORT.md on what the paper prints and what follows from its equations.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_REPORT_PAPER_H
#define STUDY_REPORT_PAPER_H

#include <stdio.h>

#include "study.h"

/* Returns: LAB_OK; LAB_DATA if paper_numbers.csv is missing; LAB_WORLD. */
int report_paper(const study *s, FILE *file, lab_error *error);

#endif
