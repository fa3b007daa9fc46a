/* Figures of merit of the runs of a fit, measured and predicted.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_APPRAISE_H
#define LAB_APPRAISE_H

#include "metrics.h"
#include "../fit/unknowns.h"

/* Measure both. A model that cannot follow the runs has no figures, and its error is the reason.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_appraise(const lab_unknowns *u, lab_metrics *measured, lab_metrics *predicted, lab_error *error);

#endif
