/* apps/study/sets: which sets run, and the report over all */
#include "scratch.h"

#include "../apps/lab/config.h"
#include "../apps/study/sets.h"

static lab_error error;

#define SET(name, more)                                                                                                \
  "{ name = \"" name "\"; rig = \"r.cfg\"; title = \"T " name                                                          \
  "\"; folder = \"f\"; judged = \"pressure\"; unit = \"kPa\";"                                                         \
  "  declared = \"d\"; independent = \"i\"; remains = \"r\"; fit = ( \"a.csv\" ); holdout = ( \"b.csv\" ); " more " }"

static const config_setting_t *read_sets(config_t *config, const char *text)
{
  if (lab_config_read(config, scratch_text("sets.cfg", text), &error))
    fail_msg("%s", error.text);
  return config_lookup(config, "sets");
}

static void test_sets_run__no_data__are_absent(void **state)
{
  sets_result result[SETS_MAX];
  config_t config;
  int n;
  (void)state;
  assert_int_equal(sets_run(read_sets(&config, "sets = ( " SET("one", "") ", " SET("two", "") " );"),
                            scratch_path("nowhere"), scratch_path("out"), result, &n, &error),
                   LAB_OK);
  assert_int_equal(n, 2);
  assert_int_equal(result[0].state, SETS_ABSENT);
  assert_int_equal(result[1].state, SETS_ABSENT);
  config_destroy(&config);
}

static void test_sets_run__set_without_its_words__is_refused(void **state)
{
  sets_result result[SETS_MAX];
  config_t config;
  int n;
  (void)state;
  assert_int_equal(sets_run(read_sets(&config, "sets = ( { name = \"one\"; } );"), scratch_path("nowhere"),
                            scratch_path("out"), result, &n, &error),
                   LAB_DATA);
  assert_contains(error.text, "expected the text rig");
  config_destroy(&config);
}

static const char report[] =
    "{ \"sentence\": \"Well.\", \"found\": [ { \"effect\": \"chamber_leak\", \"indistinguishable_from\": [ "
    "\"supply_droop\" ] } ],"
    "  \"parameters\": { \"leak_area\": { \"value\": 2e-8, \"unit\": \"m2\", \"ci95\": [ 1e-8, 3e-8 ] } },"
    "  \"error\": { \"before\": { \"pressure\": { \"rmse\": 4000, \"unit\": \"Pa\", \"in_noise\": 40 },"
    "                           \"temperature\": { \"rmse\": 31, \"unit\": \"K\", \"in_noise\": 0 } },"
    "             \"after\": { \"pressure\": { \"rmse\": 250, \"unit\": \"Pa\", \"in_noise\": 2.5 },"
    "                          \"temperature\": { \"rmse\": 15, \"unit\": \"K\", \"in_noise\": 0 } },"
    "             \"holdout\": { \"before\": { \"pressure\": { \"rmse\": 5000, \"unit\": \"Pa\", \"in_noise\": 50 } },"
    "                            \"after\": { \"pressure\": { \"rmse\": 750, \"unit\": \"Pa\", \"in_noise\": 7.5 } } } "
    "} }";

static void test_sets_report__rows__are_those_of_the_reports(void **state)
{
  sets_result result[3];
  config_t config;
  const config_setting_t *list;
  char *text;
  (void)state;
  list = read_sets(
      &config,
      "sets = ( " SET("one", "check = \"temperature\"; check_unit = \"K\"; per_unit = 2.0; per_name = \"N\";") ", " SET(
          "two", "") ", " SET("three", "") " );");
  assert_int_equal(mkdir(scratch_path("one"), 0777), 0);
  scratch_text("one/report.json", report);
  result[0] = (sets_result){config_setting_get_elem(list, 0), SETS_DONE};
  result[1] = (sets_result){config_setting_get_elem(list, 1), SETS_ABSENT};
  result[2] = (sets_result){config_setting_get_elem(list, 2), SETS_FAILED};
  if (sets_report(result, 3, scratch_path("."), &error))
    fail_msg("%s", error.text);
  text = scratch_read(scratch_path("REPORT.md"));
  assert_contains(
      text, "| [T one](one/report.json) | pressure [kPa] | 4 | 0.25 | 40 | 2.5 | 5 | 0.75 | 50 | 7.5 | chamber_leak |");
  assert_contains(text, "temperature [K] | | | | | 31 | 15 |");
  assert_contains(text, "| pressure [kPa] | data absent |");
  assert_contains(text, "| pressure [kPa] | closeloop failed |");
  assert_contains(text, "leak_area = 2e-08 (1e-08 to 3e-08) m2");
  assert_contains(text, "cannot tell it from: supply_droop (for chamber_leak)");
  assert_contains(text, "In N, at 2 a kPa: 8 before, 0.5 after; held out 10 and 1.5.");
  free(text);
  config_destroy(&config);
}

int main(void)
{
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(test_sets_run__no_data__are_absent),
      cmocka_unit_test(test_sets_run__set_without_its_words__is_refused),
      cmocka_unit_test(test_sets_report__rows__are_those_of_the_reports),
  };
  return cmocka_run_group_tests_name("sets", tests, scratch_open, scratch_close);
}
