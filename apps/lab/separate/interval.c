/* Which trial narrows what is known least. */
#include <math.h>
#include <stdio.h>

#include "separate_private.h"

/* Half widths of 95 % intervals over the scales of the parameters, by outlook: the last is what has been recorded, the
 * others come on top of it. */
typedef struct widths {
  double of[LAB_TRIAL_MAX + 1][LAB_NORMAL_MAX];
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
static void find_all(const scene *s, widths *w)
{
  lab_normal present, normal;
  int i;
  bundle_weigh(&s->bundle[s->n - 1], &s->inquiry, &s->outlook[s->n - 1], &present);
  find_widths(&present, w->of[s->n - 1]);
  for (i = 0; i < s->n - 1; i++) {
    bundle_weigh(&s->bundle[i], &s->inquiry, &s->outlook[i], &normal);
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

/* "+-3.2 %" */
static const char *percent(double width, char text[32])
{
  if (width > 1)
    snprintf(text, 32, "hardly known"); /* as wide as the value */
  else
    snprintf(text, 32, "+-%.2g %%", 100 * width);
  return text;
}

/* An effect at its neutral value has no size yet: what is known is how large it could be unseen. */
static int is_neutral(const pneu_params *params, int param)
{
  pneu_params copy = *params;
  pneu_param_info info;
  if (param == LAB_FIT_ORIFICE_AREA || param < PNEU_PARAM_BASE_COUNT)
    return 0;
  pneu_param_describe(param, &info);
  return !info.shape && *pneu_param_at(&copy, param) == info.neutral;
}

static void say(const pneu_params *params, lab_advice *advice)
{
  char name[LAB_FIT_TEXT], before[32], after[32];
  lab_fit_name(advice->param, name);
  advice_say(advice->text, "%s", advice->trial.text);
  if (is_neutral(params, advice->param))
    advice_say(advice->why, "would lower what of %s can hide in the noise from %.0f %% to %.2g %% of its usual size",
               name, 100 * advice->before, 100 * advice->after);
  else
    advice_say(advice->why, "would narrow %s from %s to %s", name, percent(advice->before, before),
               percent(advice->after, after));
}

/* ---- Entry ---- */

/* Narrow the widest interval that can be narrowed. */
static void advise(const scene *s, const side *model, const widths *w, lab_advice *advice)
{
  const double *now = w->of[s->n - 1], worth_while = 0.9;
  int done[LAB_NORMAL_MAX] = {0}, j;
  advice_none(advice, "no schedule of the set narrows an interval by a tenth");
  while ((j = widest(now, model->n, done)) >= 0) {
    double gain[LAB_TRIAL_MAX];
    int i;
    for (i = 0; i < s->trials.n; i++)
      gain[i] = now[j] / w->of[i][j];
    i = trial_choose(&s->trials, gain, (double)INFINITY);
    done[j] = 1;
    if (i < 0 || !(worth_while * gain[i] > 1))
      continue;
    advice->kind = LAB_ADVICE_TRIAL;
    advice->trial = s->trials.trial[i];
    advice->param = model->param[j];
    advice->before = now[j];
    advice->after = w->of[i][j];
    say(&model->params, advice);
    return;
  }
}

int lab_advise_interval(const lab_inquiry *inquiry, const pneu_params *params, lab_advice *advice, lab_error *error)
{
  side model = {*params, 0, {0}, {0}};
  widths w;
  scene *s;
  int j, status;
  for (j = 0; j < inquiry->n_fit; j++)
    if (side_add(&model, inquiry->fit[j], error))
      return error->status;
  status = scene_open(inquiry, &s, advice, error);
  if (status != LAB_OK || !s)
    return status;
  if ((status = scene_survey(s, &model, NULL, NULL, error)) == LAB_OK) {
    find_all(s, &w);
    advise(s, &model, &w, advice);
  }
  scene_close(s);
  return status;
}
