/* How far a model is from logs: those that it was fitted to, on the way there, and those that it has not seen. */
#include <math.h>
#include <stdlib.h>

#include "../base/text.h"
#include "answer.h"

/* Begin where a fit of the same runs has ended. */
static void start_from(const lab_unknowns *fitted, lab_unknowns *u)
{
  int j, k;
  for (j = 0; j < u->n; j++)
    for (k = 0; k < fitted->n; k++) {
      const lab_unknown *x = &fitted->unknown[k];
      if (x->kind == u->unknown[j].kind && x->run == u->unknown[j].run && x->index == u->unknown[j].index)
        u->unknown[j].value = x->value;
    }
}

/* Fit to runs what each log has for itself, and the instants at which the command changed, within the row that shows
 * each; nothing that the logs share.
 * In:      fitted  the final model of the same runs */
static int fit_own(const lab_rig *model, const lab_run *run, int n, const lab_unknowns *fitted, lab_unknowns *u,
                   lab_error *error)
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
  start_from(fitted, u);
  return u->n > 0 ? lab_unknowns_fit(u, LAB_ROUNDS_ALL, NULL, error) : LAB_OK;
}

/* Error of a model on runs.
 * In:      fitted  the final model of these runs, and what is theirs is fitted again; NULL: they are others, and
 * nothing is */
static int judge(const lab_rig *model, const lab_run *run, int n, const lab_unknowns *fitted, lab_errors *errors,
                 lab_error *error)
{
  lab_unknowns *u = malloc(sizeof *u);
  int status = u ? LAB_OK : lab_fail_memory(error, "the errors of a model");
  if (status == LAB_OK && fitted)
    status = fit_own(model, run, n, fitted, u, error);
  else if (status == LAB_OK)
    lab_unknowns_none(model, run, n, u);
  if (status == LAB_OK)
    status = lab_loop_errors(u, errors, error);
  free(u);
  return status;
}

/* Errors on each log held out, by itself. */
static int judge_logs(lab_answer *a, lab_error *error)
{
  lab_logs *held = &a->held;
  int i, first = 0;
  for (i = 0; i < held->n_logs; i++) {
    lab_holdout_log *log = &a->report.held[i];
    int n = 0;
    while (first + n < held->n && held->run[first + n].log == &held->log[i])
      n++;
    log->name = lab_file_name(held->log[i].path);
    if (judge(&a->now.declared.rig, &held->run[first], n, NULL, &log->before, error) ||
        judge(&a->now.completed.rig, &held->run[first], n, NULL, &log->after, error))
      return error->status;
    first += n;
  }
  a->report.n_held = held->n_logs;
  return LAB_OK;
}

/* Errors of the models on the way there, on the logs that they were fitted to; NaN of one that cannot follow them. */
static int retrace(lab_answer *a, lab_error *error)
{
  int i, c, status = LAB_OK;
  for (i = 0; i < a->now.result.n_path && status == LAB_OK; i++) {
    lab_errors *errors = &a->report.fitted_path[i];
    status = judge(&a->now.result.path[i].rig, a->now.logs.run, a->now.logs.n, &a->now.completed, errors, error);
    for (c = 0; c < LAB_CHANNEL_COUNT && status == LAB_NUMERIC; c++)
      errors->rmse[c] = errors->in_noise[c] = (double)NAN;
    status = status == LAB_NUMERIC ? LAB_OK : status;
  }
  return status;
}

/* A model that cannot follow the held-out log has no error on it; that is said, and the rest is written. */
static int hold_out(lab_answer *a, lab_error *error)
{
  lab_report *report = &a->report;
  lab_logs *held = &a->held;
  int i, status;
  if (held->n == 0)
    return LAB_OK;
  if (a->now.completed.rig.n_onsets > a->rig.n_onsets)
    lab_limitation(&a->now.logs.limitations,
                   "what begins at %.6g s of the log begins at the same time of a held-out log",
                   a->now.completed.rig.onset[a->rig.n_onsets].from);
  status = judge(&a->now.declared.rig, held->run, held->n, NULL, &report->holdout_before, error);
  if (status == LAB_OK)
    status = judge(&a->now.completed.rig, held->run, held->n, NULL, &report->holdout_after, error);
  for (i = 0; i < a->now.result.n_path && status == LAB_OK; i++)
    status = judge(&a->now.result.path[i].rig, held->run, held->n, NULL, &report->holdout_path[i], error);
  if (status == LAB_OK)
    status = judge_logs(a, error);
  report->has_holdout = status == LAB_OK;
  if (status != LAB_NUMERIC)
    return status;
  lab_limitation(&a->now.logs.limitations, "held-out log not judged: %s", error->text);
  return LAB_OK;
}

int lab_answer_judge(lab_answer *a, lab_error *error)
{
  return retrace(a, error) ? error->status : hold_out(a, error);
}
