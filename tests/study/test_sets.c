/* apps/study/sets: which sets run, and the report over all */
#include "../scratch.h"

#include "../../apps/lab/base/config.h"

#include "../../apps/study/sets.h"
#include "../../apps/study/table.h"

#define SET(name, more)                                                                                                \
  "{ name = \"" name "\"; rig = \"damadics-servomotor-static-step.cfg\"; title = \"T " name                            \
  "\"; folder = \"f\"; judged = \"position\"; unit = \"mm\";"                                                          \
  "  declared = \"d\"; independent = \"i\"; remains = \"r\"; fit = ( \"a.csv\", \"b.csv\" ); holdout = ( "             \
  "\"c.csv\", \"a.csv\" ); "                                                                                           \
  "" more " }"
#define ONE(more) "sets = ( " SET("one", more) " );"

static const config_setting_t *read_sets(config_t *config, const char *text)
{
  succeed(lab_config_read(config, scratch_text("sets.cfg", text), &error));
  return config_lookup(config, "sets");
}

/* Run sets without their data.  Returns: how many are absent; -1 if they are refused */
static int absent(const char *text)
{
  static sets_result result[SETS_MAX];
  config_t config;
  int n, i, count = 0;
  const int status =
      sets_run(read_sets(&config, text), scratch_path("nowhere"), scratch_path("out"), result, &n, &error);
  config_destroy(&config);
  for (i = 0; i < n; i++)
    count += result[i].state == SETS_ABSENT;
  return status == LAB_OK ? count : status == LAB_DATA ? -1 : -2;
}

TEST(test_sets_run__no_data__are_absent)
{
  assert_int_equal(absent("sets = ( " SET("one", "") ", " SET("two", "") " );"), 2);
}

TEST(test_sets_run__set_that_lacks_something__is_refused)
{
  assert_int_equal(absent("sets = ( { name = \"one\"; } );"), -1);
  assert_contains(error.text, "expected the text rig");
  assert_int_equal(absent(ONE("sensor = \"lag\";")), -1);
  assert_contains(error.text, "sensor needs a channel as check");
}

/* ---- The report ---- */

static const char residual[] =
    "run [1],t [s],x [m],x_before [m],x_after [m]\n1,0,0.001,0,0.002\n1,1,0.004,0,0.001\n1,2,0.006,0,0.004\n1,3,,,\n"
    "1,4,0.003,0,0.002\n2,0,0.001,0,0.003\n2,1,0.001,0,0.001\n";

/* A report of closeloop, ' in the place of ": H stands for verdict and sentence, @ for the error held out in the end.
 */
static const char report[] =
    "{ H, 'found': [ { 'effect': 'presliding', 'indistinguishable_from': [ 'position_lag' ] },"
    "                { 'effect': 'pressure_gain', 'indistinguishable_from': [] } ],"
    "  'parameters': { 'spring_rate': { 'value': 284409.3, 'unit': 'N/m', 'ci95': [ 2e5, 3e5 ] },"
    "                  'presliding.x': { 'value': 1, 'unit': '1', 'ci95': [ 1, 1 ] } },"
    "  'undetermined': 'x is at its bound', 'limitations': [ 'too short' ],"
    "  'error': { 'before': { 'position': { 'rmse': 4e-3, 'unit': 'm', 'in_noise': 40 } },"
    "             'after': { 'position': { 'rmse': 25e-5, 'unit': 'm', 'in_noise': 2.5 } },"
    "    'holdout': { 'before': { 'position': { 'rmse': 5e-3, 'unit': 'm', 'in_noise': 50 } },"
    "                 'after': { 'position': { 'rmse': @, 'unit': 'm', 'in_noise': 7.5 } },"
    "      'logs': [ { 'log': 'c.csv', 'before': { 'position': { 'rmse': 6e-3, 'unit': 'm', 'in_noise': 60 } },"
    "                                  'after': { 'position': { 'rmse': 1e-3, 'unit': 'm', 'in_noise': 10 } } },"
    "                { 'log': 'd.csv', 'before': { 'position': { 'rmse': 7e-3, 'unit': 'm', 'in_noise': 70 } },"
    "                                  'after': { 'position': { 'rmse': 8e-3, 'unit': 'm', 'in_noise': 80 } } } ] } },"
    "  'path': [ { 'model': 'declared model', 'chi2': 400, 'bic': 400,"
    "              'error': { 'position': { 'rmse': 4e-3, 'unit': 'm', 'in_noise': 7 } },"
    "              'holdout': { 'position': { 'rmse': 5e-3, 'unit': 'm', 'in_noise': 9 } } },"
    "            { 'model': 'presliding', 'chi2': 100, 'bic': 100,"
    "              'error': { 'position': { 'rmse': 1e-3, 'unit': 'm', 'in_noise': 7 } },"
    "              'holdout': { 'position': { 'rmse': 5e-4, 'unit': 'm', 'in_noise': 9 } } },"
    "            { 'model': 'pressure_gain + presliding', 'chi2': 16, 'bic': 16,"
    "              'error': { 'position': { 'rmse': 3e-4, 'unit': 'm', 'in_noise': 7 } },"
    "              'holdout': { 'position': { 'rmse': @, 'unit': 'm', 'in_noise': 9 } } },"
    "            { 'model': 'presliding + pressure_gain', 'chi2': 16, 'bic': 16,"
    "              'error': { 'position': { 'rmse': 25e-5, 'unit': 'm', 'in_noise': 7 } },"
    "              'holdout': { 'position': { 'rmse': @, 'unit': 'm', 'in_noise': 9 } } } ],"
    "  'steps': [ { 'model': 'declared model', 'chi2': 400, 'bic': 400 },"
    "             { 'model': 'presliding', 'chi2': 121, 'bic': 125 }, { 'model': 'presliding', 'chi2': 100, 'bic': 105 "
    "},"
    "             { 'model': 'pressure_gain + presliding', 'chi2': 16, 'bic': 26 },"
    "             { 'model': 'presliding + area_variation + pressure_gain', 'chi2': 15.9, 'bic': 27 },"
    "             { 'model': 'presliding + dead_time', 'chi2': 36, 'bic': 46 } ] }";

