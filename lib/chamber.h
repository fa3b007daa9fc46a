#ifndef PNEU_CHAMBER_H
#define PNEU_CHAMBER_H

#include "internal.h"

/* Rates of p and, where it is a state, T. */
void pneu_chamber_rates(const pneu_terms *t, pneu_real *y_dot);

/* Whether volume, temperature and pressure are positive. */
int pneu_chamber_ok(const pneu_terms *t);

#endif
