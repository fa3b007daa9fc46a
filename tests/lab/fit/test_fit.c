/* Least squares within bounds: closed forms, a curved valley, models that fail. */
#include "../../words.h"

#include "../../../apps/lab/fit/fit.h"
#include "../../../apps/lab/fit/normal.h"

enum { ROWS = 40, STEPS = 60 };

static double chi2; /* at the end of the last fit */

/* A problem, and how often its slopes were asked for. */
typedef struct trial {
  int n;
  double t[ROWS], y[ROWS];
  double (*model)(const double *theta, double t);
  double weight;
  int failing;  /* status where a model fails */
  int no_slope; /* unknown whose slope is not to be had; -1: none */
  int asked[4]; /* times that each slope was */
  int evaluations;
} trial;

static int residuals(void *context, const double *theta, double *r, lab_error *e)
{
  trial *c = context;
  int i;
  c->evaluations++;
  for (i = 0; i < ROWS; i++) {
    const double y = c->model(theta, c->t[i]);
    if (isnan(y))
      return lab_fail(e, c->failing, "no model here");
    r[i] = c->weight * (c->y[i] - y);
  }
  return LAB_OK;
}

static int slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *e)
{
  trial *c = context;
  double at[4];
  const double step = 1e-6;
  int i;
  c->asked[j]++;
  if (j == c->no_slope)
    return lab_fail(e, c->failing, "no slope here");
  memcpy(at, theta, (size_t)c->n * sizeof *at);
  at[j] += step;
  if (residuals(c, at, column, e))
    return e->status;
  for (i = 0; i < ROWS; i++)
    column[i] = (column[i] - r[i]) / step;
  return LAB_OK;
}

static const double low[] = {-100, -100, -100}, high[] = {100, 100, 100};

static lab_fit_problem problem_of(trial *c)
{
  const lab_fit_problem p = {.n = c->n,
                             .m = ROWS,
                             .lower = low,
                             .upper = high,
                             .context = c,
                             .residuals = residuals,
                             .slope = slope,
                             .steps = STEPS};
  return p;
}

static double chi2_at(trial *c, const double *theta)
{
  double r[ROWS], sum = 0;
  int i;
  succeed(residuals(c, theta, r, &error));
  for (i = 0; i < ROWS; i++)
    sum += r[i] * r[i];
  return sum;
}

/* Of n unknowns, nothing measured at 0, 1, 2, ... */
static trial make_rows(int n, double (*model)(const double *, double))
{
  trial c = {n, {0}, {0}, model, 1000, LAB_NUMERIC, -1, {0}, 0};
  int i;
  for (i = 0; i < ROWS; i++)
    c.t[i] = i;
  return c;
}

/* ---- A straight line ---- */

static double line(const double *theta, double t)
{
  return theta[0] + theta[1] * t;
}

static trial make_line(void)
{
  trial c = {2, {0}, {0}, line, 100, LAB_NUMERIC, -1, {0}, 0};
  int i;
  for (i = 0; i < ROWS; i++) {
    c.t[i] = 0.1 * i;
    c.y[i] = 3 - 0.5 * c.t[i] + (i % 3 - 1) * 0.1;
  }
  return c;
}

static double mean(const double *y)
{
  double sum = 0;
  int i;
  for (i = 0; i < ROWS; i++)
    sum += y[i];
  return sum / ROWS;
}

/* Slope of the regression line. */
static double regression(const trial *c)
{
  const double t0 = mean(c->t), y0 = mean(c->y);
  double tt = 0, ty = 0;
  int i;
  for (i = 0; i < ROWS; i++) {
    tt += (c->t[i] - t0) * (c->t[i] - t0);
    ty += (c->t[i] - t0) * (c->y[i] - y0);
  }
  return ty / tt;
}

static void assert_regression(const trial *c, const double *theta)
{
  assert_close(theta[0], mean(c->y) - regression(c) * mean(c->t), 1e-4, 0);
  assert_close(theta[1], regression(c), 1e-4, 0);
}

TEST(test_lab_fit__line__is_the_regression_line)
{
  trial c = make_line();
  const lab_fit_problem p = problem_of(&c);
  double theta[] = {40, 7};
  const double b = regression(&c), best[] = {mean(c.y) - b * mean(c.t), b};
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_regression(&c, theta);
  assert_close(chi2, chi2_at(&c, best), 0.02, 1e-6);
}

