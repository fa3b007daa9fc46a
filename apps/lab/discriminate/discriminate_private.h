/* What the files of discriminate.h share.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DISCRIMINATE_PRIVATE_H
#define LAB_DISCRIMINATE_PRIVATE_H

#include "forecast.h"
#include "discriminate.h"

/* The trials and what has been recorded, which comes last. */
typedef struct design {
  lab_advice_request request;
  lab_test_plans plans;
  int n; /* of forecasts */
  lab_forecast forecast[LAB_TEST_PLAN_MAX + 1];
  lab_schedule schedule[LAB_TEST_PLAN_MAX + 1];
  pneu_input input[LAB_TEST_PLAN_MAX + 1][LAB_TEST_PLAN_STEPS];
  /* Normal equations of each record, one matrix for each foreseen channel, unweighted. */
  lab_normal bundle[LAB_TEST_PLAN_MAX + 1][LAB_FORECAST_CHANNELS];
  int failed[LAB_TEST_PLAN_MAX + 1]; /* not 0: could not be simulated; its bundle is empty */
  int jerky[LAB_TEST_PLAN_MAX + 1];  /* not 0: stick-slip throughout, too long to simulate many times */
} design;

/* Check a request, lay out its trials, and fill their bundles with the slopes of a model and the difference of two
 * others. Where no command moves the stem, advice says so and *made is NULL. In:      a, b  may be NULL: no difference
 * Out:     made  to be closed
 * Returns: as lab_discriminate. */
int lab_design_open(const lab_advice_request *request, const lab_forecast_model *model, const pneu_params *a,
                    const pneu_params *b, design **made, lab_advice *advice, lab_error *error);
void lab_design_close(design *s);

/* Take up a parameter that is not there yet, in the unit that suits s->params.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_side_add(lab_forecast_model *s, int param, lab_error *error);

/* What a value of a foreseen channel weighs [1/SI^2] where it is sampled; 0 where it is not recorded. */
double lab_design_weight(const lab_advice_request *q, const lab_forecast *o, int place);

/* What forecast i says.  Out: sum  over the recorded channels, weighted */
void lab_design_weigh(const design *s, int i, const lab_advice_request *q, lab_normal *sum);

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

void lab_advice_none(lab_advice *advice, const char *reason);

#endif
