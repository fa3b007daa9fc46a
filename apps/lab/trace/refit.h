/* Refits of a model with one addition more: an effect, what begins within the run, or a free term.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REFIT_H
#define LAB_REFIT_H

#include "candidate.h"
#include "freeterms.h"
#include "onset_score.h"

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

/* Whether of two models in which something begins the first is to be preferred: by BIC, but a value that changes needs
 * nothing new to begin, and gives way to an effect only by odds (ALIKE_BIC).  In: fitted or not */
int lab_refit_is_simpler(const lab_candidate *a, const lab_candidate *b);

/* Put the one of n, best first, before the others that is to be preferred to them. */
void lab_refit_put_simplest_first(lab_candidate *c, int n);

/* Refit the leaders among what may begin, each at the row of its score, briefly.
 * In:      base   as of lab_refit_onset, fitted or not
 * Out:     c      room for ONSET_LEADERS; n of them, best first, fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_refit_onsets_at(const lab_candidate *base, const lab_onset_scores *scores, double level, lab_candidate *c,
                        int *n, lab_error *error);

/* Find when near its time each of n begins that is among the best or comes near, and put the simplest of the best
 * first.  Returns: LAB_OK, LAB_WORLD. */
int lab_refit_place_onsets(lab_candidate *c, int n, lab_error *error);

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
