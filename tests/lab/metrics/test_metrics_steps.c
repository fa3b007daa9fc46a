/* Figures of merit of steps and strokes, against closed forms. */
#include "../../record.h"

static const double T = 0.8, Td = 0.25; /* [s] of a first-order lag with dead time */
static const double pi = 3.141592653589793;

/* A lag that follows steps of the set pressure between two levels every `hold` seconds, up first; rows `step` apart. */
static void record_lag(int steps, double hold, double step, double high)
{
  const double low = 0.004;
  double t = 0, x = low;
  int k;
  record_new(LAB_COMMAND_SET_PRESSURE);
  for (; t < 2 - step / 2; t += step)
    record_add(t, low, 0, low);
  for (k = 0; k < steps; k++) {
    const double from = x, to = k % 2 ? low : high;
    double since;
    for (since = 0; since < hold - step / 2; since += step)
      record_add(2 + k * hold + since, to, 0, since < Td ? from : to + (from - to) * exp(-(since - Td) / T));
    x = to + (from - to) * exp(-(hold - Td) / T);
  }
}

TEST(test_metrics__first_order_lag__its_times)
{
  record_lag(2, 16, 0.001, 0.014);
  record_measure();
  assert_int_equal(metrics.n_steps, 2);
  /* the start is seen at 0.5 % of the change */
  assert_metric(LAB_METRIC_DEAD_TIME_UP, Td - T * log(1 - 0.005), 1e-5, 0);
  assert_metric(LAB_METRIC_DEAD_TIME_DOWN, Td - T * log(1 - 0.005), 1e-5, 0);
  assert_covers(LAB_METRIC_DEAD_TIME_UP, Td, 0.01);
  assert_metric(LAB_METRIC_T63_UP, Td - T * log(1 - 0.632), 1e-6, 0);
  assert_metric(LAB_METRIC_T86_UP, Td - T * log(1 - 0.865), 1e-6, 0);
  assert_metric(LAB_METRIC_T86_DOWN, Td - T * log(1 - 0.865), 1e-6, 0);
  assert_metric(LAB_METRIC_SETTLING_TIME_UP, Td - T * log(0.02), 1e-3, 0);
  assert_close(metrics.metric[LAB_METRIC_T63_UP].uncertainty, 0.0005, 1e-6, 0);
  assert_metric(LAB_METRIC_OVERSHOOT_UP, 0, 0, 0);
}

/* 0.1 % of the stroke of noise, rows 3 to 17 ms apart, a gap across 63 %. */
TEST(test_metrics__noise_gaps_uneven_rows__within_what_is_said)
{
  double t = 0;
  record_new(LAB_COMMAND_SET_PRESSURE);
  while (t < 20) {
    const double since = t - 4;
    const double x = since < Td ? 0.004 : 0.014 - 0.010 * exp(-(since - Td) / T);
    record_add(t, since < 0 ? 1e5 : 2e5, 0, since > 1.0 && since < 1.1 ? (double)NAN : x);
    t += fixture_random(&record_seed, 0.003, 0.017);
  }
  record_noise(0, 2e-5);
  record.noise_x = (double)NAN; /* to be estimated */
  record.bracketed = 1;
  record_measure();
  assert_covers(LAB_METRIC_DEAD_TIME_UP, Td, 0.05);
  assert_covers(LAB_METRIC_T63_UP, Td - T * log(1 - 0.632), 0.09);
  assert_covers(LAB_METRIC_T86_UP, Td - T * log(1 - 0.865), 0.05);
  assert_covers(LAB_METRIC_SETTLING_TIME_UP, Td - T * log(0.02), 0.4);
  assert_covers(LAB_METRIC_OVERSHOOT_UP, 0, 1.2);
}

/* Of many draws of noise of 0.5 % of the change, nearly all leave a time within its uncertainty, and that is no more
 * than it has to be. */
TEST(test_metrics__many_draws_of_noise__uncertainty_is_right)
{
  enum { DRAWS = 100 };
  static const struct {
    int metric;
    double share, most; /* largest uncertainty over the rms of the errors */
  } times[] = {{LAB_METRIC_T63_UP, 0.632, 6}, {LAB_METRIC_T86_UP, 0.865, 6}, {LAB_METRIC_SETTLING_TIME_UP, 0.98, 12}};
  double square[3] = {0}, said[3] = {0};
  int within[3] = {0}, dead = 0, draw;
  size_t i;
  for (draw = 0; draw < DRAWS; draw++) {
    record_lag(1, 16, 0.002, 0.014);
    record_seed = (uint64_t)draw + 1;
    record_noise(0, 5e-5);
    record_measure();
    for (i = 0; i < 3; i++) {
      const lab_metric *got = metric_of(times[i].metric);
      const double off = got->value - (Td - T * log(1 - times[i].share));
      square[i] += off * off / DRAWS;
      said[i] += got->uncertainty / DRAWS;
      within[i] += fabs(off) <= got->uncertainty;
    }
    dead += fabs(metric_of(LAB_METRIC_DEAD_TIME_UP)->value - Td) <= metrics.metric[LAB_METRIC_DEAD_TIME_UP].uncertainty;
  }
  for (i = 0; i < 3; i++) {
    check_note("%s: rms %g, said %g", lab_metric_infos[times[i].metric].key, sqrt(square[i]), said[i]);
    assert_between(within[i], 93, DRAWS);
    assert_between(said[i] / sqrt(square[i]), 1.5, times[i].most);
  }
  assert_between(dead, 93, DRAWS);
}

