/* apps/lab/run/schedule, start, standard and table */
#include "../../fixture.h"
#include "../../scratch.h"

#include "../../../apps/lab/run/run.h"
#include "../../../apps/lab/run/schedule.h"
#include "../../../apps/lab/run/standard.h"
#include "../../../apps/lab/run/start.h"
#include "../../../apps/lab/base/text.h"

static lab_rig rig;
static pneu_model model;
static lab_log seen;      /* the log that was read last */
static lab_inputs inputs; /* of a run of it */
static double load;       /* [N] force on the stem at a start */
static int is_set;        /* whether the command is a set position then */
static pneu_state start;  /* that was found last */

/* The default rig, R1-400: spring 400 kN/m compressed 10 mm, area 400 cm^2, dry friction 480 N. */
static int fresh_rig(void **state)
{
  lab_rig_default(&rig);
  load = 0;
  is_set = 0;
  return lab_rig_model(&rig, &model, &error);
}

static int forget(void **state)
{
  lab_inputs_free(&inputs);
  lab_log_free(&seen);
  return 0;
}

#define CASE(name) TEST_WITH(name, fresh_rig, forget)

static void set_inputs(int p, int x, int ps, int force)
{
  rig.input[LAB_CHANNEL_P] = (unsigned char)p;
  rig.input[LAB_CHANNEL_X] = (unsigned char)x;
  rig.input[LAB_CHANNEL_PS] = (unsigned char)ps;
  rig.input[LAB_CHANNEL_FORCE] = (unsigned char)force;
  rig.laws.pressure_input = p;
  rig.laws.position_input = x;
  succeed(lab_rig_model(&rig, &model, &error));
}

static void read_log(const char *text)
{
  lab_log_free(&seen);
  succeed(lab_log_read(scratch_text("log.csv", text), &rig.log, 101325, &seen, &error));
}

static void drive(size_t run)
{
  lab_inputs_free(&inputs);
  succeed(lab_inputs_from_log(&model, &rig, &seen, run, &inputs, &error));
}

/* ---- Schedules ---- */

/* A pressure that turns between two rows goes to where it turns and on from there. */
CASE(test_lab_inputs_from_log__bend__is_an_entry_of_its_own)
{
  const lab_bend bends[] = {{0.5, 8e3}, {NAN, NAN}, {NAN, NAN}};
  read_log("t [s],p [kPa]\n0,0\n1,10\n2,12\n");
  seen.bend[LAB_CHANNEL_P] = malloc(sizeof bends);
  assert_non_null(seen.bend[LAB_CHANNEL_P]);
  memcpy(seen.bend[LAB_CHANNEL_P], bends, sizeof bends);
  set_inputs(1, 0, 0, 0);
  drive(0);
  assert_int_equal(inputs.schedule.n, 4);
  assert_close(inputs.schedule.t[1], 0.5, 0, 0);
  assert_close(inputs.schedule.input[0].pressure_rate, 16e3, 1e-9, 0);
  assert_close(inputs.schedule.input[1].pressure_rate, 4e3, 1e-9, 0);
  assert_close(inputs.schedule.input[2].pressure_rate, 2e3, 1e-9, 0);
}

/* Commands t, u, u_rate, and no others. */
static void assert_commands(const lab_schedule *s, const double row[][3], int n)
{
  int i;
  assert_int_equal(s->n, n);
  for (i = 0; i < n; i++) {
    assert_close(s->t[i], row[i][0], 0, 0);
    assert_close(s->input[i].u, row[i][1], 1e-15, 0);
    assert_close(s->input[i].u_rate, row[i][2], 1e-15, 0);
  }
}

CASE(test_lab_inputs_from_log__equal_commands__are_one_entry)
{
  static const double row[][3] = {{0, 0, 0}, {2, 1, 0}, {4, -0.5, 0}};
  read_log("t [s],u [1]\n0,0\n1,0\n2,1\n3,1\n4,-0.5\n5,-0.5\n");
  drive(0);
  assert_commands(&inputs.schedule, row, 3);
  assert_close(inputs.schedule.input[0].supply_pressure, 4e5, 0, 0);
  assert_close(inputs.schedule.input[0].pressure_rate, 0, 0, 0);
}

