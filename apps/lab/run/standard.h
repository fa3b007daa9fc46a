/* The standard experiment: fill and vent from rest, once.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STANDARD_H
#define LAB_STANDARD_H

#include "response.h"

/* Run it: start at rest on the lower stop with the chamber at ambient, u = 1 from 0.5 s, u = -1 from 15.5 s, to
 * 30.5 s, sampled every 10 ms. Where u is a set pressure: the supply pressure and ambient instead of 1 and -1.
 * Out:     trace  free with lab_response_free
 * Returns: as lab_response_run. */
int lab_standard_experiment(const pneu_model *model, const lab_response_options *options, lab_response *response,
                            lab_error *error);

#endif
