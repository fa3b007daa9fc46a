/* Records for the figures of merit, with their memory: of a simulation, or of what a bench has measured.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RECORDING_H
#define LAB_RECORDING_H

#include "metrics.h"
#include "../run/response.h"
#include "../fit/unknowns.h"

typedef struct lab_recording {
  lab_record record;
  size_t room; /* of rows */
  double *memory;
  size_t *first;
} lab_recording;

/* An empty recording for so many rows and runs, with what the rig says of its actuator.
 * Out:     recording  to be closed, also after an error
 * Returns: LAB_OK; LAB_DATA for a rig that is no model; LAB_WORLD. */
int lab_recording_open(const lab_rig *rig, size_t rows, size_t runs, lab_recording *recording, lab_error *error);
void lab_recording_close(lab_recording *recording);

/* Append a response as one run. */
void lab_recording_add_response(lab_recording *recording, const lab_response *response);

/* What a model does when the commands of a log drive it, sampled at least every 10 ms (or 200 000 times in all).
 * Out:     recording  to be closed, also after an error
 * Returns: as lab_predict_log. */
int lab_recording_simulate(const pneu_model *model, const lab_rig *rig, const lab_log *log, lab_recording *recording,
                           lab_error *error);

/* What a fitted model does at the rows of a run, with commands that act at the rows that show them.
 * Out:     response  to be freed with lab_response_free
 * Returns: as lab_predict_log. */
int lab_run_respond(const lab_unknowns *u, int run, lab_response *response, lab_error *error);

/* Figures of merit of the runs of a fit, as they were measured, and as the fitted model does them at the same times,
 * by lab_run_respond. A model that cannot follow the runs has no figures, and its error
 * is the reason.
 * Returns: LAB_OK, LAB_WORLD. */
int lab_metrics_compare(const lab_unknowns *u, lab_metrics *measured, lab_metrics *predicted, lab_error *error);

#endif
