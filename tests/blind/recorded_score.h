/* What an answer to a log "as recorded" is worth.
 *
 * An effect or a deviation counts as visible, or due, by what the log can show at best (recorded_limit.h), which knows
 * nothing of closeloop: an effect from twice the information limit on, a deviation from twice its interval of 95 % on.
 * Every log has one class, by the first of these that holds:
 *
 *   no answer    it failed, or took more than the CPU time allowed
 *   undecided    its verdict is undecided
 *   false alarm  nothing is missing, and an effect, or something unlisted, is named
 *   right        nothing is missing, or nothing visible, and none is said;
 *                or every effect named is missing, and every visible one is named;
 *                or what no catalogue has is called unlisted in the right equation
 *   partly       one of two, or a right name with another one besides;
 *                or a listed effect called unlisted, in its equation
 *   overlooked   none is said, but something visible is missing
 *   wrong        whatever else is named
 *
 * "Named" is as in the clean series: by its name, or in the list of what the log cannot tell from the one given, or
 * (visible, but not added) in that of what is significant but too small to be added. Filters on both sensors are
 * ordinary; whoever calls them pressure_lag or position_lag in a log that has them is not wrong, and is counted.
 * Confidently wrong are false alarm, overlooked and wrong.
 *
 * A deviation that is due is found if the report lists its parameter, off in the right direction; one that is said is
 * wrong if the truth is more than twice the stated interval away from what was found. That of the vent beside the fill
 * orifice is told as vent_restriction. Deviations of sensors are not judged.
 *
 * An onset counts where what begins was named, or found: within is a stated interval that holds the true instant.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_RECORDED_SCORE_H
#define BLIND_RECORDED_SCORE_H

#include "limit.h"
#include "recorded_limit.h"
#include "score.h"

enum blind_class {
  BLIND_NO_ANSWER,
  BLIND_UNDECIDED,
  BLIND_FALSE_ALARM,
  BLIND_RIGHT,
  BLIND_PARTLY,
  BLIND_OVERLOOKED,
  BLIND_WRONG,
  BLIND_CLASSES
};
const char *blind_class_text(int class);

/* Out: record whole */
void blind_score_recorded(const blind_recorded *trial, const blind_visible *visible, const blind_answer *answer,
                          size_t n_rows, blind_record *record);

/* True value over the declared one, of values that are off. */
double blind_true_ratio(const blind_recorded *trial, int value);

#endif
