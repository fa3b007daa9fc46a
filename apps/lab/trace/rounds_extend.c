/* Extensions of the best models: which are tried, in which order they are, and which is worth adding. */
#include "rounds_private.h"

#include <math.h>
#include <stdlib.h>

#include "../base/array.h"
#include "../base/clock.h"
#include "../rig/tolerance.h"

/* ---- Candidates side by side ---- */

void lab_rounds_note_alike(lab_rounds *s)
{
  lab_candidate_note_alike(&s->pool[0], s->pool[0].n_found - 1, s->pool + 1, s->n_pool - 1);
}

void lab_rounds_rank(lab_rounds *s)
{
  int i, k, n = 0;
  qsort(s->pool, (size_t)s->n_pool, sizeof *s->pool, lab_candidate_by_bic);
  for (i = 0; i < s->n_pool && s->pool[i].quality.fitted; i++) {
    int again = 0;
    for (k = 0; k < n; k++)
      again |= lab_candidate_is_alike_but(&s->pool[k], -1, &s->pool[i], -1);
    if (again)
      continue;
    if (n != i)
      s->pool[n] = s->pool[i];
    lab_rounds_note_step(s->result, &s->pool[n++]);
  }
  s->n_pool = n;
}

int lab_rounds_has_held(const lab_rounds *s)
{
  return lab_unfold_has_held(&s->unfolding);
}

static int is_unfolded(const lab_rounds *s, const lab_candidate *c)
{
  return s->unfolding.best.quality.fitted && s->unfolding.best.quality.bic == c->quality.bic;
}

/* ---- Extensions ---- */

/* Refit what scores best; the refits join the pool.  Out: n  of them */
static int refit_scored(lab_rounds *s, const lab_candidate *base, const lab_scores *scores, double level, int *n,
                        lab_error *error)
{
  lab_candidate *c = s->pool + s->n_pool;
  int led;
  lab_rounds_progress(s, "refitting the best candidates");
  if (lab_refit_effects(base, scores, level, c, n, error))
    return error->status;
  if (base->n_found > 0 || lab_is_noise(&base->quality) || lab_any(c, *n, lab_is_noise))
    return LAB_OK;
  if (lab_unfold_best(&s->unfolding, c, *n, error))
    return error->status;
  if (lab_any(c, *n, lab_is_noise))
    return LAB_OK;
  s->leaders = c;
  s->n_leaders = *n;
  if (lab_rounds_follow(s, LAB_PHASE_LED, error))
    return error->status;
  s->n_leaders = 0;
  if (s->has_begun || s->over)
    return LAB_OK;
  led = *n;
  if (lab_refit_hidden(base, scores, level, c, n, error))
    return error->status;
  return lab_rounds_has_held(s) ? lab_unfold_best(&s->unfolding, c + led, *n - led, error) : LAB_OK;
}

/* Whether what scores best can take off as much as an addition must (lab_rounds_measure_gain). */
static int may_be_added(const lab_rounds *s, const lab_candidate *base, const lab_score *best)
{
  const double of_channel = base->quality.values / base->u.run[0].n_channels;
  const double gain = (1 - pow(1 - s->options->min_gain, 2)) * of_channel;
  return !lab_is_noise(&base->quality) || lab_is_strained(&base->quality) ||
         best->statistic >= fmin(gain, lab_constant(LAB_PLAIN_BIC));
}

/* Significant, but not worth adding, by scores alone. */
static void list_scored(lab_search_result *r, const lab_scores *scores, double level)
{
  const double alike = scores->of[0].statistic - lab_constant(LAB_ALIKE_BIC);
  int i;
  for (i = 0; i < scores->n && scores->of[i].p_value < level && scores->of[i].statistic > alike; i++)
    lab_search_list_small(r, scores->of[i].effect);
}

/* Extend a candidate by every effect that its residual speaks for; the extensions join the pool. */
static int extend_scored(lab_rounds *s, const lab_candidate *base, const lab_projection *p, double start,
                         lab_error *error)
{
  lab_search_result *r = s->result;
  lab_scores scores;
  double level;
  int status = LAB_OK, n = 0;
  const int first = r->scores.n == 0;
  lab_rounds_progress(s, "testing all effects");
  if (lab_score_effects(p, &scores, error))
    return error->status;
  level = scores.tests > 0 ? s->options->alpha / scores.tests : 0;
  if (first)
    r->score_s = lab_clock() - start;
  if (base->n_found == 0) {
    s->projection = p;
    s->best_effect = scores.of[0].statistic;
    status = lab_rounds_follow(s, LAB_PHASE_SCORED, error);
    s->projection = NULL;
  }
  if (status != LAB_OK || s->has_begun)
    return status;
  if (!s->over && !may_be_added(s, base, &scores.of[0]))
    list_scored(r, &scores, level);
  else if (!s->over && (base->n_found > 0 || !lab_is_noise(&s->free_term.quality)))
    status = refit_scored(s, base, &scores, level, &n, error);
  if (status != LAB_OK || s->has_begun)
    return status;
  s->n_pool += n;
  if (first) {
    r->scores = scores;
    r->level = level;
  }
  return LAB_OK;
}

int lab_rounds_extend(lab_rounds *s, const lab_candidate *base, lab_error *error)
{
  const double start = lab_clock();
  lab_unknowns u = base->u;
  lab_projection p;
  int status = lab_projection_open(&u, &p, error);
  if (status == LAB_OK)
    status = extend_scored(s, base, &p, start, error);
  lab_projection_close(&p);
  return status;
}

/* Sums of squares of the residuals of each channel as they are fitted: whitened, and without what held values may
 * explain.  Returns: as lab_unknowns_residuals */
