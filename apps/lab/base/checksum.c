#include "checksum.h"

#include <stdio.h>
#include <string.h>

#include "../../../lib/pneu.h"
#include "text.h"

#ifndef LAB_BUILD
#define LAB_BUILD PNEU_VERSION
#endif

uint64_t lab_checksum(uint64_t sum, const void *data, size_t size)
{
  const unsigned char *byte = data;
  for (; size; size--)
    sum = (sum ^ *byte++) * UINT64_C(1099511628211);
  return sum;
}

uint64_t lab_checksum_text(uint64_t sum, const char *text)
{
  return lab_checksum(sum, text, strlen(text) + 1);
}

uint64_t lab_checksum_file(uint64_t sum, const char *path)
{
  unsigned char block[4096];
  lab_error ignored;
  size_t n;
  FILE *file = lab_text_open(path, &ignored);
  if (!file)
    return sum;
  while ((n = fread(block, 1, sizeof block, file)) > 0)
    sum = lab_checksum(sum, block, n);
  fclose(file);
  return sum;
}

const char *lab_build(void)
{
  return LAB_BUILD;
}
