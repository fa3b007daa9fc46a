/* closeloop as a process on bad logs: a clear error or a stated limitation, never a confident wrong name.
 * Run from the project's root, where the program is. */
#include "../badlog.h"
#include "../fixture.h"
#include "../program.h"

#include <sys/wait.h>

#include <cjson/cJSON.h>

static const char *const header = "t [s],u [1],p [kPa],x [mm]";
static bad_log sound;

static int open_all(void **state)
{
  sound = bad_log_of(0);
  return scratch_open(state);
}

TESTS_WITH(open_all, scratch_close)

/* Run closeloop with DIR "out" in the scratch folder, with time for slow machines and sanitizers.
 * Out:     text  its messages on both streams, to be freed
 * Returns: exit status */
static int run(const char *rig, const char *log, char **text)
{
  char command[2048];
  int status;
  snprintf(command, sizeof command, PROGRAMS "/closeloop '%s' '%s' --budget 600 --out '%s/out' >'%s/said.txt' 2>&1",
           rig, log, scratch_folder, scratch_folder);
  scratch_remove(scratch_path("out"));
  status = system(command);
  assert_true(WIFEXITED(status));
  *text = scratch_read(scratch_path("said.txt"));
  return WEXITSTATUS(status);
}

/* The log is refused with LAB_DATA and these words, and nothing is written. */
static void assert_refused_by(const char *rig, const char *log, const char *place, const char *words)
{
  char *text;
  check_note("%s", words);
  assert_int_equal(run(rig, log, &text), 1);
  assert_contains(text, place);
  assert_contains(text, words);
  assert_false(scratch_exists(scratch_path("out/report.json")));
  free(text);
}

static void assert_refused(const char *log, const char *place, const char *words)
{
  assert_refused_by(bad_rig("rig.cfg", ""), log, place, words);
}

static void assert_spoiled_is_refused(const bad_log *b, const char *place, const char *words)
{
  assert_refused(bad_write("bad.csv", header, b), place, words);
}

/* The report of a run that must succeed, to be freed. */
static char *report_of(const char *rig, const char *log)
{
  char *text;
  if (run(rig, log, &text))
    fail_msg("%s", text);
  free(text);
  return scratch_read(scratch_path("out/report.json"));
}

/* The run ends with this verdict and a limitation with these words.  Returns: things found, or the best candidate */
static int found_of_limited(const char *rig, const bad_log *b, const char *verdict, const char *words)
{
  char *report, all[4096] = "";
  const cJSON *item;
  cJSON *json;
  int found;
  check_note("%s", words);
  report = report_of(rig, bad_write("bad.csv", header, b));
  json = cJSON_Parse(report);
  assert_non_null(json);
  assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(json, "verdict")), verdict);
  cJSON_ArrayForEach(item, cJSON_GetObjectItem(json, "limitations"))
  {
    strncat(all, cJSON_GetStringValue(item), sizeof all - strlen(all) - 2);
    strcat(all, "\n");
  }
  assert_contains(all, words);
  found = cJSON_GetArraySize(cJSON_GetObjectItem(json, "found"));
  cJSON_Delete(json);
  free(report);
  return found;
}

static void assert_limited(const char *rig, const bad_log *b, const char *verdict, const char *words)
{
  const int found = found_of_limited(rig, b, verdict, words);
  if (!strcmp(verdict, "undecided"))
    assert_int_equal(found, 0);
}

TEST(test_closeloop__of_this_build__is_sanitized_as_its_test)
{
  assert_sanitized_as_its_test(PROGRAMS "/closeloop");
}

/* ---- The sound log ---- */

TEST(test_closeloop__sound_log__has_no_limitation)
{
  char *report = report_of(bad_rig("rig.cfg", ""), bad_write("good.csv", header, &sound));
  assert_contains(report, "\"verdict\":\t\"none\"");
  assert_contains(report, "\"limitations\":\t[]");
  free(report);
}

/* ---- Bytes ---- */

TEST(test_closeloop__garbage__is_refused)
{
  unsigned char bytes[8192];
  uint64_t seed = 3;
  size_t i;
  for (i = 0; i < sizeof bytes; i++)
    bytes[i] = (unsigned char)fixture_random(&seed, 0, 256);
  assert_refused(scratch_bytes("bad.csv", bytes, sizeof bytes), "bad.csv", "found a 0 byte");
  for (i = 0; i < sizeof bytes; i++)
    bytes[i] |= 1;
  assert_refused(scratch_bytes("bad.csv", bytes, sizeof bytes), "bad.csv:1", "expected");
}

