/* The program simulate, from outside: what it prints, what it leaves on the disk, its exit status. */
#include "../program.h"
#include "../scratch.h"

#include <sys/wait.h>

enum { TEXT = 1 << 20 };

static char out[TEXT], err[TEXT]; /* what the last run wrote */

static void load(const char *name, char *text)
{
  char *got = scratch_read(scratch_path(name));
  strcpy(text, got);
  free(got);
}

/* Run with arguments in which @ stands for the scratch folder.  Returns: exit status; out and err are set. */
static int run(const char *arguments)
{
  char line[4096];
  size_t n = (size_t)snprintf(line, sizeof line, PROGRAMS "/simulate ");
  int status;
  for (; *arguments && n < sizeof line - 256; arguments++)
    if (*arguments == '@')
      n += (size_t)snprintf(line + n, sizeof line - n, "%s", scratch_folder);
    else
      line[n++] = *arguments;
  snprintf(line + n, sizeof line - n, " >%s 2>%s", scratch_path("out"), scratch_path("err"));
  status = system(line);
  load("out", out);
  load("err", err);
  assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

static int write_inputs(void **state)
{
  int failed = scratch_open(state);
  if (failed)
    return failed;
  scratch_text("m.cfg", "actuator = { name = \"R1-400\"; };\n");
  scratch_text("bad.cfg", "actuator = {\n  aera = 1;\n};\n");
  scratch_text("vessel.cfg", "actuator = { stroke = \"0 mm\"; dead_volume = \"1 l\"; };\n"
                             "supply = { pressure = \"4 bar\"; };\n");
  scratch_text("runs.cfg", "log = { new_run = \"t drops\"; };\n");
  scratch_text("log.csv", "t [ms],u [%],p_abs [bar],x [cm]\n0,0,1.01325,0\n100,100,1,0\n"
                          "500,100,2,0\n2000,-100,3,1\n3500,-100,1,0\n");
  scratch_text("only_u.csv", "t [s],u [1]\n0,0\n1,1\n2,1\n");
  scratch_text("only_x.csv", "t [s],u [1],x [mm]\n0,0,0\n1,1,0\n2,1,0\n");
  scratch_text("runs.csv", "t [s],u [1],p [kPa]\n0,1,0\n1,1,0\n0,1,0\n1,1,0\n");
  scratch_text("torn.csv", "t [s],u [1],p [kPa]\n0,0,0\n1,0\n");
  return 0;
}

TESTS_WITH(write_inputs, scratch_close)

static int lines_of(const char *text)
{
  int n = 0;
  for (; *text; text++)
    n += *text == '\n';
  return n;
}

/* Number in a row and column of out, both from 0; row 0 is the header. */
static double cell(int row, int column)
{
  const char *at = out;
  while (row-- > 0)
    at = strchr(at, '\n') + 1;
  while (column-- > 0)
    at = strchr(at, ',') + 1;
  return strtod(at, NULL);
}

TEST(test_simulate__of_this_build__is_sanitized_as_its_test)
{
  assert_sanitized_as_its_test(PROGRAMS "/simulate");
}

TEST(test_simulate__supply_in_another_unit__says_that_the_stem_stands_still)
{
  scratch_text("bar.cfg", "supply = { pressure = 2.5; };\n");
  assert_int_equal(run("@/bar.cfg --step"), 0);
  assert_close(cell(1540, 3), 0, 0, 0);
  assert_contains(err, "supply.pressure is 2.5 Pa");
  assert_contains(err, "did you mean \"2.5 bar\"?");
}

TEST(test_simulate__step__prints_the_standard_experiment)
{
  assert_int_equal(run("@/m.cfg --step"), 0);
  assert_int_equal(strncmp(out, "t [s],u [1],p [kPa],x [mm]\n", 27), 0);
  assert_int_equal(lines_of(out), 3052);
  assert_close(cell(2, 0), 0.01, 0, 0);
  assert_close(cell(1540, 3), 20, 1e-6, 0);
  assert_close(cell(3051, 0), 30.5, 0, 0);
  assert_string_equal(err, "");
}

TEST(test_simulate__log__predicts_at_its_times)
{
  assert_int_equal(run("@/m.cfg @/log.csv"), 0);
  assert_int_equal(strncmp(out, "t [s],u [1],p [kPa],x [mm]\n", 27), 0);
  assert_int_equal(lines_of(out), 6);
  assert_close(cell(1, 0), 0, 0, 0);
  assert_close(cell(3, 0), 0.5, 0, 0);
  assert_close(cell(4, 1), -1, 0, 0);
  assert_close(cell(1, 2), 0, 1e-6, 0);
  assert_true(cell(3, 2) > 100 && cell(3, 2) < 400);
  assert_true(cell(4, 3) > 1);
}

TEST(test_simulate__log_without_outputs__gives_pressure_and_position)
{
  assert_int_equal(run("@/m.cfg @/only_u.csv"), 0);
  assert_int_equal(strncmp(out, "t [s],u [1],p [kPa],x [mm]\n", 27), 0);
  assert_string_equal(err, "");
}

TEST(test_simulate__command_that_never_vents__is_noted)
{
  scratch_text("back.csv", "t [s],u [1]\n0,0\n1,1\n5,0\n9,0\n");
  assert_int_equal(run("@/m.cfg @/back.csv"), 0);
  assert_contains(err, "u never goes below 0, so that nothing vents: 1 fills, 0 shuts, -1 vents");
}

TEST(test_simulate__log_of_position__gives_position_alone)
{
  assert_int_equal(run("@/m.cfg @/only_x.csv"), 0);
  assert_int_equal(strncmp(out, "t [s],u [1],x [mm]\n", 19), 0);
  assert_true(cell(3, 2) > 1);
}

/* The set position drives through the positioner, unless the log has the command too; both are shown. */
TEST(test_simulate__set_position__drives_through_the_positioner)
{
  scratch_text("closed.cfg", "positioner = { gain = 20; dead_band = \"0.2 %\"; };\n");
  scratch_text("sp.csv", "t [s],sp [%],x [mm]\n0,0,0\n1,50,0\n49,50,10\n50,25,10\n99,25,5\n");
  scratch_text("both.csv", "t [s],sp [%],u [1],x [mm]\n0,0,0,0\n1,50,1,0\n30,50,1,20\n");
  assert_int_equal(run("@/closed.cfg @/sp.csv"), 0);
  assert_int_equal(strncmp(out, "t [s],sp [%],x [mm]\n", 20), 0);
  assert_close(cell(2, 1), 50, 1e-9, 0);
  assert_between(cell(3, 2), 10 - 0.04, 10.04); /* as printed: the difference is rounded */
  assert_between(cell(5, 2), 5 - 0.04, 5.04);
  assert_int_equal(run("@/closed.cfg @/both.csv"), 0);
  assert_int_equal(strncmp(out, "t [s],u [1],sp [%],x [mm]\n", 26), 0);
  assert_close(cell(3, 3), 20, 1e-6, 0);
  assert_int_equal(run("@/m.cfg @/sp.csv"), 1);
  assert_contains(err, "positioner = { gain = 20; }");
}

TEST(test_simulate__metrics_of_set_positions__are_of_the_set_position)
{
  scratch_text("closed.cfg", "positioner = { gain = 20; };\n");
  scratch_text("sp.csv", "t [s],sp [%]\n0,10\n10,20\n20,30\n30,40\n40,50\n50,60\n60,50\n70,40\n80,30\n90,20\n100,20\n");
  assert_int_equal(run("@/closed.cfg @/sp.csv --metrics"), 0);
  assert_contains(out, "set position against set position");
  assert_contains(out, "% of 100 % are enough to move the stem back");
  assert_int_equal(run("@/closed.cfg @/sp.csv --metrics --json"), 0);
  assert_contains(out, "\"set position\"");
}

/* The stroke of the standard experiment, by the rows and by the figures. */
TEST(test_simulate__metrics__those_of_the_response)
{
  double rise = 0;
  int row;
  assert_int_equal(run("@/m.cfg --step"), 0);
  for (row = 52; rise == 0; row++)
    if (cell(row, 3) >= 0.865 * 20)
      rise = cell(row, 0) - 0.5;
  assert_int_equal(run("@/m.cfg --step --metrics"), 0);
  assert_contains(out, "t86_up");
  assert_close(strtod(strstr(out, "t86_up") + 6, NULL), rise, 0.01, 0);
  assert_contains(out, "no slow loop");
  assert_int_equal(run("@/m.cfg --step --metrics --json --out @/figures.json"), 0);
  assert_string_equal(out, "");
  load("figures.json", out);
  assert_int_equal(out[0], '{');
  assert_close(strtod(strchr(strstr(out, "\"value\":") + 8, '\t'), NULL), 0.01, 0.01, 0);
  assert_contains(out, "\"reason\":");
}

TEST(test_simulate__metrics_of_a_log__sampled_finely)
{
  scratch_text("strokes.csv", "t [s],u [1]\n0,-1\n1,1\n16,-1\n31,-1\n");
  assert_int_equal(run("@/m.cfg @/strokes.csv --metrics"), 0);
  assert_contains(out, "first full stroke up and down");
  assert_int_equal(run("@/vessel.cfg @/only_u.csv --metrics"), 0);
  assert_contains(out, "there is no stem");
}

/* A figure of the table just printed. */
static double figure(const char *name)
{
  char line[64];
  snprintf(line, sizeof line, "\n%s ", name);
  check_note("%s", name);
  assert_contains(out, line);
  return strtod(strstr(out, line) + strlen(line), NULL);
}

/* 480 N of friction both ways on 0.04 m2 are 24 kPa of a bench set of 200 kPa, whatever drives the model. */
TEST(test_simulate__schedules__show_the_friction_that_is_declared)
{
  static const struct {
    const char *arguments;
    double tolerance;
  } drives[] = {{"study/actuators/r1-400.cfg study/schedules/slow-loop.csv", 0.3},
                {"study/schedules/r1-400-regulated.cfg study/schedules/staircase.csv", 0.6},
                {"study/schedules/r1-400-pressure.cfg study/schedules/pressure-loop.csv", 0.3}};
  char line[256];
  size_t i;
  for (i = 0; i < sizeof drives / sizeof *drives; i++) {
    snprintf(line, sizeof line, "%s --metrics", drives[i].arguments);
    assert_int_equal(run(line), 0);
    assert_close(figure("dead_band"), 12, drives[i].tolerance, 0);
    assert_close(figure("hysteresis_dead_band"), 12, 0.1, 0);
    assert_close(figure("linearity"), 0, 0.01, 0);
    assert_close(figure("energy_lost"), 2 * 480 * 0.02, 0, 0.01);
  }
  assert_int_equal(run("study/schedules/r1-400-regulated.cfg study/schedules/small-steps.csv --metrics"), 0);
  assert_close(figure("dead_band"), 12, 1.2, 0);
  assert_contains(out, "<= 0.2500");
  assert_int_equal(run("study/actuators/r1-400.cfg study/schedules/strokes.csv --metrics"), 0);
  assert_close(figure("energy_in"), 0.04 * 4e5 * 0.02, 0, 1e-6);
}

TEST(test_simulate__json_alone__is_refused)
{
  assert_int_equal(run("@/m.cfg --step --json"), 2);
  assert_contains(err, "--json: goes with --metrics");
}

TEST(test_simulate__runs__start_afresh)
{
  assert_int_equal(run("@/runs.cfg @/runs.csv"), 0);
  assert_int_equal(lines_of(out), 5);
  assert_close(cell(3, 0), 0, 0, 0);
  assert_close(cell(3, 2), 0, 1e-9, 0);
  assert_close(cell(4, 2), cell(2, 2), 0, 0);
}

TEST(test_simulate__vessel__fills)
{
  assert_int_equal(run("@/vessel.cfg --step"), 0);
  assert_close(cell(1540, 2), 400, 1, 0);
  assert_close(cell(1540, 3), 0, 0, 0);
}

/* Shut for 0.5 s: a constant flow into a litre makes the pressure rise by q R T/V. */
TEST(test_simulate__flow_of_no_name__fills_while_shut)
{
  scratch_text("unlisted.cfg", "actuator = { stroke = 0; dead_volume = \"1 l\"; };\n"
                               "unlisted = ( { equation = \"flow\"; argument = \"p\"; from = 0; to = 1;\n"
                               "  values = [ 0.01, 0.01 ]; unit = \"g/s\"; } );\n");
  assert_int_equal(run("@/unlisted.cfg --step"), 0);
  assert_close(cell(41, 0), 0.4, 0, 0);
  assert_close(cell(41, 2), 0.4e-3 * 1e-5 * 287.1015193370166 * 298.15 / 1e-3, 0, 1e-6);
}

TEST(test_simulate__pressure_command__is_written_as_one)
{
  scratch_text("band.cfg", "transducer = { proportional_band = \"5 kPa\"; };\n");
  assert_int_equal(run("@/band.cfg --step"), 0);
  assert_int_equal(strncmp(out, "t [s],u [kPa],p [kPa],x [mm]\n", 29), 0);
  assert_close(cell(1540, 1), 400, 0, 0);
  assert_true(cell(1540, 2) > 390 && cell(1540, 2) <= 400);
}

TEST(test_simulate__out__writes_the_file_and_nothing_else)
{
  assert_int_equal(run("--out @/deep/er/o.csv @/m.cfg @/log.csv"), 0);
  assert_string_equal(out, "");
  assert_true(scratch_exists(scratch_path("deep/er/o.csv")));
  assert_false(scratch_exists(scratch_path("deep/er/o.csv.part")));
}

TEST(test_simulate__bad_log__leaves_no_file)
{
  assert_int_equal(run("--out @/torn_out.csv @/m.cfg @/torn.csv"), 1);
  assert_contains(err, "torn.csv:3: expected 3 fields, found 2");
  assert_false(scratch_exists(scratch_path("torn_out.csv")));
  assert_false(scratch_exists(scratch_path("torn_out.csv.part")));
}

TEST(test_simulate__bad_model__is_1_with_line_and_key)
{
  assert_int_equal(run("@/bad.cfg --step"), 1);
  assert_contains(err, "simulate: ");
  assert_contains(err, "bad.cfg:2: actuator.aera: unknown key; the nearest known one is \"area\"");
  assert_string_equal(out, "");
}

TEST(test_simulate__missing_files__are_1)
{
  assert_int_equal(run("@/none.cfg --step"), 1);
  assert_contains(err, "none.cfg: there is no such file");
  assert_int_equal(run("@/m.cfg @/none.csv"), 1);
  assert_contains(err, "none.csv: there is no such file");
}

TEST(test_simulate__bad_usage__is_2)
{
  assert_int_equal(run(""), 2);
  assert_int_equal(run("@/m.cfg"), 2);
  assert_int_equal(run("@/m.cfg @/log.csv --step"), 2);
  assert_int_equal(run("@/m.cfg --stpe"), 2);
  assert_int_equal(lines_of(err), 1);
  assert_contains(err, "--step");
}

TEST(test_simulate__full_disk__is_4)
{
  scratch_device("full", "/dev/full");
  assert_int_equal(run("@/m.cfg --step --out @/full"), 4);
  assert_contains(err, "No space left on device");
}

TEST(test_simulate__unwritable_folder__is_4)
{
  assert_int_equal(run("@/m.cfg --step --out @/m.cfg/o.csv"), 4);
  assert_contains(err, "cannot be");
}

TEST(test_simulate__help_and_version__are_0_on_stdout)
{
  assert_int_equal(run("--help"), 0);
  assert_contains(out, "Usage: simulate");
  assert_int_equal(run("--version"), 0);
  assert_contains(out, "simulate (libpneu)");
  assert_string_equal(err, "");
}
