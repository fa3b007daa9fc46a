#ifndef PNEU_STEM_H
#define PNEU_STEM_H

#include "internal.h"

/* Force on the stem without friction and viscous terms, and the level of dry friction. */
void pneu_stem_force(pneu_terms *t);

/* [N] on the stem, positive against the air, that keeps its velocity as it is; lib/pneu.h, holding_force. */
pneu_real pneu_stem_holding(const pneu_terms *t);

/* [m/s2] */
pneu_real pneu_stem_acceleration(const pneu_terms *t);

#endif
