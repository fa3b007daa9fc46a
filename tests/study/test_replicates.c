/* apps/study/replicates: what a bench repeats, against closed forms */
#include "../scratch.h"

#include "../../apps/lab/base/config.h"

#include "../../apps/study/replicates.h"

/* The repeatability of a set whose folder is that of the test.  In: more  of its group */
static double repeat_of(const char *rig, const char *judged, const char *logs, const char *more)
{
  char text[1024];
  config_t config;
  double repeat;
  snprintf(text, sizeof text, "set = { folder = \".\"; judged = \"%s\"; fit = ( %s ); holdout = ( ); %s };", judged,
           logs, more);
  succeed(lab_config_read(&config, scratch_text("set.cfg", text), &error));
  succeed(replicates_repeat(config_lookup(&config, "set"), rig, scratch_path("."), &repeat, &error));
  config_destroy(&config);
  return repeat;
}

/* A log of the pump's chamber: p [kPa] = level + t, duty on from the second row; its clock is late by `delay` seconds.
 */
static void write_pump(const char *name, double level, double delay)
{
  char text[8192] = "Time,Target,Pressure,PWM\n";
  int i;
  for (i = 0; i < 100; i++)
    snprintf(text + strlen(text), sizeof text - strlen(text), "%.6f,35,%.6f,%d\n", 0.02 * i + delay, level + 0.02 * i,
             i > 0 ? 255 : 0);
  scratch_text(name, text);
}

static const char pump[] = "study/measured/pump-fed-chamber-control.cfg";

TEST(test_replicates__levels_of_three_runs__their_standard_deviation)
{
  write_pump("a.csv", 1, 0);
  write_pump("b.csv", 2, 0);
  write_pump("c.csv", 3, 0);
  assert_close(
      repeat_of(pump, "pressure", "\"a.csv\"", "replicates = ( { logs = ( \"a.csv\", \"b.csv\", \"c.csv\" ); } );"),
      1000, 1e-9, 0);
}

TEST(test_replicates__runs_that_begin_at_other_times__are_aligned_by_the_step)
{
  write_pump("a.csv", 1, 0);
  write_pump("b.csv", 1, 0.37);
  assert_close(
      repeat_of(pump, "pressure", "\"a.csv\"", "replicates = ( { logs = ( \"a.csv\", \"b.csv\" ); steps = \"u\"; } );"),
      0, 1e-6, 0);
}

TEST(test_replicates__no_two_runs__are_not_known)
{
  write_pump("a.csv", 1, 0);
  assert_true(isnan(repeat_of(pump, "pressure", "\"a.csv\"", "")));
}

/* Force of the printed cylinder over strokes of 40 mm in 4 s: twice the pressure, and `scatter` from stroke to stroke.
 */
static void write_strokes(const char *name, double scatter)
{
  FILE *file = fopen(scratch_path(name), "w");
  int i;
  for (i = -15; i < 4000; i++) {
    const int stroke = (i + 400) / 400, up = stroke % 2;
    const double share = fmod(i + 400, 400) / 400, p = 5 + 0.01 * (stroke % 3) * sin(i);
    fprintf(file, "%d\t0\t0\t0\t%.9f\t%.9f\t%.9f\n", 10 * (i + 15), 40 * (up ? share : 1 - share), p,
            (up ? 10 : -10) + 2 * p + ((stroke / 2) % 2 ? scatter : -scatter));
  }
  fclose(file);
}

TEST(test_replicates__strokes__paired_by_direction_less_the_measured_pressure)
{
  double repeat;
  write_strokes("s.csv", 0.5);
  repeat = repeat_of("study/measured/printed-cylinder-napn.cfg", "force", "\"s.csv\"",
                     "replicates = ( { logs = ( \"s.csv\" ); strokes = \"x\"; } );");
  assert_between(repeat, 0.5,
                 0.6); /* of five strokes a side, two by three or so: 2 a b / (n (n - 1)) pairs differ by 1 */
  write_strokes("s.csv", 0);
  assert_between(repeat_of("study/measured/printed-cylinder-napn.cfg", "force", "\"s.csv\"",
                           "replicates = ( { logs = ( \"s.csv\" ); strokes = \"x\"; } );"),
                 0, 1e-3);
}

TEST(test_replicates__channel_that_is_not_there__is_refused)
{
  config_t config;
  double repeat;
  write_pump("a.csv", 1, 0);
  lab_config_read(&config,
                  scratch_text("set.cfg", "set = { folder = \".\"; judged = \"pressure\"; fit = ( ); holdout = ( ); "
                                          "replicates = ( { logs = ( \"a.csv\" ); steps = \"T\"; } ); };"),
                  &error);
  assert_fails(replicates_repeat(config_lookup(&config, "set"), pump, scratch_path("."), &repeat, &error), LAB_DATA,
               "has no channel T");
  config_destroy(&config);
}
