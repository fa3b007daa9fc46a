/* Logs in long format: a row holds one value of one channel.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGLONG_H
#define LAB_LOGLONG_H

#include "log.h"

/* Sort the rows by time and join those of the same instant; a command holds until the next one. Two values
 * of one channel at one instant are an error.
 * In/out:  log  one run; n shrinks
 * Returns: LAB_OK, LAB_DATA with the line, LAB_WORLD. */
int lab_log_join(lab_log *log, lab_error *error);

#endif
