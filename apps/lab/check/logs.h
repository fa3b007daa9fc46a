/* The logs of one question to closeloop, and an experiment for each of their runs.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_LOGS_H
#define LAB_LOGS_H

#include "../run/run.h"
#include "plausible.h"
#include "../base/limitations.h"

enum { LAB_LOGS_MAX = 32, LAB_RUNS_MAX = 256 };

typedef struct lab_logs {
  int is_whole;        /* not 0: long logs keep all their rows, to be judged rather than fitted */
  int by_set_position; /* not 0: of u and sp in a log the latter drives, if the rig file declares a positioner */
  int n_without_u;     /* logs of which u is left out for that */
  lab_log log[LAB_LOGS_MAX];
  int n_logs;
  lab_run run[LAB_RUNS_MAX];
  int n;
  lab_content content;
  lab_limitations limitations;
} lab_logs;

/* Read a log, leave out what is no measurement, see that it makes sense on this rig, and prepare its runs.
 * In:      rig    kept
 * In/out:  bench  all 0 but is_whole and by_set_position at first; to be closed, also after an error
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int lab_logs_add(lab_logs *bench, const lab_rig *rig, const char *path, lab_error *error);
void lab_logs_close(lab_logs *bench);

#endif
