/* The trials beside what has been recorded, simulated. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "discriminate_private.h"

/* ---- Words and choice ---- */

void lab_advice_none(lab_advice *advice, const char *reason)
{
  *advice = (lab_advice){.kind = LAB_ADVICE_NONE, .channel = -1, .param = -1};
  snprintf(advice->text, LAB_ADVICE_TEXT, "%.*s", LAB_ADVICE_TEXT - 1, reason);
}

int lab_trial_choose(const lab_test_plans *plans, const double *value, double enough)
{
  const double tie = 0.9;
  double most = -1;
  int i, best = -1;
  for (i = 0; i < plans->n; i++)
    if (value[i] > most)
      most = value[i];
  most = fmin(most, enough);
  for (i = 0; i < plans->n; i++)
    if (value[i] >= tie * most && (best < 0 || plans->plan[i].duration < plans->plan[best].duration))
      best = i;
  return best;
}

/* ---- Opening ---- */

static int check(const lab_advice_request *q, lab_error *error)
{
  int c, any = 0;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++) {
    const double noise = q->noise[lab_forecast_channels[c]];
    any |= noise > 0;
    if (!isnan(noise) && !(noise > 0))
      return lab_fail(error, LAB_DATA, "expected noise of channel %s above 0, found %g",
                      lab_channels[lab_forecast_channels[c]].key, noise);
  }
  if (!any)
    return lab_fail(error, LAB_DATA, "expected a recorded channel among p, x, T and ps");
  if (!(q->spacing > 0))
    return lab_fail(error, LAB_DATA, "expected a spacing of rows above 0 s, found %g", q->spacing);
  return LAB_OK;
}

static int add_forecast(design *s, const lab_schedule *schedule, double duration, lab_error *error)
{
  lab_forecast *forecast = &s->forecast[s->n];
  if (lab_forecast_open(s->request.rig, schedule, s->plans.settle, duration, s->request.spacing, forecast, error))
    return error->status;
  s->n++;
  return LAB_OK;
}

static int add_trial(design *s, const pneu_model *model, const lab_test_plan *plan, lab_error *error)
{
  pneu_input *input = s->input[s->n];
  int i;
  for (i = 0; i < plan->n; i++) {
    pneu_input_default(model, &input[i]);
    input[i].u = (pneu_real)plan->u[i];
  }
  s->schedule[s->n] = (lab_schedule){(size_t)plan->n, plan->t, input};
  return add_forecast(s, &s->schedule[s->n], plan->duration, error);
}

static int lay_out(design *s, lab_error *error)
{
  const lab_advice_request *q = &s->request;
  pneu_model model;
  int i;
  if (lab_test_plans_build(q->rig, &s->plans, error) || lab_rig_model(q->rig, &model, error))
    return error->status;
  for (i = 0; i < s->plans.n; i++)
    if (add_trial(s, &model, &s->plans.plan[i], error))
      return error->status;
  return q->recorded ? add_forecast(s, q->recorded, q->recorded_duration, error)
                     : add_trial(s, &model, &s->plans.usual, error);
}

void lab_design_close(design *s)
{
  int i;
  for (i = 0; s && i < s->n; i++)
    lab_forecast_close(&s->forecast[i]);
  free(s);
}

int lab_side_add(lab_forecast_model *s, int param, lab_error *error)
{
  int j;
  for (j = 0; j < s->n; j++)
    if (s->param[j] == param)
      return LAB_OK;
  if (s->n == LAB_NORMAL_MAX)
    return lab_fail(error, LAB_DATA, "more than %d parameters to fit again", (int)LAB_NORMAL_MAX);
  s->scale[s->n] = lab_forecast_scale(&s->params, param);
  s->param[s->n++] = param;
  return LAB_OK;
}

/* ---- Normal equations ---- */

double lab_design_weight(const lab_advice_request *q, const lab_forecast *o, int place)
{
  const double noise = q->noise[lab_forecast_channels[place]];
  const double rows = o->n > 1 ? (o->t[1] - o->t[0]) / q->spacing : 1;
  return isnan(noise) ? 0 : rows / (noise * noise);
}

