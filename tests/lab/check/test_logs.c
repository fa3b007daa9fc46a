/* Which of u and set position drives a model. */
#include "../../fixture.h"
#include "../../scratch.h"

#include "../../../apps/lab/check/logs.h"

static lab_logs logs;
static lab_rig rig;

static const char both[] = "t [s],u [1],sp [mm],x [mm]\n0,0,0,0\n1,1,10,0.1\n2,0.5,10,5\n3,0,10,9.9\n4,0,10,10\n";
static const char gaps[] = "t [s],u [1],sp [mm],x [mm]\n0,0,0,0\n1,1,10,0.1\n2,0.5,,5\n3,0,,9.9\n4,0,,10\n";

/* The channel that drives, of a log with both.  Out: without_u  logs of which u is left out */
static int driver(const char *text, int has_positioner, int by_set_position, int *without_u)
{
  int command;
  lab_rig_default(&rig);
  rig.noise[LAB_CHANNEL_X] = 1e-5;
  if (has_positioner)
    fixture_set(&rig.params, "positioner.gain", 20);
  logs.by_set_position = by_set_position;
  scratch_text("log.csv", text);
  succeed(lab_logs_add(&logs, &rig, scratch_path("log.csv"), &error));
  command = lab_log_command(&logs.log[0]);
  *without_u = logs.n_without_u;
  lab_logs_close(&logs);
  logs.n_without_u = 0;
  return command;
}

TEST(test_lab_logs_add__u_and_set_position__the_latter_drives_where_asked_and_declared)
{
  int has_positioner, asked, without_u;
  for (has_positioner = 0; has_positioner < 2; has_positioner++)
    for (asked = 0; asked < 2; asked++) {
      assert_int_equal(driver(both, has_positioner, asked, &without_u),
                       has_positioner && asked ? LAB_CHANNEL_SP : LAB_CHANNEL_U);
      assert_int_equal(without_u, has_positioner && asked);
    }
}

/* It is written where it changes, and says nothing of the rows between. */
TEST(test_lab_logs_add__set_position_with_gaps__is_only_shown)
{
  int without_u;
  assert_int_equal(driver(gaps, 1, 1, &without_u), LAB_CHANNEL_U);
  assert_int_equal(without_u, 0);
}
