/* Whether a set position that changes at every row holds from row to row.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STAIRS_H
#define LAB_STAIRS_H

#include "../log/log.h"

/* A controller that sends a set position at every row of the log draws stairs; one that is faster than the log draws
 * lines, as far as the log shows. On stairs the travel at a row cannot follow what is sent with that row.
 * In:      first, end  rows of one run
 * Returns: 1 where the travel follows the set position of the rows before, and that of its own row by less than
 *          ON_ITS_ROW of that, with its interval (95 %); 0 where it does, or the log does not tell.
 * Left out: what lies between, a step anywhere in a row, whose instant is fitted. */
int lab_holds_between_rows(const lab_log *log, size_t first, size_t end);

#endif
