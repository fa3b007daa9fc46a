/* What the data say about each unknown: closed forms for lines, and the library's model with noise. */
#include "../../fixture.h"
#include "../../words.h"

#include "../../../apps/lab/base/quantile.h"
#include "../../../apps/lab/fit/spread.h"
#include "../../../apps/lab/run/response.h"

static lab_fit_result got; /* of the last fit */

enum { MOST = LAB_FIT_MAX };

/* Something to fit: a model of m residuals, which are divided by sigma. */
typedef struct trial {
  int n;
  lab_fit_param param[MOST];
  double start[MOST], lower[MOST], upper[MOST];
  size_t m;
  int (*model)(void *data, const double *theta, double *r, lab_error *e);
  void *data;
  const double *sigma; /* NULL: 1 */
  double step;         /* of the differences */
} trial;

static void add(trial *c, const char *name, double start, double lower, double upper)
{
  c->param[c->n] = (lab_fit_param){name, 0, 0};
  c->start[c->n] = start;
  c->lower[c->n] = lower;
  c->upper[c->n++] = upper;
}

static int residuals(void *context, const double *theta, double *r, lab_error *e)
{
  const trial *c = context;
  size_t i;
  const int status = c->model(c->data, theta, r, e);
  for (i = 0; c->sigma && i < c->m; i++)
    r[i] /= c->sigma[i];
  return status;
}

/* Central differences, one-sided at a bound. */
static int slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *e)
{
  const trial *c = context;
  const double h = c->step * (theta[j] != 0 ? fabs(theta[j]) : 1);
  double at[MOST], *other = malloc(c->m * sizeof *other), from, to;
  size_t i;
  int status;
  (void)r;
  memcpy(at, theta, (size_t)c->n * sizeof *at);
  at[j] = to = fmin(theta[j] + h, c->upper[j]);
  status = residuals(context, at, column, e);
  at[j] = from = fmax(theta[j] - h, c->lower[j]);
  if (status == LAB_OK)
    status = residuals(context, at, other, e);
  for (i = 0; i < c->m; i++)
    column[i] = (column[i] - other[i]) / (to - from);
  free(other);
  return status;
}

/* Fit to the last digit, and look at the end. */
static void fit(const trial *c, double *theta)
{
  const lab_fit_problem problem = {.n = c->n,
                                   .m = c->m,
                                   .lower = c->lower,
                                   .upper = c->upper,
                                   .context = (void *)c,
                                   .residuals = residuals,
                                   .slope = slope,
                                   .enough = 1e-30,
                                   .enough_share = 1e-14};
  double chi2;
  memcpy(theta, c->start, (size_t)c->n * sizeof *theta);
  if (lab_fit(&problem, theta, &chi2, &error) || lab_fit_spread(&problem, c->param, theta, &got, &error))
    fail_msg("%s", error.text);
}

/* ---- Quantiles ---- */

TEST(test_student_quantile__tables__agree)
{
  /* closed forms: 1 degree of freedom is Cauchy's tan(pi (p - 1/2)); with 2, (2p - 1)/sqrt(2 p (1 - p)) */
  assert_close(lab_student_quantile(0.975, 1), tan(3.14159265358979323846 * 0.475), 0, 1e-11);
  assert_close(lab_student_quantile(0.975, 2), 0.95 / sqrt(2 * 0.975 * 0.025), 0, 1e-11);
  assert_close(lab_student_quantile(0.975, 10), 2.228138851964939, 0, 1e-11); /* Abramowitz and Stegun 26.10: 2.228 */
  assert_close(lab_student_quantile(0.975, (double)INFINITY), 1.959963984540054, 0, 1e-12);
  assert_close(lab_student_quantile(0.025, 7), -lab_student_quantile(0.975, 7), 0, 1e-11);
  assert_close(lab_student_probability(lab_student_quantile(0.6, 3.5), 3.5), 0.6, 1e-13, 0);
  assert_close(lab_student_quantile(0.975, 1e7), 1.959963984540054, 0, 1e-6);
}

