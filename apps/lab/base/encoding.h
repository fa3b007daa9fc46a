/* Texts that are not UTF-8.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_ENCODING_H
#define LAB_ENCODING_H

#include <stddef.h>

/* The name of the encoding, for lab_encode, of a text that is UTF-16 by its byte order mark or by every other byte of
 * its first two characters; NULL for any other. */
const char *lab_encoding_of(const char *text, size_t size);

/* A text in UTF-8.
 * In:      from  name of its encoding, as iconv has it
 * Out:     out   `room` bytes, with a 0 byte behind the text; what is no character is left out
 * Returns: bytes written without the 0; (size_t)-1 where this system does not know the encoding. */
size_t lab_encode(const char *from, const char *text, size_t size, char *out, size_t room);

/* Make a cell of a table UTF-8: where it is not, it is taken to be Windows-1252, as Excel writes in Western Europe.
 * Out:  out  `room` bytes, cut to them */
void lab_encode_cell(const char *text, char *out, size_t room);

#endif
