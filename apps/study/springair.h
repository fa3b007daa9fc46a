/* The spring and the air process, each there or taken away: why it takes both.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_SPRINGAIR_H
#define STUDY_SPRINGAIR_H

#include "study.h"

/* results/spring_and_air.csv: every actuator in every law with both, without the spring and without the air process;
 * asymmetry, and how far the velocity of each stroke is from constant: largest over smallest, 5 % to 95 % of travel. */
int springair_make(const study *s, lab_error *error);

#endif
