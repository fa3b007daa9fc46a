/* Blind trials: closeloop against rigs whose answer it does not know.
 *
 * Each trial is drawn from its number alone, simulated by the independent rig of tests/second, given to closeloop as
 * files, and scored. Nothing here is linked with the library.
 * SPDX-License-Identifier: MIT */
#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <omp.h>

#include "../../apps/lab/base/checksum.h"
#include "../../apps/lab/base/cli.h"
#include "../../apps/lab/base/names.h"
#include "../../apps/lab/base/outfile.h"
#include "../../apps/lab/base/progress.h"
#include "journal.h"
#include "limit.h"
#include "prepare.h"
#include "recorded_score.h"
#include "recorded_summary.h"
#include "summary.h"

enum { PATHS = 512, TRIALS_MAX = 1000000 };

static const char *closeloop = "./closeloop", *out = "results", *work = "build/blind", *keep, *wanted = "blind";
static const char *logs, *without = "";
static unsigned left_out; /* bits of `without` */
static int trials = 500, seed = 1, jobs, only = -1, check, timeout;

/* What sets the trials of a series apart. */
static const struct series {
  const char *name; /* also of its files */
  const char *what;
  int only_nothing; /* those trials alone in which nothing is missing */
  int tells_noise;
  int recorded; /* with what benches and plants do to a log: recorded.h */
  int timeout;  /* s of CPU */
} all_series[] = {
    {"blind", "", 0, 1, 0, 120},
    {"blind_nothing", "Drawn as the others, but only those in which nothing is missing. ", 1, 1, 0, 120},
    {"blind_noise", "The rig files do not say how large the noise is: closeloop finds it in the log. ", 0, 0, 0, 120},
    {"blind_recorded", "", 0, 0, 1, 30},
};
enum { SERIES = sizeof all_series / sizeof all_series[0] };
static const struct series *series = all_series;

