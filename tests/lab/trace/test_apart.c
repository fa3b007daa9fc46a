/* Two logs of the independent rig, between which something was set anew, or has worn. */
#include "../../fixture.h"
#include "../../scratch.h"
#include "../../second/rig.h"

#include "../../../apps/lab/trace/apart.h"

enum { ROWS = 401, LOGS = 2, COMMANDS = 3 };
static const double spacing = 0.02; /* [s] */
static const double t_cmd[COMMANDS] = {0.402, 3.003, 5.507}, u_cmd[COMMANDS] = {1, -1, 0.5};

static lab_rig rig;
static lab_log logs[LOGS];
static lab_run run[LOGS];
static lab_unknowns u;
static lab_apart apart;
static lab_error error;

static second_rig true_rig(uint64_t seed)
{
  second_rig g = second_rig_default_r1_400();
  g.flow = SECOND_CHOKED;
  g.dead_volume = 4e-5;
  g.pressure_noise = 320;
  g.position_noise = 2e-5;
  g.step = 5e-5;
  g.seed = seed;
  return g;
}

static void write_log(const second_rig *g, const char *path)
{
  static double t[ROWS], u_log[ROWS], p[ROWS], x[ROWS];
  second_log log = {.t = t, .u = u_log, .p = p, .x = x};
  FILE *file = fopen(path, "w");
  int i;
  assert_non_null(file);
  assert_int_equal(second_run(g, t_cmd, u_cmd, COMMANDS, (ROWS - 1) * spacing, spacing, &log, NULL), 0);
  fprintf(file, "t [s],u [1],p [Pa],x [m]\n");
  for (i = 0; i < ROWS; i++)
    fprintf(file, "%.3f,%g,%.1f,%.7f\n", t[i], u_log[i], p[i], x[i]);
  fclose(file);
}

/* The logs of two rigs, fitted, and what differs between them. */
static void open_logs(const second_rig *first, const second_rig *second, int n)
{
  static const char *const fitted[] = {"dry_friction", "spring_preload"};
  const second_rig *of[LOGS] = {first, second};
  int i;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.params.dead_volume = (pneu_real)4e-5;
  rig.noise[LAB_CHANNEL_P] = 320;
  rig.noise[LAB_CHANNEL_X] = 2e-5;
  for (i = 0; i < COUNT(fitted); i++)
    rig.fit[rig.n_fit++] = pneu_param_find(fitted[i]);
  for (i = 0; i < n; i++) {
    const char *path = scratch_path(i ? "second.csv" : "first.csv");
    write_log(of[i], path);
    assert_int_equal(lab_log_read(path, &rig.log, 101325, &logs[i], &error), LAB_OK);
    assert_int_equal(lab_run_open(&rig, &logs[i], 0, &run[i], &error), LAB_OK);
  }
  assert_int_equal(lab_unknowns_open(&rig, run, n, &u, &error), LAB_OK);
  assert_int_equal(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error), LAB_OK);
  assert_int_equal(lab_apart_find(&u, &apart, &error), LAB_OK);
}

static void close_logs(int n)
{
  int i;
  for (i = 0; i < n; i++) {
    lab_run_close(&run[i]);
    lab_log_free(&logs[i]);
  }
}

static void find(const second_rig *first, const second_rig *second, int n)
{
  open_logs(first, second, n);
  close_logs(n);
}

static void test_lab_apart_find__preload_set_anew__is_of_each_log(void **state)
{
  second_rig first = true_rig(3), second = true_rig(4);
  double value[LOGS];
  int j, n = 0;
  (void)state;
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
static void test_lab_apart_find__friction_that_has_grown__is_of_the_rig(void **state)
{
  second_rig first = true_rig(3), second = true_rig(4);
  (void)state;
  second.dry_friction = 2 * first.dry_friction;
  find(&first, &second, LOGS);
  assert_int_equal(apart.n, 0);
}

static void test_lab_apart_find__logs_of_one_rig__have_nothing_of_their_own(void **state)
{
  second_rig first = true_rig(3), second = true_rig(4);
  (void)state;
  find(&first, &second, LOGS);
  assert_int_equal(apart.n, 0);
  find(&first, &second, 1);
  assert_int_equal(apart.n, 0);
}

/* What one preload for both leaves is more than noise; a preload for each explains it, and that is the answer. */
static void test_lab_apart_search__preload_set_anew__is_the_answer(void **state)
{
  static lab_unknowns completed;
  static lab_search_result result;
  static lab_logs bench;
  second_rig first = true_rig(3), second = true_rig(4);
  lab_search_options options;
  double before;
  (void)state;
  second.spring_preload = 1.2 * first.spring_preload;
  open_logs(&first, &second, LOGS);
  lab_search_options_default(&options);
  completed = u;
  assert_int_equal(lab_search_measure(&u, LAB_STAGE_BEFORE, &result, &error), LAB_OK);
  assert_int_equal(lab_search_measure(&u, LAB_STAGE_AFTER, &result, &error), LAB_OK);
  result.verdict = LAB_VERDICT_UNDECIDED;
  result.n_path = 1;
  before = result.before.chi2;
  assert_int_equal(lab_apart_search(&apart, &options, &bench, &completed, &result, &error), LAB_OK);
  assert_int_equal(result.verdict, LAB_VERDICT_NONE);
  assert_int_equal(result.n_own, 1);
  assert_int_equal(result.own[0], PNEU_PARAM_spring_preload);
  assert_int_equal(result.n_path, 2);
  assert_string_equal(result.path[1].name, "values of each log");
  assert_close(result.before.chi2, before, 0, 0);
  assert_between(result.after.chi2 / (double)result.after.n, 0.9, 1.1);
  assert_int_equal(bench.limitations.n, 1);
  assert_contains(bench.limitations.text[0], "The logs differ in spring_preload");
  close_logs(LOGS);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_lab_apart_find__preload_set_anew__is_of_each_log),
      cmocka_unit_test(test_lab_apart_find__friction_that_has_grown__is_of_the_rig),
      cmocka_unit_test(test_lab_apart_find__logs_of_one_rig__have_nothing_of_their_own),
      cmocka_unit_test(test_lab_apart_search__preload_set_anew__is_the_answer),
  };
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
