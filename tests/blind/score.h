/* What an answer is worth, for whoever knows the truth.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_SCORE_H
#define BLIND_SCORE_H

#include "record.h"

/* In:  limit  information limits of what is missing
 * Out: record whole */
void blind_score(const blind_trial *trial, const double *limit, const blind_answer *answer, blind_record *record);

/* Whether a finding stands for an effect, by its name or in what the log cannot tell from it. */
int blind_stands_for(const blind_found *found, const blind_effect *effect);

/* Whether an effect, of one outside the catalogue its equation, is listed as significant but too small to be added. */
int blind_is_small(const blind_answer *answer, const blind_effect *effect);

#endif
