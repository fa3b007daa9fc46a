/* Does a log fit its rig? Checks of sense before any fit: values within what the rig can reach, channels alive, a
 * command that drives the measured motion, enough in the log to determine anything.
 *
 * A check either refuses the log (LAB_DATA: what was expected, what was found, what to do) or leaves a remark, which
 * the report carries as a limitation and which may forbid naming an effect. Thresholds are wide: a log is refused for
 * what no missing effect of a usual size makes of a rig, such as a factor of three in a level or of twenty in time.
 *
 *   lab_limitations remarks = {0};
 *   for each log: lab_log_thin(&log, LAB_THIN_ROWS, &remarks), lab_log_clean(rig, &log, &remarks, error),
 *                 lab_plausible(rig, &log, &remarks, &content, error)
 *   at last:      lab_plausible_content(rig, &content, &remarks, error)
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PLAUSIBLE_H
#define LAB_PLAUSIBLE_H

#include "../log/log.h"
#include "../base/limitations.h"
#include "../rig/rig.h"

/* How much there is to learn from, over all runs. */
typedef struct lab_content {
  size_t values; /* measured values that the model predicts */
  int runs;
  int still; /* runs in which nothing moves */
} lab_content;

/* Remark on columns of a log that this rig has no use for. */
void lab_say_idle_columns(const lab_rig *rig, const lab_log *log, lab_limitations *limitations);

/* Check every run of a log, and its columns.
 * In/out:  remarks
 *          content  what the log adds
 * Returns: LAB_OK; LAB_DATA; LAB_WORLD. */
int lab_plausible(const lab_rig *rig, const lab_log *log, lab_limitations *limitations, lab_content *content,
                  lab_error *error);

/* Is there enough to determine what the rig file asks for?
 * Returns: LAB_OK; LAB_DATA if nothing moves, or there are fewer values than unknowns. */
int lab_plausible_content(const lab_rig *rig, const lab_content *content, lab_limitations *limitations,
                          lab_error *error);

#endif
