#include "rounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../fit/nuisance.h"
#include "../rig/tolerance.h"
#include "unfold.h"

/* Where the search is and what it is to bring. */
typedef struct search {
  const lab_search_options *options;
  lab_search_result *result;
  lab_candidate declared;             /* the declared model, fitted unless something is known to begin */
  lab_candidate onset;                /* the declared model with what begins within its run; as free_term */
  lab_candidate free_term;            /* it with the best free term; not fitted: not tried yet, or none */
  const lab_quality *within;          /* the declared model with its values within tolerances; NULL: that is it */
  lab_candidate without;              /* what is left when an effect is left out */
  lab_unfolding unfolding;            /* extensions with all their values fitted, and the best of these */
  lab_candidate beam[LAB_BEAM_WIDTH]; /* best candidates so far, best first */
  int n_beam;
  lab_candidate pool[LAB_BEAM_WIDTH * LAB_REFIT_MAX]; /* extensions of them */
  int n_pool;
  int round, added, rounds_over, over;
  int is_final;                     /* the time is spent, and the best model fitted with all its values */
  int has_begun;                    /* something that begins was taken up in this round */
  int has_extended;                 /* pool[0] is the best extension of the best candidate */
  lab_nuisance nuisance;            /* what is declared, within its tolerances */
  const lab_projection *projection; /* of the declared model, while it is open */
  lab_onset_scores begins;          /* of what may begin within the run, there */
  const lab_candidate *leaders;     /* first refits of effects, while they are looked at */
  int n_leaders;
  double best_effect; /* largest score of an effect there */
  lab_term_score term[LAB_TERM_SCORES_MAX];
  int n_terms; /* scores of free terms there, best first */
} search;

/* Follow the rules of a phase that hold, in order. */
static int follow_rules(search *s, enum lab_phase phase, lab_error *error);

/* A model with what was missing is nearer to the truth: its values are what the others vary about from here on. */
static int linearise_again(search *s, lab_error *error);

static void on_progress(const search *s, const char *what)
{
  if (s->options->on_progress)
    s->options->on_progress(s->options->context, what);
}

/* ---- What is noted for the result ---- */

/* A model that was tried. */
static void note_step(lab_search_result *result, const lab_candidate *c)
{
  lab_tried_model *step = result->n_steps < LAB_SEARCH_STEPS ? &result->step[result->n_steps++] : NULL;
  if (!step)
    return;
  lab_candidate_name(c, step->name, sizeof step->name);
  step->chi2 = c->quality.chi2;
  step->bic = c->quality.bic;
}

/* A model that the search goes on from. */
static void note_way(lab_search_result *result, const lab_candidate *c)
{
  lab_error ignored;
  lab_unknowns u = c->u;
  lab_path_model *way = result->n_path < LAB_SEARCH_PATH ? &result->path[result->n_path++] : NULL;
  if (!way)
    return;
  lab_candidate_name(c, way->name, sizeof way->name);
  way->chi2 = c->quality.chi2;
  way->bic = c->quality.bic;
  if (c->u.nuisance)
    lab_nuisance_return(&u, &ignored);
  way->rig = u.rig;
}

/* A free term that is significant, but not worth adding. */
static void note_small(lab_search_result *result, const pneu_term *term)
{
  result->small = *term;
  result->has_small = 1;
}

/* ---- Candidates side by side ---- */

/* Whether two candidates have the same, whatever was added first, beside one addition of each; -1: beside nothing. */
static int is_alike_but(const lab_candidate *a, int which_a, const lab_candidate *b, int which_b)
{
  int i, k, all = a->n_found == b->n_found;
  for (i = 0; i < a->n_found; i++) {
    int any = i == which_a;
    for (k = 0; k < b->n_found; k++)
      any |= k != which_b && a->found[i].param == b->found[k].param && a->found[i].term == b->found[k].term;
    all &= any;
  }
  return all;
}

/* Whether the log cannot tell a candidate from a better one. */
static int is_as_good(const lab_quality *better, const lab_quality *q)
{
  return !(fmin(q->bic - better->bic, q->chi2 - better->chi2) > lab_constant(LAB_ALIKE_BIC));
}

/* Effects of a pool, each added last, that are as good as one of a candidate's in its place: a better fit by one
 * unknown more is no reason to choose it, but nor does the log speak against it. */
