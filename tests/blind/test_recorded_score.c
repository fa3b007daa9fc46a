/* tests/blind: what answers to logs "as recorded" are worth, and how they are counted. */
#include "../scratch.h"

#include "answers.h"
#include "prepare.h"
#include "recorded_score.h"
#include "recorded_summary.h"

static blind_record record;
static blind_visible visible;

/* Statistic of what is so many times the information limit. */
static double over(double limits)
{
  return BLIND_LIMIT_STATISTIC * limits * limits;
}

/* A trial with up to two effects missing, "+" between them, visible ten times over; all declared as it is. */
static blind_recorded trial_with(const char *missing)
{
  blind_recorded r = {0};
  char names[200], *name;
  int i;
  blind_draw(1, 0, &r.t);
  r.t.n_missing = 0;
  r.beyond = r.onset_value = -1;
  r.onset = NAN;
  r.spacing = 0.01;
  r.vent = 1;
  memset(&visible, 0, sizeof visible);
  for (i = 0; i < BLIND_VALUES; i++)
    r.off[i] = blind_values[i].absolute ? 0 : 1;
  snprintf(names, sizeof names, "%s", missing);
  for (name = strtok(names, "+"); name; name = strtok(NULL, "+")) {
    r.t.missing[r.t.n_missing] = (blind_missing){.effect = blind_effect_named(name), .size = -3};
    assert_non_null(r.t.missing[r.t.n_missing].effect);
    visible.effect[r.t.n_missing++] = over(10);
  }
  r.t.kind = r.t.n_missing == 2   ? BLIND_PAIR
             : r.t.n_missing == 0 ? BLIND_NOTHING
             : *missing == 'u'    ? BLIND_UNLISTED
                                  : BLIND_SINGLE;
  return r;
}

static void say(const char *parameter, double ratio, double half)
{
  blind_deviation *d = &answer.deviation[answer.n_deviations++];
  memset(d, 0, sizeof *d);
  strcpy(d->parameter, parameter);
  d->ratio = ratio;
  d->low = ratio - half;
  d->high = ratio + half;
  d->since.t = d->since.low = d->since.high = NAN;
}

/* ---- Classes ---- */

static const struct class_case {
  const char *missing, *verdict, *found, *unlisted;
  double limits[2]; /* sizes over their limits */
  int class;
} class_cases[] = {
    {"", "none", "", "", {0}, BLIND_RIGHT},
    {"", "effect", "chamber_leak", "", {0}, BLIND_FALSE_ALARM},
    {"", "unlisted", "", "force", {0}, BLIND_FALSE_ALARM},
    {"", "undecided", "chamber_leak", "", {0}, BLIND_UNDECIDED},
    {"", "timeout", "", "", {0}, BLIND_NO_ANSWER},
    {"", "failed", "", "", {0}, BLIND_NO_ANSWER},
    {"chamber_leak", "effect", "chamber_leak", "", {9}, BLIND_RIGHT},
    {"chamber_leak", "effect", "chamber_leak", "", {1}, BLIND_RIGHT},
    {"chamber_leak", "effect", "supply_droop:chamber_leak", "", {9}, BLIND_RIGHT},
    {"chamber_leak", "effect", "laminar_leak", "", {9}, BLIND_WRONG},
    {"chamber_leak", "effect", "laminar_leak", "", {1}, BLIND_WRONG},
    {"chamber_leak", "effect", "chamber_leak+dead_time", "", {9}, BLIND_PARTLY},
    {"chamber_leak", "none", "", "", {9}, BLIND_OVERLOOKED},
    {"chamber_leak", "none", "", "", {1.9}, BLIND_RIGHT},
    {"chamber_leak", "undecided", "dead_time", "", {9}, BLIND_UNDECIDED},
    {"chamber_leak", "unlisted", "", "mass", {9}, BLIND_PARTLY},
    {"chamber_leak", "unlisted", "", "force", {9}, BLIND_WRONG},
    {"chamber_leak", "unlisted", "", "mass", {1}, BLIND_WRONG},
    {"chamber_leak+dead_time", "effect", "dead_time+chamber_leak", "", {9, 9}, BLIND_RIGHT},
    {"chamber_leak+dead_time", "effect", "dead_time", "", {9, 9}, BLIND_PARTLY},
    {"chamber_leak+dead_time", "effect", "dead_time", "", {1, 9}, BLIND_RIGHT},
    {"chamber_leak+dead_time", "effect", "chamber_leak", "", {1, 9}, BLIND_PARTLY},
    {"chamber_leak+dead_time", "effect", "stribeck_friction", "", {9, 9}, BLIND_WRONG},
    {"unlisted:friction_bump", "unlisted", "", "force", {9}, BLIND_RIGHT},
    {"unlisted:friction_bump", "unlisted", "", "mass", {9}, BLIND_WRONG},
    {"unlisted:friction_bump", "effect", "stribeck_friction", "", {9}, BLIND_WRONG},
    {"unlisted:friction_bump", "none", "", "", {9}, BLIND_OVERLOOKED},
    {"unlisted:friction_bump", "none", "", "", {1}, BLIND_RIGHT},
};

