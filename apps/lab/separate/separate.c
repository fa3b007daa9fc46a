#include "separate.h"

#include <math.h>
#include <stdio.h>

#include "separate_private.h"

static const double clear = 5;      /* [sigma] separates */
static const double decisive = 100; /* [sigma] clear, with room for noise that is 20 times less kind than white noise */
static const double better = 2;     /* times what has been recorded gives, or it is hardly worth the trouble */

/* ---- Two models ---- */

/* Both models, and the one in the middle, of which all that either would fit counts. */
typedef struct pair {
  side a, b, middle;
} pair;

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
    if (side_add(s, q->fit[i], error))
      return error->status;
  for (e = 0; e < PNEU_EFFECT_COUNT; e++) {
    const int first = pneu_effect_params(e, &count);
    if (!is_own(first, count, &s->params, &other))
      continue;
    for (i = first; i < first + count; i++)
      if (side_add(s, i, error))
        return error->status;
  }
  return LAB_OK;
}

static void share_units(const side *from, side *to)
{
  int i, j;
  for (i = 0; i < from->n; i++)
    for (j = 0; j < to->n; j++)
      if (from->param[i] == to->param[j])
        to->scale[j] = from->scale[i];
}

static int make_pair(const lab_inquiry *q, const pneu_params *a, const pneu_params *b, pair *p, lab_error *error)
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
    if (side_add(&p->middle, i < p->a.n ? p->a.param[i] : p->b.param[i - p->a.n], error))
      return error->status;
  share_units(&p->middle, &p->a);
  share_units(&p->middle, &p->b);
  return LAB_OK;
}

/* ---- Separation of a trial ---- */

/* Leave the columns that one side would fit, in its order.  In: sign  1 or -1, of the difference */
static void take_side(const lab_normal *normal, const side *middle, const side *s, double sign, lab_normal *part)
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
static void known_before(const scene *s, int i, lab_normal *known)
{
  const int last = s->n - 1;
  if (i == last)
    lab_normal_clear(known, s->bundle[last].channel[0].k);
  else
    bundle_weigh(&s->bundle[last], &s->inquiry, &s->outlook[last], known);
}

/* Estimate by the slopes of the model midway. */
static double estimate(const scene *s, const lab_inquiry *q, const pair *p, int i)
{
  lab_normal normal, known, a, b;
  if (s->failed[i])
    return (double)NAN;
  bundle_weigh(&s->bundle[i], q, &s->outlook[i], &normal);
  known_before(s, i, &known);
  lab_normal_add(&normal, 1, &known);
  take_side(&normal, &p->middle, &p->a, 1, &a);
  take_side(&normal, &p->middle, &p->b, 1, &b);
  return fmin(lab_normal_rest(&a), lab_normal_rest(&b));
}

/* Fit each model to the other. Where motion is jerky the estimate has to do; a fit that fails leaves NaN. */
static int settle(const scene *s, const lab_inquiry *q, const pair *p, int i, double *separation, lab_error *error)
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
    const side *model = way ? &p->a : &p->b, *goal = way ? &p->b : &p->a;
    lab_normal mine;
    lab_error own;
    int at;
    take_side(&known, &p->middle, model, way ? -1 : 1, &mine);
    at = pursue(q, &s->outlook[i], &goal->params, model, &mine, &apart[way], &own);
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
 * In:      enough      as in trial_choose
 * Out:     separation  of the trial; 0 without one
 *          best        -1 without one */
static int find_best(const scene *s, const lab_inquiry *q, const pair *p, double enough, int *best, double *separation,
                     lab_error *error)
{
  enum { TRIES = 6 };
  double value[LAB_TRIAL_MAX], settled[LAB_TRIAL_MAX];
  int i = -1, tries;
  for (i = 0; i < s->trials.n; i++) {
    value[i] = estimate(s, q, p, i);
    settled[i] = (double)NAN;
  }
  for (tries = 0; tries < TRIES; tries++) {
    i = trial_choose(&s->trials, value, enough);
    if (i < 0 || !isnan(settled[i]) || !(value[i] > clear))
      break;
    if (settle(s, q, p, i, &value[i], error))
      return error->status;
    settled[i] = value[i];
  }
  if (tries == TRIES)
    i = trial_choose(&s->trials, settled, enough);
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

static void say_trial(const scene *s, lab_advice *advice)
{
  char most[32], least[32];
  advice->kind = LAB_ADVICE_TRIAL;
  advice_say(advice->text, "%s", advice->trial.text);
  advice_say(advice->why, "in %.0f s they would come to differ by %s, whatever is fitted again; %s alone gives %s",
             advice->trial.duration, sigmas(advice->separation, most),
             s->inquiry.recorded ? "what has been recorded" : "a fill and vent", sigmas(advice->usual, least));
}

static void say_sensor(double noise, lab_advice *advice)
{
  const lab_channel_info *channel = &lab_channels[advice->channel];
  char most[32], least[32];
  advice->kind = LAB_ADVICE_SENSOR;
  advice_say(advice->text,
             "no schedule of the set separates them with these sensors; record %s (%s) as well, in this test: %s",
             channel->key, channel->meaning, advice->trial.text);
  advice_say(advice->why,
             "with a sensor of noise %.3g %s they would come to differ by %s, whatever is fitted again; without it by "
             "about %s",
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

static int advise_sensor(const scene *s, const pair *p, lab_advice *advice, lab_error *error)
{
  double noise = 0;
  int c;
  for (c = 0; c < LAB_FORESEEN; c++) {
    lab_inquiry more = s->inquiry;
    double separation;
    int best;
    if (!isnan(more.noise[lab_foreseen[c]]))
      continue;
    more.noise[lab_foreseen[c]] = noise_of_new(more.rig, lab_foreseen[c]);
    if (find_best(s, &more, p, decisive, &best, &separation, error))
      return error->status;
    if (best < 0 || !(separation > fmax(clear, advice->with_sensor)))
      continue;
    advice->trial = s->trials.trial[best];
    advice->channel = lab_foreseen[c];
    advice->with_sensor = separation;
    noise = more.noise[lab_foreseen[c]];
  }
  if (advice->channel >= 0)
    say_sensor(noise, advice);
  return LAB_OK;
}

/* ---- Entry ---- */

static int advise(const scene *s, const pair *p, lab_advice *advice, lab_error *error)
{
  int best;
  advice_none(advice, "");
  if (settle(s, &s->inquiry, p, s->n - 1, &advice->usual, error) ||
      find_best(s, &s->inquiry, p, fmax(decisive, better * advice->usual), &best, &advice->separation, error))
    return error->status;
  if (best >= 0 && advice->separation > clear) {
    advice->trial = s->trials.trial[best];
    say_trial(s, advice);
    return LAB_OK;
  }
  if (best < 0) {
    advice_none(advice, "no schedule of the set can be simulated with both models");
    return LAB_OK;
  }
  advice_say(advice->text,
             "no schedule of the set separates them with these sensors (about %.1f sigma), nor with one more for p, "
             "x, T or ps",
             advice->separation);
  return advise_sensor(s, p, advice, error);
}

int lab_separate(const lab_inquiry *inquiry, const pneu_params *a, const pneu_params *b, lab_advice *advice,
                 lab_error *error)
{
  scene *s;
  pair p;
  int status;
  if (make_pair(inquiry, a, b, &p, error))
    return error->status;
  status = scene_open(inquiry, &s, advice, error);
  if (status != LAB_OK || !s)
    return status;
  if ((status = scene_survey(s, &p.middle, a, b, error)) == LAB_OK)
    status = advise(s, &p, advice, error);
  scene_close(s);
  return status;
}