static const char undecided[] = "'verdict': 'undecided', 'sentence': 'Undecided: presliding comes nearest.'";
static const char explained[] = "'verdict': 'effect', 'sentence': 'The model lacks presliding.'";
static const char doubted[] = "'verdict': 'undecided', 'sentence': 'Undecided: too short', 'doubt': 'too short'";

/* Write the report of closeloop on the set "one". */
static void write_report(const char *verdict, const char *held)
{
  char text[2 * sizeof report];
  const char *at;
  size_t n = 0;
  for (at = report; *at; at++) {
    const char one[2] = {*at, 0};
    n += (size_t)snprintf(text + n, sizeof text - n, "%s", *at == '@' ? held : *at == 'H' ? verdict : one);
  }
  assert_true(n < sizeof text);
  for (n = 0; text[n]; n++)
    if (text[n] == '\'')
      text[n] = '"';
  mkdir(scratch_path("one"), 0777);
  scratch_text("one/report.json", text);
  scratch_text("one/residual.csv", residual);
}

/* The report over one set with such a result. */
static int report_on(const char *set, sets_result result)
{
  config_t config;
  int status;
  result.set = config_setting_get_elem(read_sets(&config, set), 0);
  result.state = SETS_DONE;
  status = sets_report(&result, 1, scratch_path("."), &error);
  config_destroy(&config);
  return status;
}

/* The text of a report over one set, good until the next one. */
static const char *text_on(const char *set, sets_result result)
{
  static char *text;
  succeed(report_on(set, result));
  free(text);
  return text = scratch_read(scratch_path("REPORT.md"));
}

/* In: repeat  [m] to which its bench repeats */
static const char *report_repeating(const char *set, const char *verdict, const char *held, double repeat)
{
  write_report(verdict, held);
  return text_on(set, (sets_result){.repeat = repeat});
}

static const char *report_of(const char *set, const char *verdict, const char *held)
{
  return report_repeating(set, verdict, held, (double)NAN);
}

TEST(test_sets_report__row__has_units_noise_and_verdict)
{
  const char *text = report_of(ONE(""), undecided, "75e-5");
  assert_contains(text,
                  "| [T one](one/report.json) | position | 0.1 mm | - | 4 mm (40) | 0.25 mm (2.5) | 5 mm (50) | 0.75 "
                  "mm (7.5) | undecided | presliding (or position_lag), pressure_gain |");
  assert_contains(text, "1 undecided");
  assert_contains(text, " 1 of 1");
  assert_contains(text, "Of 2 logs ");
}

TEST(test_sets_report__held_out_error_that_grows__is_told)
{
  const char *text = report_of(ONE(""), undecided, "6e-3");
  assert_contains(text, " 0 of 1; not in: T one");
}

TEST(test_sets_report__undecided__says_how_much_is_left)
{
  const char *text = report_of(ONE(""), undecided, "75e-5");
  assert_contains(text, "2.5 times the noise");
  assert_contains(text, "presliding, pressure_gain.");
}

TEST(test_sets_report__no_more_left_than_the_bench_repeats__is_explained)
{
  const char *text = report_repeating(ONE(""), undecided, "2e-4", 2.1e-4);
  assert_contains(text, "| 0.1 mm | 0.21 mm (2.1) | 4 mm (40)");
  assert_contains(text, "| explained |");
  assert_contains(text, "lacks presliding, pressure_gain; ");
  assert_contains(text,
                  "repeats: 0.21 mm, 2.1 times the noise; the completed model leaves 1.19 times that, held out 0.952.");
}

