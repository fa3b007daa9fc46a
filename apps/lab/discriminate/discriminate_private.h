/* Parts of discriminate.c that are tried by themselves.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DISCRIMINATE_PRIVATE_H
#define LAB_DISCRIMINATE_PRIVATE_H

#include "forecast.h"
#include "discriminate.h"

/* Take up a parameter that is not there yet, in the unit that suits s->params.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_side_add(lab_forecast_model *s, int param, lab_error *error);

/* How far [sigma] a model stays from another's prediction, however it is fitted again within the bounds of its
 * parameters.
 * In:      known  what other records say of the same difference, weighted, in the columns of the model
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_discrepancy(const lab_advice_request *q, const lab_forecast *o, const pneu_params *goal,
                    const lab_forecast_model *model, const lab_normal *known, double *apart, lab_error *error);

/* The trial of the largest value (of those beyond `enough`, any), the shortest of those within a tenth of it.
 * In:      value  by trial; NaN: not to be had
 * Returns: the trial, -1 if there is none. */
int lab_trial_choose(const lab_test_plans *plans, const double *value, double enough);

#endif
