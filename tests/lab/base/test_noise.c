/* How noisy a channel is: noise of known size and memory, steps of converters, gaps, too few values. */
#include "../../fixture.h"

#include "../../../apps/lab/base/noise.h"

enum { N = 4000 };

static double y[N];

static double noise_of(const double *value, size_t n)
{
  lab_error error;
  double noise;
  assert_int_equal(lab_noise_estimate(value, n, &noise, &error), LAB_OK);
  return noise;
}

static double normal(uint64_t *seed)
{
  double sum = -6;
  int k;
  for (k = 0; k < 12; k++) /* twelve uniform numbers: variance 1 */
    sum += fixture_random(seed, 0, 1);
  return sum;
}

static void fill_white(double sigma, uint64_t seed)
{
  int i;
  for (i = 0; i < N; i++)
    y[i] = sigma * normal(&seed);
}

/* Noise of unit variance of which each value keeps a share of the one before. */
static void fill_with_memory(double memory, uint64_t seed)
{
  int i;
  y[0] = normal(&seed);
  for (i = 1; i < N; i++)
    y[i] = memory * y[i - 1] + sqrt(1 - memory * memory) * normal(&seed);
}

/* ---- Estimate ---- */

/* A median of 4000 sizes is known to about 2 %; second differences of neighbours are not independent: 5 %. */
static void test_lab_noise_estimate__white_noise__is_its_deviation(void **state)
{
  static const double sigma[] = {1e-6, 0.5, 3e5};
  int k;
  (void)state;
  for (k = 0; k < COUNT(sigma); k++) {
    fill_white(sigma[k], (uint64_t)k + 1);
    check_note("sigma %g", sigma[k]);
    assert_close(noise_of(y, N), sigma[k], 0, 0.05);
  }
}

static void test_lab_noise_estimate__noise_on_a_ramp_with_a_jump__is_its_deviation(void **state)
{
  int i;
  (void)state;
  fill_white(0.5, 8);
  for (i = 0; i < N; i++)
    y[i] += 0.01 * i + (i > N / 2 ? 100 : 0);
  assert_close(noise_of(y, N), 0.5, 0, 0.05);
}

static void test_lab_noise_estimate__stroke_in_a_tenth_of_the_log__does_not_disturb_it(void **state)
{
  int i;
  (void)state;
  fill_white(1, 4);
  for (i = 0; i < N; i++)
    y[i] += i < N / 2 ? 0 : i < N / 2 + N / 10 ? 50 * sin(i) : 1e4;
  assert_between(noise_of(y, N), 0.95, 1.25); /* a tenth of the sizes moves the median to the 55th in 100 */
}

/* Alternating signs: every second difference is 4 a, sigma sqrt(6) z of the median. */
static void test_lab_noise_estimate__alternating_values__are_the_closed_form(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = i % 2 ? 3 : -3;
  assert_close(noise_of(y, N), 4 * 3 / (sqrt(6) * 0.67448975019608171), 0, 1e-12);
}

static void test_lab_noise_estimate__straight_line__is_a_quarter_of_its_step(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = 0.5 * i;
  assert_close(noise_of(y, N), 0.125, 0, 1e-12);
}

/* Noise far below a step of the converter shows as steps now and then, and their size sets the least estimate. */
static void test_lab_noise_estimate__steps_larger_than_noise__is_a_quarter_of_a_step(void **state)
{
  const double step = 2;
  int i;
  (void)state;
  fill_white(0.05, 5);
  for (i = 0; i < N; i++)
    y[i] = step * floor((y[i] + 1e-3 * i) / step + 0.5);
  assert_close(noise_of(y, N), step / 4, 0, 1e-12);
}

/* Steps finer than the noise change it by little: sigma^2 + step^2/12. */
static void test_lab_noise_estimate__steps_smaller_than_noise__change_it_by_little(void **state)
{
  const double step = 0.25;
  int i;
  (void)state;
  fill_white(1, 6);
  for (i = 0; i < N; i++)
    y[i] = step * floor(y[i] / step + 0.5);
  assert_close(noise_of(y, N), 1, 0, 0.07);
}

static void test_lab_noise_estimate__gaps__do_not_count(void **state)
{
  int i;
  (void)state;
  fill_white(0.5, 7);
  for (i = 0; i < N; i++)
    if (i % 7 == 3)
      y[i] = NAN;
  assert_close(noise_of(y, N), 0.5, 0, 0.07);
  for (i = 0; i < N; i += 3)
    y[i] = NAN;
  assert_true(isnan(noise_of(y, N))); /* no three values in a row */
}

static void test_lab_noise_estimate__fewer_than_eight_differences__says_nothing(void **state)
{
  static const double ten[] = {1, -1, 1, -1, 1, -1, 1, -1, 1, -1};
  double gap[10];
  (void)state;
  assert_true(isfinite(noise_of(ten, 10)));
  assert_true(isnan(noise_of(ten, 9)));
  assert_true(isnan(noise_of(ten, 1)));
  assert_true(isnan(noise_of(ten, 0)));
  memcpy(gap, ten, sizeof gap);
  gap[0] = NAN;
  assert_true(isnan(noise_of(gap, 10)));
}

