/* How noisy a channel is: noise of known size, steps of converters, gaps, too few values. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/base/noise.h"

enum { N = 4000 };

static double y[N];

static double noise_of(const double *value, size_t n)
{
  double noise;
  succeed(lab_noise_estimate(value, n, &noise, &error));
  return noise;
}

static void fill_white(double sigma, uint64_t seed)
{
  int i;
  for (i = 0; i < N; i++)
    y[i] = sigma * fixture_normal(&seed);
}

/* ---- Estimate ---- */

/* A median of 4000 sizes is known to about 2 %; second differences of neighbours are not independent: 5 %. */
TEST(test_lab_noise_estimate__white_noise__is_its_deviation)
{
  static const double sigma[] = {1e-6, 0.5, 3e5};
  int k;
  for (k = 0; k < COUNT(sigma); k++) {
    fill_white(sigma[k], (uint64_t)k + 1);
    check_note("sigma %g", sigma[k]);
    assert_close(noise_of(y, N), sigma[k], 0, 0.05);
  }
}

TEST(test_lab_noise_estimate__noise_on_a_ramp_with_a_jump__is_its_deviation)
{
  int i;
  fill_white(0.5, 8);
  for (i = 0; i < N; i++)
    y[i] += 0.01 * i + (i > N / 2 ? 100 : 0);
  assert_close(noise_of(y, N), 0.5, 0, 0.05);
}

TEST(test_lab_noise_estimate__stroke_in_a_tenth_of_the_log__does_not_disturb_it)
{
  int i;
  fill_white(1, 4);
  for (i = 0; i < N; i++)
    y[i] += i < N / 2 ? 0 : i < N / 2 + N / 10 ? 50 * sin(i) : 1e4;
  assert_between(noise_of(y, N), 0.95, 1.25); /* a tenth of the sizes moves the median to the 55th in 100 */
}

/* Alternating signs: every second difference is 4 a, sigma sqrt(6) z of the median. */
TEST(test_lab_noise_estimate__alternating_values__are_the_closed_form)
{
  int i;
  for (i = 0; i < N; i++)
    y[i] = i % 2 ? 3 : -3;
  assert_close(noise_of(y, N), 4 * 3 / (sqrt(6) * 0.67448975019608171), 0, 1e-12);
}

TEST(test_lab_noise_estimate__straight_line__is_a_quarter_of_its_step)
{
  int i;
  for (i = 0; i < N; i++)
    y[i] = 0.5 * i;
  assert_close(noise_of(y, N), 0.125, 0, 1e-12);
}

/* Noise far below a step of the converter shows as steps now and then, and their size sets the least estimate. */
TEST(test_lab_noise_estimate__steps_larger_than_noise__is_a_quarter_of_a_step)
{
  const double step = 2;
  int i;
  fill_white(0.05, 5);
  for (i = 0; i < N; i++)
    y[i] = step * floor((y[i] + 1e-3 * i) / step + 0.5);
  assert_close(noise_of(y, N), step / 4, 0, 1e-12);
}

/* Steps finer than the noise change it by little: sigma^2 + step^2/12. */
TEST(test_lab_noise_estimate__steps_smaller_than_noise__change_it_by_little)
{
  const double step = 0.25;
  int i;
  fill_white(1, 6);
  for (i = 0; i < N; i++)
    y[i] = step * floor(y[i] / step + 0.5);
  assert_close(noise_of(y, N), 1, 0, 0.07);
}

/* Steps of about the size of the noise, where a median of whole steps would be off by a third. */
TEST(test_lab_noise_estimate__steps_as_large_as_noise__add_their_own)
{
  static const double step[] = {0.7, 1, 1.5, 2};
  int i, k;
  for (k = 0; k < COUNT(step); k++) {
    fill_white(1, 9);
    for (i = 0; i < N; i++)
      y[i] = step[k] * floor((y[i] + 0.01 * i) / step[k] + 0.5);
    check_note("step %g", step[k]);
    assert_close(noise_of(y, N), sqrt(1 + step[k] * step[k] / 12), 0, 0.05);
  }
}

TEST(test_lab_noise_estimate__gaps__do_not_count)
{
  int i;
  fill_white(0.5, 7);
  for (i = 0; i < N; i++)
    if (i % 7 == 3)
      y[i] = NAN;
  assert_close(noise_of(y, N), 0.5, 0, 0.07);
  for (i = 0; i < N; i += 3)
    y[i] = NAN;
  assert_true(isnan(noise_of(y, N))); /* no three values in a row */
}

TEST(test_lab_noise_estimate__fewer_than_eight_differences__says_nothing)
{
  static const double ten[] = {1, -1, 1, -1, 1, -1, 1, -1, 1, -1};
  double gap[10];
  assert_true(isfinite(noise_of(ten, 10)));
  assert_true(isnan(noise_of(ten, 9)));
  assert_true(isnan(noise_of(ten, 1)));
  assert_true(isnan(noise_of(ten, 0)));
  memcpy(gap, ten, sizeof gap);
  gap[0] = NAN;
  assert_true(isnan(noise_of(gap, 10)));
}

TEST(test_lab_noise_estimate__one_value_for_ever__is_none)
{
  int i;
  for (i = 0; i < N; i++)
    y[i] = 7;
  assert_close(noise_of(y, N), 0, 0, 0);
}

/* ---- Smallest step ---- */

TEST(test_lab_smallest_step__values_on_a_grid__is_its_step)
{
  static const double grid[] = {0, 7.5, 5, 5, 2.5, 10, -10};
  assert_close(lab_smallest_step(grid, 7), 2.5, 0, 0);
  assert_close(lab_smallest_step(grid, 2), 7.5, 0, 0);
}

TEST(test_lab_smallest_step__gaps__are_no_steps)
{
  static const double gap[] = {0, 3, NAN, 4, 8, NAN};
  assert_close(lab_smallest_step(gap, 6), 3, 0, 0);
}

TEST(test_lab_smallest_step__nothing_changes__is_none)
{
  static const double same[] = {4, 4, 4}, none[] = {NAN, NAN, 1};
  assert_close(lab_smallest_step(same, 3), 0, 0, 0);
  assert_close(lab_smallest_step(none, 3), 0, 0, 0);
  assert_close(lab_smallest_step(same, 1), 0, 0, 0);
  assert_close(lab_smallest_step(same, 0), 0, 0, 0);
}

/* Written to five digits, so that a step is off by up to one in the last; noise of a step. */
TEST(test_lab_resolution__converter__is_its_step)
{
  uint64_t seed = 3;
  int i;
  for (i = 0; i < N; i++)
    y[i] = 1e-5 * nearbyint(1e5 * 0.0305176 * nearbyint(fixture_normal(&seed) + 2 * sin(0.01 * i)));
  y[N / 2] = (double)NAN;
  assert_close(lab_resolution(y, N), 0.0305176, 1e-5, 0);
}

TEST(test_lab_resolution__smooth_or_without_steps__is_none)
{
  int i;
  fill_white(1, 4);
  assert_close(lab_resolution(y, N), 0, 0, 0);
  for (i = 0; i < N; i++)
    y[i] = i < N / 2 ? 0 : 1 - exp(-0.1 * (i - N / 2));
  assert_between(lab_resolution(y, N), 0, 1e-15); /* it ends within the digits of a double */
}