CASE(test_lab_inputs_from_log__ramp__runs_along_lines)
{
  static const double row[][3] = {{0, 0, 0}, {1, 0, 0.1}, {3.5, 0.25, 0}, {6, 1, 0}};
  const lab_schedule *s = &inputs.schedule;
  int i;
  read_log("t [s],u [1],p [kPa]\n0,0,0\n1,0,0\n2,0.1,0\n3,0.2,0\n4,0.25,0\n5,0.25,0\n6,1,0\n");
  drive(0);
  assert_commands(s, row, 4);
  for (i = 0; i < 3; i++) /* what runs does not jump */
    assert_int_equal(lab_input_jumps(&s->input[i], s->t[i + 1] - s->t[i], &s->input[i + 1]), i == 2);
}

/* One ramp from 0, at other times than those of rows: its corners are where its line meets the levels. */
static void check_corners(const char *rows, double begin, double end, double to)
{
  const lab_schedule *s = &inputs.schedule;
  read_log(rows);
  drive(0);
  check_note("%s", rows);
  assert_int_equal(s->n, 3);
  assert_close(s->t[1], begin, 1e-12, 0);
  assert_close(s->input[1].u, 0, 1e-15, 0);
  assert_close(s->input[1].u_rate, to / (end - begin), 1e-12, 0);
  assert_close(s->t[2], end, 1e-12, 0);
  assert_close(s->input[2].u, to, 1e-12, 0);
  assert_close(s->input[2].u_rate, 0, 0, 0);
}

CASE(test_lab_inputs_from_log__ramp_that_begins_between_rows__has_its_corners_there)
{
  check_corners("t [s],u [1],p [kPa]\n0,0,0\n1,0,0\n2,0.04,0\n3,0.14,0\n4,0.24,0\n5,0.34,0\n6,0.4,0\n7,0.4,0\n", 1.6,
                5.6, 0.4);
}

/* A row and a bit long: its beginning and its end are too small a part of it to be of a like pace. */
CASE(test_lab_inputs_from_log__short_ramp__is_no_jump)
{
  check_corners("t [s],u [1],p [kPa]\n0,0,0\n1,0,0\n2,0.08,0\n3,0.88,0\n4,1,0\n5,1,0\n", 1.9, 3.15, 1);
}

/* Rows that were lost do not make a jump of it. */
CASE(test_lab_inputs_from_log__ramp_over_a_gap__goes_by_its_pace)
{
  check_corners("t [s],u [1],p [kPa]\n0,0,0\n1,0,0\n8,0.55,0\n9,0.65,0\n10,0.75,0\n11,0.8,0\n12,0.8,0\n", 2.5, 10.5,
                0.8);
}

/* What a positioner sends: it jumps somewhere in the row before, holds, and then runs along with the stem. */
CASE(test_lab_run_open__command_that_jumps_and_runs_at_once__jumps_between_two_rows)
{
  static const double row[][3] = {{0, 0, 0}, {3, -1, 0}, {3, -1, 0.3}, {4, -0.7, 0.2}, {6, -0.3, 0}};
  lab_run run;
  int i;
  read_log("t [s],u [1],p [kPa]\n0,0,0\n1,0,0\n2,0,0\n3,-1,0\n4,-0.7,0\n5,-0.5,0\n6,-0.3,0\n7,-0.3,0\n");
  rig.noise[LAB_CHANNEL_P] = 100;
  succeed(lab_run_open(&rig, &seen, 0, &run, &error));
  assert_commands(&run.inputs.schedule, row, 5);
  for (i = 0; i < 4; i++)
    assert_close(run.bracket[i], i == 0, 0, 0);
  lab_run_close(&run);
}

