#include "separate.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "foresee.h"

static const double clear = 5;      /* [sigma] separates */
static const double decisive = 100; /* [sigma] clear, with room for noise that is 20 times less kind than white noise */
static const double tie = 0.9;
static const double normal_95 = 1.959963984540054;

/* ---- What is simulated ---- */

/* The trials and what has been recorded, which comes last. */
typedef struct scene {
  const lab_inquiry *inquiry;
  lab_trials trials;
  int n; /* of outlooks */
  lab_outlook outlook[LAB_TRIAL_MAX + 1];
  lab_schedule schedule[LAB_TRIAL_MAX + 1];
  pneu_input input[LAB_TRIAL_MAX + 1][LAB_TRIAL_STEPS];
} scene;

static void scene_close(scene *s)
{
  int i;
  for (i = 0; s && i < s->n; i++)
    lab_outlook_close(&s->outlook[i]);
  free(s);
}

static int add_outlook(scene *s, const lab_schedule *schedule, double duration, lab_error *error)
{
  lab_outlook *outlook = &s->outlook[s->n];
  if (lab_outlook_open(s->inquiry->rig, schedule, s->trials.settle, duration, s->inquiry->spacing, outlook, error))
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

static int fill_scene(scene *s, lab_error *error)
{
  const lab_inquiry *q = s->inquiry;
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

static int scene_open(const lab_inquiry *inquiry, scene **made, lab_error *error)
{
  scene *s = *made = calloc(1, sizeof *s);
  if (!s)
    return lab_fail_memory(error, "a set of schedules");
  s->inquiry = inquiry;
  if (fill_scene(s, error) == LAB_OK)
    return LAB_OK;
  scene_close(s);
  *made = NULL;
  return error->status;
}

/* What a value of a foreseen channel weighs, for each of the samples; 0 where it is not recorded. */
static double weight(const lab_inquiry *q, const lab_outlook *o, double noise)
{
  const double rows = o->n > 1 ? (o->t[1] - o->t[0]) / q->spacing : 1;
  return isnan(noise) ? 0 : rows / (noise * noise);
}

/* Noise of a sensor that is to be added: declared, or that of an ordinary one. */
static double noise_of_new(const lab_rig *rig, int channel)
{
  const double share = 1e-3, kelvin = 0.5; /* class 0.1 of full scale; a fine thermocouple */
  if (!isnan(rig->noise[channel]))
    return rig->noise[channel];
  return channel == LAB_CHANNEL_T   ? kelvin
         : channel == LAB_CHANNEL_X ? share * (double)rig->params.stroke
                                    : share * (double)rig->params.supply_pressure;
}

/* ---- Normal equations of a record ---- */

/* One matrix for each foreseen channel, unweighted. */
typedef struct bundle {
  lab_normal channel[LAB_FORESEEN];
} bundle;

/* In:      y  slope columns, then the difference: k + 1 columns of LAB_FORESEEN * n */
static void gather(const lab_outlook *o, int k, const double *y, bundle *b)
{
  const double *column[LAB_NORMAL_MAX + 1];
  int c, j;
  for (c = 0; c < LAB_FORESEEN; c++) {
    for (j = 0; j <= k; j++)
      column[j] = y + ((size_t)j * LAB_FORESEEN + (size_t)c) * (size_t)o->n;
    memset(&b->channel[c], 0, sizeof b->channel[c]);
    b->channel[c].k = k;
    lab_normal_add(&b->channel[c], 1, column, o->n);
  }
}

static void add_scaled(lab_normal *sum, double factor, const lab_normal *normal)
{
  int i, j;
  for (i = 0; i <= normal->k; i++)
    for (j = i; j <= normal->k; j++)
      sum->g[i][j] += factor * normal->g[i][j];
}

/* Sum over the recorded channels, and one more.  In: extra  place in lab_foreseen, -1 none */
static void weigh(const lab_inquiry *q, const lab_outlook *o, const bundle *b, int extra, lab_normal *sum)
{
  int c;
  memset(sum, 0, sizeof *sum);
  sum->k = b->channel[0].k;
  for (c = 0; c < LAB_FORESEEN; c++) {
    const double noise = c == extra ? noise_of_new(q->rig, lab_foreseen[c]) : q->noise[lab_foreseen[c]];
    add_scaled(sum, weight(q, o, noise), &b->channel[c]);
  }
}

/* ---- Separation ---- */

/* A model and what of it would be fitted again. */
typedef struct side {
  pneu_params params;
  int n;
  int param[LAB_NORMAL_MAX];
} side;

/* Separations over one record [sigma]; NaN where a simulation failed. */
typedef struct gap {
  double plain;              /* with the recorded channels */
  double with[LAB_FORESEEN]; /* with one more */
} gap;

static int take_up(side *s, int param, lab_error *error)
{
  int j;
  for (j = 0; j < s->n; j++)
    if (s->param[j] == param)
      return LAB_OK;
  if (s->n == LAB_NORMAL_MAX)
    return lab_fail(error, LAB_DATA, "more than %d parameters to fit again", (int)LAB_NORMAL_MAX);
  s->param[s->n++] = param;
  return LAB_OK;
}

/* Whether an effect acts in one model and has other parameters in the other. */
static int is_own(int first, int count, pneu_params *mine, pneu_params *theirs)
{
  int i, acts = 0, differs = 0;
  for (i = first; i < first + count; i++) {
    pneu_param_info info;
    pneu_param_describe(i, &info);
    acts |= !info.shape && *pneu_param_at(mine, i) != info.neutral;
    differs |= *pneu_param_at(mine, i) != *pneu_param_at(theirs, i);
  }
  return acts && differs;
}

static int make_side(const lab_inquiry *q, const pneu_params *mine, const pneu_params *theirs, side *s,
                     lab_error *error)
{
  pneu_params other = *theirs;
  int e, i, count;
  s->params = *mine;
  s->n = 0;
  for (i = 0; i < q->n_fit; i++)
    if (take_up(s, q->fit[i], error))
      return error->status;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    if (!is_own(first, count, &s->params, &other))
      continue;
    for (i = first; i < first + count; i++)
      if (take_up(s, i, error))
        return error->status;
  }
  return LAB_OK;
}

static void measure(const lab_inquiry *q, const lab_outlook *o, const bundle *b, gap *g)
{
  lab_normal sum;
  int c;
  weigh(q, o, b, -1, &sum);
  g->plain = lab_normal_rest(&sum);
  for (c = 0; c < LAB_FORESEEN; c++) {
    weigh(q, o, b, isnan(q->noise[lab_foreseen[c]]) ? c : -1, &sum);
    g->with[c] = lab_normal_rest(&sum);
  }
}

/* A model that is being fitted to a prediction. */
typedef struct pursuit {
  const lab_inquiry *inquiry;
  const lab_outlook *outlook;
  const side *side;
  const double *goal; /* the prediction */
  pneu_params params; /* so far */
  double *own;        /* what they predict */
  double *slope;      /* side->n columns */
  double *difference; /* the column after them: goal - own */
  double *trial;      /* scratch, one column */
  bundle bundle;
  lab_normal normal; /* bundle, weighted */
  double apart;      /* [sigma] length of difference */
  double rest;       /* [sigma] what fitting should leave of it */
} pursuit;

static void look(pursuit *p)
{
  const int k = p->side->n;
  int i;
  for (i = 0; i < LAB_FORESEEN * p->outlook->n; i++)
    p->difference[i] = p->goal[i] - p->own[i];
  gather(p->outlook, k, p->slope, &p->bundle);
  weigh(p->inquiry, p->outlook, &p->bundle, -1, &p->normal);
  p->apart = sqrt(p->normal.g[k][k]);
  p->rest = lab_normal_rest(&p->normal);
}

/* Whether fitting is over: nearly all that is left is what it cannot absorb. */
static int is_near(const pursuit *p)
{
  return p->apart <= 1.05 * p->rest + 0.3;
}

static double distance(const pursuit *p, const double *y)
{
  const int n = p->outlook->n;
  double sum = 0;
  int c, i;
  for (c = 0; c < LAB_FORESEEN; c++) {
    const double w = weight(p->inquiry, p->outlook, p->inquiry->noise[lab_foreseen[c]]);
    for (i = c * n; w > 0 && i < (c + 1) * n; i++)
      sum += w * (p->goal[i] - y[i]) * (p->goal[i] - y[i]);
  }
  return sqrt(sum);
}

/* Move the parameters towards where the model is nearest, less far where that makes it worse.
 * Out:     moved  whether they did */
static int approach(pursuit *p, int *moved, lab_error *error)
{
  double prior[LAB_NORMAL_MAX], step[LAB_NORMAL_MAX], factor;
  int j;
  *moved = 0;
  for (j = 0; j < p->side->n; j++)
    prior[j] = 1; /* no parameter moves by more than its own size for nothing */
  lab_normal_step(&p->normal, prior, step);
  for (factor = 1; factor > 0.05; factor /= 2) {
    pneu_params params = p->params;
    int status;
    for (j = 0; j < p->side->n; j++)
      lab_foresee_shift(&params, p->side->param[j], factor * step[j]);
    status = lab_foresee(p->outlook, &params, p->trial, error);
    if (status != LAB_OK && status != LAB_NUMERIC)
      return status;
    if (status != LAB_OK || !(distance(p, p->trial) < p->apart))
      continue;
    memcpy(p->own, p->trial, LAB_FORESEEN * (size_t)p->outlook->n * sizeof *p->own);
    p->params = params;
    *moved = 1;
    break;
  }
  return LAB_OK;
}

/* Gauss-Newton, with slopes renewed only where a step has not arrived. */
static int pursue(pursuit *p, lab_error *error)
{
  enum { ROUNDS = 6 };
  int round, moved = 1;
  for (round = 0; round < ROUNDS && moved; round++) {
    if (lab_foresee_slopes(p->outlook, &p->params, p->side->n, p->side->param, p->own, p->slope, error))
      return error->status;
    look(p);
    if (is_near(p))
      break;
    if (approach(p, &moved, error))
      return error->status;
    look(p);
    if (is_near(p))
      break;
  }
  return LAB_OK;
}

/* How far a model stays from a prediction, however its parameters are fitted again.
 * In:      goal   the prediction
 *          own    that of the model
 *          space  s->n + 3 columns */
static int stay_apart(const lab_inquiry *q, const lab_outlook *o, const double *goal, const double *own, const side *s,
                      double *space, gap *g, lab_error *error)
{
  const size_t m = LAB_FORESEEN * (size_t)o->n;
  pursuit p;
  memset(&p, 0, sizeof p);
  p.inquiry = q;
  p.outlook = o;
  p.side = s;
  p.goal = goal;
  p.params = s->params;
  p.slope = space;
  p.difference = space + (size_t)s->n * m;
  p.trial = p.difference + m;
  p.own = p.trial + m;
  memcpy(p.own, own, m * sizeof *own);
  if (pursue(&p, error))
    return error->status;
  measure(q, o, &p.bundle, g);
  return LAB_OK;
}

static void keep_smaller(gap *g, const gap *other)
{
  int c;
  g->plain = fmin(g->plain, other->plain);
  for (c = 0; c < LAB_FORESEEN; c++)
    g->with[c] = fmin(g->with[c], other->with[c]);
}

/* Separation of two models over a record, the smaller of both ways round. */
static int separate_over(const lab_inquiry *q, const lab_outlook *o, const side *a, const side *b, gap *g,
                         lab_error *error)
{
  const size_t m = LAB_FORESEEN * (size_t)o->n;
  const size_t columns = (size_t)(a->n > b->n ? a->n : b->n) + 3;
  double *memory = malloc((columns + 2) * m * sizeof *memory), *y_a = memory, *y_b = y_a + m, *space = y_b + m;
  gap back;
  int status;
  if (!memory)
    return lab_fail_memory(error, "a response");
  if ((status = lab_foresee(o, &a->params, y_a, error)) == LAB_OK &&
      (status = lab_foresee(o, &b->params, y_b, error)) == LAB_OK &&
      (status = stay_apart(q, o, y_a, y_b, b, space, g, error)) == LAB_OK &&
      (status = stay_apart(q, o, y_b, y_a, a, space, &back, error)) == LAB_OK)
    keep_smaller(g, &back);
  free(memory);
  return status;
}

static int separate_all(const scene *s, const side *a, const side *b, gap *g, lab_error *error)
{
  int i, status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < s->n; i++) {
    lab_error mine;
    int c, at = separate_over(s->inquiry, &s->outlook[i], a, b, &g[i], &mine);
    if (at == LAB_OK)
      continue;
    g[i].plain = (double)NAN;
    for (c = 0; c < LAB_FORESEEN; c++)
      g[i].with[c] = (double)NAN;
    if (at != LAB_NUMERIC) {
#pragma omp critical(separate_error)
      *error = mine, status = at;
    }
  }
  return status;
}

