/* Records of simulations and of benches, and what the figures of merit say of them. */
#include "../../scratch.h"
#include "../../virtual.h"

#include <cjson/cJSON.h>

#include "../../../apps/lab/metrics/recording.h"
#include "../../../apps/study/sets.h"

enum { ROWS = 5401 };
static const double spacing = 0.01; /* [s] */

static lab_rig rig;
static lab_log logged;
static lab_run run;
static lab_unknowns u;
static lab_metrics measured, predicted;

/* ---- Full strokes of the independent rig ---- */

static const char *write_log(void)
{
  static const double t_cmd[] = {2.004, 15.003, 28.006, 41.002}, u_cmd[] = {1, -1, 1, -1};
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_cmd, .n = 4};
  const second_rig g = virtual_rig(3);
  const char *path = scratch_path("strokes.csv");
  virtual_write(&g, &course, 54, spacing, path);
  return path;
}

/* Once for all tests. */
static int measure_strokes(void **state)
{
  if (scratch_open(state))
    return -1;
  lab_rig_default(&rig);
  rig.laws.flow = PNEU_FLOW_CHOKED;
  rig.params.dead_volume = (pneu_real)4e-5;
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  virtual_open(&rig, write_log(), &logged, &run);
  succeed(lab_unknowns_open(&rig, &run, 1, &u, &error));
  succeed(lab_metrics_compare(&u, &measured, &predicted, &error));
  return 0;
}

TESTS_WITH(measure_strokes, scratch_close)

/* What noise and sampling leave open covers the difference between the record and the model that made it. */
TEST(test_lab_recording__measured_and_predicted__agree_within_what_is_said)
{
  static const int both[] = {LAB_METRIC_DEAD_TIME_UP,   LAB_METRIC_DEAD_TIME_DOWN,   LAB_METRIC_T63_UP,
                             LAB_METRIC_T63_DOWN,       LAB_METRIC_T86_UP,           LAB_METRIC_T86_DOWN,
                             LAB_METRIC_STROKE_TIME_UP, LAB_METRIC_STROKE_TIME_DOWN, LAB_METRIC_DURATION_RATIO,
                             LAB_METRIC_ASYMMETRY,      LAB_METRIC_ENERGY_IN,        LAB_METRIC_ENERGY_OUT,
                             LAB_METRIC_ENERGY_LOST,    LAB_METRIC_ENERGY_EFFICIENCY};
  size_t i;
  for (i = 0; i < sizeof both / sizeof *both; i++) {
    const lab_metric *a = &measured.metric[both[i]], *b = &predicted.metric[both[i]];
    check_note("%s: %.100s", lab_metric_infos[both[i]].key, a->text);
    assert_close(a->value, b->value, a->uncertainty + b->uncertainty, 0);
    assert_between(a->uncertainty, 0, fmax(0.1 * a->value, 0.15));
  }
  assert_true(isnan(measured.metric[LAB_METRIC_AIR_MASS].value));
  assert_true(predicted.metric[LAB_METRIC_AIR_MASS].value > 0);
}

/* The air of a cycle is what the full chamber holds more than the empty one. */
TEST(test_lab_recording__air__what_the_chamber_takes)
{
  const double R_T = (double)rig.params.gas_constant * 298.15;
  const double empty = 101325 * 4e-5 / R_T, whole = (101325 + 4e5) * (4e-5 + 0.04 * 0.02) / R_T;
  assert_close(predicted.metric[LAB_METRIC_AIR_MASS].value, whole - empty,
               predicted.metric[LAB_METRIC_AIR_MASS].uncertainty, 2e-3);
}

TEST(test_lab_metrics_compare__model_that_fails__its_error_is_the_reason)
{
  static lab_metrics got, none;
  lab_unknowns broken = u;
  int i;
  for (i = 0; i < broken.n; i++)
    if (broken.unknown[i].kind == LAB_UNKNOWN_PARAM)
      broken.unknown[i].value = -1; /* an area */
  succeed(lab_metrics_compare(&broken, &got, &none, &error));
  assert_close(got.metric[LAB_METRIC_T63_UP].value, measured.metric[LAB_METRIC_T63_UP].value, 0, 0);
  assert_true(isnan(none.metric[LAB_METRIC_T63_UP].value));
  assert_contains(none.metric[LAB_METRIC_T63_UP].text, "area");
}

TEST(test_lab_recording__driven_position__gives_nothing)
{
  lab_rig driven = rig;
  lab_recording recording;
  driven.laws.position_input = 1;
  succeed(lab_recording_open(&driven, 1, 1, &recording, &error));
  assert_non_null(recording.record.unfit);
  lab_recording_close(&recording);
}

TEST(test_lab_recording__force_and_preload__set_the_bench_set)
{
  lab_rig loaded = rig;
  lab_recording recording;
  loaded.params.external_force = 400;
  succeed(lab_recording_open(&loaded, 1, 1, &recording, &error));
  assert_close(recording.record.signal_low, 110e3, 0, 1e-12);
  assert_close(recording.record.signal_high, 310e3, 0, 1e-12);
  lab_recording_close(&recording);
}

