/* From two logs of the independent rig to what has changed between them. */
#include "../../scratch.h"
#include "../../blind/logs.h"
#include "../../virtual.h"

#include "../../../apps/lab/change/change.h"

enum { ROWS = 1001, COMMANDS = 5 };
static const double spacing = 0.01; /* [s] */
static const double t_cmd[COMMANDS] = {0.402, 2.503, 4.001, 5.507, 7.204};
static const double u_cmd[2][COMMANDS] = {{1, 0, -1, 0.5, -0.5}, {0.8, 0, -1, 1, -0.7}};
static lab_rig rig;
static lab_changes changes; /* of the comparison that was made last */
static lab_suspect suspect[2];
static int n_suspects;
static int undecided; /* not 0: the model does not explain the baseline */

static void write_log(const second_rig *g, const double *u_of, const char *path)
{
  const second_course course = {.t_cmd = t_cmd, .u_cmd = u_of, .n = COMMANDS};
  virtual_write(g, &course, 10, spacing, path);
}

static void declare(void)
{
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_rate;
  rig.fit[rig.n_fit++] = PNEU_PARAM_spring_preload;
}

/* Compare logs of a rig whose model is fitted to the first one and needs nothing more. */
static void compare_logs(const char *const path[2])
{
  static lab_unknowns u;
  static lab_log log[2];
  static lab_run run[2];
  int i;
  for (i = 0; i < 2; i++)
    virtual_open(&rig, path[i], &log[i], &run[i]);
  succeed(lab_unknowns_open(&rig, run, 1, &u, &error));
  succeed(lab_unknowns_fit(&u, LAB_ROUNDS_ALL, NULL, &error));
  succeed(lab_changes_find(&(lab_comparison){&u, !undecided, run + 1, 1, suspect, n_suspects, 0.01}, &changes, &error));
}

static void compare_files(const char *rig_name, const char *then, const char *now)
{
  const char *const path[2] = {scratch_path(then), scratch_path(now)};
  succeed(lab_rig_read(scratch_path(rig_name), &rig, &error));
  compare_logs(path);
}

/* Compare logs of two rigs, as they are declared. */
static void compare_declared(const second_rig *then, const second_rig *now)
{
  const char *const path[2] = {scratch_path("then.csv"), scratch_path("now.csv")};
  write_log(then, u_cmd[0], path[0]);
  write_log(now, u_cmd[1], path[1]);
  compare_logs(path);
}

static void compare(const second_rig *now)
{
  const second_rig then = virtual_rig(7);
  declare();
  compare_declared(&then, now);
}

/* One change of that name, whose interval holds the value now. */
static void assert_change(const char *what, double now)
{
  char name[LAB_PARAM_NAME_TEXT];
  assert_int_equal(changes.condition, LAB_SINCE_CHANGED);
  assert_int_equal(changes.n, 1);
  assert_string_equal(lab_change_name(changes.change[0].param, name), what);
  assert_between(now, changes.change[0].low, changes.change[0].high);
  assert_between(changes.change[0].p_value, 0, 1e-6);
}

TEST(test_lab_changes_find__another_day__is_unchanged)
{
  second_rig now = virtual_rig(8);
  now.supply *= 1.02;
  now.ambient -= 1200;
  now.ambient_temperature += 6;
  now.supply_temperature += 6;
  now.pressure_bias = 800;
  now.position_bias = 5e-5;
  compare(&now);
  assert_int_equal(changes.condition, LAB_SINCE_UNCHANGED);
  assert_int_equal(changes.n, 0);
  assert_close(changes.now, 1, 0.05, 0);
}

static void write_blind(const blind_trial *trial, const second_rig *g, const blind_schedule *schedule, const char *name)
{
  blind_rows rows;
  succeed(blind_simulate(g, schedule, trial->spacing, &rows, &error));
  succeed(blind_write_rows(&rows, trial->channels, scratch_folder, name, &error));
  blind_rows_free(&rows);
}

