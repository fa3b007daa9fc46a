/* Decimal numbers in a field of text, read fast and without a locale.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_NUMBER_H
#define LAB_NUMBER_H

enum lab_number_kind { LAB_NUMBER_BAD, LAB_NUMBER_GAP, LAB_NUMBER_FINITE };

/* Read the field [begin, end); blanks around it do not count.
 * In:      decimal    the decimal mark, '.' or ','
 *          thousands  a mark to leave out, 0 for none; equal to `decimal`: all but the last are left out
 * Out:     value      correctly rounded; NaN for a gap; not set for a bad field
 * Returns: LAB_NUMBER_GAP for an empty field or "nan" in any case; LAB_NUMBER_BAD for anything but a finite
 *          decimal number; `*end` must be readable. */
int lab_number_read(const char *begin, const char *end, char decimal, char thousands, double *value);

/* The shortest decimal number that is read back as the same value.
 * Out:     text  LAB_NUMBER_TEXT characters
 * Returns: text. */
enum { LAB_NUMBER_TEXT = 32 };
const char *lab_number_write(double value, char *text);

#endif
