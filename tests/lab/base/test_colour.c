/* Noise with memory: its innovations against a dense covariance matrix, and its estimate from noise of known colour. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/base/colour.h"

enum { DENSE = 24, N = 1600 };

static double y[N];

/* Noise of a deviation about a level, on a ramp. */
static void fill(lab_colour c, double sigma, double ramp, uint64_t seed)
{
  double slow = fixture_normal(&seed);
  int i;
  for (i = 0; i < N; i++) {
    y[i] = sigma * (sqrt(1 - c.share) * fixture_normal(&seed) + sqrt(c.share) * slow) + 50 + ramp * i;
    slow = c.memory * slow + sqrt(1 - c.memory * c.memory) * fixture_normal(&seed);
  }
}

/* ---- Innovations ---- */

/* r' V^-1 r and log det V by Cholesky's method, over the rows that are no gaps. */
static double dense(const lab_colour *c, const double *r, double *log_size)
{
  double v[DENSE][DENSE], z[DENSE], sum = 0;
  int at[DENSE], n = 0, i, j, k;
  for (i = 0; i < DENSE; i++)
    if (r[i] != 0)
      at[n++] = i;
  for (*log_size = 0, i = 0; i < n; i++) {
    for (j = 0; j <= i; j++) {
      v[i][j] = c->share * pow(c->memory, at[i] - at[j]) + (i == j ? 1 - c->share : 0);
      for (k = 0; k < j; k++)
        v[i][j] -= v[i][k] * v[j][k];
      v[i][j] = i == j ? sqrt(v[i][i]) : v[i][j] / v[j][j];
    }
    for (z[i] = r[at[i]], k = 0; k < i; k++)
      z[i] -= v[i][k] * z[k];
    z[i] /= v[i][i];
    sum += z[i] * z[i];
    *log_size += 2 * log(v[i][i]);
  }
  return sum;
}

TEST(test_lab_colour_whiten__any_colour_with_gaps__has_the_likelihood_of_a_dense_matrix)
{
  static const lab_colour colour[] = {{0.9, 0.5}, {0.6, 1}, {-0.5, 0.3}, {0.99, 0.1}, {0.2, 0.9}};
  uint64_t seed = 7;
  int k, i;
  for (k = 0; k < COUNT(colour); k++) {
    double r[DENSE], white[DENSE], want, want_log, sum = 0, log_size;
    for (i = 0; i < DENSE; i++)
      r[i] = white[i] = i == 5 || (i > 10 && i < 15) ? 0 : fixture_normal(&seed);
    want = dense(&colour[k], r, &want_log);
    log_size = lab_colour_whiten(&colour[k], white, DENSE);
    for (i = 0; i < DENSE; i++)
      sum += white[i] * white[i];
    check_note("memory %g, share %g", colour[k].memory, colour[k].share);
    assert_close(sum, want, 0, 1e-10);
    assert_close(log_size, want_log, 1e-10, 0);
    assert_close(white[5], 0, 0, 0);
  }
}

/* All of the noise has memory 0.6: r_i = (e_i - 0.6 e_(i-1))/0.8. */
TEST(test_lab_colour_whiten__no_white_part__is_the_closed_form)
{
  const lab_colour c = {0.6, 1};
  double r[DENSE], white[DENSE];
  uint64_t seed = 3;
  int i;
  for (i = 0; i < DENSE; i++)
    r[i] = white[i] = fixture_normal(&seed);
  lab_colour_whiten(&c, white, DENSE);
  assert_close(white[0], r[0], 1e-12, 0);
  for (i = 1; i < DENSE; i++)
    assert_close(white[i], (r[i] - 0.6 * r[i - 1]) / 0.8, 1e-9, 0);
}

/* Of a sample, by the definition. */
TEST(test_lab_colour_second_difference__sample__is_its_mean_square)
{
  const lab_colour c = {0.7, 0.8};
  double sum = 0;
  int i;
  fill(c, 1, 0, 11);
  for (i = 2; i < N; i++)
    sum += pow(y[i] - 2 * y[i - 1] + y[i - 2], 2) / 6;
  assert_close(lab_colour_second_difference(&c), sum / N, 0, 0.1); /* 1,600 values, each in three differences */
}

/* ---- Estimate ---- */

static lab_colour estimate(int rows, double *scale)
{
  lab_stretch rest[N];
  lab_colour c;
  int k, n = N / rows;
  for (k = 0; k < n; k++)
    rest[k] = (lab_stretch){y + k * rows, (size_t)rows};
  succeed(lab_colour_estimate(rest, n, &c, scale, &error));
  return c;
}

/* Levels and trends of the stretches, and gaps, do not matter. Bounds: four standard errors of the correlation from row
 * to row, 1/sqrt(N), and of the deviation of values of which one in (1 + m)/(1 - m) is independent. */
