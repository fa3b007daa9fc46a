#include "fixture.h"

#include <stdlib.h>
#include <string.h>

#include "../apps/lab/fit/fit.h"
#include "../apps/lab/base/quantile.h"
#include "../apps/lab/run/response.h"

static lab_error error;

static lab_fit_result fitted(const lab_fit_problem *problem, const lab_fit_options *options)
{
  lab_fit_result result;
  if (lab_fit_run(problem, options, &result, &error) != LAB_OK)
    fail_msg("%s", error.text);
  return result;
}

/* ---- Quantiles ---- */

static void test_student_quantile__tables__agree(void **state)
{
  /* closed forms: 1 degree of freedom is Cauchy's tan(pi (p - 1/2)); with 2, (2p - 1)/sqrt(2 p (1 - p)) */
  (void)state;
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
static void normal_equations(const line *d, int weighted, double *theta, double inverse[3], double *chi2)
{
  double s = 0, st = 0, stt = 0, sy = 0, sty = 0, det;
  int i;
  for (i = 0; i < LINE; i++) {
    const double w = weighted ? 1 / (d->sigma[i] * d->sigma[i]) : 1;
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
    const double w = weighted ? 1 / (d->sigma[i] * d->sigma[i]) : 1, r = theta[0] + theta[1] * d->t[i] - d->y[i];
    *chi2 += w * r * r;
  }
}

static const lab_fit_param line_params[2] = {{"a", "1", 1, -10, 10, 0, 0}, {"b", "1/s", 0, -10, 10, 0, 0}};

static void check_line(const lab_fit_result *got, const double *theta, const double inverse[3], double chi2,
                       double variance, double quantile)
{
  assert_close(got->theta[0], theta[0], 1e-9, 0);
  assert_close(got->theta[1], theta[1], 1e-9, 0);
  assert_close(got->chi2, chi2, 0, 1e-9);
  assert_close(got->covariance[0][0], variance * inverse[0], 0, 1e-7);
  assert_close(got->covariance[0][1], variance * inverse[1], 0, 1e-7);
  assert_close(got->covariance[1][0], variance * inverse[1], 0, 1e-7);
  assert_close(got->covariance[1][1], variance * inverse[2], 0, 1e-7);
  assert_close(got->high[1] - got->low[1], 2 * quantile * sqrt(variance * inverse[2]), 0, 1e-7);
  assert_string_equal(got->remark, "");
}

static void test_fit_run__line_of_unknown_noise__least_squares_and_student(void **state)
{
  line data = make_line();
  const lab_fit_problem problem = {2, line_params, LINE, line_residuals, NULL, &data, NULL, 0};
  const lab_fit_result got = fitted(&problem, NULL);
  double theta[2], inverse[3], chi2;
  (void)state;
  normal_equations(&data, 0, theta, inverse, &chi2);
  assert_close(got.degrees, LINE - 2, 0, 0);
  check_line(&got, theta, inverse, chi2, chi2 / (LINE - 2), lab_student_quantile(0.975, LINE - 2));
  assert_close(got.rmse, sqrt(chi2 / LINE), 0, 1e-9);
}

static void test_fit_run__line_of_known_noise__weighted_and_normal(void **state)
{
  line data = make_line();
  const lab_fit_problem problem = {2, line_params, LINE, line_residuals, NULL, &data, data.sigma, 1};
  const lab_fit_result got = fitted(&problem, NULL);
  double theta[2], inverse[3], chi2;
  (void)state;
  normal_equations(&data, 1, theta, inverse, &chi2);
  check_line(&got, theta, inverse, chi2, 1, 1.959963984540054);
  assert_close(got.reduced_chi2, chi2 / (LINE - 2), 0, 1e-9);
}

static int line_slopes(void *context, const double *theta, const double *r, double *slope, lab_error *e)
{
  const line *data = context;
  int i;
  (void)theta, (void)r, (void)e;
  for (i = 0; i < LINE; i++) {
    slope[i] = 1;
    slope[LINE + i] = data->t[i];
  }
  return LAB_OK;
}

static void test_fit_run__given_slopes__as_with_differences(void **state)
{
  line data = make_line();
  const lab_fit_problem problem = {2, line_params, LINE, line_residuals, line_slopes, &data, data.sigma, 0};
  const lab_fit_result got = fitted(&problem, NULL);
  double theta[2], inverse[3], chi2;
  (void)state;
  normal_equations(&data, 1, theta, inverse, &chi2);
  check_line(&got, theta, inverse, chi2, chi2 / (LINE - 2), lab_student_quantile(0.975, LINE - 2));
}

/* ---- Rosenbrock's valley: r = (10 (y - x^2), 1 - x), minimum 0 at (1, 1) ---- */

static int valley(void *context, const double *theta, double *r, lab_error *e)
{
  (void)context, (void)e;
  r[0] = 10 * (theta[1] - theta[0] * theta[0]);
  r[1] = 1 - theta[0];
  return LAB_OK;
}

static void test_fit_run__rosenbrock__every_search_finds_the_minimum(void **state)
{
  static const lab_fit_param params[2] = {{"x", "1", -1.2, -5, 5, 0, 0}, {"y", "1", 1, -5, 5, 0, 0}};
  const lab_fit_problem problem = {2, params, 2, valley, NULL, NULL, NULL, 0};
  lab_fit_options options;
  (void)state;
  lab_fit_options_default(&options);
  for (options.search = LAB_FIT_POLISH_ONLY; options.search <= LAB_FIT_CRS; options.search++) {
    lab_fit_result got;
    check_note("search %d", options.search);
    got = fitted(&problem, &options);
    assert_close(got.theta[0], 1, 1e-7, 0);
    assert_close(got.theta[1], 1, 1e-7, 0);
    assert_true(got.finish != LAB_FIT_COUNT_REACHED);
  }
}

/* ---- Bounds ---- */

/* Remembers whether it was ever called outside of 0..2, 0..2. */
static int bounded_valley(void *context, const double *theta, double *r, lab_error *e)
{
  int *outside = context;
  *outside |= !(theta[0] >= 0 && theta[0] <= 0.5 && theta[1] >= 0 && theta[1] <= 2);
  return valley(NULL, theta, r, e);
}

static void test_fit_run__bound_active__minimum_on_the_bound_and_never_outside(void **state)
{
  /* with x <= 1/2 the least is at x = 1/2, y = 1/4 */
  static const lab_fit_param params[2] = {{"x", "1", 0.1, 0, 0.5, 0, 0}, {"y", "1", 1, 0, 2, 0, 0}};
  int outside = 0, search;
  const lab_fit_problem problem = {2, params, 2, bounded_valley, NULL, &outside, NULL, 1};
  lab_fit_options options;
  (void)state;
  lab_fit_options_default(&options);
  for (search = LAB_FIT_POLISH_ONLY; search <= LAB_FIT_SBPLX; search++) {
    lab_fit_result got;
    options.search = search;
    got = fitted(&problem, &options);
    assert_true(got.theta[0] == 0.5);
    assert_close(got.theta[1], 0.25, 1e-8, 0);
    assert_int_equal(got.state[0], LAB_FIT_AT_UPPER);
    assert_int_equal(got.state[1], LAB_FIT_FREE);
    assert_int_equal(got.n_free, 1);
    assert_close(got.covariance[1][1], 0.01, 0, 1e-6); /* y alone: 1/10^2 */
    assert_close(got.covariance[0][0], 0, 0, 0);
    assert_string_equal(got.remark, "x is at its upper bound");
  }
  assert_int_equal(outside, 0);
}

static void test_fit_run__start_on_a_bound__leaves_it(void **state)
{
  static const lab_fit_param params[2] = {{"x", "1", 5, -5, 5, 0, 1}, {"y", "1", -5, -5, 5, 0, 1}};
  const lab_fit_problem problem = {2, params, 2, valley, NULL, NULL, NULL, 0};
  lab_fit_options options;
  lab_fit_result got;
  (void)state;
  lab_fit_options_default(&options);
  options.search = LAB_FIT_POLISH_ONLY;
  got = fitted(&problem, &options);
  assert_close(got.theta[0], 1, 1e-7, 0);
  assert_int_equal(got.n_free, 2);
}

/* The data want b = -0.5; with a bound above that, what is left is the tail of a normal distribution beyond the bound.
 */
static void check_one_side(double lower, double upper, int state)
{
  line data = make_line();
  const lab_fit_param params[2] = {{"a", "1", 1, -10, 10, 0, 0},
                                   {"b", "1/s", 0.5 * (lower + upper), lower, upper, 0, 0}};
  const lab_fit_problem problem = {2, params, LINE, line_residuals, NULL, &data, data.sigma, 1};
  const lab_fit_result got = fitted(&problem, NULL);
  const double end = state == LAB_FIT_AT_LOWER ? lower : upper, side = state == LAB_FIT_AT_LOWER ? 1 : -1;
  const double far = side > 0 ? got.high[1] : got.low[1];
  double theta[2], inverse[3], chi2, sd;
  normal_equations(&data, 1, theta, inverse, &chi2);
  sd = sqrt(inverse[2] * fmax(1, got.reduced_chi2));
  assert_int_equal(got.state[1], state);
  assert_close(side > 0 ? got.low[1] : got.high[1], end, 0, 0);
  assert_close(lab_student_probability(-side * (far - theta[1]) / sd, (double)INFINITY) /
                   lab_student_probability(-side * (end - theta[1]) / sd, (double)INFINITY),
               0.05, 1e-6, 0);
}

static void test_fit_run__bound_active__interval_on_one_side(void **state)
{
  (void)state;
  check_one_side(-0.49, 3, LAB_FIT_AT_LOWER);
  check_one_side(-0.40, 3, LAB_FIT_AT_LOWER);
  check_one_side(-3, -0.52, LAB_FIT_AT_UPPER);
}

static void test_fit_run__more_left_than_known_noise__wider_by_its_size(void **state)
{
  line data = make_line();
  const lab_fit_problem problem = {2, line_params, LINE, line_residuals, NULL, &data, data.sigma, 1};
  double theta[2], inverse[3], chi2;
  lab_fit_result got;
  int i;
  (void)state;
  for (i = 0; i < LINE; i++)
    data.sigma[i] /= 10;
  got = fitted(&problem, NULL);
  normal_equations(&data, 1, theta, inverse, &chi2);
  assert_true(chi2 > 2 * (LINE - 2));
  check_line(&got, theta, inverse, chi2, chi2 / (LINE - 2), 1.959963984540054);
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

static void test_fit_run__product_of_two__pair_named(void **state)
{
  static const lab_fit_param params[4] = {{"a", "1", 1, 0.1, 9, 0, 0},
                                          {"b", "1", -1, -9, -0.1, 0, 0},
                                          {"c", "1", 1, -9, 9, 0, 0},
                                          {"d", "1", 2, 1, 3, 0, 0}};
  line data = make_line();
  const lab_fit_problem problem = {4, params, LINE, product, NULL, &data, NULL, 0};
  const lab_fit_result got = fitted(&problem, NULL);
  double theta[2], inverse[3], chi2;
  (void)state;
  normal_equations(&data, 0, theta, inverse, &chi2);
  assert_int_equal(got.state[0], LAB_FIT_UNDETERMINED);
  assert_int_equal(got.state[1], LAB_FIT_UNDETERMINED);
  assert_int_equal(got.state[2], LAB_FIT_FREE);
  assert_int_equal(got.state[3], LAB_FIT_UNDETERMINED);
  assert_non_null(strstr(got.remark, "only a combination of a and b is determined"));
  assert_non_null(strstr(got.remark, "d has no effect on the data"));
  assert_close(got.theta[0] * got.theta[1], theta[1], 0, 1e-7);
  assert_close(got.theta[2], theta[0], 0, 1e-7);
  assert_close(got.covariance[2][2], chi2 / (LINE - 2) * inverse[0], 0, 1e-4); /* as if only the product were fitted */
  assert_close(got.low[0], 0.1, 0, 0);
  assert_close(got.high[0], 9, 0, 0);
  assert_true(isinf(got.deviation[1]));
}

/* ---- Models that fail ---- */

/* a line that does not exist for slopes above 1 */
static int fragile(void *context, const double *theta, double *r, lab_error *e)
{
  if (theta[1] > 1)
    return lab_fail(e, LAB_NUMERIC, "no model at b = %g", theta[1]);
  line_residuals(context, theta, r, e);
  if (theta[1] > 0.5)
    r[4] = (double)NAN;
  return LAB_OK;
}

static void test_fit_run__failing_region__avoided_and_counted(void **state)
{
  static const lab_fit_param params[2] = {{"a", "1", 1, -10, 10, 0, 0}, {"b", "1", 0.499, -3, 3, 0, 1}};
  line data = make_line();
  const lab_fit_problem problem = {2, params, LINE, fragile, NULL, &data, NULL, 0};
  lab_fit_options options;
  double theta[2], inverse[3], chi2;
  long failed = 0;
  (void)state;
  normal_equations(&data, 0, theta, inverse, &chi2);
  lab_fit_options_default(&options);
  for (options.search = LAB_FIT_POLISH_ONLY; options.search <= LAB_FIT_CRS; options.search++) {
    const lab_fit_result got = fitted(&problem, &options);
    check_note("search %d", options.search);
    assert_close(got.theta[0], theta[0], 1e-8, 0);
    assert_close(got.theta[1], theta[1], 1e-8, 0);
    failed += got.failed;
  }
  assert_true(failed > 0);
}

static void test_fit_run__failing_start__named(void **state)
{
  static const lab_fit_param params[2] = {{"a", "1", 1, -10, 10, 0, 0}, {"b", "1", 0.7, 0.6, 3, 0, 1}};
  line data = make_line();
  const lab_fit_problem problem = {2, params, LINE, fragile, NULL, &data, NULL, 0};
  lab_fit_result got;
  (void)state;
  assert_int_equal(lab_fit_run(&problem, NULL, &got, &error), LAB_NUMERIC);
  assert_non_null(strstr(error.text, "residual 5 of 11 is not finite"));
}

static int broken(void *context, const double *theta, double *r, lab_error *e)
{
  int *calls = context;
  if (++*calls > 20)
    return lab_fail(e, LAB_WORLD, "the disk is gone");
  return valley(NULL, theta, r, e);
}

static void test_fit_run__callback_error__ends_the_fit_at_once(void **state)
{
  static const lab_fit_param params[2] = {{"x", "1", -1.2, -5, 5, 0, 0}, {"y", "1", 1, -5, 5, 0, 0}};
  int search;
  (void)state;
  for (search = LAB_FIT_POLISH_ONLY; search <= LAB_FIT_CRS; search++) {
    int calls = 0;
    const lab_fit_problem problem = {2, params, 2, broken, NULL, &calls, NULL, 0};
    lab_fit_options options;
    lab_fit_result got;
    lab_fit_options_default(&options);
    options.search = search;
    assert_int_equal(lab_fit_run(&problem, &options, &got, &error), LAB_WORLD);
    assert_string_equal(error.text, "the disk is gone");
    assert_int_equal(calls, 21);
  }
}

static void test_fit_run__no_problem__refused_with_its_name(void **state)
{
  static const lab_fit_param outside = {"rate", "N/m", 5, 6, 9, 0, 0}, crossed = {"rate", "N/m", 5, 5, 5, 0, 0},
                             negative = {"rate", "N/m", 5, 0, 9, 1, 0};
  const lab_fit_param *const bad[] = {&outside, &crossed, &negative};
  static const char *const word[] = {"not within its bounds", "leave nothing to fit", "logarithmic"};
  lab_fit_result got;
  int i;
  (void)state;
  for (i = 0; i < 3; i++) {
    const lab_fit_problem problem = {1, bad[i], 2, valley, NULL, NULL, NULL, 0};
    assert_int_equal(lab_fit_run(&problem, NULL, &got, &error), LAB_DATA);
    assert_non_null(strstr(error.text, word[i]));
    assert_non_null(strstr(error.text, "rate"));
  }
}

/* ---- Many starts ---- */

/* r = (x^2 - 1, (x - 1)/10) has a poorer minimum near x = -1 */
static int two_wells(void *context, const double *theta, double *r, lab_error *e)
{
  (void)context, (void)e;
  r[0] = theta[0] * theta[0] - 1;
  r[1] = 0.1 * (theta[0] - 1);
  return LAB_OK;
}

static void test_fit_run__many_starts__best_well_whatever_the_threads(void **state)
{
  static const lab_fit_param param = {"x", "1", -1.1, -3, 3, 0, 0};
  const lab_fit_problem problem = {1, &param, 2, two_wells, NULL, NULL, NULL, 0};
  lab_fit_options options;
  lab_fit_result one, four;
  (void)state;
  lab_fit_options_default(&options);
  one = fitted(&problem, &options);
  assert_between(one.theta[0], -1.0, -0.9);
  options.starts = 16;
  one = fitted(&problem, &options);
  options.threads = 4;
  four = fitted(&problem, &options);
  assert_close(one.theta[0], 1, 1e-9, 0);
  assert_memory_equal(&one, &four, sizeof one);
  assert_true(one.agree > 1 && one.agree < one.starts && one.starts == 16);
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
  const lab_response_options options = {LAB_STEPPER, 1e-8, 9, 0, 0, 0};
  const double at[2] = {0, 3};
  pneu_input input[2];
  const lab_schedule schedule = {2, at, input};
  pneu_state rest;
  pneu_model model;
  lab_trace trace;
  params.fill_area = params.vent_area = (pneu_real)theta[0];
  params.dry_friction = (pneu_real)theta[1];
  params.spring_rate = (pneu_real)theta[2];
  params.spring_preload = (pneu_real)theta[3];
  if (pneu_model_init(&model, &params, &law, NULL) != PNEU_OK)
    return lab_fail(e, LAB_NUMERIC, "parameters out of bounds");
  input[0] = fixture_input(&model, 1);
  input[1] = fixture_input(&model, -1);
  rest = fixture_rest(&model, 0, 0, &input[0]);
  if (lab_respond(&model, &rest, &schedule, out->t, SAMPLES, &options, &trace, NULL, e))
    return e->status;
  memcpy(out->p, trace.p, sizeof out->p);
  memcpy(out->x, trace.x, sizeof out->x);
  lab_trace_free(&trace);
  return LAB_OK;
}

static const double sigma_p = 300, sigma_x = 3e-5;

static int bench_residuals(void *context, const double *theta, double *r, lab_error *e)
{
  const bench *data = context;
  bench got = *data;
  int i;
  if (bench_run(theta, &got, e))
    return e->status;
  for (i = 0; i < SAMPLES; i++) {
    r[i] = (got.p[i] - data->p[i]) / sigma_p;
    r[SAMPLES + i] = (got.x[i] - data->x[i]) / sigma_x;
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
  assert_int_equal(bench_run(truth, data, &error), LAB_OK);
  for (i = 0; i < SAMPLES; i++) {
    data->p[i] += sigma_p * noise(&seed);
    data->x[i] += sigma_x * noise(&seed);
  }
}

static void test_fit_run__library_with_noise__recovers_within_its_intervals(void **state)
{
  static const double truth[4] = {0.893e-6, 480, 4e5, 0.01};
  static const lab_fit_param params[4] = {{"orifice_area", "m2", 1.2e-6, 1e-7, 1e-5, 1, 0},
                                          {"dry_friction", "N", 300, 0, 2000, 0, 0},
                                          {"spring_rate", "N/m", 5e5, 1e5, 1e6, 0, 0},
                                          {"spring_preload", "m", 0.008, 0, 0.03, 0, 0}};
  enum { SEEDS = 8 };
  int inside = 0, seed, j;
  bench data;
  (void)state;
  for (seed = 1; seed <= SEEDS; seed++) {
    const lab_fit_problem problem = {4, params, 2 * SAMPLES, bench_residuals, NULL, &data, NULL, 0};
    lab_fit_options options;
    lab_fit_result got;
    lab_fit_options_default(&options);
    options.precision = 1e-8; /* that of the runs below */
    make_bench(truth, (uint64_t)seed, &data);
    got = fitted(&problem, &options);
    check_note("seed %d", seed);
    assert_between(got.reduced_chi2, 0.8, 1.2); /* 446 degrees of freedom: 1 +- 0.067, three times that */
    assert_string_equal(got.remark, "");
    for (j = 0; j < 4; j++) {
      assert_close(got.theta[j], truth[j], 5 * got.deviation[j], 0);
      inside += truth[j] >= got.low[j] && truth[j] <= got.high[j];
    }
  }
  assert_true(inside >= 26); /* of 32; 30.4 expected, 26 or fewer have a chance of 1 % */
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_student_quantile__tables__agree),
      cmocka_unit_test(test_fit_run__line_of_unknown_noise__least_squares_and_student),
      cmocka_unit_test(test_fit_run__line_of_known_noise__weighted_and_normal),
      cmocka_unit_test(test_fit_run__given_slopes__as_with_differences),
      cmocka_unit_test(test_fit_run__rosenbrock__every_search_finds_the_minimum),
      cmocka_unit_test(test_fit_run__bound_active__minimum_on_the_bound_and_never_outside),
      cmocka_unit_test(test_fit_run__start_on_a_bound__leaves_it),
      cmocka_unit_test(test_fit_run__bound_active__interval_on_one_side),
      cmocka_unit_test(test_fit_run__more_left_than_known_noise__wider_by_its_size),
      cmocka_unit_test(test_fit_run__product_of_two__pair_named),
      cmocka_unit_test(test_fit_run__failing_region__avoided_and_counted),
      cmocka_unit_test(test_fit_run__failing_start__named),
      cmocka_unit_test(test_fit_run__callback_error__ends_the_fit_at_once),
      cmocka_unit_test(test_fit_run__no_problem__refused_with_its_name),
      cmocka_unit_test(test_fit_run__many_starts__best_well_whatever_the_threads),
      cmocka_unit_test(test_fit_run__library_with_noise__recovers_within_its_intervals),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
