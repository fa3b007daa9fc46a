/* The rows of a log in the order of time.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_INSTANTS_H
#define LAB_INSTANTS_H

#include "log.h"

typedef struct lab_instant {
  double t;   /* [s] */
  size_t row; /* of the log */
} lab_instant;

/* Sort by time; rows of one instant stay in the order of the log.  Out: order  log->n entries */
void lab_instants_of(const lab_log *log, lab_instant *order);

#endif
