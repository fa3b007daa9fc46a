/* Periods that a residual shows: sines of known size and period in noise, in one log or in several. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/trace/freeterms.h"

enum { ROWS = 6000, LOGS = 2 };
static const double spacing = 0.02, two_pi = 6.283185307179586;

static double t[LOGS][ROWS], r[4 * ROWS], period[LAB_PERIODS_MAX];
static lab_log log_of[LOGS];
static lab_run run[LOGS];
static lab_unknowns u;

/* A log of so many rows in which pressure and position are measured. */
static void open_log(int e, size_t n)
{
  size_t i;
  memset(&log_of[e], 0, sizeof log_of[e]);
  memset(&run[e], 0, sizeof run[e]);
  for (i = 0; i < n; i++)
    t[e][i] = 100 * e + spacing * (double)i;
  log_of[e].n = n;
  log_of[e].value[LAB_CHANNEL_TIME] = t[e];
  run[e].log = &log_of[e];
  run[e].n = n;
  run[e].n_channels = 2;
  run[e].channel[0] = LAB_CHANNEL_P;
  run[e].channel[1] = LAB_CHANNEL_X;
  u.run = run;
  u.n_runs = e + 1;
}

static void fill_with_noise(uint64_t seed)
{
  int i;
  for (i = 0; i < 4 * ROWS; i++)
    r[i] = fixture_normal(&seed);
}

/* Add a sine to a channel of n rows. */
static void add_sine(double *channel, int e, size_t n, double amplitude, double every, double phase)
{
  size_t i;
  for (i = 0; i < n; i++)
    channel[i] += amplitude * sin(two_pi * t[e][i] / every + phase);
}

/* Returns: the number of periods found, into `into`. */
static int find_cycles(const double *residual, double *into)
{
  int n;
  succeed(lab_residual_periods(&u, residual, into, &n, &error));
  return n;
}

/* Within a line of the periodogram, a quarter of what so long a log resolves. */
static void assert_period(double got, double want, double length)
{
  assert_close(1 / got, 1 / want, 0.25 / length, 0);
}

/* Rows of 1/51.5 s make a hum of 50 Hz one of 1.5 Hz. */
TEST(test_lab_residual_periods__where_a_hum_would_be_seen__is_no_cycle)
{
  enum { N = 2000 };
  const double every = 1 / 1.5;
  size_t i;
  open_log(0, N);
  fill_with_noise(7);
  add_sine(r, 0, N, 5, every, 1);
  assert_true(find_cycles(r, period) > 0 && fabs(1 / period[0] - 1.5) < 0.1);
  for (i = 0; i < N; i++)
    t[0][i] = (double)i / 51.5;
  fill_with_noise(7);
  add_sine(r, 0, N, 5, every, 1);
  if (find_cycles(r, period) > 0)
    assert_true(fabs(1 / period[0] - 1.5) > 0.1);
}

/* Noise of 2000 rows has a power of 1 on every line, a sine of 0.3 one of 45. */
TEST(test_lab_residual_periods__sine_in_noise__is_found_first)
{
  static const double amplitude[] = {0.3, 1, 5}, every[] = {0.21, 1.87, 9.3};
  enum { N = 2000 };
  int i, k, channel;
  open_log(0, N);
  for (i = 0; i < COUNT(amplitude); i++)
    for (k = 0; k < COUNT(every); k++)
      for (channel = 0; channel < 2; channel++) {
        fill_with_noise((uint64_t)(10 * i + k + 1));
        add_sine(r + channel * N, 0, N, amplitude[i], every[k], 0.4 * k);
        check_note("%g every %g s in channel %d", amplitude[i], every[k], channel);
        assert_true(find_cycles(r, period) > 0);
        assert_period(period[0], every[k], N * spacing);
      }
}

/* Single rows and a long stretch without values: a residual of 0. */
TEST(test_lab_residual_periods__gaps__do_not_hide_it)
{
  enum { N = 2000 };
  uint64_t seed = 3;
  int i;
  open_log(0, N);
  fill_with_noise(2);
  add_sine(r, 0, N, 0.5, 1.87, 1);
  for (i = 0; i < N; i++)
    if (fixture_random(&seed, 0, 1) < 0.2 || (i > 700 && i < 1100))
      r[i] = 0;
  assert_true(find_cycles(r, period) > 0);
  assert_period(period[0], 1.87, N * spacing);
}

/* Rows at other distances; a stretch that the log leaves out. */
TEST(test_lab_residual_periods__uneven_rows__do_not_hide_it)
{
  enum { N = 2000 };
  uint64_t seed = 4;
  int i;
  open_log(0, N);
  for (i = 1; i < N; i++)
    t[0][i] = t[0][i - 1] + spacing * fixture_random(&seed, 0.5, 1.5) + (i == 900 ? 5 : 0);
  fill_with_noise(5);
  add_sine(r + N, 0, N, 0.5, 1.87, 1);
  assert_true(find_cycles(r, period) > 0);
  assert_period(period[0], 1.87, t[0][N - 1] - t[0][0]);
}

