/* What is timed, and where the times go.
 * SPDX-License-Identifier: MIT */
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

#include "../../apps/study/table.h"
#include "contender.h"
#include "timing.h"

enum { BENCH_PATH = 1024, BENCH_LINE = 8192 };

typedef struct bench {
  const char *results, *scratch, *programs; /* folders: tables, files that may go, closeloop and sweep */
  int quick;                                /* not 0: few repeats, small sizes; to try the program itself */
  const bench_contender *contender;         /* the own ones first */
  int n;
  double fit_tol[BENCH_CONTENDERS_MAX]; /* loosest tolerance with an error of 1e-6 of stroke, in the law of the fit */
  table items, diagram, scaling;
} bench;

/* Repeats of a race. */
int bench_repeats(const bench *b, int usual);

/* A row of items: who, on what, how exactly, how long; `own` is the time that its ratio is taken against. */
void bench_item(bench *b, const char *item, const char *law, const char *who, double tol, double error,
                const bench_spread *time, double own);

/* A row of scaling: a task, what grows, and how long it takes. */
void bench_scale(bench *b, const char *task, const char *grows, double value, const bench_spread *time);

/* The parts; each adds rows.  Returns: LAB_OK or an error that is recorded. */
int bench_races(bench *b, lab_error *error);    /* fill-and-vent: work and precision, then at three errors */
int bench_small(bench *b, lab_error *error);    /* right-hand side, step of 1 ms */
int bench_fits(bench *b, lab_error *error);     /* the four-parameter fit */
int bench_loops(bench *b, lab_error *error);    /* scan, closeloop, study */
int bench_growth(bench *b, lab_error *error);   /* cost over rows, effects, parameters, threads */
int bench_readings(bench *b, lab_error *error); /* a log of a million rows */

/* All of it: results/bench.csv, work_precision.csv, scaling.csv.
 * In:      rival  n_rivals that join the own contenders
 * Returns: exit status */
int bench_run(const char *results, const char *scratch, const char *programs, int quick, const bench_contender *rival,
              int n_rivals);

#endif
