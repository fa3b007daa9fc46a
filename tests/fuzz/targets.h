/* The readers of files as a fuzzer sees them: any bytes may come, and what is promised must hold.
 *
 * A target reads the bytes as a file of its kind and ends the program where a promise of the reader is broken; the
 * sanitizers see the rest. Bytes of a log may have the text of a rig file in front, with a line "%%" between the two.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_FUZZ_TARGETS_H
#define TESTS_FUZZ_TARGETS_H

#include <stddef.h>
#include <stdint.h>

typedef struct fuzz_target {
  const char *name;
  void (*read)(const uint8_t *data, size_t size);
} fuzz_target;

enum { FUZZ_TARGETS = 4 };

extern const fuzz_target fuzz_targets[FUZZ_TARGETS];

/* The target of that name, NULL if there is none. `length` bytes of the name count. */
const fuzz_target *fuzz_target_named(const char *name, size_t length);

#endif
