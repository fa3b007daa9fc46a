/* closeloop: which effect does a model lack that would explain a log?
 * SPDX-License-Identifier: MIT */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "lab/advise.h"
#include "lab/cli.h"
#include "lab/interrupt.h"
#include "lab/log.h"
#include "lab/loop.h"
#include "lab/loopfiles.h"
#include "lab/mend.h"
#include "lab/outfile.h"
#include "lab/progress.h"
#include "lab/report_html.h"
#include "lab/plausible.h"
#include "lab/thin.h"

enum { LOG_MAX = LAB_STORY_HELD, RUN_MAX = 256 };

static const char *holdout, *out;
static double alpha = 0.01, min_gain = 0.02;
static int no_figures;
static lab_progress progress;

static const lab_option options[] = {
    {"holdout", LAB_OPTION_TEXT, &holdout, "LOG.csv[,LOG2.csv]",
     "judge the completed model on these logs, which it has not seen", 0, 0},
    {"out", LAB_OPTION_TEXT, &out, "DIR", "write there instead of results/<rig name>", 0, 0},
    {"alpha", LAB_OPTION_REAL, &alpha, "P", "chance of naming anything when nothing is missing (0.01)", 1e-9, 0.5},
    {"min-gain", LAB_OPTION_REAL, &min_gain, "SHARE", "error that an effect must save to be added (0.02)", 0, 1},
    {"no-figures", LAB_OPTION_FLAG, &no_figures, NULL, "report without figures, without gnuplot", 0, 0},
    {NULL, 0, NULL, NULL, NULL, 0, 0}};

static const lab_program program = {
    "closeloop",
    "RIG.cfg LOG.csv [LOG2.csv ...]",
    "Fit the declared model to logs of a test bench, trace the residual to a physical effect that the model lacks, add "
    "it, and report the error before and after.",
    options,
    2,
    1 + LOG_MAX};

/* The logs of a run of the program, and an experiment for each of their runs. */
typedef struct bench {
  lab_log log[LOG_MAX];
  int n_logs;
  lab_experiment experiment[RUN_MAX];
  int n;
  lab_content content;
  lab_remarks remarks;
} bench;

/* The logs to fit, and the one held out. */
static bench fitted, held;

static void close_bench(bench *b)
{
  while (b->n > 0)
    lab_experiment_close(&b->experiment[--b->n]);
  while (b->n_logs > 0)
    lab_log_free(&b->log[--b->n_logs]);
}

/* Read a log, leave out what is no measurement, and see that it makes sense on this rig. */
static int read_log(const lab_rig *rig, const char *path, bench *b, lab_error *error)
{
  lab_log *log = &b->log[b->n_logs];
  if (lab_log_read(path, &rig->log, (double)rig->params.ambient_pressure, log, error))
    return error->status;
  b->n_logs++;
  lab_log_thin(log, LAB_THIN_ROWS, &b->remarks);
  if (lab_log_mend(rig, log, &b->remarks, error))
    return error->status;
  return lab_plausible(rig, log, &b->remarks, &b->content, error);
}

static int add_log(const lab_rig *rig, const char *path, bench *b, lab_error *error)
{
  lab_log *log = &b->log[b->n_logs];
  size_t run;
  if (read_log(rig, path, b, error))
    return error->status;
  for (run = 0; run < log->n_runs; run++) {
    if (b->n == RUN_MAX)
      return lab_fail(error, LAB_DATA, "%s: more than %d runs in all", path, (int)RUN_MAX);
    if (lab_experiment_open(rig, log, run, &b->experiment[b->n++], error))
      return error->status;
  }
  return LAB_OK;
}

/* Error of a model on runs. Nothing that the logs share is fitted; what each log has for itself is, and so are the
 * instants at which the command changed, within the row that shows each. */