/* In:      y  slope columns, then the difference: k + 1 columns of LAB_FORECAST_CHANNELS * n */
static void fill_bundle(lab_normal *bundle, const lab_forecast *o, int k, const double *y)
{
  const double *column[LAB_NORMAL_MAX + 1];
  int c, j;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++) {
    for (j = 0; j <= k; j++)
      column[j] = y + ((size_t)j * LAB_FORECAST_CHANNELS + (size_t)c) * (size_t)o->n;
    lab_normal_clear(&bundle[c], k);
    lab_normal_add_rows(&bundle[c], column, o->n);
  }
}

void lab_design_weigh(const design *s, int i, const lab_advice_request *q, lab_normal *sum)
{
  const lab_normal *bundle = s->bundle[i];
  int c;
  lab_normal_clear(sum, bundle->k);
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++)
    lab_normal_add(sum, lab_design_weight(q, &s->forecast[i], c), &bundle[c]);
}

/* ---- Survey ---- */

/* The last column: how the predictions of two models differ.  In: y  scratch, one column */
static int difference(const lab_forecast *o, const pneu_params *a, const pneu_params *b, double *y, double *column,
                      lab_error *error)
{
  int i;
  if (lab_forecast_run(o, a, column, NULL, error) || lab_forecast_run(o, b, y, NULL, error))
    return error->status;
  for (i = 0; i < LAB_FORECAST_CHANNELS * o->n; i++)
    column[i] -= y[i];
  return LAB_OK;
}

static int survey_one(const lab_forecast *o, const lab_forecast_model *model, const pneu_params *a,
                      const pneu_params *b, lab_normal *into, long *steps, lab_error *error)
{
  const size_t m = LAB_FORECAST_CHANNELS * (size_t)o->n;
  double *space = calloc(((size_t)model->n + 2) * m, sizeof *space);
  double *last, *y;
  int status;
  if (!space)
    return lab_fail_memory(error, "a response");
  last = space + (size_t)model->n * m;
  y = last + m;
  if ((status = lab_forecast_run(o, &model->params, y, steps, error)) == LAB_OK &&
      (status = lab_forecast_slopes(o, model, y, space, error)) == LAB_OK &&
      (!a || (status = difference(o, a, b, y, last, error)) == LAB_OK))
    fill_bundle(into, o, model->n, space);
  free(space);
  return status;
}

static int survey(design *s, const lab_forecast_model *model, const pneu_params *a, const pneu_params *b,
                  lab_error *error)
{
  const long many_steps = 3000; /* smooth ones take 50 to 500 */
  int i, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < s->n; i++) {
    lab_error mine;
    long steps = 0;
    int c;
    const int at = survey_one(&s->forecast[i], model, a, b, s->bundle[i], &steps, &mine);
    s->failed[i] = at != LAB_OK;
    s->jerky[i] = steps > many_steps;
    for (c = 0; at != LAB_OK && c < LAB_FORECAST_CHANNELS; c++)
      lab_normal_clear(&s->bundle[i][c], model->n);
    if (at == LAB_WORLD) {
#pragma omp critical(scene_error)
      *error = mine, status = at;
    }
  }
  return status;
}

int lab_design_open(const lab_advice_request *request, const lab_forecast_model *model, const pneu_params *a,
                    const pneu_params *b, design **made, lab_advice *advice, lab_error *error)
{
  design *s;
  *made = NULL;
  if (check(request, error))
    return error->status;
  if (!(s = calloc(1, sizeof *s)))
    return lab_fail_memory(error, "a set of schedules");
  s->request = *request;
  if (lay_out(s, error)) {
    lab_advice_none(advice, error->text);
    error->status = error->status == LAB_WORLD ? LAB_WORLD : LAB_OK;
  } else if (survey(s, model, a, b, error) == LAB_OK) {
    *made = s;
    return LAB_OK;
  }
  lab_design_close(s);
  return error->status;
}
