/* apps/study/alone: what a log says by itself, of rigs of the independent simulator */
#include "../scratch.h"
#include "../virtual.h"

#include "../../apps/study/alone.h"

enum { ROWS = 401, COMMANDS = 3 };
static const double spacing = 0.05; /* [s] */

static lab_rig rig;

/* A log of a rig with so many times the declared preload, whose position is shown late by a time constant [s]. */
static const char *log_of(double preload, double lag)
{
  static const double t_cmd[COMMANDS] = {0.402, 8.003, 14.507}, u_cmd[COMMANDS] = {1, -1, 0.5};
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = COMMANDS};
  second_rig g = virtual_rig(5);
  const char *path = scratch_path("alone.csv");
  g.spring_preload *= preload;
  g.position_lag = lag;
  virtual_write(&g, &course, (ROWS - 1) * spacing, spacing, path);
  return path;
}

static void declare(void)
{
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
}

TEST(test_alone_fit_log__preload_of_this_log__is_found_and_only_noise_left)
{
  const double truth = 1.2 * 0.01;
  alone_fit fit;
  declare();
  succeed(alone_fit_log(&rig, log_of(1.2, 0), LAB_CHANNEL_X, &fit, &error));
  assert_int_equal(fit.n, 1);
  assert_string_equal(fit.value[0].name, "spring_preload");
  assert_true(fit.value[0].half > 0 && fit.value[0].half < 0.01 * truth);
  assert_close(fit.value[0].value, truth, fit.value[0].half, 0);
  assert_close(fit.left, 2e-5, 0, 0.1);
  assert_close(fit.in_noise, 1, 0, 0.1);
  assert_true(fit.common > 10 * fit.left);
}

TEST(test_alone_fit_log__value_of_each_log__is_found_as_well)
{
  alone_fit fit;
  declare();
  rig.fit_per_log[0] = 1;
  succeed(alone_fit_log(&rig, log_of(0.8, 0), LAB_CHANNEL_X, &fit, &error));
  assert_int_equal(fit.n, 1);
  assert_close(fit.value[0].value, 0.8 * 0.01, fit.value[0].half, 0);
  assert_close(fit.common, fit.left, 0, 1e-3);
  assert_close(fit.left, 2e-5, 0, 0.1);
}

/* The preload is right, so that nothing but the lag is missing. */
TEST(test_alone_fit_sensor__position_that_lags__is_shown_through_it)
{
  static const double lag = 0.08;
  alone_fit fit;
  declare();
  succeed(alone_fit_sensor(&rig, log_of(1, lag), "position_lag.position_time", LAB_CHANNEL_X, &fit, &error));
  assert_int_equal(fit.n, 1);
  assert_string_equal(fit.value[0].name, "position_lag.position_time");
  assert_true(fit.value[0].half < 0.1 * lag);
  assert_close(fit.value[0].value, lag, fit.value[0].half, 0);
  assert_close(fit.left, 2e-5, 0, 0.1);
}

TEST(test_alone_fit_sensor__what_is_no_lag__is_not_made_one)
{
  alone_fit fit;
  declare();
  succeed(alone_fit_sensor(&rig, log_of(1.2, 0), "position_lag.position_time", LAB_CHANNEL_X, &fit, &error));
  assert_true(fit.left > 10 * 2e-5);
}

TEST(test_alone_fit_sensor__unknown_parameter__is_refused)
{
  alone_fit fit;
  declare();
  assert_fails(alone_fit_sensor(&rig, log_of(1, 0), "no_such", LAB_CHANNEL_X, &fit, &error), LAB_DATA, "no_such");
}