static void note_alike(lab_candidate *c, int which, const lab_candidate *pool, int n)
{
  lab_found *found = &c->found[which];
  lab_rig end;
  int i, k;
  found->n_alike = 0;
  for (i = 0; found->effect >= 0 && i < n; i++) {
    const int last = pool[i].n_found - 1, effect = pool[i].found[last].effect;
    int known = effect < 0 || effect == found->effect;
    for (k = 0; k < found->n_alike; k++)
      known |= found->alike[k] == effect;
    if (known || !is_as_good(&c->quality, &pool[i].quality) || !is_alike_but(c, which, &pool[i], last))
      continue;
    if (found->n_alike < LAB_LEADERS_MAX) {
      lab_rig_at(&pool[i].u.rig, HUGE_VAL, &end);
      found->alike_params[found->n_alike] = end.params;
    }
    found->alike[found->n_alike++] = effect;
  }
}

/* The same for what was added last to the best of the pool. */
static void note_alike_best(search *s)
{
  note_alike(&s->pool[0], s->pool[0].n_found - 1, s->pool + 1, s->n_pool - 1);
}

/* Sort the pool, best first, without what could not be fitted, and each model once. */
static void rank(search *s)
{
  int i, k, n = 0;
  qsort(s->pool, (size_t)s->n_pool, sizeof *s->pool, lab_candidate_by_bic);
  for (i = 0; i < s->n_pool && s->pool[i].quality.fitted; i++) {
    int again = 0;
    for (k = 0; k < n; k++)
      again |= is_alike_but(&s->pool[k], -1, &s->pool[i], -1);
    if (again)
      continue;
    if (n != i)
      s->pool[n] = s->pool[i];
    note_step(s->result, &s->pool[n++]);
  }
  s->n_pool = n;
}

/* Whether declared values vary unseen within their tolerances. */
static int has_held(const search *s)
{
  return lab_unfold_has_held(&s->unfolding);
}

static int is_unfolded(const search *s, const lab_candidate *c)
{
  return s->unfolding.best.quality.fitted && s->unfolding.best.quality.bic == c->quality.bic;
}

/* ---- Extensions ---- */

/* Refit what scores best; the refits join the pool.  Out: n  of them */
static int refit_scored(search *s, const lab_candidate *base, const lab_scores *scores, double level, int *n,
                        lab_error *error)
{
  lab_candidate *c = s->pool + s->n_pool;
  int led;
  on_progress(s, "refitting the best candidates");
  if (lab_refit_effects(base, scores, level, c, n, error))
    return error->status;
  if (base->n_found > 0 || lab_is_noise(&base->quality) || lab_any(c, *n, lab_is_noise))
    return LAB_OK;
  if (has_held(s) && lab_unfold_best(&s->unfolding, c, *n, error))
    return error->status;
  if (lab_any(c, *n, lab_is_noise))
    return LAB_OK;
  s->leaders = c;
  s->n_leaders = *n;
  if (follow_rules(s, LAB_PHASE_LED, error))
    return error->status;
  s->n_leaders = 0;
  if (s->has_begun || s->over)
    return LAB_OK;
  led = *n;
  if (lab_refit_hidden(base, scores, level, c, n, error))
    return error->status;
  return has_held(s) ? lab_unfold_best(&s->unfolding, c + led, *n - led, error) : LAB_OK;
}

