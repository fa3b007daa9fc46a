/* A user's text on its way into a file of another kind, where it is to be shown and never to be obeyed: one function a
 * kind, for whoever writes such a file.
 *
 * Text is plain where it is UTF-8 without control characters, ends of lines and marks that turn the direction of what
 * follows. What is not plain is shown as U+FFFD, or as "?" where there is no room for more.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ESCAPE_H
#define LAB_ESCAPE_H

#include <stdio.h>

#include <cjson/cJSON.h>

int lab_is_plain(const char *text);

/* Put "?" in the place of every byte that is not plain. */
void lab_make_plain(char *text);

/* Make one part of a path of a name: no / or \ is left in it, and no . at its beginning. */
void lab_make_file_name(char *name);

/* HTML and SVG: between tags, and within quotes. Ends of lines and tabs stay. */
void lab_put_html(FILE *file, const char *text);

/* A path as an address in HTML: all but letters, digits and -._~/ as %xx. */
void lab_put_address(FILE *file, const char *path);

/* A cell of a CSV file, in quotes where it needs them; the end of a line becomes a blank. */
void lab_put_cell(FILE *file, const char *text);

/* The same of what a user has written: a spreadsheet takes what begins with = + - @ for a formula, so that an
 * apostrophe goes before it. */
void lab_put_users_cell(FILE *file, const char *text);

/* A string of libconfig with its quotes, which is read as the same bytes. */
void lab_put_config(FILE *file, const char *text);

/* A string of gnuplot with its quotes, single ones, in which it substitutes nothing. A line only. */
void lab_put_gnuplot(FILE *file, const char *text);

/* Words in a comment of C. */
void lab_put_comment(FILE *file, const char *text);

#endif
