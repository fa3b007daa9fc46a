/* Which test to record next, for what closeloop found. */
#include <math.h>
#include <string.h>

#include "../discriminate/forecast.h"
#include "answer.h"

/* The rig and the longest of its records, as the search for a trial sees them. */
static void inquire(const lab_report *report, lab_advice_request *q)
{
  const lab_unknowns *u = report->completed;
  const lab_run *x = &u->run[0];
  const double *t;
  int e, c;
  memset(q, 0, sizeof *q);
  for (e = 1; e < u->n_runs; e++)
    if (u->run[e].n > x->n)
      x = &u->run[e];
  t = x->log->value[LAB_CHANNEL_TIME] + x->first;
  q->rig = report->rig;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    q->noise[c] = (double)NAN;
  for (c = 0; c < x->n_channels; c++)
    q->noise[x->channel[c]] = x->sigma[c];
  q->recorded_duration = t[x->n - 1] - t[0];
  q->spacing = q->recorded_duration / (double)(x->n > 1 ? x->n - 1 : 1);
  q->n_fit = report->rig->n_fit;
  q->fit = report->rig->fit;
  q->recorded = &x->inputs.schedule;
}

/* Whether anything was recorded that a test can be foreseen for. */
static int can_foresee(const lab_advice_request *q)
{
  int c;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++)
    if (q->noise[lab_forecast_channels[c]] > 0)
      return 1;
  return 0;
}

int lab_answer_advise(lab_answer *a, lab_error *error)
{
  lab_report *report = &a->report;
  const lab_search_result *r = report->result;
  int fit[LAB_PARAM_COUNT], i, alike = 0;
  lab_advice_request q;
  lab_rig last;
  lab_rig_at(&report->completed->rig, INFINITY, &last);
  inquire(report, &q);
  if (!can_foresee(&q))
    return LAB_OK;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    alike += found->n_alike;
    if (found->n_alike > 0 && lab_discriminate(&q, &last.params, &found->alike_params[0], &report->separate[i], error))
      return error->status;
  }
  if (alike > 0 || r->window > 0 || report->completed->rig.n_terms > 0)
    return LAB_OK;
  memcpy(fit, q.fit, (size_t)q.n_fit * sizeof *fit);
  for (i = 0; i < r->n_found; i++)
    fit[q.n_fit++] = r->found[i].param;
  q.fit = fit;
  return lab_advise_precision(&q, &last.params, &report->next, error);
}
