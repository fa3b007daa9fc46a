/* Close the loop: fit, trace the residual, add the effect, again, until nothing passes.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOOP_H
#define LAB_LOOP_H

#include "../fit/errors.h"
#include "slots.h"
#include "trace.h"

enum { LAB_LOOP_EFFECTS = 3, LAB_LOOP_LEADERS = 7, LAB_LOOP_STEPS = 160, LAB_LOOP_PATH = 8 };

enum lab_verdict { LAB_VERDICT_NONE, LAB_VERDICT_EFFECT, LAB_VERDICT_UNLISTED, LAB_VERDICT_UNDECIDED };

typedef struct lab_loop_options {
  double alpha;    /* chance of naming anything when nothing is missing */
  double min_gain; /* share by which an effect must lower the error of some channel to be added */
  int max_effects;
  void (*tell)(void *context, const char *what); /* told what is being done; may be NULL */
  void *context;
} lab_loop_options;

/* What was added: an effect, or a free term where nothing that has a name would do. */
typedef struct lab_found {
  int effect, param, shape; /* effect: -1 for a free term; shape: -1 if none */
  int term;                 /* of the model's free terms; -1 for an effect */
  double statistic, p_value, explained;
  int degrees;  /* of freedom of the statistic */
  double scale; /* free term: a value of it that matters */
  int n_alike;  /* effects that the log cannot tell from it */
  int alike[LAB_TRACE_MAX];
  pneu_params alike_params[LAB_LOOP_LEADERS]; /* models with the first of them in its place, fitted */
} lab_found;

/* A model that was tried: the declared one first. */
typedef struct lab_step {
  char name[LAB_FIT_TEXT]; /* of what it has beyond the declared model, joined by " + " */
  double chi2, bic;        /* of the residuals; Schwarz 1978 */
} lab_step;

/* A model that the search went on from, fitted. */
typedef struct lab_waypoint {
  char name[LAB_FIT_TEXT];
  double chi2, bic;
  lab_rig rig;
} lab_waypoint;

typedef struct lab_loop_result {
  int verdict; /* enum lab_verdict */
  int n_found;
  lab_found found[LAB_LOOP_EFFECTS];
  lab_errors before, after;
  lab_fit_result fit;     /* of the final model */
  lab_trace_result trace; /* of the declared model: what was tried */
  double trace_s;         /* [s] that this scan took */
  int n_listed;           /* effects that are significant but gain less than min_gain */
  int listed[LAB_TRACE_MAX];
  int has_small;   /* not 0: a free term is significant but gains less than min_gain */
  pneu_term small; /* that term */
  int n_steps;
  lab_step step[LAB_LOOP_STEPS];
  int n_path; /* models from the declared one to the final one */
  lab_waypoint path[LAB_LOOP_PATH];
  size_t window; /* rows of a window if the log is rough and was seen coarsely (coarse.h); else 0 */
  double level;  /* p-value that a single candidate has to pass */
} lab_loop_result;

/* alpha 0.01, min_gain 0.02, three effects. */
void lab_loop_options_default(lab_loop_options *options);

/* Run the loop.
 * In/out:  u       declared model, fitted; then the completed one
 * Out:     result
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_loop_run(lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, lab_error *error);

/* "none", "effect", "unlisted", "undecided" */
const char *lab_verdict_text(int verdict);

#endif