/* Extend a candidate by every effect that its residual speaks for; the extensions join the pool. */
static int extend_scored(search *s, const lab_candidate *base, const lab_projection *p, double start, lab_error *error)
{
  lab_search_result *r = s->result;
  lab_scores scores;
  double level;
  int status = LAB_OK, n = 0;
  const int first = r->scores.n == 0;
  on_progress(s, "testing all effects");
  if (lab_score_effects(p, &scores, error))
    return error->status;
  level = scores.tests > 0 ? s->options->alpha / scores.tests : 0;
  if (first)
    r->score_s = lab_clock() - start;
  if (base->n_found == 0) {
    s->projection = p;
    s->best_effect = scores.of[0].statistic;
    status = follow_rules(s, LAB_PHASE_SCORED, error);
    s->projection = NULL;
  }
  if (status != LAB_OK || s->has_begun)
    return status;
  if (!s->over && !lab_is_noise(&s->free_term.quality))
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

static int extend(search *s, const lab_candidate *base, lab_error *error)
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

/* The share by which the best extension lowers the error of some channel, what varies unseen taken out of it; where the
 * log is seen coarsely, of all channels together. */
static int gain_of(const lab_candidate *a, const lab_candidate *b, double *gain, lab_error *error)
{
  lab_errors before, after;
  int c;
  *gain = 1 - sqrt(b->quality.chi2 / a->quality.chi2);
  if (a->u.window > 0)
    return LAB_OK;
  if (lab_fitted_errors(&a->u, &before, error) || lab_fitted_errors(&b->u, &after, error))
    return error->status;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (before.rmse[c] > 0)
      *gain = fmax(*gain, 1 - after.rmse[c] / before.rmse[c]);
  return LAB_OK;
}

/* Whether a candidate leaves white noise: then nothing that the log recorded badly can have asked for its last effect.
 */
static int measure_whiteness(const lab_candidate *c, int *white, lab_error *error)
{
  lab_residual_stats left[LAB_CHANNEL_COUNT];
  *white = 0;
  if (c->u.window > 0 || c->found[c->n_found - 1].term >= 0)
    return LAB_OK;
  if (lab_unknowns_residual_stats(&c->u, left, error))
    return error->status;
  *white = lab_residual_stats_white(left);
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

/* Whether it lowers it by as much as is asked for, or plainly does and leaves white noise, or it explains the logs and
 * declared values need no longer be beyond their tolerances for it, and not because a sensor is. */
static int measure_gain(const search *s, int *enough, lab_error *error)
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
  if (*enough || !(a->quality.bic - b->quality.bic > lab_constant(LAB_PLAIN_BIC)))
    return LAB_OK;
  return measure_whiteness(b, enough, error);
}

/* Significant, but not worth adding: the best one, and what cannot be told from it. */
static void list_small(search *s)
{
  lab_search_result *r = s->result;
  const lab_found *found = &s->pool[0].found[s->pool[0].n_found - 1];
  int i;
  r->listed[r->n_listed++] = found->effect;
  for (i = 0; i < found->n_alike && r->n_listed < LAB_SCORES_MAX; i++)
    r->listed[r->n_listed++] = found->alike[i];
}

/* The best extensions are what the next round begins with. */
static int add_effect(search *s, lab_error *error)
{
  const double before = s->beam[0].quality.chi2;
  int i;
  if (measure_gain(s, &s->added, error))
    return error->status;
  note_alike_best(s);
  if (!s->added) {
    list_small(s);
    return LAB_OK;
  }
  for (i = 0; i < s->n_pool && i < LAB_BEAM_WIDTH; i++) {
    lab_candidate_explain(&s->pool[i], before);
    s->beam[i] = s->pool[i];
  }
  s->n_beam = i;
  note_way(s->result, &s->beam[0]);
  return LAB_OK;
}

/* The pool as it is with all values fitted, which may be known already; the best one stays so. */
static int rank_whole(search *s, lab_error *error)
{
  if (!s->unfolding.best.quality.fitted && lab_unfold_best(&s->unfolding, s->pool, s->n_pool, error))
    return error->status;
  if (s->n_pool > 0 && is_unfolded(s, &s->pool[0]))
    s->pool[0] = s->unfolding.best;
  return LAB_OK;
}

/* Whether some candidate at hand leaves only noise, so that poorer ones need not be extended. */
static int is_settled(const search *s)
{
  return lab_is_noise(&s->beam[0].quality) || lab_any(s->pool, s->n_pool, lab_is_noise);
}

/* One round: extend the candidates of the beam, and take the best extensions if they are worth it. */
static int advance(search *s, lab_error *error)
{
  const double reach = lab_constant(LAB_RIVAL) * s->beam[0].quality.chi2;
  int i, status = LAB_OK;
  s->added = s->n_pool = s->has_begun = 0;
  s->unfolding.best.quality.fitted = 0;
  for (i = 0; status == LAB_OK && i < s->n_beam; i++)
    if (i == 0 || (!s->has_begun && !is_settled(s) && s->beam[i].quality.chi2 < reach))
      status = extend(s, &s->beam[i], error);
  s->added = s->has_begun;
  if (status != LAB_OK || s->has_begun || s->over)
    return status;
  rank(s);
  if (rank_whole(s, error))
    return error->status;
  s->has_extended = s->n_pool > 0;
  status = follow_rules(s, LAB_PHASE_REFITTED, error);
  s->has_extended = 0;
  return status;
}

/* ---- What was found before, again ---- */

static void drop_effect(lab_candidate *c, const lab_found *found)
{
  if (lab_unknowns_find_onset(&c->u, found->param) >= 0)
    lab_unknowns_drop_onset(&c->u);
  if (found->shape >= 0)
    lab_unknowns_drop(&c->u, found->shape);
  lab_unknowns_drop(&c->u, found->param);
}

/* In:  which  the last one, if it is a free term */
static void drop_found(lab_candidate *c, int which)
{
  int k;
  if (c->found[which].term >= 0)
    lab_unknowns_drop_term(&c->u);
  else
    drop_effect(c, &c->found[which]);
  c->n_found--;
  for (k = which; k < c->n_found; k++)
    c->found[k] = c->found[k + 1];
}

/* What the last fit has put to its neutral value is not there. */
static void drop_neutral(lab_candidate *c)
{
  int i = c->n_found;
  lab_rig last;
  lab_rig_at(&c->u.rig, HUGE_VAL, &last);
  while (i-- > 0) {
    pneu_param_info info;
    if (c->found[i].effect < 0)
      continue;
    pneu_param_describe(c->found[i].param, &info);
    if (*pneu_param_at(&last.params, c->found[i].param) == info.neutral)
      drop_found(c, i);
  }
}

/* Without one of the found effects, fitted again, or not fitted where no fit is found.  Returns: LAB_OK, LAB_WORLD. */
static int leave_out(const lab_candidate *c, int which, lab_candidate *without, lab_error *error)
{
  *without = *c;
  drop_found(without, which);
  return lab_candidate_fit(without, LAB_ROUNDS_ALL, error) == LAB_WORLD ? LAB_WORLD : LAB_OK;
}

/* Take out again what is not needed now that other effects have come. */
static int remove_needless(search *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0], *without = &s->without;
  int i, status = LAB_OK;
  for (i = 0; status == LAB_OK && best->n_found > 1 && i < best->n_found - 1; i++) {
    if (best->found[i].term >= 0)
      continue;
    status = leave_out(best, i, without, error);
    if (status == LAB_OK && without->quality.fitted && without->quality.bic <= best->quality.bic) {
      *best = *without;
      i = -1;
    }
  }
  return status;
}

