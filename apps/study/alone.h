/* What a log says by itself: a model fitted to it alone. What that leaves shows within the log; what common values
 * leave beyond it shows only between logs. SPDX-License-Identifier: MIT */
#ifndef STUDY_ALONE_H
#define STUDY_ALONE_H

#include "../lab/base/message.h"
#include "../lab/rig/rig.h"

enum { ALONE_VALUES_MAX = 16 };

typedef struct alone_value {
  char name[LAB_PARAM_NAME_TEXT], unit[32];
  double value, half; /* in its unit; half of the 95 % interval, which holds if nothing but noise is left; 0: it is at
                         a bound */
} alone_value;

/* Errors are root mean squares of the channel that was asked for, SI; NaN where the model cannot follow the log. */
typedef struct alone_fit {
  double common;         /* with the model's values; what each log has for itself is fitted */
  double left, in_noise; /* with values of its own; the same over the declared noise */
  size_t rows;           /* values that were compared */
  int n, undetermined;   /* values that the log tells, and how many it does not */
  alone_value value[ALONE_VALUES_MAX];
} alone_fit;

/* Fit all that a model's file has in `fit` and `fit_per_log`, from its values, to one log, and the instants of its
 * commands. Knots of free terms stay as they are.
 * In:      rig      the model
 *          log      path of it
 *          channel  whose error is asked for: enum lab_channel
 * Returns: LAB_OK; LAB_DATA for a log that does not fit the rig; LAB_WORLD. */
int alone_fit_log(const lab_rig *rig, const char *log, int channel, alone_fit *fit, lab_error *error);

/* Fit one parameter of a model to one channel of a log, all else as it is: what a sensor may do to it.
 * In:      name     of the parameter ("temperature_lag.temperature_time")
 *          channel  enum lab_channel; no other takes part
 * Out:     fit      its interval is for noise as large as what is left
 * Returns: as alone_fit_log; LAB_DATA for a parameter that does not exist. */
int alone_fit_sensor(const lab_rig *rig, const char *log, const char *name, int channel, alone_fit *fit,
                     lab_error *error);

#endif