TEST(test_lab_fit__bound_in_the_way__is_the_best_line_on_it)
{
  static const double bounded[] = {100, -0.75};
  trial c = make_line();
  lab_fit_problem p = problem_of(&c);
  double theta[] = {40, -2};
  p.upper = bounded;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_true(theta[1] == bounded[1]);
  assert_close(theta[0], mean(c.y) - bounded[1] * mean(c.t), 1e-4, 0);
}

TEST(test_lab_fit__bounds_on_all__ends_in_the_corner)
{
  static const double least[] = {3.5, -0.3};
  trial c = make_line();
  lab_fit_problem p = problem_of(&c);
  double theta[] = {4, 0};
  p.lower = least;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_true(theta[0] == least[0]);
  assert_true(theta[1] == least[1]);
  assert_close(chi2, chi2_at(&c, least), 0, 1e-12);
}

TEST(test_lab_fit__start_on_bounds__leaves_them)
{
  static const double above[] = {9, 100}, below[] = {-100, -4};
  trial c = make_line();
  lab_fit_problem p = problem_of(&c);
  double theta[] = {9, -4};
  p.upper = above;
  p.lower = below;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_regression(&c, theta);
}

/* ---- A curved valley ---- */

/* Rosenbrock's function in its two residuals, the other rows empty. */
static double valley(const double *theta, double t)
{
  return t == 0 ? 10 * (theta[1] - theta[0] * theta[0]) : t == 1 ? 1 - theta[0] : 0;
}

TEST(test_lab_fit__rosenbrock__follows_the_valley)
{
  trial c = make_rows(2, valley);
  const lab_fit_problem p = problem_of(&c);
  double theta[] = {-1.2, 1};
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_close(theta[0], 1, 3e-4, 0);
  assert_close(theta[1], 1, 6e-4, 0);
  assert_close(chi2, chi2_at(&c, theta), 0, 1e-12);
}

TEST(test_lab_fit__one_step__is_on_the_way)
{
  trial c = make_rows(2, valley);
  lab_fit_problem p = problem_of(&c);
  double theta[] = {-1.2, 1};
  const double before = 1e6 * (4.4 * 4.4 + 2.2 * 2.2);
  p.steps = 1;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_true(chi2 < 0.5 * before && chi2 > 1e-3 * before);
  assert_close(chi2, chi2_at(&c, theta), 0, 1e-12);
  assert_int_equal(c.asked[0], 1);
}

/* ---- When it ends ---- */

/* A thousandth off the regression line is 0.4 of chi-square. */
TEST(test_lab_fit__near_enough__ends_at_once)
{
  trial c = make_line();
  lab_fit_problem p = problem_of(&c);
  const double b = regression(&c), off = mean(c.y) - b * mean(c.t) + 1e-3;
  double theta[] = {off, b};
  p.enough = 1;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_true(theta[0] == off && theta[1] == b);
  assert_close(chi2, chi2_at(&c, theta), 0, 1e-12);
  p.enough = 0.1;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_close(theta[0], off - 1e-3, 1e-6, 0);
  theta[0] = off;
  p.enough_share = 0.9;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_true(theta[0] == off);
}

/* ---- Models that fail ---- */

/* Its first full step from 5 goes to where there is no logarithm. */
static double logarithm(const double *theta, double t)
{
  return theta[0] > 0 ? log(theta[0]) + 0 * t : (double)NAN;
}

TEST(test_lab_fit__model_fails_beyond__stays_where_it_does_not)
{
  trial c = {1, {0}, {0}, logarithm, 100, LAB_NUMERIC, -1, {0}, 0};
  const lab_fit_problem p = problem_of(&c);
  double theta[] = {5};
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_close(theta[0], 1, 1e-3, 0);
}

TEST(test_lab_fit__model_fails_at_start__says_so)
{
  trial c = {1, {0}, {0}, logarithm, 100, LAB_NUMERIC, -1, {0}, 0};
  const lab_fit_problem p = problem_of(&c);
  double theta[] = {-1};
  assert_int_equal(lab_fit(&p, theta, &chi2, &error), LAB_NUMERIC);
  assert_true(theta[0] == -1);
}

