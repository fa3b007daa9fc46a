/* A preview: the search of the beginning of a long run.
 *
 * A search takes as many simulations of a long log as of a short one. What is missing mostly shows in the first third
 * as well, and the values that this is found with are near those of the whole run.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PREVIEW_H
#define LAB_PREVIEW_H

#include "rounds.h"

/* Whether there is one run, seen row by row, of 400 rows or more that cost as much as PREVIEW_ROWS: rows of a closed loop
 * count for eight, and changes of the command for nine more. */
int lab_preview_is_asked(const lab_unknowns *u);

/* Search the beginning, fit what is found to the whole run, and go on from there if that leaves only noise, or if
 * effects leave little more.
 * In:      u     the declared model, fitted
 * In/out:  f     with the errors of that; if done, what was found
 * Out:     done  whether that left only noise, the time of the beginning was spent, or the search that went on from
 *                effects ended with effects; else f is as it was, but for sound_until
 * Returns: LAB_OK, LAB_WORLD. */
int lab_preview_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                       lab_error *error);

#endif
