#include "answer.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "advise.h"
#include "../fit/outliers.h"
#include "../metrics/appraise.h"
#include "../base/interrupt.h"
#include "../base/outfile.h"
#include "report_html.h"
#include "../base/text.h"
#include "../base/clock.h"
#include "../trace/second_look.h"

static void tell(const lab_question *q, const char *what)
{
  if (q->tell)
    q->tell(q->context, what);
}

/* ---- Reading ---- */

static int read_held_out(const lab_question *q, lab_answer *a, lab_error *error)
{
  int i;
  a->rig_held = a->rig;
  lab_log_format_hold_out(&a->rig_held.log);
  for (i = 0; i < q->n_holdout; i++)
    if (lab_bench_add(&a->held, &a->rig_held, q->holdout[i], error))
      return error->status;
  lab_remarks_join(&a->fitted.remarks, &a->held.remarks);
  return LAB_OK;
}

/* Read every log before any fit, so that a bad one costs no waiting. */
static int read_files(const lab_question *q, lab_answer *a, lab_error *error)
{
  int i;
  tell(q, "reading");
  if (lab_rig_read(q->rig, &a->rig, error))
    return error->status;
  for (i = 0; i < q->n_logs; i++)
    if (lab_bench_add(&a->fitted, &a->rig, q->log[i], error))
      return error->status;
  if (lab_plausible_content(&a->rig, &a->fitted.content, &a->fitted.remarks, error))
    return error->status;
  return read_held_out(q, a, error);
}

/* ---- Judging ---- */

/* Fit to runs what each log has for itself, and the instants at which the command changed, within the row that shows
 * each; nothing that the logs share. */
static int fit_own(const lab_rig *model, const lab_experiment *run, int n, lab_unknowns *u, lab_error *error)
{
  lab_rig own = *model;
  int j;
  for (own.n_fit = j = 0; j < model->n_fit; j++)
    if (model->fit_per_log[j]) {
      own.fit_per_log[own.n_fit] = 1;
      own.fit[own.n_fit++] = model->fit[j];
    }
  if (lab_unknowns_open(&own, run, n, u, error))
    return error->status;
  return u->n > 0 ? lab_unknowns_fit(u, LAB_FIT_WHOLE, NULL, error) : LAB_OK;
}

/* Error of a model on runs. */
static int judge(const lab_rig *model, const lab_experiment *run, int n, lab_errors *errors, lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  int status = u ? fit_own(model, run, n, u, error) : lab_fail_memory(error, "the held-out log");
  if (status == LAB_OK)
    status = lab_loop_errors(u, errors, error);
  free(u);
  return status;
}

/* Where values that stand alone were left out of the logs fitted, they are from those held out, too: no model can have
 * them. */
static int leave_out_held(lab_answer *a, lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  lab_outliers out = {0};
  int status = u ? fit_own(&a->completed.rig, a->held.experiment, a->held.n, u, error)
                 : lab_fail_memory(error, "the held-out log");
  if (status == LAB_OK)
    status = lab_outliers_take(u, a->held.log, &out, error);
  lab_remarks_join(&a->fitted.remarks, &out.remarks);
  lab_outliers_free(&out);
  free(u);
  return status;
}

/* Errors on each log held out, by itself. */
static int judge_logs(lab_answer *a, lab_error *error)
{
  lab_bench *held = &a->held;
  int i, first = 0;
  for (i = 0; i < held->n_logs; i++) {
    lab_held *log = &a->story.held[i];
    int n = 0;
    while (first + n < held->n && held->experiment[first + n].log == &held->log[i])
      n++;
    log->name = lab_file_name(held->log[i].path);
    if (judge(&a->declared.rig, &held->experiment[first], n, &log->before, error) ||
        judge(&a->completed.rig, &held->experiment[first], n, &log->after, error))
      return error->status;
    first += n;
  }
  a->story.n_held = held->n_logs;
  return LAB_OK;
}

