/* The search from declared values that are known to tolerances. Where these do not explain the logs by themselves,
 * something may be missing from a rig that is as declared: if one cause explains them and needs no deviations beside,
 * none are looked for; else the better model of the two searches is the answer.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CONTEST_H
#define LAB_CONTEST_H

#include "rounds.h"

/* The declared model within its tolerances, fitted once for all searches of a whole run, row by row.
 * In:      u  it, fitted
 * In/out:  f  held
 * Returns: as lab_candidate_hold. */
int lab_contest_hold(const lab_unknowns *u, lab_finding *f, lab_error *error);

/* In:      u         the declared model, fitted
 *          is_brief  not 0: if tolerances alone leave only noise, look for nothing else; nor if they do so nearly to
 *                    the end, and what begins there is not plain
 * In/out:  f         with the errors of that; then what is taken for the answer, or the values of that beginning and
 *                    its rows
 * Returns: as lab_rounds_run. */
int lab_contest_run(const lab_unknowns *u, int is_brief, const lab_search_options *options, lab_finding *f,
                    lab_error *error);

/* Whether effects beside values as declared are to be told, where there is an answer with deviations: one that names
 * less is the simpler one, and gives way only to odds; one that needs values far beyond their tolerances has odds
 * against it, but not beside a sensor that is itself beyond what sensors are. */
int lab_contest_is_better(const lab_finding *exact, const lab_finding *tolerant);

#endif
