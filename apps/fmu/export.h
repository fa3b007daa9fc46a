/* An FMU from a model file.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_EXPORT_FILE_H
#define FMU_EXPORT_FILE_H

#include "../lab/rig/rig.h"

/* Write the FMU of a rig.
 * In:      fmi   2 or 3
 *          path  NULL: the rig's name, as C allows it, and .fmu
 * Returns: LAB_OK; LAB_DATA for a model that cannot be one; LAB_WORLD. */
int fmu_export(const lab_rig *rig, int fmi, const char *path, lab_error *error);

#endif