/* ---- A straight line: everything is known in closed form ---- */

enum { LINE = 11 };

typedef struct line {
  double t[LINE], y[LINE], sigma[LINE];
} line;

static int line_residuals(void *context, const double *theta, double *r, lab_error *e)
{
  const line *data = context;
  int i;
  (void)e;
  for (i = 0; i < LINE; i++)
    r[i] = theta[0] + theta[1] * data->t[i] - data->y[i];
  return LAB_OK;
}

static line make_line(void)
{
  line data;
  int i;
  for (i = 0; i < LINE; i++) {
    data.t[i] = i;
    data.y[i] = 3 - 0.5 * i + (i % 3 - 1) * 0.1;
    data.sigma[i] = 0.1 + 0.02 * i;
  }
  return data;
}

/* Solution and inverse of the weighted normal equations of y = a + b t. */
static void normal_equations(const line *d, double *theta, double inverse[3], double *chi2)
{
  double s = 0, st = 0, stt = 0, sy = 0, sty = 0, det;
  int i;
  for (i = 0; i < LINE; i++) {
    const double w = 1 / (d->sigma[i] * d->sigma[i]);
    s += w;
    st += w * d->t[i];
    stt += w * d->t[i] * d->t[i];
    sy += w * d->y[i];
    sty += w * d->t[i] * d->y[i];
  }
  det = s * stt - st * st;
  inverse[0] = stt / det;
  inverse[1] = -st / det;
  inverse[2] = s / det;
  theta[0] = inverse[0] * sy + inverse[1] * sty;
  theta[1] = inverse[1] * sy + inverse[2] * sty;
  for (*chi2 = 0, i = 0; i < LINE; i++) {
    const double w = 1 / (d->sigma[i] * d->sigma[i]), r = theta[0] + theta[1] * d->t[i] - d->y[i];
    *chi2 += w * r * r;
  }
}

static trial trial_of(line *data)
{
  trial c = {.m = LINE, .model = line_residuals, .data = data, .sigma = data->sigma, .step = 1e-3};
  add(&c, "a", 1, -10, 10);
  add(&c, "b", 0, -10, 10);
  return c;
}

static void check_line(const double *at, const double *theta, const double inverse[3], double chi2, double variance)
{
  const double quantile = 1.959963984540054;
  assert_close(at[0], theta[0], 1e-9, 0);
  assert_close(at[1], theta[1], 1e-9, 0);
  assert_close(got.chi2, chi2, 0, 1e-9);
  assert_close(got.reduced_chi2, chi2 / (LINE - 2), 0, 1e-9);
  assert_close(got.covariance[0][0], variance * inverse[0], 0, 1e-7);
  assert_close(got.covariance[0][1], variance * inverse[1], 0, 1e-7);
  assert_close(got.covariance[1][0], variance * inverse[1], 0, 1e-7);
  assert_close(got.covariance[1][1], variance * inverse[2], 0, 1e-7);
  assert_close(got.deviation[1], sqrt(variance * inverse[2]), 0, 1e-7);
  assert_close(got.high[1] - got.low[1], 2 * quantile * sqrt(variance * inverse[2]), 0, 1e-7);
  assert_string_equal(got.undetermined, "");
}

TEST(test_lab_fit_spread__line__weighted_and_normal)
{
  line data = make_line();
  const trial c = trial_of(&data);
  double at[2], theta[2], inverse[3], chi2;
  fit(&c, at);
  normal_equations(&data, theta, inverse, &chi2);
  assert_true(chi2 < LINE - 2);
  check_line(at, theta, inverse, chi2, 1);
}

TEST(test_lab_fit_spread__more_left_than_noise__wider_by_its_size)
{
  line data = make_line();
  const trial c = trial_of(&data);
  double at[2], theta[2], inverse[3], chi2;
  int i;
  for (i = 0; i < LINE; i++)
    data.sigma[i] /= 10;
  fit(&c, at);
  normal_equations(&data, theta, inverse, &chi2);
  assert_true(chi2 > 2 * (LINE - 2));
  check_line(at, theta, inverse, chi2, chi2 / (LINE - 2));
}

