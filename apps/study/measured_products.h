/* The comparisons with public measurements as products of the study: absent data is no error.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_MEASURED_PRODUCTS_H
#define STUDY_MEASURED_PRODUCTS_H

#include "study.h"

/* results/measured_vessel*.csv */
int measured_vessel_product(const study *s, lab_error *error);

/* results/measured_damadics_*.csv */
int measured_damadics_product(const study *s, lab_error *error);

#endif