static void test_lab_noise_estimate__one_value_for_ever__is_none(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = 7;
  assert_close(noise_of(y, N), 0, 0, 0);
}

/* ---- Memory ---- */

/* Its standard error is sqrt((1 - a^2)/n), at most 0.016: four of them. */
static void test_lab_noise_memory__noise_with_memory__is_its_coefficient(void **state)
{
  static const double memory[] = {-0.8, -0.4, 0.2, 0.5, 0.85};
  int k;
  (void)state;
  for (k = 0; k < COUNT(memory); k++) {
    fill_with_memory(memory[k], (uint64_t)k + 10);
    check_note("memory %g", memory[k]);
    assert_close(lab_noise_memory(y, N), memory[k], 4 * sqrt((1 - memory[k] * memory[k]) / N), 0);
  }
}

static void test_lab_noise_memory__on_a_level__is_the_same(void **state)
{
  double zero;
  int i;
  (void)state;
  fill_with_memory(0.5, 15);
  zero = lab_noise_memory(y, N);
  for (i = 0; i < N; i++)
    y[i] = 1e3 + 2 * y[i];
  assert_close(lab_noise_memory(y, N), zero, 1e-9, 0);
}

static void test_lab_noise_memory__white_noise__is_none(void **state)
{
  int k;
  (void)state;
  for (k = 0; k < 20; k++) {
    fill_white(3, (uint64_t)k + 20);
    assert_close(lab_noise_memory(y, N), 0, 0, 0);
  }
}

/* Two values and two others: 0.5 but for the ends; with 50 such rows that is less than four standard errors. */
static void test_lab_noise_memory__few_values__needs_more_of_it(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = i % 8 < 4 ? 1 : -1;
  assert_close(lab_noise_memory(y, 800), 0.5, 1.0 / 800, 0);
  assert_close(lab_noise_memory(y, 56), 0, 0, 0);
}

static void test_lab_noise_memory__less_than_fifty_values__says_nothing(void **state)
{
  double gap[50];
  int i;
  (void)state;
  for (i = 0; i < 50; i++)
    y[i] = i;
  memcpy(gap, y, sizeof gap);
  gap[20] = NAN;
  assert_true(lab_noise_memory(y, 50) > 0.8);
  assert_close(lab_noise_memory(y, 49), 0, 0, 0);
  assert_close(lab_noise_memory(y, 0), 0, 0, 0);
  assert_close(lab_noise_memory(gap, 50), 0, 0, 0);
}

/* What hardly changes from row to row has no more than 0.9, or a fit would live on its differences alone. */
static void test_lab_noise_memory__next_to_one__is_held_at_nine_tenths(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = sin(1e-2 * i);
  assert_close(lab_noise_memory(y, N), 0.9, 0, 0);
  for (i = 0; i < N; i++)
    y[i] = i % 2;
  assert_close(lab_noise_memory(y, N), -0.9, 0, 0);
}

static void test_lab_noise_memory__one_value_for_ever__is_none(void **state)
{
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = 7;
  assert_close(lab_noise_memory(y, N), 0, 0, 0);
}

/* A stretch of a tenth that is missing takes one pair of neighbours. */
static void test_lab_noise_memory__one_long_gap__changes_nothing(void **state)
{
  int i;
  (void)state;
  fill_with_memory(0.6, 16);
  for (i = N / 2; i < N / 2 + N / 10; i++)
    y[i] = NAN;
  assert_close(lab_noise_memory(y, N), 0.6, 4 * sqrt((1 - 0.36) / (0.9 * N)), 0);
}

/* Every third value is missing, and with it two pairs of three; or values at random. Four standard errors of the pairs
 * that are left. */
static void test_lab_noise_memory__scattered_gaps__change_nothing(void **state)
{
  static const double memory[] = {-0.6, 0.6};
  uint64_t seed = 5;
  int i, k;
  (void)state;
  for (k = 0; k < COUNT(memory); k++) {
    const double error = 4 * sqrt((1 - memory[k] * memory[k]) / N);
    check_note("memory %g", memory[k]);
    fill_with_memory(memory[k], (uint64_t)k + 17);
    for (i = 0; i < N; i += 3)
      y[i] = NAN;
    assert_close(lab_noise_memory(y, N), memory[k], error * sqrt(3), 0);
    fill_with_memory(memory[k], (uint64_t)k + 19);
    for (i = 0; i < N; i++)
      if (fixture_random(&seed, 0, 1) < 0.5)
        y[i] = NAN;
    assert_close(lab_noise_memory(y, N), memory[k], error * 2, 0);
  }
}

/* Fewer pairs, larger standard error: of 2000 values with 400 pairs, 0.15 is no longer told from 0. */
static void test_lab_noise_memory__scattered_gaps__need_more_of_it(void **state)
{
  int i;
  (void)state;
  fill_with_memory(0.15, 21);
  assert_true(lab_noise_memory(y, N) > 0.08);
  for (i = 0; i < N; i++)
    if (i % 2 && i % 10 != 1)
      y[i] = NAN;
  assert_close(lab_noise_memory(y, N), 0, 0, 0);
}

