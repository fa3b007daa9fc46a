/* How well declared values and instruments are known: the group `tolerance` of a rig file.
 *
 * A tolerance is a standard deviation: a share of the declared value, or a quantity; 0 is exact. The names, of
 * parameters, of the ratio of both orifices and of the instruments' errors, are those of pneu-rig(5). A share of a bias
 * is one of the span, for which supply and stroke stand. Without the group every value has the default of its kind
 * (tolerance.c). SPDX-License-Identifier: MIT */
#ifndef LAB_TOLERANCE_H
#define LAB_TOLERANCE_H

#include <libconfig.h>

#include "rig.h"

/* Read the group.  Out: rig->tolerance  Returns: LAB_OK, LAB_DATA with the nearest known key. */
int lab_tolerance_read(const config_setting_t *group, lab_rig *rig, lab_error *error);

/* The tolerance of a parameter, given or by default.  Returns: standard deviation, SI; 0: it is exact, or none is known
 */
double lab_tolerance(const lab_rig *rig, int param);

/* Whether a parameter is the share that the vent passes less beside the fill orifice. */
int lab_param_is_vents_share(int param);

/* Write the group, if the rig's file has one. */
void lab_tolerance_write(FILE *file, const lab_rig *rig);

/* Name of a parameter as the group has it: "spring_rate", "clock".  In: param  of the model  Returns: NULL: it has none
 */
const char *lab_tolerance_name(int param);

#endif
