/* A log that a model has not seen, of a rig whose preload was set anew. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/weights.h"
#include "../../../apps/lab/report/judge.h"

enum { ROWS = 401, COMMANDS = 3, FEW = 40 };
static const double spacing = 0.05; /* [s] */

static lab_rig rig;
static lab_log seen;
static lab_run run;

/* The log, its command after some rest, and its first stroke soon after that, of a rig with 1.2 times the declared
 * preload. */
static void open_log(double rest)
{
  const double t_cmd[COMMANDS] = {rest, 8.003, 14.507}, u_cmd[COMMANDS] = {1, -1, 0.5};
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = COMMANDS};
  second_rig g = virtual_rig(5);
  const char *path = scratch_path("held.csv");
  g.spring_preload *= 1.2;
  virtual_write(&g, &course, (ROWS - 1) * spacing, spacing, path);
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
  virtual_open(&rig, path, &seen, &run);
}

/* The instants of commands are not fitted there, so that more than noise is left either way. */
TEST(test_lab_judge__unseen_log__tells_its_own_value_by_its_start)
{
  lab_errors shared, own;
  size_t i;
  open_log(0.402);
  succeed(lab_judge(&rig, &run, 1, &shared, &error));
  rig.fit_per_log[0] = 1;
  succeed(lab_judge(&rig, &run, 1, &own, &error));
  assert_true(own.in_noise[LAB_CHANNEL_X] < 0.25 * shared.in_noise[LAB_CHANNEL_X]);
  assert_int_equal(shared.n, 2 * ROWS);
  assert_int_equal(own.n, 2 * (ROWS - FEW)); /* its first tenth is not judged */
  for (i = 0; i < 2 * ROWS; i++)
    assert_close(run.weight[i], 1, 0, 0);
}

/* A log that rests for a quarter begins to tell after that: until its stem has moved by a tenth. */
TEST(test_lab_judge__log_that_rests_for_long__starts_until_it_has_moved)
{
  lab_errors shared, own;
  open_log(5.002);
  succeed(lab_judge(&rig, &run, 1, &shared, &error));
  rig.fit_per_log[0] = 1;
  succeed(lab_judge(&rig, &run, 1, &own, &error));
  assert_in_range(own.n, 2 * (ROWS - 125), 2 * (ROWS - 101));
  assert_true(own.in_noise[LAB_CHANNEL_X] < 0.5 * shared.in_noise[LAB_CHANNEL_X]);
}

/* By its clock a row may be off by as much as the stem moves in that time. */
TEST(test_lab_weigh_unseen__rows_that_move__weigh_less)
{
  const double jitter = 0.01; /* [s] */
  double least = 1, fastest = 0;
  size_t i;
  open_log(0.402);
  succeed(lab_weigh_unseen(&rig, jitter, &run, 1, &error));
  for (i = 1; i + 1 < ROWS; i++) {
    const double *x = seen.value[LAB_CHANNEL_X];
    fastest = fmax(fastest, fabs(x[i + 1] - x[i - 1]) / (2 * spacing));
    least = fmin(least, run.weight[ROWS + i]);
  }
  assert_int_equal(run.channel[1], LAB_CHANNEL_X);
  assert_close(run.jitter, jitter, 0, 0);
  assert_close(least, 1 / hypot(1, jitter * fastest / 2e-5), 0, 0.15);
  for (i = 0; i < 7; i++) /* before the first command */
    assert_close(run.weight[ROWS + i], 1, 1e-3, 0);
}
