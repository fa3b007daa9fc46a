/* closeloop: which effect does a model lack that would explain a log?
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>

#include "lab/report/answer.h"
#include "lab/batch/batch.h"
#include "lab/base/cli.h"
#include "lab/base/interrupt.h"
#include "lab/base/outfile.h"
#include "lab/base/progress.h"
#include "lab/batch/split.h"

static const char *holdout, *out, *list;
static double alpha = 0.01, min_gain = 0.02;
static int no_figures, reports;

static const lab_option options[] = {
    {"holdout", LAB_OPTION_TEXT, &holdout, "LOG.csv[,LOG2.csv]",
     "judge the completed model on these logs, which it has not seen", 0, 0},
    {"out", LAB_OPTION_TEXT, &out, "DIR", "write there instead of results/<rig name>, or results/<list name>", 0, 0},
    {"alpha", LAB_OPTION_REAL, &alpha, "P", "chance of naming anything when nothing is missing (0.01)", 1e-9, 0.5},
    {"min-gain", LAB_OPTION_REAL, &min_gain, "SHARE", "error that an effect must save to be added (0.02)", 0, 1},
    {"no-figures", LAB_OPTION_FLAG, &no_figures, NULL, "report without figures, without gnuplot", 0, 0},
    {"batch", LAB_OPTION_TEXT, &list, "LIST.csv",
     "many rigs, a line each: header name,rig,log,holdout; several logs: a.csv;b.csv;\n"
     "paths from the list's folder; name and holdout may be left out; # is a comment.\n"
     "Writes DIR/batch.csv, a line each in the list's order, DIR/index.html, the worst\n"
     "first, DIR/batch.cost.csv, and DIR/<name>/report.json. As many logs at once as --threads says. Stopped, it goes on\n"
     "where it was; a line is done again if its files, options or closeloop changed.\n"
     "A log that fails is a line with verdict \"error\"; the exit status is then that of\n"
     "the worst line",
     0, 0},
    {"reports", LAB_OPTION_FLAG, &reports, NULL, "with --batch: every file of every log, as for a single one", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "closeloop",
    "RIG.cfg LOG.csv [LOG2.csv ...] | --batch LIST.csv",
    "Fit the declared model to logs of a test bench, trace the residual to a physical effect that the model lacks, add "
    "it, and report the error before and after.",
    options,
    0,
    1 + LAB_BENCH_LOGS};

static void say(void *progress, const char *what)
{
  lab_progress_say(progress, what);
}

static int write_answer(const lab_answer *answer, lab_error *error)
{
  char folder[LAB_PATH_TEXT];
  snprintf(folder, sizeof folder, "results/%s", answer->rig.name);
  return lab_answer_write(answer, out ? out : folder, no_figures ? LAB_WRITE_PLAIN : LAB_WRITE_FIGURES, error);
}

static int run_one(const lab_cli *cli, lab_error *error)
{
  char held_text[LAB_BENCH_LOGS * LAB_PATH_TEXT], sentence[LAB_SENTENCE_TEXT];
  const char *held[LAB_BENCH_LOGS];
  lab_progress progress;
  lab_answer *answer;
  lab_question q = {0};
  int status;
  snprintf(held_text, sizeof held_text, "%s", holdout ? holdout : "");
  q.rig = cli->operand[0];
  q.log = (const char *const *)cli->operand + 1;
  q.n_logs = cli->n_operands - 1;
  q.holdout = held;
  q.n_holdout = lab_split(held_text, ',', held, LAB_BENCH_LOGS);
  q.alpha = alpha;
  q.min_gain = min_gain;
  q.tell = say;
  q.context = &progress;
  if (q.n_holdout < 0)
    return lab_fail(error, LAB_USAGE, "--holdout: more than %d logs", (int)LAB_BENCH_LOGS);
  lab_progress_begin(&progress, program.name, cli->quiet);
  status = lab_answer_find(&q, &answer, error);
  if (status == LAB_OK) {
    lab_progress_say(&progress, "writing the report");
    status = write_answer(answer, error);
    lab_progress_end(&progress);
    lab_story_sentence(&answer->story, sentence, sizeof sentence);
    if (status == LAB_OK)
      status = lab_out_say(sentence, error);
    lab_answer_free(answer);
  }
  lab_progress_end(&progress);
  return status;
}

static int run_batch(const lab_cli *cli, lab_error *error)
{
  lab_batch_options how = {0};
  how.list = list;
  how.out = out;
  how.alpha = alpha;
  how.min_gain = min_gain;
  how.extent = !reports ? LAB_WRITE_JSON : no_figures ? LAB_WRITE_PLAIN : LAB_WRITE_FIGURES;
  how.at_once = cli->threads;
  how.quiet = cli->quiet;
  return lab_batch_run(&how, error);
}

/* What the table of options cannot say. */
static int check_usage(const lab_cli *cli, lab_error *error)
{
  if (!list && reports)
    return lab_fail(error, LAB_USAGE, "--reports: goes with --batch; a single run writes everything");
  if (list && holdout)
    return lab_fail(error, LAB_USAGE, "--holdout: with --batch, the column holdout of the list says it");
  if (list ? cli->n_operands != 0 : cli->n_operands < 2)
    return lab_fail(error, LAB_USAGE, "expected %s, found %d operands; see --help", program.operands, cli->n_operands);
  return LAB_OK;
}

int main(int argc, char **argv)
{
  lab_error error;
  lab_cli cli;
  int status;
  lab_interrupt_catch();
  status = lab_cli_read(&program, argc, argv, &cli, &error);
  if (status == LAB_OK && !cli.done)
    status = check_usage(&cli, &error);
  if (status == LAB_OK && !cli.done)
    status = list ? run_batch(&cli, &error) : run_one(&cli, &error);
  return status == LAB_OK ? 0 : lab_cli_report(&program, &error);
}