TEST(test_lab_colour_estimate__known_colour__is_found)
{
  static const lab_colour colour[] = {{0.6, 1}, {0.9, 0.5}, {0.9, 1}, {0.95, 0.3}, {-0.5, 1}};
  int k, i;
  for (k = 0; k < COUNT(colour); k++) {
    const double m = fabs(colour[k].memory), once = (1 + m) / (1 - m);
    double scale = 0;
    lab_colour c;
    fill(colour[k], 2, 0.01, (uint64_t)k + 1);
    for (i = 0; i < N; i += 97)
      y[i] = NAN;
    c = estimate(400, &scale);
    check_note("memory %g, share %g", colour[k].memory, colour[k].share);
    assert_close(c.memory * c.share, colour[k].memory * colour[k].share, 4 / sqrt(N), 0);
    assert_close(scale, 2, 0, 4 * sqrt(once / 2 / N));
  }
}

TEST(test_lab_colour_estimate__white_noise__has_no_memory)
{
  int seed;
  for (seed = 1; seed <= 30; seed++) {
    double scale = 3;
    fill((lab_colour){0, 0}, 2, 0.01, (uint64_t)seed * 1000003);
    assert_close(estimate(200, &scale).memory, 0, 0, 0);
    assert_close(scale, 3, 0, 0); /* unchanged */
  }
}

/* A swing is no noise: it does not get whiter by a memory of one row. */
TEST(test_lab_colour_estimate__swing__is_no_colour)
{
  double scale = 3;
  int i;
  fill((lab_colour){0, 0}, 1, 0, 5);
  for (i = 0; i < N; i++)
    y[i] += 3 * sin(0.2 * i);
  assert_close(estimate(400, &scale).memory, 0, 0, 0);
}

TEST(test_lab_colour_estimate__stretch_in_which_something_moves__does_not_count)
{
  double scale = 0;
  int i;
  fill((lab_colour){0.9, 0.5}, 2, 0, 9);
  for (i = 600; i < 800; i++)
    y[i] += 40 * exp(-0.05 * (i - 600));
  estimate(200, &scale);
  assert_close(scale, 2, 0, 0.2);
}

/* The whole memory is longer than an eighth of a stretch. */
TEST(test_lab_colour_estimate__short_stretches__tell_a_long_memory)
{
  int seed;
  for (seed = 1; seed <= 10; seed++) {
    double scale = 0;
    fill((lab_colour){0.9, 0.8}, 2, 0.01, (uint64_t)seed * 7919);
    check_note("seed %d", seed);
    assert_between(estimate(60, &scale).memory, 0.8, 1);
    assert_close(scale, 2, 0, 0.15);
  }
}

/* What a model lacks comes to rest after each move of the stem, the one way after a stroke up and the other after one
 * down. */
TEST(test_lab_colour_estimate__what_settles_in_every_stretch__is_no_colour)
{
  double scale = 3, size;
  int rows, i, seed;
  for (size = 1; size <= 4; size *= 2)
    for (rows = 60; rows <= 240; rows *= 2)
      for (seed = 1; seed <= 10; seed++) {
        fill((lab_colour){0, 0}, 1, 0, (uint64_t)seed * 104729);
        for (i = 0; i < N; i++)
          y[i] += size * ((i / rows) % 2 ? -1 : 1.5) * exp(-(3.0 + (i / rows) % 4 * 2) * (i % rows) / rows);
        check_note("size %g, %d rows, seed %d", size, rows, seed);
        assert_close(estimate(rows, &scale).memory, 0, 0, 0);
      }
}

/* A stem that arrives later than its model. */
TEST(test_lab_colour_estimate__late_arrivals__are_no_colour)
{
  double scale = 3;
  int rows = 80, i, seed;
  for (seed = 1; seed <= 10; seed++) {
    fill((lab_colour){0, 0}, 1, 0, (uint64_t)seed * 15485863);
    for (i = 0; i < N; i++)
      if (i % rows < 4 + (i / rows) * 7 % 20)
        y[i] += ((i / rows) % 2 ? -1.5 : 1.5) * (1 + i / rows % 3);
    check_note("seed %d", seed);
    assert_close(estimate(rows, &scale).memory, 0, 0, 0);
  }
}

/* A stem that still moves about, to and fro, slower than an eighth of 400 rows. */
TEST(test_lab_colour_estimate__memory_without_end__is_no_colour)
{
  double scale = 3;
  int seed, i;
  for (seed = 1; seed <= 10; seed++) {
    uint64_t own = (uint64_t)seed * 32452843;
    double at = 0, to = 0;
    for (i = 0; i < N; i++) {
      if (i % 100 == 0)
        to = 3 * fixture_normal(&own);
      at += 0.03 * (to - at);
      y[i] = at + fixture_normal(&own);
    }
    check_note("seed %d", seed);
    assert_close(estimate(400, &scale).memory, 0, 0, 0);
  }
}

TEST(test_lab_colour_estimate__few_values__says_nothing)
{
  lab_stretch rest = {y, 99};
  lab_colour c;
  double scale = 3;
  fill((lab_colour){0.9, 1}, 2, 0, 2);
  succeed(lab_colour_estimate(&rest, 1, &c, &scale, &error));
  assert_close(c.memory, 0, 0, 0);
  rest.n = 300;
  succeed(lab_colour_estimate(&rest, 1, &c, &scale, &error));
  assert_true(c.memory > 0.5);
  succeed(lab_colour_estimate(&rest, 0, &c, &scale, &error));
  assert_close(c.memory, 0, 0, 0);
}
