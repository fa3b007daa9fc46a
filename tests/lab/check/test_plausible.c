/* apps/lab/check/plausible with view, and mend, thin, remarks, show. What closeloop makes of them is in
 * tests/apps/test_closeloop.c.
 */
#include "../../badlog.h"
#include "../../fixture.h"

#include "../../../apps/lab/base/text.h"
#include "../../../apps/lab/check/standstill.h"
#include "../../../apps/lab/check/mend.h"
#include "../../../apps/lab/check/plausible.h"

static const char *const header = "t [s],u [1],p [kPa],x [mm]";
static bad_log sound;
static lab_rig rig;
static lab_log log_read;
static lab_limitations limitations;
static lab_content content;

static int open_all(void **state)
{
  sound = bad_log_of(0);
  return scratch_open(state);
}

TESTS_WITH(open_all, scratch_close)

static int done(void **state)
{
  lab_log_free(&log_read);
  memset(&log_read, 0, sizeof log_read);
  return 0;
}

static int fresh(void **state)
{
  memset(&limitations, 0, sizeof limitations);
  memset(&content, 0, sizeof content);
  memset(&error, 0, sizeof error);
  return done(state);
}

#define CASE(name) TEST_WITH(name, fresh, done)

static void read_files(const char *rig_path, const char *log_path)
{
  lab_log_free(&log_read);
  if (lab_rig_read(rig_path, &rig, &error) ||
      lab_log_read(log_path, &rig.log, (double)rig.params.ambient_pressure, &log_read, &error))
    fail_msg("%s", error.text);
}

/* In: columns  header of the log  more  of the rig file */
static void read_columns(const char *columns, const bad_log *b, const char *more)
{
  read_files(bad_rig("rig.cfg", more), bad_write("log.csv", columns, b));
}

static void read_log(const bad_log *b)
{
  read_columns(header, b, "");
}

/* All that closeloop asks before a fit.  Returns: status */
static int judge(void)
{
  lab_log_thin(&log_read, LAB_THIN_ROWS, &limitations);
  if (lab_log_clean(&rig, &log_read, &limitations, &error) ||
      lab_plausible(&rig, &log_read, &limitations, &content, &error))
    return error.status;
  return lab_plausible_content(&rig, &content, &limitations, &error);
}

static void assert_passes(void)
{
  if (judge() != LAB_OK)
    fail_msg("%s", error.text);
}

static void assert_judged_wrong(const char *words)
{
  assert_int_equal(judge(), LAB_DATA);
  assert_contains(error.text, words);
}

/* A sound log: no error, no doubt, and no remark. */
static void assert_quiet(void)
{
  assert_passes();
  if (limitations.n > 0)
    fail_msg("%s", limitations.text[0]);
  assert_int_equal(limitations.doubt, 0);
}

/* ---- Logs that must pass ---- */

CASE(test_lab_plausible__sound_log__is_quiet)
{
  read_log(&sound);
  assert_quiet();
  assert_int_equal(content.runs, 1);
  assert_int_equal(content.still, 0);
  assert_int_equal(content.values, 2 * BAD_ROWS);
}

CASE(test_lab_plausible__leak__is_quiet)
{
  const bad_log b = bad_log_of(5e-8); /* a eighteenth of the orifice */
  read_log(&b);
  assert_quiet();
}

CASE(test_lab_plausible__position_only__is_quiet)
{
  read_columns("t [s],u [1],-,x [mm]", &sound, "");
  assert_quiet();
}

CASE(test_lab_plausible__pressure_only__is_quiet)
{
  read_columns("t [s],u [1],p [kPa],-", &sound, "");
  assert_quiet();
}

CASE(test_lab_plausible__pressure_as_input__is_quiet)
{
  read_columns("t [s],-,p [kPa],x [mm]", &sound, "inputs = [\"p\"];\n");
  assert_quiet();
}