/* The residuals come without an error, but one of them is none. */
static int hollow(void *context, const double *theta, double *r, lab_error *e)
{
  (void)context, (void)e;
  memset(r, 0, ROWS * sizeof *r);
  r[4] = sqrt(theta[0]);
  return LAB_OK;
}

TEST(test_lab_fit__residual_not_finite__is_named)
{
  trial c = make_line();
  lab_fit_problem p = problem_of(&c);
  double theta[] = {-1, 0};
  p.residuals = hollow;
  assert_int_equal(lab_fit(&p, theta, &chi2, &error), LAB_NUMERIC);
  assert_string_equal(error.text, "residual 5 of 40 is not finite");
}

TEST(test_lab_fit__any_other_failure__ends_it)
{
  trial c = {1, {0}, {0}, logarithm, 100, LAB_WORLD, -1, {0}, 0};
  const lab_fit_problem p = problem_of(&c);
  double theta[] = {5};
  assert_int_equal(lab_fit(&p, theta, &chi2, &error), LAB_WORLD);
  assert_string_equal(error.text, "no model here");
  theta[0] = 1.5;
  c.no_slope = 0;
  assert_int_equal(lab_fit(&p, theta, &chi2, &error), LAB_WORLD);
  assert_string_equal(error.text, "no slope here");
}

TEST(test_lab_fit__slope_fails__leaves_that_unknown_where_it_is)
{
  trial c = make_line();
  const lab_fit_problem p = problem_of(&c);
  double theta[] = {40, -0.2};
  c.no_slope = 1;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_true(theta[1] == -0.2);
  assert_close(theta[0], mean(c.y) + 0.2 * mean(c.t), 1e-4, 0);
}

/* ---- Slopes that are kept ---- */

static double decay(const double *theta, double t)
{
  return theta[0] * exp(-theta[1] * t) + theta[2] * sin(9 * t);
}

/* Slopes are asked for less often than steps are taken, and the end is where the gradient is nought. */
TEST(test_lab_fit__kept_slopes__end_where_new_ones_would)
{
  trial c = {3, {0}, {0}, decay, 1000, LAB_NUMERIC, -1, {0}, 0};
  lab_fit_problem p = problem_of(&c);
  double theta[] = {1, 3, 0.5}, near;
  const double truth[] = {2, 0.7, -0.2};
  int i, side;
  for (i = 0; i < ROWS; i++) {
    c.t[i] = 0.1 * i;
    c.y[i] = decay(truth, c.t[i]) + (i % 3 - 1) * 0.01;
  }
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_close(chi2, chi2_at(&c, theta), 0, 1e-12);
  assert_true(c.asked[0] >= 2); /* at the start, and once more before the end */
  assert_true(2 * c.asked[0] < c.evaluations);
  for (i = 0; i < 3; i++)
    for (side = -1; side < 2; side += 2) {
      double beside[3];
      memcpy(beside, theta, sizeof beside);
      beside[i] += 1e-3 * side;
      near = chi2_at(&c, beside);
      check_note("unknown %d", i);
      assert_true(near > chi2 - 0.02); /* what is enough */
    }
}

/* What an earlier fit has left of the slopes is enough to come to the end; one that is brief does not check it, the
 * other asks for all of them once. */
TEST(test_lab_fit__known_slopes__are_not_asked_for_before_the_end)
{
  trial c = make_line();
  double slopes[2 * ROWS], theta[] = {0, 0};
  const char known[] = {1, 1}, half[] = {0, 1};
  lab_fit_problem p = problem_of(&c);
  p.slopes = slopes;
  succeed(lab_fit(&p, theta, &chi2, &error));
  p.is_known = known;
  p.is_brief = 1;
  theta[0] = theta[1] = c.asked[0] = c.asked[1] = 0;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_regression(&c, theta);
  assert_int_equal(c.asked[0] + c.asked[1], 0);
  p.is_known = half;
  theta[0] = theta[1] = 0;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_int_equal(c.asked[0], 1);
  assert_int_equal(c.asked[1], 0);
  p.is_brief = 0;
  theta[0] = theta[1] = c.asked[0] = 0;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_int_equal(c.asked[0], 2); /* at the start, and with the other before the end */
  assert_int_equal(c.asked[1], 1);
}

