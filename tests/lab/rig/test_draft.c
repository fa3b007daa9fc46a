/* apps/lab/rig/draft and sheetwords: a rig file drafted from a log and the words of a sheet. */
#include "../../badlog.h"

#include "../../../apps/lab/log/log.h"
#include "../../../apps/lab/rig/draft.h"
#include "../../../apps/lab/rig/rig.h"
#include "../../../apps/lab/rig/sheetwords.h"

static const char *log_path;
static char *text; /* of the last draft */

static int open_all(void **state)
{
  static bad_log sound;
  sound = bad_log_of(0);
  if (scratch_open(state))
    return -1;
  log_path = strdup(bad_write("log.csv", "t [s],u [1],p [kPa],x [mm]", &sound));
  return 0;
}

static int close_all(void **state)
{
  free(text);
  return scratch_close(state);
}

TESTS_WITH(open_all, close_all)

/* Draft, and read what was written, which is `text` then. */
static lab_rig draft_of(const char *log, const char *const *sheet, int n)
{
  FILE *file = fopen(scratch_path("draft.cfg"), "w");
  lab_rig rig;
  assert_non_null(file);
  succeed(lab_draft_write(file, log, sheet, n, &error));
  assert_int_equal(fclose(file), 0);
  succeed(lab_rig_read(scratch_path("draft.cfg"), &rig, &error));
  free(text);
  text = scratch_read(scratch_path("draft.cfg"));
  return rig;
}

static int is_fitted(const lab_rig *rig, const char *name)
{
  char found[LAB_PARAM_NAME_TEXT];
  int i;
  for (i = 0; i < rig->n_fit; i++)
    if (strcmp(lab_fit_name(rig->fit[i], found), name) == 0)
      return 1;
  return 0;
}

/* The independent rig has 390 kN/m, 10 mm, 500 N, 0.893 mm2: starts of a fit, not its result. */
TEST(test_lab_draft_write__log_and_sheet__are_a_start_for_a_fit)
{
  static const char *const sheet[] = {"area=400 cm^2", "stroke=20 mm", "supply=400 kPa", "dead_volume=40 cm^3"};
  const lab_rig rig = draft_of(log_path, sheet, 4);
  assert_close((double)rig.params.area, 0.04, 0, 1e-6);
  assert_close((double)rig.params.spring_rate, 4e5, 0, 0.1);
  assert_close((double)rig.params.spring_preload, 0.01, 0, 0.2);
  assert_close((double)rig.params.dry_friction, 500, 0, 0.5);
  assert_close((double)rig.params.fill_area, 0.893e-6, 0, 0.3);
  assert_close((double)rig.params.vent_area, 0.893e-6, 0, 0.3);
  assert_int_equal(rig.laws.flow, PNEU_FLOW_ISO6358);
  assert_contains(text, " critical_ratio = \"100 %\";"); /* a nozzle has 0.528 */
  assert_true(is_fitted(&rig, "spring_rate") && is_fitted(&rig, "fill_area") && is_fitted(&rig, "dry_friction"));
  assert_contains(text, "area = \"400 cm^2\"; // sheet");
  assert_contains(text, "1001 rows in 10 s, one each 0.01 s (100 Hz)");
  assert_contains(text, "// derived: area times the slope of p over x");
  assert_contains(text, "moving_mass = \"2 kg\"; // NOT KNOWN");
  assert_contains(text, " moving_mass = \"100 %\";");   /* a default is not the sheet's */
  assert_contains(text, " dry_friction = \"1000 %\";"); /* nor is where a fit begins */
  assert_null(strstr(text, " stroke = \"100"));
  assert_contains(text, "// name = \"...\"; // by default that of this file");
}

TEST(test_lab_draft_write__words_of_the_sheet__are_not_fitted)
{
  static const char *const sheet[] = {"bench_set=0.2..1.0 bar", "Kv=0.1",    "vent.xT=0.5",  "tube.length=2 m",
                                      "tube.bore=4 mm",         "name=FV 1", "flow=iso6358", "actuator.stroke=20 mm"};
  const lab_rig rig = draft_of(log_path, sheet, 8);
  assert_close((double)rig.params.spring_preload, 0.005, 0, 1e-6);
  assert_true(rig.params.vent_area < rig.params.fill_area);
  assert_string_equal(rig.name, "FV 1");
  assert_int_equal(rig.laws.flow, PNEU_FLOW_ISO6358);
  assert_false(is_fitted(&rig, "spring_rate") || is_fitted(&rig, "fill_area") || is_fitted(&rig, "vent_area"));
  assert_true(is_fitted(&rig, "dry_friction"));
  assert_null(strstr(text, " critical_ratio = \"100 %\";"));
}

