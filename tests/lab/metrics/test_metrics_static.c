/* Dead band, resolution, hysteresis and linearity, against elements whose characteristic is known. */
#include "../../record.h"

/* An element with play: position follows signal off by half the play, either way. */
typedef struct element {
  double play;    /* [Pa] */
  double bow;     /* [1] height of a parabola over the straight line, share of the stroke */
  double stick;   /* [Pa] change of signal that it takes to move on */
  double lasting; /* [Pa] further distance of the branches in the middle of the range */
  double x;       /* [m] */
} element;

static double follow(element *e, double s)
{
  const double share = (s - record_low) / record_span;
  const double target = record_stroke * (share + 4 * e->bow * share * (1 - share));
  const double half = record_stroke / record_span * (e->play + 4 * e->lasting * share * (1 - share)) / 2;
  const double pushed = fmin(fmax(e->x, target - half), target + half);
  if (fabs(pushed - e->x) >= e->stick * record_stroke / record_span * (1 - 1e-9))
    e->x = fmin(fmax(pushed, 0), record_stroke);
  return e->x;
}

/* Hold a set pressure for `rows` rows, 0.1 s apart. */
static void hold(element *e, double percent, int rows)
{
  const double s = record_low + record_span * percent / 100;
  const double x = follow(e, s);
  int i;
  for (i = 0; i < rows; i++)
    record_add(0.1 * (double)record.n, s, 0, x);
}

/* Steps of `step` percent from one level to the next of n, the last one included. */
static void stairs(element *e, const double *level, int n, double step)
{
  int k, i;
  for (k = 1; k < n; k++) {
    const int steps = (int)(fabs(level[k] - level[k - 1]) / step + 0.5);
    for (i = 1; i <= steps; i++)
      hold(e, level[k - 1] + (level[k] - level[k - 1]) * i / steps, 12);
  }
}

static void measure_stairs(element e, const double *level, int n, double step)
{
  record_new(LAB_COMMAND_SET_PRESSURE);
  stairs(&e, level, n, step);
  record_measure();
}

/* Chamber pressure that ramps through n levels, rows 0.05 s apart, `rate` percent of the span a second. */
static void ramps(element *e, const double *level, int n, double rate)
{
  int k, i;
  for (k = 1; k < n; k++) {
    const int rows = (int)(fabs(level[k] - level[k - 1]) / rate / 0.05 + 0.5);
    for (i = 1; i <= rows; i++) {
      const double s = record_low + record_span * (level[k - 1] + (level[k] - level[k - 1]) * i / rows) / 100;
      record_add(0.05 * (double)record.n, 0, s, follow(e, s));
    }
  }
}

/* ---- Play ---- */

TEST(test_metrics__play_by_a_staircase__dead_band_and_no_hysteresis)
{
  element e = {20e3, 0, 0, 0, 0};
  record_new(LAB_COMMAND_SET_PRESSURE);
  stairs(&e, (const double[]){-10, 110, -10, 50}, 4, 2);
  stairs(&e, (const double[]){50, 30, 50}, 3, 0.5);
  record_measure();
  assert_covers(LAB_METRIC_DEAD_BAND, 10, 0.5);
  assert_covers(LAB_METRIC_HYSTERESIS_DEAD_BAND, 10, 0.2);
  assert_covers(LAB_METRIC_HYSTERESIS, 0, 0.6);
  assert_covers(LAB_METRIC_LINEARITY, 0, 0.2);
  assert_metric(LAB_METRIC_RESOLUTION, 0.5, 0.01, 0);
  assert_true(metrics.metric[LAB_METRIC_RESOLUTION].at_most);
}

TEST(test_metrics__play_by_a_slow_ramp_with_noise__the_same)
{
  element e = {20e3, 0, 0, 0, 0};
  record_new(LAB_COMMAND_PRESSURE);
  ramps(&e, (const double[]){-10, 110, -10, 50, 30, 50}, 6, 1);
  record_noise(300, 2e-5);
  record_p[500] = (double)NAN;
  record_x[700] = (double)NAN;
  record_measure();
  assert_covers(LAB_METRIC_DEAD_BAND, 10, 1.5);
  assert_covers(LAB_METRIC_HYSTERESIS_DEAD_BAND, 10, 1.5);
  assert_covers(LAB_METRIC_HYSTERESIS, 0, 3);
  assert_covers(LAB_METRIC_LINEARITY, 0, 1.5);
}

/* Branches that part further in the middle than a turn needs. */
TEST(test_metrics__hysteresis_beside_play__both_apart)
{
  element e = {10e3, 0, 0, 16e3, 0};
  record_new(LAB_COMMAND_SET_PRESSURE);
  stairs(&e, (const double[]){-10, 110, -10, 10}, 4, 1);
  stairs(&e, (const double[]){10, -5}, 2, 0.5);
  record_measure();
  assert_metric(LAB_METRIC_HYSTERESIS_DEAD_BAND, 100 * 26e3 / record_span, 0.1, 0);
  assert_between(metric_of(LAB_METRIC_DEAD_BAND)->value, 5, 9);
  assert_close(metric_of(LAB_METRIC_HYSTERESIS)->value, 13 - metrics.metric[LAB_METRIC_DEAD_BAND].value, 0.2, 0);
}

