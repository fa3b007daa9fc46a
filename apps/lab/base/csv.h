/* The reader of CSV files: logs, lists of a fleet, tables of the study.
 *
 * A cell may be in quotes, with blanks before them; marks in it are text then, and "" is a quote (RFC 4180). The end of
 * a line is the end of its row, in quotes too, so that a message can name the line. Where LAB_CSV_BLANKS is the
 * mark, any number of blanks is one mark, and those around a line are none. SPDX-License-Identifier: MIT */
#ifndef LAB_CSV_H
#define LAB_CSV_H

#include <stddef.h>

#include "text.h"

enum {
  LAB_CSV_LINE = 65536, /* bytes of a line */
  LAB_CSV_CELLS = 64,   /* cells of a row that are kept */
  LAB_CSV_BLANKS = 1    /* the mark of tables whose columns are filled up with blanks */
};

/* A text that ends with a 0 byte at `end`. */
typedef struct lab_cell {
  char *begin, *end;
} lab_cell;

typedef struct lab_csv {
  const char *path;
  char mark;                    /* between cells; a comma after lab_csv_open */
  char comment;                 /* lines that begin with it are left out; 0 after lab_csv_open: none */
  int line;                     /* number of the present line, from 1; 0 before the first */
  const char *begin, *end;      /* the present line, without its end (LF or CR LF) */
  int n;                        /* its cells once it is cut, also those beyond LAB_CSV_CELLS */
  lab_cell cell[LAB_CSV_CELLS]; /* valid until the next line is cut */
  lab_text text;
  const char *rest; /* the lines after the present one */
  char row[LAB_CSV_LINE + 1];
} lab_csv;

/* Read a file into memory and stand before its first line.
 * In:      path  kept
 * Out:     csv   to be closed, also after an error
 * Returns: as lab_text_read. */
int lab_csv_open(lab_csv *csv, const char *path, lab_error *error);
void lab_csv_close(lab_csv *csv);

/* Go back before the first line. */
void lab_csv_restart(lab_csv *csv);

/* Step to the next line that is no comment.
 * Out:     more  0 at the end of the file
 * Returns: LAB_OK; LAB_DATA with file and line for one longer than LAB_CSV_LINE. */
int lab_csv_line(lab_csv *csv, int *more, lab_error *error);

/* Cut the present line into cells.  Returns: LAB_OK; LAB_DATA without the place for a quote that does not end. */
int lab_csv_cut(lab_csv *csv, lab_error *error);

/* Whether blanks are all that is left, from the present line on. */
int lab_csv_is_over(const lab_csv *csv);

/* Lines of the file, the last one counted whether or not it ends. */
size_t lab_csv_lines(const lab_csv *csv);

/* Put "file:line" in front of the recorded text.  Returns: its status. */
int lab_csv_fail_in(const lab_csv *csv, lab_error *error);

/* Cut a text that is no file's, in place.
 * In/out:  text  [begin, end) with a 0 byte at `end`
 * Out:     cell  the first `most` cells
 * Returns: how many cells there are; -1 for a quote that does not end. */
int lab_csv_cells(char *begin, char *end, char mark, lab_cell *cell, int most);

#endif
