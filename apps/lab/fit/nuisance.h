/* What is known beforehand, without a fit: generalised least squares.
 *
 * A search that fits many models need not fit in each what is known to a tolerance: declared values, instants of
 * commands. With H the slopes of the residuals r in them, over their spreads, and c how far they are from their priors,
 * the best values for given r are those of a linear problem, and what is left is (r, c) with the span of (H, -1) taken
 * out. Its sum of squares is r' (1 + H H')^-1 r where c is 0. Residuals, fits, scores and refits go on as before with
 * what is left in place of r. SPDX-License-Identifier: MIT */
#ifndef LAB_NUISANCE_H
#define LAB_NUISANCE_H

#include "unknowns.h"

typedef struct lab_nuisance {
  int n;
  lab_unknown of[LAB_FIT_MAX]; /* as unknowns, where they were */
  double off[LAB_FIT_MAX];     /* prior less value, over how far it may vary (lab_unknown_reach) */
  double misfit;               /* of the unknowns at that time */
  size_t n_data;               /* residuals of the data, in the view at hand */
  double *slopes;              /* of the residuals of the data: n columns of n_data entries */
  double *basis;               /* orthonormal: n columns of n_data + LAB_FIT_MAX entries */
} lab_nuisance;

/* Take what has a prior out of the unknowns, and its slopes at the present values into account of every residual from
 * now on. Knots of free terms stay.
 * In/out:  u         seen as it will be; keeps `nuisance`
 * Out:     nuisance  to be closed, also after an error
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_nuisance_open(lab_unknowns *u, lab_nuisance *nuisance, lab_error *error);
void lab_nuisance_close(lab_nuisance *nuisance);

/* Project residuals.  In/out: r  n_data entries, and n more to be filled */
void lab_nuisance_apply(const lab_nuisance *nuisance, double *r);

/* The same of a change of residuals.  In/out: change  n_data entries, and n more to be filled */
void lab_nuisance_project(const lab_nuisance *nuisance, double *change);

/* Whether it holds a parameter. */
int lab_nuisance_holds(const lab_nuisance *nuisance, int param);

/* The largest deviation of a declared value from its prior, over its tolerance: among the unknowns, or as the nuisance
 * has it.
 * Out:     strain
 * Returns: as lab_unknowns_residuals. */
int lab_nuisance_strain(const lab_unknowns *u, double *strain, lab_error *error);

/* Put what was taken out back among the unknowns, at its best values, unless it was taken up there.
 * In/out:  u  with a nuisance, then without
 * Returns: as lab_unknowns_residuals. */
int lab_nuisance_return(lab_unknowns *u, lab_error *error);

/* Begin the next fit with the slopes of what was taken out and has come back.  In/out: u  keeps slopes */
void lab_nuisance_begin_with(const lab_nuisance *nuisance, lab_unknowns *u);

/* Whether instants of commands are all that varies unseen. */
int lab_nuisance_is_instants(const lab_nuisance *nuisance);

#endif
