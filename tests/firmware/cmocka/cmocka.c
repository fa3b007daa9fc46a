#include "cmocka.h"

jmp_buf cmocka_end;

static int cmocka_run_one(const struct CMUnitTest *test)
{
  static const char *const words[CMOCKA_OUTCOMES] = {"      OK", " FAILED ", " SKIPPED"};
  void *state = test->initial_state;
  const int outcome = setjmp(cmocka_end);
  if (outcome == CMOCKA_PASSED)
    test->test_func(&state);
  printf("[ %s ] %s\n", words[outcome], test->name);
  return outcome;
}

int _cmocka_run_group_tests(const char *group, const struct CMUnitTest *test, size_t n, int (*setup)(void **state),
                            int (*teardown)(void **state))
{
  int count[CMOCKA_OUTCOMES] = {0};
  size_t i;
  (void)group;
  for (i = 0; setup == teardown && i < n; i++)
    count[cmocka_run_one(&test[i])]++;
  printf("[  PASSED  ] %d test(s).\n", count[CMOCKA_PASSED]);
  if (count[CMOCKA_SKIPPED])
    printf("[  SKIPPED ] %d test(s).\n", count[CMOCKA_SKIPPED]);
  if (count[CMOCKA_FAILED])
    printf("[  FAILED  ] %d test(s).\n", count[CMOCKA_FAILED]);
  return count[CMOCKA_FAILED] + (count[CMOCKA_PASSED] == 0);
}
