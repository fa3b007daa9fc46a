#include "discriminate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../fit/fit.h"
#include "discriminate_private.h"

static const double clear = 5;      /* [sigma] separates */
static const double decisive = 100; /* [sigma] clear, with room for noise that is 20 times less kind than white noise */
static const double near_enough = 1e-3; /* [sigma^2] of chi-square, and as a share of it */
static const double better = 2;         /* times what has been recorded gives, or it is hardly worth the trouble */

/* ---- The trials beside what has been recorded, simulated ---- */

/* The trials and what has been recorded, which comes last. */
typedef struct design {
  lab_advice_request request;
  lab_test_plans plans;
  int n; /* of forecasts */
  lab_forecast forecast[LAB_TEST_PLAN_MAX + 1];
  lab_schedule schedule[LAB_TEST_PLAN_MAX + 1];
  pneu_input input[LAB_TEST_PLAN_MAX + 1][LAB_TEST_PLAN_STEPS];
  /* Normal equations of each record, one matrix for each foreseen channel, unweighted. */
  lab_normal bundle[LAB_TEST_PLAN_MAX + 1][LAB_FORECAST_CHANNELS];
  int failed[LAB_TEST_PLAN_MAX + 1]; /* not 0: could not be simulated; its bundle is empty */
  int jerky[LAB_TEST_PLAN_MAX + 1];  /* not 0: stick-slip throughout, too long to simulate many times */
  int left_out;                      /* not 0: the time was spent before all were simulated */
} design;

static const char no_time[] = "there was no time to look for one";

/* ---- Words and choice ---- */

static void say_nothing(lab_advice *advice, const char *reason)
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

static void close_design(design *s)
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

/* What a value of a foreseen channel weighs [1/SI^2] where it is sampled; 0 where it is not recorded. */
static double weight_of(const lab_advice_request *q, const lab_forecast *o, int place)
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

/* What forecast i says.  Out: sum  over the recorded channels, weighted */
static void weigh(const design *s, int i, const lab_advice_request *q, lab_normal *sum)
{
  const lab_normal *bundle = s->bundle[i];
  int c;
  lab_normal_clear(sum, bundle->k);
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++)
    lab_normal_add(sum, weight_of(q, &s->forecast[i], c), &bundle[c]);
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
  for (i = s->n - 1; i >= 0; i--) { /* the record, which all are compared with, is the last */
    lab_error mine;
    long steps = 0;
    int c;
    const int is_late = lab_cpu_is_spent(s->request.until);
    const int at = is_late ? LAB_NUMERIC : survey_one(&s->forecast[i], model, a, b, s->bundle[i], &steps, &mine);
    if (is_late) {
#pragma omp atomic write
      s->left_out = 1;
    }
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

/* Check a request, lay out its trials, and fill their bundles with the slopes of a model and the difference of two
 * others. Where no command moves the stem, advice says so and *made is NULL. In:      a, b  may be NULL: no difference
 * Out:     made  to be closed
 * Returns: as lab_discriminate. */
static int open_design(const lab_advice_request *request, const lab_forecast_model *model, const pneu_params *a,
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
    say_nothing(advice, error->text);
    error->status = error->status == LAB_WORLD ? LAB_WORLD : LAB_OK;
  } else if (survey(s, model, a, b, error) == LAB_OK) {
    *made = s;
    return LAB_OK;
  }
  close_design(s);
  return error->status;
}

/* ---- A model that is fitted to what another one predicts ---- */

typedef struct pursuit {
  const lab_advice_request *request;
  const lab_forecast *forecast;
  const lab_forecast_model *model;
  size_t m;                                             /* values of a prediction */
  double *goal;                                         /* what it is fitted to */
  double known[LAB_NORMAL_MAX + 1][LAB_NORMAL_MAX + 1]; /* rows of the other records */
} pursuit;

/* The prediction beside its goal, over the noise, and what the other records say once the model has changed by theta,
 * which is in the units of its parameters. */
