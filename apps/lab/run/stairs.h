/* Whether a set position holds from row to row of a log.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STAIRS_H
#define LAB_STAIRS_H

#include "../log/log.h"

/* A controller that sends a set position with each row of the log draws stairs; one that is faster than the log draws
 * lines, as far as the log shows. On stairs the travel at a row cannot follow what is sent with that row. Lines that are
 * late by half a row or more cannot either: there it follows what was sent two rows before beside the row before.
 * In:      log  of all its runs, whose rows count as evenly apart
 * Returns: 1 where the travel follows the set position of the row before, and plainly less that of its own row and of
 *          two rows before; 0 where it does not, or the log does not tell: fewer than 40 rows, or a set position that
 *          goes on as before.
 * Left out: stairs with a dead time of half a row or more, or a slow stem without a pressure beside it, which count as
 *          lines; steps anywhere in a row, whose instant is fitted. */
int lab_holds_between_rows(const lab_log *log);

#endif