/* Closed and charged, 21 rows of a pressure that sinks: no command, no stem. */
CASE(test_lab_plausible__vessel_that_leaks__is_quiet)
{
  char text[2048] = "t [s],p [kPa]\n";
  int i;
  for (i = 0; i <= 20; i++)
    lab_append(text, sizeof text, "%d,%.4g\n", i, 300 * exp(-0.1 * i) + 0.3 * (i % 3 - 1));
  read_files(scratch_text("rig.cfg", "actuator = { stroke = \"0 mm\"; dead_volume = \"1 dm^3\"; };\n"
                                     "supply = { pressure = \"400 kPa\"; };\nlog = { constants = { u = 0; }; };\n"
                                     "noise = { pressure = \"0.3 kPa\"; };\nfit = (\"dead_volume\");\n"),
             scratch_text("log.csv", text));
  assert_quiet();
}

/* A weak pump and a sensor that is off by its declared noise: more than the supply, and not by enough to refuse it. */
CASE(test_lab_plausible__more_than_the_supply_by_less_than_noise__passes)
{
  char text[4096] = "t [s],p [kPa]\n";
  int i;
  for (i = 0; i <= 60; i++)
    lab_append(text, sizeof text, "%.1f,%.4g\n", 0.1 * i, 7.2 * (1 - exp(-1.5 * i / 10)) + 0.2 * (i % 3 - 1));
  read_files(scratch_text("rig.cfg", "actuator = { stroke = \"0 mm\"; dead_volume = \"1 dm^3\"; };\n"
                                     "transducer = { fill_area = \"3 mm^2\"; };\n"
                                     "supply = { pressure = \"5 kPa\"; };\nlog = { constants = { u = 1; }; };\n"
                                     "noise = { pressure = \"1 kPa\"; };\nfit = (\"fill_area\");\n"),
             scratch_text("log.csv", text));
  assert_passes();
}

/* An area wrong by a factor of five is what fits are for. */
CASE(test_lab_plausible__poor_guess_of_the_orifices__is_quiet)
{
  static const double factors[] = {0.2, 5};
  int i;
  for (i = 0; i < 2; i++) {
    fresh(state);
    read_log(&sound);
    rig.params.fill_area *= (pneu_real)factors[i];
    rig.params.vent_area *= (pneu_real)factors[i];
    assert_quiet();
  }
}

/* A valve forty times slower than declared is refused, unless a positioner gave its commands. */
CASE(test_lab_plausible__slow_valve__is_refused_unless_a_positioner_moves_it)
{
  int with_positioner;
  for (with_positioner = 0; with_positioner < 2; with_positioner++) {
    fresh(state);
    read_log(&sound);
    rig.params.fill_area *= 40;
    rig.params.vent_area *= 40;
    if (with_positioner)
      log_read.value[LAB_CHANNEL_SP] = calloc(log_read.n, sizeof(double));
    assert_int_equal(judge(), with_positioner ? LAB_OK : LAB_DATA);
    if (!with_positioner)
      assert_contains(error.text, "slower than the declared model");
  }
}

/* The logs of the rig that come with the data, where they are on this machine: none may be refused or doubted. */
CASE(test_lab_plausible__logs_of_the_rig__are_quiet)
{
  static const char *const names[] = {"backpressure-a", "bias-a",         "choked-a",    "lag-a",
                                      "leak-a",         "leak-b",         "null-a",      "null-b",
                                      "spring-a",       "leak-thermal-a", "stickspot-a", "travel-a",
                                      "stribeck-a",     "thermal-a",      "thermal-b",   "xonly-leak-a"};
  static const char *const logs[] = {"fit", "holdout"};
  const char *folder = getenv("MEASURED");
  char cfg[512], csv[512];
  size_t i, k;
  snprintf(cfg, sizeof cfg, "%s/rig/null-a/rig.cfg", folder ? folder : "../shared/data");
  if (!scratch_exists(cfg)) {
    printf("absent: %s\n", cfg);
    skip();
  }
  for (i = 0; i < sizeof names / sizeof names[0]; i++)
    for (k = 0; k < 2; k++) {
      fresh(state);
      snprintf(cfg, sizeof cfg, "%s/rig/%s/rig.cfg", folder ? folder : "../shared/data", names[i]);
      snprintf(csv, sizeof csv, "%s/rig/%s/%s.csv", folder ? folder : "../shared/data", names[i], logs[k]);
      read_files(cfg, csv);
      assert_quiet();
    }
}