/* Slopes of another problem are found to be wrong. */
TEST(test_lab_fit__known_slopes_that_are_wrong__are_renewed)
{
  trial c = make_line();
  double slopes[2 * ROWS], theta[] = {0, 0};
  const char known[] = {1, 1};
  lab_fit_problem p = problem_of(&c);
  int i;
  for (i = 0; i < 2 * ROWS; i++)
    slopes[i] = i % 7 - 3;
  p.slopes = slopes;
  p.is_known = known;
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_regression(&c, theta);
}

TEST(test_lab_fit__rough_model__has_new_slopes_at_every_step)
{
  trial c = {3, {0}, {0}, decay, 1000, LAB_NUMERIC, -1, {0}, 0}, again;
  lab_fit_problem p = problem_of(&c);
  double theta[] = {1, 3, 0.5}, other[] = {1, 3, 0.5};
  int i;
  for (i = 0; i < ROWS; i++) {
    c.t[i] = 0.1 * i;
    c.y[i] = 2 * exp(-0.07 * i);
  }
  again = c;
  succeed(lab_fit(&p, theta, &chi2, &error));
  p.context = &again;
  p.is_rough = 1;
  succeed(lab_fit(&p, other, &chi2, &error));
  assert_true(again.asked[0] > c.asked[0]);
}

/* ---- The search before the descent ---- */

/* y = theta^2, of which -1 would do as well as 1, but for a second row that likes 1 better. */
static double two_wells(const double *theta, double t)
{
  return t == 0 ? theta[0] * theta[0] - 1 : t == 1 ? 0.1 * (theta[0] - 1) : 0;
}

static const double well_low[] = {-3}, well_high[] = {3};

static lab_fit_problem wells_of(trial *c, int search)
{
  lab_fit_problem p = problem_of(c);
  p.lower = well_low;
  p.upper = well_high;
  p.search = search;
  return p;
}

TEST(test_lab_fit__two_wells__search_finds_the_deeper)
{
  trial c = make_rows(1, two_wells);
  int search;
  for (search = 0; search <= 20; search += 20) {
    const lab_fit_problem p = wells_of(&c, search);
    double theta[] = {-1.1};
    succeed(lab_fit(&p, theta, &chi2, &error));
    assert_close(theta[0], search ? 1 : -0.99, 0.02, 0);
  }
}

/* Outside of -3 .. 3 there is no model, nor beyond 0.5; there the first well is the best. */
static double one_well(const double *theta, double t)
{
  if (!(theta[0] >= -3 && theta[0] <= 3))
    abort();
  return theta[0] > 0.5 ? (double)NAN : two_wells(theta, t);
}

TEST(test_lab_fit__search__avoids_what_fails_and_stays_within_the_bounds)
{
  trial c = make_rows(1, one_well);
  const lab_fit_problem p = wells_of(&c, 200);
  double theta[] = {-3};
  succeed(lab_fit(&p, theta, &chi2, &error));
  assert_close(theta[0], -0.99, 0.02, 0);
}

/* As many residuals as unknowns, each 0 at a quarter. */
static int quarters(void *context, const double *theta, double *r, lab_error *e)
{
  int j;
  (void)context, (void)e;
  for (j = 0; j < LAB_FIT_MAX; j++)
    r[j] = theta[j] - 0.25;
  return LAB_OK;
}

TEST(test_lab_fit__search_with_most_unknowns__stays_inside_and_finds_more)
{
  static double lower[LAB_FIT_MAX], upper[LAB_FIT_MAX], theta[LAB_FIT_MAX], r[LAB_FIT_MAX];
  const lab_fit_problem p = {.n = LAB_FIT_MAX,
                             .m = LAB_FIT_MAX,
                             .lower = lower,
                             .upper = upper,
                             .residuals = quarters,
                             .search = 4 * LAB_FIT_MAX};
  double before, after;
  int j;
  for (j = 0; j < LAB_FIT_MAX; j++) {
    lower[j] = -1;
    upper[j] = 2;
    theta[j] = 0.9;
  }
  succeed(lab_fit_evaluate(&p, theta, r, &before, &error));
  succeed(lab_fit_search(&p, theta, &error));
  succeed(lab_fit_evaluate(&p, theta, r, &after, &error));
  assert_true(after < 0.2 * before);
  for (j = 0; j < LAB_FIT_MAX; j++)
    assert_true(theta[j] >= -1 && theta[j] <= 2);
}

