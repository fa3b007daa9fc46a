/* What noise and clock of a log really are, as the residual of a fit shows them, and what rows weigh for it.
 *
 * What counts are second differences of the residual, which a model that lacks something, being smooth, hardly
 * disturbs. While nothing moves they show the noise: where it is white and larger than declared, it takes the place of
 * what was declared. While the channels move they show rows whose time is not what their stamp says: an error of the
 * time of deviation s is one of slope times s on every channel, of a row by itself. Medians are compared, so that
 * bursts, such as a stem that slips, do not count. SPDX-License-Identifier: MIT */
#ifndef LAB_WEIGHTS_H
#define LAB_WEIGHTS_H

#include "../base/limitations.h"
#include "unknowns.h"

/* Look at the residual of a fit; once more at that of a better one, of which what was missing is no part. What the
 * clock does is told once.
 *
 * In:      u    fitted, seen row by row
 * In/out:  run  those of u: sigma, level, jitter, colour, drift and weight change
 *          u    commands may have changed so much before or after the rows that bracket them
 * Out:     any  whether fitting again is worth it
 * Returns: LAB_OK; LAB_NUMERIC, LAB_WORLD. */
int lab_weigh_runs(lab_unknowns *u, lab_run *run, int *any, lab_error *error);

/* Runs that took no part in the fit have the clock of those that did: their rows weigh for it as well, by how fast the
 * model says that the channels move.
 * In:      jitter  [s] of the runs that were fitted
 * In/out:  run     jitter and weight change
 * Returns: as lab_unknowns_errors. */
int lab_weigh_unseen(const lab_rig *model, double jitter, lab_run *run, int n, lab_error *error);

/* Say in a sentence each what was recognised: another noise than declared, values recorded in steps that the noise does
 * not hide, noise with memory, rows whose time is uncertain. */
void lab_weights_say(const lab_run *run, int n, lab_limitations *limitations);

#endif
