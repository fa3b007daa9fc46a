#include "../../apps/study/table.h"
#include "../words.h"

/* what the table writes, in `text` */
static void written(const table *t, char *text, size_t size)
{
  size_t n;
  FILE *file = tmpfile();
  assert_non_null(file);
  succeed(table_write(t, file, &error));
  rewind(file);
  n = fread(text, 1, size - 1, file);
  text[n] = '\0';
  fclose(file);
}

TEST(test_table_write__numbers_and_text__rows_in_order)
{
  char text[256];
  table t;
  table_open(&t, "flow,p [kPa],x [mm]");
  table_row(&t, "sgg", "paper", 1.5, -2.0);
  table_row(&t, "sgg", "choked", 1.0 / 3.0, 1e-12);
  written(&t, text, sizeof text);
  assert_string_equal(text, "flow,p [kPa],x [mm]\npaper,1.5,-2\nchoked,0.333333333,1e-12\n");
  table_close(&t);
}

TEST(test_table_write__commas_quotes_breaks__quoted)
{
  char text[256];
  table t;
  table_open(&t, "a,b,c");
  table_row(&t, "sss", "one, two", "say \"x\"", "line\nbreak");
  written(&t, text, sizeof text);
  assert_string_equal(text, "a,b,c\n\"one, two\",\"say \"\"x\"\"\",\"line break\"\n");
  table_close(&t);
}

TEST(test_table_write__nan_infinity_negative_zero__empty_inf_zero)
{
  char text[256];
  table t;
  table_open(&t, "a,b,c,d");
  table_row(&t, "gggs", (double)NAN, (double)INFINITY, -0.0, (const char *)NULL);
  written(&t, text, sizeof text);
  assert_string_equal(text, "a,b,c,d\n,inf,0,\n");
  table_close(&t);
}

TEST(test_table_row__many_rows__all_kept)
{
  table t;
  int i;
  table_open(&t, "i,name");
  for (i = 0; i < 1000; i++)
    table_row(&t, "gs", (double)i, i % 2 ? "odd" : "even");
  assert_int_equal(table_rows(&t), 1000);
  for (i = 0; i < 1000; i++) {
    assert_close(table_at(&t, (size_t)i, 0)->number, i, 0, 0);
    assert_string_equal(table_at(&t, (size_t)i, 1)->text, i % 2 ? "odd" : "even");
  }
  table_close(&t);
}

TEST(test_table_row__text_given__copied)
{
  char name[] = "before";
  table t;
  table_open(&t, "name");
  table_row(&t, "s", name);
  strcpy(name, "after");
  assert_string_equal(table_at(&t, 0, 0)->text, "before");
  table_close(&t);
}

TEST(test_table_write__file_refuses__world_error)
{
  table t;
  FILE *file = fopen("/dev/null", "r"); /* open for reading only */
  assert_non_null(file);
  table_open(&t, "a");
  assert_fails(table_write(&t, file, &error), LAB_WORLD, "cannot write");
  fclose(file);
  table_close(&t);
}

TEST(test_table_write__memory_ran_out__world_error)
{
  table t;
  table_open(&t, "a");
  t.failed = 1;
  table_row(&t, "g", 1.0);
  assert_int_equal(table_rows(&t), 0);
  assert_int_equal(table_write(&t, stdout, &error), LAB_WORLD);
  table_close(&t);
}
