/* An attempt: a model with what was added to it, fitted, and how good it is.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ATTEMPT_H
#define LAB_ATTEMPT_H

#include "loop.h"

typedef struct lab_attempt {
  lab_unknowns u;
  double chi2; /* of the residuals, with priors */
  double bic;  /* Schwarz 1978, over the measured values; a free term costs more than an effect */
  int fitted;
  int white; /* more is left than the declared noise, but it is noise */
  int n_found;
  lab_found found[LAB_LOOP_EFFECTS];
} lab_attempt;

/* Fit from its present values.
 * In:      steps  as for lab_unknowns_fit
 * Returns: as lab_unknowns_fit; `fitted` says whether it was LAB_OK. */
int lab_attempt_fit(lab_attempt *a, int steps, lab_error *error);

/* Take the values that the unknowns had before any fit. */
void lab_attempt_undo_fit(lab_attempt *a);

/* One more thing found, to be filled in.  Returns: its place. */
lab_found *lab_attempt_add_found(lab_attempt *a);

/* Say what the last addition did to chi-square. */
void lab_attempt_explain(lab_attempt *a, double chi2_before);

/* "declared model", or what was found, joined by " + ".  Out: text */
void lab_attempt_name(const lab_attempt *a, char *text, size_t size);

/* Whether one of n attempts leaves only noise: chi-square within six standard deviations of its expectation, or the
 * error within a twentieth of the noise, as far as a declared noise can be trusted; or white noise, up to half as large
 * again as declared. */
int lab_any_is_noise(const lab_attempt *a, int n);

/* Whether one of n attempts leaves nothing to explain: chi-square within a standard deviation of its expectation. */
int lab_any_is_clean(const lab_attempt *a, int n);

/* Order for qsort: fitted ones first, then by BIC. */
int lab_attempt_by_bic(const void *x, const void *y);

/* The better of two, by chi-square, takes the place of the first. */
void lab_attempt_keep_better(lab_attempt *a, const lab_attempt *other);

#endif