/* As many values as unknowns: no degrees of freedom, the noise is what it is said to be. */
static int quarter(void *data, const double *theta, double *r, lab_error *e)
{
  int j;
  (void)data, (void)e;
  for (j = 0; j < MOST; j++)
    r[j] = theta[j] - 0.25;
  return LAB_OK;
}

/* A mean of 64 stretches of `size` values that differ by sqrt(3) times their noise from stretch to stretch, up and
 * down: as if there were 64 values, its variance is sum b^2/64^2 = 3/64; value by value it would be 3/(64 size). */
static int mean_residuals(void *context, const double *theta, double *r, lab_error *e)
{
  const int size = *(const int *)context;
  int i;
  (void)e;
  for (i = 0; i < 64 * size; i++)
    r[i] = theta[0] - 2 - (i / size % 2 ? 1 : -1) * sqrt(3);
  return LAB_OK;
}

TEST(test_lab_fit_spread__left_in_stretches__as_few_values_as_there_are_stretches)
{
  static int sizes[] = {8, 50};
  double theta[MOST];
  size_t k;
  for (k = 0; k < sizeof sizes / sizeof *sizes; k++) {
    trial c = {.m = (size_t)(64 * sizes[k]), .model = mean_residuals, .data = &sizes[k], .step = 1e-3};
    add(&c, "mean", 0.5, -10, 10);
    fit(&c, theta);
    assert_close(got.deviation[0], sqrt(3.0 / 64), 0, 1e-8);
    assert_close(got.high[0] - got.low[0], 2 * 1.959963984540054 * got.deviation[0], 0, 1e-8);
  }
}

TEST(test_lab_fit_spread__most_unknowns__each_is_as_its_own_value_says)
{
  static trial c = {.m = MOST, .model = quarter, .step = 1e-3};
  double at[MOST];
  int j;
  for (j = 0; j < MOST; j++)
    add(&c, "x", 0.75, -5, 5);
  fit(&c, at);
  assert_true(isnan(got.reduced_chi2));
  for (j = 0; j < MOST; j++) {
    assert_close(at[j], 0.25, 1e-9, 0);
    assert_int_equal(got.state[j], LAB_STATE_FREE);
    assert_close(got.high[j], 0.25 + 1.959963984540054, 1e-7, 0);
  }
}

/* ---- Bounds ---- */

/* Rosenbrock's valley: with x <= 1/2 the least is at x = 1/2, y = 1/4. */
static int valley(void *data, const double *theta, double *r, lab_error *e)
{
  (void)data, (void)e;
  r[0] = 10 * (theta[1] - theta[0] * theta[0]);
  r[1] = 1 - theta[0];
  return LAB_OK;
}

TEST(test_lab_fit_spread__bound_active__is_said_and_the_other_alone_is_free)
{
  trial c = {.m = 2, .model = valley, .step = 1e-5};
  double at[2];
  add(&c, "x", 0.1, 0, 0.5);
  add(&c, "y", 1, 0, 2);
  fit(&c, at);
  assert_true(at[0] == 0.5);
  assert_close(at[1], 0.25, 1e-8, 0);
  assert_int_equal(got.state[0], LAB_STATE_AT_UPPER);
  assert_int_equal(got.state[1], LAB_STATE_FREE);
  assert_close(got.covariance[1][1], 0.01, 0, 1e-6); /* y alone: 1/10^2 */
  assert_close(got.covariance[0][0], 0, 0, 0);
  assert_close(got.deviation[0], 0, 0, 0);
  assert_string_equal(got.undetermined, "x is at its upper bound");
}

/* The data want b = -0.5; with a bound above that, what is left is the tail of a normal distribution beyond the bound.
 */
