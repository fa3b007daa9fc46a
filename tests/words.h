/* Assertions on what calls of the lab say, and on messages.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_WORDS_H
#define TESTS_WORDS_H

#include <string.h>

#include "../apps/lab/base/message.h"
#include "check.h"

static lab_error error; /* of the call made last */

/* Fail unless a call of the lab returns LAB_OK; prints its message. */
#define succeed(call) check_success((call), __FILE__, __LINE__)

static inline void check_success(int status, const char *file, int line)
{
  if (status == LAB_OK)
    return;
  print_error("%s\n", error.text);
  _fail(file, line);
}

/* Fail unless a call of the lab returns a status, and says some words. */
#define assert_fails(call, status, words) check_failure((call), (status), (words), __FILE__, __LINE__)

static inline void check_failure(int status, int wanted, const char *words, const char *file, int line)
{
  if (status == wanted && strstr(error.text, words))
    return;
  print_error("status %d, \"%s\"; want %d, \"%s\"\n", status, error.text, wanted, words);
  _fail(file, line);
}

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
