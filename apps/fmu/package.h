/* A zip archive in memory, by libzip; the same files give the same bytes, because none has a date.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_PACKAGE_H
#define FMU_PACKAGE_H

#include <zip.h>

#include "../lab/base/message.h"

typedef struct fmu_package {
  zip_source_t *source; /* the archive */
  zip_t *zip;
} fmu_package;

/* Begin; to be ended by fmu_package_write, or fmu_package_drop after an error.  Returns: LAB_OK, LAB_WORLD. */
int fmu_package_begin(fmu_package *package, lab_error *error);

/* Add a file.  In: bytes  copied.  Returns: LAB_OK, LAB_WORLD. */
int fmu_package_add(fmu_package *package, const char *name, const void *bytes, size_t size, lab_error *error);

/* Put the archive into a file, whole or not at all.  Returns: LAB_OK, LAB_WORLD. */
int fmu_package_write(fmu_package *package, const char *path, lab_error *error);

void fmu_package_drop(fmu_package *package);

#endif
