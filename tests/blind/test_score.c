/* tests/blind: what an answer is worth, and how it is counted and reported. */
#include "../scratch.h"

#include "answers.h"
#include "journal.h"
#include "score.h"
#include "stats.h"
#include "summary.h"

static blind_record record;

/* ---- Reports ---- */

static const char report[] =
    "{\"verdict\": \"effect\", \"found\": [{\"effect\": \"laminar_leak\", \"equation\": \"mass\","
    "  \"indistinguishable_from\": [\"chamber_leak\", \"supply_droop\"]}],"
    " \"unlisted\": [{\"equation\": \"force\", \"argument\": \"x\"}],"
    " \"error\": {\"before\": {\"pressure\": {\"rmse\": 1, \"in_noise\": 3}, \"position\": {\"in_noise\": 1}},"
    "  \"after\": {\"pressure\": {\"in_noise\": 1}},"
    "  \"holdout\": {\"after\": {\"pressure\": {\"in_noise\": 1.2}, \"position\": {\"in_noise\": 1.6}}}},"
    " \"candidates\": [{\"effect\": \"laminar_leak\", \"statistic\": 90}, {\"effect\": \"laminar_leak\"},"
    "  {\"effect\": \"chamber_leak\", \"statistic\": 80.5}],"
    " \"significant_but_small\": [\"dead_time\"]}";

TEST(test_blind_answer_read__whole_report__every_field_is_taken)
{
  succeed(blind_answer_read(scratch_text("report.json", report), &answer, &error));
  assert_string_equal(answer.verdict, "effect");
  assert_int_equal(answer.n_found, 1);
  assert_string_equal(answer.found[0].effect, "laminar_leak");
  assert_string_equal(answer.found[0].equation, "mass");
  assert_int_equal(answer.found[0].n_alike, 2);
  assert_string_equal(answer.found[0].alike[1], "supply_droop");
  assert_int_equal(answer.n_unlisted, 1);
  assert_string_equal(answer.unlisted[0], "force");
  assert_int_equal(answer.n_small, 1);
  assert_string_equal(answer.small[0], "dead_time");
  assert_int_equal(answer.n_candidates, 3);
  assert_close(answer.statistic[2], 80.5, 0, 0);
  assert_close(answer.before, sqrt(5), 0, 1e-15);
  assert_close(answer.after, 1, 0, 0);
  assert_close(answer.holdout_after, sqrt(2), 0, 1e-15);
  assert_true(isnan(answer.holdout_before));
}

TEST(test_blind_answer_read__no_verdict__is_refused)
{
  assert_fails(blind_answer_read(scratch_text("a.json", "{\"found\": []}"), &answer, &error), LAB_DATA, "no verdict");
  assert_int_equal(blind_answer_read(scratch_text("b.json", "{\"verdict\": "), &answer, &error), LAB_DATA);
}

/* ---- Score ---- */

/* A trial with up to two effects missing, "+" between them. */
static blind_trial trial_with(int kind, const char *missing)
{
  static blind_trial t;
  char names[200], *name;
  blind_draw(1, 0, &t);
  t.kind = kind;
  t.n_missing = 0;
  snprintf(names, sizeof names, "%s", missing);
  for (name = strtok(names, "+"); name; name = strtok(NULL, "+")) {
    t.missing[t.n_missing].effect = blind_effect_named(name);
    assert_non_null(t.missing[t.n_missing].effect);
    t.missing[t.n_missing++].size = -3;
  }
  return t;
}

