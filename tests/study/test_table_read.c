/* apps/study/table: tables of results read again */
#include "../scratch.h"

#include "../../apps/study/study.h"

static void assert_refused(const char *text, const char *words)
{
  table t;
  assert_fails(table_load_file(scratch_text("t.csv", text), &t, &error), LAB_DATA, "t.csv");
  assert_contains(error.text, words);
  table_close(&t);
}

TEST(test_table_load_file__quotes_and_numbers__are_read)
{
  table t;
  succeed(table_load_file(scratch_text("t.csv", "name,value [m],note\n\"a, \"\"b\"\"\",1.5,x\nc,,y\n"), &t, &error));
  assert_int_equal(table_rows(&t), 2);
  assert_string_equal(table_text(&t, 0, "name"), "a, \"b\"");
  assert_close(table_number(&t, 0, "value"), 1.5, 0, 0);
  assert_true(isnan(table_number(&t, 1, "value")));
  assert_string_equal(table_text(&t, 1, "note"), "y");
  table_close(&t);
}

TEST(test_table_load_file__column_that_is_missing__is_empty)
{
  table t;
  succeed(table_load_file(scratch_text("t.csv", "name,value\na,1\n"), &t, &error));
  assert_int_equal(table_column(&t, "val"), -1);
  assert_string_equal(table_text(&t, 0, "val"), "");
  assert_true(isnan(table_number(&t, 0, "val")));
  table_close(&t);
}

TEST(test_table_load_file__row_of_other_length__is_refused)
{
  assert_refused("a,b\n1,2\n1\n", "t.csv:3: expected 2 fields");
  assert_refused("a,b\n1,2,3\n", "t.csv:2: expected 2 fields");
}

TEST(test_table_load_file__no_file__is_refused)
{
  table t;
  assert_fails(table_load_file(scratch_path("nothere.csv"), &t, &error), LAB_DATA, "there is no such file");
  table_close(&t);
}

TEST(test_table_load__results_folder__is_where_it_looks)
{
  static study s;
  table t;
  scratch_text("t.csv", "a\n7\n");
  snprintf(s.results, sizeof s.results, "%s", scratch_folder);
  succeed(table_load(&s, "t.csv", &t, &error));
  assert_close(table_number(&t, 0, "a"), 7, 0, 0);
  table_close(&t);
}
