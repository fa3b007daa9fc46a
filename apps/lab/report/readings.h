/* What can be read off the figures of a page by pointing: the numbers behind each curve, and where its panel lies.
 *
 *   {"columns": [{"k": 2, "d": "10000,3,,-2"}],
 *    "panels": {"response": [{"group": "t", "x_name": "t", "x_unit": "s", "x": [0, 27], "y": [-10, 330],
 *      "box": [69.7, 245, 799.5, 405], "name": "Pressure p", "unit": "kPa", "at": 0,
 *      "curves": [{"key": "measured", "of": 1}]}]}}
 *
 * and beside them "t", the column of time, by the clock of each log, "runs", with the entry at which each run begins
 * and the shift of its clock on the axis, and "labels", what the keys are called.
 *
 * A column is a list of whole numbers, each the difference from the one before, in units of 10^-k; empty for a gap. A
 * box is left, top, right, bottom in units of the drawing; x and y are the ends of its axes.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_READINGS_H
#define LAB_READINGS_H

#include <stddef.h>

#include <cjson/cJSON.h>

/* A panel: where it lies, and what its axes show. */
typedef struct lab_panel {
  const char *group; /* panels of one group, also of other figures, are read at the same x */
  const char *x_name, *x_unit;
  const char *name, *unit; /* of what is shown */
  double left, top, right, bottom;
  double x[2], y[2]; /* ends of the axes */
} lab_panel;

cJSON *lab_readings_new(void);

/* Add a column, rounded to `decimals` after the point.
 * In:      keep  n; the entries to take; NULL: all
 * Returns: its number; -1 without memory. */
int lab_readings_column(cJSON *readings, const double *value, const unsigned char *keep, size_t n, double scale,
                        int decimals);

/* Decimals by which a range has some thousand steps. */
int lab_readings_decimals(double low, double high);

/* Add a panel to a figure, whose curves have their x in the column `at`.  Returns: the panel; NULL without memory. */
cJSON *lab_readings_panel(cJSON *readings, const char *figure, const lab_panel *panel, int at);

/* Add a curve to a panel.
 * In:      key  of what is shown; the drawing has it as a title
 *          of   column */
void lab_readings_curve(cJSON *panel, const char *key, int of);

#endif