static int sum_channels(const lab_unknowns *u, double sum[LAB_CHANNEL_COUNT], lab_error *error)
{
  double *all = malloc((u->m + 1) * sizeof *all), *r = all;
  int e, c, status = all ? lab_unknowns_residuals((void *)u, NULL, r, error) : lab_fail_memory(error, "residuals");
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    sum[c] = 0;
  for (e = 0; status == LAB_OK && e < u->n_runs; e++)
    for (c = 0; c < u->run[e].n_channels; c++, r += u->run[e].n)
      sum[u->run[e].channel[c]] += lab_dot(r, r, u->run[e].n);
  free(all);
  return status;
}

/* The share by which the best extension lowers the error of some channel; where the log is seen coarsely, of all
 * channels together. */
static int gain_of(const lab_candidate *a, const lab_candidate *b, double *gain, lab_error *error)
{
  double before[LAB_CHANNEL_COUNT], after[LAB_CHANNEL_COUNT];
  int c;
  *gain = 1 - sqrt(b->quality.chi2 / a->quality.chi2);
  if (a->u.window > 0)
    return LAB_OK;
  if (sum_channels(&a->u, before, error) || sum_channels(&b->u, after, error))
    return error->status;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (before[c] > 0)
      *gain = fmax(*gain, 1 - sqrt(after[c] / before[c]));
  return LAB_OK;
}

/* Whether what was found last is an error of a sensor within what is known of it, beside something that begins and
 * leaves only noise: a change that is not quite a step leaves about as much. */
static int is_within_instruments(const lab_candidate *without, const lab_candidate *c)
{
  const lab_found *last = &c->found[c->n_found - 1];
  const int j = lab_found_is_of_sensor(last) ? lab_unknowns_find(&c->u, last->param) : -1;
  return j >= 0 && lab_is_noise(&without->quality) && lab_candidate_begins(without) &&
         fabs(c->u.unknown[j].value) < lab_tolerance(&c->u.rig, last->param);
}

int lab_rounds_measure_gain(const lab_rounds *s, int *enough, lab_error *error)
{
  const lab_candidate *a = &s->beam[0], *b = &s->pool[0];
  double gain;
  if (gain_of(a, b, &gain, error))
    return error->status;
  *enough = 0;
  if (is_within_instruments(a, b))
    return LAB_OK;
  *enough = !(gain < s->options->min_gain);
  if (lab_is_strained(&a->quality) && !lab_is_strained(&b->quality) && lab_is_noise(&b->quality))
    *enough |= !lab_found_is_of_sensor(&b->found[b->n_found - 1]);
  /* then nothing that the log recorded badly can have asked for its last effect */
  if (*enough || !(a->quality.bic - b->quality.bic > lab_constant(LAB_PLAIN_BIC)) || b->found[b->n_found - 1].term >= 0)
    return LAB_OK;
  return lab_candidate_is_white(b, enough, error);
}

/* Significant, but not worth adding: the best one, and what cannot be told from it. */
static void list_small(lab_rounds *s)
{
  lab_search_result *r = s->result;
  const lab_found *found = &s->pool[0].found[s->pool[0].n_found - 1];
  int i;
  lab_search_list_small(r, found->effect);
  for (i = 0; i < found->n_alike; i++)
    lab_search_list_small(r, found->alike[i]);
}

int lab_rounds_add_effect(lab_rounds *s, lab_error *error)
{
  const double before = s->beam[0].quality.chi2;
  int i;
  if (lab_rounds_measure_gain(s, &s->added, error))
    return error->status;
  lab_rounds_note_alike(s);
  if (!s->added) {
    list_small(s);
    return LAB_OK;
  }
  for (i = 0; i < s->n_pool && i < LAB_BEAM_WIDTH; i++) {
    lab_candidate_explain(&s->pool[i], before);
    s->beam[i] = s->pool[i];
  }
  s->n_beam = i;
  lab_rounds_note_way(s->result, &s->beam[0]);
  return LAB_OK;
}

int lab_rounds_rank_whole(lab_rounds *s, lab_error *error)
{
  if (!s->unfolding.best.quality.fitted && lab_unfold_best(&s->unfolding, s->pool, s->n_pool, error))
    return error->status;
  if (s->n_pool > 0 && is_unfolded(s, &s->pool[0]))
    s->pool[0] = s->unfolding.best;
  return LAB_OK;
}

/* Whether some candidate at hand leaves only noise, so that poorer ones need not be extended. */
static int is_settled(const lab_rounds *s)
{
  return lab_is_noise(&s->beam[0].quality) || lab_any(s->pool, s->n_pool, lab_is_noise);
}

int lab_rounds_advance(lab_rounds *s, lab_error *error)
{
  const double reach = lab_constant(LAB_RIVAL) * s->beam[0].quality.chi2;
  int i, status = LAB_OK;
  s->added = s->n_pool = s->has_begun = 0;
  s->unfolding.best.quality.fitted = 0;
  for (i = 0; status == LAB_OK && i < s->n_beam; i++)
    if (i == 0 || (!s->has_begun && !is_settled(s) && s->beam[i].quality.chi2 < reach &&
                   s->beam[i].n_found < s->options->max_effects))
      status = lab_rounds_extend(s, &s->beam[i], error);
  s->added = s->has_begun;
  if (status != LAB_OK || s->has_begun || s->over)
    return status;
  lab_rounds_rank(s);
  if (lab_rounds_rank_whole(s, error))
    return error->status;
  s->has_extended = s->n_pool > 0;
  status = lab_rounds_follow(s, LAB_PHASE_REFITTED, error);
  s->has_extended = 0;
  return status;
}
