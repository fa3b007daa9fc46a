/* Sensors that drift: over a run, a channel comes to be off by a straight line in time, from nothing at its
 * first row on, that is known to a tolerance.
 *
 * A line is no unknown. It is a part of the noise, with the covariance of a prior: what it explains within its
 * tolerance is taken out of every residual, and nothing is simulated for it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_DRIFT_H
#define LAB_DRIFT_H

#include "../base/limitations.h"
#include "unknowns.h"

/* Prepare the lines of a run, again after each change of its noise.
 * In:      x->rig   with the tolerances of the drifts
 * In/out:  x->drift
 * Returns: LAB_OK, LAB_WORLD. */
int lab_drift_open(lab_run *x, lab_error *error);

/* Take a run's lines out of its residual: (I + w w')^(-1/2) r for each channel, w what the tolerance is in noise.
 * In/out:  r  n_channels * n values, weighed and whitened */
void lab_drift_take_out(const lab_run *x, double *r);

/* Errors as they are shown: over noise, row by row, without the most likely line of each run.
 * Out:     r  n_rows values
 * Returns: as lab_unknowns_errors. */
int lab_drift_errors(const lab_unknowns *u, double *r, lab_error *error);

/* The largest drift of all channels and runs, in tolerances.
 * In:      r  residuals of the data, from which lines were taken out */
double lab_drift_strain(const lab_unknowns *u, const double *r);

/* Say how much a sensor drifts where the logs show it: by three standard deviations, and a fifth of its tolerance.
 * Returns: LAB_OK; as lab_unknowns_residuals. */
int lab_drift_say(const lab_unknowns *u, lab_limitations *limitations, lab_error *error);

#endif
