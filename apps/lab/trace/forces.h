/* What the balance of forces alone tells of spring and friction, where a log has pressure and position: the measured
 * pressure drives the stem, so that nothing depends on what flows. SPDX-License-Identifier: MIT */
#ifndef LAB_FORCES_H
#define LAB_FORCES_H

#include "../fit/unknowns.h"

/* Begin with the values of spring and friction by which the measured pressure moves the stem of the one run as measured.
 * What a log without both channels, or a fit that fails, does not tell stays as it is, and what is known beforehand of
 * a value does not change.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_forces_begin(lab_unknowns *u, lab_error *error);

#endif
