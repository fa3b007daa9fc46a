/* Checksums that tell whether something has changed: FNV-1a, 64 bits.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_CHECKSUM_H
#define LAB_CHECKSUM_H

#include <stddef.h>
#include <stdint.h>

#define LAB_CHECKSUM_SEED UINT64_C(14695981039346656037)

/* Go on from `sum` over bytes; start with LAB_CHECKSUM_SEED. */
uint64_t lab_checksum(uint64_t sum, const void *data, size_t size);

/* The same over a text and its end, so that "ab","c" is not "a","bc". */
uint64_t lab_checksum_text(uint64_t sum, const char *text);

/* The same over a file's content; a missing file counts as empty. */
uint64_t lab_checksum_file(uint64_t sum, const char *path);

/* Checksum of the sources that this program was built from, as text. */
const char *lab_build(void);

#endif