/* What a day has done to a rig of the blind trials. */
typedef struct day {
  int trial;
  double supply, ambient, temperature, pressure_bias, position_bias, friction; /* factors, and SI that is added */
} day;

/* What it does to supply, air and gains cancels but for a hundredth of each. A fit that loses its way there calls it a
 * gain of the pressure sensor, a film or a back pressure. Such valleys need long logs. */
TEST(test_lab_changes_find__another_day_of_a_blind_rig__is_unchanged)
{
  static const day days[] = {{5, 0.9824069, 206.9, 0.21, 23.8, -9.617e-5, 0.98732},
                             {29, 1.008735, 320.98, -4.1962, 630.97, -9.4745e-05, 1.037990}};
  static blind_trial trial;
  size_t i;
  for (i = 0; i < sizeof days / sizeof *days; i++) {
    const day *d = &days[i];
    second_rig then, now;
    blind_draw(424242, d->trial, &trial);
    trial.channels = BLIND_P | BLIND_X;
    trial.tells_noise = 1;
    then = now = blind_truth(&trial, 0);
    now.seed += 77;
    now.supply *= d->supply;
    now.ambient += d->ambient;
    now.ambient_temperature += d->temperature;
    now.supply_temperature += d->temperature;
    now.pressure_bias = d->pressure_bias;
    now.position_bias = d->position_bias;
    now.dry_friction *= d->friction;
    succeed(blind_write_rig(&trial, scratch_folder, &error));
    write_blind(&trial, &then, &trial.holdout, "then.csv");
    write_blind(&trial, &now, &trial.fit, "now.csv");
    compare_files("rig.cfg", "then.csv", "now.csv");
    assert_int_equal(changes.n, 0);
    assert_int_equal(changes.condition, LAB_SINCE_UNCHANGED);
  }
}

/* The zero of a sensor that each log has for itself is another every day. */
TEST(test_lab_changes_find__zero_of_each_log__is_no_change)
{
  const int zero = pneu_param_find("position_bias.position_bias");
  second_rig then = virtual_rig(7), now = virtual_rig(8);
  if (zero < 0)
    skip();
  then.position_bias = 3e-4;
  now.position_bias = 15e-4;
  declare();
  rig.fit[rig.n_fit] = zero;
  rig.fit_per_log[rig.n_fit++] = 1;
  rig.tolerance[zero] = 3e-4;
  compare_declared(&then, &now);
  assert_int_equal(changes.condition, LAB_SINCE_UNCHANGED);
  assert_int_equal(changes.n, 0);
}

/* A zero that has moved by 2.5 % of the stroke is none of another day. */
TEST(test_lab_changes_find__zero_beyond_another_day__is_the_change)
{
  second_rig now = virtual_rig(8);
  now.position_bias = 0.025 * now.stroke;
  compare(&now);
  assert_change("position_bias", now.position_bias);
}

/* A vent that passes less has one name, whose other is not told beside it. */
TEST(test_lab_changes_find__vent__is_told_by_its_effect)
{
  const second_rig then = virtual_rig(7);
  second_rig now = virtual_rig(8);
  int k;
  if (pneu_effect_find("vent_restriction") < 0)
    skip();
  now.vent_area *= 0.55;
  virtual_declare(&rig);
  rig.fit[rig.n_fit++] = PNEU_PARAM_dry_friction;
  compare_declared(&then, &now);
  assert_change("vent_restriction", 0.45);
  for (k = 0; k < changes.change[0].n_alike; k++)
    assert_true(changes.change[0].alike[k] != PNEU_PARAM_vent_area);
}

/* Values that may differ from day to day can take up all that a change leaves, beyond what a day does. */
TEST(test_lab_changes_find__friction_beyond_another_day__is_no_matter_of_an_unexplained_baseline)
{
  second_rig now = virtual_rig(8);
  now.dry_friction *= 1.5;
  undecided = 1;
  compare(&now);
  undecided = 0;
  assert_change("dry_friction", now.dry_friction);
}

