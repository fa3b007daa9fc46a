#include "loop.h"
#include "unlisted.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const double alike_bic = 9.2;  /* refits that differ by less are alike: odds of a hundred to one */
static const double name_bonus = 20;  /* by which a free term must be better than an effect */
static const double convincing = 0.5; /* of the excess of the best named model: a free term leaves at most so much, */
static const double compelling = 0.1; /* and with so little there is no need to look on */
static const double rival = 3;        /* times the best chi-square: a poorer model is not extended */
static const double worth = 0.05;     /* of the best statistic: leaders have at least so much */
static const double much = 0.5;       /* of what the declared model leaves: a good effect takes so much */
static const double alone = 3;        /* a slot is tried at once if it explains so much more than any effect, */
static const double mostly = 0.5;     /* and so much of all there is */
enum {
  BEAM = 2,
  SLOTS = 8,
  ALL_LEADERS = 40,
  POOL = ALL_LEADERS + SLOTS,
  FIRST = 3,
  BRIEF = 8,
  FINALISTS = 3,
  REFINED = 21,
  MARGIN = 2
};

void lab_loop_options_default(lab_loop_options *options)
{
  memset(options, 0, sizeof *options);
  options->alpha = 0.01;
  options->min_gain = 0.02;
  options->max_effects = LAB_LOOP_EFFECTS;
}

const char *lab_verdict_text(int verdict)
{
  static const char *const text[] = {"none", "effect", "unlisted", "undecided"};
  return text[verdict];
}

/* ---- Errors ---- */

static void clear_errors(lab_errors *errors)
{
  int c;
  memset(errors, 0, sizeof *errors);
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    errors->rmse[c] = errors->in_noise[c] = (double)NAN;
}

/* Sums over one channel of all experiments. */
static void channel_error(const lab_unknowns *u, const double *r, int channel, lab_errors *errors)
{
  double noise2 = 0, unit2 = 0;
  size_t n = 0;
  int e, c;
  for (e = 0; e < u->n_experiments; e++) {
    const lab_experiment *x = &u->experiment[e];
    for (c = 0; c < x->n_channels; c++) {
      size_t i;
      for (i = 0; x->channel[c] == channel && i < x->n; i++) {
        const double z = r[(size_t)c * x->n + i];
        if (isnan(lab_experiment_measured(x, c, i)))
          continue;
        noise2 += z * z;
        unit2 += z * z * x->sigma[c] * x->sigma[c];
        n++;
      }
    }
    r += x->n * (size_t)x->n_channels;
  }
  if (n == 0)
    return;
  errors->rmse[channel] = sqrt(unit2 / (double)n);
  errors->in_noise[channel] = sqrt(noise2 / (double)n);
  errors->chi2 += noise2;
  errors->n += n;
}

int lab_loop_errors(const lab_unknowns *u, lab_errors *errors, lab_error *error)
{
  double *r = malloc((u->n_rows + 1) * sizeof *r);
  int c, status;
  clear_errors(errors);
  if (!r)
    return lab_fail_memory(error, "residuals");
  status = lab_unknowns_errors(u, r, error);
  for (c = 0; status == LAB_OK && c < LAB_CHANNEL_COUNT; c++)
    channel_error(u, r, c, errors);
  free(r);
  return status;
}

/* What is left is noise: chi-square within six standard deviations of its expectation, or the error within a twentieth
 * of the noise, as far as a declared noise can be trusted. */
static int is_noise(double chi2, size_t values)
{
  const double n = (double)values;
  return chi2 < n + 6 * sqrt(2 * n) || chi2 < 1.1025 * n;
}

/* ---- Models ---- */

/* A model with what was added to it, fitted. */
typedef struct attempt {
  lab_unknowns u;
  double chi2; /* of the residuals, with priors */
  double bic;
  int fitted;
  int n_found;
  lab_found found[LAB_LOOP_EFFECTS];
} attempt;

/* Schwarz 1978: what a fit costs, with what it fits counted, and what has no name against what has. */
static double bic(const lab_unknowns *u, double chi2)
{
  return chi2 + (double)u->n * log((double)u->n_data) + name_bonus * u->rig.n_terms;
}

static void name_of(const attempt *a, char *text, size_t size)
{
  size_t used = 0;
  int i;
  snprintf(text, size, "declared model");
  for (i = 0; i < a->n_found && used < size; i++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? " + " : "",
                             a->found[i].effect < 0 ? "unlisted" : pneu_effect_at(a->found[i].effect)->name);
}

