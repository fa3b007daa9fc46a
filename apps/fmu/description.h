/* The XML files of an FMU: modelDescription.xml in either version, and for FMI 3 that of the build.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_DESCRIPTION_H
#define FMU_DESCRIPTION_H

#include "../lab/rig/rig.h"
#include "variables.h"

/* What an FMU is made from. */
typedef struct fmu_description {
  int fmi; /* 2 or 3 */
  const lab_rig *rig;
  char identifier[LAB_NAME_TEXT + 1]; /* its name as C allows it */
  fmu_data data;
  fmu_list list;
} fmu_description;

/* Write modelDescription.xml, and of FMI 3 sources/buildDescription.xml.
 * Returns: LAB_OK, LAB_WORLD. */
int fmu_describe(FILE *file, const fmu_description *d, lab_error *error);
int fmu_describe_build(FILE *file, const fmu_description *d, lab_error *error);

#endif