/* ---- Choice ---- */

/* The trial of the largest value, the shortest of those close to it.
 * In:      stride  from value to value, in doubles
 * Returns: the trial, -1 if every value is NaN. */
static int choose(const lab_trials *trials, const double *value, size_t stride, double enough)
{
  double most = -1;
  int i, best = -1;
  for (i = 0; i < trials->n; i++)
    if (value[(size_t)i * stride] > most)
      most = value[(size_t)i * stride];
  most = fmin(most, enough);
  for (i = 0; i < trials->n; i++)
    if (value[(size_t)i * stride] >= tie * most &&
        (best < 0 || trials->trial[i].duration < trials->trial[best].duration))
      best = i;
  return best;
}

enum { GAP_DOUBLES = sizeof(gap) / sizeof(double) };

static void say(char text[LAB_ADVICE_TEXT], const char *format, ...) LAB_PRINTF(2, 3);

static void say(char text[LAB_ADVICE_TEXT], const char *format, ...)
{
  va_list args;
  va_start(args, format);
  vsnprintf(text, LAB_ADVICE_TEXT, format, args);
  va_end(args);
}

static void advise_none(lab_advice *advice, const char *reason)
{
  memset(advice, 0, sizeof *advice);
  advice->kind = LAB_ADVICE_NONE;
  advice->channel = advice->param = -1;
  say(advice->text, "%s", reason);
}