/* Take the best extension in place of the best candidate.  Out: other  whether it has something else */
static int swap_in(search *s, double chi2_without, int *other, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  *other = !is_alike_but(best, -1, &s->pool[0], -1);
  lab_candidate_explain(&s->pool[0], chi2_without);
  note_alike_best(s);
  *best = s->pool[0];
  return s->nuisance.n > 0 ? linearise_again(s, error) : LAB_OK;
}

/* An effect that was the best one alone need not be the best one beside those that came after it: put each earlier one
 * to the test again, and all of them where one has given way to another. */
static int exchange(search *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0], *without = &s->without;
  int i, other, again = LAB_EFFECTS_MAX, status = LAB_OK;
  for (i = 0; status == LAB_OK && !s->over && i < best->n_found - 1; i++) {
    if (best->found[i].term >= 0)
      continue;
    status = leave_out(best, i, without, error);
    if (status != LAB_OK || !without->quality.fitted)
      continue;
    s->n_pool = 0;
    if (extend(s, without, error) == LAB_WORLD)
      return error->status;
    rank(s);
    s->unfolding.best.quality.fitted = 0;
    if (rank_whole(s, error))
      return error->status;
    if (s->n_pool == 0 || s->pool[0].quality.bic >= best->quality.bic) {
      note_alike(best, i, s->pool, s->n_pool);
      continue;
    }
    status = swap_in(s, without->quality.chi2, &other, error);
    if (other && again-- > 0)
      i = -1;
  }
  return status;
}

/* ---- What begins within the run ---- */

/* The p-value that a score of what begins has to pass. */
static double onset_level(const search *s)
{
  return s->options->alpha / (s->begins.tests > 0 ? s->begins.tests : 1);
}

/* The best of what may begin, of those that score above a share of what acts throughout. */
static int fit_onset(search *s, enum lab_constant share, lab_error *error)
{
  const lab_onset_scores *all = &s->begins;
  const double bar = lab_constant(share) * fmax(all->throughout, s->best_effect);
  on_progress(s, "looking for what begins within the log");
  return lab_refit_onset(&s->beam[0], all, onset_level(s), bar, &s->onset, error);
}

