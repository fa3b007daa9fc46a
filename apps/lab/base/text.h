/* A text file in memory, and its lines.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TEXT_H
#define LAB_TEXT_H

#include <stddef.h>

#include "message.h"

typedef struct lab_text {
  char *data; /* with a 0 byte behind the last one */
  size_t size;
} lab_text;

/* Read a whole file; a UTF-8 byte order mark is left out.
 * Out:     text  to be freed with lab_text_free
 * Returns: LAB_OK; LAB_DATA if the file is missing, a folder, empty or not text; LAB_WORLD if it cannot be read. */
int lab_text_read(const char *path, lab_text *text, lab_error *error);

void lab_text_free(lab_text *text);

/* A line at a time; `number` counts from 1. */
typedef struct lab_lines {
  const char *at, *end;
  int number;
} lab_lines;

void lab_lines_start(lab_lines *lines, const lab_text *text);

/* Step to the next line.  Out: begin, end  without the line's end (LF or CR LF).  Returns: 0 after the last one. */
int lab_lines_next(lab_lines *lines, const char **begin, const char **end);

/* Lines in a text, the last one counted whether or not it ends. */
size_t lab_lines_count(const lab_text *text);

/* The name of a file without its folders, for what is kept or sent: an error has the path, an answer the name. */
const char *lab_file_name(const char *path);

#endif