/* Rounded to steps of 0.01: one line within a step; where the supply is measured too, all rows of it. */
CASE(test_lab_inputs_from_log__rounded_ramp__is_one_line)
{
  static const char plain[] = "t [s],u [1],p "
                              "[kPa]\n0,0,0\n1,0.01,0\n2,0.03,0\n3,0.04,0\n4,0.06,0\n5,0.07,0\n6,0.08,0\n7,0.1,0\n8,0."
                              "11,0\n9,0.11,0\n10,0.11,0\n";
  static const char supplied[] = "t [s],u [1],ps [kPa],p "
                                 "[kPa]\n0,0,400,0\n1,0.01,401,0\n2,0.03,402,0\n3,0.04,403,0\n4,0.06,404,0\n5,0.07,405,"
                                 "0\n6,0.08,406,0\n7,0.1,407,0\n8,0.11,408,0\n9,0.11,408,0\n10,0.11,408,0\n";
  read_log(plain);
  drive(0);
  assert_int_equal(inputs.schedule.n, 2);
  assert_close(inputs.schedule.input[0].u_rate, 0.11 / 8, 1e-15, 0);
  assert_close(inputs.schedule.t[1], 8, 0, 0);
  rig.input[LAB_CHANNEL_PS] = 1;
  read_log(supplied);
  drive(0);
  assert_int_equal(inputs.schedule.n, 9);
  assert_close(inputs.schedule.input[3].u, 0.33 / 8, 1e-15, 0);
  assert_close(inputs.schedule.input[3].u_rate, 0.11 / 8, 1e-15, 0);
}

static void declare_positioner(void)
{
  fixture_set(&rig.params, "positioner.gain", 20);
  succeed(lab_rig_model(&rig, &model, &error));
}

/* A ramp so slow that rounding makes stairs of it, which are none: one line within a step from row 1 to the last step,
 * and the level after it. */
CASE(test_lab_inputs_from_log__stairs_of_single_roundings__are_one_line)
{
  char text[4096] = "t [s],sp [%],p [kPa]\n";
  int i;
  for (i = 0; i < 60; i++)
    lab_append(text, sizeof text, "%d,%.2f,0\n", i, 0.004 * fmin(fmax(i - 5, 0), 40));
  read_log(text);
  declare_positioner();
  drive(0);
  assert_between(inputs.schedule.n, 3, 4);
  assert_close(inputs.schedule.input[1].u_rate, 4e-5, 4e-6, 0);
  assert_between(inputs.schedule.t[1], 4, 7);
  assert_close(inputs.schedule.input[inputs.schedule.n - 1].u, 1.6e-3, 1e-12, 0);
  assert_between(inputs.schedule.t[inputs.schedule.n - 1], 43, 46);
}

/* A step that is made again and again is no rounding. */
CASE(test_lab_inputs_from_log__steps_that_come_again__hold)
{
  char text[4096] = "t [s],sp [%],p [kPa]\n";
  int i;
  for (i = 0; i < 100; i++)
    lab_append(text, sizeof text, "%d,%.1f,0\n", i, 0.1 * (i / 5));
  read_log(text);
  declare_positioner();
  drive(0);
  assert_int_equal(inputs.schedule.n, 20);
  for (i = 0; i < 20; i++)
    assert_close(inputs.schedule.input[i].u_rate, 0, 0, 0);
}

CASE(test_lab_inputs_from_log__equal_steps_of_a_schedule__hold)
{
  read_log("t [s],u [1]\n0,0\n10,0.1\n20,0.2\n30,0.3\n");
  drive(0);
  assert_int_equal(inputs.schedule.n, 4);
  assert_close(inputs.schedule.t[3], 30, 0, 0);
}

/* Rows of a second of a stem that follows a set position with a lag, each row's held until the next or run to it along
 * a line, from its closed form, so many rows late; it walks at random. */