/* ---- Content ---- */

CASE(test_lab_plausible_content__one_still_run_of_two__passes)
{
  bad_log b = sound;
  read_log(&sound);
  assert_passes();
  b.n = 40;
  read_log(&b);
  assert_passes();
  assert_int_equal(content.runs, 2);
  assert_int_equal(content.still, 1);
}

/* ---- Checks that the processes do not reach ---- */

CASE(test_lab_plausible__temperature_in_other_degrees__is_refused)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.x[i] = 25 + 0.1 * (double)(i % 7);
  read_columns("t [s],u [1],p [kPa],T [K]", &b, "");
  assert_judged_wrong("degC and K");
}

CASE(test_lab_plausible__vent_that_ends_at_ambient_absolute__is_refused)
{
  char text[8192] = "t [s],u [1],p [kPa]\n";
  int i;
  for (i = 0; i < 200; i++)
    lab_append(text, sizeof text, "%g,%d,%.5g\n", 0.1 * i, i < 2 ? 0 : -1,
               i < 2 ? 390.0 : 101.3 + 288.7 * exp(-0.5 * 0.1 * (i - 1)) + 0.2 * (i % 3 - 1));
  read_files(scratch_text("rig.cfg",
                          "actuator = { stroke = \"0 mm\"; dead_volume = \"1 dm^3\"; };\n"
                          "transducer = { vent_area = \"3 mm^2\"; };\nsupply = { pressure = \"400 kPa\"; };\n"
                          "noise = { pressure = \"0.3 kPa\"; };\nfit = (\"dead_volume\");\n"),
             scratch_text("log.csv", text));
  assert_judged_wrong("the column is p_abs");
}

/* A chamber that reads ambient without a gauge would leave its stem on the stop. */
CASE(test_lab_plausible__stem_off_its_stop_at_ambient__is_gauge)
{
  char text[8192] = "t [s],u [1],p [kPa],x [mm]\n";
  int i;
  for (i = 0; i < 200; i++) {
    const double p = i < 20 ? 101.3 : 215 - 113.7 * exp(-0.05 * (i - 19));
    lab_append(text, sizeof text, "%g,%d,%.5g,%.5g\n", 0.1 * i, i >= 20, p + 0.2 * (i % 3 - 1),
               (p - 20) / 10 + 0.01 * (i % 3 - 1));
  }
  read_files(bad_rig("rig.cfg", ""), scratch_text("log.csv", text));
  rig.params.spring_preload = (pneu_real)0.002;
  assert_passes();
  for (i = 0; i < limitations.n; i++)
    if (strstr(limitations.text[i], "p_abs"))
      fail_msg("%s", limitations.text[i]);
}

CASE(test_lab_plausible__declared_noise_too_small__is_a_remark)
{
  read_log(&sound);
  rig.noise[LAB_CHANNEL_P] = 32;
  assert_passes();
  assert_int_equal(limitations.n, 1);
  assert_contains(limitations.text[0], "the noise of p is about 0.3");
  assert_int_equal(limitations.doubt, 0);
}

