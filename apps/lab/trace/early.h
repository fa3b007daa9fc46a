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
 * In:      alpha   chance of naming anything when nothing begins
 * In/out:  within  the declared model with what is held among its unknowns, seen row by row, fitted to the whole run;
 *                  where the beginnings lead all the way, fitted so
 * Out:     onset   with what begins, fitted where that leaves only noise
 *          begins  scores of what may begin, about the values of the beginning
 *          known   share of the run that is such a beginning
 * Returns: LAB_OK, LAB_WORLD. */
int lab_early_fit(lab_candidate *within, double alpha, lab_candidate *onset, lab_onset_scores *begins, double *known,
                  lab_error *error);

#endif