static const struct score_case {
  int kind;
  const char *missing, *verdict, *found, *unlisted;
  int detected, name, stated, family;
} score_cases[] = {
    {BLIND_NOTHING, "", "none", "", "", 0, 1, 1, 1},
    {BLIND_NOTHING, "", "effect", "chamber_leak", "", 1, 0, 0, 0},
    {BLIND_NOTHING, "", "undecided", "", "", 1, 0, 0, 0},
    {BLIND_NOTHING, "", "timeout", "", "", 0, 0, 0, 0},
    {BLIND_SINGLE, "chamber_leak", "effect", "chamber_leak", "", 1, 1, 1, 1},
    {BLIND_SINGLE, "chamber_leak", "undecided", "chamber_leak", "", 1, 0, 0, 0},
    {BLIND_SINGLE, "chamber_leak", "none", "", "", 0, 0, 0, 0},
    {BLIND_SINGLE, "chamber_leak", "effect", "supply_droop:chamber_leak", "", 1, 0, 1, 1},
    {BLIND_SINGLE, "chamber_leak", "effect", "laminar_leak", "", 1, 0, 0, 1},
    {BLIND_SINGLE, "chamber_leak", "effect", "supply_droop:dead_time", "", 1, 0, 0, 0},
    {BLIND_SINGLE, "chamber_leak", "effect", "chamber_leak+dead_time", "", 1, 0, 0, 0},
    {BLIND_SINGLE, "chamber_leak", "unlisted", "", "mass", 1, 0, 0, 0},
    {BLIND_PAIR, "chamber_leak+dead_time", "effect", "dead_time+chamber_leak", "", 1, 1, 1, 1},
    {BLIND_PAIR, "chamber_leak+dead_time", "effect", "transducer_lag:dead_time+chamber_leak", "", 1, 0, 1, 1},
    {BLIND_PAIR, "chamber_leak+dead_time", "effect", "dead_time+dead_time", "", 1, 0, 0, 0},
    {BLIND_PAIR, "chamber_leak+dead_time", "effect", "dead_time", "", 1, 0, 0, 0},
    {BLIND_UNLISTED, "unlisted:friction_bump", "unlisted", "", "force", 1, 1, 1, 1},
    {BLIND_UNLISTED, "unlisted:friction_bump", "unlisted", "", "mass", 1, 0, 0, 0},
    {BLIND_UNLISTED, "unlisted:friction_bump", "effect", "stribeck_friction", "", 1, 0, 0, 0},
};

TEST(test_blind_score__each_kind_of_answer__has_its_score)
{
  const double limit[] = {1, 2};
  size_t i;
  for (i = 0; i < sizeof score_cases / sizeof score_cases[0]; i++) {
    const struct score_case *c = &score_cases[i];
    const blind_trial t = trial_with(c->kind, c->missing);
    set_answer(c->verdict, c->found, c->unlisted);
    blind_score(&t, limit, &answer, &record);
    check_note("\"%s\" for \"%s\"", c->found, c->missing);
    assert_close(record.detected, c->detected, 0, 0);
    assert_close(record.name, c->name, 0, 0);
    assert_close(record.stated, c->stated, 0, 0);
    assert_close(record.family, c->family, 0, 0);
    assert_close(*record.why != '\0', !c->name, 0, 0);
  }
}

TEST(test_blind_score__listed_free_term__is_stated_in_its_equation)
{
  const double limit[] = {1};
  const blind_trial t = trial_with(BLIND_UNLISTED, "unlisted:friction_bump");
  set_answer("none", "", "");
  strcpy(answer.small[answer.n_small++], "unlisted:mass");
  blind_score(&t, limit, &answer, &record);
  assert_close(record.stated, 0, 0, 0);
  strcpy(answer.small[answer.n_small++], "unlisted:force");
  blind_score(&t, limit, &answer, &record);
  assert_close(record.stated, 1, 0, 0);
  assert_close(record.name, 0, 0, 0);
  assert_contains(record.why, "listed as significant but too small");
  set_answer("undecided", "", "");
  strcpy(answer.small[answer.n_small++], "unlisted:force");
  blind_score(&t, limit, &answer, &record);
  assert_close(record.stated, 0, 0, 0);
}

TEST(test_blind_score__size_over_limit__is_the_least_of_a_pair)
{
  const double limit[] = {1, 2};
  const blind_trial t = trial_with(BLIND_PAIR, "chamber_leak+dead_time");
  set_answer("none", "", "");
  blind_score(&t, limit, &answer, &record);
  assert_close(record.ratio, 1.5, 0, 1e-15);
  assert_contains(record.why, "below twice the information limit");
}

TEST(test_blind_score__own_candidate__has_its_rank_among_effects)
{
  const double limit[] = {1};
  const blind_trial t = trial_with(BLIND_SINGLE, "chamber_leak");
  succeed(blind_answer_read(scratch_text("report.json", report), &answer, &error));
  blind_score(&t, limit, &answer, &record);
  assert_int_equal(record.own_rank, 2);
  assert_close(record.own_statistic, 80.5, 0, 0);
  assert_string_equal(record.alike, "chamber_leak/supply_droop");
  assert_string_equal(record.equation, "mass+force");
  assert_string_equal(record.why, "stated as indistinguishable from what was named");
}

/* ---- The program ---- */

/* A program that says something, sleeps, writes a report where it is told to, and ends with a status. */
static const char *fake(const char *name, const char *script)
{
  const char *path = scratch_text(name, script);
  assert_int_equal(chmod(path, 0755), 0);
  return path;
}

