/* What a fit of experiments looks for: parameters of the model that all experiments share or that each has for itself,
 * the knots of free terms, and the instants at which the command changed, which a log only brackets between two rows:
 * one for each change, or, where it changes often, one share of the row for all changes of an experiment.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_UNKNOWNS_H
#define LAB_UNKNOWNS_H

#include "../base/whiteness.h"
#include "../run/run.h"
#include "spread.h"

enum lab_unknown_kind {
  LAB_UNKNOWN_PARAM,   /* index: as in pneu_param_describe, or LAB_PARAM_ORIFICE_AREA (a factor) */
  LAB_UNKNOWN_KNOT,    /* index: knot of free term `term` */
  LAB_UNKNOWN_PERIOD,  /* of free term `term` over a cycle */
  LAB_UNKNOWN_INSTANT, /* how early: index: which change of command of its experiment [s], or LAB_ALL_INSTANTS [row] */
  LAB_UNKNOWN_ONSET,   /* index: which onset of the model: the value from then on */
  LAB_UNKNOWN_SINCE,   /* index: which onset of the model: when that is [s] */
  LAB_UNKNOWN_CHANGE   /* index: as of LAB_UNKNOWN_PARAM: what is added to it, or the share by which orifice_area grows,
                          from run `run` to the last */
};

enum { LAB_ALL_RUNS = -1, LAB_ALL_INSTANTS = -1 };

typedef struct lab_unknown {
  int kind, index, term;
  int run; /* whose it is, or LAB_ALL_RUNS; of a change, the first that it is of */
  char name[LAB_PARAM_NAME_TEXT];
  char unit[32];
  double value, lower, upper, scale;
  double first;    /* value before any fit */
  double from, to; /* [s] of a change: the times of the log between which it acts; infinite: all of it */
  double spread;   /* of what is known of it beforehand, about `prior`; 0: nothing is */
  double prior;
  double tolerance; /* of a declared value that is held: its spread while it is; 0: it is none */
} lab_unknown;

typedef struct lab_unknowns {
  const lab_run *run;
  int n_runs;
  lab_rig rig;          /* the model, with the latest values of the unknowns in it */
  pneu_params declared; /* as declared; orifice_area scales its areas */
  int n;
  lab_unknown unknown[LAB_FIT_MAX];
  double tol;        /* of the stepper; 0: as in response.h */
  double misfit;     /* 1 or more: times the noise that is left; what is held counts as if that were the noise */
  double own_misfit; /* the same for what each log has for itself */
  double most_off;   /* tolerances that a fit may take a value off its sheet; 0: any */
  double until;      /* [s] of CPU time, after which a fit ends where it is; 0: there is no end */
  size_t n_rows;     /* rows times channels, gaps among them */
  size_t window;     /* rows of a window where the residuals are those of windowed.h; 0: row by row */
  size_t n_values;   /* residuals of the data that are not of gaps */
  size_t n_data, m;  /* residuals of the data; all residuals: those, one for each value of `nuisance`, and for each
                        unknown */
  double *slopes;    /* where a fit leaves its slopes for the next, m of each unknown; NULL: nowhere */
  char has_slope[LAB_FIT_MAX];         /* whether that of an unknown is there already, nearly */
  const struct lab_nuisance *nuisance; /* declared values that may vary unseen; NULL: none (nuisance.h) */
  const struct lab_linear *linear;     /* runs that are followed to first order; NULL: none (linear.h) */
} lab_unknowns;

/* No unknowns: the model as it is, every change of command at the row that shows it, and nothing fitted but where each
 * experiment starts, which its first rows tell. Its errors are those of what `simulate` predicts. */
void lab_unknowns_none(const lab_rig *rig, const lab_run *run, int n_runs, lab_unknowns *u);

/* The same but for what each log has for itself (fit_per_log).  Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_own(const lab_rig *rig, const lab_run *run, int n_runs, lab_unknowns *u, lab_error *error);

/* The rig as another log of it is expected: what each log had for itself (fit_per_log) is its mean over the logs
 * fitted, and where there are three or more known to how far one log is from that; what the rig file gives a tolerance
 * stays as declared. */
lab_rig lab_unknowns_expected(const lab_unknowns *u);

/* Collect the unknowns of a rig's fit list and the switches of the experiments.
 * Returns: LAB_OK; LAB_DATA if there are more than LAB_FIT_MAX (switches are then left out first). */
int lab_unknowns_open(const lab_rig *rig, const lab_run *run, int n_runs, lab_unknowns *u, lab_error *error);

/* Whether the instants of the changes of command are so near the rows that show them that they may all be there: the
 * squares over their spread of those after the middle of their rows are 0.5 for each instant in the mean where they are
 * anywhere, 3 where all are at their rows, and 0 where the log does not tell. */