CASE(test_lab_say_idle_columns__force_and_far_pressure__are_told_unless_used)
{
  static const struct {
    const char *inputs;
    int force;
  } rigs[] = {{"", 1}, {"inputs = [\"force\"];", 0}, {"inputs = [\"x\"];", 0}};
  const char *path =
      strdup(scratch_text("f.csv", "t [s],u [1],p [kPa],x [mm],force [N],p2 [kPa]\n0,0,0,0,1,2\n1,1,1,1,2,3\n"));
  size_t i;
  for (i = 0; i < sizeof rigs / sizeof *rigs; i++) {
    limitations.n = 0;
    read_files(bad_rig("rig.cfg", rigs[i].inputs), path);
    lab_say_idle_columns(&rig, &log_read, &limitations);
    assert_int_equal(limitations.n, 1 + rigs[i].force);
    assert_contains(limitations.text[0], rigs[i].force ? "column force is not used" : "column p2 is not used");
  }
  free((char *)path);
}

/* A control system's output bar: 50 % is shut. */
CASE(test_lab_plausible__half_that_is_shut__is_told)
{
  static const struct {
    double sign;
    const char *header, *channel, *remedy;
  } cases[] = {
      {0.5, "t [s],u [1],p [kPa],x [mm]", "the pressure does not follow the command from t = 0 s",
       "u = 2.0; }; log.offset = { u = -1.0; }"},
      {0.5, "t [s],u [1],-,x [mm]", "the position does not follow", "50 % shut"},
      {-0.5, "t [s],u [1],p [kPa],x [mm]", "rises while u is below it", "u = -2.0; }; log.offset = { u = 1.0; }"}};
  size_t k, i;
  for (k = 0; k < sizeof cases / sizeof *cases; k++) {
    bad_log b = sound;
    check_note("%s", cases[k].header);
    fresh(state);
    for (i = 0; i < b.n; i++)
      b.u[i] = 0.5 + cases[k].sign * sound.u[i];
    read_columns(cases[k].header, &b, "");
    assert_judged_wrong(cases[k].channel);
    assert_contains(error.text, cases[k].remedy);
  }
}

/* Filled for 2 s, then at a command of `after` it sinks: more than any orifice of the model would let it. */
static void read_sinking_vessel(double after)
{
  char text[8192] = "t [s],u [1],p [kPa]\n";
  int i;
  for (i = 0; i < 200; i++)
    lab_append(text, sizeof text, "%g,%g,%.5g\n", 0.1 * i, i < 20 ? 1 : after,
               (i < 20 ? 15.0 * i : 300 * exp(-0.005 * (i - 20))) + 0.3 * (i % 3 - 1));
  read_files(scratch_text("rig.cfg",
                          "actuator = { stroke = \"0 mm\"; dead_volume = \"1 dm^3\"; };\n"
                          "transducer = { fill_area = \"1.5 mm^2\"; };\nsupply = { pressure = \"400 kPa\"; };\n"
                          "noise = { pressure = \"0.3 kPa\"; };\nfit = (\"dead_volume\");\n"),
             scratch_text("log.csv", text));
}

CASE(test_lab_plausible__pressure_lost_while_filling_or_shut__is_told)
{
  read_sinking_vessel(0);
  assert_passes();
  assert_int_equal(limitations.doubt, 0);
  assert_contains(limitations.text[0], "from t = 2 s to 19.9 s while u = 0 shuts both orifices: the chamber leaks");
  fresh(state);
  read_sinking_vessel(0.2);
  assert_passes();
  assert_contains(limitations.text[0], "while u = 0.2 fills: the chamber leaks more than the orifice lets in");
  fresh(state);
  read_sinking_vessel(-0.1);
  assert_passes();
  assert_true(limitations.n == 0 || !strstr(limitations.text[0], "leaks"));
}

/* ---- A declared stem that cannot move ---- */

/* The declared rig with a plain number for its supply, nothing of it fitted. */
static void declare_supply(double pressure)
{
  read_log(&sound);
  rig.n_fit = 0;
  rig.params.supply_pressure = (pneu_real)pressure;
}

