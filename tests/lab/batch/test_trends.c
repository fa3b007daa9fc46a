/* apps/lab/batch/history, trends: from the reports of dated lines to trends.csv and the page */
#include "../../scratch.h"

#include "../../../apps/lab/base/outfile.h"
#include "../../../apps/lab/batch/trends.h"

static lab_history history;
static lab_trends trends;

enum { DAYS = 20000 }; /* since 1970 */

/* Forget all trends; for the next test. */
static int forget(void **state)
{
  lab_trends_free(&trends);
  lab_history_free(&history);
  return 0;
}

#define CASE(name) TEST_WITH(name, NULL, forget)

/* A line of the list and what its report says.  In: json  without the braces */
static void add(const char *rig, int day, const char *json)
{
  lab_fleet_entry line = {0};
  char text[2000], folder[400];
  snprintf(line.rig, sizeof line.rig, "%s", rig);
  snprintf(line.date, sizeof line.date, "day, %d", day);
  line.day = DAYS + day;
  snprintf(text, sizeof text, "{%s}", json);
  snprintf(folder, sizeof folder, "%s", scratch_path("line"));
  succeed(lab_make_folder(folder, &error));
  scratch_text("line/report.json", text);
  succeed(lab_history_add(&history, &line, folder, &error));
}

/* A report of one parameter. */
static void add_value(const char *rig, int day, const char *name, double value)
{
  const double deviation = 2;
  char json[1000];
  snprintf(json, sizeof json,
           "\"verdict\":\"none\",\"parameters\":{\"%s\":{\"value\":%.9g,\"unit\":\"N/m\",\"ci95\":[%.9g,%.9g],"
           "\"declared\":1000,\"tolerance\":0.1}}",
           name, value, value - 1.959963985 * deviation, value + 1.959963985 * deviation);
  add(rig, day, json);
}

static void find(void)
{
  lab_history_sort(&history);
  succeed(lab_trends_find(&history, &trends, &error));
}

/* ---- What is taken up ---- */

CASE(test_lab_history__report__gives_what_is_known)
{
  add("r", 1,
      "\"verdict\":\"effect\",\"parameters\":{"
      "\"spring_rate\":{\"value\":5,\"unit\":\"N/m\",\"ci95\":[3,7],\"declared\":4,\"tolerance\":0.1},"
      "\"chamber_leak.leak_area\":{\"value\":2,\"unit\":\"m2\",\"ci95\":[1,3]},"
      "\"damping\":{\"value\":2,\"unit\":\"m2\",\"ci95\":[null,3]}},"
      "\"deviations\":[{\"parameter\":\"spring_rate\",\"found\":5,\"ci95\":[3,7],\"held\":false},"
      "{\"parameter\":\"area\",\"found\":9,\"unit\":\"m2\",\"ci95\":[8,10],\"held\":true}]");
  add("r", 2, "\"verdict\":\"undecided\",\"parameters\":{\"area\":{\"value\":5,\"unit\":\"m2\",\"ci95\":[3,7]}}");
  lab_history_sort(&history);
  assert_int_equal(history.n, 3);
  assert_string_equal(history.of[0].parameter, "area");
  assert_string_equal(history.of[1].parameter, "chamber_leak.leak_area");
  assert_true(isnan(history.of[1].tolerance));
  assert_string_equal(history.of[2].parameter, "spring_rate");
  assert_close(history.of[2].deviation, 4 / (2 * 1.959963984540054), 0, 1e-12);
  assert_close(history.of[2].tolerance, 0.1, 0, 0);
}

CASE(test_lab_history__half_a_report__is_an_error)
{
  lab_fleet_entry line = {0};
  char folder[400];
  snprintf(folder, sizeof folder, "%s", scratch_path("line"));
  succeed(lab_make_folder(folder, &error));
  scratch_text("line/report.json", "{\"verdict\":");
  succeed(lab_history_add(&history, &line, folder, &error)); /* no date: nobody asks */
  strcpy(line.date, "2026-01-02");
  assert_fails(lab_history_add(&history, &line, folder, &error), LAB_DATA, "no whole report");
}

/* ---- What it comes to ---- */

/* 1000, 1020, 1040 at days 0, 20, 40, which leaves 1100 sixty days later, however the lines are ordered. */
CASE(test_lab_trends__drift__is_told_with_the_days_left)
{
  char sentence[LAB_TREND_SENTENCE];
  add_value("b", 40, "spring_rate", 1040);
  add_value("a", 7, "spring_rate", 1000); /* one day: no trend */
  add_value("b", 0, "spring_rate", 1000);
  add_value("a", 7, "spring_rate", 1001);
  add_value("b", 20, "spring_rate", 1020);
  find();
  assert_int_equal(trends.n, 1);
  assert_int_equal(trends.of[0].line.n, 3);
  assert_string_equal(trends.of[0].first->date, "day, 0");
  assert_string_equal(trends.of[0].last->date, "day, 40");
  assert_close(trends.of[0].slope, 1, 0, 1e-9);
  assert_close(trends.of[0].half, 1.959963984540054 * 2 / sqrt(800), 0, 1e-6);
  assert_true(trends.of[0].drifts);
  assert_close(trends.of[0].days[0], 60, 0, 1e-6);
  assert_string_equal(lab_trend_sentence(&trends.of[0], sentence),
                      "spring_rate leaves its tolerance of 10 % in 60 days (50 to 73)");
}