/* Errors of the models on the way there, on the logs that they were fitted to. */
static int retrace(lab_answer *a, lab_error *error)
{
  int i;
  for (i = 0; i < a->result.n_path; i++)
    if (judge(&a->result.path[i].rig, a->fitted.experiment, a->fitted.n, &a->story.fitted_path[i], error))
      return error->status;
  return LAB_OK;
}

/* A model that cannot follow the held-out log has no error on it; that is said, and the rest is written. */
static int hold_out(lab_answer *a, size_t left_out, lab_error *error)
{
  lab_story *story = &a->story;
  lab_bench *held = &a->held;
  int i, status;
  if (held->n == 0)
    return LAB_OK;
  status = left_out > 0 ? leave_out_held(a, error) : LAB_OK;
  if (status == LAB_OK)
    status = judge(&a->declared.rig, held->experiment, held->n, &story->holdout_before, error);
  if (status == LAB_OK)
    status = judge(&a->completed.rig, held->experiment, held->n, &story->holdout_after, error);
  for (i = 0; i < a->result.n_path && status == LAB_OK; i++)
    status = judge(&a->result.path[i].rig, held->experiment, held->n, &story->holdout_path[i], error);
  if (status == LAB_OK)
    status = judge_logs(a, error);
  story->has_holdout = status == LAB_OK;
  if (status != LAB_NUMERIC)
    return status;
  lab_remark(&a->fitted.remarks, "held-out log not judged: %s", error->text);
  return LAB_OK;
}

/* ---- Figures of merit ---- */

/* Of what was measured, and of what the completed model makes of the same commands. */
static int appraise(lab_answer *a, lab_error *error)
{
  a->story.measured = &a->measured;
  a->story.predicted = &a->predicted;
  return lab_appraise(&a->completed, &a->measured, &a->predicted, error);
}

/* ---- The loop ---- */

/* The loop's result where the log cannot carry a name: the fit, and nothing traced. */
static int decline(lab_unknowns *u, lab_loop_result *result, lab_error *error)
{
  if (lab_loop_errors(u, &result->before, error))
    return error->status;
  result->after = result->before;
  result->verdict = LAB_VERDICT_UNDECIDED;
  return lab_unknowns_spread(u, &result->fit, error);
}

static void begin_story(lab_answer *a)
{
  a->story.rig = &a->rig;
  a->story.declared = &a->declared;
  a->story.completed = &a->completed;
  a->story.result = &a->result;
  a->story.remarks = &a->fitted.remarks;
}

/* Fit the declared model, and add what it lacks.  Out: left_out  values that turned out to be no measurement */
static int complete(const lab_question *q, lab_answer *a, size_t *left_out, lab_error *error)
{
  const double start = lab_clock();
  lab_loop_options how;
  lab_loop_options_default(&how);
  how.tell = q->tell;
  how.context = q->context;
  how.alpha = q->alpha;
  how.min_gain = q->min_gain;
  *left_out = 0;
  tell(q, "fitting the declared model");
  if (lab_unknowns_open(&a->rig, a->fitted.experiment, a->fitted.n, &a->declared, error) ||
      lab_unknowns_fit(&a->declared, LAB_FIT_WHOLE, NULL, error))
    return error->status;
  a->story.fit_s = lab_clock() - start;
  a->completed = a->declared;
  if (a->fitted.remarks.doubt)
    return decline(&a->completed, &a->result, error);
  if (lab_loop_run(&a->completed, &how, &a->result, error) ||
      lab_second_look(&how, &a->fitted, &a->declared, &a->completed, &a->result, left_out, error))
    return error->status;
  a->story.trace_s = a->result.trace_s;
  return LAB_OK;
}

static int close_loop(const lab_question *q, lab_answer *a, lab_error *error)
{
  const double start = lab_clock();
  size_t left_out;
  begin_story(a);
  if (complete(q, a, &left_out, error))
    return error->status;
  tell(q, "judging");
  if (retrace(a, error) || hold_out(a, left_out, error) || appraise(a, error))
    return error->status;
  tell(q, "looking for the test to record next");
  if (lab_advise(&a->story, error))
    return error->status;
  a->story.total_s = lab_clock() - start;
  return LAB_OK;
}

