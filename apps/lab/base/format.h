/* Numbers as engineers write them: kPa and mm, three or four digits, a power of ten only where it must be.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_FORMAT_H
#define LAB_FORMAT_H

enum { LAB_FORMAT_TEXT = 48 };

typedef struct lab_format {
  double scale;     /* what is shown is scale * the SI value */
  const char *unit; /* UTF-8; "" where there is none */
} lab_format;

/* How to show a quantity of a unit that the library or the channels use; any other unit is shown as it is. */
lab_format lab_format_as(const char *unit);

/* A number to some significant digits: "0.01368", "389.8", "12300", "3.2e-12".
 * Out:     text  "-" for one that is not finite.  Returns: text */
const char *lab_format_number(double value, int digits, char text[LAB_FORMAT_TEXT]);

/* The same with its unit: lab_format_quantity(5591, "Pa", 3, text) is "5.59 kPa". */
const char *lab_format_quantity(double value, const char *unit, int digits, char text[LAB_FORMAT_TEXT]);

/* For a message, in four digits and without zeros at the end: "398.2 kPa", "20 mm", "298.1 K". */
const char *lab_format_brief(double value, const char *unit, char text[LAB_FORMAT_TEXT]);

/* A p-value: two digits; "below 1e-300" where it has vanished. */
const char *lab_format_p(double p, char text[LAB_FORMAT_TEXT]);

/* The same into a text of their own, which is there until the block ends. */
#define LAB_NUMBER(value, digits)         lab_format_number(value, digits, (char[LAB_FORMAT_TEXT]){0})
#define LAB_QUANTITY(value, unit, digits) lab_format_quantity(value, unit, digits, (char[LAB_FORMAT_TEXT]){0})
#define LAB_P_VALUE(p)                    lab_format_p(p, (char[LAB_FORMAT_TEXT]){0})

#endif
