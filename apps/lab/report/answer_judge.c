#include "answer_judge.h"

#include <stdlib.h>

#include "../base/text.h"
#include "../fit/outliers.h"

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

int lab_answer_judge(lab_answer *a, size_t left_out, lab_error *error)
{
  return retrace(a, error) ? error->status : hold_out(a, left_out, error);
}
