/* The columns of a log file, from its first line or from the rig file.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGHEADER_H
#define LAB_LOGHEADER_H

#include "logguess.h"

typedef struct lab_header {
  int n; /* columns */
  lab_column column[LAB_COLUMN_MAX];
  char text[LAB_COLUMN_MAX][LAB_COLUMN_TEXT]; /* as written, for messages */
  int has_stamps;                             /* not 0: time is in dates or times of day */
  lab_column quantity[LAB_QUANTITY_MAX];      /* beside format->quantity */
  char said[2 * LAB_GUESS_TEXT];              /* what was guessed of the file, in words; "": nothing */
} lab_header;

/* Find out how the file is written, as far as the format does not say, and read the columns.
 * In:      ambient  [Pa] absolute
 * In/out:  csv      just opened; takes the marks of the format, and stands before the first row afterwards
 *          format   marks and order of dates become those of the file
 * Returns: LAB_OK; LAB_DATA with file, line and column. */
int lab_header_read(lab_csv *csv, lab_log_format *format, double ambient, lab_header *header, lab_error *error);

/* Columns and quantities that lead to a channel or a role (0 or 1 after lab_header_read, but for ignored ones
 * and for channels that are weighted sums). */
int lab_header_count(const lab_header *header, const lab_log_format *format, int channel);

enum { LAB_QUOTE = 48 };

/* A cell for a message: printable and short.  Returns: shown */
const char *lab_log_quote(const char *text, char shown[LAB_QUOTE]);

#endif
