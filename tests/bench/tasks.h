/* What closeloop does, part by part, as runs of a race.
 * SPDX-License-Identifier: MIT */
#ifndef BENCH_TASKS_H
#define BENCH_TASKS_H

#include "../../apps/lab/trace/score.h"
#include "rigs.h"

/* A fit of the declared model from its declared values.  In: context  bench_rig *  Returns: seconds, NaN on failure */
double bench_task_fit(void *context);

/* The scan of a fitted model. */
typedef struct bench_scan {
  lab_unknowns u; /* fitted */
  int effects;    /* of the catalogue; 0: as closeloop scans, all, with every shape and size */
} bench_scan;

/* Fit, for a scan.  Returns: LAB_OK or an error that is recorded */
int bench_scan_fit(bench_rig *r, bench_scan *scan, lab_error *error);

/* Residual, slopes, and the score test.  In: context  bench_scan * */
double bench_task_scan(void *context);

/* Reading the log.  In: context  bench_rig * */
double bench_task_read(void *context);

/* A command line; NaN unless it ends well.  In: context  const char * */
double bench_task_command(void *context);

/* closeloop with report on a rig's logs.  Out: line, of BENCH_LINE */
void bench_closeloop_line(const bench *b, const bench_rig *r, char *line);

#endif