/* The extra channel with the largest separation, and its trial. */
static int choose_sensor(const scene *s, const gap *g, lab_advice *advice)
{
  int c, best = -1;
  for (c = 0; c < LAB_FORESEEN; c++) {
    const int i =
        isnan(s->inquiry->noise[lab_foreseen[c]]) ? choose(&s->trials, &g[0].with[c], GAP_DOUBLES, decisive) : -1;
    if (i < 0 || !(g[i].with[c] > fmax(clear, advice->with_sensor)))
      continue;
    best = i;
    advice->channel = lab_foreseen[c];
    advice->with_sensor = g[i].with[c];
  }
  return best;
}

/* "12 sigma"; beyond what is decisive the fit may end elsewhere, and the figure says no more than that. */
static const char *sigmas(double value, char text[32])
{
  if (value > decisive)
    snprintf(text, 32, "more than %g sigma", decisive);
  else
    snprintf(text, 32, value < 10 ? "%.1f sigma" : "%.0f sigma", value);
  return text;
}

static void advise_sensor(const scene *s, const gap *g, lab_advice *advice)
{
  char most[32], least[32];
  const int i = choose_sensor(s, g, advice);
  if (i < 0) {
    say(advice->text,
        "no schedule of the set separates them with these sensors (%.1f sigma at most), nor with one more for p, x, T "
        "or ps",
        advice->separation);
    return;
  }
  advice->kind = LAB_ADVICE_SENSOR;
  advice->trial = s->trials.trial[i];
  say(advice->text,
      "no schedule of the set separates them with these sensors; record %s (%s) as well, in this test: %s",
      lab_channels[advice->channel].key, lab_channels[advice->channel].meaning, advice->trial.text);
  say(advice->why,
      "with a sensor of noise %.3g %s they would differ by %s after fitting again, without it by %s at most",
      noise_of_new(s->inquiry->rig, advice->channel), lab_channels[advice->channel].unit,
      sigmas(advice->with_sensor, most), sigmas(advice->separation, least));
}

