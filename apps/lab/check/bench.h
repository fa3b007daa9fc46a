/* The logs of one question to closeloop, and an experiment for each of their runs.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_BENCH_H
#define LAB_BENCH_H

#include "../run/experiment.h"
#include "plausible.h"
#include "../base/remarks.h"

enum { LAB_BENCH_LOGS = 32, LAB_BENCH_RUNS = 256 };

typedef struct lab_bench {
  lab_log log[LAB_BENCH_LOGS];
  int n_logs;
  lab_experiment experiment[LAB_BENCH_RUNS];
  int n;
  lab_content content;
  lab_remarks remarks;
} lab_bench;

/* Read a log, leave out what is no measurement, see that it makes sense on this rig, and prepare its runs.
 * In:      rig    kept
 * In/out:  bench  all 0 at first; to be closed, also after an error
 * Returns: LAB_OK, LAB_DATA, LAB_WORLD. */
int lab_bench_add(lab_bench *bench, const lab_rig *rig, const char *path, lab_error *error);
void lab_bench_close(lab_bench *bench);

#endif
