/* apps/lab/trace/rivals: an effect gives way to the one that the logs ask for, and keeps its place against all others
 */
#include "../../check.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/rivals.h"

static const double end = 14, spacing = 0.01; /* [s] */

static lab_rig rig;
static lab_log log_read;
static lab_run run;
static lab_candidate c;

/* A log of a rig, and its declared model with effects of some size, fitted with all that is held. */
static void find(const second_rig *truth, const char *const param[], const double size[], int n)
{
  const second_course course = {.t_cmd = virtual_t_cmd, .u_cmd = virtual_u_cmd, .n = VIRTUAL_COMMANDS};
  lab_error error = {0, ""};
  int i;
  virtual_write(truth, &course, end, spacing, scratch_path("log.csv"));
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  assert_int_equal(lab_log_read(scratch_path("log.csv"), &rig.log, 101325, &log_read, &error), LAB_OK);
  assert_int_equal(lab_run_open(&rig, &log_read, 0, &run, &error), LAB_OK);
  memset(&c, 0, sizeof c);
  assert_int_equal(lab_unknowns_open(&rig, &run, 1, &c.u, &error), LAB_OK);
  assert_int_equal(lab_candidate_hold(&c, &error), LAB_OK);
  for (i = 0; i < n; i++) {
    const int index = pneu_param_find(param[i]);
    const lab_score score = {.effect = pneu_effect_of(index), .param = index, .shape = -1};
    assert_int_equal(lab_candidate_add_effect(&c, &score, size[i], &error), LAB_OK);
  }
  assert_int_equal(lab_candidate_fit(&c, LAB_ROUNDS_ALL, &error), LAB_OK);
  assert_true(c.quality.fitted);
}

static void close_log(void)
{
  lab_run_close(&run);
  lab_log_free(&log_read);
}

static void expect_effect(int which, const char *name)
{
  assert_string_equal(pneu_effect_at(c.found[which].effect)->name, name);
}

static void test_lab_rivals_try__second_best_effect__gives_way_to_the_true_one(void **state)
{
  static const char *const param[] = {"spring_hardening.spring_cubic"};
  static const double size[] = {5e7};
  second_rig truth = virtual_rig(11);
  lab_error error = {0, ""};
  double before;
  int changed;
  (void)state;
  truth.area_slope = 0.05;
  find(&truth, param, size, 1);
  before = c.quality.bic;
  assert_int_equal(lab_rivals_try(&c, &changed, &error), LAB_OK);
  assert_true(changed);
  assert_int_equal(c.n_found, 1);
  expect_effect(0, "area_variation");
  assert_true(c.quality.bic < before - 10);
  assert_true(lab_is_noise(&c.quality));
  assert_close(c.u.unknown[lab_unknowns_find(&c.u, c.found[0].param)].value, truth.area_slope, 0, 0.1);
  assert_true(c.found[0].explained > 0.9);
  close_log();
}

static void test_lab_rivals_try__true_effects__stay_in_their_order(void **state)
{
  static const char *const param[] = {"area_variation.area_loss", "dead_time.dead_time"};
  static const double size[] = {0.04, 0.04};
  second_rig truth = virtual_rig(12);
  lab_error error = {0, ""};
  int changed;
  (void)state;
  truth.area_slope = 0.05;
  truth.dead_time = 0.05;
  find(&truth, param, size, 2);
  assert_int_equal(lab_rivals_try(&c, &changed, &error), LAB_OK);
  assert_false(changed);
  expect_effect(0, "area_variation");
  expect_effect(1, "dead_time");
  close_log();
}

/* An instrument that is taken out of what was found is as well known as before. */
static void test_lab_candidate_drop__gain_of_a_sensor__is_held_again(void **state)
{
  static const char *const param[] = {"position_gain.position_gain"};
  static const double size[] = {-0.02};
  second_rig truth = virtual_rig(13);
  int j;
  (void)state;
  truth.position_gain = -0.02;
  find(&truth, param, size, 1);
  j = lab_unknowns_find(&c.u, pneu_param_find(param[0]));
  assert_false(lab_unknown_is_held(&c.u.unknown[j]));
  assert_true(c.u.unknown[j].value < -1e-3);
  lab_candidate_drop(&c, 0);
  assert_true(lab_unknown_is_held(&c.u.unknown[j]));
  assert_close(c.u.unknown[j].value, 0, 0, 0);
  assert_close(*pneu_param_at(&c.u.rig.params, c.u.unknown[j].index), 0, 0, 0);
  close_log();
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_rivals_try__second_best_effect__gives_way_to_the_true_one),
      cmocka_unit_test(test_lab_rivals_try__true_effects__stay_in_their_order),
      cmocka_unit_test(test_lab_candidate_drop__gain_of_a_sensor__is_held_again),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
