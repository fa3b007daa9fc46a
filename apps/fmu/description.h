/* The XML files of an FMU: modelDescription.xml in either version, and for FMI 3 those of build and icon.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_DESCRIPTION_H
#define FMU_DESCRIPTION_H

#include "variables.h"
#include "xml.h"

typedef struct fmu_description {
  int fmi; /* 2 or 3 */
  const char *name;
  const char *identifier; /* the name as C allows it */
  const fmu_data *data;
  const fmu_list *list;
} fmu_description;

/* modelDescription.xml */
void fmu_describe(fmu_xml *xml, const fmu_description *d);

/* sources/buildDescription.xml and terminalsAndIcons/terminalsAndIcons.xml of FMI 3. */
void fmu_describe_build(fmu_xml *xml, const fmu_description *d);
void fmu_describe_icon(fmu_xml *xml, const fmu_description *d);

#endif
