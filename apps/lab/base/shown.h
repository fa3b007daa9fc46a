/* Numbers as engineers write them: kPa and mm, three or four digits, a power of ten only where it must be.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SHOWN_H
#define LAB_SHOWN_H

enum { LAB_SHOWN_TEXT = 48 };

typedef struct lab_shown {
  double scale;     /* what is shown is scale * the SI value */
  const char *unit; /* UTF-8; "" where there is none */
} lab_shown;

/* How to show a quantity of a unit that the library or the channels use; any other unit is shown as it is. */
lab_shown lab_shown_as(const char *unit);

/* A number to some significant digits: "0.01368", "389.8", "12300", "3.2e-12".
 * Out:     text  "-" for one that is not finite.  Returns: text */
const char *lab_shown_number(double value, int digits, char text[LAB_SHOWN_TEXT]);

/* The same with its unit: lab_shown_quantity(5591, "Pa", 3, text) is "5.59 kPa". */
const char *lab_shown_quantity(double value, const char *unit, int digits, char text[LAB_SHOWN_TEXT]);

/* A p-value: two digits; "below 1e-300" where it has vanished. */
const char *lab_shown_p(double p, char text[LAB_SHOWN_TEXT]);

#endif
