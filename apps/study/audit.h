/* Mass and energy balances over a run: what came in and went out against what is there.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_AUDIT_H
#define STUDY_AUDIT_H

#include "../../lib/pneu.h"
#include "../lab/base/message.h"

typedef struct audit {
  double mass_flow;     /* [kg] integral of inflow less outflow */
  double mass_passed;   /* [kg] integral of inflow plus outflow */
  double energy_flow;   /* [J] integral of enthalpy in less out, heat, less work on the stem */
  double energy_passed; /* [J] integral of the sizes of these */
  double mass_gap;      /* [1] change of mass less mass_flow, over mass_passed */
  double energy_gap;    /* [1] likewise; NaN for the isothermal law, where heat is what it must be */
} audit;

/* Fill for 15 s and vent for 15 s from rest, and add up both balances by Gauss quadrature of order 8 over the dense
 * output.
 * In:      tol  local error in units of full scale
 * Returns: LAB_OK, LAB_NUMERIC. */
int audit_run(const pneu_model *model, double tol, audit *balance, lab_error *error);

#endif
