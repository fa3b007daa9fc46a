/* The comparisons with public measurements, where these are on this machine; run from the project's root. */
#include "scratch.h"

#include <fcntl.h>
#include <string.h>

#include "../apps/study/measured.h"
#include "../apps/study/measured_damadics.h"
#include "../apps/study/measured_vessel.h"
#include "../apps/study/servomotor.h"
#include "../apps/study/vessel.h"

static lab_error error;

#define succeed(call)                                                                                                  \
  do {                                                                                                                 \
    if ((call) != LAB_OK)                                                                                              \
      fail_msg("%s", error.text);                                                                                      \
  } while (0)

/* Paths of the data, or NULL where they are absent: set by main, which says so once. */
static const char *vessel_path, *loop_path;

/* ---- Vessel ---- */

static void open_vessel(vessel *v)
{
  if (!vessel_path)
    skip();
  succeed(vessel_open("study/measured/vessel.cfg", vessel_path, v, &error));
}

typedef struct vessel_fitted {
  lab_fit_result fit;
  vessel_error p, T;
} vessel_fitted;

static vessel_fitted fit_law(const vessel *v, const char *name)
{
  vessel_fitted f;
  int i = 0;
  while (i < vessel_law_count && strcmp(vessel_laws[i].name, name))
    i++;
  assert_true(i < vessel_law_count);
  check_note("%s", name);
  succeed(vessel_fit(v, &vessel_laws[i], NULL, &f.fit, &error));
  succeed(vessel_errors(v, &vessel_laws[i], f.fit.theta, LAB_CHANNEL_P, NULL, 1, &f.p, &error));
  succeed(vessel_errors(v, &vessel_laws[i], f.fit.theta, LAB_CHANNEL_T, NULL, 1, &f.T, &error));
  return f;
}

static const double hole = 0.25 * 3.14159265358979323846 * 2.71e-3 * 2.71e-3; /* [m2] of the source file */

static void test_vessel__record__read_whole(void **state)
{
  vessel v;
  size_t i, n_p = 0, n_T = 0;
  (void)state;
  open_vessel(&v);
  for (i = 0; i < v.log.n; i++) {
    n_p += !isnan(v.log.value[LAB_CHANNEL_P][i]);
    n_T += !isnan(v.log.value[LAB_CHANNEL_T][i]);
  }
  assert_int_equal(n_p, 15);
  assert_int_equal(n_T, 14);
  assert_close(v.rig.params.dead_volume, 0.25 * 3.14159265358979323846 * 0.2 * 0.2 * 0.515, 0, 1e-5);
  assert_close(v.rig.params.vent_area, 0.84 * hole, 0, 1e-4);
  vessel_close(&v);
}

static void test_vessel__energy_balance__pressure_below_2_5_kPa_and_the_source_s_orifice(void **state)
{
  static const char *const laws[] = {"film", "convection"};
  vessel v;
  int i;
  (void)state;
  open_vessel(&v);
  for (i = 0; i < 2; i++) {
    const vessel_fitted f = fit_law(&v, laws[i]);
    assert_between(f.p.rmse, 1.5e3, 2.5e3);             /* measured: 1.96 and 2.02 kPa */
    assert_close(f.fit.theta[0], 0.84 * hole, 0, 0.02); /* 1.003 and 0.992 of it */
    assert_true(f.fit.low[0] < 0.84 * hole && f.fit.high[0] > 0.84 * hole);
    assert_between(f.T.rmse, 15, 18); /* predicted, not fitted: 16.2 and 16.9 K */
  }
  vessel_close(&v);
}

static void test_vessel__simpler_laws__worse_by_what_the_study_says(void **state)
{
  vessel v;
  vessel_fitted f;
  (void)state;
  open_vessel(&v);
  f = fit_law(&v, "isothermal");
  assert_close(f.p.rmse, 13.84e3, 0.1e3, 0);
  assert_close(f.T.rmse, 32.3, 0.1, 0); /* 298 K throughout: no fit in it */
  f = fit_law(&v, "adiabatic");
  assert_close(f.p.rmse, 8.41e3, 0.1e3, 0);
  assert_close(f.T.rmse, 80.4, 0.5, 0);
  f = fit_law(&v, "polytropic");
  assert_int_equal(f.fit.state[1], LAB_FIT_AT_UPPER);
  f = fit_law(&v, "paper");
  assert_close(f.p.rmse, 5.56e3, 0.1e3, 0);
  assert_close(f.fit.theta[0] / hole, 0.555, 0.01, 0); /* a third below the source's 0.84 */
  vessel_close(&v);
}