static void take_onset(search *s)
{
  s->beam[0] = s->onset;
  s->n_beam = 1;
  s->has_begun = 1;
  note_step(s->result, &s->beam[0]);
  note_way(s->result, &s->beam[0]);
}

/* ---- Free terms ---- */

static int refit_terms(search *s, const lab_candidate *base, lab_candidate *best, lab_error *error)
{
  on_progress(s, "trying free terms");
  return lab_refit_free_terms(base, s->term, s->n_terms, best, error);
}

/* The best free term ranks as it does with all its values fitted. */
static int unfold_term(search *s, lab_error *error)
{
  lab_candidate *whole = &s->unfolding.whole;
  if (lab_unfold(&s->unfolding, &s->free_term, whole, error))
    return error->status;
  if (whole->quality.fitted)
    s->free_term.quality = whole->quality;
  return LAB_OK;
}

/* Whether a refit might be worth it, were it to take twice as much off chi-square as the score says. */
static int may_pay(const search *s, const lab_candidate *base, const lab_term_score *t)
{
  const double left = 1 - s->options->min_gain, values = base->quality.values / base->u.run[0].n_channels;
  return 2 * t->statistic > (1 - left * left) * values;
}

/* Whether its score says that a free term lowers BIC. */
static int lowers_bic(const lab_candidate *base, const lab_term_score *t)
{
  return t->statistic > lab_constant(LAB_TERM_BIC) + t->degrees * log(base->quality.values);
}

/* The best free term beside a candidate, if its score passes; where only noise is left and it can take MIN_GAIN off no
 * error, it is noted as small at once.  Out: best, fitted or not */
static int find_term(search *s, const lab_candidate *base, lab_candidate *best, lab_error *error)
{
  const lab_term_score *t = s->term;
  lab_unknowns u = base->u;
  lab_projection p;
  int status = lab_projection_open(&u, &p, error);
  best->quality.fitted = 0;
  if (status == LAB_OK)
    status = lab_score_free_terms(&p, s->term, &s->n_terms, error);
  if (status == LAB_OK && s->n_terms > 0 && t->degrees > 0 &&
      lab_free_term_p_value(&t->term, t->statistic, t->degrees) < s->result->level) {
    if (!lab_is_noise(&base->quality) || may_pay(s, base, t))
      status = refit_terms(s, base, best, error);
    else if (lowers_bic(base, t))
      note_small(s->result, &t->term);
  }
  lab_projection_close(&p);
  return status;
}

/* The declared model with a free term takes the place of what was found. */
static void take_term(search *s)
{
  s->beam[0] = s->free_term;
  note_step(s->result, &s->beam[0]);
  s->result->n_path = 1;
  note_way(s->result, &s->beam[0]);
}

/* The free term beside what was found joins it, which may then be needless. */
static int add_term(search *s, lab_error *error)
{
  const lab_candidate *with = &s->pool[0];
  int enough;
  note_step(s->result, with);
  if (measure_gain(s, &enough, error))
    return error->status;
  if (!enough) {
    note_small(s->result, &with->u.rig.term[with->u.rig.n_terms - 1]);
    return LAB_OK;
  }
  s->beam[0] = *with;
  if (remove_needless(s, error))
    return error->status;
  note_way(s->result, &s->beam[0]);
  return LAB_OK;
}

/* ---- Rules ---- */

int lab_rounds_may_begin(const lab_unknowns *u, const lab_search_options *options)
{
  return options->may_begin && u->n_runs == 1 && u->window == 0 && u->rig.n_onsets == 0;
}

static lab_facts facts_of(const search *s)
{
  const lab_candidate *best = &s->beam[0];
  lab_facts f = {0};
  int i;
  f.round = s->round;
  f.coarse = best->u.window > 0;
  f.added = s->added;
  f.has_begun = s->has_begun;
  f.held = has_held(s);
  f.declared = s->declared.quality;
  if (s->within)
    f.within = *s->within;
  f.best = best->quality;
  f.n_found = best->n_found;
  f.n_terms = best->u.rig.n_terms;
  for (i = 0; i < best->n_found; i++)
    f.found_term |= best->found[i].term >= 0;
  f.can_begin = lab_rounds_may_begin(&best->u, s->options);
  f.onset = s->onset.quality;
  f.free_term = s->free_term.quality;
  if (s->has_extended)
    f.extended = s->pool[0].quality;
  for (i = 0; i < s->n_leaders; i++)
    if (s->leaders[i].quality.fitted && (!f.extended.fitted || s->leaders[i].quality.bic < f.extended.bic))
      f.extended = s->leaders[i].quality;
  f.begins = s->begins.n > 0 ? s->begins.of[0].statistic : 0;
  f.throughout = fmax(s->begins.throughout, s->best_effect);
  f.excess = s->projection ? s->projection->excess : 0;
  f.effect = s->best_effect;
  f.term = s->n_terms > 0 ? s->term[0].statistic : 0;
  return f;
}