/* More rows than cells: their means. */
TEST(test_lab_residual_periods__long_log__is_seen_in_cells)
{
  open_log(0, ROWS);
  fill_with_noise(6);
  add_sine(r, 0, ROWS, 0.3, 4.4, 2);
  assert_true(find_cycles(r, period) > 0);
  assert_period(period[0], 4.4, ROWS * spacing);
}

/* Their powers add up to 26, whatever the phases, where noise reaches 11. */
TEST(test_lab_residual_periods__two_logs_out_of_phase__add_up)
{
  enum { N = 2000, SHORT = 1300 };
  int i;
  for (i = 0; i < 8; i++) {
    open_log(0, N);
    open_log(1, SHORT);
    fill_with_noise((uint64_t)i + 20);
    add_sine(r, 0, N, 0.18, 1.87, 0);
    add_sine(r + 2 * N, 1, SHORT, 0.18, 1.87, 0.8 * i);
    check_note("phases apart by %g", 0.8 * i);
    assert_true(find_cycles(r, period) > 0);
    assert_period(period[0], 1.87, N * spacing);
  }
}

TEST(test_lab_residual_periods__two_sines__are_found_in_the_order_of_their_size)
{
  enum { N = 2000 };
  open_log(0, N);
  fill_with_noise(7);
  add_sine(r, 0, N, 1, 0.9, 0);
  add_sine(r, 0, N, 2, 3.1, 0);
  assert_true(find_cycles(r, period) > 1);
  assert_period(period[0], 3.1, N * spacing);
  assert_period(period[1], 0.9, N * spacing);
}

/* A slow drift is higher than any sine, but so are its surroundings. */
TEST(test_lab_residual_periods__drift__does_not_hide_it)
{
  enum { N = 2000 };
  uint64_t seed = 8;
  double walk = 0;
  int i;
  open_log(0, N);
  fill_with_noise(9);
  for (i = 0; i < N; i++)
    r[i] += walk += 0.5 * fixture_normal(&seed);
  add_sine(r, 0, N, 2, 0.9, 0);
  assert_true(find_cycles(r, period) > 0);
  assert_period(period[0], 0.9, N * spacing);
}

/* A single row, however far off, says nothing of cycles. */
TEST(test_lab_residual_periods__log_of_one_row__does_not_count)
{
  enum { N = 2000 };
  double alone[LAB_PERIODS_MAX];
  int n, i;
  open_log(0, N);
  fill_with_noise(11);
  add_sine(r, 0, N, 0.3, 1.87, 0);
  n = find_cycles(r, alone);
  assert_true(n > 1);
  open_log(1, 1);
  r[2 * N] = r[2 * N + 1] = 1e3;
  assert_int_equal(find_cycles(r, period), n);
  for (i = 0; i < n; i++)
    assert_close(period[i], alone[i], 0, 0);
}

/* Where noise has a line that stands out, it may be any: a tenth of them in each tenth, give or take four standard
 * deviations; and few of 228 lines stand out. */
TEST(test_lab_residual_periods__white_noise__prefers_no_period)
{
  enum { N = 480, TRIALS = 800 };
  const double length = (N - 1) * spacing, low = 3 / length, high = N / (8 * length);
  int count[10] = {0}, i, k, n, found = 0, lines = 0;
  open_log(0, N);
  for (i = 0; i < TRIALS; i++) {
    fill_with_noise((uint64_t)i + 100);
    n = find_cycles(r, period);
    for (k = 0; k < n; k++)
      assert_between(1 / period[k], low, high * (1 + 1e-12));
    lines += n;
    if (n == 0)
      continue;
    found++;
    k = (int)(10 * (1 / period[0] - low) / (high - low));
    count[k < 10 ? k : 9]++;
  }
  assert_between(found, TRIALS / 4, TRIALS);
  assert_true(lines < 6 * TRIALS);
  for (k = 0; k < 10; k++) {
    check_note("tenth %d", k);
    assert_close(count[k], found / 10.0, 4 * sqrt(0.09 * found), 0);
  }
}

/* Three cycles to a log and eight rows to a cycle. */
TEST(test_lab_residual_periods__too_short_a_log__has_none)
{
  static const size_t few[] = {2, 10, 24};
  int i;
  fill_with_noise(10);
  for (i = 0; i < COUNT(few); i++) {
    open_log(0, few[i]);
    check_note("%d rows", (int)few[i]);
    assert_int_equal(find_cycles(r, period), 0);
  }
  open_log(0, 200);
  add_sine(r, 0, 200, 2, 0.5, 0);
  assert_true(find_cycles(r, period) > 0);
  open_log(1, 10); /* too short for any cycle of its own */
  assert_true(find_cycles(r, period) > 0);
}