static int residuals(void *context, const double *theta, double *r, lab_error *error)
{
  const pursuit *p = context;
  const int k = p->model->n, n = p->forecast->n;
  pneu_params params = p->model->params;
  int c, i, j;
  for (j = 0; j < k; j++)
    lab_forecast_shift(&params, p->model->param[j], theta[j], p->model->scale[j]);
  if (lab_forecast_run(p->forecast, &params, r, NULL, error))
    return error->status;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++) {
    const double root = sqrt(weight_of(p->request, p->forecast, c));
    for (i = c * n; i < (c + 1) * n; i++)
      r[i] = root > 0 ? root * (p->goal[i] - r[i]) : 0;
  }
  for (i = 0; i <= k; i++) {
    double *row = &r[p->m + (size_t)i];
    *row = p->known[i][k];
    for (j = 0; j < k; j++)
      *row -= p->known[i][j] * theta[j];
  }
  return LAB_OK;
}

/* A model without a slope cannot be pursued with: its parameter would stand still. */
static int slope(void *context, const double *theta, const double *r, int j, double *column, lab_error *error)
{
  const pursuit *p = context;
  const size_t m = p->m + (size_t)p->model->n + 1;
  double at[LAB_NORMAL_MAX], least, most;
  size_t i;
  memcpy(at, theta, (size_t)p->model->n * sizeof *at);
  lab_forecast_bounds(&p->model->params, p->model->param[j], p->model->scale[j], &least, &most);
  at[j] += at[j] + lab_forecast_step > most ? -lab_forecast_step : lab_forecast_step;
  if (residuals(context, at, column, error))
    return error->status == LAB_NUMERIC ? (error->status = LAB_DATA) : error->status;
  for (i = 0; i < m; i++)
    column[i] = (column[i] - r[i]) / (at[j] - theta[j]);
  return LAB_OK;
}

static int pursue(pursuit *p, double *apart, lab_error *error)
{
  double theta[LAB_NORMAL_MAX] = {0}, lower[LAB_NORMAL_MAX], upper[LAB_NORMAL_MAX];
  const lab_fit_problem problem = {.n = p->model->n,
                                   .m = p->m + (size_t)p->model->n + 1,
                                   .lower = lower,
                                   .upper = upper,
                                   .context = p,
                                   .residuals = residuals,
                                   .slope = slope,
                                   .enough = near_enough,
                                   .enough_share = near_enough};
  double chi2;
  int j;
  for (j = 0; j < p->model->n; j++)
    lab_forecast_bounds(&p->model->params, p->model->param[j], p->model->scale[j], &lower[j], &upper[j]);
  if (lab_fit(&problem, theta, &chi2, error))
    return error->status;
  *apart = sqrt(chi2);
  return LAB_OK;
}

int lab_discrepancy(const lab_advice_request *q, const lab_forecast *o, const pneu_params *goal,
                    const lab_forecast_model *model, const lab_normal *known, double *apart, lab_error *error)
{
  pursuit p = {.request = q, .forecast = o, .model = model, .m = LAB_FORECAST_CHANNELS * (size_t)o->n};
  int status;
  lab_normal_rows(known, p.known);
  if (!(p.goal = malloc(p.m * sizeof *p.goal)))
    return lab_fail_memory(error, "a response");
  if ((status = lab_forecast_run(o, goal, p.goal, NULL, error)) == LAB_OK)
    status = pursue(&p, apart, error);
  free(p.goal);
  return status;
}

/* ---- Two models ---- */

/* Both models, and the one in the middle, of which all that either would fit counts. */
typedef struct pair {
  lab_forecast_model a, b, middle;
} pair;

/* Whether an effect acts in one model and has other parameters in the other. */
static int is_own(int first, int count, pneu_params *mine, pneu_params *theirs)
{
  int i, acts = 0, differs = 0;
  for (i = first; i < first + count; i++) {
    const pneu_param_info info = lab_param_info(i);
    acts |= !info.shape && *pneu_param_at(mine, i) != info.neutral;
    differs |= *pneu_param_at(mine, i) != *pneu_param_at(theirs, i);
  }
  return acts && differs;
}

static int make_side(const lab_advice_request *q, const pneu_params *mine, const pneu_params *theirs,
                     lab_forecast_model *s, lab_error *error)
{
  pneu_params other = *theirs;
  int e, i, count;
  s->params = *mine;
  s->n = 0;
  for (i = 0; i < q->n_fit; i++)
    if (lab_side_add(s, q->fit[i], error))
      return error->status;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    if (!is_own(first, count, &s->params, &other))
      continue;
    for (i = first; i < first + count; i++)
      if (lab_side_add(s, i, error))
        return error->status;
  }
  return LAB_OK;
}

