/* What libFuzzer calls. The environment variable FUZZ_TARGET names a row of fuzz_targets. */
#include "targets.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  static const fuzz_target *target;
  if (!target) {
    const char *name = getenv("FUZZ_TARGET");
    target = name ? fuzz_target_named(name, strlen(name)) : NULL;
  }
  if (!target)
    abort();
  target->read(data, size);
  return 0;
}
