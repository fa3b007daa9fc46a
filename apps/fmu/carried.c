#include "carried.h"

#include <string.h>

#include "apps/fmu/carried.inc"

const fmu_file *fmu_carried(const char *name)
{
  const fmu_file *file = fmu_files;
  while (file->name && strcmp(file->name, name) != 0)
    file++;
  return file->name ? file : NULL;
}

int fmu_is_source(const fmu_file *file, int fmi)
{
  return strchr(file->name, '/') && !strstr(file->name, fmi == 2 ? "/fmi3" : "/fmi2");
}
