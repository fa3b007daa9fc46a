/* Candidates: models with what was added to them, fitted; and refits of a model with one addition more.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REFIT_H
#define LAB_REFIT_H

#include "decide.h"
#include "freeterms.h"
#include "onset_score.h"
#include "onset.h"

/* What was added: an effect, or a free term where nothing that has a name would do. */
typedef struct lab_found {
  int effect, param, shape; /* effect: -1 for a free term; shape: -1 if none */
  int term;                 /* of the model's free terms; -1 for an effect */
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

/* Order for qsort: fitted ones first, then by BIC. */
int lab_candidate_by_bic(const void *x, const void *y);

/* Whether something found is an error of a sensor. */
int lab_found_is_of_sensor(const lab_found *found);

/* Whether something was found that begins. */
int lab_candidate_begins(const lab_candidate *c);

/* Take errors of instruments that are far beyond what is known of them beforehand, by odds (ALIKE_BIC), for what is
 * missing, and fit again.
 * In/out:  c    fitted, with what is held among its unknowns
 * Out:     any  whether there are some
 * Returns: as lab_candidate_fit. */
int lab_candidate_take_instruments(lab_candidate *c, int *any, lab_error *error);

/* Place again what begins: about other values it may begin elsewhere.  Returns: LAB_OK, LAB_WORLD */
int lab_candidate_place_again(lab_candidate *c, lab_error *error);

enum { LAB_REFIT_MAX = 40 };

/* Refit the leaders by score, in parallel, from several starts.
 * In:      base   fitted
 *          level  p-value that a score has to pass
 * Out:     c      room for LAB_REFIT_MAX; each has one effect more, fitted or not
 *          n      their number
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_effects(const lab_candidate *base, const lab_scores *scores, double level, lab_candidate *c, int *n,
                      lab_error *error);

/* Where no leader leaves only noise: if none of them is any good beside the declared model, which what is missing may
 * have bent beyond the reach of slopes, refit all that pass; and while none leaves only noise, what the bent fit has
 * hidden.
 * In:      base   to which nothing was added
 * In/out:  c, n   of lab_refit_effects
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_hidden(const lab_candidate *base, const lab_scores *scores, double level, lab_candidate *c, int *n,
                     lab_error *error);

/* Refit the leaders among what may begin within the only run, find when each begins, and keep the best. One that
 * explains no more than if it acted throughout is none.
 * In:      base   fitted, seen row by row
 *          level  p-value that a score has to pass
 *          bar    statistic that it has to exceed
 * Out:     best   fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_onset(const lab_candidate *base, const lab_onset_scores *scores, double level, double bar,
                    lab_candidate *best, lab_error *error);

/* Refit the leaders among what may begin at a row, and find when near it each begins.
 * In:      base   as of lab_refit_onset, fitted or not
 *          row    of the only run
 * Out:     c      room for ONSET_LEADERS; n of them, best first, fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_onsets_at(const lab_candidate *base, const lab_onset_scores *scores, double level, size_t row,
                        lab_candidate *c, int *n, lab_error *error);

/* Refit the leaders among what may begin in place of what does in a candidate, at the same time; at another where that
 * leaves more than noise.
 * In:      c      to which what begins was added last
 *          level  as of lab_refit_onset
 * Out:     other  room for LAB_REFIT_MAX; n of them, fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_instead(const lab_candidate *c, const lab_onset_scores *scores, double level, lab_candidate *other,
                      int *n, lab_error *error);

/* Refit the best free terms, in parallel: briefly, then the best few of them to the end; a term that acts on a short
 * stretch gets its knots there.
 * In:      base   fitted
 *          score  n of them, best first
 * Out:     best   fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_free_terms(const lab_candidate *base, const lab_term_score *score, int n, lab_candidate *best,
                         lab_error *error);

#endif
