/* Slopes in many instants from few simulations, beside those of one simulation each. */
#include "../../fixture.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/instants.h"
#include "../../../apps/lab/fit/unknowns.h"

enum { SWITCHES = 24, ROWS_EACH = 20, ROWS = SWITCHES * ROWS_EACH, DATA = 2 * ROWS };
static const double spacing = 0.05; /* [s] */

static lab_error error;
static lab_rig rig;
static lab_unknowns u;
static lab_run run;
static lab_log run_log;
static double t[ROWS], command[ROWS], p[ROWS], x[ROWS];
static double r[DATA + LAB_FIT_MAX], column[DATA + LAB_FIT_MAX], J[(DATA + LAB_FIT_MAX) * LAB_FIT_MAX];

/* One run in which the command alternates between two values, 1 s each; nothing is measured. */
static void open_run(double up, double down)
{
  int i;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.params.dead_volume = (pneu_real)4e-5;
  rig.params.fill_area *= 10;
  rig.params.vent_area *= 10;
  rig.noise[LAB_CHANNEL_P] = 300;
  rig.noise[LAB_CHANNEL_X] = 2e-5;
  run_log = virtual_log(ROWS, t, command, p, x);
  for (i = 0; i < ROWS; i++) {
    t[i] = spacing * i;
    command[i] = i < ROWS_EACH / 2 ? 0 : (i + ROWS_EACH / 2) / ROWS_EACH % 2 ? up : down;
    p[i] = x[i] = 0;
  }
  lab_run_close(&run);
  assert_int_equal(lab_run_open(&rig, &run_log, 0, &run, &error), LAB_OK);
  if (lab_unknowns_open(&rig, &run, 1, &u, &error))
    fail_msg("%s", error.text);
  assert_int_equal(u.n, SWITCHES);
}

/* Slopes at the middle of all rows.  Returns: how many are done together */
static int slopes(char done[LAB_FIT_MAX])
{
  double theta[LAB_FIT_MAX];
  int j, n = 0;
  for (j = 0; j < u.n; j++)
    theta[j] = u.unknown[j].value;
  memset(done, 0, LAB_FIT_MAX);
  assert_int_equal(lab_unknowns_residuals(&u, theta, r, &error), LAB_OK);
  assert_int_equal(lab_instants_slopes(&u, theta, J, done, &error), LAB_OK);
  for (j = 0; j < u.n; j++)
    n += done[j] != 0;
  return n;
}

/* Every stroke ends at the supply or at ambient, where what came before is forgotten. */
static void test_lab_instants_slopes__full_strokes__are_those_of_one_simulation_each(void **state)
{
  char done[LAB_FIT_MAX];
  double theta[LAB_FIT_MAX], size, off;
  int j;
  size_t i;
  (void)state;
  open_run(1, -1);
  assert_int_equal(slopes(done), SWITCHES);
  for (j = 0; j < u.n; j++)
    theta[j] = u.unknown[j].value;
  for (j = 0; j < u.n; j++) {
    check_note("%s", u.unknown[j].name);
    assert_int_equal(lab_unknowns_slope(&u, theta, r, j, column, &error), LAB_OK);
    for (size = off = 0, i = 0; i < u.m; i++) {
      size += column[i] * column[i];
      off += pow(J[(size_t)j * u.m + i] - column[i], 2);
    }
    assert_true(size > 0);
    assert_close(sqrt(off / size), 0, 1e-4, 0);
  }
}

/* Of a chamber that is filled step by step every instant is remembered to the end. */
static void test_lab_instants_slopes__what_is_remembered__is_left_alone(void **state)
{
  char done[LAB_FIT_MAX];
  (void)state;
  open_run(0.002, 0.001);
  assert_true(slopes(done) <= SWITCHES / 3); /* the last of each group */
}

static void test_lab_instants_slopes__seen_in_windows__are_left_alone(void **state)
{
  char done[LAB_FIT_MAX];
  (void)state;
  open_run(1, -1);
  lab_unknowns_view(&u, 8);
  assert_int_equal(slopes(done), 0);
}

static int close_run(void **state)
{
  (void)state;
  lab_run_close(&run);
  return 0;
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_instants_slopes__full_strokes__are_those_of_one_simulation_each),
      cmocka_unit_test(test_lab_instants_slopes__what_is_remembered__is_left_alone),
      cmocka_unit_test(test_lab_instants_slopes__seen_in_windows__are_left_alone)};
  return cmocka_run_group_tests(tests, NULL, close_run);
}
