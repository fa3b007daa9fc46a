/* Single values that neither the model nor their neighbours know of, in a log that the model itself has made. */
#include "../../fixture.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/outliers.h"

enum { ROWS = 401, OPENED = 20, CLOSED = 200 };
static const double spacing = 0.01; /* [s] */
static const double sigma_p = 300, sigma_x = 2e-5;

static lab_rig rig;
static lab_unknowns u;
static lab_run run;
static lab_log run_log;
static lab_outliers out;
static double t[ROWS], command[ROWS], p[ROWS], x[ROWS];
static int line[ROWS];
static uint64_t seed = 5;

/* What the rig makes of the commands, with a fifth of the noise that is declared. */
static void measure(void)
{
  double y[2 * ROWS], early[2] = {0, 0};
  int i;
  succeed(lab_run_predict(&run, &(lab_episode){0, &rig}, 1, early, u.tol, y, &error));
  for (i = 0; i < ROWS; i++) {
    p[i] = y[i] + 0.2 * sigma_p * fixture_normal(&seed);
    x[i] = y[ROWS + i] + 0.2 * sigma_x * fixture_normal(&seed);
  }
}

/* The R1-400 filled and vented; the model knows every value. */
static int open_log(void **state)
{
  int i;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.noise[LAB_CHANNEL_P] = sigma_p;
  rig.noise[LAB_CHANNEL_X] = sigma_x;
  run_log = virtual_log(ROWS, t, command, p, x);
  run_log.line = line;
  for (i = 0; i < ROWS; i++) {
    t[i] = spacing * i;
    line[i] = i + 2;
    command[i] = i < OPENED ? 0 : i < CLOSED ? 1 : -1;
    p[i] = x[i] = 0;
  }
  succeed(lab_run_open(&rig, &run_log, 0, &run, &error));
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  for (i = 0; i < u.n; i++)
    u.unknown[i].value = 0; /* commands at their rows */
  measure();
  return 0;
}

static int close_log(void **state)
{
  lab_outliers_free(&out);
  memset(&out, 0, sizeof out);
  lab_run_close(&run);
  return 0;
}

#define CASE(name) TEST_WITH(name, open_log, close_log)

static void take(size_t expected)
{
  succeed(lab_outliers_take(&u, &run_log, &out, &error));
  assert_int_equal(out.n, expected);
}

/* ---- What is taken ---- */

CASE(test_lab_outliers_take__log_of_the_model__has_none)
{
  take(0);
  assert_int_equal(out.limitations.n, 0);
}

CASE(test_lab_outliers_take__beyond_seven_deviations__is_taken)
{
  p[100] += 8 * sigma_p; /* in a stroke */
  x[300] -= 8 * sigma_x;
  p[50] += 6 * sigma_p;
  take(2);
  assert_true(isnan(p[100]));
  assert_true(isnan(x[300]));
  assert_false(isnan(p[50]));
}

CASE(test_lab_outliers_take__in_other_noise__has_its_size_for_measure)
{
  int i;
  for (i = 0; i < ROWS; i++)
    p[i] += 3 * sigma_p * fixture_normal(&seed); /* three times what is declared */
  p[100] += 15 * sigma_p;
  p[250] += 36 * sigma_p;
  take(1);
  assert_true(isnan(p[250]));
}

CASE(test_lab_outliers_take__two_side_by_side__are_both_taken)
{
  p[100] += 30 * sigma_p;
  p[101] += 50 * sigma_p;
  x[299] += 12 * sigma_x;
  x[301] -= 40 * sigma_x;
  take(4);
  assert_true(isnan(p[100]) && isnan(p[101]) && isnan(x[299]) && isnan(x[301]));
}

CASE(test_lab_outliers_take__soon_after_a_command__are_counted)
{
  x[OPENED + 4] += 30 * sigma_x;
  x[OPENED + 5] += 20 * sigma_x;
  p[CLOSED + 20] += 30 * sigma_p;
  take(3);
  assert_int_equal(out.n_soon, 1);
}

/* ---- What is not ---- */

CASE(test_lab_outliers_take__three_rows__may_be_an_effect)
{
  p[100] += 30 * sigma_p;
  p[101] += 30 * sigma_p;
  p[102] += 30 * sigma_p;
  take(0);
}

CASE(test_lab_outliers_take__a_step__stays)
{
  int i;
  for (i = 150; i < ROWS; i++)
    p[i] += 50 * sigma_p;
  take(0);
}

CASE(test_lab_outliers_take__misfit_at_the_corners__stays)
{
  rig.params.spring_preload *= (pneu_real)1.1;
  rig.params.dry_friction *= (pneu_real)0.5;
  measure();
  take(0);
}

/* A peak of one row that only the model has is its mistake. */
CASE(test_lab_outliers_take__a_peak_of_the_model__is_no_outlier)
{
  run_log.value[LAB_CHANNEL_U][100] = -1; /* vents for one row */
  run_log.value[LAB_CHANNEL_U][101] = 1;
  lab_run_close(&run);
  succeed(lab_run_open(&rig, &run_log, 0, &run, &error));
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  take(0);
}

CASE(test_lab_outliers_take__a_converter_that_flickers__stays)
{
  const double step = 20 * sigma_x;
  int i;
  for (i = 0; i < ROWS; i++)
    x[i] = step * floor(x[i] / step + 0.5);
  x[10] += step;
  take(0);
}

CASE(test_lab_outliers_take__more_than_a_fiftieth__stays)
{
  int i;
  for (i = 5; i < 8 * 40; i += 40)
    p[i] += 100 * sigma_p;
  take(8);
  lab_outliers_put_back(&out);
  p[350] += 100 * sigma_p;
  take(0);
}

CASE(test_lab_outliers_take__a_gap__is_none)
{
  p[100] = p[101] = (double)NAN;
  p[103] += 50 * sigma_p;
  take(1);
  assert_close(out.taken[0].place - p, 103, 0, 0);
}

/* ---- What is said, and put back ---- */

CASE(test_lab_outliers_take__says__how_many_and_where)
{
  p[100] += 30 * sigma_p;
  p[300] += 30 * sigma_p;
  x[350] += 30 * sigma_x;
  take(3);
  assert_int_equal(out.limitations.n, 2);
  assert_contains(out.limitations.text[0], "log.csv: 2 values of channel p ");
  assert_contains(out.limitations.text[0], "line 102 (t = 1 s)");
  assert_contains(out.limitations.text[1], "log.csv: 1 value of channel x ");
  assert_contains(out.limitations.text[1], "line 352 (t = 3.5 s)");
}

CASE(test_lab_outliers_put_back__after_two_takes__is_as_before)
{
  double before[ROWS];
  p[100] += 30 * sigma_p;
  p[300] += 30 * sigma_p;
  memcpy(before, p, sizeof p);
  take(2);
  p[200] += 30 * sigma_p;
  before[200] = p[200];
  take(3);
  lab_outliers_put_back(&out);
  assert_int_equal(out.n, 0);
  assert_memory_equal(before, p, sizeof p);
}
