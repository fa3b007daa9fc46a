/* What a model predicts for a record that nobody has made yet, and how it depends on parameters.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FORESEE_H
#define LAB_FORESEE_H

#include "../fit/normal.h"
#include "../run/response.h"
#include "../rig/rig.h"

enum { LAB_FORESEEN = 4 };
extern const int lab_foreseen[LAB_FORESEEN]; /* enum lab_channel: p, x, T and the supply at the transducer, ps */

/* A record to come. Pressure and position at its start are measured, so that every model begins with the same. */
typedef struct lab_outlook {
  const lab_rig *rig; /* its laws count in a prediction, not its parameters */
  const lab_schedule *schedule;
  pneu_state start; /* of the rig; see lab_trial_start */
  double *t;        /* [s] n sampling times */
  int n;
} lab_outlook;

/* Lay sampling times over a schedule.
 * In:      settle    [s] see lab_trial_start
 *          duration  [s]
 *          spacing   [s] wanted; wider where there would be more than 1500
 * Out:     outlook   to be closed; keeps rig and schedule
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_outlook_open(const lab_rig *rig, const lab_schedule *schedule, double settle, double duration, double spacing,
                     lab_outlook *outlook, lab_error *error);
void lab_outlook_close(lab_outlook *outlook);

/* Out:     y      LAB_FORESEEN * n values, SI, channel by channel
 *          steps  that the simulation took; may be NULL
 * Returns: LAB_OK; LAB_NUMERIC, also for parameters out of bounds; LAB_WORLD. */
int lab_foresee(const lab_outlook *outlook, const pneu_params *params, double *y, long *steps, lab_error *error);

/* Slopes of y in parameters (as in lab_rig.fit).
 * In:      scale  unit of each, a change that matters
 *          y      at params
 * Out:     slope  count columns of LAB_FORESEEN * n
 * Returns: as lab_foresee. */
int lab_foresee_slopes(const lab_outlook *outlook, const pneu_params *params, int count, const int *param,
                       const double *scale, const double *y, double *slope, lab_error *error);

/* A change of a parameter that matters: its value, the usual size of an effect, for LAB_FIT_ORIFICE_AREA the fill area
 * (the vent area changes in proportion). */
double lab_foresee_scale(const pneu_params *params, int param);

/* Change a parameter as far as its bounds allow, and how far it is from one model to another, both over scale. */
void lab_foresee_shift(pneu_params *params, int param, double change, double scale);
double lab_foresee_change(const pneu_params *from, const pneu_params *to, int param, double scale);

#endif
