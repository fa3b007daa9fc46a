/* A fitted model, seen from the residual: what the score tests of trace.h and slots.h project out.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SCAN_H
#define LAB_SCAN_H

#include "../fit/unknowns.h"

typedef struct lab_scan {
  lab_unknowns *u;
  size_t m;
  double *r;     /* residual */
  double *basis; /* n_basis orthonormal columns that span the slopes in what was fitted */
  int n_basis;
  double chi2, excess; /* of the data; what is beyond its expectation */
} lab_scan;

/* Residual and slopes of a fitted model.
 * In:      u     fitted; used until the scan is closed
 * Out:     scan  to be closed, also after an error
 * Returns: LAB_OK, LAB_NUMERIC, LAB_WORLD. */
int lab_scan_open(lab_unknowns *u, lab_scan *scan, lab_error *error);
void lab_scan_close(lab_scan *scan);

/* What another model would change in the residuals.  Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD. */
int lab_scan_difference(const lab_scan *scan, const lab_rig *model, double *slope, lab_error *error);

/* Take the span of n orthonormal columns of m entries out of v; a second time where little is left, for rounding.
 * Returns: length left. */
double lab_scan_project_out(const double *basis, int n, size_t m, double *v);

/* Take what was fitted out of a slope.  Returns: length left; 0 where rounding is all that is left. */
double lab_scan_visible(const lab_scan *scan, double *v);

void lab_scan_normalise(double *v, double length, size_t m);

#endif
