#include "answer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../base/clock.h"
#include "../fit/drift.h"
#include "../fit/weights.h"
#include "../metrics/recording.h"
#include "../trace/search.h"

static void on_progress(const lab_request *q, const char *what)
{
  if (q->on_progress)
    q->on_progress(q->context, what);
}

/* ---- Reading ---- */

static int read_held_out(const lab_request *q, lab_answer *a, lab_error *error)
{
  int i;
  a->rig_held = a->rig;
  a->held.is_whole = 1;
  lab_log_format_hold_out(&a->rig_held.log);
  for (i = 0; i < q->n_holdout; i++)
    if (lab_logs_add(&a->held, &a->rig_held, q->holdout[i], error))
      return error->status;
  lab_limitations_join(&a->now.logs.limitations, &a->held.limitations);
  return LAB_OK;
}

/* Read every log before any fit, so that a bad one costs no waiting. */
static int read_files(const lab_request *q, lab_answer *a, lab_error *error)
{
  int i;
  on_progress(q, "reading");
  if (lab_rig_read(q->rig, &a->rig, error))
    return error->status;
  for (i = 0; i < q->n_logs; i++)
    if (lab_logs_add(&a->now.logs, &a->rig, q->log[i], error))
      return error->status;
  for (i = 0; i < q->n_baseline; i++)
    if (lab_logs_add(&a->then.logs, &a->rig, q->baseline[i], error))
      return error->status;
  if (lab_plausible_content(&a->rig, &a->now.logs.content, &a->now.logs.limitations, error) ||
      (q->n_baseline && lab_plausible_content(&a->rig, &a->then.logs.content, &a->then.logs.limitations, error)))
    return error->status;
  return read_held_out(q, a, error);
}

/* ---- Figures of merit ---- */

/* Of what was measured, and of what the completed model makes of the same commands. */
static int appraise(lab_answer *a, lab_error *error)
{
  a->report.measured = &a->measured;
  a->report.predicted = &a->predicted;
  return lab_metrics_compare(&a->now.completed, &a->measured, &a->predicted, error);
}

/* ---- The loop ---- */

/* The loop's result where the log cannot carry a name: the fit, and nothing traced. */
static int decline(lab_unknowns *u, lab_search_result *result, lab_error *error)
{
  if (lab_search_measure(u, LAB_STAGE_BEFORE, result, error) || lab_search_measure(u, LAB_STAGE_AFTER, result, error))
    return error->status;
  result->verdict = LAB_VERDICT_UNDECIDED;
  return lab_unknowns_intervals(u, &result->fit, error);
}

static void begin_report(lab_answer *a)
{
  a->report.rig = &a->rig;
  a->report.declared = &a->now.declared;
  a->report.completed = &a->now.completed;
  a->report.result = &a->now.result;
  a->report.limitations = &a->now.logs.limitations;
}

/* Only deviations that begin within the log. */
static void keep_onsets(const lab_report *report, lab_deviations *all)
{
  int i, n = 0;
  for (i = 0; i < all->n; i++)
    if (lab_report_onset(report, all->of[i].param))
      all->of[n++] = all->of[i];
  all->n = n;
}

/* What the fit says of the declared values, which are not unknowns from here on. */
static int conclude(lab_answer *a, lab_error *error)
{
  lab_deviations *all = &a->report.deviations;
  if (lab_deviations_find(&a->rig, &a->now.completed, &a->now.result.fit, all, error))
    return error->status;
  if (a->now.result.verdict == LAB_VERDICT_UNDECIDED) { /* the values stand in for what is not known */
    all->condition = LAB_CONDITION_CANNOT_TELL;
    keep_onsets(&a->report, all);
  }
  lab_unknowns_settle(&a->now.completed, &a->now.result.fit);
  return LAB_OK;
}

/* How much of a budget the search may take: what it leaves is for the intervals and for judging, a few simulations for
 * each unknown, of which the fit of the declared model has shown the cost.
 * In:      budget, fit  [s] of CPU: what is given, and what the fit took */
static double for_search(double budget, double fit)
{
  static const double least = 0.5, most = 0.8;
  return fmax(fmin(most * budget, budget - fit), least * budget);
}

/* Fit the declared model; once more where the logs show another noise or clock than is declared. */
static int fit_declared(lab_logs *logs, lab_unknowns *declared, lab_error *error)
{
  int e, any;
  for (e = 0; e < logs->n; e++)
    if (lab_drift_open(&logs->run[e], error))
      return error->status;
  if (lab_unknowns_fit(declared, LAB_ROUNDS_ALL, NULL, error) || lab_weigh_runs(declared, logs->run, &any, error))
    return error->status;
  lab_weights_say(logs->run, logs->n, &logs->limitations);
  return any ? lab_unknowns_fit(declared, LAB_ROUNDS_ALL, NULL, error) : LAB_OK;
}

/* How much CPU time there is, from when on [s]; 0: no end. */
typedef struct allowance {
  double start, budget;
} allowance;

static double until(const allowance *time, double fit)
{
  return time->budget > 0 ? time->start + for_search(time->budget, fit) : 0;
}

/* Fit the declared model to the logs.  Out: fit_s  [s] of CPU that it took */
static int fit_to(const lab_request *q, const lab_rig *rig, const allowance *time, lab_completion *c, double *fit_s,
                  lab_error *error)
{
  const double used = lab_cpu_time();
  int status;
  on_progress(q, "fitting the declared model");
  if (lab_unknowns_open(rig, c->logs.run, c->logs.n, &c->declared, error))
    return error->status;
  c->declared.until = until(time, 0);
  status = fit_declared(&c->logs, &c->declared, error);
  *fit_s = lab_cpu_time() - used;
  return status;
}