TEST(test_lab_changes_find__leak__is_the_change)
{
  second_rig now = virtual_rig(8);
  now.leak_area = 1.5e-8;
  compare(&now);
  assert_change("chamber_leak", 1.5e-8);
  assert_close(changes.change[0].then, 0, 1e-15, 0);
}

/* What explains the new log is taken with what the search could not tell from it; what does not is left. */
TEST(test_lab_changes_find__suspect__is_taken_only_if_it_explains)
{
  static const struct {
    const char *param;
    double size;
    int n_alike;
  } cases[] = {{"leak_area", 3e-9, 1}, {"dry_friction", 100, 0}};
  const lab_found found = {.n_alike = 1, .alike = {pneu_effect_find("porous_leak")}};
  size_t i;
  second_rig now = virtual_rig(8);
  if (found.alike[0] < 0 || pneu_param_find("leak_area") < 0)
    skip();
  now.leak_area = 4e-9;
  n_suspects = 1;
  for (i = 0; i < 2; i++) {
    suspect[0] = (lab_suspect){.score = {.param = pneu_param_find(cases[i].param), .shape = -1, .size = cases[i].size}};
    suspect[0].found = cases[i].n_alike ? &found : NULL;
    compare(&now);
    assert_change("chamber_leak", 4e-9);
    if (cases[i].n_alike)
      assert_int_equal(pneu_effect_of(changes.change[0].alike[0]), found.alike[0]);
  }
  n_suspects = 0;
}

/* What was asked before leaves nothing behind. */
TEST(test_lab_changes_find__suspect_after_one_with_an_onset__acts_throughout)
{
  second_rig now = virtual_rig(8);
  now.leak_area = 1.5e-8;
  suspect[0] = (lab_suspect){.score = {.param = PNEU_PARAM_dry_friction, .shape = -1, .size = 100, .onset = 500}};
  suspect[1] = (lab_suspect){.score = {.param = pneu_param_find("leak_area"), .shape = -1, .size = 1.4e-8}};
  n_suspects = 2;
  compare(&now);
  n_suspects = 0;
  assert_change("chamber_leak", 1.5e-8);
  assert_int_equal(changes.change[0].begin.known, 0);
}

/* Chi-square falls by 33 for it: beyond chance (p = 8e-9), but no more than a model not quite the rig's leaves. */
TEST(test_lab_changes_find__leak_that_hardly_shows__is_no_change)
{
  second_rig now = virtual_rig(8);
  now.leak_area = 1.6e-9;
  compare(&now);
  assert_int_equal(changes.condition, LAB_SINCE_UNCHANGED);
}

TEST(test_lab_changes_find__more_friction__is_the_change)
{
  second_rig now = virtual_rig(8);
  now.supply *= 0.99;
  now.dry_friction *= 1.5;
  compare(&now);
  assert_change("dry_friction", 720);
  assert_close(changes.change[0].then, 480, 0, 0.02);
}

/* What the orifices pass goes with the sizes of chamber and spring. Where nothing is known of these it is uncertain by
 * the same share then and now, 42 %, so that the interval shrinks with the orifices; as wide as then it would be 70 %.
 */
TEST(test_lab_changes_find__smaller_orifices_of_a_rig_without_sizes__are_uncertain_by_a_share)
{
  second_rig then = virtual_rig(7), now = virtual_rig(8);
  now.fill_area *= 0.6;
  now.vent_area *= 0.6;
  declare();
  rig.fit[rig.n_fit++] = PNEU_PARAM_area;
  rig.fit[rig.n_fit++] = PNEU_PARAM_dead_volume;
  compare_declared(&then, &now);
  assert_int_equal(changes.n, 1);
  assert_int_equal(changes.change[0].param, LAB_PARAM_ORIFICE_AREA);
  assert_close(changes.change[0].now / changes.change[0].then, 0.6, 0, 0.02);
  assert_between((changes.change[0].high - changes.change[0].low) / 2 / changes.change[0].now, 0.2, 0.5);
}

