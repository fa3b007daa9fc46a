/* Figures by gnuplot.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_GNUPLOT_H
#define LAB_GNUPLOT_H

#include <stdio.h>

#include "message.h"

/* Draw a figure, whole or not at all, into the file `out`: runs the script, which draws to standard output, with IN,
 * the folder of the tables. A gnuplot that outlives this program touches no file that has a name. Returns: LAB_OK;
 * LAB_WORLD if gnuplot is not there or fails, or the file cannot be written. */
int lab_gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error);

/* The same with a script that has its data in it.
 * In:      script  a file without a name (tmpfile), written
 * Out:     drawn   0 if there is no gnuplot
 * Returns: LAB_OK; LAB_WORLD if gnuplot fails, or the file cannot be written. */
int lab_gnuplot_run(FILE *script, const char *out, int *drawn, lab_error *error);

#endif
