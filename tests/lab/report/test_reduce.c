/* apps/lab/report/reduce: series made fit to look at. */
#include "../../check.h"

#include "../../../apps/lab/report/reduce.h"

TEST(test_lab_envelope__a_spike__is_kept)
{
  enum { N = 1000, COLUMNS = 10 };
  static double at[N], value[N];
  const size_t first[] = {0};
  const lab_line line = {N, at, value, 1, first};
  lab_point point[3 * COLUMNS + 1];
  size_t i, n;
  double highest = -1;
  for (i = 0; i < N; i++) {
    at[i] = (double)i;
    value[i] = 0.001 * (double)i;
  }
  value[347] = 50;
  n = lab_envelope(&line, COLUMNS, point);
  assert_int_equal(n, 2 * COLUMNS);
  for (i = 0; i < n; i++)
    highest = fmax(highest, point[i].value);
  assert_close(highest, 50, 0, 0);
  for (i = 1; i < n; i++)
    assert_true(point[i].at > point[i - 1].at);
  assert_close(point[0].value, 0, 0, 0);
  assert_close(point[n - 1].value, 0.999, 0, 1e-15);
}

/* A gap of many rows breaks the line, one of a row or two does not. */
TEST(test_lab_envelope__runs_and_gaps__break_the_line)
{
  enum { ROWS = 40 };
  double at[ROWS], value[ROWS];
  const size_t first[] = {0, 35};
  const lab_line line = {ROWS, at, value, 2, first};
  lab_point point[3 * ROWS + 2];
  size_t i, n, breaks = 0;
  for (i = 0; i < ROWS; i++) {
    at[i] = (double)i;
    value[i] = i == 5 || (i >= 10 && i < 30) ? (double)NAN : 1;
  }
  n = lab_envelope(&line, ROWS, point);
  for (i = 0; i < n; i++)
    breaks += isnan(point[i].value);
  assert_int_equal(n, 19 + 2);
  assert_int_equal(breaks, 2);
  assert_true(isnan(point[9].value) && isnan(point[15].value));
  assert_int_equal(point[8].row, 9);
  assert_int_equal(point[10].row, 30);
}

/* A channel that is measured now and then, as read off a figure, is a line. */
TEST(test_lab_envelope__few_values__are_joined)
{
  enum { ROWS = 40 };
  double at[ROWS], value[ROWS];
  const size_t first[] = {0};
  const lab_line line = {ROWS, at, value, 1, first};
  lab_point point[3 * ROWS + 1];
  size_t i, n;
  for (i = 0; i < ROWS; i++) {
    at[i] = (double)i;
    value[i] = i % 5 ? (double)NAN : 1;
  }
  n = lab_envelope(&line, ROWS, point);
  assert_int_equal(n, 8);
  for (i = 0; i < n; i++)
    assert_false(isnan(point[i].value));
}

TEST(test_lab_bin_means__values__mean_of_each_part)
{
  const double at[] = {0, 0.5, 1, 1.5, 2, (double)NAN}, value[] = {1, 3, 5, (double)NAN, 7, 9};
  lab_bin bin[2];
  lab_bin_means(at, value, 6, 0, 2, 2, bin);
  assert_int_equal(bin[0].n, 2);
  assert_close(bin[0].mean, 2, 1e-15, 0);
  assert_int_equal(bin[1].n, 2);
  assert_close(bin[1].mean, 6, 1e-15, 0);
}
