/* What the files of the loop share: a search over models, a few at a time, each extended by one effect a round.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOOP_PRIVATE_H
#define LAB_LOOP_PRIVATE_H

#include "attempt.h"
#include "scan.h"

/* The search: where it is and what it is to bring. */
typedef struct search {
  const lab_loop_options *options;
  lab_loop_result *result;
  lab_attempt *beam; /* best models so far, best first */
  int n_beam;
  lab_attempt *pool; /* LAB_REFIT_MAX extensions of each of them */
  int n_pool;
  lab_attempt *declared; /* the declared model, fitted */
  lab_attempt *nameless; /* the declared model with the best free term; not fitted: not tried yet, or none */
} search;

void loop_tell(const search *s, const char *what);

/* A model that was tried, and one that the search goes on from, for the result. */
void loop_note_step(lab_loop_result *result, const lab_attempt *a);
void loop_note_way(lab_loop_result *result, const lab_attempt *a);

/* Whether model b lowers the error of some channel of model a by as much as is asked for. */
int loop_is_gain(const search *s, const lab_attempt *a, const lab_attempt *b, int *enough, lab_error *error);

/* ---- Models side by side ---- */

/* Whether two models have the same, whatever was added first. */
int loop_is_same(const lab_attempt *a, const lab_attempt *b);

/* Effects of a pool, each added last, that are as good as one of a model's in its place: a better fit by one unknown
 * more is no reason to choose it, but nor does the log speak against it. */
void loop_note_alike(lab_attempt *model, int which, const lab_attempt *pool, int n);

/* The same for the best of a pool. */
void loop_note_alike_best(lab_attempt *pool, int n);

/* ---- Extensions ---- */

/* Try every extension of one model by an effect; they join the pool. */
int loop_extend(search *s, const lab_attempt *base, lab_error *error);

/* The pool, best first, without what could not be fitted, and each model once. */
void loop_rank(search *s);

/* ---- What was found before, again ---- */

/* Take out again what is not needed now that other effects have come. */
int loop_remove_needless(lab_attempt *a, lab_error *error);

/* An effect that was the best one alone need not be the best one beside those that came after it: put each earlier one
 * to the test again. */
int loop_exchange(search *s, lab_error *error);

/* ---- Free terms ---- */

/* A free term beside the declared model, tried before any effect where it explains most of what there is and far more
 * than any of them. */
int loop_try_slots_first(const search *s, const lab_attempt *base, const lab_scan *scan, double best_effect,
                         lab_error *error);

/* Whether it is time for a free term beside the declared model: when no single effect explains much, or when two leave
 * more than noise. */
int loop_wants_nameless(const search *s, int rounds);

/* The best free term beside a model, if the best slot passes.  Out: best, fitted or not */
int loop_find_slot(const search *s, const lab_attempt *base, lab_attempt *best, lab_error *error);

/* Whether the model with a free term is so good that there is no need to look on, and whether it is to be preferred to
 * the best one in the end. */
int loop_is_compelling(const search *s);
int loop_is_preferred(const search *s);

/* Nothing that has a name would do: a free term beside what was found, which may then be needless. */
int loop_last_resort(search *s, lab_error *error);

#endif
