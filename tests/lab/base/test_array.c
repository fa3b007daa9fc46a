/* Products of columns: against plain loops, for every number of columns that go together or are left over. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/base/array.h"

enum { N = 37, STRIDE = 40, COLUMNS = 11 };

static double a[N], b[COLUMNS * STRIDE];

static void fill(uint64_t seed)
{
  int i;
  for (i = 0; i < N; i++)
    a[i] = fixture_normal(&seed);
  for (i = 0; i < COLUMNS * STRIDE; i++)
    b[i] = fixture_normal(&seed);
}

static double product(const double *x, const double *y)
{
  double sum = 0;
  int i;
  for (i = 0; i < N; i++)
    sum += x[i] * y[i];
  return sum;
}

TEST(test_lab_dots__any_number_of_columns__are_added_to_what_is_there)
{
  int columns, k;
  fill(1);
  for (columns = 0; columns <= COLUMNS; columns++) {
    double sum[COLUMNS + 1];
    for (k = 0; k <= COLUMNS; k++)
      sum[k] = k;
    lab_dots(a, b, STRIDE, columns, N, sum);
    for (k = 0; k <= COLUMNS; k++) {
      check_note("column %d of %d", k, columns);
      assert_close(sum[k], k + (k < columns ? product(a, b + k * STRIDE) : 0), 1e-12, 0);
    }
  }
}

/* What is left has nothing of the columns, and what was taken has nothing else: Pythagoras. */
TEST(test_lab_project_out__any_number_of_columns__nothing_of_them_is_left)
{
  int columns, i, k;
  fill(2);
  for (columns = 0; columns < COLUMNS; columns++) {
    double v[N], taken = 0, left;
    const double length = lab_project_out(b, columns, STRIDE, N, b + columns * STRIDE);
    for (i = 0; i < N; i++)
      b[columns * STRIDE + i] /= length;
    memcpy(v, a, sizeof v);
    left = lab_project_out(b, columns + 1, STRIDE, N, v);
    for (k = 0; k <= columns; k++) {
      check_note("column %d of %d", k, columns + 1);
      assert_close(product(v, b + k * STRIDE), 0, 1e-14, 0);
      taken += pow(product(a, b + k * STRIDE), 2);
    }
    assert_close(left * left, product(a, a) - taken, 1e-12, 0);
    assert_close(left, sqrt(product(v, v)), 1e-14, 0);
  }
}