/* Search; where noise with memory was told beside something that is missing, once more with that told again. */
static int search_with_colours(const lab_search_options *how, lab_completion *c, lab_error *error)
{
  int any = 0;
  if (lab_search_run(&c->completed, how, &c->result, error))
    return error->status;
  if (c->result.verdict != LAB_VERDICT_UNDECIDED || c->result.cut_short ||
      c->result.n_found + c->completed.rig.n_onsets == 0)
    return LAB_OK;
  if (lab_weigh_colours(&c->completed, c->logs.run, &any, error) || !any)
    return error->status;
  if (lab_unknowns_fit(&c->declared, LAB_ROUNDS_ALL, NULL, error))
    return error->status;
  c->completed = c->declared;
  return lab_search_run(&c->completed, how, &c->result, error);
}

/* Add what the fitted model lacks.
 * In:      fit_s      of fit_to
 *          may_begin  whether it may begin within the log: a baseline is what it is throughout */
static int complete(const lab_request *q, const allowance *time, double fit_s, int may_begin, lab_completion *c,
                    lab_error *error)
{
  lab_search_options how;
  lab_search_options_default(&how);
  how.on_progress = q->on_progress;
  how.context = q->context;
  how.alpha = q->alpha;
  how.min_gain = q->min_gain;
  how.may_begin = may_begin;
  if (!c->logs.limitations.doubt)
    c->declared.until = until(time, fit_s);
  c->completed = c->declared;
  if (c->logs.limitations.doubt)
    return decline(&c->completed, &c->result, error);
  if (search_with_colours(&how, c, error))
    return error->status;
  if (lab_search_without_outliers(&how, &c->logs, &c->declared, &c->completed, &c->result, error))
    return error->status;
  return lab_drift_say(&c->completed, &c->logs.limitations, error);
}

/* What has changed since the baseline, which is asked before the new logs are traced. Where the logs of either side are
 * in doubt, that is all that can be said.
 * In:      time  of all; a third is for the model of the baseline, what is left but a fifth for the comparison */
static int compare(const lab_request *q, const allowance *time, lab_answer *a, lab_error *error)
{
  static const double baseline = 1.0 / 3, both = 0.8;
  const allowance own = {lab_cpu_time(), baseline * time->budget};
  lab_completion *then = &a->then;
  const lab_limitations *doubtful = a->now.logs.limitations.doubt ? &a->now.logs.limitations : &then->logs.limitations;
  double fit_s;
  if (then->logs.n == 0)
    return LAB_OK;
  a->report.changes = &a->changes;
  if (doubtful->doubt) {
    snprintf(a->changes.why, sizeof a->changes.why, "%s", doubtful->text[doubtful->doubt - 1]);
    return LAB_OK;
  }
  on_progress(q, "completing the model of the baseline");
  if (fit_to(q, &a->rig, &own, then, &fit_s, error) || complete(q, &own, fit_s, 0, then, error))
    return error->status;
  lab_unknowns_settle(&then->completed, &then->result.fit);
  a->report.baseline = &then->completed.rig;
  on_progress(q, "looking for what has changed");
  then->completed.until = time->budget > 0 ? time->start + both * time->budget : 0;
  return lab_changes_find(&then->completed, then->result.verdict != LAB_VERDICT_UNDECIDED, a->now.logs.run,
                          a->now.logs.n, q->alpha, &a->changes, error);
}

/* With nothing to fit the declared model is judged as it stands: its command changes at the rows that show it. */
static int leave_as_declared(lab_answer *a, lab_error *error)
{
  if (a->rig.n_fit > 0)
    return LAB_OK;
  lab_unknowns_none(&a->rig, a->now.logs.run, a->now.logs.n, &a->now.declared);
  return lab_loop_errors(&a->now.declared, &a->now.result.before, error);
}

static int close_loop(const lab_request *q, lab_answer *a, lab_error *error)
{
  const allowance time = {lab_cpu_time(), q->budget};
  const double start = lab_clock();
  double fit_s;
  begin_report(a);
  if (fit_to(q, &a->rig, &time, &a->now, &fit_s, error))
    return error->status;
  a->report.fit_s = lab_clock() - start;
  if (compare(q, &time, a, error) || complete(q, &time, fit_s, 1, &a->now, error) || conclude(a, error) ||
      leave_as_declared(a, error))
    return error->status;
  a->report.trace_s = a->now.result.score_s;
  on_progress(q, "evaluating on the held-out logs");
  if (lab_answer_judge(a, error) || appraise(a, error))
    return error->status;
  if (!a->now.result.cut_short) {
    on_progress(q, "looking for the test to record next");
    if (lab_answer_advise(a, error))
      return error->status;
  }
  a->report.total_s = lab_clock() - start;
  return LAB_OK;
}

int lab_answer_find(const lab_request *request, lab_answer **answer, lab_error *error)
{
  lab_answer *a = calloc(1, sizeof *a);
  int status = a ? read_files(request, a, error) : lab_fail_memory(error, "the answer");
  if (status == LAB_OK)
    status = close_loop(request, a, error);
  if (status != LAB_OK && a) {
    lab_answer_free(a);
    a = NULL;
  }
  *answer = a;
  return status;
}

void lab_answer_free(lab_answer *answer)
{
  lab_logs_close(&answer->now.logs);
  lab_logs_close(&answer->then.logs);
  lab_logs_close(&answer->held);
  free(answer);
}