/* ---- Rows ---- */

TEST(test_closeloop__last_value_cut_short__is_left_out)
{
  bad_log b = sound;
  b.n = 300;    /* in the middle of a hold at high pressure */
  b.p[299] = 3; /* of 3.. hundred kPa */
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "the last value");
}

/* ---- Time ---- */

static void swap(double *a, double *b)
{
  const double keep = *a;
  *a = *b;
  *b = keep;
}

TEST(test_closeloop__times_out_of_order__name_the_line)
{
  bad_log b = sound;
  swap(&b.t[500], &b.t[700]);
  assert_spoiled_is_refused(&b, "bad.csv:503", "channel t: expected more than");
  b = sound;
  b.t[500] = (double)NAN;
  assert_spoiled_is_refused(&b, "bad.csv:502", "channel t: expected a number, found a gap");
  for (b.n = 0; b.n < BAD_ROWS; b.n++)
    b.t[b.n] = 1;
  assert_spoiled_is_refused(&b, "bad.csv:3", "channel t: expected more than");
}

/* As a clock that goes in steps has it. One that stands is refused, as above. */
TEST(test_closeloop__row_of_the_time_before__is_spread_and_counted)
{
  bad_log b = sound;
  b.t[500] = b.t[499];
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "spread over the step of the clock: 1;");
}

/* A row whose time is that of the row before is left out where the rig file asks for it, and counted. */
TEST(test_closeloop__damaged_rows__are_left_out_and_counted)
{
  bad_log b = sound;
  b.t[500] = b.t[499];
  b.t[600] = (double)NAN;
  assert_limited(bad_rig("rig.cfg", "log = { damaged = \"drop\"; };\n"), &b, "none", "2 damaged rows of ");
}

TEST(test_closeloop__shuffled_rows__are_refused)
{
  bad_log b = sound;
  uint64_t seed = 5;
  size_t i;
  for (i = b.n - 1; i > 0; i--) {
    const size_t k = (size_t)fixture_random(&seed, 0, (double)(i + 1));
    swap(&b.t[i], &b.t[k]);
    swap(&b.u[i], &b.u[k]);
    swap(&b.p[i], &b.p[k]);
    swap(&b.x[i], &b.x[k]);
  }
  assert_spoiled_is_refused(&b, "bad.csv:", "channel t: expected more than");
}

/* Times renumbered over rows in disorder: nothing is left for the reader to see. */
TEST(test_closeloop__shuffled_values__do_not_match_the_command)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++) {
    b.p[i] = sound.p[(i * 389) % b.n];
    b.x[i] = sound.x[(i * 389) % b.n];
  }
  {
    char *text;
    const int status = run(bad_rig("rig.cfg", ""), bad_write("bad.csv", header, &b), &text);
    assert_true(status == 1 || strstr(text, "Undecided"));
    free(text);
  }
}

TEST(test_closeloop__jump_in_time__is_a_limitation)
{
  bad_log b = sound;
  size_t i;
  for (i = 20; i < b.n; i++) /* before the first command */
    b.t[i] += 60;
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "no rows from t = 0.19 s to t = 60.2 s");
}

/* ---- Units ---- */

TEST(test_closeloop__units_that_disagree__are_refused)
{
  static const struct slip {
    const char *header, *words;
  } slips[] = {
      {"t [s],u [1],p [bar],x [mm]", "bar and kPa mixed up"},
      {"t [s],u [1],p [psi],x [mm]", "psi and kPa mixed up"},
      {"t [s],u [1],p [Pa],x [mm]", "Pa, kPa and MPa mixed up"},
      {"t [s],u [1],p_abs [kPa],x [mm]", "gauge pressure in a column p_abs"},
      {"t [s],u [1],p [kPa],x [m]", "m, mm and um mixed up"},
      {"t [s],u [1],p [kPa],x [cm]", "mm and cm mixed up"},
      {"t [s],u [1],p [kPa],x [um]", "m, mm and um mixed up"},
      {"t [min],u [1],p [kPa],x [mm]", "slower"},
      {"t [ms],u [1],p [kPa],x [mm]", "faster"},
  };
  size_t i;
  for (i = 0; i < sizeof slips / sizeof slips[0]; i++)
    assert_refused(bad_write("bad.csv", slips[i].header, &sound), "bad.csv", slips[i].words);
}

