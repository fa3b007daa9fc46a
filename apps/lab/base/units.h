/* Units of measurement, as UDUNITS-2 reads them. Gauge or absolute is not a unit: see channel.h.
 * The unit database is loaded at the first call, which must not run beside another one.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_UNITS_H
#define LAB_UNITS_H

#include "message.h"

/* The straight line from one unit to another: in `to`, a value is scale * value + offset.
 * In:      from, to  units ("kPa", "%", "1", "degC", "1/4096"); equal texts are not looked up, so that a
 *                    unit which UDUNITS cannot write (W/K^(4/3)) still works as it stands
 * Returns: LAB_OK; LAB_DATA for an unknown unit or another dimension; LAB_WORLD without a unit database. */
int lab_unit_factor(const char *from, const char *to, double *scale, double *offset, lab_error *error);

/* Whether a word is another one, which has no capitals, but for capitals. */
int lab_unit_is_word(const char *word, const char *other);

/* The unit in what sheets and loggers write of a pressure: "psi" in "psig" and in "psia".
 * Out:     absolute  1 if it counts from vacuum
 * Returns: NULL if the word is none of these */
const char *lab_unit_of_pressure(const char *word, int *absolute);

/* A unit in base units, such as "kg.m-1.s-2"; "1" where it has none.  Returns: LAB_OK; LAB_DATA if it is unknown;
 * LAB_WORLD. */
enum { LAB_UNIT_TEXT = 128 };
int lab_unit_dimension(const char *unit, char text[LAB_UNIT_TEXT], lab_error *error);

/* Read a quantity such as "400 cm^2", "25 degC", "1/4 in", "20 psig" or "5 %"; a plain number is taken to be in `unit`.
 * Out:     value in `unit`
 * Returns: LAB_OK; LAB_DATA if there is no finite number in front, or as lab_unit_factor. */
int lab_quantity(const char *text, const char *unit, double *value, lab_error *error);

/* The same for a difference or a spread: only the scale counts ("0.5 degC" is 0.5 K). */
int lab_quantity_difference(const char *text, const char *unit, double *value, lab_error *error);

#endif