int lab_answer_find(const lab_question *question, lab_answer **answer, lab_error *error)
{
  lab_answer *a = calloc(1, sizeof *a);
  int status = a ? read_files(question, a, error) : lab_fail_memory(error, "the answer");
  if (status == LAB_OK)
    status = close_loop(question, a, error);
  if (status != LAB_OK && a) {
    lab_answer_free(a);
    a = NULL;
  }
  *answer = a;
  return status;
}

void lab_answer_free(lab_answer *answer)
{
  lab_bench_close(&answer->fitted);
  lab_bench_close(&answer->held);
  free(answer);
}

/* ---- Writing ---- */

/* Figures, if wanted, and the page around them. */
static int write_page(const lab_story *story, const char *folder, int with_figures, lab_error *error)
{
  lab_evidence evidence;
  lab_figures figures = {0};
  int status = lab_evidence_collect(story, &evidence, error);
  if (status == LAB_OK && with_figures)
    status = lab_figures_draw(story, &evidence, &figures, error);
  if (status == LAB_OK)
    status = lab_figures_write(&figures, folder, error);
  if (status == LAB_OK)
    status = lab_report_html(story, &evidence, &figures, folder, error);
  lab_figures_free(&figures);
  lab_evidence_free(&evidence);
  return status;
}

static int write_files(const lab_story *story, const char *folder, int extent, lab_error *error)
{
  if (lab_make_folder(folder, error))
    return error->status;
  if (extent >= LAB_WRITE_PLAIN && (lab_story_residual(story, folder, error) || lab_story_model(story, folder, error) ||
                                    lab_story_header(story, folder, error)))
    return error->status;
  if (lab_story_json(story, folder, error))
    return error->status;
  return extent >= LAB_WRITE_PLAIN ? write_page(story, folder, extent == LAB_WRITE_FIGURES, error) : LAB_OK;
}

int lab_answer_write(const lab_answer *answer, const char *folder, int extent, lab_error *error)
{
  int status;
  lab_interrupt_hold();
  status = write_files(&answer->story, folder, extent, error);
  lab_interrupt_release();
  return status;
}

/* Files of an answer, and the extent from which on each is always there. */
static const struct {
  const char *name;
  int extent;
} files[] = {{"report.json", LAB_WRITE_JSON},    {"report.html", LAB_WRITE_PLAIN},  {"model.cfg", LAB_WRITE_PLAIN},
             {"model.h", LAB_WRITE_PLAIN},       {"residual.csv", LAB_WRITE_PLAIN}, {"response.svg", LAB_WRITE_FIGURES},
             {"residual.svg", LAB_WRITE_FIGURES}};
static const char *const sometimes[] = {"arguments.svg", "autocorrelation.svg", "candidates.svg", "parameters.svg",
                                        "unlisted.svg"};

static void path_in(const char *folder, const char *name, char path[LAB_PATH_TEXT + 32])
{
  snprintf(path, LAB_PATH_TEXT + 32, "%s/%s", folder, name);
}

void lab_answer_remove(const char *folder)
{
  char path[LAB_PATH_TEXT + 32];
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    path_in(folder, files[i].name, path);
    remove(path);
  }
  for (i = 0; i < sizeof sometimes / sizeof *sometimes; i++) {
    path_in(folder, sometimes[i], path);
    remove(path);
  }
}

int lab_answer_is_there(const char *folder, int extent)
{
  char path[LAB_PATH_TEXT + 32];
  size_t i;
  for (i = 0; i < sizeof files / sizeof *files; i++) {
    path_in(folder, files[i].name, path);
    if (files[i].extent <= extent && access(path, R_OK))
      return 0;
  }
  return 1;
}