TEST(test_metrics__no_play__at_most_what_a_step_shows)
{
  measure_stairs((element){0, 0, 0, 0, 0}, (const double[]){0, 60, 30}, 3, 2);
  assert_true(metric_of(LAB_METRIC_DEAD_BAND)->at_most);
  assert_between(metrics.metric[LAB_METRIC_DEAD_BAND].value, 1, 2.5);
}

/* ---- Resolution ---- */

TEST(test_metrics__stem_that_slips__its_step)
{
  measure_stairs((element){0, 0, 3e3, 0, 0}, (const double[]){0, 60}, 2, 0.25);
  assert_covers(LAB_METRIC_RESOLUTION, 1.5, 0.15);
  assert_false(metrics.metric[LAB_METRIC_RESOLUTION].at_most);
}

TEST(test_metrics__slips_in_a_noisy_ramp__their_step)
{
  element e = {0, 0, 6e3, 0, 0};
  record_new(LAB_COMMAND_PRESSURE);
  ramps(&e, (const double[]){0, 60}, 2, 1);
  record_noise(100, 5e-6);
  record_measure();
  assert_covers(LAB_METRIC_RESOLUTION, 3, 0.3);
}

/* ---- Linearity ---- */

/* Of a parabola over its chord, the line that suits best takes half the height, which shrinks with the square of the
 * range. Off the stops are both branches from 3 % to 96 %, and the grid has 0.6 %. */
TEST(test_metrics__bowed_characteristic__half_the_bow)
{
  const double most = 0.96 - 0.03, least = most - 2 * 0.006;
  measure_stairs((element){4e3, 0.06, 0, 0, 0}, (const double[]){-10, 110, -10}, 3, 1);
  assert_between(metric_of(LAB_METRIC_LINEARITY)->value, 100 * 0.06 / 2 * least * least, 100 * 0.06 / 2 * most * most);
  assert_denied(LAB_METRIC_HYSTERESIS, "it takes the dead band");
}

/* ---- Reasons ---- */

TEST(test_metrics__fast_loop__says_so)
{
  element e = {20e3, 0, 0, 0, 0};
  record_new(LAB_COMMAND_PRESSURE);
  ramps(&e, (const double[]){-10, 110, -10, 50, 20}, 5, 30);
  record_measure();
  assert_denied(LAB_METRIC_DEAD_BAND, "the stem passes all 1 turns of the chamber pressure faster than 5 %");
  assert_denied(LAB_METRIC_RESOLUTION, "changes slowly nowhere");
  assert_denied(LAB_METRIC_HYSTERESIS_DEAD_BAND, "no slow loop");
  assert_denied(LAB_METRIC_LINEARITY, "no slow loop");
}

TEST(test_metrics__turns_on_stops_only__no_dead_band)
{
  measure_stairs((element){20e3, 0, 0, 0, 0}, (const double[]){-10, 110, -10}, 3, 5);
  assert_denied(LAB_METRIC_DEAD_BAND, "on a stop it does");
  assert_denied(LAB_METRIC_HYSTERESIS, "on a stop it does");
  assert_covers(LAB_METRIC_HYSTERESIS_DEAD_BAND, 10, 0.2);
}

TEST(test_metrics__small_loop__says_how_small)
{
  measure_stairs((element){20e3, 0, 0, 0, 0}, (const double[]){0, 50, 20}, 3, 1);
  assert_covers(LAB_METRIC_DEAD_BAND, 10, 0.6);
  assert_denied(LAB_METRIC_HYSTERESIS_DEAD_BAND, "the largest slow one covers 20 %");
}

TEST(test_metrics__turn_between_rows__not_known)
{
  element e = {20e3, 0, 0, 0, 0};
  record_new(LAB_COMMAND_SET_PRESSURE);
  stairs(&e, (const double[]){0, 60}, 2, 5);
  hold(&e, 10, 12);
  hold(&e, 9, 12);
  hold(&e, 8, 12);
  record_measure();
  assert_denied(LAB_METRIC_DEAD_BAND, "between rows");
}

TEST(test_metrics__one_movement__no_resolution)
{
  element e = {0, 0, 0, 0, 0};
  record_new(LAB_COMMAND_SET_PRESSURE);
  for (e.x = 0; record.n < 480;) {
    hold(&e, 30, 60);
    hold(&e, 60, 60);
  }
  record_measure();
  assert_denied(LAB_METRIC_RESOLUTION, "twice in the same direction");
}

TEST(test_metrics__valve_that_snaps__no_line)
{
  measure_stairs((element){20e3, 0, 190e3, 0, 0}, (const double[]){-10, 110, -10}, 3, 2);
  assert_denied(LAB_METRIC_LINEARITY, "too little of the loop");
}

TEST(test_metrics__no_signal_to_set_it_against__says_so)
{
  element e = {20e3, 0, 0, 0, 0};
  record_new(LAB_COMMAND_OPENING);
  ramps(&e, (const double[]){-10, 110}, 2, 1);
  record.p = NULL;
  record_measure();
  assert_denied(LAB_METRIC_DEAD_BAND, "no chamber pressure, which is the signal of a bare actuator");
  assert_denied(LAB_METRIC_LINEARITY, "no chamber pressure");
  record.p = record_p;
  record.signal_high = record.signal_low;
  record_measure();
  assert_denied(LAB_METRIC_RESOLUTION, "the bench set, the span of the signal, is not known");
  record_new(LAB_COMMAND_SET_PRESSURE);
  hold(&e, 10, 100);
  record_measure();
  assert_denied(LAB_METRIC_DEAD_BAND, "no staircase");
}
