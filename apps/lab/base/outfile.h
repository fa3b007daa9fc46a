/* Output that is whole or absent: written beside its place as `path.part`, then renamed.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_OUTFILE_H
#define LAB_OUTFILE_H

#include <stdio.h>

#include "message.h"

typedef struct lab_outfile {
  FILE *file; /* write here; errors are seen by lab_out_close */
  char *path;
  char *part; /* NULL: written in place (standard output, a device, a pipe) */
} lab_outfile;

/* Open an output; folders on the way to it are made.
 * In:      path  NULL is standard output; a device or a pipe is written in place
 * Out:     out   to be ended with lab_out_close or lab_out_abandon; nothing to end after an error
 * Returns: LAB_OK; LAB_WORLD with the path and the system's words. */
int lab_out_open(lab_outfile *out, const char *path, lab_error *error);

/* Flush, check and put the file in its place; where that fails nothing is left of it.
 * Returns: LAB_OK; LAB_WORLD, for a full disk and the like. */
int lab_out_close(lab_outfile *out, lab_error *error);

/* A line of its own on standard output, arrived when this returns.  Returns: LAB_OK, LAB_WORLD. */
int lab_out_say(const char *line, lab_error *error);

/* Drop what was written. */
void lab_out_abandon(lab_outfile *out);

/* Close where all went well, else drop what was written.
 * In:      status  of whoever wrote
 * Returns: status; where that is LAB_OK, as lab_out_close. */
int lab_out_end(lab_outfile *out, int status, lab_error *error);

/* Make a folder and those on the way to it.  Returns: LAB_OK, LAB_WORLD. */
int lab_make_folder(const char *path, lab_error *error);

#endif