int lab_unknowns_are_at_rows(const lab_unknowns *u);

/* Hold what the rig declares, and the errors of its instruments, to their tolerances (tolerance.h) instead of exactly:
 * what is not fitted becomes an unknown about its declared value.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_hold(lab_unknowns *u, lab_error *error);

/* Take the misfit for what the present model leaves: beside an error of 60 times the noise, a value that is 100
 * tolerances off would weigh nothing.  Returns: as lab_unknowns_residuals. */
int lab_unknowns_weigh_held(lab_unknowns *u, lab_error *error);

/* The same for what each log has for itself.  Returns: as lab_unknowns_residuals. */
int lab_unknowns_weigh_own(lab_unknowns *u, lab_error *error);

/* Whether the misfit has fallen so much that it is to be taken once more, and fitted again. */
int lab_misfit_has_fallen(double before, double now);

/* Whether each log has it for itself, and it is known to a tolerance. */
int lab_unknown_differs(const lab_unknown *x);

/* How far what is known of an unknown lets it vary: its spread, less where the model leaves more than noise. */
double lab_unknown_reach(const lab_unknowns *u, const lab_unknown *x);

/* Whether parameter `param` is a value of the rig, and no part of an effect. */
int lab_param_is_value(int param);

/* Damping and viscous friction add up to one coefficient.  Returns: the other of these two; -1 for all else */
int lab_param_twin(int param);

/* Whether parameter `param` is an error of a sensor, and no value of the rig. */
int lab_param_is_of_sensor(int param);

/* The tolerance of a declared value that is to be held, in its unit; 0 where it, its scale or its twin is fitted, or
 * the twin is known less well. */
double lab_unknowns_to_hold(const lab_unknowns *u, const lab_rig *declared, int param);

/* Let a declared value vary that was not held.  Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_free_value(lab_unknowns *u, int param, lab_error *error);

/* Let a held value go: nothing is known of it any more, but it is still compared with its declared value. */
void lab_unknowns_let_go(lab_unknowns *u, int j);

/* Whether an unknown is a declared value that was held and let go. */
int lab_unknown_is_let_go(const lab_unknown *x);

/* Hold no longer: what was held stays in the model as it is, but for what does not act there (lab_rig_drop_idle).
 * In/out:  result  intervals of the unknowns, from which it is taken out; NULL: none */
void lab_unknowns_settle(lab_unknowns *u, lab_fit_result *result);

/* Whether an unknown rests at the value that has no effect (trace/absent.h). */
int lab_unknown_rests(const lab_unknown *x);

/* Whether it is the size of a declared effect, and rests there: the logs refute the effect. */
int lab_unknown_is_absent(const lab_unknown *x);

/* Whether something is known of an unknown beforehand: it is held, or the instant of a command. */
int lab_unknown_is_known(const lab_unknown *x);

/* Whether an unknown is held. One that was added is not. */
int lab_unknown_is_held(const lab_unknown *x);

/* Take up a parameter that all experiments share, starting from `value`; one that is held is let go.
 * Damping stays above 2 % of what is declared.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add(lab_unknowns *u, int param, double value, lab_error *error);

/* A stem that is hardly damped hunts behind a positioner, and a fit that has gone there does not come back. Leave such
 * a damping as it is declared, known to its own size, to vary with what is held, and the others as they were before a
 * fit.  Returns: whether it was one */
int lab_unknowns_leave_damping(lab_unknowns *u);

/* Take up a free term, whose values in `term` are the start; over a cycle, with its period.
 * In:      scale  a value of it that matters, in its unit
 *          held   knots at either end that keep their values
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add_term(lab_unknowns *u, const pneu_term *term, double scale, int held, lab_error *error);

/* Take up runs that follow those there are: what each run has for itself is found for them as well.
 * In:      run     n_runs of them, those of u first; used as long as u is
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_join(lab_unknowns *u, const lab_run *run, int n_runs, lab_error *error);

/* Take up the change of a parameter from one run on, starting from none.
 * In:      param   as in pneu_param_describe, or LAB_PARAM_ORIFICE_AREA
 *          run     the first that has it
 *          spread  of what is known of the change beforehand, about 0; 0: nothing is
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add_change(lab_unknowns *u, int param, int run, double spread, lab_error *error);

/* Take up a parameter that has another value from some time on, starting from `value`.
 * In:      param  as in pneu_param_describe, or LAB_PARAM_ORIFICE_AREA, whose value is then a factor
 *          from   [s] of the log; no earlier than that of an onset before it
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add_onset(lab_unknowns *u, int param, double from, double value, lab_error *error);

/* Take up when the last onset is, starting from where it is: between the first and the last row of the only run; and
 * drop it again, wherever it is.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_unknowns_add_since(lab_unknowns *u, lab_error *error);
void lab_unknowns_drop_since(lab_unknowns *u);

/* Drop the last onset. */
void lab_unknowns_drop_onset(lab_unknowns *u);

