/* The rounds of a search, over several files: where a search is, and what its files ask of each other. Private to
 * these. Functions that return int return LAB_OK, LAB_NUMERIC or LAB_WORLD. SPDX-License-Identifier: MIT */
#ifndef LAB_ROUNDS_PRIVATE_H
#define LAB_ROUNDS_PRIVATE_H

#include "rounds.h"
#include "unfold.h"

/* Where the search is and what it is to bring. */
typedef struct lab_rounds {
  const lab_search_options *options;
  lab_search_result *result;
  double start;                       /* [s] of CPU time at which the search began */
  lab_candidate declared;             /* the declared model, fitted unless something is known to begin */
  lab_candidate onset;                /* the declared model with what begins within its run; as free_term */
  lab_candidate free_term;            /* it with the best free term; not fitted: not tried yet, or none */
  const lab_quality *within;          /* the declared model with its values within tolerances; NULL: that is it */
  lab_candidate without;              /* what is left when an effect is left out */
  lab_candidate whole;                /* the best that was fitted with all its values; not fitted: none */
  lab_unfolding unfolding;            /* extensions with all their values fitted, and the best of these */
  lab_candidate beam[LAB_BEAM_WIDTH]; /* best candidates so far, best first */
  int n_beam;
  lab_candidate pool[LAB_BEAM_WIDTH * LAB_REFIT_MAX]; /* extensions of them */
  int n_pool;
  int round, added, over;
  int is_final;                     /* the time is spent, and the best model fitted with all its values */
  int has_begun;                    /* something that begins was taken up in this round */
  int has_extended;                 /* pool[0] is the best extension of the best candidate */
  lab_nuisance nuisance;            /* what is declared, within its tolerances */
  const lab_projection *projection; /* of the declared model, while it is open */
  lab_onset_scores begins;          /* of what may begin within the run, there */
  const lab_candidate *leaders;     /* first refits of effects, while they are looked at */
  int n_leaders;
  double best_effect; /* largest score of an effect there */
  lab_term_score term[LAB_TERM_SCORES_MAX];
  int n_terms; /* scores of free terms there, best first */
} lab_rounds;

/* ---- What is noted (rounds.c) ---- */

/* Tell who waits what is done. */
void lab_rounds_progress(const lab_rounds *s, const char *what);

/* A free term that is significant, but not worth adding. */
void lab_rounds_note_small(lab_search_result *result, const pneu_term *term);

/* ---- The rules (rounds.c) ---- */

/* Follow the rules of a phase that hold, in order. */
int lab_rounds_follow(lab_rounds *s, enum lab_phase phase, lab_error *error);

/* ---- Extensions (rounds_extend.c) ---- */

/* Note which of the pool are as good as what was added last to its best. */
void lab_rounds_note_alike(lab_rounds *s);

/* Sort the pool, best first, without what could not be fitted, and each model once. */
void lab_rounds_rank(lab_rounds *s);

/* Whether declared values vary unseen within their tolerances. */
int lab_rounds_has_held(const lab_rounds *s);

/* Extend a candidate by every effect that its residual speaks for; the extensions join the pool. */
int lab_rounds_extend(lab_rounds *s, const lab_candidate *base, lab_error *error);

/* Whether the best extension lowers an error by as much as is asked for, or plainly and leaves white noise, or explains
 * the logs where declared values need no longer be beyond their tolerances for it, and not because a sensor is. */
int lab_rounds_measure_gain(const lab_rounds *s, int *enough, lab_error *error);

/* The best extensions are what the next round begins with. */
int lab_rounds_add_effect(lab_rounds *s, lab_error *error);

/* The pool as it is with all values fitted, which may be known already; the best one stays so. */
int lab_rounds_rank_whole(lab_rounds *s, lab_error *error);

/* One round: extend the candidates of the beam, and take the best extensions if they are worth it. */
int lab_rounds_advance(lab_rounds *s, lab_error *error);

/* ---- What was found before, again, and what begins (rounds_again.c) ---- */

/* Take out again what is not needed now that other effects have come. */
int lab_rounds_remove_needless(lab_rounds *s, lab_error *error);

/* An effect that was the best one alone need not be the best one beside those that came after it: put each earlier one
 * to the test again, and all of them where one has given way to another. */
int lab_rounds_exchange(lab_rounds *s, lab_error *error);

/* Find the best of what may begin, of those that score above a share of what acts throughout; take it in place of the
 * declared model. */
int lab_rounds_fit_onset(lab_rounds *s, enum lab_constant share, lab_error *error);
void lab_rounds_take_onset(lab_rounds *s);

/* A fit that is bent ranks alike things by chance: now that it is known when one of them begins, the others again. */
int lab_rounds_try_instead(lab_rounds *s, lab_error *error);

/* ---- Free terms (rounds_term.c) ---- */

/* Refit a candidate with the free terms that were scored.  Out: best, fitted or not */
int lab_rounds_refit_terms(lab_rounds *s, const lab_candidate *base, lab_candidate *best, lab_error *error);

/* The best free term ranks as it does with all its values fitted. */
int lab_rounds_unfold_term(lab_rounds *s, lab_error *error);

/* The best free term beside a candidate, if its score passes; where only noise is left and it can take MIN_GAIN off no
 * error, it is noted as small at once.  Out: best, fitted or not */
int lab_rounds_find_term(lab_rounds *s, const lab_candidate *base, lab_candidate *best, lab_error *error);

/* The same beside the best model, of which a free term can tell nothing where nothing was found and white noise is left.
 * Out: pool[0], fitted or not */
int lab_rounds_find_term_beside(lab_rounds *s, lab_error *error);

/* The declared model with a free term takes the place of what was found. */
void lab_rounds_take_term(lab_rounds *s);

/* The free term beside what was found joins it, which may then be needless. */
int lab_rounds_add_term(lab_rounds *s, lab_error *error);

/* ---- Values within their tolerances (rounds_values.c) ---- */

/* What has a prior varies unseen from here on. */
int lab_rounds_linearise(lab_rounds *s, lab_error *error);

/* The best model with all its values fitted; as it is where that fails. */
int lab_rounds_unfold(lab_rounds *s, lab_error *error);

/* A model with what was missing is nearer to the truth: its values are what the others vary about from here on. Where
 * it cannot be simulated beside its values, it is where the search ends. */
int lab_rounds_linearise_again(lab_rounds *s, lab_error *error);

#endif