static int act(search *s, int action, lab_error *error)
{
  switch (action) {
  case LAB_DO_SCORE_ONSETS:
    return lab_onset_scores_find(s->projection, 0, s->beam[0].u.run->n, &s->begins, error);
  case LAB_DO_FIT_CLEAR_ONSET:
    return fit_onset(s, LAB_ONSET_CLEAR, error);
  case LAB_DO_FIT_ONSET:
    return fit_onset(s, LAB_ONSET_SHARE, error);
  case LAB_DO_TAKE_ONSET:
    take_onset(s);
    break;
  case LAB_DO_SCORE_TERMS:
    return lab_score_free_terms(s->projection, s->term, &s->n_terms, error);
  case LAB_DO_FIT_SCORED_TERM:
    if (!s->declared.quality.fitted)
      break;
    return refit_terms(s, &s->declared, &s->free_term, error);
  case LAB_DO_UNFOLD_TERM:
    return unfold_term(s, error);
  case LAB_DO_FIT_TERM:
    if (!s->declared.quality.fitted)
      break;
    return find_term(s, &s->declared, &s->free_term, error);
  case LAB_DO_FIT_TERM_BESIDE:
    s->has_extended = 1;
    return find_term(s, &s->beam[0], &s->pool[0], error);
  case LAB_DO_ADD_EFFECT:
    return add_effect(s, error);
  case LAB_DO_ADD_TERM:
    return add_term(s, error);
  case LAB_DO_REMOVE_NEEDLESS:
    return remove_needless(s, error);
  case LAB_DO_EXCHANGE:
    return exchange(s, error);
  case LAB_DO_TAKE_TERM:
    take_term(s);
    break;
  case LAB_DO_END_ROUNDS:
    s->rounds_over = 1;
    break;
  case LAB_DO_END:
    s->over = 1;
    break;
  }
  return LAB_OK;
}

static int follow_rules(search *s, enum lab_phase phase, lab_error *error)
{
  int i, status = LAB_OK;
  for (i = 0; status == LAB_OK && i < lab_rule_count && !s->over; i++) {
    const lab_facts f = facts_of(s);
    if (lab_rules[i].phase == phase && lab_rules[i].holds(&f))
      status = act(s, lab_rules[i].action, error);
  }
  return status;
}

/* ---- The search ---- */

/* What has a prior varies unseen from here on. */
static int linearise(search *s, lab_error *error)
{
  if (s->declared.u.window > 0) /* an instant moves whole slips */
    return LAB_OK;
  if (lab_nuisance_open(&s->declared.u, &s->nuisance, error))
    return error->status;
  return lab_candidate_fit(&s->declared, LAB_ROUNDS_ALL, error);
}

/* Fit what is to be the answer: as far as the time goes, and a step where it is spent, for which there is a tenth more.
 */
static int fit_in_time(lab_candidate *c, lab_error *error)
{
  static const double more = 0.1;
  const double until = c->u.until;
  int status;
  if (!lab_cpu_is_spent(until))
    return lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  c->u.until = until > 0 ? lab_cpu_time() + more * until : 0;
  status = lab_candidate_fit(c, 1, error);
  c->u.until = until;
  return status;
}

/* The best model with all its values fitted; as it is where that fails. */
static int unfold(search *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  int status = LAB_OK;
  if (!best->u.nuisance && (s->is_final || !has_held(s))) /* fitted to the end before */
    return status;
  if (best->u.nuisance && lab_nuisance_return(&best->u, error))
    return error->status;
  s->without = *best;
  best->u.until = s->declared.u.until;
  status = fit_in_time(best, error);
  if (status == LAB_NUMERIC) {
    *best = s->without;
    status = LAB_OK;
  }
  s->result->path[s->result->n_path - 1].rig = best->u.rig;
  return status;
}