static void read_walk(int holds, int rows, int late)
{
  static char text[20000];
  const double lag = 0.8, stays = exp(-1 / lag);
  double set = 0.5, x = 0.5, shown[2] = {0.5, 0.5}; /* now, a row ago */
  uint64_t seed = 3;
  int i, at = snprintf(text, sizeof text, "t [s],sp [%%],x [mm]\n");
  for (i = 0; i < rows; i++) {
    const double next = fmin(fmax(set + fixture_random(&seed, -0.05, 0.05), 0.2), 0.8), rate = holds ? 0 : next - set;
    const double noise = fixture_random(&seed, -0.01, 0.01);
    shown[1] = shown[0];
    shown[0] = x;
    at += snprintf(text + at, sizeof text - (size_t)at, "%d,%.4f,%.4f\n", i, 100 * set, 20 * shown[late] + noise);
    x = set + rate * (1 - lag) + (x - set + rate * lag) * stays;
    set = next;
  }
  read_log(text);
}

static size_t count_lines(void)
{
  size_t i, n = 0;
  drive(0);
  for (i = 0; i < inputs.schedule.n; i++)
    n += inputs.schedule.input[i].u_rate != 0;
  return n;
}

CASE(test_lab_inputs_from_log__stem_follows_the_row_before__holds_from_row_to_row)
{
  read_walk(1, 200, 0);
  assert_int_equal(count_lines(), 0);
  read_walk(0, 200, 0);
  assert_between((double)count_lines(), 100, 200);
  read_walk(0, 200, 1); /* cannot follow its own row either */
  assert_between((double)count_lines(), 100, 200);
  read_walk(1, 30, 0); /* too few to tell */
  assert_between((double)count_lines(), 10, 30);
}

CASE(test_lab_inputs_from_log__set_position__drives_where_there_is_no_command)
{
  read_log("t [s],sp [%],x [mm]\n0,0,0\n1,0,0\n2,50,0\n3,50,1\n");
  assert_fails(lab_positioner_check(&rig, &seen, &error), LAB_DATA, "positioner = { gain = 20; }");
  drive(0); /* a fit may come to a gain of 0 */
  declare_positioner();
  succeed(lab_positioner_check(&rig, &seen, &error));
  drive(0);
  assert_int_equal(inputs.schedule.n, 2);
  assert_close(inputs.schedule.t[1], 2, 0, 0);
  assert_close(inputs.schedule.input[1].u, 0.5, 1e-15, 0);
  assert_int_equal(inputs.schedule.input[1].set_position, 1);
  read_log("t [s],sp [%],u [1]\n0,0,0\n1,50,1\n2,,0.25\n");
  drive(0);
  assert_int_equal(inputs.schedule.n, 3);
  assert_close(inputs.schedule.input[2].u, 0.25, 0, 0);
  assert_int_equal(inputs.schedule.input[2].set_position, 0);
}

CASE(test_lab_inputs_from_log__second_run__has_its_own_rows)
{
  rig.log.new_run = LAB_RUN_T_DROPS;
  read_log("t [s],u [1]\n0,0\n1,1\n0.5,1\n2,-1\n");
  drive(1);
  assert_int_equal(inputs.schedule.n, 2);
  assert_close(inputs.schedule.t[0], 0.5, 0, 0);
  assert_close(inputs.schedule.input[1].u, -1, 0, 0);
}

CASE(test_lab_inputs_from_log__measured_inputs__run_along_lines_over_gaps)
{
  read_log("t [s],p [kPa],x [mm]\n0,10,0\n1,,1\n3,40,1\n4,40,2\n");
  set_inputs(1, 1, 0, 0);
  drive(0);
  assert_int_equal(inputs.schedule.n, 4);
  assert_close(inputs.schedule.input[0].pressure_rate, 1e4, 1e-6, 0);
  assert_close(inputs.schedule.input[1].pressure_rate, 1e4, 1e-6, 0);
  assert_close(inputs.schedule.input[2].pressure_rate, 0, 0, 0);
  assert_close(inputs.schedule.input[0].position_rate, 1e-3, 1e-12, 0);
  assert_close(inputs.schedule.input[1].position_rate, 0, 0, 0);
  assert_close(inputs.schedule.input[3].position_rate, 0, 0, 0);
}

