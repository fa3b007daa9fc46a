/* Logs of a rig, made by the independent generator, and what closeloop makes of them.
 * SPDX-License-Identifier: MIT */
#ifndef BENCH_RIGS_H
#define BENCH_RIGS_H

#include "../../apps/lab/fit/unknowns.h"
#include "bench.h"

/* A log, and the model that is to be fitted to it. */
typedef struct bench_rig {
  char folder[BENCH_PATH]; /* with rig.cfg, fit.csv and holdout.csv */
  lab_rig rig;
  lab_log log;
  lab_run run;
} bench_rig;

/* Fifty seconds of strokes of an R1-400 whose parameters are off by 3 to 8 %, pressure and position.
 * In:      name   of a folder in b->scratch
 *          rows   of the log, about
 *          leaky  not 0: its chamber leaks, which the rig file does not say
 * Returns: LAB_OK or an error that is recorded */
int bench_rig_write(const bench *b, const char *name, double rows, int leaky, bench_rig *r, lab_error *error);

/* Read what was written.  Out: rig, log, experiment; to be closed */
int bench_rig_open(bench_rig *r, lab_error *error);
void bench_rig_close(bench_rig *r);

#endif
