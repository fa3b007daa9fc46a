/* A run that is as declared until something begins.
 *
 * A fit of the whole run is bent by what begins within it, in a closed loop beyond the reach of slopes. The rows before
 * it are explained by the declared model within its tolerances: the longest beginning of the run of which that holds
 * says when it begins, and the values found there are those that it changes.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_EARLY_H
#define LAB_EARLY_H

#include "refit.h"

/* Fit ever longer beginnings of the only run, which as a whole is plainly off. If one that leaves only noise ends
 * before the run does, look for what begins there, and fit the whole run with it.
 * In:      rows    of the run that leave only noise with the values of `within`; 0: not known
 *          alpha   chance of naming anything when nothing begins
 * In/out:  within  the declared model with what is held among its unknowns, seen row by row, fitted; where the
 *                  beginnings lead all the way, fitted so
 * Out:     onset   with what begins, fitted where that leaves only noise; else with the values of the beginning
 *          begins  scores of what may begin, about these
 *          sound   rows of the beginning
 * Returns: LAB_OK, LAB_WORLD. */
int lab_early_fit(lab_candidate *within, size_t rows, double alpha, lab_candidate *onset, lab_onset_scores *begins,
                  size_t *sound, lab_error *error);

#endif