static int judge(const lab_rig *model, lab_experiment *run, int n, lab_errors *errors, lab_error *error)
{
  static lab_unknowns u;
  lab_rig own = *model;
  int j;
  for (own.n_fit = j = 0; j < model->n_fit; j++)
    if (model->fit_per_log[j]) {
      own.fit_per_log[own.n_fit] = 1;
      own.fit[own.n_fit++] = model->fit[j];
    }
  if (lab_unknowns_open(&own, run, n, &u, error))
    return error->status;
  if (u.n > 0 && lab_unknowns_fit(&u, LAB_FIT_WHOLE, NULL, error))
    return error->status;
  return lab_loop_errors(&u, errors, error);
}

/* Read each held-out log of the list "a.csv,b.csv". */
static int add_held_out(const lab_rig *rig, const char *list, lab_error *error)
{
  static lab_rig own; /* the experiments keep it */
  int status = LAB_OK;
  own = *rig;
  lab_log_format_hold_out(&own.log);
  while (status == LAB_OK && *list) {
    char path[LAB_PATH_TEXT];
    const size_t length = strcspn(list, ",");
    snprintf(path, sizeof path, "%.*s", (int)length, list);
    status = held.n_logs < LOG_MAX ? add_log(&own, path, &held, error)
                                   : lab_fail(error, LAB_DATA, "more than %d logs held out", (int)LOG_MAX);
    list += length + (list[length] == ',');
  }
  return status;
}

/* Errors on each log held out, by itself. */
static int judge_logs(lab_story *story, lab_error *error)
{
  int i, first = 0;
  for (i = 0; i < held.n_logs; i++) {
    lab_held *log = &story->held[i];
    int n = 0;
    while (first + n < held.n && held.experiment[first + n].log == &held.log[i])
      n++;
    log->path = held.log[i].path;
    if (judge(&story->declared->rig, &held.experiment[first], n, &log->before, error) ||
        judge(&story->completed->rig, &held.experiment[first], n, &log->after, error))
      return error->status;
    first += n;
  }
  story->n_held = held.n_logs;
  return LAB_OK;
}

/* Errors of the models on the way there, on the logs that they were fitted to. */
static int retrace(lab_story *story, lab_error *error)
{
  int i;
  for (i = 0; i < story->result->n_path; i++)
    if (judge(&story->result->path[i].rig, fitted.experiment, fitted.n, &story->fitted_path[i], error))
      return error->status;
  return LAB_OK;
}

/* A model that cannot follow the held-out log has no error on it; that is said, and the rest is written. */
static int hold_out(lab_story *story, lab_error *error)
{
  int i, status;
  if (held.n == 0)
    return LAB_OK;
  lab_progress_say(&progress, "judging on the held-out log");
  status = judge(&story->declared->rig, held.experiment, held.n, &story->holdout_before, error);
  if (status == LAB_OK)
    status = judge(&story->completed->rig, held.experiment, held.n, &story->holdout_after, error);
  for (i = 0; i < story->result->n_path && status == LAB_OK; i++)
    status = judge(&story->result->path[i].rig, held.experiment, held.n, &story->holdout_path[i], error);
  if (status == LAB_OK)
    status = judge_logs(story, error);
  story->has_holdout = status == LAB_OK;
  if (status != LAB_NUMERIC)
    return status;
  lab_remark(&fitted.remarks, "held-out log not judged: %s", error->text);
  return LAB_OK;
}

/* Figures, if wanted, and the page around them. */
static int write_page(const lab_story *story, const char *folder, lab_error *error)
{
  lab_evidence evidence;
  lab_figures figures = {0};
  int status = lab_evidence_collect(story, &evidence, error);
  if (status == LAB_OK && !no_figures)
    status = lab_figures_draw(story, &evidence, &figures, error);
  if (status == LAB_OK)
    status = lab_figures_write(&figures, folder, error);
  if (status == LAB_OK)
    status = lab_report_html(story, &evidence, &figures, folder, error);
  lab_figures_free(&figures);
  lab_evidence_free(&evidence);
  return status;
}

static int write_files(const lab_story *story, const char *folder, lab_error *error)
{
  if (lab_make_folder(folder, error) || lab_story_residual(story, folder, error) ||
      lab_story_model(story, folder, error) || lab_story_header(story, folder, error) ||
      lab_story_json(story, folder, error))
    return error->status;
  return write_page(story, folder, error);
}