static void check_one_side(double lower, double upper, int state)
{
  line data = make_line();
  trial c = trial_of(&data);
  const double end = state == LAB_STATE_AT_LOWER ? lower : upper, side = state == LAB_STATE_AT_LOWER ? 1 : -1;
  double at[2], theta[2], inverse[3], chi2, sd, far;
  c.start[1] = 0.5 * (lower + upper);
  c.lower[1] = lower;
  c.upper[1] = upper;
  fit(&c, at);
  far = side > 0 ? got.high[1] : got.low[1];
  normal_equations(&data, theta, inverse, &chi2);
  sd = sqrt(inverse[2] * fmax(1, got.reduced_chi2));
  assert_int_equal(got.state[1], state);
  assert_close(side > 0 ? got.low[1] : got.high[1], end, 0, 0);
  assert_close(lab_student_probability(-side * (far - theta[1]) / sd, (double)INFINITY) /
                   lab_student_probability(-side * (end - theta[1]) / sd, (double)INFINITY),
               0.05, 1e-6, 0);
}

TEST(test_lab_fit_spread__bound_active__interval_on_one_side)
{
  check_one_side(-0.49, 3, LAB_STATE_AT_LOWER);
  check_one_side(-0.40, 3, LAB_STATE_AT_LOWER);
  check_one_side(-3, -0.52, LAB_STATE_AT_UPPER);
}

/* ---- What the data do not determine ---- */

/* y = a b t + c; d does nothing */
static int product(void *context, const double *theta, double *r, lab_error *e)
{
  const line *data = context;
  int i;
  (void)e;
  for (i = 0; i < LINE; i++)
    r[i] = theta[0] * theta[1] * data->t[i] + theta[2] - data->y[i];
  return LAB_OK;
}

TEST(test_lab_fit_spread__product_of_two__pair_named)
{
  line data = make_line();
  trial c = {.m = LINE, .model = product, .data = &data, .sigma = data.sigma, .step = 1e-4};
  double at[4], theta[2], inverse[3], chi2;
  add(&c, "a", 1, 0.1, 9);
  add(&c, "b", -1, -9, -0.1);
  add(&c, "c", 1, -9, 9);
  add(&c, "d", 2, 1, 3);
  fit(&c, at);
  normal_equations(&data, theta, inverse, &chi2);
  assert_int_equal(got.state[0], LAB_STATE_UNDETERMINED);
  assert_int_equal(got.state[1], LAB_STATE_UNDETERMINED);
  assert_int_equal(got.state[2], LAB_STATE_FREE);
  assert_int_equal(got.state[3], LAB_STATE_UNDETERMINED);
  assert_contains(got.undetermined, "only a combination of a and b is determined");
  assert_contains(got.undetermined, "d has no effect on the data");
  assert_close(at[0] * at[1], theta[1], 0, 1e-7);
  assert_close(at[2], theta[0], 0, 1e-7);
  assert_close(got.covariance[2][2], inverse[0], 0, 1e-4); /* as if only the product were fitted */
  assert_close(got.low[0], 0.1, 0, 0);
  assert_close(got.high[0], 9, 0, 0);
  assert_true(isinf(got.deviation[1]));
}

/* ---- The library's model with noise ---- */

enum { SAMPLES = 225 };

typedef struct bench {
  double t[SAMPLES], p[SAMPLES], x[SAMPLES];
} bench;

/* Fill for 3 s, vent for 6 s, 25 samples a second. */
static int bench_run(const double *theta, bench *out, lab_error *e)
{
  pneu_params params = fixture_params(FIXTURE_R1_400);
  const pneu_laws law = {PNEU_GAS_ISOTHERMAL, PNEU_FLOW_CHOKED, 0, 0};
  const double at[2] = {0, 3};
  pneu_input input[2];
  const lab_schedule schedule = {2, at, input};
  pneu_state rest;
  const lab_simulation task = {
      .start = &rest, .schedule = &schedule, .t = out->t, .n = SAMPLES, .t_end = 9, .options = {.tol = 1e-8}};
  pneu_model model;
  lab_response response;
  params.fill_area = params.vent_area = (pneu_real)theta[0];
  params.dry_friction = (pneu_real)theta[1];
  params.spring_rate = (pneu_real)theta[2];
  params.spring_preload = (pneu_real)theta[3];
  if (pneu_model_init(&model, &params, &law, NULL) != PNEU_OK)
    return lab_fail(e, LAB_NUMERIC, "parameters out of bounds");
  input[0] = fixture_input(&model, 1);
  input[1] = fixture_input(&model, -1);
  rest = fixture_rest(&model, 0, 0, &input[0]);
  if (lab_response_run(&model, &task, &response, e))
    return e->status;
  memcpy(out->p, response.p, sizeof out->p);
  memcpy(out->x, response.x, sizeof out->x);
  lab_response_free(&response);
  return LAB_OK;
}

