#include "answer.h"

#include <stdlib.h>

#include "advise.h"
#include "answer_judge.h"
#include "../base/clock.h"
#include "../metrics/appraise.h"
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
  if (lab_answer_judge(a, left_out, error) || appraise(a, error))
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
