/* apps/lab/base/cli and progress */
#include "../../scratch.h"

#include <omp.h>

#include "../../../apps/lab/base/cli.h"
#include "../../../apps/lab/base/progress.h"

static int flag, count;
static double real;
static const char *text;
static lab_cli cli;

static const lab_option options[] = {{"out", LAB_OPTION_TEXT, &text, "FILE", "where to write", 0, 0},
                                     {"step", LAB_OPTION_FLAG, &flag, NULL, "the standard experiment", 0, 0},
                                     {"grid", LAB_OPTION_COUNT, &count, "N", "points", 2, 50},
                                     {"tol", LAB_OPTION_REAL, &real, "X", "tolerance", 1e-9, 1},
                                     {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {"sample", "MODEL.cfg [LOG.csv]", "Does nothing, for a test.", options, 1, 2};

/* Read a command line written as words with blanks between them. */
static int read_line(const char *line)
{
  static char copy[256];
  static char *argv[32];
  int argc = 0;
  char *word;
  snprintf(copy, sizeof copy, "sample %s", line);
  for (word = strtok(copy, " "); word && argc < 31; word = strtok(NULL, " "))
    argv[argc++] = word;
  argv[argc] = NULL;
  flag = 0, count = 7, real = 0.5, text = "default";
  return lab_cli_read(&program, argc, argv, &cli, &error);
}

static void assert_usage(const char *line, const char *words)
{
  assert_fails(read_line(line), LAB_USAGE, words);
}

TEST(test_lab_cli_read__all_options__set_their_values)
{
  assert_int_equal(read_line("--out o.csv --step --grid 12 --tol 1e-3 --quiet m.cfg"), LAB_OK);
  assert_string_equal(text, "o.csv");
  assert_int_equal(flag, 1);
  assert_int_equal(count, 12);
  assert_close(real, 1e-3, 0, 0);
  assert_int_equal(cli.quiet, 1);
  assert_int_equal(cli.done, 0);
  assert_int_equal(cli.n_operands, 1);
  assert_string_equal(cli.operand[0], "m.cfg");
}

TEST(test_lab_cli_read__o__is_out)
{
  assert_int_equal(read_line("-o o.csv m.cfg"), LAB_OK);
  assert_string_equal(text, "o.csv");
  assert_usage("m.cfg -o", "-o");
}

TEST(test_lab_cli_read__no_options__keeps_the_defaults)
{
  assert_int_equal(read_line("m.cfg"), LAB_OK);
  assert_string_equal(text, "default");
  assert_int_equal(flag, 0);
  assert_int_equal(count, 7);
  assert_int_equal(cli.quiet, 0);
  assert_int_equal(cli.threads, 0);
}

TEST(test_lab_cli_read__options_between_operands__are_found)
{
  assert_int_equal(read_line("m.cfg --out=x l.csv --step"), LAB_OK);
  assert_string_equal(text, "x");
  assert_int_equal(flag, 1);
  assert_int_equal(cli.n_operands, 2);
  assert_string_equal(cli.operand[1], "l.csv");
}

TEST(test_lab_cli_read__two_dashes__end_the_options)
{
  assert_int_equal(read_line("-- --step"), LAB_OK);
  assert_int_equal(flag, 0);
  assert_string_equal(cli.operand[0], "--step");
}

TEST(test_lab_cli_read__threads__reach_openmp)
{
  int before = omp_get_max_threads();
  assert_int_equal(read_line("--threads 3 m.cfg"), LAB_OK);
  assert_int_equal(cli.threads, 3);
  assert_int_equal(omp_get_max_threads(), 3);
  omp_set_num_threads(before);
}

TEST(test_lab_cli_read__unknown_option__names_the_nearest)
{
  assert_usage("--stepp m.cfg", "--stepp: unknown or ambiguous option; the nearest known one is --step");
  assert_usage("m.cfg --quit", "--quiet");
  assert_usage("-x m.cfg", "-x");
}

TEST(test_lab_cli_read__argument_missing_or_too_many__is_said)
{
  assert_usage("m.cfg --out", "--out: expected an argument");
  assert_usage("m.cfg --step=5", "--step=5");
}

TEST(test_lab_cli_read__bad_number__gives_the_bounds)
{
  assert_usage("--grid 1 m.cfg", "--grid: expected a whole number, 2 to 50, found \"1\"");
  assert_usage("--grid 51 m.cfg", "found \"51\"");
  assert_usage("--grid 2.5 m.cfg", "found \"2.5\"");
  assert_usage("--grid 12x m.cfg", "found \"12x\"");
  assert_usage("--grid nan m.cfg", "found \"nan\"");
  assert_usage("--tol 2 m.cfg", "--tol: expected a number, 1e-09 to 1, found \"2\"");
  assert_usage("--threads 0 m.cfg", "--threads");
  assert_usage("--threads -1 m.cfg", "--threads");
}

TEST(test_lab_cli_read__wrong_number_of_operands__is_said)
{
  assert_usage("", "expected MODEL.cfg [LOG.csv], found 0 operands");
  assert_usage("a b c", "found 3 operands");
}

/* Standard output while a command line is read, to be freed. */
static char *output_of(const char *line)
{
  char path[512];
  int kept, status;
  strcpy(path, scratch_path("stdout"));
  fflush(stdout);
  kept = dup(STDOUT_FILENO);
  assert_non_null(freopen(path, "w", stdout));
  status = read_line(line);
  fflush(stdout);
  dup2(kept, STDOUT_FILENO);
  close(kept);
  assert_int_equal(status, LAB_OK);
  return scratch_read(path);
}

TEST(test_lab_cli_read__help__lists_every_option)
{
  char *shown = output_of("--help");
  const char *words[] = {"Usage: sample MODEL.cfg [LOG.csv]",
                         "--out FILE",
                         "--step",
                         "--grid N",
                         "--tol X",
                         "--threads N",
                         "--quiet",
                         "--help",
                         "--version",
                         "where to write",
                         "Exit status"};
  size_t i;
  assert_int_equal(cli.done, 1);
  for (i = 0; i < sizeof words / sizeof words[0]; i++)
    assert_contains(shown, words[i]);
  free(shown);
}

TEST(test_lab_cli_read__version__names_program_and_library)
{
  char *shown = output_of("--version");
  assert_int_equal(cli.done, 1);
  assert_contains(shown, "sample (libpneu) ");
  free(shown);
}

TEST(test_lab_progress_count__no_terminal_or_quiet__writes_nothing)
{
  lab_progress progress;
  lab_progress_begin(&progress, "fit", 1);
  assert_null(progress.stream);
  lab_progress_count(&progress, 1, 2, 0);
  lab_progress_end(&progress);
  assert_int_equal(progress.written, 0);
  lab_progress_begin(&progress, "fit", 0);
  assert_int_equal(progress.stream != NULL, isatty(STDERR_FILENO));
}

/* A progress that writes to a file and thinks that a second has gone by. */
static lab_progress begin_in(FILE *file)
{
  lab_progress progress;
  lab_progress_begin(&progress, "fit", 0);
  progress.stream = file;
  progress.start -= 1;
  progress.shown -= 1;
  return progress;
}

TEST(test_lab_progress_count__half_done__tells_time_to_go_and_clears)
{
  char path[512], *shown;
  FILE *file;
  lab_progress progress;
  strcpy(path, scratch_path("progress"));
  file = fopen(path, "w");
  assert_non_null(file);
  progress = begin_in(file);
  lab_progress_count(&progress, 50, 100, 0);
  lab_progress_count(&progress, 51, 100, 0); /* too soon */
  lab_progress_end(&progress);
  fclose(file);
  shown = scratch_read(path);
  assert_string_equal(shown, "\rfit: 50 of 100, 50 a second, 1 s to go \033[K\r\033[K");
  free(shown);
}