static void advise_trial(const scene *s, const gap *g, lab_advice *advice)
{
  char most[32], least[32];
  const double again = g[s->n - 1].plain, better = 2;
  const int i = choose(&s->trials, &g[0].plain, GAP_DOUBLES, fmax(decisive, better * again));
  advise_none(advice, "every simulation of the set failed");
  advice->usual = again;
  if (i < 0)
    return;
  advice->separation = g[i].plain;
  if (!(advice->separation > clear)) {
    advise_sensor(s, g, advice);
    return;
  }
  advice->kind = LAB_ADVICE_TRIAL;
  advice->trial = s->trials.trial[i];
  say(advice->text, "%s", advice->trial.text);
  say(advice->why, "in %.0f s they would differ by %s after fitting again; %s gives %s", advice->trial.duration,
      sigmas(advice->separation, most), s->inquiry->recorded ? "what has been recorded" : "a fill and vent",
      sigmas(advice->usual, least));
}

/* ---- Intervals ---- */

/* What records say about parameters: half widths of 95 % intervals over their scales, by the number of the outlook; the
 * last is what has been recorded, the others come on top of it. */
typedef struct widths {
  double of[LAB_TRIAL_MAX + 1][LAB_NORMAL_MAX];
} widths;

static const double hopeless = 1; /* an interval as wide as the value itself: not known */

