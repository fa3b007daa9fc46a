/* What a candidate costs, whichever way its fit is done. */
#include <math.h>

#include "../../check.h"
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/fit/nuisance.h"
#include "../../../apps/lab/trace/refit.h"

enum { ROWS = 501, COMMANDS = 3 };

/* In:  skew  [s] by which the position is older than the pressure beside it */
static void write_log(double skew, const char *path)
{
  static const double t_cmd[COMMANDS] = {0.402, 2.003, 3.501}, u_cmd[COMMANDS] = {1, -1, 0.5};
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = COMMANDS};
  second_rig g = virtual_rig(second_rig_default_r1_400().seed);
  g.position_skew = skew;
  virtual_write(&g, &course, 5, 0.01, path);
}

/* Instants of commands are known to their rows: they cost nothing, whether they are fitted or vary unseen. With
 * friction alone to count, the price is the logarithm of the number of values. */
static void test_lab_candidate_fit__instants_of_commands__cost_nothing_either_way(void **state)
{
  static lab_rig rig;
  static lab_log recorded;
  static lab_run run;
  static lab_candidate whole, folded;
  static lab_nuisance nuisance;
  const char *path = scratch_path("log.csv");
  const double price = log(2 * ROWS);
  size_t i;
  lab_error error = {0, ""};
  (void)state;
  write_log(0, path);
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = pneu_param_find("dry_friction");
  assert_int_equal(lab_log_read(path, &rig.log, 101325, &recorded, &error), LAB_OK);
  assert_int_equal(lab_run_open(&rig, &recorded, 0, &run, &error), LAB_OK);
  assert_int_equal(lab_unknowns_open(&rig, &run, 1, &whole.u, &error), LAB_OK);
  assert_int_equal(whole.u.n, 1 + COMMANDS);
  assert_int_equal(lab_candidate_fit(&whole, LAB_ROUNDS_ALL, &error), LAB_OK);
  folded.u = whole.u;
  assert_int_equal(lab_nuisance_open(&folded.u, &nuisance, &error), LAB_OK);
  assert_int_equal(folded.u.n, 1);
  assert_int_equal(lab_candidate_fit(&folded, LAB_ROUNDS_ALL, &error), LAB_OK);
  assert_close(whole.quality.bic - whole.quality.chi2, price, 1e-6, 0);
  assert_close(folded.quality.bic - folded.quality.chi2, price, 1e-6, 0);
  /* the instants come back with the slopes that they had, which the next fit begins with */
  assert_int_equal(lab_nuisance_return(&folded.u, &error), LAB_OK);
  assert_int_equal(lab_unknowns_keep_slopes(&folded.u, &error), LAB_OK);
  lab_nuisance_begin_with(&nuisance, &folded.u);
  assert_false(folded.u.has_slope[0]);
  whole.u.slopes = NULL;
  assert_int_equal(lab_unknowns_keep_slopes(&whole.u, &error), LAB_OK);
  assert_int_equal(lab_unknowns_find_slopes(&whole.u, &error), LAB_OK);
  assert_int_equal(whole.u.m, folded.u.m);
  for (i = whole.u.m; i < whole.u.m * (size_t)whole.u.n; i++)
    assert_close(folded.u.slopes[i], whole.u.slopes[i], 0.02, 0.5);
  for (i = 1; i < (size_t)whole.u.n; i++)
    assert_true(folded.u.has_slope[i]);
  lab_unknowns_forget_slopes(&whole.u);
  lab_unknowns_forget_slopes(&folded.u);
  lab_nuisance_close(&nuisance);
  lab_run_close(&run);
  lab_log_free(&recorded);
}

/* A clock is known to 5 ms: one that is 60 ms off is missing from what was declared, one that is 6 ms off is not. */
static void test_lab_candidate_take_instruments__clock__is_found_far_beyond_its_tolerance(void **state)
{
  static const double skew[] = {0.006, 0.06};
  static lab_rig rig;
  static lab_candidate c;
  int i, any;
  (void)state;
  for (i = 0; i < 2; i++) {
    const char *path = scratch_path("skewed.csv");
    lab_error error = {0, ""};
    lab_log recorded;
    lab_run run;
    write_log(skew[i], path);
    virtual_declare(&rig);
    rig.fit[rig.n_fit++] = pneu_param_find("dry_friction");
    assert_int_equal(lab_log_read(path, &rig.log, 101325, &recorded, &error), LAB_OK);
    assert_int_equal(lab_run_open(&rig, &recorded, 0, &run, &error), LAB_OK);
    memset(&c, 0, sizeof c);
    assert_int_equal(lab_unknowns_open(&rig, &run, 1, &c.u, &error), LAB_OK);
    assert_int_equal(lab_unknowns_hold(&c.u, &error), LAB_OK);
    assert_int_equal(lab_candidate_fit(&c, LAB_ROUNDS_ALL, &error), LAB_OK);
    assert_int_equal(lab_candidate_take_instruments(&c, &any, &error), LAB_OK);
    assert_int_equal(any, i);
    assert_int_equal(c.n_found, i);
    lab_run_close(&run);
    lab_log_free(&recorded);
  }
  assert_int_equal(c.found[0].effect, pneu_effect_find("channel_skew"));
  assert_close((double)*pneu_param_at(&c.u.rig.params, c.found[0].param), 0.06, 0, 0.02);
  assert_between(c.found[0].statistic, 50, 144); /* other tolerances take a part of it */
  assert_between(c.found[0].explained, 0.5, 1);
  assert_true(c.quality.strain < 3);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_candidate_fit__instants_of_commands__cost_nothing_either_way),
      cmocka_unit_test(test_lab_candidate_take_instruments__clock__is_found_far_beyond_its_tolerance),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
