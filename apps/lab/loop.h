/* Close the loop: fit, trace the residual, add the effect, again, until nothing passes.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOOP_H
#define LAB_LOOP_H

#include "trace.h"

enum { LAB_LOOP_EFFECTS = 3, LAB_LOOP_LEADERS = 6 };

enum lab_verdict { LAB_VERDICT_NONE, LAB_VERDICT_EFFECT, LAB_VERDICT_UNLISTED, LAB_VERDICT_UNDECIDED };

typedef struct lab_loop_options {
  double alpha;    /* chance of naming anything when nothing is missing */
  double min_gain; /* share by which an effect must lower the error to be added */
  int max_effects;
} lab_loop_options;

/* An effect that was added. */
typedef struct lab_found {
  int effect, param, shape; /* shape: -1 if none */
  double statistic, p_value, explained;
  double chi2_before, chi2_after; /* of the data */
  int n_alike;                    /* effects that the log cannot tell from it */
  int alike[LAB_TRACE_MAX];
} lab_found;

/* Error of a model on the experiments it was given: root mean square per channel. */
typedef struct lab_errors {
  double rmse[LAB_CHANNEL_COUNT];     /* SI; NaN where not measured */
  double in_noise[LAB_CHANNEL_COUNT]; /* over the noise */
  double chi2;
  size_t n;
} lab_errors;

typedef struct lab_loop_result {
  int verdict; /* enum lab_verdict */
  int n_found;
  lab_found found[LAB_LOOP_EFFECTS];
  lab_errors before, after;
  lab_fit_result fit;     /* of the final model */
  lab_trace_result trace; /* of the declared model: what was tried; to be closed */
  int n_listed;           /* effects that are significant but gain less than min_gain */
  int listed[LAB_TRACE_MAX];
  double level; /* p-value that a single candidate has to pass */
} lab_loop_result;

/* alpha 0.01, min_gain 0.02, three effects. */
void lab_loop_options_default(lab_loop_options *options);

/* Run the loop.
 * In/out:  u       declared model, fitted; then the completed one
 *          result  fit: of the declared model
 * Out:     result  the rest; to be closed with lab_loop_close, also after an error
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_loop_run(lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, lab_error *error);
void lab_loop_close(lab_loop_result *result);

/* Error of the present model of `u` on its experiments. */
int lab_loop_errors(const lab_unknowns *u, lab_errors *errors, lab_error *error);

/* "none", "effect", "unlisted", "undecided" */
const char *lab_verdict_text(int verdict);

#endif