static void note_step(lab_loop_result *result, const attempt *a, int kept)
{
  lab_step *step = result->n_steps < LAB_LOOP_STEPS ? &result->step[result->n_steps++] : NULL;
  if (!step)
    return;
  name_of(a, step->name, sizeof step->name);
  step->n_added = a->n_found;
  step->chi2 = a->chi2;
  step->bic = a->bic;
  step->kept = kept;
}

static void note_way(lab_loop_result *result, const attempt *a)
{
  lab_waypoint *way;
  if (result->n_path == LAB_LOOP_PATH)
    return;
  way = &result->path[result->n_path++];
  name_of(a, way->name, sizeof way->name);
  way->chi2 = a->chi2;
  way->bic = a->bic;
  way->rig = a->u.rig;
}

static int fit_attempt(attempt *a, int steps, lab_error *error)
{
  const int status = lab_unknowns_fit(&a->u, steps, &a->chi2, error);
  a->fitted = status == LAB_OK;
  a->bic = bic(&a->u, a->chi2);
  return status;
}

static lab_found *append_found(attempt *a)
{
  lab_found *found = &a->found[a->n_found++];
  memset(found, 0, sizeof *found);
  found->effect = found->term = found->shape = -1;
  found->degrees = 1;
  return found;
}

/* Share by which the error of the channel that gains most falls; of all together where it is seen coarsely. */
static double gain(const attempt *a, const attempt *b, const lab_errors *before, const lab_errors *after)
{
  double most = a->u.window ? 1 - sqrt(b->chi2 / a->chi2) : 0;
  int c;
  for (c = 0; !a->u.window && c < LAB_CHANNEL_COUNT; c++)
    if (before->rmse[c] > 0)
      most = fmax(most, 1 - after->rmse[c] / before->rmse[c]);
  return most;
}

/* ---- Refits ---- */

/* Where a refit begins. The present fit may have bent its parameters to stand in for the effect; then the values
 * before any fit, with the effect at its usual size, are nearer to the truth. */
enum start { FROM_SLOPE, FROM_DECLARED, FROM_USUAL, STARTS };

/* The values that the unknowns had before any fit. */
static void undo_fit(attempt *a)
{
  double theta[LAB_FIT_MAX];
  int j;
  for (j = 0; j < a->u.n; j++)
    theta[j] = a->u.unknown[j].value = a->u.unknown[j].first;
  lab_unknowns_apply(&a->u, theta, LAB_ALL_EXPERIMENTS, &a->u.rig);
}

/* The model with one candidate of some size, before it is fitted.  Returns: 0, or -1 if there is no room. */
static int take_up(const attempt *base, const lab_candidate *c, double size, int as_declared, attempt *a)
{
  pneu_param_info info;
  lab_error ignored;
  double theta[LAB_FIT_MAX];
  int j;
  *a = *base;
  a->fitted = 0;
  pneu_param_describe(c->param, &info);
  if (as_declared)
    undo_fit(a);
  if (lab_unknowns_add(&a->u, c->param, (double)info.neutral + size, &ignored) ||
      (c->shape >= 0 && lab_unknowns_add(&a->u, c->shape, c->shape_value, &ignored)))
    return -1;
  for (j = 0; j < a->u.n; j++)
    theta[j] = a->u.unknown[j].value;
  lab_unknowns_apply(&a->u, theta, LAB_ALL_EXPERIMENTS, &a->u.rig);
  return 0;
}

/* The model with one candidate, from one start. */
static void refit_from(const attempt *base, const lab_candidate *c, int start, attempt *a)
{
  pneu_param_info info;
  double usual;
  lab_error ignored;
  lab_found *found;
  pneu_param_describe(c->param, &info);
  usual = (double)(info.value - info.neutral) * (c->size * (double)(info.value - info.neutral) < 0 ? -1 : 1);
  if (start == FROM_SLOPE && c->size != 0)
    usual = c->size;
  if (take_up(base, c, usual, start == FROM_DECLARED, a) || fit_attempt(a, FIRST, &ignored))
    return;
  found = append_found(a);
  found->effect = c->effect;
  found->param = c->param;
  found->shape = c->shape;
  found->statistic = c->statistic;
  found->p_value = c->p_value;
}

/* Better of two attempts takes the place of the first. */
static void keep_better(attempt *a, const attempt *other)
{
  if (other->fitted && (!a->fitted || other->chi2 < a->chi2))
    *a = *other;
}

