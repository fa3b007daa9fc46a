/* tests/second: the virtual rig under its positioner, and a rig that becomes another one. */
#include "../check.h"

#include "cases.h"

/* A stem that follows its set position: R1-400, with room above the piston. */
static second_rig follower(void)
{
  second_rig g = second_rig_default_r1_400();
  g.flow = SECOND_CHOKED;
  g.dead_volume = 40e-6;
  g.step = 100e-6;
  return g;
}

static const second_positioner proportional = {
    .gain = 20, .dead_band = 0.005, .cutoff_low = 0.01, .cutoff_high = 0.99, .cycle = 1e-3};

/* Set position from the start.  Out: got */
static void follow(const second_rig *g, const second_positioner *k, double set, double t_end, double dt)
{
  const double t0 = 0.0;
  const second_course course = {.t_cmd = &t0, .u_cmd = &set, .n = 1, .positioner = k};
  const second_log log = {got.t, got.u, got.p, got.x, got.T, got.m, got.v};
  second_audit audit;
  got.n = second_samples(t_end, dt);
  assert_true(got.n <= CASE_SAMPLES);
  assert_int_equal(second_follow(g, &course, t_end, dt, &log, &audit), 0);
  assert_int_equal(audit.forced, 0);
}

TEST(test_second_follow__proportional__comes_to_its_dead_band)
{
  const second_rig g = follower();
  follow(&g, &proportional, 0.6, 15, 0.01);
  assert_between(0.6 - case_last(got.x) / g.stroke, -0.005, 0.005);
  assert_close(case_last(got.u), 0, 0, 0);
  assert_close(case_last(got.v), 0, 1e-12, 0);
}

/* Of rows outside the dead band; u was sent up to a cycle before. */
TEST(test_second_follow__proportional__sends_gain_times_error)
{
  const second_rig g = follower();
  size_t i, partial = 0;
  follow(&g, &proportional, 0.6, 15, 0.01);
  for (i = 1; i < got.n; i++) {
    const double e = 0.6 - got.x[i] / g.stroke, moved = 20 * fabs(got.v[i]) * 1e-3 / g.stroke;
    if (fabs(e) > 0.006)
      assert_close(got.u[i], fmin(fmax(20 * e, -1), 1), 2 * moved + 1e-9, 0);
    partial += got.u[i] > 0 && got.u[i] < 1;
  }
  assert_true(partial > 10);
}

TEST(test_second_follow__integral__stands_still_while_clipped)
{
  const second_rig g = follower();
  second_positioner k = proportional;
  double high = 0;
  size_t i;
  k.integral_time = 1;
  k.dead_band = 0;
  follow(&g, &k, 0.6, 15, 0.01);
  for (i = 0; i < got.n; i++)
    high = fmax(high, got.x[i]);
  assert_between(0.6 - case_last(got.x) / g.stroke, -0.0051, 0.0051);
  assert_between(high / g.stroke, 0.59, 0.65); /* wound up over the stroke, it would go to its end */
}

/* The first cycle's integral is where it began and the share of that cycle; without an integral it is nothing. */
TEST(test_second_follow__integral_start__is_sent_from_the_start)
{
  const second_rig g = follower();
  second_positioner k = {.gain = 5, .integral_time = 2, .integral_start = 0.02, .cutoff_high = 2, .cycle = 1e-3};
  follow(&g, &k, 0.05, 2e-3, 1e-3);
  assert_close(got.u[1], 5 * (0.05 + 0.02 + 0.05 * 1e-3 / 2), 1e-15, 0);
  k.integral_time = 0;
  follow(&g, &k, 0.05, 2e-3, 1e-3);
  assert_close(got.u[1], 5 * 0.05, 1e-15, 0);
}

TEST(test_second_follow__beyond_the_cut_offs__is_shut_or_open)
{
  const second_rig g = follower();
  follow(&g, &proportional, 0.009, 1, 0.01);
  assert_close(case_last(got.u), -1, 0, 0);
  assert_close(case_last(got.x), 0, 0, 0);
  follow(&g, &proportional, 0.991, 15, 0.01);
  assert_close(case_last(got.u), 1, 0, 0);
  assert_close(case_last(got.x), g.stroke, 0, 1e-12);
}

/* The gas hears of a command a dead time after the log does. */
TEST(test_second_follow__dead_time__is_between_log_and_gas)
{
  second_rig g = follower();
  size_t i = 0;
  g.dead_time = 0.0304;
  follow(&g, &proportional, 0.6, 0.1, 1e-3);
  assert_close(got.u[1], 1, 0, 0);
  while (got.p[i] < 1)
    i++;
  assert_close(got.t[i], 0.031, 1e-9, 0);
}

/* A vessel that begins to leak: the pressure stands, then falls by its choked flow, P exp(-t/tau). */
TEST(test_second_follow__leak_that_begins__empties_from_then_on)
{
  second_rig g = case_vessel(SECOND_ISOTHERMAL, SECOND_CHOKED), later;
  second_course course = {.later = &later, .change = 1.2345};
  const second_log log = {.t = got.t, .p = got.p};
  size_t i;
  double tau;
  g.start_pressure = 800e3;
  later = g;
  later.leak_area = 2e-6;
  tau = g.dead_volume / (case_choked(&g) * later.leak_area * sqrt(case_rt(&g)));
  assert_int_equal(second_follow(&g, &course, 3, 1e-3, &log, NULL), 0);
  for (i = 0; i <= 3000; i++)
    assert_close(got.p[i] + g.ambient, 800e3 * exp(-fmax(0, got.t[i] - 1.2345) / tau), 0, 1e-9);
}