/* ---- Static loop ---- */

static void open_servo(servomotor *s)
{
  if (!loop_path)
    skip();
  succeed(servo_read("study/measured/damadics.cfg", loop_path, s, &error));
}

static const servo_law *servo_law_named(const char *name)
{
  int i = 0;
  while (i < servo_law_count && strcmp(servo_laws[i].name, name))
    i++;
  assert_true(i < servo_law_count);
  return &servo_laws[i];
}

static lab_fit_result fit_servo(const servomotor *s, const char *name)
{
  lab_fit_result fit;
  check_note("%s", name);
  succeed(servo_fit(s, servo_law_named(name), NULL, &fit, &error));
  return fit;
}

static void test_servo__loop__read_whole(void **state)
{
  servomotor s;
  size_t i, sliding = 0;
  (void)state;
  open_servo(&s);
  for (i = 0; i < s.n; i++)
    sliding += s.sliding[i];
  assert_int_equal(s.n, 43);
  assert_int_equal(sliding, 33);
}

static void test_servo__kept_law__below_0_3_kPa_where_coulomb_is_not(void **state)
{
  servomotor s;
  lab_fit_result fit;
  (void)state;
  open_servo(&s);
  fit = fit_servo(&s, "coulomb");
  assert_between(fit.rmse, 0.5e3, 0.65e3); /* measured: 0.573 kPa */
  fit = fit_servo(&s, "friction-position+hardening");
  assert_between(fit.rmse, 0.2e3, 0.3e3); /* measured: 0.265 kPa */
  assert_int_equal(fit.n_free, 5);
  assert_true(fit.low[3] > 0 && fit.low[4] > 0); /* both terms are there */
}

static void test_servo__friction_by_travel_or_by_pressure__a_static_loop_cannot_tell(void **state)
{
  servomotor s;
  (void)state;
  open_servo(&s);
  assert_close(fit_servo(&s, "friction-position").rmse, fit_servo(&s, "friction-pressure").rmse, 0, 1e-6);
}

static void test_servo__slow_ramp__passes_where_the_forces_balance(void **state)
{
  enum { N = 116 };
  double p[2 * N], x[2 * N], balanced;
  const servo_law *law = servo_law_named("coulomb");
  servomotor s;
  lab_fit_result fit;
  int i, compared = 0;
  (void)state;
  open_servo(&s);
  fit = fit_servo(&s, "coulomb");
  succeed(servo_ramp(&s, law, fit.theta, 115e3, N, p, x, &error));
  assert_true(x[0] == 0 && x[N - 1] == s.rig.params.stroke && x[2 * N - 1] == 0);
  for (i = 0; i < 2 * N; i++) {
    const int stays = i > 0 && x[i] == x[i - 1];
    if (x[i] <= 0 || x[i] >= s.rig.params.stroke || stays)
      continue;
    succeed(servo_pressure(&s, law, fit.theta, x[i], i < N ? 1 : -1, &balanced, &error));
    assert_close(p[i], balanced, 15, 0); /* [Pa]: viscous friction at 1 kPa/s is 6 Pa */
    compared++;
  }
  assert_true(compared > 140);
}

/* ---- Whole comparisons ---- */

/* Field `column` of line `row` of a table, both from 0. */
static double field(const char *text, int row, int column)
{
  while (row-- > 0) {
    text = strchr(text, '\n');
    assert_non_null(text);
    text++;
  }
  while (column-- > 0) {
    text = strchr(text, ',');
    assert_non_null(text);
    text++;
  }
  return strtod(text, NULL);
}

