/* Stored logs of two rigs, for the demonstration.
 * SPDX-License-Identifier: MIT */
#ifndef FIRMWARE_RIG_LOGS_H
#define FIRMWARE_RIG_LOGS_H

#include "pneu.h"

typedef struct rig_row {
  short t; /* [ms] */
  short u; /* command, held until the next row */
  short p; /* [20 Pa] gauge, as measured */
  short x; /* [um] as measured */
} rig_row;

typedef struct rig_log {
  const char *name;
  int flow; /* enum pneu_flow_law */
  const rig_row *row;
  int n;
  /* what a fit to a healthy log has given */
  pneu_real spring_rate, spring_preload, dry_friction, viscous, orifice;
} rig_log;

extern const rig_log rig_log_healthy, rig_log_leak;

#endif
