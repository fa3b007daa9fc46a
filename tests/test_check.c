/* The assertions of the tests themselves. */
#include "check.h"

TEST(test_check_is_close__nan_or_infinity__is_refused)
{
  assert_false(check_is_close(NAN, 1, 1, 1));
  assert_false(check_is_close(1, NAN, 1, 1));
  assert_false(check_is_close(1, 1, NAN, 0));
  assert_false(check_is_close(INFINITY, INFINITY, 1, 1));
}

TEST(test_check_is_close__at_the_tolerance__is_accepted_and_beyond_refused)
{
  assert_true(check_is_close(1.5, 1, 0.5, 0));
  assert_true(check_is_close(3, 2, 0, 0.5));
  assert_false(check_is_close(1.75, 1, 0.5, 0));
  assert_false(check_is_close(-1, 1, 0, 0.5));
}