CASE(test_lab_inputs_from_log__measured_supply_and_force__hold_over_gaps)
{
  read_log("t [s],u [1],ps [kPa],force [N]\n0,0,300,5\n1,0,,5\n2,0,290,7\n");
  set_inputs(0, 0, 1, 1);
  drive(0);
  assert_int_equal(inputs.schedule.n, 2);
  assert_close(inputs.schedule.input[0].supply_pressure, 300e3, 1e-9, 0);
  assert_close(inputs.schedule.input[1].supply_pressure, 290e3, 1e-9, 0);
  assert_close(inputs.schedule.input[1].force, 7, 0, 0);
}

CASE(test_lab_inputs_from_log__measured_outputs__do_not_drive)
{
  read_log("t [s],u [1],p [kPa],ps [kPa],force [N]\n0,0,1,300,5\n1,0,2,290,7\n");
  drive(0);
  assert_int_equal(inputs.schedule.n, 1);
  assert_close(inputs.schedule.input[0].supply_pressure, 4e5, 0, 0);
  assert_close(inputs.schedule.input[0].force, 0, 0, 0);
}

CASE(test_lab_inputs_from_log__missing_input__is_named)
{
  read_log("t [s],p [kPa]\n0,1\n");
  assert_fails(lab_inputs_from_log(&model, &rig, &seen, 0, &inputs, &error), LAB_DATA, "log.csv: expected a column u");
  set_inputs(1, 1, 0, 0);
  assert_fails(lab_inputs_from_log(&model, &rig, &seen, 0, &inputs, &error), LAB_DATA, "expected a column x");
}

/* ---- Starts ---- */

static pneu_state start_of(const char *text, double u)
{
  pneu_input input;
  pneu_input_default(&model, &input);
  read_log(text);
  input.u = (pneu_real)u;
  input.force = (pneu_real)load;
  input.set_position = is_set;
  succeed(lab_run_initial_state(&model, &input, &seen, 0, &start, &error));
  return start;
}

/* Begin at this command with this pressure and position; what is 0 is so to the bit. */
static void assert_start(const char *text, double u, double p, double x)
{
  start_of(text, u);
  check_note("start at u = %g of %s", u, text);
  assert_close(start.p, p, p > 0 ? 1e-9 : 0, 0);
  assert_close(start.x, x, x > 0 ? 1e-15 : 0, 0);
}

CASE(test_lab_run_initial_state__noise_at_rest__is_averaged)
{
  char text[4096] = "t [s],u [1],p [kPa],x [mm]\n";
  int i;
  for (i = 0; i < 50; i++)
    lab_append(text, sizeof text, "%d,0,%g,%g\n", i, 200 + (i * 7 % 5 - 2) * 0.1, 10 + (i * 3 % 5 - 2) * 0.01);
  strcat(text, "50,1,900,900\n");
  start_of(text, 0);
  assert_close(start.p, 200e3, 1, 0);
  assert_close(start.x, 10e-3, 1e-6, 0);
  assert_close(start.v, 0, 0, 0);
  assert_close(start.T, 298.15, 0, 0);
}

CASE(test_lab_run_initial_state__moving_from_the_first_row__takes_the_first_rows)
{
  char text[65536] = "t [s],u [1],p [kPa],x [mm]\n";
  int i;
  for (i = 0; i < 1000; i++)
    lab_append(text, sizeof text, "%d,1,%g,%g\n", i, 0.3 * i, 0.02 * i);
  assert_start(text, 1, 0, 0);
}

/* A move in the first of many rows hardly shifts their mean, but it is where the run begins. */
CASE(test_lab_run_initial_state__moves_at_once_and_rests__takes_the_first_row)
{
  char text[8192] = "t [s],u [1],p [kPa]\n0,0,20\n";
  int i;
  for (i = 1; i < 300; i++)
    lab_append(text, sizeof text, "%d,0,%d.%d\n", i, 160, i * 7 % 10);
  assert_close(start_of(text, 0).p, 20e3, 1e-6, 0);
}