/* The start is the best of all, and no point of the search is. */
TEST(test_lab_fit__search_finds_nothing_better__goes_on_from_the_start)
{
  trial c = make_rows(1, two_wells);
  lab_fit_problem p = wells_of(&c, 3);
  double theta[] = {0.99};
  succeed(lab_fit_search(&p, theta, &error));
  assert_true(theta[0] == 0.99);
}

TEST(test_lab_fit__any_other_failure_in_the_search__ends_it_at_once)
{
  trial c = make_rows(1, one_well);
  const lab_fit_problem p = wells_of(&c, 200);
  double theta[] = {-1.1};
  c.failing = LAB_WORLD;
  assert_int_equal(lab_fit(&p, theta, &chi2, &error), LAB_WORLD);
  assert_string_equal(error.text, "no model here");
  assert_true(theta[0] == -1.1);
  assert_int_equal(c.asked[0], 0);
}

/* ---- Linear equations ---- */

TEST(test_lab_solve_positive__hilbert_matrix__gives_its_integer_inverse)
{
  static const double inverse[3][3] = {{9, -36, 30}, {-36, 192, -180}, {30, -180, 180}};
  int i, j, k;
  for (k = 0; k < 3; k++) {
    double a[3][5] = {{0}}, b[3] = {0};
    for (i = 0; i < 3; i++)
      for (j = 0; j < 3; j++)
        a[i][j] = 1.0 / (1 + i + j);
    b[k] = 1;
    assert_int_equal(lab_solve_positive(3, 5, &a[0][0], b), 0);
    for (i = 0; i < 3; i++)
      assert_close(b[i], inverse[i][k], 1e-10, 0);
    assert_close(a[1][0], 0.5, 1e-15, 0); /* of the factor */
    assert_close(a[1][1], sqrt(1.0 / 12), 1e-15, 0);
  }
}

TEST(test_lab_solve_positive__not_positive__is_refused)
{
  double saddle[] = {1, 2, 2, 1}, flat[] = {1, 1, 1, 1}, none[] = {1, 0, 0, NAN}, b[] = {1, 1};
  assert_int_equal(lab_solve_positive(2, 2, saddle, b), -1);
  assert_int_equal(lab_solve_positive(2, 2, flat, b), -1);
  assert_int_equal(lab_solve_positive(2, 2, none, b), -1);
}

/* ---- Columns that are 0 in parts ---- */

enum { LONG = 1500, WAVES = 9 };

/* Each unknown acts for a while: none, some or all of those before it do so too. */
static double wave(int j, int i)
{
  return i >= 150 * j && i < 150 * j + 400 ? 1e3 * sin((j + 1) * 0.01 * i) + 100 * j : 0;
}

static int residuals_of_waves(void *context, const double *theta, double *r, lab_error *e)
{
  int i, j;
  (void)context, (void)e;
  for (i = 0; i < LONG; i++)
    for (j = 0, r[i] = 0; j < WAVES; j++)
      r[i] += wave(j, i) * (theta[j] - (j - 3));
  return LAB_OK;
}

static int slope_of_wave(void *context, const double *theta, const double *r, int j, double *column, lab_error *e)
{
  int i;
  (void)context, (void)theta, (void)r, (void)e;
  for (i = 0; i < LONG; i++)
    column[i] = wave(j, i);
  return LAB_OK;
}

TEST(test_lab_fit__columns_zero_in_parts__one_step_suffices)
{
  double lower[WAVES], upper[WAVES], theta[WAVES] = {0};
  const lab_fit_problem p = {.n = WAVES,
                             .m = LONG,
                             .lower = lower,
                             .upper = upper,
                             .residuals = residuals_of_waves,
                             .slope = slope_of_wave,
                             .steps = 1};
  int j;
  for (j = 0; j < WAVES; j++)
    lower[j] = -100, upper[j] = 100;
  succeed(lab_fit(&p, theta, &chi2, &error));
  for (j = 0; j < WAVES; j++)
    assert_close(theta[j], j - 3, 1e-4, 0);
}
