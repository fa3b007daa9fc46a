/* The stepper against CVODE, and the balances of mass and energy, on every standard experiment.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_AGREEMENT_H
#define STUDY_AGREEMENT_H

#include "study.h"

/* results/agreement.csv */
int agreement_make(const study *s, lab_error *error);

#endif