/* Bench set of 0.8 bar on 350 cm2 over 15 mm. */
TEST(test_lab_draft_write__no_log_yet__is_all_of_the_sheet)
{
  static const char *const sheet[] = {"area=350 cm2", "travel=15 mm", "bench_set=0.2..1.0 bar", "Kvs=0.1",
                                      "supply=1.4 bar"};
  const lab_rig rig = draft_of(NULL, sheet, 5);
  assert_close((double)rig.params.spring_rate, 0.8e5 * 0.035 / 0.015, 0, 1e-9);
  assert_close((double)rig.params.spring_preload, 0.015 / 4, 0, 1e-9);
  assert_int_equal(rig.n_fit, 0);
  assert_int_equal(rig.laws.flow, PNEU_FLOW_ISO6358);
  assert_contains(text, "without a log");
  assert_contains(text, "vent = { Kv = \"0.1\"; }");
  assert_contains(text, "NOT KNOWN, a default: lumped moving mass");
}

/* Its orifices pass what IEC 60534-2-1 says of Kv, xT 0.72, to 4.2 %: kg/s of air at 293.15 K from 7 bar. */
TEST(test_lab_draft_write__orifice_of_a_kv__passes_what_the_standard_says)
{
  static const char *const sheet[] = {"area=350 cm2", "travel=15 mm", "bench_set=0.2..1.0 bar", "Kvs=0.1",
                                      "supply=1.4 bar"};
  const double p1 = 7e5, R = 287.05, T = 293.15;
  lab_rig rig = draft_of(NULL, sheet, 5);
  pneu_model model;
  int i;
  assert_int_equal(pneu_model_init(&model, &rig.params, &rig.laws, NULL), PNEU_OK);
  for (i = 1; i < 50; i++) {
    const double x = fmin(i / 50.0, 0.72), kg_h = 31.6 * 0.1 * (1 - x / 2.16) * sqrt(x * p1 / 1e5 * p1 / (R * T));
    pneu_flow flow;
    pneu_orifice(&model, rig.laws.flow, rig.params.fill_area, (pneu_real)p1, (pneu_real)T,
                 (pneu_real)(p1 * (1 - i / 50.0)), &flow);
    check_note("pressure drop %d/50", i);
    assert_close((double)flow.q, kg_h / 3600, 0, 0.042);
  }
}

/* Without any sheet, a positioner's log with shares of the stroke: what is not known is marked. */
TEST(test_lab_draft_write__files_of_loggers__are_read_with_their_draft)
{
  static const char *const files[] = {"excel-de.csv", "valvelink.csv", "numpy-savetxt.csv", "grafana.csv"};
  size_t i;
  for (i = 0; i < sizeof files / sizeof files[0]; i++) {
    char path[256];
    lab_log log;
    lab_rig rig;
    check_note("%s", files[i]);
    snprintf(path, sizeof path, "tests/loggers/%s", files[i]);
    rig = draft_of(path, NULL, 0);
    succeed(lab_log_read(path, &rig.log, 101325, &log, &error));
    assert_int_equal(lab_rig_has_positioner(&rig), log.value[LAB_CHANNEL_U] == NULL);
    lab_log_free(&log);
    assert_contains(text, "area = \"0.04 m2\"; // NOT KNOWN");
    assert_contains(text, strstr(files[i], "excel") || strstr(files[i], "link") ? "stroke = \"0.02 m\"; // NOT KNOWN"
                                                                                : "stroke = \"0.01 m\"; // derived");
  }
}

static void assert_no_word(const char *word, int status, const char *words)
{
  FILE *file = fopen(scratch_path("draft.cfg"), "w");
  assert_non_null(file);
  assert_int_equal(lab_draft_write(file, log_path, &word, 1, &error), status);
  assert_int_equal(fclose(file), 0);
  assert_contains(error.text, words);
}

/* What the sheet says of the positioner is declared, and not fitted. */
TEST(test_lab_draft_write__positioner_of_the_sheet__is_declared)
{
  static const char *const sheet[] = {"area=400 cm2", "stroke=20 mm", "positioner.gain=39.6",
                                      "positioner.dead_band=0.27 %"};
  const int gain = pneu_param_find("positioner.gain");
  const lab_rig rig = draft_of(NULL, sheet, 4);
  assert_true(gain >= 0);
  assert_close((double)*pneu_param_at((pneu_params *)&rig.params, gain), 39.6, 0, 1e-9);
  assert_contains(text, "positioner = { gain = \"39.6\"; dead_band = \"0.27 %\"; }; // sheet");
}

TEST(test_lab_draft_write__what_is_no_word_of_a_sheet__is_refused)
{
  static const char *const twice[] = {"area=1 cm2", "area=2 cm2"};
  assert_no_word("aera=1 cm2", LAB_USAGE, "the nearest known one is \"area\"");
  assert_no_word("area", LAB_USAGE, "expected key=value");
  assert_no_word("name=\"x\"", LAB_USAGE, "without quotes");
  assert_no_word("pressure=4 bar", LAB_USAGE, "Write \"supply.pressure\" or \"ambient.pressure\"");
  assert_no_word("bench_set=1 bar", LAB_USAGE, "expected two pressures");
  assert_no_word("area=1 kg", LAB_DATA, "actuator.area");
  assert_fails(lab_draft_write(stdout, log_path, twice, 2, &error), LAB_USAGE, "area is there twice");
}

