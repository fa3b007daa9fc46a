/* The last steps of reading a raw log: rows put in the order and the number that the format asks for.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGSHAPE_H
#define LAB_LOGSHAPE_H

#include "log.h"

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
