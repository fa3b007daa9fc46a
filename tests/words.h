/* Assertions on messages.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_WORDS_H
#define TESTS_WORDS_H

#include <string.h>

#include "check.h"

/* Fail unless a call of the lab returns LAB_OK; prints the message of `error`. */
#define succeed(call)                                                                                                  \
  do {                                                                                                                 \
    if ((call) != LAB_OK)                                                                                              \
      fail_msg("%s", error.text);                                                                                      \
  } while (0)

/* Fail unless `text` contains `part`; prints both. */
#define assert_contains(text, part) check_contains((text), (part), __FILE__, __LINE__)

static inline void check_contains(const char *text, const char *part, const char *file, int line)
{
  if (strstr(text, part))
    return;
  print_error("\"%s\" is not in \"%s\"\n", part, text);
  _fail(file, line);
}

#endif
