/* A response seen coarsely: what does not depend on the phase of stick-slip, and what noise does to it. */
#include "../../fixture.h"

#include "../../../apps/lab/fit/windowed.h"

enum { ROWS = 6400, WINDOW = 64, WINDOWS = 2 * (ROWS - WINDOW) / WINDOW + 1, PERIOD = 16 };

static const double sigma = 0.1;
/* Scatter of the sawtooth is 4/sqrt(12), known to a fifth. By phase, the line takes a 16th of its variance or a 64th:
 * 0.03 of scatter; noise moves it by sigma/8, of which four: 0.05. */
static const double scatter_bound = (0.03 + 0.05) / (0.2 * 1.155);
static double measured[ROWS], predicted[ROWS], r[2 * WINDOWS];

static double ramp(int i)
{
  return 0.05 * i;
}

/* Slips of one unit every PERIOD rows about a ramp. */
static double sawtooth(int i, int phase)
{
  return ramp(i) + 4 * ((double)((i + phase) % PERIOD) / PERIOD - 0.5);
}

static void fill(double (*truth)(int), uint64_t seed)
{
  int i;
  for (i = 0; i < ROWS; i++)
    measured[i] = (truth ? truth(i) : sawtooth(i, 0)) + sigma * fixture_normal(&seed);
}

/* Root mean square of every other residual. */
static double rms(int first)
{
  double sum = 0;
  int k;
  for (k = first; k < 2 * WINDOWS; k += 2)
    sum += r[k] * r[k];
  return sqrt(sum / WINDOWS);
}

TEST(test_lab_windowed_count__lengths__windows_overlap_by_half)
{
  assert_int_equal(lab_windowed_count(100, 20), 9);
  assert_int_equal(lab_windowed_count(109, 20), 9);
  assert_int_equal(lab_windowed_count(110, 20), 10);
  assert_int_equal(lab_windowed_count(20, 20), 1);
  assert_int_equal(lab_windowed_count(19, 20), 0);
  assert_true((lab_windowed_count(100, 21) - 1) * (21 / 2) + 21 <= 100); /* the last one ends within the rows */
  assert_int_equal(lab_windowed_count(ROWS, WINDOW), WINDOWS);
}

TEST(test_lab_windowed_residuals__sawtooth_out_of_phase__are_small)
{
  double row_by_row = 0;
  int i;
  fill(NULL, 1);
  for (i = 0; i < ROWS; i++) {
    predicted[i] = sawtooth(i, PERIOD / 2);
    row_by_row += (measured[i] - predicted[i]) * (measured[i] - predicted[i]) / (sigma * sigma * ROWS);
  }
  lab_windowed_residuals(measured, predicted, ROWS, WINDOW, sigma, r);
  assert_true(row_by_row > 300);
  for (i = 0; i < WINDOWS; i++) {
    assert_close(r[2 * i], 0, 0.1, 0);
    assert_close(r[2 * i + 1], 0, scatter_bound, 0);
  }
}

TEST(test_lab_windowed_residuals__line_for_a_sawtooth__miss_its_scatter)
{
  int i;
  fill(NULL, 2);
  for (i = 0; i < ROWS; i++)
    predicted[i] = ramp(i);
  lab_windowed_residuals(measured, predicted, ROWS, WINDOW, sigma, r);
  for (i = 0; i < WINDOWS; i++) {
    assert_close(r[2 * i], 0, 0.5, 0);
    assert_between(r[2 * i + 1], 4, 6); /* all of the roughness, known to a fifth */
  }
}

TEST(test_lab_windowed_residuals__sawtooth_beside_its_course__miss_the_mean)
{
  int i;
  fill(NULL, 3);
  for (i = 0; i < ROWS; i++)
    predicted[i] = sawtooth(i, 3) - 10;
  lab_windowed_residuals(measured, predicted, ROWS, WINDOW, sigma, r);
  for (i = 0; i < WINDOWS; i++) {
    assert_between(r[2 * i], 12, 30);
    assert_close(r[2 * i + 1], 0, scatter_bound, 0);
  }
}

TEST(test_lab_windowed_residuals__noise_alone__have_unit_scatter)
{
  int i;
  fill(ramp, 4);
  for (i = 0; i < ROWS; i++)
    predicted[i] = ramp(i);
  lab_windowed_residuals(measured, predicted, ROWS, WINDOW, sigma, r);
  assert_close(rms(0), 1, 0.2, 0);
  assert_close(rms(1), 1, 0.2, 0);
}

TEST(test_lab_windowed_residuals__gaps__do_not_count)
{
  int i;
  fill(ramp, 5);
  for (i = 0; i < ROWS; i++)
    predicted[i] = ramp(i);
  for (i = 0; i < WINDOW + WINDOW / 2; i++)
    if (i % 10 != 0 || i >= WINDOW) { /* seven values in the first window, fewer in the second */
      measured[i] = NAN;
      predicted[i] = 1e6;
    }
  for (i = WINDOW / 2 * 10; i < WINDOW / 2 * 10 + WINDOW; i += 3) {
    measured[i] = NAN;
    predicted[i] = 1e6;
  }
  lab_windowed_residuals(measured, predicted, ROWS, WINDOW, sigma, r);
  for (i = 0; i < 4; i++)
    assert_true(r[i] == 0);
  assert_true(r[4] != 0);
  assert_close(r[20], 0, 4, 0);
  assert_close(r[21], 0, 4, 0);
  assert_true(r[20] != 0 && r[21] != 0);
}

TEST(test_lab_windowed_roughness__smooth_with_noise__is_0)
{
  int i;
  fill(ramp, 6);
  for (i = 0; i < ROWS; i++)
    predicted[i] = 0;
  assert_true(lab_windowed_roughness(measured, predicted, ROWS, WINDOW, sigma) == 0);
}

/* Strokes up and down, each of which ends slowly. */
static double strokes(int i, double slowness)
{
  const double left = exp(-(i % 320) / slowness);
  return 20 * (i / 320 % 2 ? left : 1 - left);
}

/* A stroke that takes half as long again as the model's is no stick-slip. */
TEST(test_lab_windowed_roughness__slower_strokes__is_0)
{
  int i;
  fill(ramp, 8);
  for (i = 0; i < ROWS; i++) {
    predicted[i] = strokes(i, 12);
    measured[i] += strokes(i, 18) - ramp(i);
  }
  assert_true(lab_windowed_roughness(measured, predicted, ROWS, WINDOW, sigma) == 0);
}

TEST(test_lab_windowed_roughness__stick_slip__is_1_unless_predicted)
{
  int i;
  fill(NULL, 7);
  for (i = 0; i < ROWS; i++)
    predicted[i] = ramp(i);
  assert_between(lab_windowed_roughness(measured, predicted, ROWS, WINDOW, sigma), 0.98, 1);
  for (i = 0; i < ROWS; i++)
    predicted[i] = sawtooth(i, PERIOD / 2);
  assert_true(lab_windowed_roughness(measured, predicted, ROWS, WINDOW, sigma) == 0);
}

/* Rough, but nothing moves along. */
static double shaking(int i)
{
  return i % 4 < 2 ? 2 : -2;
}

TEST(test_lab_windowed_roughness__no_motion__is_0)
{
  int i;
  fill(shaking, 8);
  for (i = 0; i < ROWS; i++)
    predicted[i] = 0;
  assert_true(lab_windowed_roughness(measured, predicted, ROWS, WINDOW, sigma) == 0);
}