/* A channel that is not what its column says: a straight line of what it ought to be. */
TEST(test_closeloop__channel_scaled_turned_or_dead__is_refused)
{
  enum { U = offsetof(bad_log, u), P = offsetof(bad_log, p), X = offsetof(bad_log, x) };
  static const struct {
    int channel;
    double scale, offset;
    const char *header, *place, *words;
  } slips[] = {
      {P, 0.01, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv", "bar and kPa mixed up"},
      {X, 0.1, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv", "mm and cm mixed up"},
      {U, 100, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv:43", "is its unit %"},
      {P, 0, 12.5, "t [s],u [1],p [kPa],x [mm]", "bad.csv", "channel p stays constant"},
      {X, 0, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv", "channel x stays constant"},
      {X, -1, 20, "t [s],u [1],p [kPa],x [mm]", "bad.csv", "x falls as p rises"},
      {U, -1, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv:", "is its sign turned"},
      {U, -1, 0, "t [s],u [1],-,x [mm]", "bad.csv:", "is its sign turned"},
      {U, 0, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv:", "u never changes"},
      {X, 2.5, 0, "t [s],u [1],p [kPa],x [mm]", "bad.csv:", "whether the log is of this rig"},
  };
  size_t i, k;
  for (k = 0; k < sizeof slips / sizeof slips[0]; k++) {
    bad_log b = sound;
    double *value = (double *)((char *)&b + slips[k].channel);
    for (i = 0; i < b.n; i++)
      value[i] = slips[k].scale * value[i] + slips[k].offset;
    assert_refused(bad_write("bad.csv", slips[k].header, &b), slips[k].place, slips[k].words);
  }
}

TEST(test_closeloop__absolute_called_gauge__is_undecided)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.p[i] = sound.p[i] + 101.325;
  assert_limited(bad_rig("rig.cfg", ""), &b, "undecided", "the column is p_abs");
}

/* ---- Sensors ---- */

/* A clipped pressure stands still under an open orifice, as one does that leaks: it must not be called a leak. */
TEST(test_closeloop__saturated_pressure__is_left_out_and_said)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.p[i] = fmin(sound.p[i], 180);
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "stands at exactly 180 kPa, its largest value");
}

TEST(test_closeloop__saturated_position__is_left_out_and_said)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.x[i] = fmin(sound.x[i], 9);
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "stands at exactly 9 mm, its largest value");
}

/* Noise of a pressure that drives the model does not drive the stem: friction and spring come out as they are. */
TEST(test_closeloop__pressure_as_input__shows_friction_and_spring)
{
  const char *rig = scratch_text(
      "driven.cfg", "actuator = { area = \"400 cm^2\"; dead_volume = \"40 cm^3\"; stroke = \"20 mm\";\n"
                    "  spring_rate = \"500 kN/m\"; spring_preload = \"10 mm\"; moving_mass = \"2 kg\";\n"
                    "  dry_friction = \"160 N\"; viscous_friction = \"500 N.s/m\"; damping = \"1000 N.s/m\"; };\n"
                    "supply = { pressure = \"400 kPa\"; temperature = \"298.15 K\"; };\n"
                    "ambient = { pressure = \"101.325 kPa\"; temperature = \"298.15 K\"; };\n"
                    "inputs = [\"p\"];\n"
                    "noise = { pressure = \"0.32 kPa\"; position = \"0.02 mm\"; };\n");
  char *report;
  assert_limited(rig, &sound, "none", "channel p drives the model, without its noise of 0.3");
  report = scratch_read(scratch_path("out/report.json"));
  assert_contains(report, "Friction is 3 times its sheet, the spring 20 % soft; nothing else is missing");
  free(report);
}

TEST(test_closeloop__spikes__are_left_out_and_said)
{
  bad_log b = sound;
  size_t i;
  for (i = 57; i < b.n; i += 131)
    b.p[i] += 150;
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "8 values of channel p are far from both neighbours");
}

TEST(test_closeloop__values_that_stand_alone__are_left_out_and_said)
{
  bad_log b = sound;
  size_t i;
  for (i = 57; i < b.n; i += 131)
    b.p[i] += 4;
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "8 values of channel p are isolated");
}

/* Beside a change of the command, where a table of the sensor's error, a flow or a gain would explain it. */
TEST(test_closeloop__one_bad_value__brings_no_name)
{
  static const size_t row[] = {43, 44, 45};
  size_t i;
  for (i = 0; i < sizeof row / sizeof *row; i++) {
    bad_log b = sound;
    b.p[row[i]] += 7;
    assert_limited(bad_rig("rig.cfg", ""), &b, "none", "1 value of channel p is isolated");
  }
}

