/* Columns that are not named "name [unit]": which channel a logger's name means, and in which unit it is.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGNAME_H
#define LAB_LOGNAME_H

#include "logcolumn.h"

/* Find the unit in a name: "Pressure (bar)", "p [kPa]", "Travel %", "Druck in bar", "p / bar", "p_bar", "barg", "degC".
 * In:      si   unit into which it must be convertible
 * Out:     unit  as UDUNITS reads it; "" where there is none
 *          absolute  set to 1 by "bara", "psia" and the like; else left
 * Returns: 1 if there is one. */
int lab_name_unit(const char *text, const char *si, char unit[LAB_COLUMN_TEXT], int *absolute);

/* Whether a cell below a name holds nothing but a unit, with or without brackets. */
int lab_name_is_unit(const char *text);

/* The channel that a name means by its words, in English, German or French, if it can be in the unit of the name or of
 * `below`. In:      below     the unit in the next line of the file; "" is_stamp  the column holds dates or times Out:
 * absolute  whether it is a pressure above vacuum Returns: enum lab_channel, or LAB_COLUMN_IGNORED. */
int lab_name_channel(const char *text, const char *below, int is_stamp, const lab_column_frame *frame, int *absolute);

#endif