TEST(test_blind_score_recorded__each_kind_of_answer__has_its_class)
{
  size_t i;
  for (i = 0; i < sizeof class_cases / sizeof class_cases[0]; i++) {
    const struct class_case *c = &class_cases[i];
    const blind_recorded r = trial_with(c->missing);
    int k;
    for (k = 0; k < r.t.n_missing; k++)
      visible.effect[k] = over(c->limits[k]);
    set_answer(c->verdict, c->found, c->unlisted);
    blind_score_recorded(&r, &visible, &answer, 100, &record);
    check_note("%s %s%s for \"%s\"", c->verdict, c->found, c->unlisted, c->missing);
    if (strcmp(record.class, blind_class_text(c->class)))
      fail_msg("%s: %s, not %s", check_case, record.class, blind_class_text(c->class));
  }
}

TEST(test_blind_score_recorded__listed_as_small__is_not_overlooked)
{
  const blind_recorded leak = trial_with("chamber_leak");
  blind_recorded bump;
  set_answer("none", "", "");
  strcpy(answer.small[answer.n_small++], "chamber_leak");
  blind_score_recorded(&leak, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "right");
  bump = trial_with("unlisted:friction_bump");
  blind_score_recorded(&bump, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "overlooked");
  strcpy(answer.small[answer.n_small++], "unlisted:force");
  blind_score_recorded(&bump, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "right");
}

TEST(test_blind_score_recorded__instrument_among_the_deviations__is_not_overlooked)
{
  blind_recorded r = trial_with("position_bias");
  r.t.missing[0].size = -2.6e-5;
  visible.effect[0] = over(9);
  set_answer("none", "", "");
  say("position_bias", 2e-5, 0);
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "overlooked");
  answer.deviation[0].ratio = -2e-5;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "right");
}

/* A filter may be called a lag where there is one, and does not stand for what is missing. */
TEST(test_blind_score_recorded__filter_called_a_lag__is_no_false_alarm)
{
  blind_recorded r = trial_with("");
  set_answer("effect", "pressure_lag", "");
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "false alarm");
  assert_int_equal(record.instrument, 0);
  r.filter[0] = 0.02;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "right");
  assert_int_equal(record.instrument, 1);
  set_answer("effect", "position_lag", "");
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "false alarm");
  r = trial_with("chamber_leak");
  r.filter[1] = 0.02;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_string_equal(record.class, "overlooked");
}

/* ---- Deviations ---- */

TEST(test_blind_score_recorded__deviation__is_found_by_name_and_direction)
{
  const int rate = blind_value_named("spring_rate"), orifice = blind_value_named("orifice_area");
  blind_recorded r = trial_with("");
  r.off[rate] = 1.3;
  r.off[orifice] = 0.7;
  r.beyond = rate;
  visible.value[rate] = visible.value[orifice] = 1.01 * BLIND_DUE;
  set_answer("none", "", "");
  say("spring_rate", 1.25, 0.1);
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_due, 2);
  assert_int_equal(record.n_found, 1);
  assert_int_equal(record.far_found, 1);
  assert_string_equal(record.due, "spring_rate x1.3; NOT orifice_area x0.7");
  answer.deviation[0].ratio = 0.9; /* the wrong way */
  say("vent_area", 0.72, 0.05);
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_found, 1);
  assert_int_equal(record.far_found, 0);
  visible.value[rate] = 0.99 * BLIND_DUE;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_due, 1);
  assert_int_equal(record.far_due, 0);
}

