/* Sensors that drift: a line within its tolerance is taken out of a residual as its prior says. */
#include "../../fixture.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/drift.h"
#include "../../../apps/lab/fit/errors.h"

enum { ROWS = 41, GAP = 7 };
static const double sigma = 300, tolerance = 350; /* [Pa] of the R1-400's default: 0.25 % of 140 kPa */

static lab_rig rig;
static lab_log one_log;
static lab_run run;
static double t[ROWS], command[ROWS], p[ROWS], weight[ROWS];

static void open_run(void)
{
  int i;
  lab_rig_default(&rig);
  rig.params.supply_pressure = 140000;
  one_log = virtual_log(ROWS, t, command, p, NULL);
  for (i = 0; i < ROWS; i++) {
    t[i] = 0.1 * i + 3;
    p[i] = i == GAP ? NAN : 0;
    weight[i] = 1;
  }
  memset(&run, 0, sizeof run);
  run.rig = &rig;
  run.log = &one_log;
  run.n = ROWS;
  run.n_channels = 1;
  run.channel[0] = LAB_CHANNEL_P;
  run.sigma[0] = sigma;
  run.weight = weight;
  succeed(lab_drift_open(&run, &error));
}

static void close_run(void)
{
  free(run.drift);
  run.drift = NULL;
}

/* w: what a drift of one tolerance adds, over the noise. */
static double line(int i)
{
  return i == GAP ? 0 : tolerance / sigma * (double)i / (ROWS - 1);
}

static double dot(const double *a, double (*b)(int), const double *c)
{
  double sum = 0;
  int i;
  for (i = 0; i < ROWS; i++)
    sum += a[i] * (b ? b(i) : c[i]);
  return sum;
}

/* r'(1 + w w')^-1 r = r'r - (w'r)^2/(1 + w'w), by Sherman and Morrison. */
TEST(test_lab_drift_take_out__any_residual__has_the_size_that_its_prior_gives)
{
  double r[ROWS], before[ROWS], w[ROWS], along, length2;
  uint64_t seed = 4;
  int i;
  open_run();
  for (i = 0; i < ROWS; i++) {
    r[i] = before[i] = i == GAP ? 0 : fixture_random(&seed, -2, 3);
    w[i] = line(i);
  }
  along = dot(before, line, NULL);
  length2 = dot(w, line, NULL);
  lab_drift_take_out(&run, r);
  assert_close(dot(r, NULL, r), dot(before, NULL, before) - along * along / (1 + length2), 0, 1e-12);
  assert_close(r[GAP], 0, 0, 0);
  close_run();
}

/* All of it but 1/(1 + w'w), which the prior takes. */
TEST(test_lab_drift_strain__drift_of_seven_tolerances__is_found)
{
  lab_unknowns *u = calloc(1, sizeof *u);
  double r[ROWS], w[ROWS], length2;
  int i;
  open_run();
  assert_non_null(u);
  u->run = &run;
  u->n_runs = 1;
  for (i = 0; i < ROWS; i++) {
    w[i] = line(i);
    r[i] = 7 * w[i];
  }
  length2 = dot(w, line, NULL);
  lab_drift_take_out(&run, r);
  assert_close(lab_drift_strain(u, r), 7 * length2 / (1 + length2), 0, 1e-10);
  close_run();
  assert_close(lab_drift_strain(u, r), 0, 0, 0); /* without lines there is no drift */
  free(u);
}

/* A rig at rest whose sensor of pressure drifts by two tolerances, 1 kPa each, beside a noise of 320 Pa: the errors
 * that are shown are noise, without a prior's 1/(1 + w'w) of the line; those of a run without lines have it all. */
TEST(test_lab_errors_without_drift__sensor_that_drifts__leave_its_line_out)
{
  enum { LONG = 2001 };
  static const double t_cmd[] = {99}, u_cmd[] = {1}, spacing = 0.01, reach = 2000;
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = 1};
  const second_rig g = virtual_rig(7);
  const char *path = scratch_path("drift.csv");
  lab_unknowns *u = calloc(1, sizeof *u);
  lab_errors with, without;
  lab_log seen;
  size_t i;
  assert_non_null(u);
  virtual_write(&g, &course, (LONG - 1) * spacing, spacing, path);
  virtual_declare(&rig);
  succeed(lab_log_read(path, &rig.log, 101325, &seen, &error));
  for (i = 0; i < LONG; i++)
    seen.value[LAB_CHANNEL_P][i] += reach * (double)i / (LONG - 1);
  succeed(lab_run_open(&rig, &seen, 0, &run, &error));
  lab_unknowns_none(&rig, &run, 1, u);
  succeed(lab_errors_without_drift(u, &with, &error));
  succeed(lab_drift_open(&run, &error));
  succeed(lab_errors_without_drift(u, &without, &error));
  assert_close(with.in_noise[LAB_CHANNEL_P], sqrt(1 + reach * reach / 3 / (320 * 320)), 0, 0.03);
  assert_close(without.in_noise[LAB_CHANNEL_P], 1, 0, 0.03);
  assert_close(without.in_noise[LAB_CHANNEL_X], with.in_noise[LAB_CHANNEL_X], 0, 0.001);
  lab_run_close(&run);
  lab_log_free(&seen);
  free(u);
}

TEST(test_lab_drift_open__no_tolerance__takes_nothing)
{
  double r[ROWS], before[ROWS];
  int i;
  open_run();
  rig.tolerance[LAB_PRESSURE_DRIFT] = 0;
  succeed(lab_drift_open(&run, &error));
  for (i = 0; i < ROWS; i++)
    r[i] = before[i] = i;
  lab_drift_take_out(&run, r);
  assert_memory_equal(r, before, sizeof r);
  close_run();
}
