/* How a logger wrote a file, where the rig file does not say: the marks between cells and in numbers, where the header
 * is and where the rows begin. A file whose first line is the header of interface.md is never guessed at.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGGUESS_H
#define LAB_LOGGUESS_H

#include "logformat.h"

enum { LAB_GUESS_TEXT = 400 };

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

/* Say in words what was guessed of the marks and lines.  Out: text  LAB_GUESS_TEXT bytes */
void lab_guess_say(const lab_guess *guess, const lab_log_format *format, char text[LAB_GUESS_TEXT]);

#endif