TEST(test_blind_score_recorded__stated_interval__is_wrong_beyond_twice_its_width)
{
  blind_recorded r = trial_with("");
  r.off[blind_value_named("ambient_pressure")] = -10132.5;
  r.off[blind_value_named("damping")] = 1.2; /* of which two thirds are damping */
  set_answer("none", "", "");
  say("ambient_pressure", 0.9 + 0.019, 0.01);
  say("ambient_pressure", 0.9 - 0.021, 0.01);
  say("damping", 1.3, 0.01);
  say("pressure_gain", 1.3, 0.01);
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_said, 4);
  assert_int_equal(record.n_wrong, 1);
}

/* The vent passes 0.9 of what the fill orifice does: restricted by a tenth. */
TEST(test_blind_score_recorded__vent__is_judged_as_a_restriction)
{
  blind_recorded r = trial_with("");
  r.vent = 0.9;
  r.t.base.vent_area *= r.vent;
  visible.vent = 1.01 * BLIND_DUE;
  set_answer("none", "", "");
  say("vent_restriction", 0.1 + 0.019, 0.01);
  answer.deviation[0].absolute = 1;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_due, 1);
  assert_int_equal(record.n_found, 1);
  assert_int_equal(record.n_wrong, 0);
  assert_string_equal(record.due, "vent_restriction 0.1");
  assert_string_equal(record.deviations, "vent_restriction 0.119 [0.109..0.129]");
  say("vent_restriction", -0.1, 0.01); /* the wrong way */
  answer.deviation[0] = answer.deviation[--answer.n_deviations];
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_found, 0);
  assert_int_equal(record.n_wrong, 1);
  visible.vent = 0.99 * BLIND_DUE;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_due, 0);
}

/* What narrows it further is an effect, and due by its name; what is said of the vent is of both. */
TEST(test_blind_score_recorded__vent_that_is_missing__is_not_due_as_a_value)
{
  blind_recorded r = trial_with("vent_restriction");
  r.t.missing[0].size = 0.2;
  r.t.base.vent_area *= 0.9;
  visible.vent = 1.01 * BLIND_DUE;
  set_answer("none", "", "");
  say("vent_restriction", 1 - 0.9 * 0.8, 0.001);
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_due, 0);
  assert_int_equal(record.n_wrong, 0);
  answer.deviation[0].ratio = 0.1;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.n_wrong, 1);
}

/* ---- Onset ---- */

TEST(test_blind_score_recorded__onset__counts_where_what_begins_was_named)
{
  blind_recorded r = trial_with("chamber_leak");
  r.onset = 12;
  set_answer("effect", "dead_time", "");
  answer.found[0].since = (blind_since){12, 11, 13};
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.onset_due, 0);
  set_answer("effect", "chamber_leak", "");
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.onset_due, 1);
  assert_int_equal(record.onset_said, 0);
  answer.found[0].since = (blind_since){12.4, 11.9, 13};
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.onset_said, 1);
  assert_int_equal(record.onset_within, 1);
  answer.found[0].since.low = 12.1;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.onset_within, 0);
}

TEST(test_blind_score_recorded__onset_of_a_value__is_that_of_its_deviation)
{
  const int supply = blind_value_named("supply_pressure");
  blind_recorded r = trial_with("");
  r.onset = 12;
  r.onset_value = r.beyond = supply;
  r.off[supply] = 0.8;
  set_answer("none", "", "");
  say("supply_pressure", 0.8, 0.01);
  answer.deviation[0].since = (blind_since){12, 11, 13};
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.onset_within, 1);
  r.onset = NAN;
  blind_score_recorded(&r, &visible, &answer, 100, &record);
  assert_int_equal(record.onset_due, 0);
  assert_int_equal(record.onset_said, 1); /* where all is from the start */
}

/* ---- Reports, records, the page ---- */

TEST(test_blind_answer_read__deviations_and_onset__are_taken)
{
  static const char report[] =
      "{\"verdict\": \"effect\", \"condition\": \"deviates\", \"found\": [{\"effect\": \"chamber_leak\","
      " \"onset\": {\"t\": 3.5, \"unit\": \"s\", \"ci95\": [3, 4]}}], \"deviations\": [{\"parameter\": \"spring_rate\","
      " \"declared\": 200, \"found\": 150, \"ci95\": [140, 160], \"ratio\": 0.75, \"beyond\": true},"
      " {\"parameter\": \"vent_restriction\", \"declared\": 0, \"found\": -0.06, \"ci95\": [-0.07, -0.05],"
      " \"ratio\": null, \"beyond\": false}]}";
  succeed(blind_answer_read(scratch_text("report.json", report), &answer, &error));
  assert_string_equal(answer.condition, "deviates");
  assert_close(answer.found[0].since.t, 3.5, 0, 0);
  assert_close(answer.found[0].since.high, 4, 0, 0);
  assert_int_equal(answer.n_deviations, 2);
  assert_string_equal(answer.deviation[0].parameter, "spring_rate");
  assert_close(answer.deviation[0].ratio, 0.75, 0, 0);
  assert_close(answer.deviation[0].low, 0.7, 0, 1e-15);
  assert_close(answer.deviation[0].beyond, 1, 0, 0);
  assert_true(isnan(answer.deviation[0].since.t));
  assert_int_equal(answer.deviation[0].absolute, 0);
  assert_int_equal(answer.deviation[1].absolute, 1);
  assert_close(answer.deviation[1].ratio, -0.06, 0, 0);
  assert_close(answer.deviation[1].high, -0.05, 0, 0);
}

