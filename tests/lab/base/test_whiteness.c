/* apps/lab/base/whiteness, and the tail of chi-square that it needs */
#include "../../fixture.h"

#include "../../../apps/lab/base/quantile.h"
#include "../../../apps/lab/base/whiteness.h"

enum { ROWS = 400 };

/* ---- chi-square ---- */

TEST(test_lab_chi2_tail__one_two_four_degrees__closed_forms)
{
  double x;
  for (x = 0; x < 60; x += 0.7) {
    check_note("x = %g", x);
    assert_close(lab_chi2_tail(x, 1), erfc(sqrt(x / 2)), 0, 1e-13);
    assert_close(lab_chi2_tail(x, 2), exp(-x / 2), 0, 1e-13);
    assert_close(lab_chi2_tail(x, 4), exp(-x / 2) * (1 + x / 2), 0, 1e-13);
  }
}

/* Upper 5 % and 1 % points as tables print them: NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4. */
TEST(test_lab_chi2_tail__printed_points__their_probability)
{
  static const struct {
    int degrees;
    double five, one;
  } table[] = {{3, 7.815, 11.345}, {10, 18.307, 23.209}, {25, 37.652, 44.314}, {60, 79.082, 88.379}};
  size_t i;
  for (i = 0; i < sizeof table / sizeof *table; i++) {
    check_note("%d degrees", table[i].degrees);
    assert_close(lab_chi2_tail(table[i].five, table[i].degrees), 0.05, 0, 5e-4);
    assert_close(lab_chi2_tail(table[i].one, table[i].degrees), 0.01, 0, 5e-4);
  }
}

/* The density integrated by Simpson's rule, from x to where nothing is left. */
static double integrated_tail(double x, int degrees)
{
  enum { STEPS = 20000 };
  const double a = 0.5 * degrees, h = 200.0 / STEPS;
  double sum = 0;
  int i;
  for (i = 0; i <= STEPS; i++) {
    const double z = 0.5 * (x + i * h);
    sum += (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2) * 0.5 * exp((a - 1) * log(z) - z - lgamma(a));
  }
  return sum * h / 3;
}

TEST(test_lab_chi2_tail__many_degrees__the_integral_of_the_density)
{
  static const int degrees[] = {3, 7, 18, 37, 60};
  size_t i;
  for (i = 0; i < sizeof degrees / sizeof *degrees; i++) {
    check_note("%d degrees", degrees[i]);
    assert_close(lab_chi2_tail(20, degrees[i]), integrated_tail(20, degrees[i]), 0, 1e-9);
    assert_close(lab_chi2_tail(90, degrees[i]), integrated_tail(90, degrees[i]), 0, 1e-9);
  }
  assert_close(lab_chi2_tail(0, 37), 1, 0, 0);
  assert_close(lab_chi2_tail(1e5, 37), 0, 0, 0);
}

/* ---- whiteness ---- */

static uint64_t seed;

/* r_i = rho r_(i-1) + noise, of variance 1 */
static void draw(double rho, double *r, size_t n)
{
  size_t i;
  for (i = 0; i < n; i++)
    r[i] = i == 0 ? fixture_normal(&seed) : rho * r[i - 1] + sqrt(1 - rho * rho) * fixture_normal(&seed);
}

/* Share of draws that the test calls coloured at 5 %; every third value is a gap if asked for. */
static double refused(double rho, int gaps, int draws)
{
  static double r[ROWS];
  const lab_stretch stretch[] = {{r, ROWS / 4}, {r + ROWS / 4, ROWS - ROWS / 4}};
  int i, k, count = 0;
  seed = 11;
  for (i = 0; i < draws; i++) {
    lab_whiteness w;
    draw(rho, r, ROWS);
    for (k = 0; gaps && k < ROWS; k++)
      if (fixture_normal(&seed) > 0.43)
        r[k] = (double)NAN;
    lab_whiteness_test(stretch, 2, &w);
    count += w.p_value < 0.05;
  }
  return (double)count / draws;
}

/* 2000 draws: a standard deviation of 0.5 %; Q is chi-square to first order in lags/n, which is 7 %. */
TEST(test_lab_whiteness_test__white__refused_at_its_rate)
{
  assert_between(refused(0, 0, 2000), 0.035, 0.07);
}

TEST(test_lab_whiteness_test__white_with_gaps__refused_at_its_rate)
{
  assert_between(refused(0, 1, 2000), 0.035, 0.07);
}

TEST(test_lab_whiteness_test__autoregressive__refused)
{
  assert_between(refused(0.4, 0, 200), 0.99, 1);
  assert_between(refused(0.4, 1, 200), 0.9, 1);
}

TEST(test_lab_whiteness_test__autoregressive__correlation_is_rho_to_the_lag)
{
  enum { N = 40000 };
  static double r[N];
  const lab_stretch stretch = {r, N};
  lab_whiteness w;
  seed = 3;
  draw(0.8, r, N);
  lab_whiteness_test(&stretch, 1, &w);
  assert_int_equal(w.lags, 46);
  assert_close(w.correlation[0], 1, 0, 0);
  assert_close(w.correlation[1], 0.8, 0.015, 0);
  assert_close(w.correlation[3], 0.512, 0.03, 0);
  assert_close(w.deviation[1], 1 / sqrt(N), 0, 1e-3);
}

TEST(test_lab_whiteness_test__constant__is_not_white)
{
  static double r[ROWS];
  const lab_stretch stretch = {r, ROWS};
  lab_whiteness w;
  int i;
  seed = 4;
  draw(0, r, ROWS);
  for (i = 0; i < ROWS; i++)
    r[i] += 1;
  lab_whiteness_test(&stretch, 1, &w);
  assert_true(w.p_value < 1e-6);
}

/* By hand: 1 -1 | 2 gap 1, two stretches. Pairs one apart: 1 * -1; nothing across the edge or the gap. */
TEST(test_lab_whiteness_test__gap_and_edge__no_pair_across)
{
  const double first[] = {1, -1, 1, -1, 1, -1, 1, -1}, second[] = {2, (double)NAN, 1};
  const lab_stretch stretch[] = {{first, 8}, {second, 3}};
  lab_whiteness w;
  lab_whiteness_test(stretch, 2, &w);
  assert_int_equal(w.n, 10);
  assert_int_equal(w.lags, 2);
  assert_close(w.correlation[1], -7.0 / 13, 1e-15, 0);
  assert_close(w.correlation[2], 8.0 / 13, 1e-15, 0);
  assert_close(w.deviation[1], sqrt(7.0 / 120), 1e-15, 0);
  assert_close(w.statistic, (49.0 / 7 + 64.0 / 7) / 169 * 120, 0, 1e-14);
}

TEST(test_lab_whiteness_test__too_few_values__says_nothing)
{
  const double r[] = {1, 2, (double)NAN}, zero[8] = {0};
  const lab_stretch few = {r, 3}, nothing = {zero, 8};
  lab_whiteness w;
  lab_whiteness_test(&few, 1, &w);
  assert_true(isnan(w.p_value));
  lab_whiteness_test(&nothing, 1, &w);
  assert_true(isnan(w.p_value));
}
