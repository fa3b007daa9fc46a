/* A model file's content as the FMU has it.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_MODELDATA_H
#define FMU_MODELDATA_H

#include "../lab/rig/rig.h"
#include "runtime/data.h"

/* Out:     data  its token made from the model, from the version of FMI and from what export-fmu carries: the same
 *                model gives the same token */
void fmu_data_of(const lab_rig *rig, int fmi, fmu_data *data);

#endif
