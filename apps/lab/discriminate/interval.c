/* Which trial narrows what is known least. */
#include <math.h>
#include <stdio.h>

#include "discriminate_private.h"

/* Half widths of 95 % intervals over the scales of the parameters, by forecast: the last is what has been recorded, the
 * others come on top of it. */
typedef struct widths {
  double of[LAB_TEST_PLAN_MAX + 1][LAB_NORMAL_MAX];
} widths;

static void find_widths(const lab_normal *normal, double *width)
{
  const double normal_95 = 1.959963984540054;
  double prior[LAB_NORMAL_MAX];
  int j;
  for (j = 0; j < normal->k; j++)
    prior[j] = 10; /* anything from nothing to many times the value */
  lab_normal_deviations(normal, prior, width);
  for (j = 0; j < normal->k; j++)
    width[j] *= normal_95;
}

/* A trial that cannot be simulated adds nothing. */
static void find_all(const design *s, widths *w)
{
  lab_normal present, normal;
  int i;
  lab_bundle_weigh(&s->bundle[s->n - 1], &s->request, &s->forecast[s->n - 1], &present);
  find_widths(&present, w->of[s->n - 1]);
  for (i = 0; i < s->n - 1; i++) {
    lab_bundle_weigh(&s->bundle[i], &s->request, &s->forecast[i], &normal);
    lab_normal_add(&normal, 1, &present);
    find_widths(&normal, w->of[i]);
  }
}

/* The widest interval but for those that are done. */
static int widest(const double *width, int n, const int *done)
{
  int j, at = -1;
  for (j = 0; j < n; j++)
    if (!done[j] && (at < 0 || width[j] > width[at]))
      at = j;
  return at;
}

/* ---- Words ---- */

/* "±3.2 %" */
static const char *percent(double width, char text[32])
{
  if (width > 1)
    snprintf(text, 32, "over ±100 %%"); /* as wide as the value */
  else
    snprintf(text, 32, "±%.2g %%", 100 * width);
  return text;
}

/* An effect at its neutral value has no size yet: what is known is how large it could be unseen. */
static int is_neutral(const pneu_params *params, int param)
{
  pneu_params copy = *params;
  pneu_param_info info;
  if (param == LAB_PARAM_ORIFICE_AREA || param < PNEU_PARAM_BASE_COUNT)
    return 0;
  pneu_param_describe(param, &info);
  return !info.shape && *pneu_param_at(&copy, param) == info.neutral;
}

static void on_progress(const pneu_params *params, lab_advice *advice)
{
  char name[LAB_PARAM_NAME_TEXT], before[32], after[32];
  lab_fit_name(advice->param, name);
  lab_advice_say(advice->text, "%s", advice->plan.text);
  if (is_neutral(params, advice->param))
    lab_advice_say(advice->why,
                   "This test would lower the detection limit of %s from %.0f %% to %.2g %% of its usual size.", name,
                   100 * advice->before, 100 * advice->after);
  else
    lab_advice_say(advice->why, "This test would narrow the interval of %s from %s to %s.", name,
                   percent(advice->before, before), percent(advice->after, after));
}

/* ---- Entry ---- */

/* Narrow the widest interval that can be narrowed. */
static void advise(const design *s, const lab_forecast_model *model, const widths *w, lab_advice *advice)
{
  const double *now = w->of[s->n - 1], worth_while = 0.9;
  int done[LAB_NORMAL_MAX] = {0}, j;
  lab_advice_none(advice, "no schedule of the set narrows an interval by a tenth");
  while ((j = widest(now, model->n, done)) >= 0) {
    double gain[LAB_TEST_PLAN_MAX];
    int i;
    for (i = 0; i < s->plans.n; i++)
      gain[i] = now[j] / w->of[i][j];
    i = lab_trial_choose(&s->plans, gain, (double)INFINITY);
    done[j] = 1;
    if (i < 0 || !(worth_while * gain[i] > 1))
      continue;
    advice->kind = LAB_ADVICE_TEST;
    advice->plan = s->plans.plan[i];
    advice->param = model->param[j];
    advice->before = now[j];
    advice->after = w->of[i][j];
    on_progress(&model->params, advice);
    return;
  }
}

int lab_advise_precision(const lab_advice_request *request, const pneu_params *params, lab_advice *advice,
                         lab_error *error)
{
  lab_forecast_model model = {*params, 0, {0}, {0}};
  widths w;
  design *s;
  int j, status;
  for (j = 0; j < request->n_fit; j++)
    if (lab_side_add(&model, request->fit[j], error))
      return error->status;
  status = lab_design_open(request, &s, advice, error);
  if (status != LAB_OK || !s)
    return status;
  if ((status = lab_design_survey(s, &model, NULL, NULL, error)) == LAB_OK) {
    find_all(s, &w);
    advise(s, &model, &w, advice);
  }
  lab_design_close(s);
  return status;
}
