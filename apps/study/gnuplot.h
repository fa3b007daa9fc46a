/* Figures by gnuplot.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_GNUPLOT_H
#define STUDY_GNUPLOT_H

#include "../lab/message.h"

/* Draw a figure, whole or not at all: runs the script with IN, the folder of the tables, and OUT, the file to write.
 * Returns: LAB_OK; LAB_WORLD if gnuplot is not there or fails. */
int gnuplot_draw(const char *script, const char *in, const char *out, lab_error *error);

#endif
