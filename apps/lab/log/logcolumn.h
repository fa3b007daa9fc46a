/* A column of a log: "name [unit]" and what it means.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGCOLUMN_H
#define LAB_LOGCOLUMN_H

#include "channel.h"
#include "../base/message.h"

enum { LAB_COLUMN_TEXT = 128 }; /* bytes of "name [unit]" with its end */

/* Roles of a column beyond the channels. */
enum { LAB_COLUMN_IGNORED = -1, LAB_COLUMN_QUANTITY = -2, LAB_COLUMN_VALUE = -3, LAB_COLUMN_DAY = -4 };

typedef struct lab_column {
  int channel;          /* enum lab_channel, or one of the roles above */
  double scale, offset; /* SI value = scale * number + offset */
  int is_stamp;         /* it holds dates or times of day (stamp.h), not numbers */
} lab_column;

/* A signal that stands for a quantity: "4..20 mA" for 0 to 6 bar. */
typedef struct lab_signal {
  double from, to;  /* in `unit`; equal: there is none */
  double low, high; /* SI, at from and to; NaN: not given yet */
  char unit[16];
} lab_signal;

struct lab_log_format; /* logformat.h: what the units of a column may refer to */

/* The unit in which a channel's column is to be: that of its signal, or SI. */
const char *lab_column_unit(int channel, const struct lab_log_format *format);

/* Read "name [unit]"; p_abs, ps_abs and p2_abs become gauge; x may be a share of the stroke ("%"); "-" is a column to
 * ignore.
 * Returns: LAB_OK; LAB_DATA for an unknown name, no unit, or a unit of another dimension. */
int lab_column_read(const char *text, const struct lab_log_format *format, lab_column *column, lab_error *error);

/* The column of a channel whose unit is known.
 * In:      text      what messages call it
 *          absolute  not 0: a pressure above vacuum
 *          unit      "%" of x is a share of the stroke, "date" of t is dates and times
 * Returns: LAB_OK; LAB_DATA for an unknown unit or one of another dimension. */
int lab_column_of(const char *text, int channel, int absolute, const char *unit, const struct lab_log_format *format,
                  lab_column *column, lab_error *error);

/* Whether a text is "name [unit]" with the name of a channel, whatever its unit. */
int lab_column_is_named(const char *text);

/* Read "mark [unit]": the number behind `mark` in a file's name.
 * In:      si  unit to convert to
 * Out:     mark           LAB_COLUMN_TEXT bytes
 *          scale, offset  SI value = scale * number + offset
 * Returns: LAB_OK; LAB_DATA. */
int lab_column_mark(const char *text, const char *si, char *mark, double *scale, double *offset, lab_error *error);

#endif
