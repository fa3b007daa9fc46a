/* Files that export-fmu carries inside: all of an FMU that does not depend on the model.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_CARRIED_H
#define FMU_CARRIED_H

#include <stddef.h>

typedef struct fmu_file {
  const char *name; /* sources: as in the repository */
  const unsigned char *bytes;
  size_t size;
} fmu_file;

extern const fmu_file fmu_files[]; /* the last one has no name */

/* By name.  Returns: NULL, export-fmu was built without it */
const fmu_file *fmu_carried(const char *name);

/* Whether it is a source of an FMU of that version of FMI. */
int fmu_is_source(const fmu_file *file, int fmi);

#endif
