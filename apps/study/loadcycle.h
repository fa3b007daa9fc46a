/* The work that a loaded actuator does in a cycle, by simulation.
 * SPDX-License-Identifier: MIT */
#ifndef STUDY_LOADCYCLE_H
#define STUDY_LOADCYCLE_H

#include "../../lib/pneu.h"
#include "../lab/base/message.h"

typedef struct load_cycle {
  double work_up;   /* [J] on the load while the stem rises */
  double work_down; /* [J] while it falls */
  double air;       /* [kg] taken from the supply, filled to it at the end of the travel */
} load_cycle;

/* Rise and fall against a load that, with the spring, always holds the stem back by a little less than the air (up)
 * or pushes against it by a little less than the spring (down): the load is set anew every 20 ms, as a dynamometer
 * would, from the position at that moment. Filling ends at supply pressure.
 * In:      margin  force left to move the stem, over supply pressure times area
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC (also where the stem does not get through). */
int load_cycle_run(const pneu_params *params, const pneu_laws *law, double margin, load_cycle *out, lab_error *error);

#endif