/* The candidates worth a refit: the first of those that pass. */
static int count_leaders(const lab_trace_result *trace, double level)
{
  int n = 0;
  while (n < trace->n && n < LAB_LOOP_LEADERS && trace->candidate[n].p_value < level &&
         trace->candidate[n].statistic >= worth * trace->candidate[0].statistic)
    n++;
  return n;
}

/* All that pass. */
static int count_passing(const lab_trace_result *trace, double level)
{
  int n = 0;
  while (n < trace->n && n < ALL_LEADERS && trace->candidate[n].p_value < level)
    n++;
  return n;
}

static int any_is_noise(const attempt *a, int n)
{
  int i, any = 0;
  for (i = 0; i < n; i++)
    any |= a[i].fitted && is_noise(a[i].chi2, a[i].u.n_data);
  return any;
}

static int by_bic(const void *x, const void *y)
{
  const attempt *a = x, *b = y;
  if (a->fitted != b->fitted)
    return b->fitted - a->fitted;
  return a->bic < b->bic ? -1 : a->bic > b->bic;
}

/* Fit those to the end that are in the running after a brief fit: the best few, and whatever is nearly as good. */
static void fit_finalists(attempt *a, int n)
{
  int i;
  qsort(a, (size_t)n, sizeof *a, by_bic);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error ignored;
    if (a[i].fitted && (i < FINALISTS || a[i].bic < 1.2 * a[0].bic))
      fit_attempt(&a[i], LAB_FIT_WHOLE, &ignored);
  }
}

static double least_chi2(const attempt *a, int n)
{
  double least = INFINITY;
  int i;
  for (i = 0; i < n; i++)
    if (a[i].fitted)
      least = fmin(least, a[i].chi2);
  return least;
}

/* Refit the leaders from one start, in parallel: a few steps, and more for those that keep up with the best. */
static void refit_race(const attempt *base, const lab_candidate *leader, int n, int start, attempt *a)
{
  double least;
  int i;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    refit_from(base, &leader[i], start, &a[i]);
  least = least_chi2(a, n);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error ignored;
    if (a[i].fitted && a[i].chi2 < rival * least)
      fit_attempt(&a[i], BRIEF, &ignored);
  }
}

/* Refit the leaders: all from the first start, and from the others for as long as none leaves only noise. */
static void refit_leaders(const attempt *base, const lab_candidate *leader, int n, attempt *a)
{
  const int starts = base->n_found == 0 ? STARTS : STARTS - 1;
  attempt *mine = malloc(((size_t)n + 1) * sizeof *mine);
  int i, start;
  for (i = 0; i < n; i++)
    a[i].fitted = 0;
  for (start = 0; mine && start < starts && !any_is_noise(a, n); start++) {
    refit_race(base, leader, n, start, mine);
    for (i = 0; i < n; i++)
      keep_better(&a[i], &mine[i]);
  }
  free(mine);
  fit_finalists(a, n);
}

/* Whether none of them explains much of what the declared model leaves. */
static int all_poor(const attempt *base, const attempt *a, int n)
{
  const double excess = base->chi2 - (double)base->u.n_data;
  int i, poor = 1;
  for (i = 0; i < n; i++)
    poor &= !a[i].fitted || a[i].chi2 - (double)a[i].u.n_data > much * excess;
  return poor;
}

/* Refit the leaders; where none of them is any good beside the declared model, which what is missing may have bent
 * beyond the reach of slopes, all that pass.  Returns: how many. */
static int refit_candidates(const attempt *base, const lab_trace_result *trace, double level, attempt *a)
{
  const int leaders = count_leaders(trace, level), all = count_passing(trace, level);
  refit_leaders(base, trace->candidate, leaders, a);
  if (base->n_found > 0 || all <= leaders || is_noise(base->chi2, base->u.n_data) || !all_poor(base, a, leaders))
    return leaders;
  refit_leaders(base, trace->candidate + leaders, all - leaders, a + leaders);
  return all;
}

/* ---- What has no name ---- */

static void refit_slot(const attempt *base, const lab_slot *slot, attempt *a)
{
  lab_error ignored;
  lab_found *found;
  *a = *base;
  a->fitted = 0;
  if (lab_unknowns_add_term(&a->u, &slot->term, slot->scale, 0, &ignored) || fit_attempt(a, BRIEF, &ignored))
    return;
  found = append_found(a);
  found->term = a->u.rig.n_terms - 1;
  found->statistic = slot->statistic;
  found->degrees = slot->degrees;
  found->scale = slot->scale;
}

