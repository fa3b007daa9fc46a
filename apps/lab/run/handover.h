/* From one model of a run to the next.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_HANDOVER_H
#define LAB_HANDOVER_H

#include "../../../lib/pneu.h"

/* Go on with another model: what both have goes on, what is new begins as at rest; a stem that has sunk into a stop
 * touches it.
 * In/out:  state  of `from`, then of `to`
 * Returns: as pneu_state_rest: PNEU_OK, or < 0 where the other model can be in no such state. */
int lab_hand_over(const pneu_model *from, const pneu_model *to, const pneu_input *input, pneu_state *state);

/* Whether the states of two models have the same entries, and the stem the same modes: none on a stop that yields. */
int lab_states_agree(const pneu_model *a, const pneu_model *b);

#endif
