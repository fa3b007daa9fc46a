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

enum { REFIT_STEPS = 2 };

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

static void subtract(const double *a, const double *b, int m, double *difference)
{
  int i;
  for (i = 0; i < m; i++)
    difference[i] = a[i] - b[i];
}

/* Move the parameters to where the model is nearest to what it is compared with. */
static void refit(const side *s, const lab_normal *normal, pneu_params *params)
{
  double prior[LAB_NORMAL_MAX], step[LAB_NORMAL_MAX];
  int j;
  for (j = 0; j < s->n; j++)
    prior[j] = 1; /* no parameter moves by more than its own size for nothing */
  lab_normal_step(normal, prior, step);
  for (j = 0; j < s->n; j++)
    lab_foresee_shift(params, s->param[j], step[j]);
}

static void measure(const lab_inquiry *q, const lab_outlook *o, const bundle *b, gap *g)
{
  lab_normal sum;
  int c;
  weigh(q, o, b, -1, &sum);
  g->plain = lab_normal_rest(&sum);
  for (c = 0; c < LAB_FORESEEN; c++) {
    weigh(q, o, b, c, &sum);
    g->with[c] = lab_normal_rest(&sum);
  }
}

/* How far a model stays from a prediction, however its parameters are fitted again.
 * In:      y      the prediction
 *          own    that of the model
 *          space  s->n + 2 columns */
static int stay_apart(const lab_inquiry *q, const lab_outlook *o, const double *y, const double *own, const side *s,
                      double *space, gap *g, lab_error *error)
{
  const int m = LAB_FORESEEN * o->n;
  double *difference = space + (size_t)s->n * (size_t)m, *moved = difference + m;
  pneu_params params = s->params;
  double before = (double)INFINITY;
  lab_normal sum;
  bundle b;
  int round;
  if (lab_foresee_slopes(o, &s->params, s->n, s->param, own, space, error))
    return error->status;
  subtract(y, own, m, difference);
  for (round = 0;; round++) {
    gather(o, s->n, space, &b);
    weigh(q, o, &b, -1, &sum);
    if (sum.g[s->n][s->n] > before)
      return LAB_OK; /* the step made it worse */
    before = sum.g[s->n][s->n];
    measure(q, o, &b, g);
    if (round == REFIT_STEPS)
      return LAB_OK;
    refit(s, &sum, &params);
    if (lab_foresee(o, &params, moved, error))
      return error->status == LAB_NUMERIC ? LAB_OK : error->status;
    subtract(y, moved, m, difference);
  }
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
  const size_t columns = (size_t)(a->n > b->n ? a->n : b->n) + 2;
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

static void advise_sensor(const scene *s, const gap *g, lab_advice *advice)
{
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
      "with a sensor of noise %.3g %s they would differ by %.3g sigma after fitting again, without it by %.2g at most",
      noise_of_new(s->inquiry->rig, advice->channel), lab_channels[advice->channel].unit, advice->with_sensor,
      advice->separation);
}

static void advise_trial(const scene *s, const gap *g, lab_advice *advice)
{
  const int i = choose(&s->trials, &g[0].plain, GAP_DOUBLES, decisive);
  advise_none(advice, "every simulation of the set failed");
  advice->usual = g[s->n - 1].plain;
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
  say(advice->why, "in %.0f s they would differ by %.3g sigma after fitting again; %s gives %.2g",
      advice->trial.duration, advice->separation, s->inquiry->recorded ? "what has been recorded" : "a fill and vent",
      advice->usual);
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
