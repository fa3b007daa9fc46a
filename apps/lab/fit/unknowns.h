/* What a fit of experiments looks for: parameters of the model that all experiments share or that each has for itself,
 * the knots of free terms, and the instants at which the command changed, which a log only brackets between two rows.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_UNKNOWNS_H
#define LAB_UNKNOWNS_H

#include "../run/experiment.h"
#include "fit.h"

enum lab_unknown_kind {
  LAB_UNKNOWN_PARAM,  /* index: as in pneu_param_describe, or LAB_FIT_ORIFICE_AREA (a factor) */
  LAB_UNKNOWN_KNOT,   /* index: knot of free term `term` */
  LAB_UNKNOWN_PERIOD, /* of free term `term` over a cycle */
  LAB_UNKNOWN_SWITCH  /* index: which change of command, counted over all experiments */
};

enum { LAB_ALL_EXPERIMENTS = -1 };

typedef struct lab_unknown {
  int kind, index, term;
  int experiment; /* whose it is, or LAB_ALL_EXPERIMENTS */
  char name[LAB_FIT_TEXT];
  char unit[32];
  double value, lower, upper, scale;
  double first;  /* value before any fit */
  double spread; /* of what is known of it beforehand, about `prior`; 0: nothing is */
  double prior;
} lab_unknown;

typedef struct lab_unknowns {
  const lab_experiment *experiment;
  int n_experiments;
  lab_rig rig;          /* the model, with the latest values of the unknowns in it */
  pneu_params declared; /* as declared; orifice_area scales its areas */
  int n;
  lab_unknown unknown[LAB_FIT_MAX];
  double tol;       /* of the stepper */
  size_t n_rows;    /* rows times channels, gaps among them */
  size_t window;    /* rows of a window where the residuals are those of coarse.h; 0: row by row */
  size_t n_values;  /* residuals of the data that are not of gaps */
  size_t n_data, m; /* residuals of the data; all residuals: those, and one for each unknown */
} lab_unknowns;

/* Collect the unknowns of a rig's fit list and the switches of the experiments.
 * Returns: LAB_OK; LAB_DATA if there are more than LAB_FIT_MAX (switches are then left out first). */
int lab_unknowns_open(const lab_rig *rig, const lab_experiment *experiment, int n_experiments, lab_unknowns *u,
                      lab_error *error);

/* Take up a parameter that all experiments share, starting from `value`.  Returns: LAB_OK; LAB_DATA if there is no
 * room. */
int lab_unknowns_add(lab_unknowns *u, int param, double value, lab_error *error);

/* Take up a free term, whose values in `term` are the start; over a cycle, with its period.
 * In:      scale  a value of it that matters, in its unit
 *          held   knots at either end that keep their values
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add_term(lab_unknowns *u, const pneu_term *term, double scale, int held, lab_error *error);

/* Drop the last free term. */
void lab_unknowns_drop_term(lab_unknowns *u);

/* Drop a parameter and set it to its neutral value. */
void lab_unknowns_drop(lab_unknowns *u, int param);

/* Put the values of the unknowns into a model: those of all experiments, then those of one.
 * In:      theta       n values
 *          experiment  which one, or LAB_ALL_EXPERIMENTS
 * In/out:  rig         its parameters and free terms change */
void lab_unknowns_apply(const lab_unknowns *u, const double *theta, int experiment, lab_rig *rig);

/* Residuals (measured less predicted, over noise, whitened where the noise has memory; a gap counts 0), then those of
 * the priors.
 * In:      context  const lab_unknowns *
 *          theta    n values, NULL: the present ones
 * Out:     r        m values */
int lab_unknowns_residuals(void *context, const double *theta, double *r, lab_error *error);

/* The same with another model, for the unknowns as they are.
 * In:      rig  in the place of the model; what each experiment has for itself still applies */
int lab_unknowns_residuals_with(const lab_unknowns *u, const lab_rig *rig, double *r, lab_error *error);

/* See the experiments coarsely from now on, in windows of so many rows; 0: row by row. */
void lab_unknowns_view(lab_unknowns *u, size_t window);

/* Whether the stem of an experiment sticks and slips where the present model's does not.
 * Out:     window  rows in which to see the experiments coarsely if one does; else 0
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unknowns_rough(const lab_unknowns *u, size_t *window, lab_error *error);

/* Whether what is left for the present unknowns is noise of up to one and a half times the size that was declared:
 * white, and as large everywhere.  Out: white  Returns: as lab_unknowns_residuals. */
int lab_unknowns_white(const lab_unknowns *u, int *white, lab_error *error);

/* Errors over noise, row by row and not whitened: n_rows values for the present unknowns. */
int lab_unknowns_errors(const lab_unknowns *u, double *r, lab_error *error);

/* Slope of the residuals in unknown j by a difference. */
int lab_unknowns_slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error);

/* Fit from the present values and take up what is found.
 * In:      steps  downhill, at most; LAB_FIT_WHOLE: as many as it takes
 * Out:     chi2   may be NULL
 * Returns: as lab_descend. */
enum { LAB_FIT_WHOLE = 40 };
int lab_unknowns_fit(lab_unknowns *u, int steps, double *chi2, lab_error *error);

/* What the data say of each unknown, at a fit: intervals, correlations, remarks.  Returns: as lab_fit_run. */
int lab_unknowns_spread(lab_unknowns *u, lab_fit_result *result, lab_error *error);

/* Place of a parameter among the unknowns, -1 if it is none of them. */
int lab_unknowns_find(const lab_unknowns *u, int param);

#endif
