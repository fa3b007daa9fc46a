/* A full stroke up and down of a model, and its measures.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_STROKE_H
#define STUDY_STROKE_H

#include "../../lib/pneu.h"
#include "../lab/message.h"
#include "asymmetry.h"

/* Fill from rest on the lower stop until nothing moves, then vent until nothing moves, and measure.
 * Method: the library's stepper at tol 1e-8.
 * Returns: LAB_OK, LAB_DATA (parameters out of bounds, or no travel), LAB_NUMERIC, LAB_WORLD. */
int stroke_measure(const pneu_params *params, const pneu_laws *law, asymmetry_result *out, lab_error *error);

#endif
