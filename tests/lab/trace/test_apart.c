/* Two logs of the independent rig, between which something was set anew, or has worn. */
#include "../../scratch.h"
#include "../../virtual.h"

#include "../../../apps/lab/trace/apart.h"

enum { LOGS = 2 };

static lab_rig rig;
static lab_log logs[LOGS];
static lab_run run[LOGS];
static lab_unknowns u;
static lab_apart apart;

/* The logs of two rigs, fitted, and what differs between them. */
static void find(const second_rig *first, const second_rig *second, int n)
{
  const second_rig *of[LOGS] = {first, second};
  int i;
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
  for (i = 0; i < n; i++) {
    const char *path = scratch_path(i ? "second.csv" : "first.csv");
    virtual_record_brief(of[i], path);
    virtual_open(&rig, path, &logs[i], &run[i]);
  }
  succeed(lab_unknowns_open(&rig, run, n, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  succeed(lab_apart_find(&u, &apart, &error));
}

TEST(test_lab_apart_find__preload_set_anew__is_of_each_log)
{
  second_rig first = virtual_rig(3), second = virtual_rig(4);
  double value[LOGS];
  int j, n = 0;
  second.spring_preload = 1.2 * first.spring_preload;
  find(&first, &second, LOGS);
  assert_int_equal(apart.n, 1);
  assert_int_equal(apart.param[0], PNEU_PARAM_spring_preload);
  for (j = 0; j < apart.declared.n; j++)
    if (apart.declared.unknown[j].index == PNEU_PARAM_spring_preload &&
        apart.declared.unknown[j].kind == LAB_UNKNOWN_PARAM)
      value[n++] = apart.declared.unknown[j].value;
  assert_int_equal(n, LOGS);
  assert_close(value[0], first.spring_preload, 0, 0.01);
  assert_close(value[1], second.spring_preload, 0, 0.01);
}

/* Friction belongs to the rig: that it grows is a finding, and no value of a log. */
TEST(test_lab_apart_find__friction_that_has_grown__is_of_the_rig)
{
  second_rig first = virtual_rig(3), second = virtual_rig(4);
  second.dry_friction = 2 * first.dry_friction;
  find(&first, &second, LOGS);
  assert_int_equal(apart.n, 0);
}

TEST(test_lab_apart_find__logs_of_one_rig__have_nothing_of_their_own)
{
  second_rig first = virtual_rig(3), second = virtual_rig(4);
  find(&first, &second, LOGS);
  assert_int_equal(apart.n, 0);
  find(&first, &second, 1);
  assert_int_equal(apart.n, 0);
}

/* What one preload for both leaves is more than noise; a preload for each explains it, and that is the answer. */
TEST(test_lab_apart_search__preload_set_anew__is_the_answer)
{
  static lab_unknowns completed;
  static lab_search_result result;
  static lab_logs bench;
  second_rig first = virtual_rig(3), second = virtual_rig(4);
  lab_search_options options;
  double before;
  second.spring_preload = 1.2 * first.spring_preload;
  find(&first, &second, LOGS);
  lab_search_options_default(&options);
  completed = u;
  succeed(lab_search_measure(&u, LAB_STAGE_BEFORE, &result, &error));
  succeed(lab_search_measure(&u, LAB_STAGE_AFTER, &result, &error));
  result.verdict = LAB_VERDICT_UNDECIDED;
  result.n_path = 1;
  before = result.before.chi2;
  succeed(lab_apart_search(&apart, &options, &bench, &completed, &result, &error));
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(result.n_own, 1);
  assert_int_equal(result.own[0], PNEU_PARAM_spring_preload);
  assert_int_equal(result.n_path, 2);
  assert_string_equal(result.path[1].name, "values of each log");
  assert_close(result.before.chi2, before, 0, 0);
  assert_between(result.after.chi2 / (double)result.after.n, 0.9, 1.1);
  assert_int_equal(bench.limitations.n, 1);
  assert_contains(bench.limitations.text[0], "The logs differ in spring_preload");
}