/* The same downwards: the lower side of the tolerance is left. */
CASE(test_lab_trends__fall__leaves_at_the_lower_side)
{
  char sentence[LAB_TREND_SENTENCE];
  add_value("r", 0, "v", 1000);
  add_value("r", 40, "v", 960);
  find();
  assert_string_equal(lab_trend_sentence(&trends.of[0], sentence),
                      "v leaves its tolerance of 10 % in 60 days (50 to 73)");
}

/* What is beyond its tolerance at either side, what has none, and what does not drift. */
CASE(test_lab_trends__sentence__fits_what_is_known)
{
  static const struct {
    double from, to;
    const char *sentence;
  } row[] = {{1090, 1120, "v is outside its tolerance of 10 % and rises by 0.000750 N/mm a day (0.000611 to 0.000889)"},
             {890, 895, ""},
             {1120, 1105, "v is outside its tolerance of 10 % and falls by 0.000375 N/mm a day (0.000236 to 0.000514)"},
             {1000, 1000, ""}};
  char sentence[LAB_TREND_SENTENCE];
  size_t i;
  for (i = 0; i < sizeof row / sizeof *row; i++) {
    add_value("r", 0, "v", row[i].from);
    add_value("r", 40, "v", row[i].to);
    find();
    check_note("row %d", (int)i);
    assert_string_equal(lab_trend_sentence(&trends.of[0], sentence), row[i].sentence);
    assert_true(trends.of[0].drifts ? trends.of[0].days[0] == 0 : isnan(trends.of[0].days[0]));
    forget(state);
  }
  add("r", 0, "\"parameters\":{\"v\":{\"value\":1e-6,\"unit\":\"m2\",\"ci95\":[0.9e-6,1.1e-6]}}");
  add("r", 10, "\"parameters\":{\"v\":{\"value\":2e-6,\"unit\":\"m2\",\"ci95\":[1.9e-6,2.1e-6]}}");
  find();
  assert_string_equal(lab_trend_sentence(&trends.of[0], sentence), "v rises by 0.100 mm² a day (0.0859 to 0.114)");
}

/* A slope of two and a half deviations tells something alone, and nothing among ten. */
CASE(test_lab_trends__many_parameters__need_more)
{
  char name[8];
  int k;
  for (k = 0; k < 10; k++) {
    snprintf(name, sizeof name, "p%d", k);
    add_value("many", 0, name, 1000);
    add_value("many", 40, name, k ? 1000 : 1000 + 2.5 * 2 * sqrt(2));
  }
  add_value("one", 0, "p0", 1000);
  add_value("one", 40, "p0", 1000 + 2.5 * 2 * sqrt(2));
  find();
  assert_int_equal(trends.n, 11);
  assert_int_equal(trends.of[0].n_of_rig, 10);
  assert_true(fabs(trends.of[0].slope) > trends.of[0].half);
  assert_false(trends.of[0].drifts);
  assert_int_equal(trends.of[10].n_of_rig, 1);
  assert_true(trends.of[10].drifts);
}

/* ---- What is written ---- */

CASE(test_lab_trends__written__table_and_page)
{
  cJSON *page = cJSON_CreateObject();
  char *text;
  add_value("=r,1", 0, "spring_rate", 1000);
  add_value("=r,1", 40, "spring_rate", 1040);
  find();
  succeed(lab_trends_write(&trends, scratch_path("trends.csv"), &error));
  text = scratch_read(scratch_path("trends.csv"));
  assert_string_equal(
      text, "rig,parameter,unit,n,first_date,last_date,slope_per_day,slope_low,slope_high,days_left,"
            "days_left_low,days_left_high,last_value,declared,tolerance,scatter\n"
            "\"'=r,1\",spring_rate,N/m,2,\"day, 0\",\"day, 40\",1,0.86141,1.13859,60,49.921,73.2124,1040,1000,0.1,0\n");
  free(text);
  lab_trends_page(&trends, page);
  text = cJSON_PrintUnformatted(page);
  assert_contains(text, "\"rig\":\"=r,1\"");
  assert_contains(text, "\"path\":\"M2.0 26.0L2.0 22.0M118.0 6.0L118.0 2.0M2.0 24.0L118.0 4.0\"");
  assert_contains(text, "\"sentences\":[\"spring_rate leaves");
  cJSON_free(text);
  cJSON_Delete(page);
  forget(state);
  find(); /* the list has no dates any longer */
  succeed(lab_trends_write(&trends, scratch_path("trends.csv"), &error));
  assert_int_equal(access(scratch_path("trends.csv"), F_OK), -1);
}
