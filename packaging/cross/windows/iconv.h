/* iconv from UTF-16LE, UTF-16BE and WINDOWS-1252 to UTF-8.
 * SPDX-License-Identifier: MIT */
#ifndef WINDOWS_ICONV_H
#define WINDOWS_ICONV_H

#include <stddef.h>

typedef const struct windows_encoding *iconv_t;

/* Errors: (iconv_t)-1 for any other pair */
iconv_t iconv_open(const char *to, const char *from);

/* As POSIX has it, with errno EILSEQ, EINVAL or E2BIG; there is no state to set back. */
size_t iconv(iconv_t converter, char **in, size_t *size, char **out, size_t *room);

int iconv_close(iconv_t converter);

#endif