CASE(test_lab_is_at_rest__supply_in_another_unit__is_named)
{
  static const struct meant {
    double number;
    const char *words;
  } meant[] = {
      {2.5, "did you mean \"2.5 bar\"?"}, {250, "did you mean \"250 kPa\"?"}, {36, "did you mean \"36 psi\"?"}};
  char text[LAB_LIMITATION_TEXT];
  size_t i;
  for (i = 0; i < sizeof meant / sizeof meant[0]; i++) {
    declare_supply(meant[i].number);
    assert_int_equal(lab_is_at_rest(&rig, 1, text), 1);
    assert_contains(text, meant[i].words);
  }
  declare_supply(109e3);
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 1);
  assert_null(strstr(text, "did you mean"));
  declare_supply(111e3);
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
  assert_string_equal(text, "");
}

CASE(test_lab_is_at_rest__supply_that_does_not_count__is_quiet)
{
  static const int inputs[] = {LAB_CHANNEL_P, LAB_CHANNEL_X, LAB_CHANNEL_PS, LAB_CHANNEL_FORCE};
  char text[LAB_LIMITATION_TEXT];
  size_t i;
  for (i = 0; i < sizeof inputs / sizeof inputs[0]; i++) {
    declare_supply(2.5);
    rig.input[inputs[i]] = 1;
    assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
  }
  declare_supply(2.5);
  rig.params.stroke = 0;
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
  declare_supply(2.5);
  rig.fit[rig.n_fit++] = PNEU_PARAM_supply_pressure;
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
  declare_supply(2.5);
  rig.params.external_force = -5000; /* pulls the stem up */
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
  declare_supply(2.5);
  rig.n_terms = 1;
  rig.term[0].equation = PNEU_TERM_SUPPLY;
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
}

CASE(test_lab_is_at_rest__spring_is_fitted__may_be_ten_times_less)
{
  char text[LAB_LIMITATION_TEXT];
  declare_supply(12e3);
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 0);
  rig.params.supply_pressure = 10e3;
  assert_int_equal(lab_is_at_rest(&rig, 1, text), 1);
}

CASE(test_lab_plausible__stem_that_rises_without_supply__is_refused)
{
  read_columns("t [s],u [1],-,x [mm]", &sound, "");
  rig.params.supply_pressure = (pneu_real)2.5;
  assert_judged_wrong("x rises, but the model's stem cannot leave its stop: supply.pressure is 2.5 Pa");
}

/* A recorder of 0.1 mm, whose last digit turns: what hardly moves is stuck. */
CASE(test_lab_plausible__stem_that_hardly_moves__is_stuck)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.x[i] = i % 7 ? 8e-3 : 8.1e-3;
  read_log(&b);
  assert_judged_wrong("channel x stays constant within");
  assert_contains(error.text, "is the stem stuck");
}

/* A decay of pressure below the bench set: the stem rests in the log as in the model. */
CASE(test_lab_plausible__stem_at_rest_below_its_bench_set__is_a_remark)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++) {
    b.u[i] = i < 50 ? 0 : i < 500 ? 1 : -1;
    b.p[i] = 80 * (i < 50    ? 0
                   : i < 500 ? 1 - exp(-0.05 * (double)(i - 50))
                             : exp(-0.02 * (double)(i - 500))) +
             0.3 * (double)(i % 3) - 0.3;
    b.x[i] = 0.02 * (double)(i % 3) - 0.02;
  }
  read_log(&b);
  rig.n_fit = 0;
  rig.params.supply_pressure = 80e3;
  assert_passes();
  assert_int_equal(limitations.doubt, 0);
  assert_contains(limitations.text[limitations.n - 1], "cannot leave its stop: supply.pressure is 80.00 kPa");
}

/* ---- Mending ---- */

CASE(test_lab_log_clean__pressure_input_that_saturates__is_refused)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.p[i] = fmin(sound.p[i], 180);
  read_columns("t [s],-,p [kPa],x [mm]", &b, "inputs = [\"p\"];\n");
  assert_judged_wrong("drives the model");
}