static void share_units(const lab_forecast_model *from, lab_forecast_model *to)
{
  int i, j;
  for (i = 0; i < from->n; i++)
    for (j = 0; j < to->n; j++)
      if (from->param[i] == to->param[j])
        to->scale[j] = from->scale[i];
}

static int make_pair(const lab_advice_request *q, const pneu_params *a, const pneu_params *b, pair *p, lab_error *error)
{
  pneu_params other = *b;
  int i;
  if (make_side(q, a, b, &p->a, error) || make_side(q, b, a, &p->b, error))
    return error->status;
  p->middle = p->a;
  for (i = 0; i < PNEU_PARAM_COUNT; i++) {
    pneu_real *value = pneu_param_at(&p->middle.params, i);
    *value = (*value + *pneu_param_at(&other, i)) / 2;
  }
  p->middle.n = 0;
  for (i = 0; i < p->a.n + p->b.n; i++)
    if (lab_side_add(&p->middle, i < p->a.n ? p->a.param[i] : p->b.param[i - p->a.n], error))
      return error->status;
  share_units(&p->middle, &p->a);
  share_units(&p->middle, &p->b);
  return LAB_OK;
}

/* ---- Separation of a trial ---- */

/* Leave the columns that one side would fit, in its order.  In: sign  1 or -1, of the difference */
static void take_side(const lab_normal *normal, const lab_forecast_model *middle, const lab_forecast_model *s,
                      double sign, lab_normal *part)
{
  int keep[LAB_NORMAL_MAX], i, j;
  for (j = 0; j < s->n; j++)
    for (i = 0; i < middle->n; i++)
      if (middle->param[i] == s->param[j])
        keep[j] = i;
  lab_normal_select(normal, s->n, keep, part);
  for (j = 0; j < s->n; j++)
    part->g[j][s->n] *= sign;
}

/* What has been recorded says about the difference a - b; nothing to a record that stands for itself. */
static void known_before(const design *s, int i, lab_normal *known)
{
  const int last = s->n - 1;
  if (i == last)
    lab_normal_clear(known, s->bundle[last]->k);
  else
    weigh(s, last, &s->request, known);
}

/* Estimate by the slopes of the model midway. */
static double estimate(const design *s, const lab_advice_request *q, const pair *p, int i)
{
  lab_normal normal, known, a, b;
  if (s->failed[i])
    return (double)NAN;
  weigh(s, i, q, &normal);
  known_before(s, i, &known);
  lab_normal_add(&normal, 1, &known);
  take_side(&normal, &p->middle, &p->a, 1, &a);
  take_side(&normal, &p->middle, &p->b, 1, &b);
  return fmin(lab_normal_rest(&a), lab_normal_rest(&b));
}

/* Fit each model to the other. Where motion is jerky the estimate has to do; a fit that fails leaves NaN. */
static int settle(const design *s, const lab_advice_request *q, const pair *p, int i, double *separation,
                  lab_error *error)
{
  double apart[2] = {(double)NAN, (double)NAN};
  lab_normal known;
  int way, status = LAB_OK;
  *separation = estimate(s, q, p, i);
  if (s->failed[i] || s->jerky[i])
    return LAB_OK;
  known_before(s, i, &known);
#pragma omp parallel for
  for (way = 0; way < 2; way++) {
    const lab_forecast_model *model = way ? &p->a : &p->b, *goal = way ? &p->b : &p->a;
    lab_normal mine;
    lab_error own;
    int at;
    take_side(&known, &p->middle, model, way ? -1 : 1, &mine);
    at = lab_discrepancy(q, &s->forecast[i], &goal->params, model, &mine, &apart[way], &own);
    if (at == LAB_WORLD) {
#pragma omp critical(separate_error)
      *error = own, status = at;
    } else if (at != LAB_OK) {
      apart[way] = (double)NAN;
    }
  }
  *separation = isnan(apart[0]) || isnan(apart[1]) ? (double)NAN : fmin(apart[0], apart[1]);
  return status;
}

/* The best trial: the one that is estimated best, until that is settled as well.
 * In:      enough      as in lab_trial_choose
 * Out:     separation  of the trial; 0 without one
 *          best        -1 without one */