static const lab_option options[] = {
    {"trials", LAB_OPTION_COUNT, &trials, "N", "numbers 0 to N - 1, those of them that the series takes (500)", 1,
     TRIALS_MAX},
    {"series", LAB_OPTION_TEXT, &wanted, "NAME",
     "blind (all), blind_nothing (nothing missing), blind_noise (noise not told), blind_recorded (as recorded)", 0, 0},
    {"without", LAB_OPTION_TEXT, &without, "NAMES", "of blind_recorded: imperfections to leave out: positioner,drift",
     0, 0},
    {"logs", LAB_OPTION_TEXT, &logs, "DIR", "of blind_recorded: write its logs and truth.csv there, and ask nothing", 0,
     0},
    {"trial", LAB_OPTION_COUNT, &only, "K", "this one alone: show its truth, the answer and the score", 0, TRIALS_MAX},
    {"seed", LAB_OPTION_COUNT, &seed, "N", "of everything that is drawn (1)", 0, 1000000},
    {"closeloop", LAB_OPTION_TEXT, &closeloop, "FILE", "the program to be tried (./closeloop)", 0, 0},
    {"out", LAB_OPTION_TEXT, &out, "DIR", "where <series>.csv and <series>.md go (results)", 0, 0},
    {"work", LAB_OPTION_TEXT, &work, "DIR", "journal and logs of the trials under way (build/blind)", 0, 0},
    {"keep", LAB_OPTION_TEXT, &keep, "DIR", "leave the files of every trial there", 0, 0},
    {"timeout", LAB_OPTION_COUNT, &timeout, "S",
     "seconds of CPU that closeloop has for one trial (120; blind_recorded 30)", 1, 1000000},
    {"jobs", LAB_OPTION_COUNT, &jobs, "N", "trials at once; default: one a core", 1, 1024},
    {"check", LAB_OPTION_FLAG, &check, NULL, "exit status 1 if a count speaks against a bar", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "blind", "", "Draw rigs with and without something missing, let closeloop find it, count how often it is right.",
    options, 0,  0};

/* ---- One trial ---- */

/* Remove a folder of files. */
static void remove_folder(const char *path)
{
  DIR *folder = opendir(path);
  struct dirent *entry;
  char inner[PATHS + 300];
  while (folder && (entry = readdir(folder))) {
    snprintf(inner, sizeof inner, "%s/%s", path, entry->d_name);
    unlink(inner);
  }
  if (folder)
    closedir(folder);
  rmdir(path);
}

/* Write its logs, ask, score. */
static int one_clean(int number, const char *folder, blind_record *record, lab_error *error)
{
  blind_trial t;
  blind_answer answer;
  double limit[BLIND_AT_ONCE], statistic;
  int i;
  blind_draw((uint64_t)seed, number, &t);
  t.tells_noise = series->tells_noise;
  if (blind_write_logs(&t, folder, error))
    return error->status;
  for (i = 0; i < t.n_missing; i++)
    if (blind_limit(&t, i, &limit[i], &statistic, error))
      return error->status;
  if (blind_ask(closeloop, folder, timeout, &answer, error))
    return error->status;
  blind_score(&t, limit, &answer, record);
  return LAB_OK;
}

static int one_recorded(int number, const char *folder, blind_record *record, lab_error *error)
{
  blind_recorded r;
  blind_answer answer;
  blind_visible visible;
  size_t rows;
  blind_draw_recorded((uint64_t)seed, number, left_out, &r);
  if (blind_prepare(&r, folder, &rows, &visible, error) || blind_ask(closeloop, folder, timeout, &answer, error))
    return error->status;
  blind_score_recorded(&r, &visible, &answer, rows, record);
  return LAB_OK;
}

static int one(int number, blind_record *record, lab_error *error)
{
  char folder[PATHS];
  int status;
  snprintf(folder, sizeof folder, "%s/trial-%d", keep ? keep : work, number);
  status = (series->recorded ? one_recorded : one_clean)(number, folder, record, error);
  if (!keep)
    remove_folder(folder);
  return status == LAB_OK ? LAB_OK : lab_fail_in(error, "trial %d", number);
}

static int show_one(lab_error *error)
{
  blind_record record;
  if (one(only, &record, error))
    return error->status;
  blind_record_header(stdout, series->recorded);
  blind_record_write(stdout, &record, series->recorded);
  return LAB_OK;
}

/* ---- All of them ---- */

static int belongs(int number)
{
  return !series->only_nothing || blind_kind_of(number) == BLIND_NOTHING;
}

static int run_all(int quiet, blind_journal *journal, lab_error *error)
{
  lab_progress progress;
  int k, left = 0, done = 0, status = LAB_OK;
  char *todo = calloc((size_t)trials, 1);
  if (!todo)
    return lab_fail_memory(error, "trials");
  for (k = 0; k < trials; k++)
    left += todo[k] = (char)(belongs(k) && !blind_journal_has(journal, k));
  lab_progress_begin(&progress, "blind trials", quiet);
#pragma omp parallel for schedule(dynamic) num_threads(jobs ? jobs : omp_get_max_threads())
  for (k = 0; k < trials; k++) {
    blind_record record;
    lab_error mine;
    int failed;
    if (!todo[k] || status != LAB_OK)
      continue;
    failed = one(k, &record, &mine);
#pragma omp critical(blind_journal)
    {
      if (!failed)
        failed = blind_journal_add(journal, &record, &mine);
      if (failed) {
        status = failed;
        *error = mine;
      }
      lab_progress_count(&progress, ++done, left, 0);
    }
  }
  lab_progress_end(&progress);
  free(todo);
  blind_journal_sort(journal);
  return status;
}

static int write_csv(const blind_journal *j, lab_error *error)
{
  char path[PATHS];
  lab_outfile file;
  int i;
  snprintf(path, sizeof path, "%s/%s.csv", out, series->name);
  if (lab_out_open(&file, path, error))
    return error->status;
  blind_record_header(file.file, series->recorded);
  for (i = 0; i < j->n; i++)
    blind_record_write(file.file, &j->record[i], series->recorded);
  return lab_out_close(&file, error);
}

static int write_md(const blind_journal *j, lab_error *error)
{
  char path[PATHS];
  lab_outfile file;
  int failed;
  snprintf(path, sizeof path, "%s/%s.md", out, series->name);
  if (lab_out_open(&file, path, error))
    return error->status;
  failed = series->recorded ? blind_recorded_summary_write(file.file, j->record, j->n, (uint64_t)seed, timeout)
                            : blind_summary_write(file.file, j->record, j->n, (uint64_t)seed, series->what);
  return lab_out_end(&file, failed ? lab_fail_memory(error, "the summary") : LAB_OK, error);
}

/* A line for each bar.  Returns: how many are refuted */
static int say_bars(const blind_journal *j)
{
  const blind_bar_list *bars = series->recorded ? &blind_recorded_bars : &blind_bars;
  int i, refuted = 0;
  for (i = 0; i < bars->n; i++) {
    const blind_bar *bar = &bars->bar[i];
    const blind_count c = blind_bar_counts(bars, i, j->record, j->n);
    const int word = blind_bar_word(bar, c);
    refuted += bar->at_least >= 0 && word == BLIND_BAR_REFUTED;
    printf("%-70s %3d of %3d", bar->what, c.k, c.n);
    if (bar->at_least >= 0)
      printf("  (%s %g %%)%s", bar->at_least ? "at least" : "at most", 100 * bar->share,
             word >= BLIND_BAR_REACHED ? "" : "  MISSED");
    printf("\n");
  }
  return refuted;
}

/* ---- Logs alone ---- */

static int one_log(int number, size_t *rows, lab_error *error)
{
  blind_recorded r;
  char folder[PATHS];
  blind_draw_recorded((uint64_t)seed, number, left_out, &r);
  snprintf(folder, sizeof folder, "%s/trial-%d", logs, number);
  return blind_write_recorded(&r, folder, rows, error) ? lab_fail_in(error, "trial %d", number) : LAB_OK;
}

static int write_truths(const size_t *rows, lab_error *error)
{
  blind_recorded r;
  lab_outfile file;
  char path[PATHS];
  int k;
  snprintf(path, sizeof path, "%s/truth.csv", logs);
  if (lab_out_open(&file, path, error))
    return error->status;
  blind_truth_header(file.file);
  for (k = 0; k < trials; k++) {
    blind_draw_recorded((uint64_t)seed, k, left_out, &r);
    blind_truth_write(file.file, &r, rows[k]);
  }
  return lab_out_close(&file, error);
}

/* Logs and rig files of the trials as recorded, one folder each, and what is true of them. */
static int write_all_logs(lab_error *error)
{
  size_t *rows = calloc((size_t)trials, sizeof *rows);
  int k;
  if (!rows)
    return lab_fail_memory(error, "trials");
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic) num_threads(jobs ? jobs : omp_get_max_threads())
  for (k = 0; k < trials; k++) {
    lab_error mine;
    if (one_log(k, &rows[k], &mine) == LAB_OK)
      continue;
#pragma omp critical(blind_logs)
    *error = mine;
  }
  if (error->status == LAB_OK)
    write_truths(rows, error);
  free(rows);
  return error->status;
}

