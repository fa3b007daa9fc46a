/* Figures of merit for people and for programs.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_METRICSTEXT_H
#define LAB_METRICSTEXT_H

#include <stdio.h>

#include <cjson/cJSON.h>

#include "metrics.h"

enum { LAB_METRIC_SHOWN = 64 };

/* "0.842", "<= 0.21", "-"
 * Returns: text */
const char *lab_metric_value(const lab_metric *metric, char text[LAB_METRIC_SHOWN]);

/* Write a table of all figures, and of the steps. */
void lab_metrics_print(FILE *file, const lab_metrics *metrics);

/* { "<key>": { "value":, "unit":, "uncertainty":, "at_most":, "standard":, "basis": }, ... }, or
 * { "<key>": { "value": null, "unit":, "reason": } } */
cJSON *lab_metrics_object(const lab_metrics *metrics);

/* Write an object with the signals, the figures and the steps.  Returns: LAB_OK, LAB_WORLD. */
int lab_metrics_json(FILE *file, const lab_metrics *metrics, lab_error *error);

#endif
