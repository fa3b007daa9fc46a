/* Verdicts on the six hypotheses.
 *
 * A hypothesis is confirmed if the asymmetry falls below a share of its value when its cause is taken away. Where that
 * is so of several causes, each is then tried alone, with the others taken away: a cause may be needed and yet make
 * nothing by itself. No cause is exempt.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_VERDICTS_H
#define STUDY_VERDICTS_H

#include "removals.h"
#include "study.h"

/* One law: asymmetry and duration ratio with everything there, without each cause, and with each alone. */
typedef struct verdicts_law {
  double base, base_ratio;
  double without[REMOVALS], without_ratio[REMOVALS];
  double alone[REMOVALS]; /* with every other cause taken away without which the asymmetry falls below the share;
                             NaN where the cause itself is not such a one, or the stroke cannot be made */
} verdicts_law;

/* In:      below  share of the asymmetry, as study.confirmed_below
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int verdicts_measure(const lab_rig *rig, int gas, int flow, double below, verdicts_law *out, lab_error *error);

/* "confirmed", "not confirmed", or one of these with a reason after it. */
const char *verdicts_text(const verdicts_law *law, int cause, double below);

/* results/hypotheses.csv for the subject, and hypotheses_<actuator>.csv for the others. */
int verdicts_make(const study *s, lab_error *error);

#endif
