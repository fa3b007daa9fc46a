/* What a model does, as CSV: a log of its own.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SIMULATION_H
#define LAB_SIMULATION_H

#include <stdio.h>

#include "../log/log.h"
#include "../rig/rig.h"

/* Predict the channels that a log measures, at its rows; a log that measures nothing gets pressure and position.
 * Returns: as lab_predict_log. */
int lab_simulation_write(const pneu_model *model, const lab_rig *rig, const lab_log *log, FILE *file, lab_error *error);

/* Fill for 15 s and vent for 15 s: see standard.h.  Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_simulation_write_standard(const pneu_model *model, FILE *file, lab_error *error);

#endif