static int find_best(const design *s, const lab_advice_request *q, const pair *p, double enough, int *best,
                     double *separation, lab_error *error)
{
  enum { TRIES = 6 };
  double value[LAB_TEST_PLAN_MAX], settled[LAB_TEST_PLAN_MAX];
  int i, tries;
  for (i = 0; i < s->plans.n; i++) {
    value[i] = estimate(s, q, p, i);
    settled[i] = (double)NAN;
  }
  for (tries = 0; tries < TRIES; tries++) {
    i = lab_trial_choose(&s->plans, value, enough);
    if (i < 0 || !isnan(settled[i]) || !(value[i] > clear) || lab_cpu_is_spent(q->until))
      break;
    if (settle(s, q, p, i, &value[i], error))
      return error->status;
    settled[i] = value[i];
  }
  if (tries == TRIES)
    i = lab_trial_choose(&s->plans, settled, enough);
  *best = i;
  *separation = i < 0 ? 0 : value[i];
  return LAB_OK;
}

/* ---- Words ---- */

/* "12 sigma"; beyond what is decisive a fit may end elsewhere, and the figure says no more than that. */
static const char *sigmas(double value, char text[32])
{
  if (value > decisive)
    snprintf(text, 32, "more than %g sigma", decisive);
  else
    snprintf(text, 32, value < 10 ? "%.1f sigma" : "%.0f sigma", value);
  return text;
}

static void say_trial(const design *s, lab_advice *advice)
{
  char most[32], least[32];
  advice->kind = LAB_ADVICE_TEST;
  snprintf(advice->text, LAB_ADVICE_TEXT, "%s", advice->plan.text);
  snprintf(advice->why, LAB_ADVICE_TEXT,
           "In %.0f s the two models would differ by %s after a refit; %s alone gives %s.", advice->plan.duration,
           sigmas(advice->separation, most), s->request.recorded ? "what has been recorded" : "a fill and vent",
           sigmas(advice->usual, least));
}

static void say_sensor(double noise, lab_advice *advice)
{
  const lab_channel_info *channel = &lab_channels[advice->channel];
  char most[32], least[32];
  advice->kind = LAB_ADVICE_SENSOR;
  snprintf(advice->text, LAB_ADVICE_TEXT,
           "no schedule of the set separates them with these sensors; record %s (%s) as well, in this test: %s",
           channel->key, channel->meaning, advice->plan.text);
  snprintf(advice->why, LAB_ADVICE_TEXT,
           "With a sensor of noise %.3g %s the two models would differ by %s after a refit; without it by about %s.",
           noise, channel->unit, sigmas(advice->with_sensor, most), sigmas(advice->separation, least));
}

/* ---- A sensor more ---- */

/* Noise of a sensor that is to be added: declared, or that of an ordinary one. */
static double noise_of_new(const lab_rig *rig, int channel)
{
  const double share = 1e-3, kelvin = 0.5; /* class 0.1 of full scale; a fine thermocouple */
  if (rig->noise[channel] > 0)
    return rig->noise[channel];
  return channel == LAB_CHANNEL_T   ? kelvin
         : channel == LAB_CHANNEL_X ? share * (double)rig->params.stroke
                                    : share * (double)rig->params.supply_pressure;
}

static int advise_sensor(const design *s, const pair *p, lab_advice *advice, lab_error *error)
{
  double noise = 0;
  int c;
  for (c = 0; c < LAB_FORECAST_CHANNELS; c++) {
    lab_advice_request more = s->request;
    double separation;
    int best;
    if (!isnan(more.noise[lab_forecast_channels[c]]))
      continue;
    more.noise[lab_forecast_channels[c]] = noise_of_new(more.rig, lab_forecast_channels[c]);
    if (find_best(s, &more, p, decisive, &best, &separation, error))
      return error->status;
    if (best < 0 || !(separation > fmax(clear, advice->with_sensor)))
      continue;
    advice->plan = s->plans.plan[best];
    advice->channel = lab_forecast_channels[c];
    advice->with_sensor = separation;
    noise = more.noise[lab_forecast_channels[c]];
  }
  if (advice->channel >= 0)
    say_sensor(noise, advice);
  return LAB_OK;
}

