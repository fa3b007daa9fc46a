/* apps/lab/base/names */
#include "../../words.h"

#include "../../../apps/lab/base/names.h"

static const struct row {
  const char *name;
  int other;
} rows[] = {{"area", 1}, {"dead_volume", 2}, {"spring_rate", 3}, {"spring_preload", 4}};
enum { ROWS = sizeof rows / sizeof rows[0] };

TEST(test_lab_name_distance__known_pairs__counts_edits)
{
  assert_int_equal(lab_name_distance("kitten", "sitting"), 3);
  assert_int_equal(lab_name_distance("", "abc"), 3);
  assert_int_equal(lab_name_distance("abc", ""), 3);
  assert_int_equal(lab_name_distance("abc", "abc"), 0);
}

TEST(test_lab_name_distance__swapped_letters__is_one)
{
  assert_int_equal(lab_name_distance("aera", "area"), 1);
}

TEST(test_lab_name_distance__other_case__is_zero)
{
  assert_int_equal(lab_name_distance("Area", "aREA"), 0);
}

TEST(test_lab_name_distance__very_long_names__stays_inside)
{
  char a[400], b[400];
  memset(a, 'a', sizeof a - 1);
  memset(b, 'b', sizeof b - 1);
  a[sizeof a - 1] = b[sizeof b - 1] = '\0';
  assert_int_equal(lab_name_distance(a, b), 63);
}

TEST(test_lab_name_nearest__typing_error__finds_the_name)
{
  assert_string_equal(lab_name_nearest("spring_rat", rows, ROWS, sizeof rows[0]), "spring_rate");
  assert_string_equal(lab_name_nearest("deadvolume", rows, ROWS, sizeof rows[0]), "dead_volume");
}

TEST(test_lab_name_nearest__empty_table__is_empty)
{
  assert_string_equal(lab_name_nearest("x", rows, 0, sizeof rows[0]), "");
}

TEST(test_lab_name_index__exact_name__is_its_row)
{
  assert_int_equal(lab_name_index("spring_rate", rows, ROWS, sizeof rows[0]), 2);
  assert_int_equal(lab_name_index("Spring_rate", rows, ROWS, sizeof rows[0]), -1);
}
