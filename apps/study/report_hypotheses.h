/* The section of REPORT.md on the six hypotheses.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_REPORT_HYPOTHESES_H
#define STUDY_REPORT_HYPOTHESES_H

#include <stdio.h>

#include "study.h"

/* Returns: LAB_OK; LAB_DATA if a table is missing; LAB_WORLD. */
int report_hypotheses(const study *s, FILE *file, lab_error *error);

#endif