TEST(test_blind_ask__report_failure_and_endless_run__are_answers)
{
  char folder[600], script[1500];
  snprintf(folder, sizeof folder, "%s", scratch_path("asked"));
  mkdir(folder, 0755);
  snprintf(script, sizeof script,
           "#!/bin/sh\n[ \"$2\" = %s/fit.csv ] || exit 9\ncat >\"$4/report.json\" <<'EOF'\n%s\nEOF\n", folder,
           "{\"verdict\": \"none\"}");
  succeed(blind_ask(fake("good", script), folder, 10, &answer, &error));
  assert_string_equal(answer.verdict, "none");
  succeed(blind_ask(fake("bad", "#!/bin/sh\necho 'log.csv:3: bad, very' >&2\nexit 1\n"), folder, 10, &answer, &error));
  assert_string_equal(answer.verdict, "failed");
  assert_string_equal(answer.words, "log.csv:3: bad; very;");
  succeed(blind_ask(fake("slow", "#!/bin/sh\nsleep 2\nexit 1\n"), folder, 1, &answer, &error));
  assert_string_equal(answer.verdict, "failed"); /* it waited, as on a busy machine, and computed nothing */
  succeed(blind_ask(fake("endless", "#!/bin/sh\nwhile :; do :; done\n"), folder, 1, &answer, &error));
  assert_string_equal(answer.verdict, "timeout");
  succeed(
      blind_ask(fake("polite", "#!/bin/sh\ntrap 'exit 4' XCPU\nwhile :; do :; done\n"), folder, 1, &answer, &error));
  assert_string_equal(answer.verdict, "timeout");
  assert_int_equal(blind_ask("/no/such/program", folder, 1, &answer, &error), LAB_WORLD);
}

/* ---- Records ---- */

/* A record as the score makes it: chamber_leak missing, twelve times the limit. */
static blind_record sample_record(int trial, const char *verdict, const char *found)
{
  const double limit[] = {0.25};
  blind_trial t = trial_with(BLIND_SINGLE, "chamber_leak");
  t.number = trial;
  t.channels = BLIND_P | BLIND_X;
  set_answer(verdict, found, "");
  answer.holdout_after = 1.01;
  answer.before = NAN;
  blind_score(&t, limit, &answer, &record);
  return record;
}

TEST(test_blind_record_read__what_was_written__is_the_same)
{
  const blind_record r = sample_record(12, "effect", "supply_droop:chamber_leak");
  char *line = line_of(&r, 0), *again;
  blind_record back;
  assert_int_equal(blind_record_read(line, 0, &back), 1);
  again = line_of(&back, 0);
  assert_string_equal(line, again);
  assert_int_equal(back.trial, 12);
  assert_string_equal(back.why, r.why);
  assert_close(back.ratio, 12, 0, 0);
  assert_true(isnan(back.before));
  free(line);
  free(again);
}

TEST(test_blind_record_read__line_cut_anywhere__is_refused)
{
  const blind_record r = sample_record(12, "none", "");
  char *line = line_of(&r, 0);
  blind_record back;
  size_t n;
  for (n = strlen(line); n-- > 0;) {
    line[n] = '\0';
    assert_int_equal(blind_record_read(line, 0, &back), 0);
  }
  free(line);
}

TEST(test_blind_journal__stopped_in_a_line__goes_on_after_the_last_whole_one)
{
  const char *path = scratch_path("journal.csv");
  const blind_record first = sample_record(3, "none", ""), second = sample_record(1, "effect", "chamber_leak");
  blind_journal j;
  FILE *file;
  succeed(blind_journal_open(&j, path, "# key", 10, 0, &error));
  succeed(blind_journal_add(&j, &first, &error));
  succeed(blind_journal_add(&j, &second, &error));
  blind_journal_close(&j);
  file = fopen(path, "a");
  fputs("7,single,px,R1-", file);
  fclose(file);
  succeed(blind_journal_open(&j, path, "# key", 10, 0, &error));
  assert_int_equal(j.n, 2);
  assert_true(blind_journal_has(&j, 3) && blind_journal_has(&j, 1) && !blind_journal_has(&j, 7));
  blind_journal_sort(&j);
  assert_int_equal(j.record[0].trial, 1);
  blind_journal_close(&j);
  succeed(blind_journal_open(&j, path, "# key", 3, 0, &error)); /* fewer trials: 3 is not one of them */
  assert_int_equal(j.n, 1);
  blind_journal_close(&j);
  succeed(blind_journal_open(&j, path, "# other", 10, 0, &error));
  assert_int_equal(j.n, 0);
  blind_journal_close(&j);
}

/* ---- Counts ---- */