static const double sigma_p = 300, sigma_x = 3e-5;

static int bench_residuals(void *context, const double *theta, double *r, lab_error *e)
{
  const bench *data = context;
  bench tried = *data;
  int i;
  if (bench_run(theta, &tried, e))
    return e->status;
  for (i = 0; i < SAMPLES; i++) {
    r[i] = (tried.p[i] - data->p[i]) / sigma_p;
    r[SAMPLES + i] = (tried.x[i] - data->x[i]) / sigma_x;
  }
  return LAB_OK;
}

/* Normal noise by Box and Muller. */
static double noise(uint64_t *seed)
{
  const double a = fixture_random(seed, 1e-12, 1), b = fixture_random(seed, 0, 1);
  return sqrt(-2 * log(a)) * cos(2 * 3.14159265358979323846 * b);
}

static void make_bench(const double *truth, uint64_t seed, bench *data)
{
  int i;
  for (i = 0; i < SAMPLES; i++)
    data->t[i] = 0.04 * i;
  succeed(bench_run(truth, data, &error));
  for (i = 0; i < SAMPLES; i++) {
    data->p[i] += sigma_p * noise(&seed);
    data->x[i] += sigma_x * noise(&seed);
  }
}

TEST(test_lab_fit_spread__library_with_noise__recovers_within_its_intervals)
{
  static const double truth[4] = {0.893e-6, 480, 4e5, 0.01};
  enum { SEEDS = 8 };
  int inside = 0, seed, j;
  bench data;
  trial c = {.m = 2 * SAMPLES, .model = bench_residuals, .data = &data, .step = 1e-3};
  add(&c, "orifice_area", 1.2e-6, 1e-7, 1e-5);
  add(&c, "dry_friction", 300, 0, 2000);
  add(&c, "spring_rate", 5e5, 1e5, 1e6);
  add(&c, "spring_preload", 0.008, 0, 0.03);
  for (seed = 1; seed <= SEEDS; seed++) {
    double at[4];
    make_bench(truth, (uint64_t)seed, &data);
    fit(&c, at);
    check_note("seed %d", seed);
    assert_between(got.reduced_chi2, 0.8, 1.2); /* 446 degrees of freedom: 1 +- 0.067, three times that */
    assert_string_equal(got.undetermined, "");
    for (j = 0; j < 4; j++) {
      assert_close(at[j], truth[j], 5 * got.deviation[j], 0);
      inside += truth[j] >= got.low[j] && truth[j] <= got.high[j];
    }
  }
  assert_true(inside >= 26); /* of 32; 30.4 expected, 26 or fewer have a chance of 1 % */
}

/* ---- No model ---- */

static int none(void *data, const double *theta, double *r, lab_error *e)
{
  (void)data, (void)theta, (void)r;
  return lab_fail(e, LAB_NUMERIC, "no model here");
}

TEST(test_lab_fit_spread__model_fails__says_so)
{
  trial c = {.n = 1, .m = 2, .model = none, .upper = {1}};
  const lab_fit_problem problem = {
      .n = 1, .m = 2, .lower = c.lower, .upper = c.upper, .context = &c, .residuals = residuals, .slope = slope};
  assert_int_equal(lab_fit_spread(&problem, c.param, c.start, &got, &error), LAB_NUMERIC);
  assert_string_equal(error.text, "no model here");
}
