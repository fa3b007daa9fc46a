/* Candidates: models with what was added to them, fitted.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CANDIDATE_H
#define LAB_CANDIDATE_H

#include "decide.h"
#include "onset.h"
#include "score.h"

/* What was added: an effect, or a free term where nothing that has a name would do. */
typedef struct lab_found {
  int effect, param; /* effect: -1 for a free term */
  int term;          /* of the model's free terms; -1 for an effect */
  double statistic, p_value, explained;
  int degrees;  /* of freedom of the statistic */
  double scale; /* free term: a value of it that matters */
  int n_alike;  /* effects that the log cannot tell from it */
  int alike[LAB_SCORES_MAX];
  pneu_params alike_params[LAB_LEADERS_MAX]; /* models with the first of them in its place, fitted */
} lab_found;

typedef struct lab_candidate {
  lab_unknowns u;
  lab_quality quality;
  int n_found;
  lab_found found[LAB_EFFECTS_MAX];
  lab_onset begin[LAB_ONSETS_MAX]; /* of the onsets of u.rig */
} lab_candidate;

/* Fit from its present values.
 * In:      steps  as for lab_unknowns_fit
 * Returns: as lab_unknowns_fit; quality.fitted says whether it was LAB_OK. */
int lab_candidate_fit(lab_candidate *c, int steps, lab_error *error);

/* Fit with what is held among its unknowns; once more where that leaves much less.
 * Returns: LAB_OK, also where it cannot be fitted, as quality.fitted says; LAB_WORLD. */
int lab_candidate_fit_held(lab_candidate *c, lab_error *error);

/* Fit to the first n rows of the only run; where that fails, values stay.
 * In:      steps   as for lab_unknowns_fit; LAB_ROUNDS_ALL: as lab_candidate_fit_held
 * In/out:  c       as a model of the whole run, row by row; its quality is that of the beginning
 * Returns: LAB_OK, LAB_WORLD. */
int lab_candidate_fit_beginning(lab_candidate *c, size_t n, int steps, lab_error *error);

/* Let values go that are held far from where the logs want them, one after the other, while BIC falls: many values that
 * are each off a little, at the cost of a square, pass for one that is off by much. It is the one that is told. Where
 * much more is left than noise, something is missing, for which these values would make up: none is let go.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_candidate_let_go(lab_candidate *c, lab_error *error);

/* Hold what is declared to its tolerances, and fit so.
 * Returns: LAB_OK, also where it cannot be fitted, as quality.fitted says; LAB_DATA if there is no room; LAB_WORLD. */
int lab_candidate_hold(lab_candidate *c, lab_error *error);

/* The same effects from the declared values: fitted with these exactly as they are, and then within their tolerances.
 * In:      declared  with nothing held and nothing added, fitted
 * Returns: LAB_OK; LAB_DATA if there is no room; as lab_unknowns_fit. */
int lab_candidate_stage(const lab_candidate *c, const lab_unknowns *declared, lab_candidate *staged, lab_error *error);

/* Say what the last addition did to chi-square. */
void lab_candidate_explain(lab_candidate *c, double chi2_before);

/* "declared model", or what was found, joined by " + ".  Out: text */
void lab_candidate_name(const lab_candidate *c, char *text, size_t size);

/* Whether something holds of one of n candidates, such as lab_is_noise. */
int lab_any(const lab_candidate *c, int n, int (*is)(const lab_quality *q));

/* Least chi-square of n candidates; infinite if none is fitted. */
double lab_least_chi2(const lab_candidate *c, int n);

/* Order for qsort: fitted ones first, then by BIC. */
int lab_candidate_by_bic(const void *x, const void *y);

/* Whether something found is an error of a sensor. */
int lab_found_is_of_sensor(const lab_found *found);

/* Whether something was found that acts on the stem or its air: an error of a sensor makes no stem stick and slip. */
int lab_candidate_has_cause(const lab_candidate *c);

/* Whether a model needs more than FAR_VALUES values STRAINED tolerances off their sheet, one of them not in `fit`: a
 * rig is seldom so. What one cause moves together counts once. */
int lab_candidate_is_far(const lab_unknowns *u);

/* Whether something was found that begins. */
int lab_candidate_begins(const lab_candidate *c);

/* Take errors of instruments, and a vent off beside the fill orifice, that are far beyond what is known of them
 * beforehand, by odds (ALIKE_BIC), for what is missing, and fit again.
 * In/out:  c    fitted, with what is held among its unknowns
 * Out:     any  whether there are some
 * Returns: as lab_candidate_fit. */
int lab_candidate_take_instruments(lab_candidate *c, int *any, lab_error *error);

/* Place again what begins: about other values it may begin elsewhere; where only noise is left, near where it does.
 * Returns: LAB_OK, LAB_WORLD */
int lab_candidate_place_again(lab_candidate *c, lab_error *error);

/* Where a fitted model leaves more than noise, give its last effect the forms that it may do without
 * (PNEU_FORM_OPTION); it keeps them if BIC asks for that.  Returns: LAB_OK, LAB_WORLD */
int lab_candidate_try_options(lab_candidate *c, lab_error *error);

/* One more addition, to be filled in.  Returns: its place. */
lab_found *lab_candidate_add_found(lab_candidate *c);

/* Add an effect that was scored, its parameter `size` away from neutral; not fitted.
 * Returns: LAB_OK; LAB_DATA if there is no room. */
int lab_candidate_add_effect(lab_candidate *c, const lab_score *score, double size, lab_error *error);

/* Whether two candidates have the same, whatever was added first, beside one addition of each; -1: beside nothing. */
int lab_candidate_is_alike_but(const lab_candidate *a, int which_a, const lab_candidate *b, int which_b);

/* Note of one of a candidate's effects which of a pool's, each added last, are as good in its place: a better fit by
 * one unknown more is no reason to choose it, but nor does the log speak against it.
 * In:      pool  n candidates */
void lab_candidate_note_alike(lab_candidate *c, int which, const lab_candidate *pool, int n);

/* Drop one of what was found; a free term only if it was added last. */
void lab_candidate_drop(lab_candidate *c, int which);

/* Drop what the last fit has put to its neutral value. */
void lab_candidate_drop_neutral(lab_candidate *c);

/* Without one of what was found, fitted again, or not fitted where no fit is found.  Returns: LAB_OK, LAB_WORLD. */
int lab_candidate_leave_out(const lab_candidate *c, int which, lab_candidate *without, lab_error *error);

/* Drop each effect among the first n of what was found without which BIC is no higher; one is left.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_candidate_drop_needless(lab_candidate *c, int n, lab_error *error);

/* Whether it leaves white noise on every channel; never where it is seen coarsely.  Returns: as lab_unknowns_residuals
 */
int lab_candidate_is_white(const lab_candidate *c, int *white, lab_error *error);

#endif