/* Down and up again, so that both halves of the curve have one mean. */
CASE(test_lab_run_initial_state__curve_with_halves_alike__is_no_level)
{
  char text[65536] = "t [s],u [1],p [kPa]\n";
  int i;
  for (i = 0; i < 200; i++)
    lab_append(text, sizeof text, "%d,-1,%g\n", i, 100 + 0.01 * (i - 99.5) * (i - 99.5));
  assert_close(start_of(text, -1).p, (100 + 0.01 * 99.5 * 99.5) * 1e3, 1, 0);
}

CASE(test_lab_run_initial_state__pressure_that_drives_and_changes__leaves_the_first_position)
{
  char text[4096] = "t [s],p [kPa],x [mm]\n";
  int i;
  set_inputs(1, 0, 0, 0);
  for (i = 0; i < 20; i++)
    lab_append(text, sizeof text, "%d,%d,%d\n", i, 100 + i, i % 2 ? 12 : 4);
  assert_close(start_of(text, 0).x, 4e-3, 1e-15, 0);
}

CASE(test_lab_run_initial_state__vessel_seen_late__is_full_while_it_fills)
{
  rig.params.stroke = 0;
  succeed(lab_rig_model(&rig, &model, &error));
  assert_start("t [s],u [1],p [kPa]\n0,1,\n1,-1,350\n", 1, 4e5, 0);
  assert_start("t [s],u [1],p [kPa]\n0,0,\n1,1,150\n", 0, 0, 0);
}

/* A log of the set position alone: at rest there, or fully vented or filled beyond a cut-off. */
CASE(test_lab_run_initial_state__set_position_alone__is_where_the_stem_rests)
{
  const char *text = "t [s],sp [%]\n0,0\n1,50\n";
  fixture_need("positioner");
  fixture_set(&rig.params, "positioner.cutoff_low", 0.01);
  declare_positioner();
  is_set = 1;
  assert_close(start_of(text, 0.3).x, 0.3 * (double)rig.params.stroke, 1e-9, 0);
  assert_close(start_of(text, 0.3).p, 4e5 * (0.01 + 0.006) / 0.04, 1e-3, 0);
  assert_start(text, 0.005, 0, 0);
  assert_start(text, 0, 0, 0);
}

/* Without a cut-off a positioner ends where its dead band does, and what holds the stem there is all that the chamber
 * has; with one it fills on, also where the sensor sees the stem beyond its stop. */
CASE(test_lab_run_initial_state__set_position_at_the_upper_stop__is_held_or_full)
{
  const char *text = "t [s],sp [%],x [mm]\n0,100,20\n1,50,20\n",
             *beyond = "t [s],sp [%],x [mm]\n0,100,20.02\n1,50,20.02\n";
  fixture_need("positioner");
  fixture_set(&rig.params, "positioner.dead_band", 0.005);
  declare_positioner();
  is_set = 1;
  assert_close(start_of(text, 1).p, 4e5 * (0.01 + 0.02) / 0.04, 1e-3, 0);
  assert_close(start_of(beyond, 1).p, 4e5 * (0.01 + 0.02) / 0.04, 1e-3, 0);
  fixture_set(&rig.params, "positioner.cutoff_high", 0.99);
  succeed(lab_rig_model(&rig, &model, &error));
  assert_close(start_of(text, 1).p, (double)rig.params.supply_pressure, 1e-3, 0);
  assert_close(start_of(beyond, 1).p, (double)rig.params.supply_pressure, 1e-3, 0);
}

/* A sensor that swings by 2 kPa every 10 s: the log begins at its highest, a quarter of a cycle after a zero of time.
 */
CASE(test_lab_run_initial_state__sensor_in_cycles__is_corrected_by_the_time_of_the_log)
{
  static const pneu_term swing = {PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_CYCLE, 2, 0, 10, {0, 2000}};
  assert_int_equal(pneu_model_terms(&model, &swing, 1), PNEU_OK);
  start_of("t [s],u [1],p [kPa],x [mm]\n42.5,0,202,10\n43,1,202,10\n", 0);
  assert_close(start.p, 200e3, 1e-6, 0);
  assert_close(start.extra[model.clock], 42.5, 0, 0);
}