TEST(test_metrics__logged_command__known_within_a_row)
{
  double exact;
  record_lag(1, 16, 0.01, 0.014);
  record_measure();
  exact = metrics.metric[LAB_METRIC_T86_UP].uncertainty;
  record.bracketed = 1;
  record_measure();
  assert_close(metrics.metric[LAB_METRIC_T86_UP].uncertainty, exact + 0.01, 1e-9, 0);
}

static void record_second_order(double zeta, double sigma)
{
  const double omega = 5, damped = omega * sqrt(1 - zeta * zeta);
  int i;
  record_new(LAB_COMMAND_SET_PRESSURE);
  for (i = 0; i < 4000; i++) {
    const double t = 0.005 * i, s = t - 2;
    const double y =
        s < 0 ? 0 : 1 - exp(-zeta * omega * s) * (cos(damped * s) + zeta * omega / damped * sin(damped * s));
    record_add(t, s < 0 ? 1e5 : 2e5, 0, 0.005 + 0.008 * y);
  }
  record_noise(0, sigma);
}

TEST(test_metrics__second_order__its_overshoot)
{
  const double zeta = 0.4;
  record_second_order(zeta, 0);
  record_measure();
  assert_metric(LAB_METRIC_OVERSHOOT_UP, 100 * exp(-pi * zeta / sqrt(1 - zeta * zeta)), 0.01, 0);
  assert_denied(LAB_METRIC_OVERSHOOT_DOWN, "no step down of the set pressure");
  record_second_order(zeta, 2e-5);
  record_measure();
  assert_covers(LAB_METRIC_OVERSHOOT_UP, 100 * exp(-pi * zeta / sqrt(1 - zeta * zeta)), 1.5);
}

TEST(test_metrics__overdamped_with_noise__no_overshoot)
{
  record_second_order(0.99, 2e-5);
  record_measure();
  assert_metric(LAB_METRIC_OVERSHOOT_UP, 0, 0, 0);
}

TEST(test_metrics__several_steps__median_of_the_large_ones)
{
  record_lag(6, 16, 0.01, 0.014);
  record_measure();
  assert_int_equal(metrics.n_steps, 6);
  assert_metric(LAB_METRIC_T63_UP, Td - T * log(1 - 0.632), 1e-4, 0);
  assert_contains(metric_of(LAB_METRIC_T63_UP)->text, "median of 3 steps up of 50 to 50 %");
}

/* ---- Reasons ---- */

TEST(test_metrics__few_noisy_rows__settling_is_hidden)
{
  record_lag(1, 16, 0.2, 0.014);
  record_noise(0, 2e-4);
  record_measure();
  assert_denied(LAB_METRIC_SETTLING_TIME_UP, "noise hides");
  assert_covers(LAB_METRIC_T63_UP, Td - T * log(1 - 0.632), 0.3);
}

TEST(test_metrics__unsettled__says_so)
{
  record_lag(3, 1.5, 0.01, 0.014);
  record_measure();
  assert_denied(LAB_METRIC_T86_UP, "not settled before the next step");
  assert_denied(LAB_METRIC_T86_DOWN, "before the stem was at rest");
  assert_denied(LAB_METRIC_STROKE_TIME_UP, "not settled before the next step");
  assert_denied(LAB_METRIC_ASYMMETRY, "not settled before the next step");
}

TEST(test_metrics__small_step__says_so)
{
  record_lag(1, 16, 0.01, 0.0044);
  record_noise(0, 2e-5);
  record_measure();
  assert_denied(LAB_METRIC_DEAD_TIME_UP, "too small a movement");
}

TEST(test_metrics__gap_before_the_step__says_so)
{
  size_t i;
  record_lag(1, 16, 0.01, 0.014);
  for (i = 0; record_t[i] < 1.2; i++)
    record_x[i] = (double)NAN;
  record_measure();
  assert_metric(LAB_METRIC_T63_UP, Td - T * log(1 - 0.632), 1e-4, 0);
  for (; record_t[i] < 2.0; i++)
    record_x[i] = (double)NAN;
  record_measure();
  assert_denied(LAB_METRIC_T63_UP, "in a gap of the record");
}