static void test_measured_damadics__steps__fall_is_the_faster_one(void **state)
{
  char *text;
  (void)state;
  if (!loop_path)
    skip();
  succeed(measured_damadics("study", measured_folder(), scratch_folder, &error));
  assert_true(scratch_exists(scratch_path("measured_damadics_static.csv")));
  assert_true(scratch_exists(scratch_path("measured_damadics_loop.csv")));
  assert_true(scratch_exists(scratch_path("measured_damadics_catalogue.csv")));
  text = scratch_read(scratch_path("measured_damadics_steps.csv"));
  assert_close(field(text, 1, 5), 0.716, 0.005, 0);           /* fall over rise */
  assert_close(field(text, 1, 6), 0.050, 0.005, 0);           /* asymmetry */
  assert_close(field(text, 1, 7), 3.72, 0.05, 0);             /* [s] rise, first-order */
  assert_close(field(text, 1, 13), 4.11, 0.05, 0);            /* [s] fall, integrator */
  assert_true(field(text, 1, 12) < 0.1 * field(text, 1, 14)); /* a lag fits the fall better than an integrator */
  free(text);
}

static void test_measured_vessel__whole__tables_written(void **state)
{
  char *text;
  (void)state;
  if (!vessel_path)
    skip();
  succeed(measured_vessel("study", measured_folder(), scratch_folder, &error));
  text = scratch_read(scratch_path("measured_vessel.csv"));
  assert_non_null(strstr(text, ",n [1],remark\n"));
  assert_non_null(strstr(text, ",1.4,polytropic_index is at its upper bound\n")); /* the adiabatic law again */
  free(text);
  assert_true(scratch_exists(scratch_path("measured_vessel_parameters.csv")));
  assert_true(scratch_exists(scratch_path("measured_vessel_curves.csv")));
}

static void test_measured__no_data__absent_and_nothing_written(void **state)
{
  const char *nowhere = scratch_path("nowhere");
  const int shown = dup(STDERR_FILENO);
  char empty[512];
  int vessel_status, servo_status;
  (void)state;
  snprintf(empty, sizeof empty, "%s", scratch_path("empty"));
  fflush(stderr);
  assert_true(dup2(open("/dev/null", O_WRONLY), STDERR_FILENO) >= 0); /* what is said here is no news */
  vessel_status = measured_vessel("study", nowhere, empty, &error);
  servo_status = measured_damadics("study", nowhere, empty, &error);
  assert_true(dup2(shown, STDERR_FILENO) >= 0);
  assert_int_equal(vessel_status, MEASURED_ABSENT);
  assert_int_equal(servo_status, MEASURED_ABSENT);
  assert_false(scratch_exists(empty));
}

static void test_measured__damaged_loop__line_named(void **state)
{
  servomotor s;
  const char *path = scratch_text("loop.csv", "branch,p_kPa,x_percent\nlower,0.1,0\nsideways,5,1\n");
  (void)state;
  assert_int_equal(servo_read("study/measured/damadics.cfg", path, &s, &error), LAB_DATA);
  assert_non_null(strstr(error.text, "loop.csv:3"));
}

static const char *found(const char *name, char path[1024])
{
  return measured_path(measured_folder(), name, path, 1024, &error) == LAB_OK ? path : NULL;
}

int main(void)
{
  static char vessel_text[1024], loop_text[1024];
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_vessel__record__read_whole),
      cmocka_unit_test(test_vessel__energy_balance__pressure_below_2_5_kPa_and_the_source_s_orifice),
      cmocka_unit_test(test_vessel__simpler_laws__worse_by_what_the_study_says),
      cmocka_unit_test(test_servo__loop__read_whole),
      cmocka_unit_test(test_servo__kept_law__below_0_3_kPa_where_coulomb_is_not),
      cmocka_unit_test(test_servo__friction_by_travel_or_by_pressure__a_static_loop_cannot_tell),
      cmocka_unit_test(test_servo__slow_ramp__passes_where_the_forces_balance),
      cmocka_unit_test(test_measured_damadics__steps__fall_is_the_faster_one),
      cmocka_unit_test(test_measured_vessel__whole__tables_written),
      cmocka_unit_test(test_measured__no_data__absent_and_nothing_written),
      cmocka_unit_test(test_measured__damaged_loop__line_named),
  };
  vessel_path = found("vessel-air-charge-discharge/Air_790kPa_21mm.csv", vessel_text);
  loop_path = found("damadics-servomotor-static-step/static_hysteresis_fig5.csv", loop_text);
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