/* Place among the unknowns of the value that a parameter has from an onset on, -1 if it has none. */
int lab_unknowns_find_onset(const lab_unknowns *u, int param);

/* Drop the last free term. */
void lab_unknowns_drop_term(lab_unknowns *u);

/* Whether unknown j is a value of the rig that is so many tolerances off its declared one, or more. What is fitted may
 * be off by much, but one that runs away stands in for what is missing: a damping of 20 times its sheet for a lag or a
 * stem that sticks. */
int lab_unknown_is_far(const lab_unknowns *u, int j, double tolerances);

/* Whether any is. */
int lab_unknowns_is_far(const lab_unknowns *u, double tolerances);

/* Let none be further off from now on, what is added neither. */
void lab_unknowns_stay_near(lab_unknowns *u, double tolerances);

/* Drop a parameter and set it to its neutral value; one that was held is held again. */
void lab_unknowns_drop(lab_unknowns *u, int param);

/* Count the residuals, after a change of the unknowns. */
void lab_unknowns_count(lab_unknowns *u);

/* Put the values of the unknowns into a model: those of all experiments, then those of one.
 * In:      theta       n values
 *          experiment  which one, or LAB_ALL_RUNS
 * In/out:  rig         its parameters and free terms change */
void lab_unknowns_apply(const lab_unknowns *u, const double *theta, int run, lab_rig *rig);

/* The present values.  Out: theta  n of them */
void lab_unknowns_values(const lab_unknowns *u, double *theta);

/* Put those that all runs share into the model. */
void lab_unknowns_take(lab_unknowns *u);

/* Take the values that the unknowns had before any fit. */
void lab_unknowns_undo_fit(lab_unknowns *u);

/* Residuals (measured less predicted, over noise, whitened where the noise has memory; a gap counts 0), then those of
 * the priors.
 * In:      context  const lab_unknowns *
 *          theta    n values, NULL: the present ones
 * Out:     r        m values */
int lab_unknowns_residuals(void *context, const double *theta, double *r, lab_error *error);

/* The same of the runs that have unknown `which`; -1: of all.
 * In/out:  r       those of other runs stay */
int lab_unknowns_residuals_of(const lab_unknowns *u, const double *theta, int which, double *r, lab_error *error);

/* What other values change in the residuals of the runs that have unknown `which`.
 * In:      theta   n values
 *          r       residuals, m values
 * Out:     change  m values; 0 of other runs */
int lab_unknowns_change(const lab_unknowns *u, const double *theta, int which, const double *r, double *change,
                        lab_error *error);

/* Their sum of squares at the present values; 0 where they are not to be had.  Returns: as lab_unknowns_residuals. */
int lab_unknowns_chi2(const lab_unknowns *u, double *chi2, lab_error *error);

/* Those of all with another model, for the unknowns as they are.
 * In:      rig  in the place of the model; what each experiment has for itself still applies */
int lab_unknowns_residuals_with(const lab_unknowns *u, const lab_rig *rig, double *r, lab_error *error);

/* What another model changes in them, of all.
 * In:      r       residuals of the model as it is
 * Out:     change  u->m values */
int lab_unknowns_change_with(const lab_unknowns *u, const lab_rig *rig, const double *r, double *change,
                             lab_error *error);

/* The same of several models, to first order, from one run of each experiment (variation.h).
 * In:      model   n of them
 * Out:     change  m * n values, model by model, of those that are done
 *          done    n: not 0 for these; none of what is seen coarsely
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unknowns_changes_with(const lab_unknowns *u, const lab_rig *model, int n, double *change, char *done,
                              lab_error *error);

/* See the experiments coarsely from now on, in windows of so many rows; 0: row by row. */
void lab_unknowns_view(lab_unknowns *u, size_t window);

/* Whether the stem of an experiment sticks and slips where the present model's does not.
 * In:      by_stem  not 0: by its position alone; a positioner that makes up for a leak moves the pressure, and no stem
 * Out:     window  rows in which to see the experiments coarsely if one does; else 0
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unknowns_sticks_and_slips(const lab_unknowns *u, int by_stem, size_t *window, lab_error *error);

/* What is left on one channel for the present unknowns. */
typedef struct lab_residual_stats {
  lab_whiteness whiteness; /* of the residuals as they are fitted: whitened where the noise has memory; n is 0 where the
                              channel is not measured */
  int even;                /* not 0: as large everywhere, and no more than one and a half times as large as declared */
  int steady;              /* not 0: as large in quick and in slow motion as at rest, and no more than that: a sensor's,
                              whatever its memory, for what a model lacks shows in motion as a rule */
} lab_residual_stats;