TEST(test_metrics__nothing_to_go_by__says_why)
{
  int i;
  record_new(LAB_COMMAND_SET_PRESSURE);
  record_measure();
  assert_denied(LAB_METRIC_T63_UP, "no rows");
  record_lag(1, 16, 0.01, 0.014);
  record.x = NULL;
  record_measure();
  for (i = 0; i < LAB_METRIC_COUNT; i++)
    assert_denied(i, "the record has no position");
  record.stroke = 0;
  record_measure();
  assert_denied(LAB_METRIC_AIR_MASS, "there is no stem");
  record.unfit = "position is an input";
  record_measure();
  assert_denied(LAB_METRIC_T63_UP, "position is an input");
}

/* ---- Pressure as the input ---- */

/* Pressure that steps within `rise` seconds, from one noisy level to the next. */
static void record_pressure_steps(double rise, double sigma)
{
  int i;
  record_new(LAB_COMMAND_PRESSURE);
  for (i = 0; i < 4000; i++) {
    const double t = 0.01 * i, s = t - 20;
    const double share = fmin(fmax(s / rise, 0), 1), late = s - 0.3;
    record_add(t, 0, 1.5e5 + 1e5 * share, late < 0 ? 0.005 : 0.015 - 0.010 * exp(-late / T));
  }
  record_noise(sigma, 0);
}

TEST(test_metrics__steps_of_a_measured_pressure__found)
{
  record_pressure_steps(0.05, 200);
  record_measure();
  assert_int_equal(metrics.n_steps, 1);
  assert_covers(LAB_METRIC_T63_UP, 0.3 - T * log(1 - 0.632), 0.02);
  assert_denied(LAB_METRIC_T63_DOWN, "no step down of the chamber pressure");
}

TEST(test_metrics__pressure_that_ramps__is_no_step)
{
  record_pressure_steps(3, 200);
  record_measure();
  assert_denied(LAB_METRIC_T63_UP, "with a signal that takes its time");
  record_pressure_steps(15, 0);
  record_measure();
  assert_denied(LAB_METRIC_T63_UP, "with a signal that takes its time");
}

/* ---- Strokes ---- */

/* Up by a lag that reaches the stop, down along a straight line of `fall` seconds. */
static void record_strokes(double top, double fall)
{
  int i;
  record_new(LAB_COMMAND_OPENING);
  for (i = 0; i < 6000; i++) {
    const double t = 0.005 * i, s = t - 1, d = t - 16;
    const double x = s < 0 ? 0 : d < 0 ? top * fmin(1.05 * (1 - exp(-s / T)), 1) : top * fmax(1 - d / fall, 0);
    record_add(t, s < 0 ? 0 : d < 0 ? 1 : -1, 1e5, x);
  }
}

TEST(test_metrics__full_strokes__times_and_asymmetry)
{
  const double rise = T * (log(1 - 0.05 / 1.05) - log(1 - 0.95 / 1.05)), fall = 0.9 * 4;
  double shape = 0;
  int i;
  record_strokes(record_stroke, 4);
  record_measure();
  assert_metric(LAB_METRIC_STROKE_TIME_UP, -T * log(1 - 0.99 / 1.05), 1e-4, 0);
  assert_metric(LAB_METRIC_STROKE_TIME_DOWN, 0.99 * 4, 1e-4, 0);
  assert_metric(LAB_METRIC_DURATION_RATIO, fall / rise, 0, 1e-4);
  for (i = 0; i < 1000; i++) { /* the lag, scaled to unit time and travel, against a straight line */
    const double s = (i + 0.5) / 1000, y = 1.05 * (1 - (1 - 0.05 / 1.05) * exp(-s * rise / T));
    shape += fabs((y - 0.05) / 0.9 - s) / 1000;
  }
  assert_metric(LAB_METRIC_ASYMMETRY, shape, 1e-4, 0);
}

TEST(test_metrics__noisy_strokes__within_what_is_said)
{
  const double rise = T * (log(1 - 0.05 / 1.05) - log(1 - 0.95 / 1.05));
  record_strokes(record_stroke, 4);
  record_noise(0, 2e-5);
  record_measure();
  assert_covers(LAB_METRIC_STROKE_TIME_UP, -T * log(1 - 0.99 / 1.05), 0.05);
  assert_covers(LAB_METRIC_STROKE_TIME_DOWN, 0.99 * 4, 0.05);
  assert_covers(LAB_METRIC_DURATION_RATIO, 3.6 / rise, 0.05);
}

TEST(test_metrics__part_of_a_stroke__says_how_much)
{
  record_strokes(0.5 * record_stroke, 4);
  record_measure();
  assert_denied(LAB_METRIC_STROKE_TIME_UP, "the largest step covers 50 % of the travel");
  assert_denied(LAB_METRIC_STROKE_TIME_DOWN, "no full stroke down: the largest step covers 50 %");
  assert_denied(LAB_METRIC_DURATION_RATIO, "no full stroke up");
  assert_denied(LAB_METRIC_ENERGY_IN, "no cycle");
}
