/* The state at rest in which a log begins.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_START_H
#define LAB_START_H

#include "../log/log.h"
#include "../../../lib/pneu.h"

/* Where a run of a log begins: the mean of each channel over the rows before the command first changes, or over
 * as many of them as stay level. A channel that is not measured follows from the balance of forces; what stands
 * near a stop and is pushed against it is on it. Sensor effects of the model are taken off.
 * In:      input  at the first row
 *          run    0 <= run < log->n_runs
 * Out:     state
 * Returns: LAB_OK; LAB_DATA if the log begins in a state that is none. */
int lab_run_initial_state(const pneu_model *model, const pneu_input *input, const lab_log *log, size_t run,
                          pneu_state *state, lab_error *error);

/* Where the stem is in balance at a pressure, friction left out: see pneu_balance_pressure.
 * In:      pressure  [Pa] gauge
 * Returns: [m] 0..travel; the nearer stop where the balance lies beyond it. */
double lab_balance_position(const pneu_model *model, double pressure, const pneu_input *input);

#endif