/* ---- Text ---- */

TEST(test_lab_metrics_json__read_back__every_figure_or_its_reason)
{
  const char *path = scratch_path("figures.json");
  FILE *file = fopen(path, "w");
  char *text;
  cJSON *root, *figure;
  int i;
  assert_non_null(file);
  succeed(lab_metrics_json(file, &measured, &error));
  fclose(file);
  text = scratch_read(path);
  root = cJSON_Parse(text);
  for (i = 0; i < LAB_METRIC_COUNT; i++) {
    check_note("%s", lab_metric_infos[i].key);
    figure = cJSON_GetObjectItem(cJSON_GetObjectItem(root, "metrics"), lab_metric_infos[i].key);
    assert_non_null(figure);
    if (isnan(measured.metric[i].value)) {
      assert_true(cJSON_IsNull(cJSON_GetObjectItem(figure, "value")));
      assert_true(strlen(cJSON_GetStringValue(cJSON_GetObjectItem(figure, "reason"))) > 10);
    } else {
      assert_close(cJSON_GetObjectItem(figure, "value")->valuedouble, measured.metric[i].value, 0, 5e-9);
      assert_string_equal(cJSON_GetStringValue(cJSON_GetObjectItem(figure, "standard")), lab_metric_infos[i].standard);
    }
  }
  assert_int_equal(cJSON_GetArraySize(cJSON_GetObjectItem(root, "steps")), measured.n_steps);
  cJSON_Delete(root);
  free(text);
}

TEST(test_lab_metrics_print__one_line_a_figure_and_a_step)
{
  const char *path = scratch_path("figures.txt");
  FILE *file = fopen(path, "w");
  char *text;
  int i, lines = 0;
  assert_non_null(file);
  lab_metrics_print(file, &measured);
  fclose(file);
  text = scratch_read(path);
  for (i = 0; text[i]; i++)
    lines += text[i] == '\n';
  assert_int_equal(lines, 3 + LAB_METRIC_COUNT + 2 + measured.n_steps);
  assert_contains(text, "chamber pressure");
  free(text);
}

/* ---- Measurements of others ---- */

/* A step of the DAMADICS servomotor, drawn in tenths of the travel; the command is taken to step at t = 0. */
static int read_step(const char *name, double u_after, lab_metrics *out)
{
  static const char text[] = "actuator = { stroke = \"10 mm\"; };\n"
                             "log = { columns = ( \"t [ms]\", \"x [mm]\" ); skip_lines = 1; };\n";
  enum { BEFORE = 20, ROOM = 200 };
  double command[ROOM], t[ROOM], x[ROOM];
  char path[1024];
  lab_response response = {0};
  lab_rig servo;
  lab_log log;
  lab_recording recording;
  size_t i;
  snprintf(path, sizeof path, "%s/damadics-servomotor-static-step/%s", sets_data_folder(), name);
  if (access(path, R_OK)) {
    fprintf(stderr, "absent: %s; study/measured/fetch.sh loads what can be had, MEASURED names its folder\n", path);
    return 0;
  }
  succeed(lab_rig_read(scratch_text("servo.cfg", text), &servo, &error));
  succeed(lab_log_read(path, &servo.log, 101325, &log, &error));
  for (i = 0; i < BEFORE + log.n; i++) {
    command[i] = i < BEFORE ? -u_after : u_after;
    t[i] = i < BEFORE ? 0.1 * ((double)i - BEFORE) : log.value[LAB_CHANNEL_TIME][i - BEFORE];
    x[i] = log.value[LAB_CHANNEL_X][i < BEFORE ? 0 : i - BEFORE];
  }
  response.n = BEFORE + log.n;
  response.t = t;
  response.u = command;
  response.x = x;
  succeed(lab_recording_open(&servo, response.n, 1, &recording, &error));
  lab_recording_add_response(&recording, &response);
  recording.record.noise_x = 6e-5; /* 0.06 units: resolution of the drawing */
  succeed(lab_metrics_measure(&recording.record, out, &error));
  lab_recording_close(&recording);
  lab_log_free(&log);
  return 1;
}

TEST(test_metrics__damadics_steps__by_what_was_drawn)
{
  lab_metrics up, down;
  if (!read_step("step_up_fig6.csv", 1, &up) || !read_step("step_down_fig7.csv", -1, &down))
    return;
  assert_int_equal(up.step[0].fate, LAB_STEP_NOT_SETTLED); /* the figure ends before the stem does */
  check_note("step down");
  assert_close(down.metric[LAB_METRIC_T63_DOWN].value, 1.53, 0.01, 0); /* between its points, by hand */
  assert_close(down.metric[LAB_METRIC_T86_DOWN].value, 2.87, 0.02, 0);
  assert_between(down.metric[LAB_METRIC_T63_DOWN].uncertainty, 0.1, 0.4);
}
