/* What a search of the new logs by themselves makes likely to have changed.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SUSPECT_H
#define LAB_SUSPECT_H

#include "../trace/search.h"

enum { LAB_SUSPECTS_MAX = 3 };

/* A difference, as if it had been scored. */
typedef struct lab_suspect {
  lab_score score;        /* param, shape, onset, size; statistic: squares of its deviations */
  const lab_found *found; /* of the search; NULL if it is a value */
} lab_suspect;

/* A model and the search that has completed it, before what it holds is settled. */
typedef struct lab_explained {
  const lab_unknowns *u;
  const lab_search_result *result;
} lab_explained;

/* Compare two models that explain their logs: what was found in the new one and is not in the old one, then values that
 * differ by more than from day to day.
 * Out:     suspect  the plainest first
 * Returns: how many; 0 where either does not explain its logs */
int lab_suspects_find(const lab_explained *then, const lab_explained *now, lab_suspect suspect[LAB_SUSPECTS_MAX]);

#endif
