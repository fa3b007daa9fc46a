/* The steps of reading a log, for each other: how the file is written, what its columns are, how its rows are put.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGREAD_H
#define LAB_LOGREAD_H

#include "log.h"

/* ---- How a logger wrote a file, where the rig file does not say (logguess.c) ----
 *
 * The marks between cells and in numbers, where the header is and where the rows begin. A file whose first line is a
 * header as in pneu-rig(5) is never guessed at. */

typedef struct lab_guess {
  int guessed; /* 0: the file is as documented, or as the rig file says */
  int header;  /* line of the header; 0: none was found */
  int units;   /* line of the units below it; 0: none */
  int data;    /* first line of the rows; 0: there are none */
  int cells;   /* of a row */
} lab_guess;

/* Look at the first lines of a file.
 * In/out:  csv     just opened, and as that afterwards
 *          format  marks that are not given become those guessed, or those of the documented format
 * Returns: LAB_OK; LAB_DATA for a line that is too long. */
int lab_guess_form(lab_csv *csv, lab_log_format *format, lab_guess *guess, lab_error *error);

/* Say in words what was guessed of the marks and lines.  Out: text  LAB_READ_AS_TEXT bytes */
void lab_guess_say(const lab_guess *guess, const lab_log_format *format, char text[LAB_READ_AS_TEXT]);

/* ---- Which channel a logger's name means, and in which unit it is (logname.c) ---- */

/* Find the unit in a name: "Pressure (bar)", "p [kPa]", "Travel %", "Druck in bar", "p / bar", "p_bar", "barg", "degC".
 * In:      si   unit into which it must be convertible
 * Out:     unit  as UDUNITS reads it; "" where there is none
 *          absolute  set to 1 by "bara", "psia" and the like; else left
 * Returns: 1 if there is one. */
int lab_name_unit(const char *text, const char *si, char unit[LAB_COLUMN_TEXT], int *absolute);

/* Whether a cell below a name holds nothing but a unit, with or without brackets. */
int lab_name_is_unit(const char *text);

/* The channel that a name means by its words, in English, German or French, if it can be in the unit of the name or of
 * `below`.
 * In:      below     the unit in the next line of the file; ""
 *          is_stamp  the column holds dates or times
 * Out:     absolute  whether it is a pressure above vacuum
 * Returns: enum lab_channel, or LAB_COLUMN_IGNORED. */
int lab_name_channel(const char *text, const char *below, int is_stamp, const lab_log_format *format, int *absolute);

/* ---- The columns of a file, from its first line or from the rig file (logheader.c) ---- */

typedef struct lab_header {
  int n; /* columns */
  lab_column column[LAB_COLUMN_MAX];
  char text[LAB_COLUMN_MAX][LAB_COLUMN_TEXT]; /* as written, for messages */
  int has_stamps;                             /* not 0: time is in dates or times of day */
  lab_column quantity[LAB_QUANTITY_MAX];      /* beside format->quantity */
} lab_header;

/* Find out how the file is written, as far as the format does not say, and read the columns.
 * In/out:  csv      just opened; takes the marks of the format, and stands before the first row afterwards
 *          format   marks and order of dates become those of the file
 * Out:     said     what was guessed, in words; "": nothing
 * Returns: LAB_OK; LAB_DATA with file, line and column. */
int lab_header_read(lab_csv *csv, lab_log_format *format, lab_header *header, char said[LAB_READ_AS_TEXT],
                    lab_error *error);

/* Columns and quantities that lead to a channel or a role (0 or 1 after lab_header_read, but for ignored ones
 * and for channels that are weighted sums). */
int lab_header_count(const lab_header *header, const lab_log_format *format, int channel);

enum { LAB_QUOTE = 48 };

/* A cell for a message: printable and short.  Returns: shown */
const char *lab_log_quote(const char *text, char shown[LAB_QUOTE]);

/* ---- Which column is which channel, by log.map, by name or by words (logmap.c) ---- */

enum { LAB_HEADING_TEXT = 96 };

/* A column as its file has it, in UTF-8; longer names are cut. */
typedef struct lab_heading {
  char text[LAB_HEADING_TEXT];
  char below[LAB_HEADING_TEXT]; /* its unit in the next line; "" */
  lab_stamp stamp;              /* of its first row; all 0 where that is no date or time */
} lab_heading;

/* Make columns of headings. Where one of them is named as pneu-rig(5) says, and the rig file maps none, all must be;
 * else those that mean no channel are left out.
 * In:      heading  n of them, n <= LAB_COLUMN_MAX
 *          guessed  how the file is written was guessed: a heading may be empty
 * In/out:  format   date becomes the order of the dates found
 * Out:     header   n columns
 * In/out:  said     what was guessed is appended
 * Returns: LAB_OK; LAB_DATA with the key to write. */
int lab_map_columns(const lab_heading *heading, int n, int guessed, lab_log_format *format, lab_header *header,
                    char said[LAB_READ_AS_TEXT], lab_error *error);

/* A unit that people use for a channel. */
const char *lab_usual_unit(int channel, const lab_log_format *format);

/* Append a string as libconfig has it, in quotes. */
void lab_append_quoted(char *text, size_t room, const char *value);

/* Whether one of n headings is named as pneu-rig(5) says. */
int lab_map_is_named(const lab_heading *heading, int n);

/* ---- A file in long form, of which a row holds one value and the word for what it is (loglong.c) ---- */

/* Look at its rows. Such a file is not guessed at: the answer is what to write.
 * In:      csv      before the first row; anywhere afterwards
 *          heading  guess->cells of them
 * Returns: LAB_OK, it is none; LAB_DATA with the keys to write; LAB_WORLD. */
int lab_long_check(lab_csv *csv, const lab_log_format *format, const lab_guess *guess, const lab_heading *heading,
                   lab_error *error);

/* ---- Times of a clock that goes in steps (logstamps.c) ---- */

#define LAB_LEAVE_OUT "; to leave such rows out, write into the rig file: log = { damaged = \"drop\"; };"
#define LAB_EXPECTED_LATER "channel t: expected more than the %.9g s of the row before, found %.9g s%s%s"

/* Such a clock may give several rows one time: asked where it has. Where they cannot be made even they are spread over
 * its step. More than twice the usual number and one are no such thing.
 * In/out:  log  its times, and `repeated`
 * Returns: LAB_OK; LAB_DATA with the line. */
int lab_log_part_repeats(lab_log *log, lab_error *error);

/* ---- The last steps: rows in the order and the number that the format asks for (logshape.c) ---- */

/* Join the rows of a file in long format, of which each holds one value of one channel: sorted by time, those of one
 * instant in one row; a command holds until the next one. Two values of one channel at one instant are an error.
 * In/out:  log  one run; n shrinks
 * Returns: LAB_OK, LAB_DATA with the line, LAB_WORLD. */
int lab_log_join(lab_log *log, lab_error *error);

/* Reverse the way back of a loop, keep every so many-th row, take the mean over runs, put the lead before each run; in
 * this order, and each only if the format has it.
 * In/out:  log  its rows and runs
 * Returns: LAB_OK; LAB_DATA with the line; LAB_WORLD. */
int lab_log_shape(lab_log *log, const lab_log_format *format, lab_error *error);

#endif