/* Without noise a plateau that is reached at speed gives it away; one that follows a command does not. */
CASE(test_lab_log_clean__plateau_without_noise__is_saturation_only_if_abrupt)
{
  bad_log b = sound;
  size_t i, gaps = 0;
  for (i = 0; i < b.n; i++)
    b.p[i] = b.t[i] < 0.4 ? 0 : fmin(100 * (b.t[i] - 0.4), 210); /* shut from 2.5 s on: it stays at 210 */
  read_log(&b);
  succeed(lab_log_clean(&rig, &log_read, &limitations, &error));
  assert_int_equal(limitations.n, 0);
  for (i = 0; i < b.n; i++)
    b.p[i] = fmin(b.p[i], 120);
  read_log(&b);
  succeed(lab_log_clean(&rig, &log_read, &limitations, &error));
  assert_contains(limitations.text[0], "120 kPa, its largest value");
  for (i = 0; i < log_read.n; i++)
    gaps += isnan(log_read.value[LAB_CHANNEL_P][i]) != 0;
  assert_true(gaps > 800);
}

/* A log without any noise rests exactly on its stops and that is no saturation. */
CASE(test_lab_log_clean__stop_without_noise__stays)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.x[i] = fmin(fmax(20 * (b.t[i] - 1), 0), 20);
  read_log(&b);
  succeed(lab_log_clean(&rig, &log_read, &limitations, &error));
  assert_int_equal(limitations.n, 0);
}

CASE(test_lab_log_clean__spike__becomes_a_gap)
{
  bad_log b = sound;
  b.p[300] = 9999;
  b.p[320] += 60;
  read_log(&b);
  succeed(lab_log_clean(&rig, &log_read, &limitations, &error));
  assert_int_equal(limitations.n, 1);
  assert_contains(limitations.text[0], "2 values of channel p are far from both neighbours, the first at line 302");
  assert_true(isnan(log_read.value[LAB_CHANNEL_P][300]));
  assert_true(isnan(log_read.value[LAB_CHANNEL_P][320]));
  assert_false(isnan(log_read.value[LAB_CHANNEL_P][301]));
}

/* ---- Thinning ---- */

/* A log of n rows 1 ms apart; the command changes where u_of says. */
static lab_log make_log(size_t n, double (*u_of)(size_t))
{
  lab_log log;
  size_t i;
  memset(&log, 0, sizeof log);
  log.path = calloc(1, 8);
  strcpy(log.path, "l.csv");
  log.n = n;
  log.n_runs = 1;
  log.run = calloc(2, sizeof *log.run);
  log.run[1] = n;
  log.line = calloc(n, sizeof *log.line);
  log.value[LAB_CHANNEL_TIME] = calloc(n, sizeof(double));
  log.value[LAB_CHANNEL_U] = calloc(n, sizeof(double));
  log.value[LAB_CHANNEL_P] = calloc(n, sizeof(double));
  for (i = 0; i < n; i++) {
    log.line[i] = (int)i + 2;
    log.value[LAB_CHANNEL_TIME][i] = 1e-3 * (double)i;
    log.value[LAB_CHANNEL_U][i] = u_of(i);
    log.value[LAB_CHANNEL_P][i] = 3 * (double)i;
  }
  return log;
}

static double seldom(size_t i)
{
  return i < 3333 ? 0 : i < 7777 ? 1 : -1;
}

static double always(size_t i)
{
  return (double)(i % 10) / 10;
}

