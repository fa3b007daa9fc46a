/* An experiment: one run of a log beside what a model predicts for it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RUN_H
#define LAB_RUN_H

#include "../base/colour.h"
#include "../log/log.h"
#include "../rig/rig.h"
#include "staging.h"

typedef struct lab_run {
  const lab_rig *rig;
  const lab_log *log;
  size_t run, first, n;                 /* run of the log, its first row, its rows */
  int n_channels;                       /* measured channels that the model predicts */
  int channel[LAB_CHANNEL_COUNT];       /* enum lab_channel of each */
  double sigma[LAB_CHANNEL_COUNT];      /* their noise, SI */
  lab_colour colour[LAB_CHANNEL_COUNT]; /* of the noise (weights.h); at first it is white */
  double resolution[LAB_CHANNEL_COUNT]; /* smallest step between values, SI; its variance is part of sigma */
  double level[LAB_CHANNEL_COUNT];  /* scatter at rest over the noise that was declared (weights.h); 0: not looked at */
  double raised[LAB_CHANNEL_COUNT]; /* factor by which noise with memory has raised sigma; 0: none has */
  double jitter;                    /* [s] deviation of the times of rows, where it shows (weights.h) */
  double *weight;                   /* n_channels * n: noise over that of a row; at first 1 but for coarse steps */
  double *drift;                    /* n_channels * n: what a drift of the sensor adds (drift.h); NULL: there is none */
  lab_inputs inputs;                /* schedule of inputs, as the log shows them */
  size_t n_instants; /* changes of the command whose instant the log brackets; 0 if other inputs change */
  int on_rows;       /* not 0: these changes are made at the rows that show them, and their instants are no unknowns */
  double *bracket;   /* [s] n_instants: time from the row before each change to the row that shows it; 0 on a ramp */
} lab_run;

/* Prepare a run. Noise that the rig does not declare is estimated (noise.h).
 * Out:     e  keeps rig and log; to be closed, also after an error
 *             Rounding to the resolution q adds q^2/12 to the variance. Where the noise is smaller than q, values that
 *             stay within a step share one error: the rows of such a stretch weigh no more than one. So do, as far as
 *             the noise of a pressure that drives the stem goes, the rows while it rests.
 * Returns: LAB_OK; LAB_DATA if nothing is measured that the model predicts; LAB_WORLD. */
int lab_run_open(const lab_rig *rig, const lab_log *log, size_t run, lab_run *e, lab_error *error);
void lab_run_close(lab_run *e);

enum { LAB_EPISODES_MAX = 9 };

/* What a model predicts, which may change on the way.
 * In:      episode  n >= 1 of them, in the order of time, with parameters and free terms in the place of those of the
 *                   experiment's; the first acts from the beginning, whatever its time
 *          early    [s] n_instants: how much before its row each change of command happened; NULL: not at all
 *          tol      local error of the stepper
 * Out:     y        n_channels * n values, SI, channel by channel
 * Returns: LAB_OK; LAB_NUMERIC, also for parameters out of bounds; LAB_WORLD. */
int lab_run_predict(const lab_run *e, const lab_episode *episode, int n, const double *early, double tol, double *y,
                    lab_error *error);

/* What a run is predicted from. */
typedef struct lab_run_case {
  const lab_episode *episode; /* n >= 1 of them, as above */
  int n;
  const double *early; /* [s] n_instants, as above */
} lab_run_case;

/* What cases nearby predict beyond `base`, to first order, from one run (variation.h).
 * Out:     change  n_channels * n values of each case
 *          done    n_cases: not 0 where it could be had so
 * Returns: as lab_run_predict. */
int lab_run_vary(const lab_run *e, const lab_run_case *base, const lab_run_case *nearby, int n_cases, double tol,
                 double *const *change, char *done, lab_error *error);

/* Errors of channel c over its noise, as they count: weighed, and without the memory of the noise.
 * In/out:  v  n values */
void lab_run_weigh(const lab_run *e, int c, double *v);

/* Value measured at row i of channel c (place in e->channel); NaN in a gap. */
double lab_run_measured(const lab_run *e, int c, size_t i);

#endif
