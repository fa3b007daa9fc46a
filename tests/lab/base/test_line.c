/* A weighted straight line: closed forms, and how often its intervals hold. */
#include "../../fixture.h"

#include "../../../apps/lab/base/line.h"

static const double normal = 1.959963984540054; /* of 95 % */

static lab_line line_of(const double (*point)[3], int n)
{
  lab_line line = {0};
  int i;
  for (i = 0; i < n; i++)
    lab_line_add(&line, point[i][0], point[i][1], point[i][2]);
  return line;
}

/* Weights 1, 4, 1 and 4 about the mean 20001.5, where the days of a date are: sums by hand. */
static const double weighted[][3] = {{20000, 2, 1}, {20001, 3, 0.5}, {20002, 3, 1}, {20003, 4, 0.5}};

TEST(test_lab_line__weights__closed_form)
{
  const lab_line line = line_of(weighted, 4);
  /* sums of w, w x, w y about 20000 and 3: 10, 18, 3; xx = 44 - 32.4 = 11.6; xy = 12 - 5.4 = 6.6 */
  assert_true(lab_line_is_there(&line));
  assert_close(lab_line_slope(&line), 6.6 / 11.6, 0, 1e-12);
  assert_close(lab_line_value(&line, 20001.8), 3.3, 0, 1e-12);
  /* yy = 5 - 0.9 = 4.1; chi2 = 4.1 - 6.6^2/11.6 */
  assert_close(lab_line_scatter(&line), sqrt((4.1 - 6.6 * 6.6 / 11.6) / 2), 0, 1e-9);
  assert_close(lab_line_half(&line, 0.05),
               normal / sqrt(11.6) * fmax(1, 4.302652729749464 * lab_line_scatter(&line) / normal), 0, 1e-9);
}

/* Values on the line: their deviations alone count; ten times further off than these: the scatter does. */
TEST(test_lab_line__scatter__widens_the_interval_only_beyond_the_deviations)
{
  const double on[][3] = {{0, 1, 0.1}, {1, 2, 0.1}, {2, 3, 0.1}};
  const double off[][3] = {{0, 1, 0.1}, {1, 5, 0.1}, {2, 3, 0.1}};
  const lab_line small = line_of(on, 3), large = line_of(off, 3);
  assert_close(lab_line_half(&small, 0.05), normal * 0.1 / sqrt(2), 0, 1e-12);
  /* residuals -1, 2, -1: chi2 = 6/0.01 with one degree of freedom, of which t is 12.706 */
  assert_close(lab_line_half(&large, 0.05), 12.706204736432095 * sqrt(6) / sqrt(2), 0, 1e-9);
}

TEST(test_lab_line__two_points__show_no_scatter)
{
  const double two[][3] = {{10, 1, 0.3}, {20, 2, 0.4}};
  const lab_line line = line_of(two, 2);
  assert_close(lab_line_slope(&line), 0.1, 0, 1e-14);
  assert_close(lab_line_half(&line, 0.05), normal * 0.5 / 10, 0, 1e-12);
  assert_close(lab_line_scatter(&line), 0, 0, 1e-12);
}

TEST(test_lab_line__one_place__has_no_slope)
{
  const double one[][3] = {{20000.3, 1, 1}, {20000.3, 2, 0.7}, {20000.3, 4, 0.1}};
  const lab_line line = line_of(one, 3);
  assert_false(lab_line_is_there(&line));
}

/* At the ends, the value lies on the edge of the band about the line; where the slope may be 0, there is no end. */
TEST(test_lab_line__reaches__ends_where_the_band_does)
{
  const lab_line line = line_of(weighted, 4);
  double at[3];
  int i;
  assert_true(lab_line_reaches(&line, 6, 0.2, at));
  assert_close(lab_line_value(&line, at[0]), 6, 0, 1e-9);
  assert_true(at[1] < at[0] && at[0] < at[2]);
  for (i = 1; i < 3; i++) {
    const double half = lab_line_half(&line, 0.2) * sqrt(11.6) * sqrt(0.1 + pow(at[i] - 20001.8, 2) / 11.6);
    assert_close(fabs(lab_line_value(&line, at[i]) - 6), half, 0, 1e-6);
  }
  assert_false(lab_line_reaches(&line, 6, 1e-4, at));
}

/* Deviations that tell all, and such that tell a third: in either case 95 of 100 intervals hold. */
TEST(test_lab_line__half__holds_as_often_as_it_says)
{
  enum { TRIALS = 4000, POINTS = 5 };
  static const double truth[] = {1, 3};
  uint64_t seed = 1;
  size_t k;
  for (k = 0; k < 2; k++) {
    int i, trial, held = 0;
    for (trial = 0; trial < TRIALS; trial++) {
      lab_line line = {0};
      for (i = 0; i < POINTS; i++)
        lab_line_add(&line, i * i, 2 * i * i + truth[k] * fixture_normal(&seed), 1);
      held += fabs(lab_line_slope(&line) - 2) < lab_line_half(&line, 0.05);
    }
    check_note("%d of %d hold", held, (int)TRIALS);
    assert_true(held > 0.94 * TRIALS && held < (k ? 0.965 : 0.995) * TRIALS);
  }
}
