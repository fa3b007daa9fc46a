/* The hypotheses as the paper varies them.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_HYPOTHESES_H
#define STUDY_HYPOTHESES_H

#include "study.h"

/* results/fig15.csv .. fig19.csv: T1, T2 and asymmetry over the varied quantity, in every law. */
int hypotheses_sweep(const study *s, lab_error *error);

#endif
