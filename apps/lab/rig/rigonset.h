/* What begins within a log: the group `onset` of a rig file.
 *
 *   onset = ( { parameter = "chamber_leak.leak_area"; from = "40.2 s"; value = "0.02 mm^2"; } );
 *
 * From that time of a log on the parameter has another value than the one declared for it; the names are those of
 * `fit`. The value of orifice_area is a factor on the areas declared. Later entries come later in time.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_RIGONSET_H
#define LAB_RIGONSET_H

#include <stdio.h>

#include <libconfig.h>

#include "rig.h"

/* Read the list.  Out: rig->onset  Returns: LAB_OK; LAB_DATA with file, line, key, what was expected and found. */
int lab_onsets_read(const config_setting_t *list, lab_rig *rig, lab_error *error);

/* Write the list, from which lab_onsets_read makes the same, bit for bit; nothing where there is none. */
void lab_onsets_write(FILE *file, const lab_rig *rig);

#endif
