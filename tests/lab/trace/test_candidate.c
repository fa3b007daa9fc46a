/* apps/lab/trace/candidate: values that are held, and let go */
#include <math.h>

#include "../../check.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/candidate.h"
#include "../../../apps/lab/trace/decide.h"

static const double end = 14, spacing = 0.01; /* [s] */

static lab_rig rig;
static lab_log log_read;
static lab_run run;
static lab_candidate c;

/* The declared model within its tolerances, fitted to a log of a rig. */
static void hold(const second_rig *truth)
{
  const second_course course = {.t_cmd = virtual_t_cmd, .u_cmd = virtual_u_cmd, .n = VIRTUAL_COMMANDS};
  lab_error error = {0, ""};
  virtual_write(truth, &course, end, spacing, scratch_path("log.csv"));
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  assert_int_equal(lab_log_read(scratch_path("log.csv"), &rig.log, 101325, &log_read, &error), LAB_OK);
  assert_int_equal(lab_run_open(&rig, &log_read, 0, &run, &error), LAB_OK);
  assert_int_equal(lab_unknowns_open(&rig, &run, 1, &c.u, &error), LAB_OK);
  assert_int_equal(lab_candidate_hold(&c, &error), LAB_OK);
  assert_true(c.quality.fitted);
}

static void close_log(void)
{
  lab_run_close(&run);
  lab_log_free(&log_read);
}

static int count_let_go(void)
{
  int j, n = 0;
  for (j = 0; j < c.u.n; j++)
    n += lab_unknown_is_let_go(&c.u.unknown[j]);
  return n;
}

static void test_lab_candidate_let_go__one_value_far_off__is_found_without_its_prior(void **state)
{
  second_rig truth = virtual_rig(11);
  const double true_supply = truth.supply *= 0.9; /* five tolerances */
  double held, before;
  lab_error error = {0, ""};
  int j;
  (void)state;
  hold(&truth);
  j = lab_unknowns_find(&c.u, PNEU_PARAM_supply_pressure);
  held = c.u.unknown[j].value;
  before = c.quality.bic;
  assert_int_equal(lab_candidate_let_go(&c, &error), LAB_OK);
  assert_int_equal(count_let_go(), 1);
  assert_true(lab_unknown_is_let_go(&c.u.unknown[j]));
  assert_true(c.quality.bic < before - 10); /* the prior had cost 25 */
  assert_true(fabs(c.u.unknown[j].value - true_supply) < fabs(held - true_supply));
  assert_close(c.u.unknown[j].value, true_supply, 0, 5e-3);
  assert_close(c.quality.strain, 5, 0, 0.05); /* it is still told as so far off */
  close_log();
}

static void test_lab_candidate_let_go__as_declared__keeps_all(void **state)
{
  const second_rig truth = virtual_rig(11);
  lab_error error = {0, ""};
  (void)state;
  hold(&truth);
  assert_int_equal(lab_candidate_let_go(&c, &error), LAB_OK);
  assert_int_equal(count_let_go(), 0);
  close_log();
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_candidate_let_go__one_value_far_off__is_found_without_its_prior),
      cmocka_unit_test(test_lab_candidate_let_go__as_declared__keeps_all),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