/* All files at once, as far as Ctrl-C is concerned. */
static int write_story(const lab_story *story, lab_error *error)
{
  char folder[LAB_PATH_TEXT];
  int status;
  snprintf(folder, sizeof folder, "results/%s", story->rig->name);
  if (out)
    snprintf(folder, sizeof folder, "%s", out);
  lab_interrupt_hold();
  status = write_files(story, folder, error);
  lab_interrupt_release();
  return status;
}

static double seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void say(void *context, const char *what)
{
  (void)context;
  lab_progress_say(&progress, what);
}

/* The loop's result where the log cannot carry a name: the fit, and nothing traced. */
static int decline(lab_unknowns *u, lab_loop_result *result, lab_error *error)
{
  if (lab_loop_errors(u, &result->before, error))
    return error->status;
  result->after = result->before;
  result->verdict = LAB_VERDICT_UNDECIDED;
  return lab_unknowns_spread(u, &result->fit, error);
}

static int close_loop(const lab_rig *rig, lab_error *error)
{
  static lab_unknowns declared, completed;
  static lab_loop_result result;
  lab_loop_options how;
  static lab_story story;
  const double start = seconds();
  char sentence[LAB_SENTENCE_TEXT];
  int status;
  story.rig = rig;
  story.declared = &declared;
  story.completed = &completed;
  story.result = &result;
  story.remarks = &fitted.remarks;
  lab_loop_options_default(&how);
  how.tell = say;
  how.alpha = alpha;
  how.min_gain = min_gain;
  lab_progress_say(&progress, "fitting the declared model");
  if (lab_unknowns_open(rig, fitted.experiment, fitted.n, &declared, error) ||
      lab_unknowns_fit(&declared, LAB_FIT_WHOLE, NULL, error))
    return error->status;
  story.fit_s = seconds() - start;
  completed = declared;
  if (fitted.remarks.doubt ? decline(&completed, &result, error) : lab_loop_run(&completed, &how, &result, error))
    return error->status;
  story.trace_s = result.trace_s;
  if (retrace(&story, error) || hold_out(&story, error))
    return error->status;
  lab_progress_say(&progress, "looking for the test to record next");
  if (lab_advise(&story, error))
    return error->status;
  story.total_s = seconds() - start;
  lab_progress_say(&progress, "writing the report");
  status = write_story(&story, error);
  lab_progress_end(&progress);
  lab_story_sentence(&story, sentence, sizeof sentence);
  puts(sentence);
  return status;
}

/* Read every log before any fit, so that a bad one costs no waiting. */
static int read_logs(const lab_cli *cli, const lab_rig *rig, lab_error *error)
{
  int i;
  for (i = 1; i < cli->n_operands; i++)
    if (add_log(rig, cli->operand[i], &fitted, error))
      return error->status;
  if (lab_plausible_content(rig, &fitted.content, &fitted.remarks, error))
    return error->status;
  if (holdout && add_held_out(rig, holdout, error))
    return error->status;
  lab_remarks_join(&fitted.remarks, &held.remarks);
  return LAB_OK;
}

static int run(const lab_cli *cli, lab_error *error)
{
  static lab_rig rig;
  int status;
  lab_progress_begin(&progress, program.name, cli->quiet);
  lab_progress_say(&progress, "reading");
  status = lab_rig_read(cli->operand[0], &rig, error);
  if (status == LAB_OK)
    status = read_logs(cli, &rig, error);
  if (status == LAB_OK)
    status = close_loop(&rig, error);
  close_bench(&fitted);
  close_bench(&held);
  lab_progress_end(&progress);
  return status;
}

int main(int argc, char **argv)
{
  lab_error error;
  lab_cli cli;
  int status;
  lab_interrupt_catch();
  status = lab_cli_read(&program, argc, argv, &cli, &error);
  if (status == LAB_OK && !cli.done)
    status = run(&cli, &error);
  return status == LAB_OK ? 0 : lab_cli_report(&program, &error);
}
