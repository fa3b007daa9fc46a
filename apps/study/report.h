/* The page that sums up the study.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_REPORT_H
#define STUDY_REPORT_H

#include "study.h"

/* results/REPORT.md, from the tables of the results folder; those of measured data may be absent. */
int report_make(const study *s, lab_error *error);

#endif