TEST(test_sets_report__more_left_than_noise__is_not_explained)
{
  const char *text = report_repeating(ONE(""), explained, "2e-4", 2e-4);
  assert_contains(text, "| undecided |");
}

TEST(test_sets_report__more_left_of_runs_held_out__is_told)
{
  const char *text = report_repeating(ONE(""), explained, "75e-5", 2.1e-4);
  assert_contains(text, "| explained on the runs fitted only |");
  assert_contains(text, "On the runs held out more is left");
}

TEST(test_sets_report__doubt__is_the_reason)
{
  const char *text = report_of(ONE(""), doubted, "75e-5");
  assert_contains(text, "undecided: too short\n");
}

TEST(test_sets_report__section__shows_the_way_and_the_others)
{
  const char *text = report_of(ONE(""), undecided, "75e-5");
  assert_contains(text, "| declared model | 4 | 7 | 5 | 9 |\n| presliding | 1 | 7 | 0.5 | 9 |\n"
                        "| presliding + pressure_gain | 0.25 | 7 | 0.75 | 9 |\n\n");
  assert_contains(text, ": presliding 50 %.");
  assert_contains(text, "presliding + dead_time: it leaves 30 % ");
  assert_contains(text, "this one 20 % ");
  assert_contains(text, "46 against 16)");
  assert_contains(text, "lowest on the way, with presliding: 0.5 mm against 0.75 ");
  assert_contains(text, "in 1: T one (0.5 to 0.75 mm)");
  assert_null(strstr(text, "What took no part is"));
}

TEST(test_sets_report__held_out_error_that_falls__has_no_warning)
{
  const char *text = report_of(ONE(""), undecided, "4e-4");
  assert_null(strstr(text, "lowest on the way"));
  assert_null(strstr(text, "is not nearest"));
}

TEST(test_sets_report__parameters__known_and_undetermined)
{
  const char *text = report_of(ONE("given = \"spring_rate\"; as_pressure = \"kPa\";"), undecided, "75e-5");
  assert_contains(text, "spring_rate = 2.844e+05 (2e+05 to 3e+05) N/m\n");
  assert_contains(text, "presliding.x = 1 (a ratio)\n");
  assert_contains(text, "x is at its bound");
  assert_contains(text, "spring_rate = 2.709e+05 N/m; found +5 % from it");
  assert_contains(text, "2.1 kPa a mm: 8.4 before, 0.525 after; held out 10.5 before, 1.57 after");
}

TEST(test_sets_report__given_that_was_not_fitted__is_refused)
{
  write_report(undecided, "75e-5");
  assert_int_equal(report_on(ONE("given = \"area\";"), (sets_result){.repeat = (double)NAN}), LAB_DATA);
  assert_contains(error.text, "given: area is not among the parameters that were fitted");
}

TEST(test_sets_report__what_is_left__is_told_by_log)
{
  const char *text = report_of(ONE(""), undecided, "75e-5");
  assert_contains(text, "- Fitted: a.csv, b.csv.\n- Held out: c.csv, a.csv (rows that were not fitted).\n");
  assert_contains(text, "| a.csv | position [mm] | 1.94 | 19.4 | 1.25 | 3 | 1 |");
  assert_contains(text, "| b.csv | position [mm] | 1.41 | 14.1 | -1 | -2 | 0 |");
  assert_contains(text, "| c.csv | 6 | 60 | 1 | 10 |\n| d.csv | 7 | 70 | 8 | 80 |\n\n- Of these 2 the completed model "
                        "is nearer in 1; it is farther off than the declared one in: d.csv.\n");
}

TEST(test_sets_report__check__is_a_row_without_noise)
{
  const char *text = report_of(ONE("check = \"position\"; check_unit = \"cm\";"), undecided, "75e-5");
  assert_contains(text, "| - the same, not fitted | position | - | - | - | - | 0.4 cm | 0.025 cm | | |");
  assert_contains(text, "| a.csv | position [cm] | 0.194 | - |");
  assert_contains(text,
                  "What took no part is a channel that was not fitted, not a run held out, in: T one (position).\n");
}

