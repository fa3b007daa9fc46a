/* The six hypotheses: the cause that each names, how it is taken away, and how the paper varies it.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_HYPOTHESES_H
#define STUDY_HYPOTHESES_H

#include "study.h"

enum { H1_RATE, H2_PRELOAD, H3_LIMITER, H4_BENCH_OFFSET, H5_UNEQUAL_ORIFICES, H6_AIR_PROCESS, HYPOTHESES };

typedef struct hypothesis {
  const char *name, *words; /* "H1", what it names */
  const char *paper;        /* its own verdict, section 7 */
  void (*without)(pneu_params *p, pneu_laws *laws);
  void (*vary)(const study *s, double value, pneu_params *p); /* figures 15 to 19; NULL: not varied */
  double scale;                                               /* brings its SI value to the unit of the figure */
} hypothesis;

extern const hypothesis hypotheses[HYPOTHESES];

#endif
