/* Runs that follow the steps of another one. */
#include "../../fixture.h"

#include "../../../apps/lab/run/response.h"

enum { SAMPLES = 601, ROWS = 3 };
static const double dt = 0.01, t_end = 6;
static const double row_t[ROWS] = {0, 0.2, 3}, row_u[ROWS] = {0, 1, -1};

/* Position at the samples of the first `rows` rows.  Out: stats  may be NULL */
static int try_to_respond(const pneu_model *m, size_t rows, double tol, lab_pace *pace, double *x, pneu_stats *stats)
{
  pneu_input input[ROWS];
  double t[SAMPLES];
  pneu_state start;
  lab_response response;
  lab_error error;
  size_t i;
  const lab_schedule schedule = {rows, row_t, input};
  const lab_simulation task = {.start = &start,
                               .schedule = &schedule,
                               .t = t,
                               .n = SAMPLES,
                               .t_end = t_end,
                               .options = {.tol = pace ? 0 : tol},
                               .pace = pace,
                               .stats = stats};
  for (i = 0; i < ROWS; i++)
    input[i] = fixture_input(m, row_u[i]);
  for (i = 0; i < SAMPLES; i++)
    t[i] = fmin((double)i * dt, t_end);
  start = fixture_rest(m, 0, 0, &input[0]);
  if (pace)
    pace->tol = tol;
  if (lab_response_run(m, &task, &response, &error))
    return error.status;
  memcpy(x, response.x, sizeof t);
  lab_response_free(&response);
  return LAB_OK;
}

static void respond(const pneu_model *m, size_t rows, double tol, lab_pace *pace, double *x, pneu_stats *stats)
{
  assert_int_equal(try_to_respond(m, rows, tol, pace, x, stats), LAB_OK);
}

static void test_lab_pace__same_model__is_the_same_run_without_refusals(void **state)
{
  static double first[SAMPLES], again[SAMPLES];
  const pneu_model m = fixture_quick(PNEU_GAS_ENERGY, NULL, 0);
  lab_pace pace = {0};
  pneu_stats of_first, of_again;
  int i;
  (void)state;
  respond(&m, ROWS, 1e-6, &pace, first, &of_first);
  assert_true(pace.is_set);
  assert_int_equal(pace.rows, ROWS);
  assert_int_equal(pace.n, of_first.steps);
  respond(&m, ROWS, 1e-6, &pace, again, &of_again);
  for (i = 0; i < SAMPLES; i++)
    assert_close(again[i], first[i], 1e-9, 0); /* events are exact to 1e-9 s */
  assert_between((double)of_again.steps, (double)of_first.steps, (double)(of_first.steps + of_first.events));
  assert_int_equal(of_again.events, of_first.events);
  assert_true(of_first.rejected > 0);
  assert_int_equal(of_again.rejected, 0);
  lab_pace_close(&pace);
  assert_true(pace.step == NULL && pace.n == 0 && !pace.is_set);
}

/* Largest error of the slope of position in a parameter, by differences of runs at a rough tolerance, over the largest
 * slope; the slope by differences of exact runs. */
static double slope_error(const char *name, double value, double step, lab_pace *pace)
{
  static double base[SAMPLES], there[SAMPLES], below[SAMPLES], above[SAMPLES];
  const double rough = 1e-4, exact = 1e-10;
  const pneu_model m = fixture_quick(PNEU_GAS_ENERGY, name, value),
                   up = fixture_quick(PNEU_GAS_ENERGY, name, value + step),
                   down = fixture_quick(PNEU_GAS_ENERGY, name, value - step);
  double worst = 0, largest = 0;
  int i;
  respond(&m, ROWS, rough, pace, base, NULL);
  respond(&up, ROWS, rough, pace, there, NULL);
  respond(&up, ROWS, exact, NULL, above, NULL);
  respond(&down, ROWS, exact, NULL, below, NULL);
  for (i = 0; i < SAMPLES; i++) {
    const double slope = (above[i] - below[i]) / 2;
    largest = fmax(largest, fabs(slope));
    worst = fmax(worst, fabs(there[i] - base[i] - slope));
  }
  return worst / largest;
}

/* Errors of steps cancel in a difference, also across the events, which keep their own time. */
static void test_lab_pace__rough_steps__slope_is_exact(void **state)
{
  static const struct {
    const char *name;
    double value, step;
  } of[] = {{"spring_rate", 1e5, 0.1}, {"dry_friction", 480, 0.001}, {"area", 0.04, 4e-8}, {"damping", 1000, 0.01}};
  double rough = 0;
  int i;
  (void)state;
  for (i = 0; i < COUNT(of); i++) {
    lab_pace pace = {0};
    const double with = slope_error(of[i].name, of[i].value, of[i].step, &pace);
    const double without = slope_error(of[i].name, of[i].value, of[i].step, NULL);
    check_note("%s: %g with, %g without", of[i].name, with, without);
    assert_between(with, 0, 0.01);
    rough = fmax(rough, without);
    lab_pace_close(&pace);
  }
  assert_true(rough > 0.1); /* of its own steps one is refused here and not there */
}

/* Another number of rows cannot be followed: who takes a difference has to know. */
static void test_lab_pace__another_schedule__is_refused(void **state)
{
  static double x[SAMPLES];
  const pneu_model m = fixture_quick(PNEU_GAS_ENERGY, NULL, 0);
  lab_pace pace = {0};
  (void)state;
  respond(&m, ROWS, 1e-6, &pace, x, NULL);
  assert_int_equal(try_to_respond(&m, ROWS - 1, 1e-6, &pace, x, NULL), LAB_NUMERIC);
  lab_pace_close(&pace);
}

/* The steps of a model that hardly moves are too long for one that does: they are shortened. */
static void test_lab_pace__far_model__is_still_followed_closely(void **state)
{
  static double still[SAMPLES], paced[SAMPLES], exact[SAMPLES];
  const pneu_model rigid = fixture_quick(PNEU_GAS_ENERGY, "dry_friction", 2e4),
                   m = fixture_quick(PNEU_GAS_ENERGY, NULL, 0);
  lab_pace pace = {0};
  int i;
  (void)state;
  respond(&rigid, ROWS, 1e-6, &pace, still, NULL);
  respond(&m, ROWS, 1e-6, &pace, paced, NULL);
  respond(&m, ROWS, 1e-10, NULL, exact, NULL);
  assert_between(still[SAMPLES / 2], 0, 1e-6);
  assert_true(exact[SAMPLES / 2] > 0.01);
  for (i = 0; i < SAMPLES; i++)
    assert_close(paced[i], exact[i], 1e-4 * 0.02, 0);
  lab_pace_close(&pace);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_pace__same_model__is_the_same_run_without_refusals),
      cmocka_unit_test(test_lab_pace__rough_steps__slope_is_exact),
      cmocka_unit_test(test_lab_pace__another_schedule__is_refused),
      cmocka_unit_test(test_lab_pace__far_model__is_still_followed_closely),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
