/* What the files of separate.h share.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SEPARATE_PRIVATE_H
#define LAB_SEPARATE_PRIVATE_H

#include "foresee.h"
#include "separate.h"

/* Normal equations of a record, one matrix for each foreseen channel, unweighted. */
typedef struct bundle {
  lab_normal channel[LAB_FORESEEN];
} bundle;

/* A model and what of it would be fitted. */
typedef struct side {
  pneu_params params;
  int n;
  int param[LAB_NORMAL_MAX];
  double scale[LAB_NORMAL_MAX]; /* their units */
} side;

/* The trials and what has been recorded, which comes last. */
typedef struct scene {
  lab_inquiry inquiry;
  lab_trials trials;
  int n; /* of outlooks */
  lab_outlook outlook[LAB_TRIAL_MAX + 1];
  lab_schedule schedule[LAB_TRIAL_MAX + 1];
  pneu_input input[LAB_TRIAL_MAX + 1][LAB_TRIAL_STEPS];
  bundle bundle[LAB_TRIAL_MAX + 1];
  int failed[LAB_TRIAL_MAX + 1]; /* not 0: could not be simulated; the bundle is empty */
  int jerky[LAB_TRIAL_MAX + 1];  /* not 0: stick-slip throughout, too long to simulate many times */
} scene;

/* Check an inquiry and lay out its trials. Where no command moves the stem, advice says so and *made is NULL.
 * Returns: as lab_separate. */
int scene_open(const lab_inquiry *inquiry, scene **made, lab_advice *advice, lab_error *error);
void scene_close(scene *s);

/* Take up a parameter that is not there yet, in the unit that suits s->params.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int side_add(side *s, int param, lab_error *error);

/* What a value of a foreseen channel weighs [1/SI^2] where it is sampled; 0 where it is not recorded. */
double scene_weight(const lab_inquiry *q, const lab_outlook *o, int place);

/* In:      y    slope columns, then the difference: k + 1 columns of LAB_FORESEEN * n
 * Out:     sum  over the recorded channels, weighted */
void bundle_fill(bundle *b, const lab_outlook *o, int k, const double *y);
void bundle_weigh(const bundle *b, const lab_inquiry *q, const lab_outlook *o, lab_normal *sum);

/* Fill the bundles of all outlooks with the slopes of a model and the difference of two others.
 * In:      a, b  may be NULL: no difference
 * Returns: LAB_OK, LAB_WORLD. */
int scene_survey(scene *s, const side *model, const pneu_params *a, const pneu_params *b, lab_error *error);

/* How far [sigma] a model stays from another's prediction, however it is fitted again (Gauss-Newton, few steps).
 * In:      known  what other records say of the same difference, weighted, in the columns of the model
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int pursue(const lab_inquiry *q, const lab_outlook *o, const pneu_params *goal, const side *model,
           const lab_normal *known, double *apart, lab_error *error);

/* The trial of the largest value (of those beyond `enough`, any), the shortest of those within a tenth of it.
 * In:      value  by trial; NaN: not to be had
 * Returns: the trial, -1 if there is none. */
int trial_choose(const lab_trials *trials, const double *value, double enough);

void advice_none(lab_advice *advice, const char *reason);
void advice_say(char text[LAB_ADVICE_TEXT], const char *format, ...) LAB_PRINTF(2, 3);

#endif
