/* The columns of a log file, from its first line or from the rig file.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGHEADER_H
#define LAB_LOGHEADER_H

#include "logformat.h"
#include "../base/text.h"

enum { LAB_LINE_MAX = 65536 }; /* bytes of a line; a longer one is not a log's */

/* A log file being read. */
typedef struct lab_log_source {
  const char *path;
  const lab_log_format *format;
  lab_lines lines;
} lab_log_source;

typedef struct lab_header {
  int n; /* columns */
  lab_column column[LAB_COLUMN_MAX];
  char text[LAB_COLUMN_MAX][LAB_COLUMN_TEXT]; /* as written, for messages */
  lab_column quantity[LAB_QUANTITY_MAX];      /* beside format->quantity */
} lab_header;

/* Skip the lines that the format says and read the columns; afterwards the source stands at the first row.
 * In:      ambient  [Pa] absolute
 * Returns: LAB_OK; LAB_DATA with file, line and column. */
int lab_header_read(lab_log_source *source, double ambient, lab_header *header, lab_error *error);

/* Columns and quantities that lead to a channel or a role (0 or 1 after lab_header_read, but for ignored ones
 * and for channels that are weighted sums). */
int lab_header_count(const lab_header *header, const lab_log_format *format, int channel);

/* The next line that is not a comment.
 * Out:     found  0 at the end of the file
 * Returns: LAB_OK; LAB_DATA for a line longer than LAB_LINE_MAX. */
int lab_log_line(lab_log_source *source, const char **begin, const char **end, int *found, lab_error *error);

/* End of the field that starts at `begin`: the next delimiter, or `end`. */
const char *lab_log_field(const lab_log_source *source, const char *begin, const char *end);

/* Put "file:line" in front of the recorded text.  Returns: its status. */
int lab_log_fail_in(const lab_log_source *source, lab_error *error);

enum { LAB_SHOWN = 48 };

/* A stretch of a file for a message: printable and short.  Returns: text */
const char *lab_log_show(const char *begin, const char *end, char text[LAB_SHOWN]);

#endif
