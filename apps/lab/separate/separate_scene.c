/* The trials beside what has been recorded, simulated. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "separate_private.h"

/* ---- Words and choice ---- */

void advice_say(char text[LAB_ADVICE_TEXT], const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(text, LAB_ADVICE_TEXT, format, args);
  va_end(args);
}

void advice_none(lab_advice *advice, const char *reason)
{
  memset(advice, 0, sizeof *advice);
  advice->kind = LAB_ADVICE_NONE;
  advice->channel = advice->param = -1;
  advice_say(advice->text, "%s", reason);
}

int trial_choose(const lab_trials *trials, const double *value, double enough)
{
  const double tie = 0.9;
  double most = -1;
  int i, best = -1;
  for (i = 0; i < trials->n; i++)
    if (value[i] > most)
      most = value[i];
  most = fmin(most, enough);
  for (i = 0; i < trials->n; i++)
    if (value[i] >= tie * most && (best < 0 || trials->trial[i].duration < trials->trial[best].duration))
      best = i;
  return best;
}

/* ---- Opening ---- */

static int check(const lab_inquiry *q, lab_error *error)
{
  int c, any = 0;
  for (c = 0; c < LAB_FORESEEN; c++) {
    const double noise = q->noise[lab_foreseen[c]];
    any |= noise > 0;
    if (!isnan(noise) && !(noise > 0))
      return lab_fail(error, LAB_DATA, "expected noise of channel %s above 0, found %g",
                      lab_channels[lab_foreseen[c]].key, noise);
  }
  if (!any)
    return lab_fail(error, LAB_DATA, "expected a recorded channel among p, x, T and ps");
  if (!(q->spacing > 0))
    return lab_fail(error, LAB_DATA, "expected a spacing of rows above 0 s, found %g", q->spacing);
  return LAB_OK;
}

static int add_outlook(scene *s, const lab_schedule *schedule, double duration, lab_error *error)
{
  lab_outlook *outlook = &s->outlook[s->n];
  if (lab_outlook_open(s->inquiry.rig, schedule, s->trials.settle, duration, s->inquiry.spacing, outlook, error))
    return error->status;
  s->n++;
  return LAB_OK;
}

static int add_trial(scene *s, const pneu_model *model, const lab_trial *trial, lab_error *error)
{
  pneu_input *input = s->input[s->n];
  int i;
  for (i = 0; i < trial->n; i++) {
    pneu_input_default(model, &input[i]);
    input[i].u = (pneu_real)trial->u[i];
  }
  s->schedule[s->n] = (lab_schedule){(size_t)trial->n, trial->t, input};
  return add_outlook(s, &s->schedule[s->n], trial->duration, error);
}

static int lay_out(scene *s, lab_error *error)
{
  const lab_inquiry *q = &s->inquiry;
  pneu_model model;
  int i;
  if (lab_trials_build(q->rig, &s->trials, error) || lab_rig_model(q->rig, &model, error))
    return error->status;
  for (i = 0; i < s->trials.n; i++)
    if (add_trial(s, &model, &s->trials.trial[i], error))
      return error->status;
  return q->recorded ? add_outlook(s, q->recorded, q->recorded_duration, error)
                     : add_trial(s, &model, &s->trials.usual, error);
}

int scene_open(const lab_inquiry *inquiry, scene **made, lab_advice *advice, lab_error *error)
{
  scene *s;
  *made = NULL;
  if (check(inquiry, error))
    return error->status;
  if (!(s = calloc(1, sizeof *s)))
    return lab_fail_memory(error, "a set of schedules");
  s->inquiry = *inquiry;
  if (lay_out(s, error) == LAB_OK) {
    *made = s;
    return LAB_OK;
  }
  scene_close(s);
  advice_none(advice, error->text);
  return error->status == LAB_WORLD ? LAB_WORLD : (error->status = LAB_OK);
}

void scene_close(scene *s)
{
  int i;
  for (i = 0; s && i < s->n; i++)
    lab_outlook_close(&s->outlook[i]);
  free(s);
}

