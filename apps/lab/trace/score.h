/* Score tests: what a fitted model leaves, traced to the effect that the model lacks.
 *
 * With r the whitened residual of the fit, J its slopes in what was fitted and s its slope in the size of an effect at
 * neutral, s' = s with the span of J taken out, the statistic T = (s'.r)^2/(s'.s') is chi-square with one degree of
 * freedom when nothing is missing (Rao 1948). Where a small size says little about a large one, the slope is a secant
 * to the effect's usual size as well, and effects with a shape are tried with several; the largest T counts, and the
 * number of all that were tried goes into the level of the test (Bonferroni).
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SCORE_H
#define LAB_SCORE_H

#include "../fit/unknowns.h"

/* ---- A fitted model, seen from its residual ---- */

typedef struct lab_projection {
  lab_unknowns *u;
  size_t m;
  double *r;     /* residual */
  double *basis; /* n_basis orthonormal columns that span the slopes in what was fitted */
  int n_basis;
  double excess; /* of the data's chi-square over its expectation */
} lab_projection;

/* Residual and slopes of a fitted model.
 * In:      u  fitted, or near; with slopes that it keeps, if any; used until the projection is closed
 * Out:     p  to be closed, also after an error
 * Returns: LAB_OK; LAB_NUMERIC, also when the time of u is spent; LAB_WORLD. */
int lab_projection_open(lab_unknowns *u, lab_projection *p, lab_error *error);

/* The same without the slope of the last unknown. */
int lab_projection_open_rest(lab_unknowns *u, lab_projection *p, lab_error *error);

void lab_projection_close(lab_projection *p);

/* What another model would change in the residuals.
 * Out:     slope  p->m values
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_projection_slope(const lab_projection *p, const lab_rig *model, double *slope, lab_error *error);

/* Take what was fitted out of a slope.  Returns: length left; 0 where rounding is all that is left. */
double lab_projection_visible(const lab_projection *p, double *v);

/* ---- Scores of effects ---- */

enum { LAB_SCORES_MAX = 64 };

/* One way in which something may be missing. */
typedef struct lab_score {
  int effect; /* index of the effect */
  int param;  /* its parameter that is not neutral, as in pneu_param_describe */
  int shape;  /* its shape parameter, -1 if none */
  double shape_value;
  size_t onset;     /* of a change: the row of its run from which it acts; 0: throughout */
  double size;      /* by which the parameter would have to leave neutral, by the slope */
  double statistic; /* T; 0 where the sign is impossible or the log does not see it */
  double against;   /* the same where the sign is impossible: what a bent fit makes of an effect that is there */
  double p_value;   /* of T alone */
  double explained; /* share of the chi-square excess that the slope explains */
  double visible;   /* [1] length of s' over length of s: what fitting has left of it; 0: invisible */
} lab_score;

typedef struct lab_scores {
  int n;
  lab_score of[LAB_SCORES_MAX]; /* largest statistic first */
  int tests;                    /* slopes tried in all */
} lab_scores;

/* Whether a model does not have an effect: all of it is neutral, and nothing of it is fitted. */
int lab_score_lacks(const lab_unknowns *u, int effect);

/* Whether a rig can have an effect that it does not declare: a positioner is declared, what can be wrong with it is looked
 * for only where there is one, and what does nothing to a rig at its usual size, as a long chamber to a short one, is
 * not looked for at all. */
int lab_score_can_be_missing(const lab_rig *rig, int effect);

/* Score every effect that the model does not have; one whose slope cannot be simulated is not seen.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_score_effects(const lab_projection *p, lab_scores *scores, lab_error *error);

/* ---- Scores of anything that has a size ---- */

/* What is tried. */
typedef struct lab_trial {
  double usual;       /* size of the first step */
  double up, down;    /* how far it may go from none either way, >= 0 */
  double shape_value; /* of its shape; 0 where it has none */
  /* What a size changes in the residuals: p->m values.  Returns: as lab_projection_slope. */
  int (*slope)(void *context, double size, double *slope, lab_error *error);
  void *context;
  double offset; /* where it is already, from neutral: of a value that is held */
} lab_trial;

/* The size at which an effect is tried first: its usual one; for a stop that comes early behind a positioner that of the
 * stroke which no log has used, for nothing shows before the stem meets it. */
double lab_score_usual(const lab_unknowns *u, int param);

/* Score it at its usual size and, where that changes the residual by far more than can just be seen, at shorter steps
 * until it does not; at a small one where the usual one fails.
 * In/out:  score  keeps the largest statistic
 * Out:     slope  p->m values of scratch
 * Returns: the number of slopes that were judged. */
int lab_score_try(const lab_projection *p, const lab_trial *trial, lab_score *score, double *slope, lab_error *all);

enum { LAB_SCORE_SHAPES = 3 };

/* Shapes that an effect is tried with, 0 <= which < LAB_SCORE_SHAPES. */
double lab_score_shape(const pneu_params *p, const lab_score *score, int which);

/* Largest statistic first, for qsort. */
int lab_score_by_statistic(const void *a, const void *b);

#endif
