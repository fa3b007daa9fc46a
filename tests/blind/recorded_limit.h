/* What a log "as recorded" can show of what is wrong, at best.
 *
 * As in limit.h, everything is a difference of two noise-free runs of the virtual rig, over what the sensors and the
 * logger add, and what can be adjusted takes its part first. Here that is more: the fitted values; every other declared
 * value as far as its tolerance lets it, which is a row of its own, of one standard deviation; zero, gain, lag, drift
 * and clock of the sensors likewise; instants and the other effect. Where the statistic of what is left is small, a
 * sound program says nothing.
 * SPDX-License-Identifier: MIT */
#ifndef BLIND_RECORDED_LIMIT_H
#define BLIND_RECORDED_LIMIT_H

#include "recorded.h"
#include "spoil.h"

typedef struct blind_visible {
  double effect[BLIND_AT_ONCE]; /* statistic of each missing effect at its size */
  double value[BLIND_VALUES];   /* of each value at what it is off */
  double vent;                  /* of the vent at what it is off beside the fill orifice */
} blind_visible;

/* An interval of 95 % is 1.96 standard deviations to either side; what is off by twice that has at least this. */
#define BLIND_DUE (2 * 1.96 * 2 * 1.96)

/* Returns: LAB_OK; LAB_NUMERIC, LAB_WORLD */
int blind_recorded_visible(const blind_recorded *trial, blind_visible *visible, lab_error *error);

#endif
