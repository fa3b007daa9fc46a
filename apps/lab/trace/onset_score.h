/* Score tests of what begins within a run.
 *
 * What begins at t changes nothing before, and from then on about what it changes if it acts throughout: the slope of
 * that, with the rows before t left out, costs no simulation, so that every t is tried. It is wrong only for as long as
 * the rig remembers what has been before t; the refit is exact. Values that are known to a tolerance are projected out
 * as what is fitted is, of the slope as the rows have it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ONSET_SCORE_H
#define LAB_ONSET_SCORE_H

#include "score.h"

enum { LAB_ONSET_SCORES_MAX = 32 };

typedef struct lab_onset_scores {
  int n;
  lab_score of[LAB_ONSET_SCORES_MAX]; /* largest statistic first; `onset` is the row from which it acts, `size` what is
                                         added to the parameter, for orifice_area to its factor; effect: -1 for a
                                         declared value */
  int tests;                          /* slopes times places */
  double throughout;                  /* largest statistic of those that act from the first row on */
} lab_onset_scores;

/* The p-value that one of them has to pass, where `alpha` is the chance of naming any when nothing begins. */
double lab_onset_scores_level(const lab_onset_scores *scores, double alpha);

/* List all that may begin in a model, not scored. */
void lab_onset_scores_list(const lab_unknowns *u, lab_onset_scores *scores);

/* Score all that may begin within a run.
 * In:      p         of the only run, seen row by row
 *          from, to  rows between which it begins; 0 and the end of the run: anywhere
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_onset_scores_find(const lab_projection *p, size_t from, size_t to, lab_onset_scores *scores, lab_error *error);

#endif
