/* What drives the model without its noise: against the curve that the noise was added to. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/check/mend.h"

enum { ROWS = 400 };
static const double spacing = 0.1, sigma = 300; /* [s], [Pa] */

static lab_rig rig;
static lab_log log_made;
static lab_limitations limitations;

static double *column(const double *from)
{
  double *to = malloc(ROWS * sizeof *to);
  assert_non_null(to);
  memcpy(to, from, ROWS * sizeof *to);
  return to;
}

/* Up by 8 kPa/s from 10.03 s on, at rest from 20.06 s on: both bends are between two rows. */
static double ramp(double t)
{
  return 5e4 + 8e3 * fmin(fmax(t - 10.03, 0), 10.03);
}

/* What a chamber does when it is vented. */
static double decay(double t)
{
  return 3e5 * exp(-t / 12);
}

/* One run, p and x; x counts the rows. */
static void make(double (*curve)(double t), double noise)
{
  double t[ROWS], p[ROWS], x[ROWS];
  uint64_t seed = 11;
  int i;
  for (i = 0; i < ROWS; i++) {
    t[i] = i * spacing;
    x[i] = i;
    p[i] = curve(t[i]) + noise * fixture_normal(&seed);
  }
  lab_log_free(&log_made);
  log_made.n = ROWS;
  log_made.n_runs = 1;
  log_made.run = calloc(2, sizeof *log_made.run);
  log_made.line = calloc(ROWS, sizeof *log_made.line);
  assert_true(log_made.run && log_made.line);
  log_made.run[1] = ROWS;
  log_made.value[LAB_CHANNEL_TIME] = column(t);
  log_made.value[LAB_CHANNEL_P] = column(p);
  log_made.value[LAB_CHANNEL_X] = column(x);
  memset(&rig, 0, sizeof rig);
  rig.input[LAB_CHANNEL_P] = 1;
  rig.noise[LAB_CHANNEL_P] = noise;
  rig.noise[LAB_CHANNEL_X] = NAN;
}

static void smooth(void)
{
  log_made.path = malloc(8);
  assert_non_null(log_made.path);
  strcpy(log_made.path, "log.csv");
  succeed(lab_log_smooth_inputs(&rig, &log_made, &limitations, &error));
}

/* Root mean square of p less the curve, over the noise. */
static double left(double (*curve)(double t))
{
  double sum = 0;
  size_t i;
  for (i = 0; i < log_made.n; i++)
    sum += pow(log_made.value[LAB_CHANNEL_P][i] - curve(log_made.value[LAB_CHANNEL_TIME][i]), 2);
  return sqrt(sum / (double)log_made.n) / sigma;
}

static int done(void **state)
{
  lab_log_free(&log_made);
  memset(&limitations, 0, sizeof limitations);
  return 0;
}

#define CASE(name) TEST_WITH(name, NULL, done)

CASE(test_lab_log_smooth_inputs__curve__loses_most_of_its_noise)
{
  make(decay, sigma);
  assert_close(left(decay), 1, 0.1, 0);
  smooth();
  assert_between(left(decay), 0, 0.45);
  assert_close(log_made.smoothed[LAB_CHANNEL_P], sigma, 0, 0.15);
  assert_int_equal(limitations.n > 0, 1);
}

CASE(test_lab_log_smooth_inputs__bends_between_rows__are_told)
{
  size_t i, n = 0;
  make(ramp, sigma);
  smooth();
  assert_between(left(ramp), 0, 0.45);
  for (i = 0; i < log_made.n; i++) {
    const lab_bend *bend = &log_made.bend[LAB_CHANNEL_P][i];
    if (isnan(bend->t))
      continue;
    assert_close(bend->t, n++ ? 20.06 : 10.03, 0.04, 0);
    assert_between(bend->t, log_made.value[LAB_CHANNEL_TIME][i], log_made.value[LAB_CHANNEL_TIME][i + 1]);
    assert_close(bend->value, ramp(bend->t), 1.5 * sigma, 0);
  }
  assert_int_equal(n, 2);
}

CASE(test_lab_log_smooth_inputs__what_is_no_input_or_has_no_noise__stays)
{
  size_t i;
  make(decay, sigma);
  rig.input[LAB_CHANNEL_P] = 0;
  smooth();
  assert_close(left(decay), 1, 0.1, 0);
  assert_close(log_made.smoothed[LAB_CHANNEL_P], 0, 0, 0);
  make(decay, 0);
  smooth();
  for (i = 0; i < log_made.n; i++)
    assert_close(log_made.value[LAB_CHANNEL_P][i], decay(log_made.value[LAB_CHANNEL_TIME][i]), 0, 0);
}

CASE(test_lab_log_smooth_inputs__gaps__stay_gaps)
{
  size_t i, gaps = 0;
  make(decay, sigma);
  for (i = 100; i < 120; i++)
    log_made.value[LAB_CHANNEL_P][i] = NAN;
  smooth();
  for (i = 0; i < log_made.n; i++)
    gaps += isnan(log_made.value[LAB_CHANNEL_P][i]) != 0;
  assert_int_equal(gaps, 20);
  assert_true(isnan(log_made.value[LAB_CHANNEL_P][100]) && !isnan(log_made.value[LAB_CHANNEL_P][99]));
}
