/* What a model predicts for a record that nobody has made yet, and how it depends on parameters.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FORECAST_H
#define LAB_FORECAST_H

#include "../fit/normal.h"
#include "../run/response.h"
#include "../rig/rig.h"

enum { LAB_FORECAST_CHANNELS = 4 };
extern const int
    lab_forecast_channels[LAB_FORECAST_CHANNELS]; /* enum lab_channel: p, x, T and the supply at the transducer, ps */

/* A record to come. Pressure and position at its start are measured, so that every model begins with the same. */
typedef struct lab_forecast {
  const lab_rig *rig; /* its laws count in a prediction, not its parameters */
  const lab_schedule *schedule;
  pneu_state start; /* of the rig; see lab_test_plan_start */
  double *t;        /* [s] n sampling times */
  int n;
} lab_forecast;

/* Lay sampling times over a schedule.
 * In:      settle    [s] see lab_test_plan_start
 *          duration  [s]
 *          spacing   [s] wanted; wider where there would be more than 1500
 * Out:     forecast   to be closed; keeps rig and schedule
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_forecast_open(const lab_rig *rig, const lab_schedule *schedule, double settle, double duration, double spacing,
                      lab_forecast *forecast, lab_error *error);
void lab_forecast_close(lab_forecast *forecast);

/* Out:     y      LAB_FORECAST_CHANNELS * n values, SI, channel by channel
 *          steps  that the simulation took; may be NULL
 * Returns: LAB_OK; LAB_NUMERIC, also for parameters out of bounds; LAB_WORLD. */
int lab_forecast_run(const lab_forecast *forecast, const pneu_params *params, double *y, long *steps, lab_error *error);

extern const double lab_forecast_step; /* of differences for slopes, over scale */

/* A model and what of it would be fitted. */
typedef struct lab_forecast_model {
  pneu_params params;
  int n;
  int param[LAB_NORMAL_MAX];    /* as in lab_rig.fit */
  double scale[LAB_NORMAL_MAX]; /* unit of each, a change that matters */
} lab_forecast_model;

/* Slopes of y in the parameters that would be fitted.
 * In:      y      at those of the model
 * Out:     slope  model->n columns of LAB_FORECAST_CHANNELS * n
 * Returns: as lab_forecast_run. */
int lab_forecast_slopes(const lab_forecast *forecast, const lab_forecast_model *model, const double *y, double *slope,
                        lab_error *error);

/* A change of a parameter that matters: its value, the usual size of an effect, for LAB_PARAM_ORIFICE_AREA the fill
 * area (the vent area changes in proportion). */
double lab_forecast_scale(const pneu_params *params, int param);

/* The least and the largest change of a parameter, over scale. */
void lab_forecast_bounds(const pneu_params *params, int param, double scale, double *lower, double *upper);

/* Change a parameter, over scale, as far as its bounds allow. */
void lab_forecast_shift(pneu_params *params, int param, double change, double scale);

#endif
