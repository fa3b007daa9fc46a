/* How far what was not touched is found again on another day.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_REPEAT_H
#define LAB_REPEAT_H

#include "../rig/rig.h"

typedef struct lab_repeat {
  const char *name; /* as lab_fit_name has it */
  double share;     /* standard deviation as a share of `of`, a parameter's name, or of its own value */
  const char *of;   /* NULL: its own; "row": the time between two rows */
  double spread;    /* the same in its unit, where it is no share; both 0: it does not change by itself */
  int tested;       /* not 0: beyond that it is a change; 0: it is the weather */
} lab_repeat;

extern const lab_repeat lab_repeats[];
extern const int lab_repeat_count;

/* What is known of a parameter.  Returns: NULL: nothing */
const lab_repeat *lab_repeat_find(int param);

/* The standard deviation on a rig, in the parameter's unit.  In: row  [s] from row to row of the logs */
double lab_repeat_spread(const lab_repeat *repeat, const lab_rig *rig, double row);

#endif
