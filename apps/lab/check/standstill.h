/* A declared model whose stem cannot leave its stop.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_STANDSTILL_H
#define LAB_STANDSTILL_H

#include "../base/limitations.h"
#include "../rig/rig.h"

/* Whether the whole supply cannot lift the stem off its lower stop against spring, load and dry friction as declared.
 * What is fitted may be ten times less than declared. Never so where there is no stroke, where pressure, position,
 * supply or force is an input, where the supply is fitted, or where a free term acts on supply or force.
 * In:      share  of the pressure that it takes, below which the supply counts as too low, 0 .. 1
 * Out:     text   one sentence without its full stop: the pressures, and the unit that was meant if one fits; else ""
 * Returns: 1 if it cannot, else 0. */
int lab_is_at_rest(const lab_rig *rig, double share, char text[LAB_LIMITATION_TEXT]);

#endif