TEST(test_lab_changes_find__softer_spring__is_the_change)
{
  second_rig now = virtual_rig(8);
  now.spring_rate *= 0.9;
  compare(&now);
  assert_change("spring_rate", 3.6e5);
}

/* The log of a run in which something is done to the rig. */
static void write_course(const second_rig *g, const second_course *course, double t_end, double dt, const char *path)
{
  static double t[ROWS], u[ROWS], p[ROWS], x[ROWS];
  const second_log log = {.t = t, .u = u, .p = p, .x = x};
  const size_t n = second_samples(t_end, dt);
  FILE *file = fopen(path, "w");
  size_t i;
  assert_true(n <= ROWS);
  assert_non_null(file);
  assert_int_equal(second_follow(g, course, t_end, dt, &log, NULL), 0);
  fputs(course->positioner ? "t [s],sp [1],x [m]\n" : "t [s],u [1],p [Pa],x [m]\n", file);
  for (i = 0; i < n && course->positioner; i++)
    fprintf(file, "%.3f,%.5g,%.7f\n", t[i], u[i], x[i]);
  for (i = 0; i < n && !course->positioner; i++)
    fprintf(file, "%.3f,%g,%.1f,%.7f\n", t[i], u[i], p[i], x[i]);
  fclose(file);
}

/* Compare with a log in which the rig is another one from a time on. */
static void compare_on_the_way(const second_rig *early, const second_rig *late, double from)
{
  const second_rig then = virtual_rig(7);
  const second_course course = {t_cmd, u_cmd[1], COMMANDS, NULL, late, from};
  const char *const path[2] = {scratch_path("then.csv"), scratch_path("now.csv")};
  declare();
  write_log(&then, u_cmd[0], path[0]);
  write_course(early, &course, 10, spacing, path[1]);
  compare_logs(path);
}

static void assert_since(const lab_onset *onset, double t, double within)
{
  assert_true(onset->known);
  assert_close(onset->t, t, within, 0);
  assert_between(t, onset->low, onset->high);
  assert_between(onset->high - onset->low, 0, 10 * within);
}

/* A sensor's error needs no time to set in. */
TEST(test_lab_changes_find__sensor_that_fails_on_the_way__has_its_onset)
{
  const second_rig now = virtual_rig(8);
  second_rig failed = now;
  failed.pressure_bias = 8000;
  compare_on_the_way(&now, &failed, 6.13);
  assert_change("pressure_bias", 8000);
  assert_since(&changes.change[0].begin, 6.13, 2 * spacing);
  assert_false(changes.change[0].end.known);
}

TEST(test_lab_changes_find__leak_that_begins_on_the_way__has_its_onset)
{
  const second_rig now = virtual_rig(8);
  second_rig leaks = now;
  leaks.leak_area = 2e-8;
  compare_on_the_way(&now, &leaks, 4.71);
  assert_change("chamber_leak", 2e-8);
  assert_since(&changes.change[0].begin, 4.71, 10 * spacing);
}

/* A valve of a plant, logged at 1 Hz: its positioner is told positions about the middle, which shift every few rows. */
enum { PLANT_ROWS = 121, PLANT_COMMANDS = 30 };

static second_rig plant_rig(uint64_t seed)
{
  second_rig g = virtual_rig(seed);
  g.position_noise = 1e-4;
  return g;
}

static const second_positioner positioner = {.gain = 10, .dead_band = 0.005, .cutoff_high = 2};

/* In:  now   the positioner of the new log
 *      peak  the new log's highest set position, once; the baseline goes to 0.79 */
