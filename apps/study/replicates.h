/* What a bench repeats: the scatter of runs under equal commands, from the raw logs alone. No model of the bench can
 * err by less, whatever it contains. SPDX-License-Identifier: MIT */
#ifndef STUDY_REPLICATES_H
#define STUDY_REPLICATES_H

#include <libconfig.h>

#include "../lab/base/message.h"

/* Repeatability of the judged channel of a set: the root mean square of the differences of paired runs over the root of
 * two, runs aligned in time. What is proportional to differences of a measured input (p, x, ps, force) is taken out of
 * them: a model follows those. Where a log is the mean over its runs, it is that of the mean.
 *
 * Which runs are replicates is the list `replicates` of the set, groups of
 *     logs     paths below its folder
 *     steps    a channel ("p"): a run begins where it crosses the middle of its range; up and down are paired apart
 *     strokes  a channel ("x"): a run is a way through the middle eight tenths of its range, aligned in the middle. It
 *              leaves out the turns, where small differences of time are large ones of force.
 * Without steps and strokes runs are those of the logs, by their own time. A set without the list pairs the runs within
 * each of its logs.
 *
 * In:      set       a group of sets.cfg
 *          rig       path of its rig file
 *          data_dir  folder of the data
 * Out:     repeat    SI; NaN if no two runs are replicates
 * Returns: LAB_OK; LAB_DATA; LAB_WORLD. */
int replicates_repeat(const config_setting_t *set, const char *rig, const char *data_dir, double *repeat,
                      lab_error *error);

#endif