TEST(test_sets_report__sets_that_did_not_run__stay_in_the_table)
{
  sets_result result[2];
  config_t config;
  const config_setting_t *list = read_sets(&config, "sets = ( " SET("two", "") ", " SET("three", "") " );");
  char *text;
  result[0] = (sets_result){.set = config_setting_get_elem(list, 0), .state = SETS_ABSENT, .repeat = (double)NAN};
  result[1] = (sets_result){.set = config_setting_get_elem(list, 1), .state = SETS_FAILED, .repeat = (double)NAN};
  succeed(sets_report(result, 2, scratch_path("."), &error));
  text = scratch_read(scratch_path("REPORT.md"));
  assert_contains(text, "| [T two](two/report.json) | position | - | - | - | - | - | - | data absent | |");
  assert_contains(text, "| [T three](three/report.json) | position | - | - | - | - | - | - | closeloop failed | |");
  assert_contains(text, "Of 2 sets 0 ran.");
  free(text);
  config_destroy(&config);
}

/* The report of a set whose log held out leaves so many noises with values of its own. */
static const char *report_alone(double noises)
{
  sets_result result = {.repeat = (double)NAN, .n_alone = 3};
  result.alone[2] = (alone_fit){.common = 5e-4,
                                .left = noises * 1e-4,
                                .in_noise = noises,
                                .rows = 10,
                                .n = 2,
                                .undetermined = 1,
                                .value = {{"k", "N/m", 2, 0.1}, {"b", "1", 0, 0}}};
  write_report(undecided, "75e-5");
  return text_on(ONE(""), result);
}

TEST(test_sets_report__log_explained_by_its_own_values__differs_from_the_others)
{
  const char *text = report_alone(1.1);
  assert_contains(text, "| c.csv | 0.5 | 0.11 | 1.1 | k 2 +- 0.1 N/m; b 0, at a bound; 1 not determined |");
  assert_contains(text, "or the bench repeats, 0.11 mm over all of them against 0.5 with common ones");
  assert_contains(text, "what is missing shows only between the logs");
  assert_contains(text, "shows only between logs, in 1: T one (0.5 to 0.11 mm).");
}

TEST(test_sets_report__log_that_own_values_do_not_explain__lacks_something)
{
  const char *text = report_alone(1.3);
  assert_contains(text, "With values of their own the logs held out leave 0.13 mm, with common ones 0.5: ");
  assert_null(strstr(text, "what is missing shows only between the logs"));
}

TEST(test_sets_report__channel_through_its_sensor__is_told)
{
  write_report(undecided, "75e-5");
  assert_contains(text_on(ONE("check = \"position\"; check_unit = \"cm\";"),
                          (sets_result){.repeat = (double)NAN,
                                        .sensor = {.left = 0.002, .n = 1, .value = {{"lag", "s", 3, 0.25}}}}),
                  "fitted to the position, the completed model leaves 0.2 cm of it: lag 3 +- 0.25 s (95 %");
}

/* ---- Its parts ---- */

TEST(test_sets_left__slow_wave__correlated_at_lag_1)
{
  char text[4096] = "run [1],t [s],p [Pa],p_after [Pa]\n";
  sets_left left;
  table t;
  int i;
  for (i = 0; i < 100; i++)
    snprintf(text + strlen(text), sizeof text - strlen(text), "%d,%d,%.3f,0\n", 1 + i / 50, i,
             i < 50 ? sin(0.1 * i) : (i % 2 ? 1.0 : -1.0));
  succeed(table_load_file(scratch_text("left.csv", text), &t, &error));
  assert_int_equal(sets_left_runs(&t), 2);
  succeed(sets_left_of(&t, 1, "p", &left, &error));
  assert_int_equal(left.n, 50);
  assert_between(left.lag1, 0.9, 1.0);
  succeed(sets_left_of(&t, 2, "p", &left, &error));
  assert_close(left.lag1, -0.98, 1e-9, 0);
  assert_close(left.rms, 1, 1e-12, 0);
  succeed(sets_left_of(&t, 2, "T", &left, &error));
  assert_int_equal(left.n, 0);
  table_close(&t);
}

TEST(test_sets_within__parts__in_any_order)
{
  assert_true(sets_within("a + b", "b + a"));
  assert_false(sets_within("a + b", "a + bc"));
  assert_false(sets_within("a + bc", "a + b"));
  assert_true(sets_within("a + c", "c + b + a"));
  assert_false(sets_within("c + b + a", "a + c"));
}

/* A number is measured or it is not written: words on results hold none. */
TEST(test_sets_cfg__words__hold_no_figures)
{
  static const char *const words[] = {"declared", "remains"};
  const config_setting_t *list;
  config_t config;
  size_t w;
  int i;
  succeed(lab_config_read(&config, "study/measured/sets.cfg", &error));
  list = config_lookup(&config, "sets");
  assert_true(config_setting_length(list) > 0);
  for (i = 0; i < config_setting_length(list); i++)
    for (w = 0; w < sizeof words / sizeof *words; w++) {
      const char *text = sets_text(config_setting_get_elem(list, (unsigned)i), words[w]);
      if (strpbrk(text, "0123456789"))
        fail_msg("%s holds a figure: %s", words[w], text);
    }
  config_destroy(&config);
}