/* ---- Entry ---- */

static int advise(const design *s, const pair *p, lab_advice *advice, lab_error *error)
{
  int best;
  say_nothing(advice, "");
  if (settle(s, &s->request, p, s->n - 1, &advice->usual, error) ||
      find_best(s, &s->request, p, fmax(decisive, better * advice->usual), &best, &advice->separation, error))
    return error->status;
  if (best >= 0 && advice->separation > clear) {
    advice->plan = s->plans.plan[best];
    say_trial(s, advice);
    return LAB_OK;
  }
  if (best < 0 || s->left_out) {
    say_nothing(advice, s->left_out ? no_time : "no schedule of the set can be simulated with both models");
    return LAB_OK;
  }
  snprintf(advice->text, LAB_ADVICE_TEXT,
           "no schedule of the set separates them with these sensors (about %.1f sigma), nor with one more for p, "
           "x, T or ps",
           advice->separation);
  return advise_sensor(s, p, advice, error);
}

int lab_discriminate(const lab_advice_request *request, const pneu_params *a, const pneu_params *b, lab_advice *advice,
                     lab_error *error)
{
  design *s;
  pair p;
  int status;
  if (make_pair(request, a, b, &p, error) || open_design(request, &p.middle, a, b, &s, advice, error))
    return error->status;
  status = s ? advise(s, &p, advice, error) : LAB_OK;
  close_design(s);
  return status;
}

/* ---- Which trial narrows what is known least ---- */

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
  weigh(s, s->n - 1, &s->request, &present);
  find_widths(&present, w->of[s->n - 1]);
  for (i = 0; i < s->n - 1; i++) {
    weigh(s, i, &s->request, &normal);
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

/* An effect at its neutral value has no size yet: what is known is how large it could be unseen. */
static int is_neutral(const pneu_params *params, int param)
{
  pneu_params copy = *params;
  const pneu_param_info info = lab_param_info(param);
  return param != LAB_PARAM_ORIFICE_AREA && param >= PNEU_PARAM_BASE_COUNT && !info.shape &&
         *pneu_param_at(&copy, param) == info.neutral;
}

static void say_precision(const pneu_params *params, lab_advice *advice)
{
  char name[LAB_PARAM_NAME_TEXT];
  lab_fit_name(advice->param, name);
  snprintf(advice->text, LAB_ADVICE_TEXT, "%s", advice->plan.text);
  if (is_neutral(params, advice->param))
    snprintf(advice->why, LAB_ADVICE_TEXT,
             "This test would lower the detection limit of %s from %.0f %% to %.2g %% of its usual size.", name,
             100 * advice->before, 100 * advice->after);
  else
    snprintf(advice->why, LAB_ADVICE_TEXT, "This test would narrow the interval of %s to %.2g %% of its width.", name,
             100 * advice->after / advice->before);
}

/* Narrow the widest interval that can be narrowed, of parameters from one place on up to another.  Returns: whether one
 * can */
static int narrow(const design *s, const lab_forecast_model *model, const widths *w, int from, int to,
                  lab_advice *advice)
{
  const double *now = w->of[s->n - 1], worth_while = 0.9;
  int done[LAB_NORMAL_MAX] = {0}, j;
  for (j = 0; j < from; j++)
    done[j] = 1;
  while ((j = widest(now, to, done)) >= 0) {
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
    say_precision(&model->params, advice);
    return 1;
  }
  return 0;
}

int lab_advise_precision(const lab_advice_request *request, const pneu_params *params, lab_advice *advice,
                         lab_error *error)
{
  lab_forecast_model model = {*params, 0, {0}, {0}};
  widths w;
  design *s;
  int j;
  for (j = 0; j < request->n_fit; j++)
    if (lab_side_add(&model, request->fit[j], error))
      return error->status;
  if (open_design(request, &model, NULL, NULL, &s, advice, error))
    return error->status;
  if (s) {
    find_all(s, &w);
    if (!narrow(s, &model, &w, request->n_known, model.n, advice) &&
        !narrow(s, &model, &w, 0, request->n_known, advice))
      say_nothing(advice, s->left_out ? no_time : "no schedule of the set narrows an interval by a tenth");
  }
  close_design(s);
  return LAB_OK;
}