/* Nothing is left out, and nothing decided; there may be a best candidate. */
static void assert_undecided_with_all(const bad_log *b)
{
  char *report;
  found_of_limited(bad_rig("rig.cfg", ""), b, "undecided", "More than noise is left");
  report = scratch_read(scratch_path("out/report.json"));
  assert_null(strstr(report, "isolated"));
  free(report);
}

/* What comes back with every command is no accident. */
TEST(test_closeloop__bad_values_after_each_command__stay)
{
  static const size_t row[] = {44, 254, 404, 554, 724};
  bad_log b = sound;
  size_t i;
  for (i = 0; i < sizeof row / sizeof *row; i++)
    b.p[row[i]] += 7;
  assert_undecided_with_all(&b);
}

/* Where more than single values is beyond the model, what lasts a row may be real, too. */
TEST(test_closeloop__values_that_stand_alone_in_bursts_of_noise__stay)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.p[i] += (i / 50) % 4 == 0 ? (i * 7919 % 13 < 6 ? 1.5 : -1.5) : 0;
  for (i = 57; i < b.n; i += 131)
    b.p[i] += 5;
  assert_undecided_with_all(&b);
}

TEST(test_closeloop__coarse_steps__are_a_limitation)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.p[i] = 4 * floor(sound.p[i] / 4 + 0.5);
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "p is recorded in steps of 4 kPa");
}

/* ---- Too little ---- */

TEST(test_closeloop__too_few_rows__is_refused)
{
  bad_log b = sound;
  b.n = 2;
  assert_spoiled_is_refused(&b, "", "too short");
}

TEST(test_closeloop__short_log__is_undecided)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < 13; i++) { /* the first stroke, every 0.1 s */
    b.t[i] = sound.t[35 + 10 * i];
    b.u[i] = sound.u[35 + 10 * i];
    b.p[i] = sound.p[35 + 10 * i];
    b.x[i] = sound.x[35 + 10 * i];
  }
  b.n = 13;
  assert_limited(bad_rig("rig.cfg", ""), &b, "undecided", "too few to name an effect");
}

TEST(test_closeloop__still_log__is_refused)
{
  bad_log b = sound;
  b.n = 40; /* before the first command */
  assert_spoiled_is_refused(&b, "", "nothing moves");
}

TEST(test_closeloop__part_of_a_stroke__is_a_limitation)
{
  bad_log b = sound;
  while (b.n > 0 && b.x[b.n - 1] > 0.2 * 20)
    b.n--;
  for (b.n = 0; b.x[b.n] < 0.2 * 20; b.n++)
    ;
  assert_limited(bad_rig("rig.cfg", ""), &b, "none", "of a stroke of 20 mm");
}

/* ---- Too much ---- */

TEST(test_closeloop__measured_supply_that_is_no_input__is_said)
{
  const char *path = scratch_path("supply.csv");
  FILE *file = fopen(path, "w");
  char *report;
  size_t i;
  assert_non_null(file);
  fprintf(file, "%s,ps [kPa]\n", header);
  for (i = 0; i < sound.n; i++)
    fprintf(file, "%.3f,%g,%.7g,%.7g,%.7g\n", sound.t[i], sound.u[i], sound.p[i], sound.x[i],
            400 + 5 * sin(sound.t[i]));
  assert_int_equal(fclose(file), 0);
  report = report_of(bad_rig("rig.cfg", ""), path);
  assert_contains(report, "ps was measured and varies by 9.");
  assert_contains(report, "inputs = ( \\\"ps\\\" )");
  free(report);
}

TEST(test_closeloop__many_rows__are_thinned_and_said)
{
  enum { MANY = 50001 };
  static double t[MANY], u[MANY], p[MANY], x[MANY];
  const second_log log = {.t = t, .u = u, .p = p, .x = x};
  const char *path = scratch_path("many.csv");
  char *report;
  FILE *file;
  int i;
  bad_run(0, 10.0 / (MANY - 1), &log);
  file = fopen(path, "w");
  assert_non_null(file);
  fprintf(file, "t [s],u [1],p [Pa],x [m]\n");
  for (i = 0; i < MANY; i++)
    fprintf(file, "%.6f,%g,%.0f,%.7f\n", t[i], u[i], p[i], x[i]);
  assert_int_equal(fclose(file), 0);
  report = report_of(bad_rig("rig.cfg", ""), path);
  assert_contains(report, "\"verdict\":\t\"none\"");
  assert_contains(report, "16675 of 50001 rows are used, one in 3 and");
  free(report);
}