TEST(test_blind_wilson__ends_and_middle__are_the_closed_forms)
{
  const double z2 = 1.959963984540054 * 1.959963984540054;
  const blind_count none = {0, 20}, every = {20, 20}, half = {5, 10}, nothing = {0, 0};
  double low, high;
  blind_wilson(none, &low, &high);
  assert_close(low, 0, 0, 0);
  assert_close(high, z2 / (20 + z2), 0, 1e-12);
  blind_wilson(every, &low, &high);
  assert_close(low, 20 / (20 + z2), 0, 1e-12);
  assert_close(high, 1, 0, 0);
  blind_wilson(half, &low, &high);
  assert_close(low + high, 1, 0, 1e-12);
  assert_close(high - low, sqrt(z2 / (10 + z2)), 0, 1e-12);
  blind_wilson(nothing, &low, &high);
  assert_close(low, 0, 0, 0);
  assert_close(high, 1, 0, 0);
}

TEST(test_blind_quantile__few_values__between_by_lines)
{
  double v[] = {5, 1, 3}, one[] = {7};
  assert_close(blind_quantile(v, 3, 0.5), 3, 0, 0);
  assert_close(blind_quantile(v, 3, 0.9), 4.6, 0, 1e-15);
  assert_close(blind_quantile(one, 1, 0.9), 7, 0, 0);
}

/* Found from 4 on but for one of ten: the isotonic fit over 4 .. 13 is 0.9. */
TEST(test_blind_nine_in_ten__one_of_ten_missed__is_still_nine)
{
  blind_sized v[13];
  int i;
  for (i = 0; i < 13; i++)
    v[i] = (blind_sized){13 - i, 13 - i >= 4 && 13 - i != 13};
  assert_close(blind_nine_in_ten(v, 13), 4, 0, 0);
  v[0].found = 1; /* the smallest, by luck: pooled with its neighbours it counts for little */
  assert_close(blind_nine_in_ten(v, 13), 4, 0, 0);
  for (i = 0; i < 13; i++)
    v[i].found = i % 2;
  assert_true(isnan(blind_nine_in_ten(v, 12)));
}

/* ---- Summary ---- */

TEST(test_blind_bar_word__counts__by_share_and_interval)
{
  static const struct {
    int at_least;
    double share;
    blind_count count;
    int word;
  } cases[] = {
      {1, 0.95, {400, 400}, BLIND_BAR_SHOWN}, {1, 0.95, {19, 20}, BLIND_BAR_REACHED},
      {1, 0.95, {18, 20}, BLIND_BAR_MISSED},  {1, 0.95, {9, 12}, BLIND_BAR_REFUTED},
      {1, 0.95, {0, 0}, BLIND_BAR_REACHED},   {0, 0.01, {0, 400}, BLIND_BAR_SHOWN},
      {0, 0.01, {1, 100}, BLIND_BAR_REACHED}, {0, 0.01, {2, 100}, BLIND_BAR_MISSED},
      {0, 0.01, {1, 6}, BLIND_BAR_REFUTED},   {0, 0.01, {0, 0}, BLIND_BAR_REACHED},
  };
  size_t i;
  for (i = 0; i < sizeof cases / sizeof cases[0]; i++) {
    const blind_bar bar = {"", 0, 0, cases[i].at_least, cases[i].share};
    assert_int_equal(blind_bar_word(&bar, cases[i].count), cases[i].word);
  }
}

static blind_count bar_of_stated(const blind_record *r, int n)
{
  return blind_bar_counts(&blind_bars, 1, r, n);
}

TEST(test_blind_bar_counts__right_names__counts_trials_above_twice_the_limit)
{
  blind_record r[3] = {sample_record(0, "effect", "chamber_leak"), sample_record(1, "none", ""),
                       sample_record(2, "none", "")};
  r[2].ratio = 1.9;
  assert_int_equal(bar_of_stated(r, 3).n, 2);
  assert_int_equal(bar_of_stated(r, 3).k, 1);
  strcpy(r[1].channels, "x");
  assert_int_equal(bar_of_stated(r, 3).n, 1);
}

TEST(test_blind_summary_write__misses__are_listed_one_by_one)
{
  const blind_record r[3] = {sample_record(4, "effect", "chamber_leak"), sample_record(5, "none", ""),
                             sample_record(6, "effect", "dead_time")};
  char *text = NULL;
  size_t size;
  FILE *memory = open_memstream(&text, &size);
  assert_int_equal(blind_summary_write(memory, r, 3, 1, ""), 0);
  fclose(memory);
  assert_contains(text, "3 trials, seed 1");
  assert_contains(text, "| 1/3 | 33.3 % |");
  assert_contains(text, "| 5 | px | chamber_leak -3 m2 (12 x) | none | 1.01 | ");
  assert_contains(text, "| 6 | px | chamber_leak -3 m2 (12 x) | effect: dead_time | 1.01 | ");
  assert_null(strstr(text, "\n| 4 | px"));
  free(text);
}
