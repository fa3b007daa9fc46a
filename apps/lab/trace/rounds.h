/* The rounds of one search: a declared model is extended by what its residual speaks for, until nothing passes. What is
 * done when, and what is kept, is decided by the rules of decide.h.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ROUNDS_H
#define LAB_ROUNDS_H

#include "search.h"

/* What a search makes of the logs. */
typedef struct lab_finding {
  lab_candidate declared; /* with what is held */
  lab_candidate best;
  const lab_unknowns *exact; /* the declared model with nothing held, fitted; NULL: there is none */
  lab_candidate *held;       /* room for it within its tolerances (lab_contest_hold); NULL: of a part of a run */
  double held_s;             /* [s] of CPU that its fit took */
  double start;              /* [s] of CPU time at which the search began */
  double gain;               /* of chi-square, by tolerances after the search */
  lab_onset_scores begins;   /* what may begin */
  size_t sound;              /* rows of a run of which `best` is known to leave only noise; 0: of all, or of none */
  lab_search_result result;
} lab_finding;

/* Whether something may begin within the logs: they are one run, seen row by row, of which nothing begins yet. */
int lab_rounds_may_begin(const lab_unknowns *u, const lab_search_options *options);

/* Note a model that was tried. */
void lab_rounds_note_step(lab_search_result *result, const lab_candidate *c);

/* What is concluded from the model that a search ends with.  Returns: enum lab_verdict */
int lab_rounds_verdict(const lab_candidate *best);

/* Note a model that the search goes on from; the one noted last as it is now, with all its values fitted. */
void lab_rounds_note_way(lab_search_result *result, const lab_candidate *c);
void lab_rounds_note_values(lab_search_result *result, const lab_unknowns *u);

/* The search from a declared model, in the view that its unknowns have.
 * In:      begun    from the declared model with what is known to be missing, fitted, as its best; NULL: from the
 *                   declared model
 *          within   the same with its values within tolerances, which the search is to beat; may be NULL
 * In/out:  f        declared: fitted or not; fitted once more, which finds the end of a valley. With `begun` it is
 *                   fitted already and stays as it is
 *                   best: with what was added
 *                   result: all but the errors, the fit and what was found
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_rounds_run(lab_finding *f, const lab_finding *begun, const lab_quality *within,
                   const lab_search_options *options, lab_error *error);

#endif
