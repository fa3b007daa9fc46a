/* As much of cmocka as the core's tests use, for targets that have none: the same names and the same lines of output.
 * A test that fails leaves by longjmp.
 * SPDX-License-Identifier: MIT */
#ifndef FIRMWARE_CMOCKA_H
#define FIRMWARE_CMOCKA_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct CMUnitTest {
  const char *name;
  void (*test_func)(void **state);
  int (*setup_func)(void **state), (*teardown_func)(void **state); /* of no use here */
  void *initial_state;
};

enum { CMOCKA_PASSED, CMOCKA_FAILED, CMOCKA_SKIPPED, CMOCKA_OUTCOMES };

extern jmp_buf cmocka_end;

static inline void cmocka_leave(int outcome, const char *what, const char *file, int line)
{
  if (outcome == CMOCKA_FAILED)
    fprintf(stderr, "%s:%d: %s\n", file, line, what);
  longjmp(cmocka_end, outcome);
}

static inline void print_error(const char *format, ...)
{
  va_list list;
  va_start(list, format);
  vfprintf(stderr, format, list);
  va_end(list);
}

#define _fail(file, line) cmocka_leave(CMOCKA_FAILED, "failed", file, line)
#define skip()            cmocka_leave(CMOCKA_SKIPPED, "", __FILE__, __LINE__)
#define fail_msg(...)     (print_error(__VA_ARGS__), _fail(__FILE__, __LINE__))

#define assert_true(c)                    ((c) ? (void)0 : cmocka_leave(CMOCKA_FAILED, #c, __FILE__, __LINE__))
#define assert_false(c)                   assert_true(!(c))
#define assert_null(p)                    assert_true((p) == NULL)
#define assert_non_null(p)                assert_true((p) != NULL)
#define assert_ptr_equal(a, b)            assert_true((const void *)(a) == (const void *)(b))
#define assert_int_equal(a, b)            assert_true((long long)(a) == (long long)(b))
#define assert_int_not_equal(a, b)        assert_true((long long)(a) != (long long)(b))
#define assert_in_range(value, low, high) assert_true((value) >= (low) && (value) <= (high))
#define assert_string_equal(a, b)         assert_true(strcmp(a, b) == 0)
#define assert_string_not_equal(a, b)     assert_true(strcmp(a, b) != 0)
#define assert_memory_equal(a, b, n)      assert_true(memcmp(a, b, n) == 0)

int _cmocka_run_group_tests(const char *group, const struct CMUnitTest *test, size_t n, int (*setup)(void **state),
                            int (*teardown)(void **state));

#endif