/* Normal equations of one record of one model. */
static int inform(const lab_inquiry *q, const lab_outlook *o, const side *s, lab_normal *normal, lab_error *error)
{
  const size_t m = LAB_FORESEEN * (size_t)o->n;
  double *slope = calloc(((size_t)s->n + 2) * m, sizeof *slope), *y = slope + ((size_t)s->n + 1) * m;
  bundle b;
  int status;
  if (!slope)
    return lab_fail_memory(error, "a response");
  if ((status = lab_foresee(o, &s->params, y, error)) == LAB_OK &&
      (status = lab_foresee_slopes(o, &s->params, s->n, s->param, y, slope, error)) == LAB_OK) {
    gather(o, s->n, slope, &b);
    weigh(q, o, &b, -1, normal);
  }
  free(slope);
  return status;
}

static void find_widths(const lab_normal *normal, double *width)
{
  double prior[LAB_NORMAL_MAX];
  int j;
  for (j = 0; j < normal->k; j++)
    prior[j] = 10; /* anything from nothing to many times the value */
  lab_normal_deviations(normal, prior, width);
  for (j = 0; j < normal->k; j++)
    width[j] *= normal_95;
}

/* A trial that cannot be simulated adds nothing. */
static int inform_all(const scene *s, const side *model, widths *w, lab_error *error)
{
  lab_normal normal[LAB_TRIAL_MAX + 1];
  int i, status = LAB_OK;
  memset(normal, 0, sizeof normal);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < s->n; i++) {
    lab_error mine;
    const int at = inform(s->inquiry, &s->outlook[i], model, &normal[i], &mine);
    normal[i].k = model->n;
    if (at != LAB_OK && (at != LAB_NUMERIC || i == s->n - 1)) {
#pragma omp critical(separate_error)
      *error = mine, status = at;
    }
  }
  for (i = 0; i < s->n - 1; i++) {
    add_scaled(&normal[i], 1, &normal[s->n - 1]);
    find_widths(&normal[i], w->of[i]);
  }
  find_widths(&normal[s->n - 1], w->of[s->n - 1]);
  return status;
}