TEST(test_lab_draft_write__actuator_by_name__has_its_makers_values)
{
  static const struct {
    const char *name;
    double area, stroke, low, high; /* m2, m, Pa of the bench set */
  } actuators[] = {{"actuator=fisher-657-40", 0.0445, 0.038, 2e4, 1e5},
                   {"actuator=masoneilan-37-13", 0.0677418, 0.0381, 20684.27, 103421.4},
                   {"actuator=polna-p-630-38", 0.063, 0.038, 2e4, 1e5},
                   {"actuator=siemens-powers-4", 0.0071, 0.102, 2.1e4, 5e4}};
  int i;
  for (i = 0; i < (int)(sizeof actuators / sizeof actuators[0]); i++) {
    const lab_rig rig = draft_of(log_path, &actuators[i].name, 1);
    const pneu_params *p = &rig.params;
    check_note("%s", actuators[i].name);
    assert_close((double)p->area, actuators[i].area, 0, 1e-6);
    assert_close((double)p->stroke, actuators[i].stroke, 0, 1e-6);
    assert_close((double)(p->spring_rate * p->spring_preload / p->area), actuators[i].low, 0, 1e-5);
    assert_close((double)(p->spring_rate * (p->spring_preload + p->stroke) / p->area), actuators[i].high, 0, 1e-5);
    assert_contains(text, "// catalogue");
    assert_string_equal(rig.name, strchr(actuators[i].name, '=') + 1);
  }
}

TEST(test_lab_draft_write__actuator_by_name__the_sheet_comes_first)
{
  static const char *const sheet[] = {"actuator=hora-pa-n-280-30", "stroke=25 mm", "bench_set=0.8..2.4 bar"};
  static const char *const unknown[] = {"actuator=hora-pa-n-280"};
  const lab_rig rig = draft_of(log_path, sheet, 3);
  assert_close((double)rig.params.stroke, 0.025, 0, 1e-9);
  assert_close((double)rig.params.dead_volume, 0.48e-3, 0, 1e-9);
  assert_contains(text, "stroke = \"25 mm\"; // sheet");
  assert_contains(text, "// Catalogue: HORA");
  assert_fails(lab_draft_write(stdout, log_path, unknown, 1, &error), LAB_USAGE, "hora-pa-n-280-");
}

/* Areas by the same sheet in a rig file; what the sheet says of an orifice goes before what its positioner passes. */
TEST(test_lab_draft_write__positioner_by_name__has_its_makers_values)
{
  static const struct {
    const char *word[2];
    double fill, vent; /* over those of Kv = 0.1 */
  } positioners[] = {{{"positioner=siemens-sipart-ps2"}, 1, 2}, {{"positioner=siemens-sipart-ps2", "Kv=0.3"}, 3, 3}};
  static const char *const kv[] = {"Kv=0.1"}, *const unknown[] = {"positioner=samson-3731"};
  static const char *const flow[] = {"positioner=samson-3730"};
  const double unit = (double)draft_of(log_path, kv, 1).params.fill_area;
  lab_rig rig;
  int i;
  for (i = 0; i < 2; i++) {
    rig = draft_of(log_path, positioners[i].word, positioners[i].word[1] ? 2 : 1);
    assert_close((double)rig.params.fill_area, positioners[i].fill * unit, 0, 1e-6);
    assert_close((double)rig.params.vent_area, positioners[i].vent * unit, 0, 1e-6);
    assert_contains(text, "// Catalogue: Siemens SIPART PS2");
  }
  rig = draft_of(log_path, flow, 1);
  assert_close((double)(rig.params.vent_area / rig.params.fill_area), 14 / 8.5, 0, 1e-6);
  assert_fails(lab_draft_write(stdout, log_path, unknown, 1, &error), LAB_USAGE, "samson-3730");
}

TEST(test_lab_sheet_ask__answers__are_words_of_the_sheet)
{
  char given[] = "fisher-40\nfisher-657-40\n0.4 bar\n0.4..2 bar\n\n\n open\n\n 5 kg \n";
  char said[2048] = "";
  FILE *in = fmemopen(given, sizeof given - 1, "r"), *out = fmemopen(said, sizeof said, "w");
  lab_sheet_answers answers;
  const char *words[LAB_QUESTIONS];
  int i;
  assert_non_null(in);
  assert_non_null(out);
  lab_sheet_ask(in, out, &answers);
  fclose(in);
  fclose(out);
  assert_int_equal(answers.n, 4);
  assert_string_equal(answers.text[0], "actuator=fisher-657-40");
  assert_string_equal(answers.text[1], "bench_set=0.4..2 bar");
  assert_string_equal(answers.text[2], "fail=open");
  assert_string_equal(answers.text[3], "moving_mass=5 kg");
  assert_contains(said, "no actuator \"fisher-40\"; known ones: fisher-657-30, fisher-657-34, fisher-657-40, ");
  assert_contains(said, "expected two pressures");
  for (i = 0; i < answers.n; i++)
    words[i] = answers.text[i];
  draft_of(log_path, words, answers.n);
  assert_contains(text, "moving_mass = \"5 kg\"; // sheet");
  assert_contains(text, "fail = \"open\"; // sheet");
}
