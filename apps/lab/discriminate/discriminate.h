/* Which test to record next: the one that separates two models which explain a log equally well, or the one that
 * narrows what is known least.
 *
 * Both models are simulated over a set of trials (trial.h). What counts is the part of their difference that fitting
 * again, to the trial and what has been recorded, cannot absorb: with y_A and y_B over the noise and J the slopes of B
 * in what would be fitted, the length of y_A - y_B with the span of J taken out, after the parameters of B have moved
 * to where they fit A best (Gauss-Newton, a few steps; what has been recorded counts by its slopes). The smaller of
 * both ways round is taken. All trials are ranked by an estimate from slopes of the model midway; the best are then
 * settled. A trial of hundreds of slips is only estimated. Fitted again are the list given and all parameters of the
 * effects by which the models differ. White noise; the instants of commands count as known.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DISCRIMINATE_H
#define LAB_DISCRIMINATE_H

#include "../run/response.h"
#include "testplan.h"

enum { LAB_ADVICE_TEXT = 512 };

/* What is asked about. */
typedef struct lab_advice_request {
  const lab_rig *rig; /* laws; its parameters give the times of the trials, its noise that of sensors to add */
  double noise[LAB_CHANNEL_COUNT]; /* of the recorded channels among p, x, T, ps, SI; NaN: not recorded */
  double spacing;                  /* [s] between rows */
  int n_fit;
  const int *fit; /* what is fitted, as in lab_rig.fit */
  int n_known;    /* the first of these, whose intervals are narrowed only where none of the others can be */
  const lab_schedule *recorded; /* what has been recorded; NULL: a fill and vent */
  double recorded_duration;     /* [s] from its first row */
  double until;                 /* [s] of CPU time (lab_cpu_time) from when on no more is simulated; 0: no end */
} lab_advice_request;

enum lab_advice_kind {
  LAB_ADVICE_NONE,  /* `text` says why */
  LAB_ADVICE_TEST,  /* record `trial` */
  LAB_ADVICE_SENSOR /* no trial separates them; with a sensor for `channel` this one would */
};

typedef struct lab_advice {
  int kind;
  char text[LAB_ADVICE_TEXT]; /* what to do: "hold at 80 % travel with both orifices shut for 10 s" */
  char why[LAB_ADVICE_TEXT];  /* a sentence with the figures; empty where there are none */
  lab_test_plan plan;
  double separation; /* [sigma] expected of the trial and what has been recorded together, with the recorded channels */
  double usual;      /* [sigma] of what has been recorded alone */
  int channel;       /* enum lab_channel; -1 none */
  double with_sensor;   /* [sigma] */
  int param;            /* of the interval, as in lab_rig.fit; -1 none */
  double before, after; /* half width of its 95 % interval, over its value (of an effect: its usual size) */
} lab_advice;

/* Two models of a rig: which trial separates them? The largest separation wins; those above 100 sigma (or twice that of
 * what has been recorded, if it is more) count as equal, and of those within 10 % of the largest the shortest is taken.
 * Below 5 sigma a trial does not separate.
 * Returns: LAB_OK, also without advice; LAB_DATA for an request that is none; LAB_WORLD. */
int lab_discriminate(const lab_advice_request *request, const pneu_params *a, const pneu_params *b, lab_advice *advice,
                     lab_error *error);

/* One model: which trial, recorded besides what is there, narrows the widest interval of what is fitted most? A
 * parameter of an effect at its neutral value stands for the effect's limit of detection. Where no trial narrows the
 * widest one by a tenth, the next is tried.
 * Returns: as lab_discriminate. */
int lab_advise_precision(const lab_advice_request *request, const pneu_params *params, lab_advice *advice,
                         lab_error *error);

#endif
