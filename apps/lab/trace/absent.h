/* Declared effects that the logs refute.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ABSENT_H
#define LAB_ABSENT_H

#include "candidate.h"

/* Put each effect whose size the rig file declares and has fitted to the value that has no effect, where BIC is no
 * higher without it: a size that the logs do not ask for bends the model where no log has been. It stays among the
 * unknowns and rests there (lab_unknown_rests), so that its interval says how large it may be.
 * In/out:  c    fitted to the end
 * Out:     any  whether there was one
 * Returns: LAB_OK, LAB_WORLD. */
int lab_absent_find(lab_candidate *c, int *any, lab_error *error);

#endif
