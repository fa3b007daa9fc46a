/* Long logs made short enough to fit.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_THIN_H
#define LAB_THIN_H

#include "../log/log.h"
#include "../base/remarks.h"

/* Rows of a log that a fit uses. Its time grows with the rows (about 10 s for 100,000 without an effect, several times
 * that with one), and what can be told from a stroke does not: 20,000 rows show one of 10 s every half a millisecond.
 */
enum { LAB_THIN_ROWS = 20000 };

/* Keep every k-th row of a log of more than `most` rows, with the first and the last row of each run, and the row of
 * each change of command with the one before it, which bracket the instant. Where the command changes in more than a
 * quarter of `most` rows, it becomes its mean over the rows that each kept one stands for.
 * In/out:  log
 *          remarks  says what was done; nothing if all rows stay */
void lab_log_thin(lab_log *log, size_t most, lab_remarks *remarks);

#endif
