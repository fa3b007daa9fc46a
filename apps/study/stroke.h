/* A full stroke up and down of a model, and its measures.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_STROKE_H
#define STUDY_STROKE_H

#include "../../lib/pneu.h"
#include "../lab/base/message.h"
#include "../lab/metrics/asymmetry.h"

/* A simulated stroke: dense output of the stepper, at most 20 ms apart. */
typedef struct stroke_curve {
  size_t n, room; /* samples in use, samples allocated */
  double *t;      /* [s] from the change of command */
  double *x;      /* [m] */
  double *v;      /* [m/s] */
  double *p;      /* [Pa] gauge */
  int full;       /* out of memory */
} stroke_curve;

typedef struct stroke_pair {
  stroke_curve up, down;
} stroke_pair;

/* Fill from rest on the lower stop until nothing moves, then vent until nothing moves, by the library's stepper at
 * tol 1e-8.
 * In:      up, down  parameters on either way; the same of an actuator that has no others on its way down
 * Out:     pair      free with stroke_pair_free, also after a failure
 * Returns: LAB_OK, LAB_DATA (parameters out of bounds), LAB_NUMERIC, LAB_WORLD. */
int stroke_sample(const pneu_params *up, const pneu_params *down, const pneu_laws *law, stroke_pair *pair,
                  lab_error *error);
void stroke_pair_free(stroke_pair *pair);

/* A stroke as the measures take it. */
lab_edge stroke_edge(const stroke_curve *s);

/* Sample and measure.  Returns: as stroke_sample; LAB_DATA also without travel. */
int stroke_measure(const pneu_params *up, const pneu_params *down, const pneu_laws *law, lab_asymmetry *out,
                   lab_error *error);

#endif
