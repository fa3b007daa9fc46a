/* One declared value far off, alone: the plainest thing that can be wrong with a rig.
 *
 * Held to their tolerances, many values bend a little to make up for the one that is far off, and the search goes on
 * from there.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ALONE_H
#define LAB_ALONE_H

#include "../fit/unknowns.h"

/* The declared model with the one value let go that takes most off chi-square, all others as declared.
 * In:      declared  fitted
 * Out:     with      that model, fitted
 *          any       whether there is one that takes off half of it
 * Returns: LAB_OK, also where the time of `declared` is spent; LAB_WORLD. */
int lab_alone_find(const lab_unknowns *declared, lab_unknowns *with, int *any, lab_error *error);

#endif
