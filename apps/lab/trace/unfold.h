/* Candidates with all their values: while effects are compared, what is known to a tolerance varies unseen along
 * straight lines (nuisance.h), and those lines bend where something is missing. SPDX-License-Identifier: MIT */
#ifndef LAB_UNFOLD_H
#define LAB_UNFOLD_H

#include "../fit/nuisance.h"
#include "refit.h"

typedef struct lab_unfolding {
  const lab_nuisance *nuisance; /* what varies unseen */
  const lab_unknowns *exact;    /* the declared model with nothing held, fitted; NULL: there is none */
  double until;                 /* [s] of CPU time */
  lab_candidate whole, best;    /* the last one with all its values fitted, and the best so far */
} lab_unfolding;

/* Whether declared values vary unseen, and not only the instants of commands. */
int lab_unfold_has_held(const lab_unfolding *f);

/* Fit a candidate with all its values: from where the straight lines lead, and, if that comes near to the logs, from
 * the declared values.
 * Out:     whole  the better one, fitted or not
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unfold(const lab_unfolding *f, const lab_candidate *c, lab_candidate *whole, lab_error *error);

/* Fit the best of n candidates with all their values, and rank them by that. Where declared values vary, it takes long:
 * if straight lines explain the logs, only the best one is fitted, what straight lines cannot tell from it, and what
 * would come before it then, if it gained UNFOLDED_GAIN times as much.
 * In/out:  f->best  the best such one so far
 *          c        sorted, best first
 * Returns: LAB_OK, LAB_WORLD. */
int lab_unfold_best(lab_unfolding *f, lab_candidate *c, int n, lab_error *error);

#endif
