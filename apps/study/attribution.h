/* Which part of the air process makes the asymmetry: every combination of its causes, and the Shapley share of each.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_ATTRIBUTION_H
#define STUDY_ATTRIBUTION_H

#include "study.h"

/* results/attribution.csv and attribution_cells.csv (all combinations) for the subject, attribution_<actuator>.csv for
 * the others. */
int attribution_make(const study *s, lab_error *error);

#endif
