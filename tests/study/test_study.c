/* apps/study/study: the file that says what the study is, and what is wrong with one that does not */
#include "../scratch.h"

#include "../../apps/study/study.h"

static study s;

/* A whole file; each row can be replaced. */
static const struct entry {
  const char *key, *text;
} entries[] = {
    {"actuators", "actuators = ( \"r1.cfg\" );"},
    {"subject", "subject = \"r1\";"},
    {"gas", "gas = ( \"isothermal\", \"energy\" );"},
    {"flow", "flow = ( \"paper\" );"},
    {"results", "results = \"out\";"},
    {"confirmed_below", "confirmed_below = 0.1;"},
    {"H1", "H1 = { from = \"20 kN/m\"; to = \"560 kN/m\"; points = 28; };"},
    {"H2", "H2 = { from = 0; to = 4000; points = 21; };"},
    {"H3", "H3 = { from = \"25 %\"; to = \"100 %\"; points = 16; };"},
    {"H4", "H4 = { bench_sets = ( ( \"80 kPa\", \"240 kPa\" ), ( 1e5, 2e5 ) ); };"},
    {"H5", "H5 = { from = 0.25; to = 2; points = 36; };"},
};

/* Write the file with another text for one key.  Returns: its path */
static const char *file_with(const char *key, const char *instead)
{
  char text[4096] = "";
  int i;
  for (i = 0; i < (int)(sizeof entries / sizeof *entries); i++)
    lab_append(text, sizeof text, "%s\n", strcmp(entries[i].key, key) == 0 ? instead : entries[i].text);
  scratch_text("r1.cfg", "actuator = { name = \"r1\"; };\n");
  return scratch_text("study.cfg", text);
}

TEST(test_study_read__whole_file__is_taken_up)
{
  succeed(study_read(file_with("", ""), &s, &error));
  assert_int_equal(s.n_actuators, 1);
  assert_int_equal(s.subject, 0);
  assert_int_equal(s.n_gas, 2);
  assert_int_equal(s.gas[1], PNEU_GAS_ENERGY);
  assert_int_equal(s.n_flow, 1);
  assert_string_equal(s.results, "out");
  assert_close(s.range[0].to, 560e3, 1e-6, 0);
  assert_close(s.range[2].from, 0.25, 1e-12, 0);
  assert_int_equal(s.range[4].points, 36);
  assert_int_equal(s.n_benches, 2);
  assert_close(s.bench[0].high, 240e3, 1e-6, 0);
}

TEST(test_study_read__bad_keys__are_refused)
{
  static const struct {
    const char *key, *instead, *words;
  } cases[] = {
      {"subject", "", "key subject is missing"},
      {"subject", "subject = 5;", "a text in quotes"},
      {"subject", "subject = \"r2\";", "no actuator of the list is named \"r2\""},
      {"subject", "subject = \"r1\"; sbject = 1;", "nearest known one is \"subject\""},
      {"actuators", "actuators = ( );", "1 to 8 entries"},
      {"actuators", "actuators = ( \"nothere.cfg\" );", "nothere.cfg: there is no such file"},
      {"actuators", "actuators = ( 5 );", "actuators[0]: expected a text"},
      {"gas", "gas = \"energy\";", "gas: expected a list"},
      {"gas", "gas = ( \"enrgy\" );", "nearest known one is \"energy\""},
      {"flow", "flow = ( \"papr\" );", "nearest known one is \"paper\""},
      {"confirmed_below", "confirmed_below = 2;", "expected 0 to 1"},
      {"H1", "H1 = 5;", "a group"},
      {"H1", "H1 = { from = 1; to = 2; };", "expected the keys from, to and points"},
      {"H1", "H1 = { from = 1; to = 2; points = 3; step = 1; };", "unknown key"},
      {"H2", "H2 = { from = \"1 m\"; to = 2; points = 3; };", "H2.from"},
      {"H3", "H3 = { from = 2; to = 1; points = 3; };", "H3.to"},
      {"H5", "H5 = { from = 1; to = 2; points = 1; };", "a whole number, 2 to 10000"},
      {"H4", "H4 = { };", "expected the key bench_sets"},
      {"H4", "H4 = 5;", "a group"},
      {"H4", "H4 = { bench_sets = ( ); };", "1 to 16 entries"},
      {"H4", "H4 = { bench_sets = ( ( 1 ) ); };", "2 to 2 entries"},
      {"H4", "H4 = { bench_sets = ( ( \"1 m\", 2 ) ); };", "H4.bench_sets[0][0]"},
      {"H4", "H4 = { bench_sets = ( ( 2, 2 ) ); };", "H4.bench_sets[0][1]"},
  };
  int i;
  for (i = 0; i < (int)(sizeof cases / sizeof *cases); i++) {
    check_note("%s", cases[i].instead);
    assert_fails(study_read(file_with(cases[i].key, cases[i].instead), &s, &error), LAB_DATA, ".cfg");
    assert_contains(error.text, cases[i].words);
  }
}

/* A path that the file cannot be beside. */
TEST(test_study_read__path_too_long__is_refused)
{
  char path[2 * STUDY_PATH_TEXT], text[3 * STUDY_PATH_TEXT];
  memset(path, 'a', sizeof path);
  path[sizeof path - 1] = 0;
  assert_fails(study_read(path, &s, &error), LAB_DATA, "path is too long");
  path[STUDY_PATH_TEXT - 1] = 0;
  snprintf(text, sizeof text, "actuators = ( \"%.*s\" );", STUDY_PATH_TEXT - 1, path);
  assert_fails(study_read(file_with("actuators", text), &s, &error), LAB_DATA, "path is too long");
  path[STUDY_PATH_TEXT / 2] = 0;
  assert_fails(study_read(path, &s, &error), LAB_DATA, "there is no such file");
}

TEST(test_study_save__table__is_written_and_noted)
{
  static study_saved saved;
  table t;
  snprintf(s.results, sizeof s.results, "%s", scratch_folder);
  table_open(&t, "a");
  table_row(&t, "g", 7.0);
  s.saved = NULL;
  succeed(study_save(&s, "first.csv", &t, &error));
  s.saved = &saved;
  succeed(study_save(&s, "one.csv", &t, &error));
  succeed(study_save(&s, "two.csv", &t, &error));
  assert_string_equal(saved.names, "one.csv two.csv");
  assert_true(scratch_exists(scratch_path("first.csv")));
  t.failed = 1;
  assert_int_equal(study_save(&s, "three.csv", &t, &error), LAB_WORLD);
  assert_false(scratch_exists(scratch_path("three.csv")));
  snprintf(s.results, sizeof s.results, "%s/one.csv", scratch_folder); /* no folder */
  t.failed = 0;
  assert_int_equal(study_save(&s, "four.csv", &t, &error), LAB_WORLD);
  table_close(&t);
}

TEST(test_study_laws__others_than_the_rig_s__keep_its_inputs)
{
  lab_rig rig;
  pneu_laws laws;
  lab_rig_default(&rig);
  rig.laws.position_input = 1;
  laws = study_laws(&rig, PNEU_GAS_ENERGY, PNEU_FLOW_ISO6358);
  assert_int_equal(laws.gas, PNEU_GAS_ENERGY);
  assert_int_equal(laws.flow, PNEU_FLOW_ISO6358);
  assert_int_equal(laws.position_input, 1);
}
