/* closeloop: which effect does a model lack that would explain a log?
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "lab/report/answer.h"
#include "lab/trace/decide.h"
#include "lab/batch/batch.h"
#include "lab/rig/draft.h"
#include "lab/rig/sheetwords.h"
#include "lab/base/cli.h"
#include "lab/base/escape.h"
#include "lab/base/interrupt.h"
#include "lab/base/outfile.h"
#include "lab/base/progress.h"
#include "lab/base/text.h"

static const char *out, *list, *init;
static lab_texts holdout, baseline, sheet;
static double alpha, min_gain;
static int budget, figures, no_figures, reports, allow_include;

static const int usual_batch_budget = 600; /* [s] of CPU, for a line of a batch */
static const int usual_memory = 4096;      /* [MB] for a line of a batch */
static const int patience = 10;            /* budgets after which even what follows the search is given up */

static const lab_option options[] = {
    {"holdout", LAB_OPTION_TEXTS, &holdout, "LOG.csv[,LOG2.csv]",
     "judge the completed model on these logs, which it has not seen", 0, 0},
    {"baseline", LAB_OPTION_TEXTS, &baseline, "THEN.csv[,THEN2.csv...]",
     "logs of the same rig as it was: say what has changed since", 0, 0},
    {"out", LAB_OPTION_TEXT, &out, "DIR", "write there instead of results/<rig name>, or results/<list name>", 0, 0},
    {"alpha", LAB_OPTION_REAL, &alpha, "P", "chance of naming anything when nothing is missing (0.01)", 1e-9, 0.5},
    {"min-gain", LAB_OPTION_REAL, &min_gain, "SHARE", "error that an effect must save to be added (0.02)", 0, 1},
    {"figures", LAB_OPTION_FLAG, &figures, NULL, "fail where there is no gnuplot to draw the figures as SVG", 0, 0},
    {"no-figures", LAB_OPTION_FLAG, &no_figures, NULL, "write no SVG; the page has its curves all the same", 0, 0},
    {"batch", LAB_OPTION_TEXT, &list, "LIST.csv",
     "many rigs, a line each: header name,rig,log,holdout; several logs: a.csv;b.csv;\n"
     "paths from the list's folder; name and holdout may be left out; # is a comment.\n"
     "A column date gives each rig its history: trends.csv, and a part of the page.\n"
     "Writes DIR/batch.csv, a line each in the list's order, DIR/index.html, the worst\n"
     "first, DIR/batch.cost.csv, and DIR/<name>/report.json. As many logs at once as --threads says. Stopped, it goes "
     "on\n"
     "where it was; a line is done again if its files, options or closeloop changed.\n"
     "A log that fails is a line with verdict \"error\"; the exit status is then that of\n"
     "the worst line",
     0, 0},
    {"reports", LAB_OPTION_FLAG, &reports, NULL, "with --batch: every file of every log, as for a single one", 0, 0},
    {"budget", LAB_OPTION_COUNT, &budget, "SECONDS",
     "CPU time after which the best answer so far is given, marked as such (60); with\n--batch, after which a line "
     "ends "
     "in an error (600)",
     1, 1e7},
    {"init", LAB_OPTION_TEXT, &init, "LOG.csv",
     "write a rig file for this log to standard output, each line with a comment on where its value\ncomes from", 0, 0},
    {"sheet", LAB_OPTION_TEXTS, &sheet, "KEY=VALUE",
     "for a rig file, with --init or alone: what the data sheet says, \"area=400 cm2\",\n"
     "\"bench_set=0.2..1.0 bar\", stroke, fail, supply, Kv, fill.Kv, vent.Qn, tube.length, tube.bore,\n"
     "positioner.gain and the keys of pneu-rig(5), or actuator=fisher-657-40 and\n"
     "positioner=samson-3730 of the catalogue; may be given many times, or once with more KEY=VALUE\n"
     "behind it; without it, a terminal is asked",
     0, 0},
    {"allow-include", LAB_OPTION_FLAG, &allow_include, NULL,
     "with --batch: read rig files that take in others by @include", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "closeloop",
    "RIG.cfg LOG.csv [LOG2.csv ...] | --batch LIST.csv | --init LOG.csv | --sheet KEY=VALUE ...",
    "Fit the declared model to logs of a test bench, trace the residual to a physical effect that the model lacks, add "
    "it, and report the error before and after.",
    options,
    0,
    1 + LAB_LOGS_MAX};

static void on_progress(void *progress, const char *what)
{
  lab_progress_say(progress, what);
}

static int extent(void)
{
  return figures ? LAB_WRITE_FIGURES : no_figures ? LAB_WRITE_PLAIN : LAB_WRITE_DRAWN;
}

/* Write the answer, and say what is not there. */
static int write_answer(const lab_answer *answer, lab_progress *progress, int quiet, lab_error *error)
{
  char name[LAB_NAME_TEXT], folder[LAB_PATH_TEXT];
  const char *to = out ? out : folder;
  int status;
  strcpy(name, answer->rig.name);
  lab_make_file_name(name);
  snprintf(folder, sizeof folder, "results/%s", name);
  lab_progress_say(progress, "writing the report");
  status = lab_answer_write(answer, to, extent(), error);
  lab_progress_end(progress);
  if (status == LAB_OK && extent() == LAB_WRITE_DRAWN && !quiet && !lab_answer_is_there(to, LAB_WRITE_FIGURES))
    fputs("closeloop: no figures as SVG, since gnuplot is not installed (Debian: gnuplot-nox)\n", stderr);
  return status;
}

/* The logs that an option names, separated by commas or given one after the other.
 * Out:     text  of which the names are parts
 * Returns: how many; -1: too many */
static int name_logs(const lab_texts *named, char text[LAB_LOGS_MAX * LAB_PATH_TEXT], const char *log[LAB_LOGS_MAX])
{
  int i;
  *text = '\0';
  for (i = 0; i < named->n; i++)
    lab_append(text, LAB_LOGS_MAX * LAB_PATH_TEXT, "%s%s", i ? "," : "", named->text[i]);
  return lab_split(text, ',', log, LAB_LOGS_MAX);
}

static int run_one(const lab_cli *cli, lab_error *error)
{
  char held_text[LAB_LOGS_MAX * LAB_PATH_TEXT], then_text[LAB_LOGS_MAX * LAB_PATH_TEXT], sentence[LAB_SENTENCE_TEXT];
  const char *held[LAB_LOGS_MAX], *then[LAB_LOGS_MAX];
  lab_progress progress;
  lab_answer *answer;
  lab_request q = {0};
  int status;
  q.rig = cli->operand[0];
  q.log = (const char *const *)cli->operand + 1;
  q.n_logs = cli->n_operands - 1;
  q.holdout = held;
  q.n_holdout = name_logs(&holdout, held_text, held);
  q.baseline = then;
  q.n_baseline = name_logs(&baseline, then_text, then);
  q.alpha = alpha;
  q.min_gain = min_gain;
  q.on_progress = on_progress;
  q.context = &progress;
  if (q.n_holdout < 0)
    return lab_fail(error, LAB_USAGE, "--holdout: more than %d logs", (int)LAB_LOGS_MAX);
  if (q.n_baseline < 0)
    return lab_fail(error, LAB_USAGE, "--baseline: more than %d logs", (int)LAB_LOGS_MAX);
  q.budget = budget ? budget : LAB_USUAL_BUDGET;
  if (!lab_interrupt_after(program.name, patience * (int)q.budget))
    return lab_fail(error, LAB_WORLD, "--budget: this system does not bound CPU time");
  lab_progress_begin(&progress, program.name, cli->quiet);
  status = lab_answer_find(&q, &answer, error);
  if (status == LAB_OK) {
    status = write_answer(answer, &progress, cli->quiet, error);
    lab_report_sentence(&answer->report, sentence);
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
  how.extent = reports ? extent() : LAB_WRITE_JSON;
  how.at_once = cli->threads;
  how.quiet = cli->quiet;
  how.budget = budget ? budget : usual_batch_budget;
  how.memory = usual_memory;
  how.room = LAB_TEXT_MAX;
  how.allow_include = allow_include;
  return lab_batch_run(&how, error);
}

/* What the reader of logs wants written into a rig file, of which there is none yet.  Returns: status */
static int say_how_to_begin(int status, lab_error *error)
{
  if (status == LAB_DATA && strstr(error->text, "rig file"))
    lab_append(error->text, sizeof error->text,
               " (there is no rig file yet: closeloop --sheet name=VALVE > rig.cfg makes one)");
  return status;
}

/* Words of the sheet may stand behind the first as operands; on a terminal they are asked for. */
static int run_init(const lab_cli *cli, lab_error *error)
{
  static lab_sheet_answers answers;
  lab_outfile file;
  int i;
  if (sheet.n == 0 && !cli->quiet && isatty(STDIN_FILENO) && isatty(STDERR_FILENO))
    lab_sheet_ask(stdin, stderr, &answers);
  for (i = 0; i < answers.n; i++)
    sheet.text[sheet.n++] = answers.text[i];
  for (i = 0; i < cli->n_operands && sheet.n < LAB_TEXTS_MAX; i++)
    sheet.text[sheet.n++] = cli->operand[i];
  if (lab_out_open(&file, out, error))
    return error->status;
  return lab_out_end(&file, say_how_to_begin(lab_draft_write(file.file, init, sheet.text, sheet.n, error), error),
                     error);
}

/* What the table of options cannot say. */
static int check_usage(const lab_cli *cli, lab_error *error)
{
  if (init && (list || holdout.n || baseline.n))
    return lab_fail(error, LAB_USAGE, "--init: goes with --sheet and --out alone");
  if (sheet.n && (list || holdout.n || baseline.n))
    return lab_fail(error, LAB_USAGE, "--sheet: goes with --init and --out alone");
  if (init && cli->n_operands && !sheet.n)
    return lab_fail(error, LAB_USAGE, "--init: needs a log, and --sheet before \"%s\": --init LOG.csv --sheet \"%s\"",
                    cli->operand[0], cli->operand[0]);
  if (!list && reports)
    return lab_fail(error, LAB_USAGE, "--reports: goes with --batch; a single run writes everything");
  if (!list && allow_include)
    return lab_fail(error, LAB_USAGE, "--allow-include: goes with --batch; a single run reads what its rig file says");
  if (figures && no_figures)
    return lab_fail(error, LAB_USAGE, "--figures and --no-figures exclude each other");
  if (list && baseline.n)
    return lab_fail(error, LAB_USAGE, "--baseline: does not go with --batch");
  if (list && holdout.n)
    return lab_fail(error, LAB_USAGE, "--holdout: with --batch, the column holdout of the list says it");
  if (init || sheet.n)
    return LAB_OK;
  if (list ? cli->n_operands != 0 : cli->n_operands < 2)
    return lab_fail(error, LAB_USAGE, "expected %s, found %d operands; see --help", program.operands, cli->n_operands);
  return LAB_OK;
}

static int closeloop(const lab_cli *cli, lab_error *error)
{
  if (check_usage(cli, error))
    return error->status;
  if (init || sheet.n)
    return run_init(cli, error);
  return list ? run_batch(cli, error) : run_one(cli, error);
}

int main(int argc, char **argv)
{
  alpha = lab_constant(LAB_ALPHA);
  min_gain = lab_constant(LAB_MIN_GAIN);
  return lab_cli_main(&program, argc, argv, closeloop);
}
