/* Values of a log that stand alone: neither the model nor their neighbours know of them.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_OUTLIERS_H
#define LAB_OUTLIERS_H

#include "../base/limitations.h"
#include "unknowns.h"

typedef struct lab_outlier {
  double *place, value;
} lab_outlier;

/* What was taken out; all 0 at first. */
typedef struct lab_outliers {
  size_t n, n_soon; /* all; those within five rows after a change of command */
  lab_outlier *taken;
  lab_limitations limitations; /* how many, and where the first is, for each channel of each run */
} lab_outliers;

/* Make gaps of values whose error is more than seven times the noise away from that of their neighbours, two on
 * either side, of which three agree. The error is that of the present model, so that strokes and corners which it
 * knows do not count; nor does a peak that is the model's rather than the log's. More than a fiftieth of a channel
 * is no accident, and stays. In a log with few rows a stroke, what lasts a row may be real: see that the model
 * explains all the rest.
 * In:      u    fitted; lab_unknowns_view counts its values anew
 * In/out:  log  those that the experiments of u belong to
 *          out  goes on from what it has; to be freed, also after an error
 * Returns: as lab_unknowns_errors. */
int lab_outliers_take(const lab_unknowns *u, lab_log *log, lab_outliers *out, lab_error *error);

/* Put all back where it was. The log must still be there. */
void lab_outliers_put_back(lab_outliers *out);
void lab_outliers_free(lab_outliers *out);

#endif