static int choose_series(lab_error *error)
{
  const int found = lab_name_index(wanted, all_series, SERIES, sizeof all_series[0]);
  if (found < 0)
    return lab_fail(error, LAB_USAGE, "--series: unknown series \"%s\"; the nearest known one is %s", wanted,
                    lab_name_nearest(wanted, all_series, SERIES, sizeof all_series[0]));
  series = &all_series[found];
  timeout = timeout ? timeout : series->timeout;
  return LAB_OK;
}

static int run(const lab_cli *cli, const char *self, lab_error *error)
{
  blind_journal journal;
  char path[PATHS], key[200];
  int status = choose_series(error);
  if (status != LAB_OK)
    return status;
  if (!blind_imperfections_read(without, &left_out))
    return lab_fail(error, LAB_USAGE, "--without: \"%s\": not names of imperfections with commas between them",
                    without);
  if (logs)
    return write_all_logs(error);
  if (access(closeloop, X_OK))
    return lab_fail(error, LAB_WORLD, "%s: %s; name the program with --closeloop", closeloop, strerror(errno));
  if (only >= 0)
    return show_one(error);
  snprintf(path, sizeof path, "%s/%s-journal.csv", work, series->name);
  snprintf(key, sizeof key,
           "# seed %d, without \"%s\", timeout %d s of CPU, closeloop %016" PRIx64 ", blind %016" PRIx64, seed, without,
           timeout, lab_checksum_file(LAB_CHECKSUM_SEED, closeloop), lab_checksum_file(LAB_CHECKSUM_SEED, self));
  status = blind_journal_open(&journal, path, key, trials, series->recorded, error);
  if (status == LAB_OK)
    status = run_all(cli->quiet, &journal, error);
  if (status == LAB_OK)
    status = write_csv(&journal, error);
  if (status == LAB_OK)
    status = write_md(&journal, error);
  if (status == LAB_OK && say_bars(&journal) && check)
    status = lab_fail(error, LAB_DATA, "the trials speak against a bar; %s/%s.md lists them", out, series->name);
  blind_journal_close(&journal);
  return status;
}

int main(int argc, char **argv)
{
  lab_error error;
  lab_cli cli;
  int status = lab_cli_read(&program, argc, argv, &cli, &error);
  if (status == LAB_OK && !cli.done)
    status = run(&cli, argv[0], &error);
  return status == LAB_OK ? 0 : lab_cli_report(&program, &error);
}
