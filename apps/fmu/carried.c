#include "carried.h"

#include <string.h>

#include "apps/fmu/carried.inc"

const fmu_file *fmu_carried(int i)
{
  return i < (int)(sizeof files / sizeof files[0]) ? &files[i] : NULL;
}

const fmu_file *fmu_carried_find(const char *name)
{
  int i = 0;
  while (strcmp(files[i].name, name) != 0)
    i++;
  return &files[i];
}

int fmu_is_source(const fmu_file *file, int fmi)
{
  return strchr(file->name, '/') && !strstr(file->name, fmi == 2 ? "/fmi3" : "/fmi2");
}

int fmu_is_compiled(const fmu_file *file)
{
  const size_t length = strlen(file->name);
  return length > 2 && strcmp(file->name + length - 2, ".c") == 0;
}
