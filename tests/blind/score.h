/* What an answer is worth, for whoever knows the truth.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_SCORE_H
#define BLIND_SCORE_H

#include "record.h"

/* In:  limit  information limits of what is missing
 * Out: record whole */
void blind_score(const blind_trial *trial, const double *limit, const blind_answer *answer, blind_record *record);

#endif
