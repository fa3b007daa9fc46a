/* Free terms (pneu.h): where something without a name may act, how well it would explain a residual, and in words what
 * it is and where it acts.
 *
 * A free term acts in an equation, over an argument; its slopes are those in the heights of its knots, and its score T
 * is chi-square with as many degrees of freedom as of them the log sees. What comes in cycles of time has the two
 * amplitudes of a sine, with the period that the residual shows; its phase is that of the logs' own times, and the same
 * for all of them.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FREETERMS_H
#define LAB_FREETERMS_H

#include "score.h"

/* ---- Scores ---- */

enum { LAB_TERM_SCORES_MAX = 24, LAB_PERIODS_MAX = 24 };

typedef struct lab_term_score {
  pneu_term term;   /* its knots, values 0; or its cycle, with the amplitudes that the slopes ask for */
  double scale;     /* a value of it that matters, in its unit */
  double statistic; /* T */
  int degrees;      /* of freedom: directions of the knots that the log sees */
} lab_term_score;

/* Score a free term everywhere where one may act.
 * Out:     score  largest statistic less degrees first
 *          n      their number; 0 where the model has no room for one more
 * Returns: LAB_OK, LAB_WORLD. */
int lab_score_free_terms(const lab_projection *p, lab_term_score score[LAB_TERM_SCORES_MAX], int *n, lab_error *error);

/* p-value of a statistic of a term; a cycle's is the best of many lines, and their number counts. */
double lab_free_term_p_value(const pneu_term *term, double statistic, int degrees);

/* Peaks of the periodograms of all channels, each over all logs; the highest over its surroundings first. Phases of the
 * logs do not count.
 * In:      r       errors over noise, run by run and channel by channel; residuals as they are fitted
 * Out:     period  [s] LAB_PERIODS_MAX at most
 *          n       their number
 * Returns: LAB_OK, LAB_WORLD. */
int lab_residual_periods(const lab_unknowns *u, const double *r, double *period, int *n, lab_error *error);

/* ---- Where a term acts ---- */

/* The stretch of its argument outside which a term stays near one level. Knots at one end that are exactly 0, up to
 * half of them, do not count: no log has reached them, and nothing is known there. One knot alone reaches half of the
 * way to its neighbours.
 * A cycle acts at all times: its whole period, with its largest amplitude as the peak.
 * Out:     level  where it does not act, in its unit; peak  its largest departure from there, signed
 * Returns: 1 if the stretch is a short one, 0 if it acts nearly everywhere. */
int lab_free_term_stretch(const pneu_term *term, double *from, double *to, double *level, double *peak);

/* ---- In words ---- */

enum { LAB_WHERE_TEXT = 160 };

/* "mass", "energy", "force" or "sensor", as in report.json. */
const char *lab_free_term_equation(const pneu_term *term);

/* "dry friction", "a flow into or out of the chamber" */
const char *lab_free_term_what(const pneu_term *term);

/* "x = 11.2 .. 13.1 mm, both directions", or "nearly everywhere, ...", with the largest value; for a cycle
 * "periodically, every 1.87 s (0.535 Hz)" with its largest amplitude. */
const char *lab_free_term_where(const pneu_term *term, char text[LAB_WHERE_TEXT]);

#endif