static void test_lab_noise_memory__no_two_neighbours__says_nothing(void **state)
{
  int i;
  (void)state;
  fill_with_memory(0.9, 22);
  for (i = 0; i < N; i += 2)
    y[i] = NAN;
  assert_close(lab_noise_memory(y, N), 0, 0, 0);
}

/* ---- Smallest step ---- */

static void test_lab_smallest_step__values_on_a_grid__is_its_step(void **state)
{
  static const double grid[] = {0, 7.5, 5, 5, 2.5, 10, -10};
  (void)state;
  assert_close(lab_smallest_step(grid, 7), 2.5, 0, 0);
  assert_close(lab_smallest_step(grid, 2), 7.5, 0, 0);
}

static void test_lab_smallest_step__gaps__are_no_steps(void **state)
{
  static const double gap[] = {0, 3, NAN, 4, 8, NAN};
  (void)state;
  assert_close(lab_smallest_step(gap, 6), 3, 0, 0);
}

static void test_lab_smallest_step__nothing_changes__is_none(void **state)
{
  static const double same[] = {4, 4, 4}, none[] = {NAN, NAN, 1};
  (void)state;
  assert_close(lab_smallest_step(same, 3), 0, 0, 0);
  assert_close(lab_smallest_step(none, 3), 0, 0, 0);
  assert_close(lab_smallest_step(same, 1), 0, 0, 0);
  assert_close(lab_smallest_step(same, 0), 0, 0, 0);
}

/* Written to five digits, so that a step is off by up to one in the last; noise of a step. */
static void test_lab_resolution__converter__is_its_step(void **state)
{
  uint64_t seed = 3;
  int i;
  (void)state;
  for (i = 0; i < N; i++)
    y[i] = 1e-5 * nearbyint(1e5 * 0.0305176 * nearbyint(normal(&seed) + 2 * sin(0.01 * i)));
  y[N / 2] = (double)NAN;
  assert_close(lab_resolution(y, N), 0.0305176, 1e-5, 0);
}

static void test_lab_resolution__smooth_or_without_steps__is_none(void **state)
{
  int i;
  (void)state;
  fill_white(1, 4);
  assert_close(lab_resolution(y, N), 0, 0, 0);
  for (i = 0; i < N; i++)
    y[i] = i < N / 2 ? 0 : 1 - exp(-0.1 * (i - N / 2));
  assert_between(lab_resolution(y, N), 0, 1e-15); /* it ends within the digits of a double */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_noise_estimate__white_noise__is_its_deviation),
      cmocka_unit_test(test_lab_noise_estimate__noise_on_a_ramp_with_a_jump__is_its_deviation),
      cmocka_unit_test(test_lab_noise_estimate__stroke_in_a_tenth_of_the_log__does_not_disturb_it),
      cmocka_unit_test(test_lab_noise_estimate__alternating_values__are_the_closed_form),
      cmocka_unit_test(test_lab_noise_estimate__straight_line__is_a_quarter_of_its_step),
      cmocka_unit_test(test_lab_noise_estimate__steps_larger_than_noise__is_a_quarter_of_a_step),
      cmocka_unit_test(test_lab_noise_estimate__steps_smaller_than_noise__change_it_by_little),
      cmocka_unit_test(test_lab_noise_estimate__gaps__do_not_count),
      cmocka_unit_test(test_lab_noise_estimate__fewer_than_eight_differences__says_nothing),
      cmocka_unit_test(test_lab_noise_estimate__one_value_for_ever__is_none),
      cmocka_unit_test(test_lab_noise_memory__noise_with_memory__is_its_coefficient),
      cmocka_unit_test(test_lab_noise_memory__on_a_level__is_the_same),
      cmocka_unit_test(test_lab_noise_memory__white_noise__is_none),
      cmocka_unit_test(test_lab_noise_memory__few_values__needs_more_of_it),
      cmocka_unit_test(test_lab_noise_memory__less_than_fifty_values__says_nothing),
      cmocka_unit_test(test_lab_noise_memory__next_to_one__is_held_at_nine_tenths),
      cmocka_unit_test(test_lab_noise_memory__one_value_for_ever__is_none),
      cmocka_unit_test(test_lab_noise_memory__one_long_gap__changes_nothing),
      cmocka_unit_test(test_lab_noise_memory__scattered_gaps__change_nothing),
      cmocka_unit_test(test_lab_noise_memory__scattered_gaps__need_more_of_it),
      cmocka_unit_test(test_lab_noise_memory__no_two_neighbours__says_nothing),
      cmocka_unit_test(test_lab_smallest_step__values_on_a_grid__is_its_step),
      cmocka_unit_test(test_lab_smallest_step__gaps__are_no_steps),
      cmocka_unit_test(test_lab_smallest_step__nothing_changes__is_none),
      cmocka_unit_test(test_lab_resolution__converter__is_its_step),
      cmocka_unit_test(test_lab_resolution__smooth_or_without_steps__is_none),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