/* ---- Commands ---- */

TEST(test_closeloop__command_of_another_test__is_refused)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.u[i] = sound.u[b.n - 1 - i];
  assert_spoiled_is_refused(&b, "bad.csv", "the command does not match");
}

/* Rows of u moved by some seconds, either way. */
static bad_log shifted(int rows)
{
  bad_log b = sound;
  int i;
  for (i = 0; i < (int)b.n; i++)
    b.u[i] = i - rows < 0 ? 0 : sound.u[i - rows < (int)b.n ? i - rows : (int)b.n - 1];
  return b;
}

TEST(test_closeloop__command_recorded_too_late__is_refused)
{
  bad_log b;
  b = shifted(60);
  assert_spoiled_is_refused(&b, "bad.csv", "the command does not match");
  b = shifted(200);
  assert_spoiled_is_refused(&b, "bad.csv", "the command does not match");
}

TEST(test_closeloop__one_stroke_before_its_command__is_refused)
{
  bad_log b = shifted(30);
  b.n = 350;
  assert_spoiled_is_refused(&b, "bad.csv", "before u says so");
}

/* The same changes at other instants, some before and some after those of the test. */
TEST(test_closeloop__commands_at_other_instants__are_refused)
{
  static const double at[] = {0.402, 2.1, 4.4, 5.1, 7.6}, to[] = {1, 0, -1, 0.5, -0.5};
  bad_log b = sound;
  size_t i;
  int k;
  for (i = 0; i < b.n; i++)
    for (k = 0; k < 5; k++)
      if (b.t[i] >= at[k])
        b.u[i] = to[k];
  assert_spoiled_is_refused(&b, "bad.csv:", "p moves against it or before it");
}

TEST(test_closeloop__quick_commands_of_another_test__are_refused)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.u[i] = i / 5 % 2 ? 1 : -0.8;
  assert_spoiled_is_refused(&b, "bad.csv", "is not what the declared model makes of u");
}

TEST(test_closeloop__command_seconds_too_early__is_no_dead_time)
{
  bad_log b = sound;
  size_t i, k;
  for (i = 0; i < b.n; i++) { /* the measured channels 1.6 s late, after a longer rest */
    k = i < 160 ? i % 35 : i - 160;
    b.p[i] = sound.p[k];
    b.x[i] = sound.x[k];
  }
  assert_limited(bad_rig("rig.cfg", ""), &b, "undecided", "different clocks");
}

TEST(test_closeloop__command_from_0_to_1__is_undecided)
{
  bad_log b = sound;
  size_t i;
  for (i = 0; i < b.n; i++)
    b.u[i] = fmax(sound.u[i], 0);
  assert_limited(bad_rig("rig.cfg", ""), &b, "undecided", "u is never negative");
}

/* ---- Another rig ---- */

TEST(test_closeloop__supply_in_another_unit__is_refused)
{
  char *text = scratch_read(bad_rig("rig.cfg", "")), *pressure = strstr(text, "\"400 kPa\"");
  memcpy(pressure, "4.0      ", 9);
  assert_refused_by(scratch_text("bar.cfg", text), bad_write("bad.csv", "t [s],u [1],-,x [mm]", &sound),
                    "bad.csv:", "did you mean \"4 bar\"?");
  free(text);
}

TEST(test_closeloop__bad_holdout__is_refused_before_any_fit)
{
  char command[2048], *text;
  bad_log b = sound;
  size_t i;
  int status;
  for (i = 0; i < b.n; i++)
    b.u[i] = -sound.u[i];
  snprintf(command, sizeof command, PROGRAMS "/closeloop '%s' '%s' --holdout '%s' --out '%s/out' >'%s/said.txt' 2>&1",
           bad_rig("rig.cfg", ""), bad_write("good.csv", header, &sound), bad_write("held.csv", header, &b),
           scratch_folder, scratch_folder);
  status = system(command);
  assert_int_equal(WEXITSTATUS(status), 1);
  text = scratch_read(scratch_path("said.txt"));
  assert_contains(text, "held.csv:");
  assert_contains(text, "is its sign turned");
  free(text);
}
