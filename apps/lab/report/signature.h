/* The valve signature: the pressures that balance the stem over its travel, in either direction.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_SIGNATURE_H
#define LAB_SIGNATURE_H

#include "report.h"

enum { LAB_SIGNATURE_POINTS = 51 };

/* Lines of a signature: the stem is about to move down, has no dry friction, is about to move up. */
enum lab_signature_line { LAB_SIGNATURE_DOWN, LAB_SIGNATURE_SPRING, LAB_SIGNATURE_UP, LAB_SIGNATURE_LINES };

typedef struct lab_signature {
  double x[LAB_SIGNATURE_POINTS];                      /* [m] from stop to stop */
  double p[LAB_SIGNATURE_LINES][LAB_SIGNATURE_POINTS]; /* [Pa] gauge */
  double bench_lower, bench_upper;                     /* [Pa] bench set: of the spring alone at either stop */
  double spring_rate;                                  /* [N/m] mean over the stroke, as the pressure shows it */
  double band;                                         /* [Pa] between up and down at mid travel */
} lab_signature;

/* The signature of a rig, with what its effects and free terms do to forces at rest; a force that builds up over
 * travel, such as spring_hysteresis, is left out. Returns: LAB_OK; LAB_DATA for a parameter out of bounds or a vessel,
 * which has none. */
int lab_signature_make(const lab_rig *rig, lab_signature *signature, lab_error *error);

/* The rigs of a report that have a signature: as declared, as found, and as the baseline has it, if there is one.
 * Out:     model
 * Returns: their number. */
enum { LAB_SIGNATURE_MODELS = 3 };
typedef struct lab_signature_model {
  int key; /* enum lab_curve_key_id */
  const lab_rig *rig;
  lab_signature signature;
} lab_signature_model;
int lab_signature_models(const lab_report *report, lab_signature_model model[LAB_SIGNATURE_MODELS]);

#endif