/* Values of one term, less a level, at the knots of another; 0 at its ends. */
static void resample(const pneu_term *from, double level, pneu_term *to)
{
  int i;
  for (i = 0; i < to->n; i++) {
    const double at = (double)(to->from + (to->to - to->from) * (pneu_real)i / (pneu_real)(to->n - 1));
    const double place = (at - (double)from->from) / (double)(from->to - from->from) * (from->n - 1);
    const int k = place < from->n - 2 ? (int)fmax(place, 0) : from->n - 2;
    const double share = fmin(fmax(place - k, 0), 1);
    to->value[i] = (pneu_real)((1 - share) * (double)from->value[k] + share * (double)from->value[k + 1] - level);
  }
  to->value[0] = to->value[to->n - 1] = 0;
}

/* A free term that acts on a short stretch only: knots there, close together, and none elsewhere. */
static void refine(attempt *a)
{
  const lab_found *found = &a->found[a->n_found - 1];
  const pneu_term coarse = a->u.rig.term[found->term];
  const double margin = MARGIN * (double)(coarse.to - coarse.from) / (coarse.n - 1);
  attempt *fine = malloc(sizeof *fine);
  double from, to, level, peak;
  pneu_term term = coarse;
  lab_error ignored;
  if (fine && lab_unlisted_stretch(&coarse, &from, &to, &level, &peak)) {
    *fine = *a;
    lab_unknowns_drop_term(&fine->u);
    term.n = REFINED;
    term.from = (pneu_real)fmax(from - margin, (double)coarse.from);
    term.to = (pneu_real)fmin(to + margin, (double)coarse.to);
    resample(&coarse, level, &term);
    if (lab_unknowns_add_term(&fine->u, &term, found->scale, 1, &ignored) == LAB_OK &&
        fit_attempt(fine, LAB_FIT_WHOLE, &ignored) == LAB_OK && fine->bic < a->bic)
      *a = *fine;
  }
  free(fine);
}

/* What the last addition did to chi-square. */
static void explain(attempt *a, double chi2_before)
{
  lab_found *found = &a->found[a->n_found - 1];
  found->chi2_before = chi2_before;
  found->chi2_after = a->chi2;
  found->explained = (chi2_before - a->chi2) / fmax(chi2_before - (double)a->u.n_data, 1);
}

/* The best slots, refitted: briefly, then the best few of them to the end.  Out: best, fitted or not */
static void refit_slots(const attempt *base, const lab_slot *slot, int n, attempt *best)
{
  attempt *a = malloc(SLOTS * sizeof *a);
  int i;
  best->fitted = 0;
  n = !a ? 0 : n < SLOTS ? n : SLOTS;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    refit_slot(base, &slot[i], &a[i]);
  qsort(a, (size_t)n, sizeof *a, by_bic);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error ignored;
    if (i < FINALISTS && a[i].fitted)
      fit_attempt(&a[i], LAB_FIT_WHOLE, &ignored);
  }
  for (i = 0; i < n && i < FINALISTS; i++)
    keep_better(best, &a[i]);
  free(a);
  if (best->fitted) {
    refine(best);
    explain(best, base->chi2);
  }
}

/* ---- Search ---- */

/* Effects whose refits are as good as the winner's. */
static void note_alike(attempt *pool, int n)
{
  lab_found *found = &pool[0].found[pool[0].n_found - 1];
  int i, k;
  for (i = 1; found->effect >= 0 && i < n && pool[i].bic - pool[0].bic < alike_bic; i++) {
    const int effect = pool[i].found[pool[i].n_found - 1].effect;
    int known = effect < 0 || effect == found->effect || pool[i].n_found != pool[0].n_found;
    for (k = 0; k < found->n_alike; k++)
      known |= found->alike[k] == effect;
    if (known)
      continue;
    if (found->n_alike < LAB_LOOP_LEADERS)
      found->alike_params[found->n_alike] = pool[i].u.rig.params;
    found->alike[found->n_alike++] = effect;
  }
}

