/* The old and the new logs of a rig in one fit: what both have, what differs from day to day, and what has changed.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SIDES_H
#define LAB_SIDES_H

#include "../fit/linear.h"
#include "change.h"

/* Both sides in one fit. */
typedef struct lab_sides {
  lab_unknowns u;
  lab_unknowns then;          /* the same as the baseline alone has it */
  lab_unknowns base;          /* the model of the baseline, with the instants of its commands, which stay in `u` */
  lab_linear old;             /* its runs, simulated once */
  lab_run run[LAB_FIT_MAX];   /* of both sides: views, whose noise may differ from that of the logs */
  lab_run white[LAB_FIT_MAX]; /* the same with noise that has no memory */
  int first;                  /* run of the new logs */
  int decided;                /* whether the model explains the baseline */
  double row;                 /* [s] from row to row, the longest mean of a run */
  double chi2;
  int n;
  lab_change change[LAB_CHANGES_MAX]; /* what was taken up */
  int shape[LAB_CHANGES_MAX];
  double without_first; /* chi-square without what was taken up first; 0: not known */
  double
      followed; /* by how much chi-square fell when the supply was followed, which is the last change; 0: it was not */
  int n_followed; /* what that fitted */
} lab_sides;

/* Put both together, from the model of the baseline, not yet fitted.
 * Out: c  zeros before; c->old to be closed, also after an error */
int lab_sides_join(const lab_comparison *of, lab_sides *c, lab_error *error);

/* Place of a change among the unknowns, the last one of a parameter; -1 if it is none of them. */
int lab_sides_find(const lab_unknowns *u, int param);

/* Let a parameter change as far as the fit wants, beside what it does from day to day if it acts from an onset on.
 * Returns: LAB_OK, LAB_DATA without room */
int lab_sides_release(lab_unknowns *u, int first, const lab_score *score, double value, lab_error *error);

/* Fit until it stays where it is: what is known to a day only makes long valleys.
 * In:  aim  chi-square that another model has: where the last fit gained too little to get there, it ends; HUGE_VAL */
int lab_sides_settle(lab_unknowns *u, double aim, double *chi2, lab_error *error);

/* Fit with what differs from day to day held close at first: from none, the first step of all together would lead far
 * astray, where another valley may hold it. */
int lab_sides_approach(lab_unknowns *u, double *chi2, lab_error *error);

/* Both sides to be simulated, with the instants of the commands of both, as far as there is room.
 * In:  u  as c->u
 * Out: whole */
void lab_sides_whole(const lab_sides *c, const lab_unknowns *u, lab_unknowns *whole);

/* What is left of either side, [1] over what counts as noise. */
typedef struct lab_rest {
  double then, now;
  size_t n; /* values of the new logs */
  double chi2;
  double strain; /* [1] deviations by which what differs from day to day does so, the largest */
} lab_rest;

/* In:      first  run of the new logs
 * Returns: as lab_unknowns_residuals */
int lab_sides_rest(const lab_unknowns *u, int first, lab_rest *left, lab_error *error);

/* The same with both sides simulated.  In: u  as c->u  run  c->run or c->white */
int lab_sides_rest_of_all(const lab_sides *c, const lab_unknowns *u, const lab_run *run, lab_rest *left,
                          lab_error *error);

/* Whether a value differs by so much more than from day to day that it stands in for a change. */
int lab_rest_is_strained(const lab_rest *left);

/* Whether the new logs leave as little as the baseline, or as noise does, with values as they may be. */
int lab_rest_is_as_before(const lab_rest *left);

/* Whether the new logs leave more than noise. */
int lab_rest_is_more_than_noise(const lab_rest *left);

/* Whether they leave so much more than the baseline that it is no matter of noise. */
int lab_rest_is_doubtful(const lab_rest *left);

/* Whether the model leaves so much of the baseline, which it was fitted to before, that it is bent. */
int lab_rest_spoils_baseline(const lab_rest *left);

/* Score each difference that the new logs may have, throughout and, where more than noise is left, from some rows on.
 * Returns: LAB_OK; LAB_NUMERIC, also without time; LAB_WORLD */
int lab_change_scores(lab_sides *c, lab_scores *scores, lab_error *error);

/* Size of the first step: a tenth of a parameter, an effect's usual size. */
double lab_change_usual(const lab_unknowns *u, int param);

#endif