CASE(test_lab_log_thin__few_changes__keeps_them_and_the_row_before)
{
  lab_log log = make_log(10001, seldom);
  const double *t = log.value[LAB_CHANNEL_TIME], *u = log.value[LAB_CHANNEL_U];
  size_t i, found = 0;
  lab_log_thin(&log, 500, &limitations);
  assert_true(log.n <= 500 && log.n > 450);
  assert_int_equal(log.run[1], log.n);
  assert_close(t[0], 0, 0, 0);
  assert_close(t[log.n - 1], 10, 1e-12, 0);
  for (i = 1; i < log.n; i++) {
    assert_true(t[i] > t[i - 1]);
    assert_close(log.value[LAB_CHANNEL_P][i], 3000 * t[i], 1e-6, 0);
    assert_int_equal(log.line[i], (int)(1000 * t[i] + 0.5) + 2);
    if (u[i] == u[i - 1])
      continue;
    found++;
    assert_close(t[i] - t[i - 1], 1e-3, 1e-9, 0);
  }
  assert_int_equal(found, 2);
  assert_int_equal(limitations.n, 1);
  assert_contains(limitations.text[0], "of 10001 rows");
  lab_log_free(&log);
}

CASE(test_lab_log_thin__busy_command__is_averaged)
{
  lab_log log = make_log(10000, always);
  size_t i;
  lab_log_thin(&log, 500, &limitations);
  assert_true(log.n <= 501);
  for (i = 0; i + 1 < log.n; i++)
    assert_close(log.value[LAB_CHANNEL_U][i], 0.45, 1e-12, 0);
  assert_contains(limitations.text[0], "averaged");
  lab_log_free(&log);
}

CASE(test_lab_log_thin__short_log__stays)
{
  lab_log log = make_log(500, seldom);
  lab_log_thin(&log, 500, &limitations);
  assert_int_equal(log.n, 500);
  assert_int_equal(limitations.n, 0);
  lab_log_free(&log);
}

CASE(test_lab_log_thin__two_runs__keep_their_ends)
{
  lab_log log = make_log(10000, seldom);
  size_t *run = calloc(3, sizeof *run);
  run[1] = 6001;
  run[2] = 10000;
  free(log.run);
  log.run = run;
  log.n_runs = 2;
  lab_log_thin(&log, 500, &limitations);
  assert_close(log.value[LAB_CHANNEL_TIME][log.run[1]], 6.001, 1e-12, 0);
  assert_close(log.value[LAB_CHANNEL_TIME][log.run[1] - 1], 6, 1e-12, 0);
  assert_int_equal(log.run[2], log.n);
  lab_log_free(&log);
}

/* ---- Remarks, values ---- */

CASE(test_lab_limitation__too_many__says_so)
{
  int i;
  lab_limitation(&limitations, "first");
  lab_limitation_no_verdict(&limitations, "second %d", 2);
  for (i = 0; i < 2 * LAB_LIMITATION_MAX; i++)
    lab_limitation(&limitations, "more %d", i);
  assert_int_equal(limitations.n, LAB_LIMITATION_MAX);
  assert_int_equal(limitations.doubt, 2);
  assert_string_equal(limitations.text[1], "second 2");
  assert_contains(limitations.text[LAB_LIMITATION_MAX - 1], "more limitations");
}

CASE(test_lab_limitation__said_already__is_said_once)
{
  lab_limitation(&limitations, "short");
  lab_limitation(&limitations, "noisy");
  lab_limitation_no_verdict(&limitations, "short");
  assert_int_equal(limitations.n, 2);
  assert_int_equal(limitations.doubt, 1);
}

CASE(test_lab_limitations_join__held_out_doubt__is_only_a_remark)
{
  static lab_limitations held;
  memset(&held, 0, sizeof held);
  lab_limitation_no_verdict(&held, "held");
  lab_limitations_join(&limitations, &held);
  assert_string_equal(limitations.text[0], "held");
  assert_int_equal(limitations.doubt, 0);
}

/* ---- Hum ---- */

/* Rows of a chamber pressure of 100 kPa with noise of up to 500 Pa. */
typedef struct humming {
  double frequency, rate, amplitude; /* [Hz], [1/s], [Pa] */
  double jitter, lost;               /* of the row; of all rows */
} humming;

enum { LOGGED, LEFT };