/* A zero of the sensor, not a pressure: 1.6 kPa at a supply of 400 kPa; 2.4 kPa is one, and so is what fills or holds.
 */
CASE(test_lab_run_initial_state__down_and_near_ambient__is_vented)
{
  static const char *const down = "t [s],u [1],p [kPa],x [mm]\n0,0,1.6,0.02\n1,0,1.6,0.02\n";
  assert_true(start_of(down, 0).p == 0);
  assert_true(start_of(down, -1).p == 0);
  assert_close(start_of(down, 1).p, 1600, 1e-6, 0);
  assert_close(start_of("t [s],u [1],p [kPa],x [mm]\n0,0,2.4,0.02\n1,0,2.4,0.02\n", 0).p, 2400, 1e-6, 0);
  assert_close(start_of("t [s],u [1],p [kPa],x [mm]\n0,0,1.6,4\n1,0,1.6,4\n", 0).p, 1600, 1e-6, 0);
}

CASE(test_lab_run_initial_state__near_a_stop_and_pushed__stands_on_it)
{
  start_of("t [s],u [1],p [kPa],x [mm]\n0,0,-0.03,0.0275\n", 0);
  assert_true(start.x == 0);
  assert_int_equal(start.mode, PNEU_MODE_LOWER);
  assert_start("t [s],u [1],p [kPa],x [mm]\n0,0,400,19.97\n", 0, 4e5, 0.02);
  assert_int_equal(start.mode, PNEU_MODE_UPPER);
  assert_start("t [s],u [1],p [kPa],x [mm]\n0,0,400,20.2\n", 0, 4e5, 0.02);
}

CASE(test_lab_run_initial_state__held_by_friction__stays_where_it_is_seen)
{
  assert_start("t [s],u [1],p [kPa],x [mm]\n0,0,205,10\n", 0, 205e3, 0.01);
  assert_int_equal(start.mode, PNEU_MODE_STUCK);
}

/* A sensor's error is not in the state: bias and gain as the model has them are taken out. */
CASE(test_lab_run_initial_state__sensors_in_error__starts_from_what_is_there)
{
  fixture_set(&rig.params, "pressure_bias.pressure_bias", 1400);
  fixture_set(&rig.params, "position_gain.position_gain", 0.05);
  succeed(lab_rig_model(&rig, &model, &error));
  start_of("t [s],u [1],p [Pa],x [mm]\n0,0,201400,10.5\n", 0);
  assert_close(start.p, 200e3, 1e-6, 0);
  assert_close(start.x, 10e-3, 0, 1.01 * 0.05 * 0.05 * 0.05); /* three rounds, each takes out all but the gain */
}

CASE(test_lab_run_initial_state__no_position__follows_from_pressure)
{
  assert_start("t [s],u [1],p [kPa]\n0,0,200\n", 0, 200e3, 0.01);
  assert_start("t [s],u [1],p [kPa]\n0,0,20\n", 0, 20e3, 0);
  assert_start("t [s],u [1],p [kPa]\n0,0,390\n", 0, 390e3, 0.02);
}

CASE(test_lab_run_initial_state__no_pressure__follows_from_position)
{
  assert_start("t [s],u [1],x [mm]\n0,0,10\n", 0, 200e3, 0.01);
  assert_start("t [s],u [1],x [mm]\n0,0,0.02\n", 0, 0, 0);
  assert_start("t [s],u [1],x [mm]\n0,1,19.99\n", 1, 4e5, 0.02);
}

/* 400 N more against the air take 10 kPa more, or let the stem down by 1 mm. */
CASE(test_lab_run_initial_state__force_on_the_stem__counts_against_the_air)
{
  load = 400;
  assert_start("t [s],u [1],x [mm]\n0,0,10\n", 0, 210e3, 0.01);
  assert_start("t [s],u [1],p [kPa]\n0,0,200\n", 0, 200e3, 9e-3);
}

