/* A model file's content as it goes into the FMU: as bytes for the binary, as a header for the sources.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_MODELDATA_H
#define FMU_MODELDATA_H

#include "../lab/rig/rig.h"
#include "runtime/data.h"

/* Out:     data  its token made from the model, from the version of FMI and from what export-fmu carries: the same
 *                model gives the same token */
void fmu_data_of(const lab_rig *rig, int fmi, fmu_data *data);

/* The header model_data.h.  Out: text  to be freed.  Returns: LAB_OK, LAB_WORLD. */
int fmu_data_header(const lab_rig *rig, const fmu_data *data, char **text, size_t *size, lab_error *error);

/* The shared library of a version of FMI with the data in their place.  Out: bytes  to be freed */
int fmu_data_binary(const fmu_data *data, int fmi, unsigned char **bytes, size_t *size, lab_error *error);

#endif
