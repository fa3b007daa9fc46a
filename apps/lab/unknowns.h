/* What a fit of experiments looks for: parameters of the model that all share, and the instants at which the command
 * changed, which a log only brackets between two rows.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_UNKNOWNS_H
#define LAB_UNKNOWNS_H

#include "experiment.h"
#include "fit.h"

enum lab_unknown_kind {
  LAB_UNKNOWN_PARAM, /* index: as in pneu_param_describe, or LAB_FIT_ORIFICE_AREA (a factor) */
  LAB_UNKNOWN_SWITCH /* index: which change of command, counted over all experiments */
};

typedef struct lab_unknown {
  int kind, index;
  char name[LAB_FIT_TEXT];
  char unit[16];
  double value, lower, upper, scale;
  double first;  /* value before any fit */
  double spread; /* of what is known of it beforehand, about `value`; 0: nothing is */
  double prior;  /* value about which the spread is */
} lab_unknown;

typedef struct lab_unknowns {
  const lab_experiment *experiment;
  int n_experiments;
  pneu_params params;   /* of the model, with the latest values of the unknowns in it */
  pneu_params declared; /* as declared; orifice_area scales its areas */
  int n;
  lab_unknown unknown[LAB_FIT_MAX];
  double tol;       /* of the stepper */
  size_t n_data, m; /* measured values; residuals: those, and one for each prior */
} lab_unknowns;

/* Collect the unknowns of a rig's fit list and the switches of the experiments.
 * Returns: LAB_OK; LAB_DATA if there are more than LAB_FIT_MAX (switches are then left out first). */
int lab_unknowns_open(const lab_rig *rig, const lab_experiment *experiment, int n_experiments, lab_unknowns *u,
                      lab_error *error);

/* Take up a parameter, starting from `value`.  Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add(lab_unknowns *u, int param, double value, lab_error *error);

/* Drop a parameter and set it to its neutral value. */
void lab_unknowns_drop(lab_unknowns *u, int param);

/* Parameters of the model at theta (n values). */
void lab_unknowns_params(const lab_unknowns *u, const double *theta, pneu_params *params);

/* Residuals (measured less predicted, over noise; a gap counts 0), then those of the priors. Signature of fit.h.
 * In:      context  const lab_unknowns *
 *          theta    n values, NULL: the present ones
 * Out:     r        m values */
int lab_unknowns_residuals(void *context, const double *theta, double *r, lab_error *error);

/* Residuals with some parameters of the model set to other values, the unknowns as they are.
 * In:      params  in the place of those of the unknowns */
int lab_unknowns_residuals_with(const lab_unknowns *u, const pneu_params *params, double *r, lab_error *error);

/* Slopes d r / d theta by differences, in parallel. Signature of fit.h. */
int lab_unknowns_slopes(void *context, const double *theta, const double *r, double *slope, lab_error *error);

/* Fit by Levenberg-Marquardt from the present values and take up what it finds.
 * Out:     result  may be NULL
 * Returns: as lab_fit_run. */
int lab_unknowns_fit(lab_unknowns *u, lab_fit_result *result, lab_error *error);

#endif