int side_add(side *s, int param, lab_error *error)
{
  int j;
  for (j = 0; j < s->n; j++)
    if (s->param[j] == param)
      return LAB_OK;
  if (s->n == LAB_NORMAL_MAX)
    return lab_fail(error, LAB_DATA, "more than %d parameters to fit again", (int)LAB_NORMAL_MAX);
  s->scale[s->n] = lab_foresee_scale(&s->params, param);
  s->param[s->n++] = param;
  return LAB_OK;
}

/* ---- Normal equations ---- */

double scene_weight(const lab_inquiry *q, const lab_outlook *o, int place)
{
  const double noise = q->noise[lab_foreseen[place]];
  const double rows = o->n > 1 ? (o->t[1] - o->t[0]) / q->spacing : 1;
  return isnan(noise) ? 0 : rows / (noise * noise);
}

void bundle_fill(bundle *b, const lab_outlook *o, int k, const double *y)
{
  const double *column[LAB_NORMAL_MAX + 1];
  int c, j;
  for (c = 0; c < LAB_FORESEEN; c++) {
    for (j = 0; j <= k; j++)
      column[j] = y + ((size_t)j * LAB_FORESEEN + (size_t)c) * (size_t)o->n;
    lab_normal_clear(&b->channel[c], k);
    lab_normal_add_rows(&b->channel[c], column, o->n);
  }
}

void bundle_weigh(const bundle *b, const lab_inquiry *q, const lab_outlook *o, lab_normal *sum)
{
  int c;
  lab_normal_clear(sum, b->channel[0].k);
  for (c = 0; c < LAB_FORESEEN; c++)
    lab_normal_add(sum, scene_weight(q, o, c), &b->channel[c]);
}

/* ---- Survey ---- */

/* The last column: how the predictions of two models differ.  In: y  scratch, one column */
static int difference(const lab_outlook *o, const pneu_params *a, const pneu_params *b, double *y, double *column,
                      lab_error *error)
{
  int i;
  if (lab_foresee(o, a, column, NULL, error) || lab_foresee(o, b, y, NULL, error))
    return error->status;
  for (i = 0; i < LAB_FORESEEN * o->n; i++)
    column[i] -= y[i];
  return LAB_OK;
}

static int survey_one(const lab_outlook *o, const side *model, const pneu_params *a, const pneu_params *b, bundle *into,
                      long *steps, lab_error *error)
{
  const size_t m = LAB_FORESEEN * (size_t)o->n;
  double *space = calloc(((size_t)model->n + 2) * m, sizeof *space);
  double *last, *y;
  int status;
  if (!space)
    return lab_fail_memory(error, "a response");
  last = space + (size_t)model->n * m;
  y = last + m;
  if ((status = lab_foresee(o, &model->params, y, steps, error)) == LAB_OK &&
      (status = lab_foresee_slopes(o, &model->params, model->n, model->param, model->scale, y, space, error)) ==
          LAB_OK &&
      (!a || (status = difference(o, a, b, y, last, error)) == LAB_OK))
    bundle_fill(into, o, model->n, space);
  free(space);
  return status;
}

int scene_survey(scene *s, const side *model, const pneu_params *a, const pneu_params *b, lab_error *error)
{
  const long many_steps = 3000; /* smooth ones take 50 to 500 */
  int i, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < s->n; i++) {
    lab_error mine;
    long steps = 0;
    int c;
    const int at = survey_one(&s->outlook[i], model, a, b, &s->bundle[i], &steps, &mine);
    s->failed[i] = at != LAB_OK;
    s->jerky[i] = steps > many_steps;
    for (c = 0; at != LAB_OK && c < LAB_FORESEEN; c++)
      lab_normal_clear(&s->bundle[i].channel[c], model->n);
    if (at == LAB_WORLD) {
#pragma omp critical(scene_error)
      *error = mine, status = at;
    }
  }
  return status;
}