/* Amplitude that is taken off what was logged, or off what a model leaves of it. */
static double taken_from(const humming *h, int which)
{
  enum { N = 1200 };
  static double t[N], p[N], left[N];
  static char path[] = "log.csv";
  lab_log log = {.path = path, .n = N, .n_runs = 1};
  size_t run[] = {0, N};
  uint64_t seed = 1;
  double row = 0;
  int i, lines;
  for (i = 0; i < N; i++) {
    row += fixture_random(&seed, 0, 1) < h->lost ? 2 : 1;
    t[i] = (row + fixture_random(&seed, -h->jitter, h->jitter)) / h->rate;
    p[i] = 1e5 + h->amplitude * sin(6.283185307179586 * h->frequency * t[i]) + fixture_random(&seed, -500, 500);
    left[i] = p[i] - 1e5;
  }
  log.run = run;
  log.value[LAB_CHANNEL_TIME] = t;
  log.value[LAB_CHANNEL_P] = p;
  if (which == LOGGED) {
    succeed(lab_log_remove_hum(&log, &limitations, &error));
  } else {
    succeed(lab_log_remove_hum_left(&log, 0, N, LAB_CHANNEL_P, left, &lines, &limitations, &error));
    assert_int_equal(lines > 0, log.hum[LAB_CHANNEL_P].amplitude > 0);
  }
  for (i = 0; i < N; i++) /* only noise is left of it */
    assert_between(p[i] - 1e5, -900 - h->amplitude * (log.hum[LAB_CHANNEL_P].amplitude == 0),
                   900 + h->amplitude * (log.hum[LAB_CHANNEL_P].amplitude == 0));
  return log.hum[LAB_CHANNEL_P].amplitude;
}

static double taken_off(const humming *h)
{
  return taken_from(h, LOGGED);
}

CASE(test_lab_log_remove_hum__only_the_mains__is_taken_off)
{
  assert_close(taken_off(&(humming){50, 200, 3e3, 0, 0}), 3e3, 0, 0.02);
  assert_close(taken_off(&(humming){60, 200, 3e3, 0, 0}), 3e3, 0, 0.02);
  assert_close(taken_off(&(humming){50, 64, 3e3, 0, 0}), 3e3, 0, 0.02); /* seen as 14 Hz */
  assert_close(taken_off(&(humming){43, 200, 3e3, 0, 0}), 0, 0, 0);     /* what swings otherwise may be the rig */
  assert_close(taken_off(&(humming){50, 7.2, 3e3, 0, 0}), 0, 0, 0);     /* so few rows a second: anything may be it */
}

/* Strokes are not there: a line may be slower, and rows fewer a second. */
CASE(test_lab_log_remove_hum_left__slow_line__is_taken_off)
{
  const humming slow = {50, 52, 3e3, 0, 0}, few = {50, 15.9, 3e3, 0, 0}, other = {48.5, 52, 3e3, 0, 0};
  const humming weak = {50, 24, 130, 0, 0.03}, force = {0.9, 30.3, 3e3, 0, 0.03};
  assert_close(taken_off(&slow), 0, 0, 0);
  assert_close(taken_from(&slow, LEFT), 3e3, 0, 0.02); /* seen as 2 Hz */
  assert_close(taken_off(&few), 0, 0, 0);
  assert_close(taken_from(&few, LEFT), 3e3, 0, 0.02);
  assert_close(taken_from(&weak, LEFT), 130, 0, 0.2); /* less than half the noise of a row */
  assert_close(taken_from(&other, LEFT), 0, 0, 0);
  assert_close(taken_from(&force, LEFT), 0, 0, 0); /* where 120 Hz would be seen */
}

CASE(test_lab_log_remove_hum__uneven_rows__are_as_good)
{
  assert_close(taken_off(&(humming){50, 200, 3e3, 0.3, 0.03}), 3e3, 0, 0.02);
  assert_close(taken_off(&(humming){50, 200, 250, 0.3, 0.03}), 250, 0, 0.2); /* less than the noise of a row */
  assert_close(taken_off(&(humming){50, 200, 0, 0.3, 0.03}), 0, 0, 0);
}