static double seconds(void)
{
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The search: where it is and what it is to bring. */
typedef struct search {
  const lab_loop_options *options;
  lab_loop_result *result;
  attempt *beam; /* BEAM best models so far, best first */
  int n_beam;
  attempt *pool; /* POOL extensions of them */
  int n_pool;
  attempt *declared; /* the declared model, fitted */
  attempt *nameless; /* the declared model with the best free term; not fitted: not tried yet, or none */
} search;

static void tell(const search *s, const char *what)
{
  if (s->options->tell)
    s->options->tell(s->options->context, what);
}

/* More than noise, if only a little. */
static int leaves_something(const attempt *a)
{
  const double n = (double)a->u.n_data;
  return a->chi2 > n + 2 * sqrt(2 * n);
}

static void try_slots(const search *s, const attempt *base, const lab_slot *slot, int n, attempt *best)
{
  tell(s, "looking for what has no name");
  refit_slots(base, slot, n, best);
}

/* Try every extension of one model by one effect; and before these, of the declared model by a free term, where that
 * explains most of what there is and far more than any of them. */
static int extend(search *s, const attempt *base, lab_error *error)
{
  const double start = seconds();
  lab_slot slot[LAB_SLOT_MAX];
  lab_trace_result trace;
  lab_scan scan;
  attempt copy = *base;
  int n_slots = 0, status = lab_scan_open(&copy.u, &scan, error);
  if (status == LAB_OK) {
    tell(s, "tracing the residual");
    lab_trace_effects(&scan, &trace);
    if (s->result->trace.n == 0)
      s->result->trace_s = seconds() - start;
    if (trace.tests > 0)
      s->result->level = s->options->alpha / trace.tests;
    if (base->n_found == 0 && !any_is_noise(base, 1) && alone * trace.candidate[0].statistic < scan.excess)
      n_slots = lab_slots_try(&scan, slot);
    if (n_slots > 0 && slot[0].statistic > mostly * scan.excess &&
        slot[0].statistic > alone * trace.candidate[0].statistic)
      try_slots(s, base, slot, n_slots, s->nameless);
    tell(s, "fitting the leaders");
    if (!any_is_noise(s->nameless, 1))
      s->n_pool += refit_candidates(base, &trace, s->result->level, s->pool + s->n_pool);
    if (s->result->trace.n == 0)
      s->result->trace = trace;
    else
      lab_trace_close(&trace);
  }
  lab_scan_close(&scan);
  return status;
}

/* The pool, best first, without what could not be fitted. */
static void rank(search *s)
{
  int i;
  qsort(s->pool, (size_t)s->n_pool, sizeof *s->pool, by_bic);
  while (s->n_pool > 0 && !s->pool[s->n_pool - 1].fitted)
    s->n_pool--;
  for (i = 0; i < s->n_pool; i++)
    note_step(s->result, &s->pool[i], i < BEAM);
}

/* Significant, but not worth adding: the best one, and what cannot be told from it. */
static void list_small(search *s)
{
  lab_loop_result *r = s->result;
  const lab_found *found = &s->pool[0].found[s->pool[0].n_found - 1];
  int i;
  note_alike(s->pool, s->n_pool);
  r->listed[r->n_listed++] = found->effect;
  for (i = 0; i < found->n_alike && r->n_listed < LAB_TRACE_MAX; i++)
    r->listed[r->n_listed++] = found->alike[i];
}

/* Whether some model at hand leaves only noise, so that poorer ones need not be extended. */
static int settled(const search *s)
{
  return any_is_noise(s->beam, 1) || any_is_noise(s->pool, s->n_pool);
}

/* One round: extend the models of the beam and take the best extensions for the next.
 * Out:     better  0 when none is worth it */
static int advance(search *s, int *better, lab_error *error)
{
  const double declared = s->beam[0].chi2;
  lab_errors before, after;
  int i;
  *better = 0;
  s->n_pool = 0;
  for (i = 0; i < s->n_beam && (i == 0 || (!settled(s) && s->beam[i].chi2 < rival * s->beam[0].chi2)); i++)
    if (extend(s, &s->beam[i], error))
      return error->status;
  rank(s);
  if (s->n_pool == 0 || !(s->pool[0].bic < s->beam[0].bic))
    return LAB_OK;
  if (lab_loop_errors(&s->beam[0].u, &before, error) || lab_loop_errors(&s->pool[0].u, &after, error))
    return error->status;
  if (gain(&s->beam[0], &s->pool[0], &before, &after) < s->options->min_gain) {
    list_small(s);
    return LAB_OK;
  }
  note_alike(s->pool, s->n_pool);
  for (i = 0; i < s->n_pool && i < BEAM; i++) {
    explain(&s->pool[i], declared);
    s->beam[i] = s->pool[i];
  }
  s->n_beam = i;
  *better = 1;
  return LAB_OK;
}

/* Without one of the found effects, fitted again.  Returns: 0, or -1 where that fails. */
static int leave_out(const attempt *a, int which, attempt *without)
{
  lab_error ignored;
  int k;
  *without = *a;
  if (a->found[which].shape >= 0)
    lab_unknowns_drop(&without->u, a->found[which].shape);
  lab_unknowns_drop(&without->u, a->found[which].param);
  for (k = which; k + 1 < without->n_found; k++)
    without->found[k] = without->found[k + 1];
  without->n_found--;
  return fit_attempt(without, LAB_FIT_WHOLE, &ignored) == LAB_OK ? 0 : -1;
}

/* Take out again what is not needed now that other effects have come. */
static void remove_needless(attempt *a)
{
  attempt *without = malloc(sizeof *without);
  int i;
  for (i = 0; without && a->n_found > 1 && i < a->n_found - 1; i++)
    if (a->found[i].term < 0 && leave_out(a, i, without) == 0 && without->bic <= a->bic) {
      *a = *without;
      i = -1;
    }
  free(without);
}

/* An effect that was the best one alone need not be the best one beside those that came after it: put each earlier one
 * to the test again. */
static int exchange(search *s, lab_error *error)
{
  attempt *without = malloc(sizeof *without);
  int i, status = without ? LAB_OK : lab_fail_memory(error, "the search");
  for (i = 0; status == LAB_OK && i < s->beam[0].n_found - 1; i++) {
    if (s->beam[0].found[i].term >= 0 || leave_out(&s->beam[0], i, without))
      continue;
    s->n_pool = 0;
    status = extend(s, without, error);
    rank(s);
    if (s->n_pool > 0 && s->pool[0].bic < s->beam[0].bic) {
      note_alike(s->pool, s->n_pool);
      s->beam[0] = s->pool[0];
    }
  }
  free(without);
  return status;
}

static int verdict_of(const attempt *a)
{
  int i, unlisted = 0;
  for (i = 0; i < a->n_found; i++)
    unlisted |= a->found[i].term >= 0;
  if (unlisted)
    return LAB_VERDICT_UNLISTED;
  if (!is_noise(a->chi2, a->u.n_data))
    return LAB_VERDICT_UNDECIDED;
  return a->n_found > 0 ? LAB_VERDICT_EFFECT : LAB_VERDICT_NONE;
}

/* A free term can bend to nearly anything, and says nothing beyond what it has seen: it must leave only noise, or far
 * less than what has a name does. */
static int is_better(const attempt *nameless, const attempt *named, double share)
{
  const double n = (double)named->u.n_data;
  return nameless->fitted && nameless->bic < named->bic &&
         (any_is_noise(nameless, 1) || nameless->chi2 - n < share * (named->chi2 - n));
}

/* The best free term beside a model.  Out: best, fitted or not */
static int find_slot(const search *s, const attempt *base, attempt *best, lab_error *error)
{
  attempt copy = *base;
  lab_slot slot[LAB_SLOT_MAX];
  lab_scan scan;
  int n, status = lab_scan_open(&copy.u, &scan, error);
  best->fitted = 0;
  if (status == LAB_OK && (n = lab_slots_try(&scan, slot)) > 0)
    try_slots(s, base, slot, n, best);
  lab_scan_close(&scan);
  return status;
}

/* Nothing that has a name would do: a free term beside what was found, which may then be needless. */
static int last_resort(search *s, lab_error *error)
{
  attempt *best = &s->beam[0], *longer = &s->pool[0];
  lab_errors before, after;
  if (find_slot(s, best, longer, error))
    return error->status;
  if (!is_better(longer, best, convincing))
    return LAB_OK;
  note_step(s->result, longer, 1);
  if (lab_loop_errors(&best->u, &before, error) || lab_loop_errors(&longer->u, &after, error))
    return error->status;
  if (gain(best, longer, &before, &after) < s->options->min_gain)
    return LAB_OK;
  *best = *longer;
  note_way(s->result, best);
  remove_needless(best);
  return LAB_OK;
}

/* Whether it is time for a free term beside the declared model: when no single effect explains much, or when two leave
 * more than noise. */
static int wants_nameless(const search *s, int rounds)
{
  const attempt *best = &s->beam[0];
  return !s->nameless->fitted && !any_is_noise(best, 1) && (rounds > 0 || all_poor(s->declared, best, 1));
}

static int search_all(search *s, lab_error *error)
{
  attempt *best = &s->beam[0];
  int rounds, better = 1;
  note_way(s->result, best);
  for (rounds = 0; better && rounds < s->options->max_effects; rounds++) {
    if (advance(s, &better, error))
      return error->status;
    if (better)
      note_way(s->result, best);
    if (best->u.window && any_is_noise(best, 1))
      return LAB_OK; /* a coarse view does not see fine differences */
    if (better && best->n_found > 1) {
      const double before = best->chi2;
      remove_needless(best);
      if ((best->n_found == 2 || any_is_noise(best, 1)) && exchange(s, error))
        return error->status;
      if (best->chi2 != before)
        note_way(s->result, best);
    }
    if (wants_nameless(s, rounds) && find_slot(s, s->declared, s->nameless, error))
      return error->status;
    if (!any_is_noise(best, 1) &&
        (any_is_noise(s->nameless, 1) || (best->n_found > 1 && is_better(s->nameless, best, compelling))))
      break;
  }
  if (s->nameless->fitted && !any_is_noise(best, 1) && is_better(s->nameless, best, convincing)) {
    *best = *s->nameless;
    note_step(s->result, best, 1);
    s->result->n_path = 1;
    note_way(s->result, best);
  }
  if (best->u.rig.n_terms == 0 && leaves_something(best) && best->n_found < LAB_LOOP_EFFECTS)
    return last_resort(s, error);
  return LAB_OK;
}

/* The search from a declared model, fitted, in the view that the unknowns have.  Out: best, with what was added */
static int search_from(const lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, attempt *best,
                       lab_error *error)
{
  search s = {options, result, NULL, 1, NULL, 0, NULL, NULL};
  int status = LAB_OK;
  s.declared = calloc(1, sizeof *s.declared);
  s.nameless = calloc(1, sizeof *s.nameless);
  s.beam = calloc(BEAM, sizeof *s.beam);
  s.pool = malloc((size_t)BEAM * POOL * sizeof *s.pool);
  if (!s.beam || !s.pool || !s.declared || !s.nameless)
    status = lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    s.declared->u = *u;
    status = fit_attempt(s.declared, LAB_FIT_WHOLE, error);
    s.beam[0] = *s.declared;
  }
  if (status == LAB_OK) {
    note_step(result, &s.beam[0], 1);
    status = search_all(&s, error);
    *best = s.beam[0];
  }
  free(s.declared);
  free(s.nameless);
  free(s.beam);
  free(s.pool);
  return status;
}