/* The widest interval at present but for those that are already done. */
static int widest(const double *width, int n, const int *done)
{
  int j, at = -1;
  for (j = 0; j < n; j++)
    if (!done[j] && (at < 0 || width[j] > width[at]))
      at = j;
  return at;
}

/* "+-3.2 %" */
static const char *percent(double width, char text[32])
{
  if (width > hopeless)
    snprintf(text, 32, "unknown");
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

static void say_narrowed(const pneu_params *params, lab_advice *advice)
{
  char name[LAB_FIT_TEXT], before[32], after[32];
  lab_fit_name(advice->param, name);
  say(advice->text, "%s", advice->trial.text);
  if (is_neutral(params, advice->param))
    say(advice->why, "would lower the size of %s that can hide in the noise from %.2g %% to %.2g %% of its usual size",
        name, 100 * advice->before, 100 * advice->after);
  else
    say(advice->why, "would narrow %s from %s to %s", name, percent(advice->before, before),
        percent(advice->after, after));
}

/* Narrow the widest interval that can be narrowed. */
static void advise_widths(const scene *s, const side *model, const widths *w, lab_advice *advice)
{
  const double *now = w->of[s->n - 1], worth_while = 0.9;
  int done[LAB_NORMAL_MAX] = {0}, j;
  advise_none(advice, "no schedule of the set narrows an interval by a tenth");
  while ((j = widest(now, model->n, done)) >= 0) {
    double gain[LAB_TRIAL_MAX];
    int i;
    for (i = 0; i < s->trials.n; i++)
      gain[i] = now[j] / w->of[i][j];
    i = choose(&s->trials, gain, 1, (double)INFINITY);
    done[j] = 1;
    if (i < 0 || !(gain[i] * worth_while > 1))
      continue;
    advice->kind = LAB_ADVICE_TRIAL;
    advice->trial = s->trials.trial[i];
    advice->param = model->param[j];
    advice->before = now[j];
    advice->after = w->of[i][j];
    say_narrowed(&model->params, advice);
    return;
  }
}

/* ---- Entries ---- */

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

/* Open the scene; where no command moves the stem, say so.  Returns: as lab_separate; *made is NULL without advice */
static int prepare(const lab_inquiry *q, scene **made, lab_advice *advice, lab_error *error)
{
  *made = NULL;
  if (check(q, error))
    return error->status;
  if (scene_open(q, made, error) == LAB_OK)
    return LAB_OK;
  advise_none(advice, error->text);
  return error->status == LAB_WORLD ? LAB_WORLD : (error->status = LAB_OK);
}

int lab_separate(const lab_inquiry *inquiry, const pneu_params *a, const pneu_params *b, lab_advice *advice,
                 lab_error *error)
{
  gap g[LAB_TRIAL_MAX + 1];
  side side_a, side_b;
  scene *s;
  int status;
  if (make_side(inquiry, a, b, &side_a, error) || make_side(inquiry, b, a, &side_b, error))
    return error->status;
  status = prepare(inquiry, &s, advice, error);
  if (status != LAB_OK || !s)
    return status;
  status = separate_all(s, &side_a, &side_b, g, error);
  if (status == LAB_OK)
    advise_trial(s, g, advice);
  scene_close(s);
  return status;
}

int lab_advise_interval(const lab_inquiry *inquiry, const pneu_params *params, lab_advice *advice, lab_error *error)
{
  widths w;
  side model;
  scene *s;
  int status;
  if (make_side(inquiry, params, params, &model, error))
    return error->status;
  status = prepare(inquiry, &s, advice, error);
  if (status != LAB_OK || !s)
    return status;
  status = inform_all(s, &model, &w, error);
  if (status == LAB_OK)
    advise_widths(s, &model, &w, advice);
  scene_close(s);
  if (status != LAB_NUMERIC)
    return status;
  advise_none(advice, error->text);
  return error->status = LAB_OK;
}