static void compare_plant(const second_rig *early, const second_rig *late, double from, const second_positioner *now,
                          double peak)
{
  static double t_set[PLANT_COMMANDS], set[PLANT_COMMANDS];
  const char *const path[2] = {scratch_path("then.csv"), scratch_path("now.csv")};
  const second_rig then = plant_rig(7);
  second_course course = {t_set, set, PLANT_COMMANDS, &positioner, NULL, 0};
  int i;
  for (i = 0; i < PLANT_COMMANDS; i++) {
    t_set[i] = 4 * i + 0.5;
    set[i] = 0.5 + 0.2 * sin(1.3 * i) + 0.1 * sin(0.31 * i);
  }
  declare();
  rig.noise[LAB_CHANNEL_X] = 1e-4;
  rig.n_fit = 0;
  rig.fit[rig.n_fit++] = LAB_PARAM_ORIFICE_AREA;
  *pneu_param_at(&rig.params, lab_param_index("positioner.gain")) = (pneu_real)positioner.gain;
  *pneu_param_at(&rig.params, lab_param_index("positioner.dead_band")) = (pneu_real)positioner.dead_band;
  write_course(&then, &course, PLANT_ROWS - 1, 1, path[0]);
  course.positioner = now;
  course.later = late;
  course.change = from;
  set[1] = fmax(set[1], peak);
  write_course(early, &course, PLANT_ROWS - 1, 1, path[1]);
  compare_logs(path);
}

/* ... comes back, and the positioner hides it as long as it suffices. */
TEST(test_lab_changes_find__supply_that_comes_back__has_the_time)
{
  second_rig now = plant_rig(8), fails = now;
  fails.supply = 30e3;
  compare_plant(&fails, &now, 47.3, &positioner, 0);
  assert_int_equal(changes.condition, LAB_SINCE_CHANGED);
  assert_change("supply_pressure", 30e3);
  assert_false(changes.change[0].begin.known);
  assert_since(&changes.change[0].end, 47.3, 2);
}

/* ... or fails on the way, and stays so. */
TEST(test_lab_changes_find__supply_that_fails_on_the_way__has_its_onset)
{
  second_rig now = plant_rig(8), fails = now;
  fails.supply = 60e3;
  compare_plant(&now, &fails, 80.6, &positioner, 0);
  assert_change("supply_pressure", 60e3);
  assert_since(&changes.change[0].begin, 80.6, 3);
  assert_false(changes.change[0].end.known);
}

TEST(test_lab_changes_find__plant_as_ever__is_unchanged)
{
  second_rig now = plant_rig(8);
  now.supply *= 1.02;
  now.position_bias = 5e-5;
  compare_plant(&now, NULL, 0, &positioner, 0);
  assert_int_equal(changes.condition, LAB_SINCE_UNCHANGED);
}

TEST(test_lab_changes_find__half_the_gain__is_the_change)
{
  const second_rig now = plant_rig(8);
  second_positioner tired = positioner;
  tired.gain = 5;
  compare_plant(&now, NULL, 0, &tired, 0);
  assert_change("positioner.gain", 5);
}

/* A model may be off where it was not fitted; one row there is no reason to see less in the others. */
TEST(test_lab_changes_find__one_set_position_beyond_the_baseline__hides_nothing)
{
  const second_rig now = plant_rig(8);
  second_positioner worn = positioner;
  worn.dead_band = 0.01;
  compare_plant(&now, NULL, 0, &worn, 0.95);
  assert_change("positioner_dead_band", 0.005);
}

/* Something that no parameter has: it can be told neither that all is well nor what is not. */
TEST(test_lab_changes_find__no_parameter_has_it__cannot_tell)
{
  second_rig now = virtual_rig(8);
  now.force = 900;
  now.force_rate = 3.7;
  compare(&now);
  assert_true(changes.now > 1.5);
  assert_true(*changes.why != '\0');
  assert_true(changes.condition != LAB_SINCE_UNCHANGED);
}
