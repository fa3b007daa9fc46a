/* What a model does when the commands of a log drive it.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_PREDICT_H
#define LAB_PREDICT_H

#include "../log/log.h"
#include "response.h"
#include "../rig/rig.h"

/* What is followed. */
typedef struct lab_prediction {
  const lab_rig *rig; /* of the model */
  const lab_log *log;
  size_t run;      /* of the log */
  const double *t; /* [s] n times to sample at, increasing, within the run; NULL: at its rows */
  size_t n;
  lab_response_options options;
} lab_prediction;

/* Respond to one run of a log, from where it begins.
 * Out:     trace    free with lab_response_free
 * Returns: LAB_OK, LAB_DATA (the log lacks an input, or begins in no state), LAB_NUMERIC, LAB_WORLD. */
int lab_predict_log(const pneu_model *model, const lab_prediction *following, lab_response *response, lab_error *error);

#endif
