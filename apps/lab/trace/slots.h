/* Where something may act that has no name: slots, tested as the effects are (trace.h).
 *
 * A slot is an equation and an argument in which a free term (pneu.h) may act; its slopes are those in the heights of
 * the term's knots, and T is chi-square with as many degrees of freedom as of them the log sees. What comes in cycles
 * of time has the two amplitudes of a sine, with the period that the residual shows (cycles.h); its phase is that of
 * the logs' own times, and the same for all of them.
 *
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SLOTS_H
#define LAB_SLOTS_H

#include "scan.h"

enum { LAB_SLOT_MAX = 24 };

/* An equation and an argument in which something without a name may act. */
typedef struct lab_slot {
  pneu_term term;   /* its knots, values 0; or its cycle, with the amplitudes that the slopes ask for */
  double scale;     /* a value of it that matters, in its unit */
  double statistic; /* T */
  int degrees;      /* of freedom: directions of the knots that the log sees */
} lab_slot;

/* Try every slot.
 * Out:     slot  largest statistic less degrees first
 *          n     their number
 * Returns: LAB_OK, LAB_WORLD. */
int lab_slots_try(const lab_scan *scan, lab_slot slot[LAB_SLOT_MAX], int *n, lab_error *error);

/* Tests that the statistic of a term is the best of: a cycle is the best of many lines. */
double lab_slot_tests(const pneu_term *term);

#endif
