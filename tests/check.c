/* What every test program runs. */
#include "check.h"

static struct CMUnitTest tests[CHECK_TESTS];
static int n;
static int (*before)(void **state), (*after)(void **state);

void check_join(struct CMUnitTest test)
{
  if (n == CHECK_TESTS)
    abort();
  tests[n++] = test;
}

void check_around(int (*setup)(void **state), int (*teardown)(void **state))
{
  before = setup;
  after = teardown;
}

int main(void)
{
  if (n == 0)
    abort(); /* what has no test must not pass */
  return _cmocka_run_group_tests("tests", tests, (size_t)n, before, after);
}
