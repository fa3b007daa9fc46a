/* The six hypotheses: how each is varied, and what is left of the asymmetry without its cause.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_HYPOTHESES_H
#define STUDY_HYPOTHESES_H

#include "study.h"

/* results/fig15.csv .. fig19.csv: T1, T2 and asymmetry over the varied quantity, in every law. */
int hypotheses_sweep(const study *s, lab_error *error);

/* results/hypotheses.csv for the subject, and hypotheses_<actuator>.csv for the others. */
int hypotheses_verdicts(const study *s, lab_error *error);

#endif
