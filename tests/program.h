/* The programs that a test starts: those of its own build, PROGRAMS being their folder.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_PROGRAM_H
#define TESTS_PROGRAM_H

#include <stdio.h>

#include "check.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define TEST_IS_SANITIZED 1
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define TEST_IS_SANITIZED 1
#endif
#ifndef TEST_IS_SANITIZED
#define TEST_IS_SANITIZED 0
#endif

/* A program that checks its memory has the address sanitizer's beginning among its names; a test that does starts no
 * other, and one that does not starts none of these. */
static inline void assert_sanitized_as_its_test(const char *path)
{
  static const char name[] = "__asan_init";
  FILE *file = fopen(path, "rb");
  size_t matched = 0;
  int c;
  assert_non_null(file);
  while (matched < sizeof name && (c = getc(file)) != EOF)
    matched = c == name[matched] ? matched + 1 : c == name[0];
  fclose(file);
  assert_int_equal(matched == sizeof name, TEST_IS_SANITIZED);
}

#endif
