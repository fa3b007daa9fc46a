/* Tests, and assertions on floating-point numbers: those of cmocka compare as float and let NaN pass.
 * Include before anything that needs cmocka.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

/* Every test of cmocka is handed a state, and hardly any uses it. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

/* A tolerance for each precision of the library under test. */
#ifdef PNEU_SINGLE
#define TOL(in_double, in_single) (in_single)
#else
#define TOL(in_double, in_single) (in_double)
#endif

/* Case under test, printed in front of a failure: check_note("b = %g", b). */
static char check_case[160];
#define check_note(...) ((void)snprintf(check_case, sizeof check_case, __VA_ARGS__))

/* ---- Tests, which join by themselves: TEST(test_what__how__what_comes_of_it) { ... } ---- */

enum { CHECK_TESTS = 200 };
void check_join(struct CMUnitTest test);

#define TEST(name) TEST_WITH(name, NULL, NULL)

/* The same with a set-up and a tear-down of its own. */
#define TEST_WITH(name, setup, teardown)                                                                               \
  static void name(void **state);                                                                                      \
  __attribute__((constructor)) static void name##_joins(void)                                                          \
  {                                                                                                                    \
    check_join((struct CMUnitTest){#name, name, setup, teardown, NULL});                                               \
  }                                                                                                                    \
  static void name(void **state)

/* Set-up and tear-down, or NULL, of all tests of a program together; of two the later counts. */
#define TESTS_WITH(setup, teardown)                                                                                    \
  __attribute__((constructor)) static void setup##_and_##teardown(void)                                                \
  {                                                                                                                    \
    check_around(setup, teardown);                                                                                     \
  }
void check_around(int (*setup)(void **state), int (*teardown)(void **state));

/* ---- Numbers ---- */

/* Whether |got - want| <= atol + rtol |want|, both finite. */
static inline int check_is_close(double got, double want, double atol, double rtol)
{
  return isfinite(got) && isfinite(want) && fabs(got - want) <= atol + rtol * fabs(want);
}

static inline void check_close(double got, double want, double atol, double rtol, const char *what, const char *file,
                               int line)
{
  if (check_is_close(got, want, atol, rtol))
    return;
  print_error("%s: %s = %.17g, want %.17g; apart by %.3g, allowed %.3g\n", check_case, what, got, want,
              fabs(got - want), atol + rtol * fabs(want));
  _fail(file, line);
}

static inline void check_between(double got, double lo, double hi, const char *what, const char *file, int line)
{
  if (got >= lo && got <= hi)
    return;
  print_error("%s: %s = %.17g is not within %.17g .. %.17g\n", check_case, what, got, lo, hi);
  _fail(file, line);
}

/* Fails on NaN and infinity as well; prints the numbers. */
#define assert_close(got, want, atol, rtol)                                                                            \
  check_close((double)(got), (double)(want), (double)(atol), (double)(rtol), #got, __FILE__, __LINE__)

/* Fails on NaN as well. */
#define assert_between(got, lo, hi) check_between((double)(got), (double)(lo), (double)(hi), #got, __FILE__, __LINE__)

#endif