/* A model about the same values as another: what the nuisance holds is where it is there. */
static int move_to(const lab_nuisance *h, lab_candidate *c, lab_error *error)
{
  int k, status;
  if (!c->quality.fitted)
    return LAB_OK;
  c->u.nuisance = h;
  c->u.misfit = h->misfit;
  for (k = 0; k < h->n; k++)
    if (h->of[k].kind == LAB_UNKNOWN_PARAM && h->of[k].run == LAB_ALL_RUNS)
      *pneu_param_at(&c->u.rig.params, h->of[k].index) = (pneu_real)h->of[k].value;
  lab_unknowns_take(&c->u);
  lab_unknowns_count(&c->u);
  status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* About the best model, and all others about the same values. */
static int linearise_about(search *s, lab_error *error)
{
  lab_nuisance h;
  int i, status;
  if (lab_unknowns_weigh_held(&s->beam[0].u, error))
    return error->status;
  status = lab_nuisance_open(&s->beam[0].u, &h, error);
  lab_nuisance_close(&s->nuisance);
  s->nuisance = h;
  s->beam[0].u.nuisance = &s->nuisance;
  if (status == LAB_OK)
    status = lab_candidate_fit(&s->beam[0], LAB_ROUNDS_ALL, error);
  for (i = 1; status == LAB_OK && i < s->n_beam; i++)
    status = move_to(&s->nuisance, &s->beam[i], error);
  if (status == LAB_OK)
    status = move_to(&s->nuisance, &s->free_term, error);
  return status == LAB_OK ? move_to(&s->nuisance, &s->declared, error) : status;
}

/* Where the best model cannot be simulated beside its values, it is where the search ends. */
static int linearise_again(search *s, lab_error *error)
{
  int status = unfold(s, error);
  s->is_final = lab_cpu_is_spent(s->declared.u.until);
  if (status == LAB_OK && !s->is_final)
    status = lab_candidate_place_again(&s->beam[0], error);
  if (status != LAB_OK || s->is_final)
    return status;
  s->without = s->beam[0];
  status = linearise_about(s, error);
  if (status != LAB_NUMERIC)
    return status;
  s->beam[0] = s->without;
  s->over = 1;
  return error->status = LAB_OK;
}

/* A fit that is bent ranks alike things by chance: now that it is known when one of them begins, the others again. */
static int try_instead(search *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  int i, n, status = lab_refit_instead(best, &s->begins, onset_level(s), s->pool, &s->n_pool, error);
  if (status != LAB_OK)
    return status;
  rank(s);
  if (s->n_pool > 0 && s->pool[0].quality.bic < best->quality.bic) {
    s->without = *best;
    *best = s->pool[0];
    s->pool[0] = s->without;
    if (best->n_found > 0)
      lab_candidate_explain(best, s->declared.quality.chi2);
    status = s->nuisance.n > 0 ? linearise_again(s, error) : lab_candidate_place_again(best, error);
  }
  for (i = n = 0; i < s->n_pool; i++)
    if (s->pool[i].n_found > 0)
      s->pool[n++] = s->pool[i];
  if (best->n_found > 0)
    note_alike(best, best->n_found - 1, s->pool, n);
  return status;
}

/* Whether there is room for one more; what begins may have come with others. */
static int has_room(const search *s)
{
  return s->round < s->options->max_effects && s->beam[0].n_found < s->options->max_effects;
}

/* Whether what begins was found with values as declared and leaves more than noise: the search goes on from there. */
static int needs_tolerances(const search *s)
{
  return s->within && !lab_is_noise(&s->beam[0].quality);
}

static int search_all(search *s, lab_error *error)
{
  for (s->round = 0, s->added = 1; s->added && !s->rounds_over && !s->is_final && has_room(s); s->round++) {
    double chi2;
    if (advance(s, error))
      return error->status;
    if (s->added && s->nuisance.n > 0 && linearise_again(s, error))
      return error->status;
    if (s->has_begun && !needs_tolerances(s) && try_instead(s, error))
      return error->status;
    chi2 = s->beam[0].quality.chi2;
    if (follow_rules(s, LAB_PHASE_ROUND, error))
      return error->status;
    if (s->over)
      return LAB_OK;
    if (s->beam[0].quality.chi2 != chi2)
      note_way(s->result, &s->beam[0]);
  }
  return follow_rules(s, LAB_PHASE_END, error);
}

/* What begins, without what was found beside it: that has to be found again. */
static int keep_onset(lab_candidate *c, double until, lab_error *error)
{
  int i = c->n_found;
  while (i-- > 0)
    if (c->found[i].term >= 0 || lab_unknowns_find_onset(&c->u, c->found[i].param) < 0)
      drop_found(c, i);
  c->u.until = until;
  return lab_candidate_hold(c, error);
}

/* From the declared model, fitted. */
static int begin(search *s, lab_error *error)
{
  if (lab_candidate_fit(&s->declared, LAB_ROUNDS_ALL, error))
    return error->status;
  note_way(s->result, &s->declared);
  if (linearise(s, error))
    return error->status;
  s->beam[0] = s->declared;
  s->n_beam = 1;
  note_step(s->result, &s->declared);
  return LAB_OK;
}

/* What begins is known already, but for what else may begin then. The declared model is far from the logs. */
static int go_on_from(search *s, const lab_candidate *begun, const lab_onset_scores *begins, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  note_way(s->result, &s->declared);
  note_step(s->result, &s->declared);
  s->declared.quality.fitted = 0;
  s->n_beam = 1;
  *best = *begun;
  s->begins = *begins;
  if (keep_onset(best, s->declared.u.until, error))
    return error->status;
  if (!best->quality.fitted)
    return lab_fail(error, LAB_NUMERIC, "what begins cannot be followed within tolerances");
  if (best->n_found > 0)
    lab_candidate_explain(best, s->declared.quality.chi2);
  note_step(s->result, best);
  note_way(s->result, best);
  return linearise_again(s, error) ? error->status : try_instead(s, error);
}

/* Whether tolerances alone were found to be better than anything that could be added. */
static int is_given_up(const search *s)
{
  return s->over && s->within && s->within->fitted && s->beam[0].n_found == 0 && !s->has_begun &&
         s->within->bic < s->beam[0].quality.bic;
}

/* Nothing was found. */
static int give_back(const search *s, lab_finding *f)
{
  f->best = f->declared;
  f->best.quality = s->declared.quality;
  f->result.verdict = LAB_VERDICT_UNDECIDED;
  return LAB_OK;
}

/* Where only noise is left, an instrument may all the same be further off than one can be. */
static int take_instruments(search *s, lab_error *error)
{
  lab_candidate *best = &s->beam[0];
  int any, status;
  if (!lab_is_noise(&best->quality) || lab_cpu_is_spent(s->declared.u.until))
    return LAB_OK;
  s->without = *best;
  status = lab_candidate_take_instruments(best, &any, error);
  if (status == LAB_OK && any)
    note_way(s->result, best);
  if (status != LAB_OK)
    *best = s->without;
  return status == LAB_WORLD ? status : LAB_OK;
}

/* Where the time is spent, of the rules at the end those hold that ask for no more fits. */
static int end_early(search *s, lab_error *error)
{
  const int status = follow_rules(s, LAB_PHASE_END, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* The best model, fitted with all that varies. */
static int end_with(search *s, lab_finding *f, lab_error *error)
{
  lab_facts facts;
  if (unfold(s, error))
    return error->status;
  if (!lab_cpu_is_spent(f->declared.u.until) && lab_candidate_place_again(&s->beam[0], error))
    return error->status;
  if (take_instruments(s, error))
    return error->status;
  drop_neutral(&s->beam[0]);
  facts = facts_of(s);
  f->best = s->beam[0];
  f->result.verdict = lab_decide_verdict(&facts);
  return LAB_OK;
}

int lab_rounds_run(lab_finding *f, const lab_finding *begun, const lab_quality *within,
                   const lab_search_options *options, lab_error *error)
{
  search *s = calloc(1, sizeof *s);
  int status;
  if (!s)
    return lab_fail_memory(error, "the search");
  s->options = options;
  s->result = &f->result;
  s->within = within;
  s->declared = f->declared;
  s->unfolding.nuisance = &s->nuisance;
  s->unfolding.exact = f->exact;
  s->unfolding.until = f->declared.u.until;
  status = begun ? go_on_from(s, &begun->best, &begun->begins, error) : begin(s, error);
  if (status == LAB_OK)
    status = search_all(s, error);
  if (status == LAB_NUMERIC && lab_cpu_is_spent(f->declared.u.until) && s->beam[0].quality.fitted)
    status = end_early(s, error);
  if (status == LAB_OK)
    status = is_given_up(s) ? give_back(s, f) : end_with(s, f, error);
  f->begins = s->begins;
  lab_nuisance_close(&s->nuisance);
  free(s);
  return status;
}
