/* A text file in memory, and what is cut from a text.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TEXT_H
#define LAB_TEXT_H

#include <stddef.h>
#include <stdio.h>

#include "message.h"

enum { LAB_TEXT_MAX = 512 << 20 }; /* [byte] of a file */

typedef struct lab_text {
  char *data; /* with a 0 byte behind the last one */
  size_t size;
} lab_text;

/* Open a user's file for reading: one on a disk, of at most LAB_TEXT_MAX bytes, so that nobody waits for a pipe or
 * reads a device without end. Returns: the stream; NULL with `error`: LAB_DATA if there is none or it is another kind,
 * LAB_WORLD if it cannot be read. */
FILE *lab_text_open(const char *path, lab_error *error);

/* A text that lies in memory, under the name by which it is read. */
typedef struct lab_text_given {
  const char *name;
  const void *data;
  size_t size; /* [byte] */
} lab_text_given;

/* From now on lab_text_read reads these and no file.
 * In:      given  n of them, that stay where they are; NULL: files again */
void lab_text_give(const lab_text_given *given, int n);

/* Read a whole file that lab_text_open opens, or a text that was given; UTF-16 becomes UTF-8, a byte order mark is
 * left out, and lines that all end in CR end in LF.
 * Out:     text  to be freed with lab_text_free
 * Returns: LAB_OK; LAB_DATA if the file is missing, no file on a disk, too large, empty or not text, with what turns it
 *          into text where its kind is known; LAB_WORLD if it cannot be read. */
int lab_text_read(const char *path, lab_text *text, lab_error *error);

/* The bytes of an open file, up to a part with a 0 byte unless they are UTF-16.
 * In:      path  for messages
 * In/out:  text  empty; to be freed, also after an error
 * Returns: LAB_OK, LAB_WORLD. */
int lab_text_stream(FILE *file, const char *path, lab_text *text, lab_error *error);

void lab_text_free(lab_text *text);

/* A text in the making, of any length. */
typedef struct lab_writing {
  FILE *file;
  char *text;
  size_t size;
} lab_writing;

/* Begin.  Returns: the stream to write to; NULL without memory */
FILE *lab_writing_begin(lab_writing *w);

/* End, also one that has not begun.  Returns: the text, to be freed; NULL where there was no memory */
char *lab_writing_end(lab_writing *w);

/* The name of a file without its folders, for what is kept or sent: an error has the path, an answer the name. */
const char *lab_file_name(const char *path);

/* Append to a text, as far as it goes into `size` bytes. */
void lab_append(char *text, size_t size, const char *format, ...) LAB_PRINTF(3, 4);

/* Drop blanks in front and behind, in place.  Returns: where the rest begins */
char *lab_trim(char *text);

/* Make a cell of a table UTF-8: where it is not, it is taken to be Windows-1252, as Excel writes in Western Europe.
 * Out:  out  `room` bytes, cut to them */
void lab_encode_cell(const char *text, char *out, size_t room);

/* Cut a list such as "a.csv;b.csv" at a mark; blanks around the parts and empty parts are dropped.
 * In/out:  text  cut in place
 * Out:     part  point into it
 * Returns: how many; -1 if there are more than `room`. */
int lab_split(char *text, char mark, const char **part, int room);

#endif