CASE(test_lab_run_initial_state__nothing_measured__is_empty_and_down)
{
  assert_start("t [s],u [1]\n0,0\n", 0, 0, 0);
}

CASE(test_lab_run_initial_state__vessel__has_no_position)
{
  rig.params.stroke = 0;
  succeed(lab_rig_model(&rig, &model, &error));
  assert_start("t [s],u [1],p [kPa]\n0,-1,700\n", -1, 700e3, 0);
}

CASE(test_lab_run_initial_state__driven_channels__start_at_their_first_value)
{
  set_inputs(1, 1, 0, 0);
  assert_start("t [s],p [kPa],x [mm]\n0,,0.5\n1,12,1\n2,13,1\n", 0, 12e3, 0.5e-3);
}

CASE(test_lab_run_initial_state__below_vacuum__is_refused)
{
  pneu_input input;
  read_log("t [s],u [1],p [kPa]\n0,0,-150\n");
  pneu_input_default(&model, &input);
  assert_fails(lab_run_initial_state(&model, &input, &seen, 0, &start, &error), LAB_DATA, "log.csv:2:");
  assert_contains(error.text, "-150000 Pa");
}

/* ---- The standard experiment ---- */

CASE(test_lab_standard_experiment__default_model__fills_and_vents)
{
  const lab_response_options options = {.tol = 1e-6};
  lab_response response;
  succeed(lab_standard_experiment(&model, &options, &response, &error));
  assert_int_equal(response.n, 3051);
  assert_close(response.t[1], 0.01, 1e-15, 0);
  assert_close(response.t[3050], 30.5, 1e-12, 0);
  assert_close(response.u[49], 0, 0, 0);
  assert_close(response.u[51], 1, 0, 0);
  assert_close(response.u[1551], -1, 0, 0);
  assert_close(response.x[49], 0, 0, 0);
  assert_close(response.p[49], 0, 1e-9, 0);
  assert_close(response.x[1549], 0.02, 1e-9, 0);
  assert_close(response.p[1549], 4e5, 100, 0);
  assert_close(response.x[3050], 0, 1e-9, 0);
  lab_response_free(&response);
}

/* ---- Runs ---- */

/* The noise of values without any is that of their rounding, whatever its own rounding. */
CASE(test_lab_run_open__values_in_steps_without_noise__have_weights)
{
  static char text[20000];
  int k, i;
  for (k = 1; k <= 20; k++) {
    lab_run run;
    strcpy(text, "t [s],u [1],p [kPa]\n");
    for (i = 0; i < 400; i++)
      lab_append(text, sizeof text, "%d,%d,%g\n", i, i > 0, 0.1 * k * (double)(i * i / 4000));
    read_log(text);
    succeed(lab_run_open(&rig, &seen, 0, &run, &error));
    check_note("steps of %g kPa, sigma %g Pa", 0.1 * k, run.sigma[0]);
    assert_true(run.sigma[0] > 0);
    for (i = 0; i < 400; i++)
      assert_true(run.weight[i] > 0 && run.weight[i] <= 1);
    lab_run_close(&run);
  }
}

/* Rounding to steps of q adds q^2/12 to a declared variance. */
CASE(test_lab_run_open__declared_resolution__is_that_of_the_run)
{
  const double q = 500, noise = 100; /* [Pa] */
  lab_run run;
  read_log("t [s],u [1],p [kPa]\n0,1,0\n1,1,1.1\n2,1,2.3\n3,1,2.9\n");
  rig.noise[LAB_CHANNEL_P] = noise;
  rig.tolerance[LAB_PRESSURE_RESOLUTION] = q;
  succeed(lab_run_open(&rig, &seen, 0, &run, &error));
  assert_close(run.resolution[0], q, 0, 0);
  assert_close(run.sigma[0], sqrt(noise * noise + q * q / 12), 0, 1e-12);
  lab_run_close(&run);
}
