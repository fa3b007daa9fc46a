/* The first rows of a run as a run of its own.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BEGINNING_H
#define LAB_BEGINNING_H

#include "../run/run.h"

/* In:      n     rows, of those of x
 * Out:     part  with weights and drift of its own; all else is that of x. To be closed
 * Returns: LAB_OK, LAB_WORLD. */
int lab_beginning_open(const lab_run *x, size_t n, lab_run *part, lab_error *error);

void lab_beginning_close(lab_run *part);

#endif