TEST(test_blind_record_read__recorded__is_what_was_written)
{
  const blind_recorded r = trial_with("chamber_leak+dead_time");
  blind_record back;
  char *line, *again;
  set_answer("effect", "chamber_leak", "");
  say("spring_rate", 1.25, 0.1);
  answer.cpu = 1.5;
  blind_score_recorded(&r, &visible, &answer, 123, &record);
  line = line_of(&record, 1);
  assert_int_equal(blind_record_read(line, 1, &back), 1);
  assert_int_equal(blind_record_read(line, 0, &back), 0);
  blind_record_read(line, 1, &back);
  again = line_of(&back, 1);
  assert_string_equal(line, again);
  assert_string_equal(back.class, "partly");
  assert_close(back.rows, 123, 0, 0);
  assert_close(back.cpu, 1.5, 0, 0);
  free(line);
  free(again);
}

TEST(test_blind_recorded_summary_write__counts__and_lists_what_is_not_right)
{
  blind_recorded r = trial_with("chamber_leak");
  blind_record records[3];
  char *text = NULL;
  size_t size;
  FILE *memory = open_memstream(&text, &size);
  r.t.number = 4;
  r.has = 1u << BLIND_DRIFT;
  set_answer("effect", "dead_time", "");
  answer.cpu = 7;
  blind_score_recorded(&r, &visible, &answer, 100, &records[0]);
  set_answer("effect", "chamber_leak", "");
  answer.cpu = 2;
  r.t.number = 5;
  blind_score_recorded(&r, &visible, &answer, 100, &records[1]);
  r.t.number = 6;
  r.off[0] = 1.1;
  visible.value[0] = 2 * BLIND_DUE;
  blind_score_recorded(&r, &visible, &answer, 100, &records[2]);
  assert_int_equal(blind_recorded_summary_write(memory, records, 3, 1, 30), 0);
  fclose(memory);
  assert_contains(text, "| all logs: right or honestly undecided | 2/3 |");
  assert_contains(text, "| all logs: confidently wrong (false alarm, overlooked, wrong) | 1/3 |");
  assert_contains(text, "| deviations beyond twice their interval: found | 0/1 |");
  assert_contains(text, "CPU time: median 2 s,");
  assert_contains(text, "| drift | 3 |");
  assert_contains(text, "| 4 | ");
  assert_contains(text, "| wrong | chamber_leak -3 m2 (10 x) | effect: dead_time |");
  assert_contains(text, "NOT area x1.1");
  assert_null(strstr(text, "\n| 5 | "));
  free(text);
}

/* A second run takes the log that the first left, unless it is of another trial. */
TEST(test_blind_prepare__same_trial__keeps_its_files)
{
  blind_recorded r;
  blind_visible first, second;
  size_t rows, again;
  char path[600];
  blind_draw_recorded(1, 0, 1u << BLIND_POSITIONER, &r);
  r.n_moves = 3;
  r.end = 2;
  succeed(blind_prepare(&r, scratch_path("kept"), &rows, &first, &error));
  snprintf(path, sizeof path, "%s/fit.csv", scratch_path("kept"));
  assert_int_equal(unlink(path), 0);
  succeed(blind_prepare(&r, scratch_path("kept"), &again, &second, &error));
  assert_int_equal(access(path, R_OK), -1);
  assert_int_equal(again, rows);
  assert_close(second.value[0], first.value[0], 0, 1e-8);
  r.drift[0] = 0.1;
  succeed(blind_prepare(&r, scratch_path("kept"), &again, &second, &error));
  assert_int_equal(access(path, R_OK), 0);
}
