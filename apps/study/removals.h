/* The causes that the six hypotheses name, and how each is taken away.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_REMOVALS_H
#define STUDY_REMOVALS_H

#include "../../lib/pneu.h"

enum {
  REMOVE_SPRING,
  REMOVE_PRELOAD,
  REMOVE_LIMITER,
  REMOVE_BENCH_OFFSET,
  REMOVE_UNEQUAL_TIMES,
  REMOVE_AIR_PROCESS,
  REMOVALS
};

typedef struct removal {
  const char *hypothesis;
  void (*apply)(pneu_params *p, pneu_laws *laws);
} removal;

extern const removal removals[REMOVALS];

#endif
