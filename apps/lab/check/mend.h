/* Values of a log that are no measurements: they become gaps, and a remark says so.
 *
 * Saturation. A value at the end of a converter's range shows by the noise that is missing: the largest (or smallest)
 * value comes back exactly, again and again, where the rest of the channel is noisy. A pressure without visible noise
 * that stops from one row to the next, under an open orifice, is taken as saturated too: a chamber settles slowly.
 * Spikes. A value far from its neighbours, two on either side, which agree. A peak of break-away has slopes.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_MEND_H
#define LAB_MEND_H

#include "../log/log.h"
#include "../base/remarks.h"
#include "../rig/rig.h"

/* Make gaps of what is no measurement, run by run.
 * In:      rig  its inputs: a channel that drives the model cannot have such gaps
 * In/out:  log
 *          remarks
 * Returns: LAB_OK; LAB_DATA if an input is saturated or hardly anything is left; LAB_WORLD. */
int lab_log_mend(const lab_rig *rig, lab_log *log, lab_remarks *remarks, lab_error *error);

#endif
