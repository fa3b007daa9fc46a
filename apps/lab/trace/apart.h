/* Values that differ from log to log: a sensor's zero, how a hand valve was shut, what the day before has left.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_APART_H
#define LAB_APART_H

#include "search.h"

/* The declared model where each log has its own value of some parameters. */
typedef struct lab_apart {
  lab_unknowns declared; /* fitted */
  int n, param[LAB_OWN_MAX];
} lab_apart;

/* Give each log its own value of what the rig file asks to be fitted and a rig may begin anew with, one parameter after
 * the other, as long as that takes DIFFER_SHARE off chi-square.
 * In:      declared  fitted
 * Out:     apart     n = 0: nothing differs by as much, or there is one log
 * Returns: LAB_OK, LAB_WORLD. */
int lab_apart_find(const lab_unknowns *declared, lab_apart *apart, lab_error *error);

/* Where effects explain no more than a part of logs of which something differs, search once more with values of each
 * log. If that explains them, has a lower BIC, or leaves as much as a free term does, it is the answer,
 * and the bench's remarks say what differs; else nothing changes: what differs may only stand in for an effect.
 *
 * In/out:  bench      its logs
 *          completed  model of the search with what the logs share, and
 *          result     of it
 * Returns: as lab_search_run; a failure to follow with values of each log is no error. */
int lab_apart_search(const lab_apart *apart, const lab_search_options *options, lab_logs *bench,
                     lab_unknowns *completed, lab_search_result *result, lab_error *error);

#endif