/* Look at what is left, row by row: u->window is 0.  Out: left  Returns: as lab_unknowns_residuals. */
int lab_unknowns_residual_stats(const lab_unknowns *u, lab_residual_stats left[LAB_CHANNEL_COUNT], lab_error *error);

/* Channels on which what is left is coloured; whether it is white on every one that is measured; whether it is noise
 * there: white and even; whether it is a sensor's there: noise or steady. */
int lab_residual_stats_coloured(const lab_residual_stats left[LAB_CHANNEL_COUNT]);
int lab_residual_stats_white(const lab_residual_stats left[LAB_CHANNEL_COUNT]);
int lab_residual_stats_noise(const lab_residual_stats left[LAB_CHANNEL_COUNT]);
int lab_residual_stats_of_sensors(const lab_residual_stats left[LAB_CHANNEL_COUNT]);

/* Errors over noise, row by row and not whitened: n_rows values for the present unknowns. */
int lab_unknowns_errors(const lab_unknowns *u, double *r, lab_error *error);

/* Errors of a run, or a change of them, as residuals: weighted and whitened, in place. */
void lab_unknowns_weigh(const lab_unknowns *u, int run, double *r);

/* Slopes of the residuals from one run of each experiment, to first order (variation.h).
 * In:      context  const lab_unknowns *
 * In/out:  done     n: columns that are there, and then those of J that were found too; none of what is seen coarsely
 *          J        m * n, column by column
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unknowns_slopes_together(void *context, const double *theta, double *J, char *done, lab_error *error);

/* Slopes of the residuals r at the present values, those that are `done` already apart; 0 where one is not to be had.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unknowns_slopes(lab_unknowns *u, const double *r, char *done, double *J, lab_error *error);

/* Step of the difference that a slope in unknown j is, into the side where there is room. */
double lab_unknowns_slope_step(const lab_unknowns *u, const double *theta, int j);

/* Residuals of one experiment. */
size_t lab_unknowns_residuals_in(const lab_unknowns *u, int run);

/* Residuals before those of the unknowns' priors: of the data, and of `nuisance`. */
size_t lab_unknowns_before_priors(const lab_unknowns *u);

/* Slope in unknown j of the residual of its prior.  In/out: column  u->m values, of which it is one */
void lab_unknowns_slope_of_prior(const lab_unknowns *u, int j, double *column);

/* Slope of the residuals in unknown j by a difference of `step` in the unknown, which is where the runs that have it
 * are predicted again.
 * In:      r       residuals at theta
 * Out:     column  u->m values */
int lab_unknowns_difference(const lab_unknowns *u, const double *theta, const double *r, int j, double step,
                            double *column, lab_error *error);

/* The same with a small step, into the side where there is room. */
int lab_unknowns_slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error);

/* Fit from the present values and take up what is found. What each log has for itself is weighed by what is left, and
 * once more while that falls.
 * In:      steps  downhill, at most; LAB_ROUNDS_ALL: as usual
 * Out:     chi2   may be NULL
 * Returns: as lab_fit. */
enum { LAB_ROUNDS_ALL = 0 };
int lab_unknowns_fit(lab_unknowns *u, int steps, double *chi2, lab_error *error);

/* Keep slopes from fit to fit from now on, none of which is known yet; not where a log is so long that they would take
 * more than 32 MB, nor where a view is coarse. A copy of `u` shares them, until one of the two forgets them.
 * Returns: LAB_OK, LAB_WORLD */
int lab_unknowns_keep_slopes(lab_unknowns *u, lab_error *error);
void lab_unknowns_forget_slopes(lab_unknowns *u);

/* Slopes of all unknowns at their present values, where they are kept: the next fit begins with them.
 * Returns: as lab_fit_slopes. */
int lab_unknowns_find_slopes(lab_unknowns *u, lab_error *error);

/* Begin the next fit with the slopes of a model of the same runs, for the unknowns that it has as well. */
void lab_unknowns_begin_with(lab_unknowns *u, const lab_unknowns *base);

/* What the data say of each unknown, at a fit: intervals, correlations, remarks.  Returns: as lab_fit_spread. */
int lab_unknowns_intervals(lab_unknowns *u, lab_fit_result *result, lab_error *error);

/* Place of a parameter among the unknowns, -1 if it is none of them. */
int lab_unknowns_find(const lab_unknowns *u, int param);

#endif
