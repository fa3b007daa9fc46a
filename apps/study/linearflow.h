/* Air that flows in proportion to the pressure difference whatever its density: the counterfactual of hypothesis 6,
 * q = area sqrt(2/(R T_a)) (p_up - p_down), T_a ambient.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_LINEARFLOW_H
#define STUDY_LINEARFLOW_H

#include "../../lib/pneu.h"

/* In the place of enum pneu_flow_law; LINEAR_CHOKED_FLOW holds p_down at the nozzle's critical pressure below that. */
enum { LINEAR_FLOW = PNEU_FLOW_COUNT, LINEAR_CHOKED_FLOW };

/* As pneu_model_init; laws->flow may be one of these, too. */
int linear_model_init(pneu_model *model, const pneu_params *p, const pneu_laws *laws, int *bad);

#endif