/* The search seen coarsely, if the log is rough.  Out: done, 1 if it left only noise */
static int search_coarsely(const lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result,
                           attempt *best, int *done, lab_error *error)
{
  lab_unknowns coarse = *u;
  *done = 0;
  result->window = lab_unknowns_rough(u);
  if (result->window == 0)
    return LAB_OK;
  lab_unknowns_view(&coarse, result->window);
  if (search_from(&coarse, options, result, best, error))
    return error->status;
  *done = best->n_found > 0 && is_noise(best->chi2, best->u.n_data);
  if (!*done) {
    lab_trace_close(&result->trace);
    result->n_steps = result->n_listed = result->n_path = 0;
    result->window = 0;
  }
  return LAB_OK;
}

int lab_loop_run(lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, lab_error *error)
{
  attempt *best = malloc(sizeof *best);
  int done = 0, status;
  memset(result, 0, sizeof *result);
  status = best ? lab_loop_errors(u, &result->before, error) : lab_fail_memory(error, "the search");
  if (status == LAB_OK)
    status = search_coarsely(u, options, result, best, &done, error);
  if (status == LAB_OK && !done)
    status = search_from(u, options, result, best, error);
  if (status == LAB_OK) {
    *u = best->u;
    result->n_found = best->n_found;
    memcpy(result->found, best->found, sizeof result->found);
    result->verdict = verdict_of(best);
    status = lab_unknowns_spread(u, &result->fit, error);
    lab_unknowns_view(u, 0);
  }
  if (status == LAB_OK)
    status = lab_loop_errors(u, &result->after, error);
  free(best);
  return status;
}

void lab_loop_close(lab_loop_result *result)
{
  lab_trace_close(&result->trace);
}
