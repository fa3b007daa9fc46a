#include "loop.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "attempt.h"
#include "nameless.h"
#include "../base/quantile.h"
#include "refit.h"
#include "../base/clock.h"

static const double alike_bic = 9.2;  /* refits that differ by less are alike: odds of a hundred to one */
static const double convincing = 0.5; /* of the excess of one effect, or of none: a free term leaves at most so much, */
static const double compelling = 0.1; /* and with so little there is no need to look on */
static const double rival = 3;        /* times the best chi-square: a poorer model is not extended */
static const double alone = 3;        /* a slot is tried at once if it explains so much more than any effect, */
static const double mostly = 0.5;     /* and so much of all there is */
enum { BEAM = 2 };

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

static void note_step(lab_loop_result *result, const lab_attempt *a)
{
  lab_step *step = result->n_steps < LAB_LOOP_STEPS ? &result->step[result->n_steps++] : NULL;
  if (!step)
    return;
  lab_attempt_name(a, step->name, sizeof step->name);
  step->chi2 = a->chi2;
  step->bic = a->bic;
}

static void note_way(lab_loop_result *result, const lab_attempt *a)
{
  lab_waypoint *way;
  if (result->n_path == LAB_LOOP_PATH)
    return;
  way = &result->path[result->n_path++];
  lab_attempt_name(a, way->name, sizeof way->name);
  way->chi2 = a->chi2;
  way->bic = a->bic;
  way->rig = a->u.rig;
}

/* Share by which the error of the channel that gains most falls; of all together where it is seen coarsely. */
static double gain(const lab_attempt *a, const lab_attempt *b, const lab_errors *before, const lab_errors *after)
{
  double most = a->u.window ? 1 - sqrt(b->chi2 / a->chi2) : 0;
  int c;
  for (c = 0; !a->u.window && c < LAB_CHANNEL_COUNT; c++)
    if (before->rmse[c] > 0)
      most = fmax(most, 1 - after->rmse[c] / before->rmse[c]);
  return most;
}

/* ---- Search ---- */

/* Whether two models have the same, whatever was added first, beside one thing found of each; -1: beside nothing. */
static int is_alike_but(const lab_attempt *a, int which_a, const lab_attempt *b, int which_b)
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

static int is_same(const lab_attempt *a, const lab_attempt *b)
{
  return is_alike_but(a, -1, b, -1);
}

/* Effects of a pool, each added last, that are as good as one of a model's in its place: a better fit by one unknown
 * more is no reason to choose it, but nor does the log speak against it. */
static void note_alike(lab_attempt *model, int which, const lab_attempt *pool, int n)
{
  lab_found *found = &model->found[which];
  int i, k;
  found->n_alike = 0;
  for (i = 0; found->effect >= 0 && i < n; i++) {
    const int last = pool[i].n_found - 1, effect = pool[i].found[last].effect;
    int known = fmin(pool[i].bic - model->bic, pool[i].chi2 - model->chi2) > alike_bic || effect < 0 ||
                effect == found->effect || !is_alike_but(model, which, &pool[i], last);
    for (k = 0; k < found->n_alike; k++)
      known |= found->alike[k] == effect;
    if (known)
      continue;
    if (found->n_alike < LAB_LOOP_LEADERS)
      found->alike_params[found->n_alike] = pool[i].u.rig.params;
    found->alike[found->n_alike++] = effect;
  }
}

/* The same for the best of a pool. */
static void note_alike_best(lab_attempt *pool, int n)
{
  note_alike(&pool[0], pool[0].n_found - 1, pool + 1, n - 1);
}

/* The search: where it is and what it is to bring. */
typedef struct search {
  const lab_loop_options *options;
  lab_loop_result *result;
  lab_attempt *beam; /* BEAM best models so far, best first */
  int n_beam;
  lab_attempt *pool; /* LAB_REFIT_MAX extensions of each of them */
  int n_pool;
  lab_attempt *declared; /* the declared model, fitted */
  lab_attempt *nameless; /* the declared model with the best free term; not fitted: not tried yet, or none */
} search;

static void tell(const search *s, const char *what)
{
  if (s->options->tell)
    s->options->tell(s->options->context, what);
}

/* More than noise, if only a little. */
static int leaves_something(const lab_attempt *a)
{
  const double n = (double)a->u.n_values;
  return a->chi2 > n + 2 * sqrt(2 * n);
}

static int try_slots(const search *s, const lab_attempt *base, const lab_slot *slot, int n, lab_attempt *best,
                     lab_error *error)
{
  tell(s, "looking for what has no name");
  return lab_refit_slots(base, slot, n, best, error);
}

/* A free term beside the declared model, tried before any effect where it explains most of what there is and far more
 * than any of them. */
static int try_slots_first(const search *s, const lab_attempt *base, const lab_scan *scan, double best_effect,
                           lab_error *error)
{
  lab_slot slot[LAB_SLOT_MAX];
  int n;
  if (base->n_found > 0 || lab_any_is_noise(base, 1) || !(alone * best_effect < scan->excess))
    return LAB_OK;
  if (lab_slots_try(scan, slot, &n, error))
    return error->status;
  if (n == 0 || !(slot[0].statistic > mostly * scan->excess) || !(slot[0].statistic > alone * best_effect))
    return LAB_OK;
  return try_slots(s, base, slot, n, s->nameless, error);
}

/* Every extension of a model by one effect, with the scan of its residual. */
static int extend_scanned(search *s, const lab_attempt *base, const lab_scan *scan, double start, lab_error *error)
{
  double level;
  lab_trace_result trace;
  int n = 0;
  tell(s, "tracing the residual");
  if (lab_trace_effects(scan, &trace, error))
    return error->status;
  if (s->result->trace.n == 0)
    s->result->trace_s = lab_clock() - start;
  level = trace.tests > 0 ? s->options->alpha / trace.tests : 0;
  if (try_slots_first(s, base, scan, trace.candidate[0].statistic, error))
    return error->status;
  tell(s, "fitting the leaders");
  if (!lab_any_is_noise(s->nameless, 1) && lab_refit_effects(base, &trace, level, s->pool + s->n_pool, &n, error))
    return error->status;
  s->n_pool += n;
  if (s->result->trace.n == 0) {
    s->result->trace = trace;
    s->result->level = level;
  }
  return LAB_OK;
}

/* Try every extension of one model. */
static int extend(search *s, const lab_attempt *base, lab_error *error)
{
  const double start = lab_clock();
  lab_attempt copy = *base;
  lab_scan scan;
  int status = lab_scan_open(&copy.u, &scan, error);
  if (status == LAB_OK)
    status = extend_scanned(s, base, &scan, start, error);
  lab_scan_close(&scan);
  return status;
}

/* The pool, best first, without what could not be fitted, and each model once. */
static void rank(search *s)
{
  int i, k, n = 0;
  qsort(s->pool, (size_t)s->n_pool, sizeof *s->pool, lab_attempt_by_bic);
  for (i = 0; i < s->n_pool && s->pool[i].fitted; i++) {
    int again = 0;
    for (k = 0; k < n; k++)
      again |= is_same(&s->pool[k], &s->pool[i]);
    if (again)
      continue;
    if (n != i)
      s->pool[n] = s->pool[i];
    note_step(s->result, &s->pool[n]);
    n++;
  }
  s->n_pool = n;
}

/* Significant, but not worth adding: the best one, and what cannot be told from it. */
static void list_small(search *s)
{
  lab_loop_result *r = s->result;
  const lab_found *found = &s->pool[0].found[s->pool[0].n_found - 1];
  int i;
  note_alike_best(s->pool, s->n_pool);
  r->listed[r->n_listed++] = found->effect;
  for (i = 0; i < found->n_alike && r->n_listed < LAB_TRACE_MAX; i++)
    r->listed[r->n_listed++] = found->alike[i];
}

/* Whether some model at hand leaves only noise, so that poorer ones need not be extended. */
static int settled(const search *s)
{
  return lab_any_is_noise(s->beam, 1) || lab_any_is_noise(s->pool, s->n_pool);
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
  note_alike_best(s->pool, s->n_pool);
  for (i = 0; i < s->n_pool && i < BEAM; i++) {
    lab_attempt_explain(&s->pool[i], declared);
    s->beam[i] = s->pool[i];
  }
  s->n_beam = i;
  *better = 1;
  return LAB_OK;
}

/* Without one of the found effects, fitted again, or not fitted where no fit is found.  Returns: LAB_OK, LAB_WORLD. */
static int leave_out(const lab_attempt *a, int which, lab_attempt *without, lab_error *error)
{
  int k;
  *without = *a;
  if (a->found[which].shape >= 0)
    lab_unknowns_drop(&without->u, a->found[which].shape);
  lab_unknowns_drop(&without->u, a->found[which].param);
  for (k = which; k + 1 < without->n_found; k++)
    without->found[k] = without->found[k + 1];
  without->n_found--;
  return lab_attempt_fit(without, LAB_FIT_WHOLE, error) == LAB_WORLD ? LAB_WORLD : LAB_OK;
}

/* Take out again what is not needed now that other effects have come. */
static int remove_needless(lab_attempt *a, lab_error *error)
{
  lab_attempt *without = malloc(sizeof *without);
  int i, status = without ? LAB_OK : lab_fail_memory(error, "the search");
  for (i = 0; status == LAB_OK && a->n_found > 1 && i < a->n_found - 1; i++) {
    if (a->found[i].term >= 0)
      continue;
    status = leave_out(a, i, without, error);
    if (status == LAB_OK && without->fitted && without->bic <= a->bic) {
      *a = *without;
      i = -1;
    }
  }
  free(without);
  return status;
}

/* An effect that was the best one alone need not be the best one beside those that came after it: put each earlier one
 * to the test again. */
static int exchange(search *s, lab_error *error)
{
  lab_attempt *without = malloc(sizeof *without);
  int i, status = without ? LAB_OK : lab_fail_memory(error, "the search");
  for (i = 0; status == LAB_OK && i < s->beam[0].n_found - 1; i++) {
    if (s->beam[0].found[i].term >= 0)
      continue;
    status = leave_out(&s->beam[0], i, without, error);
    if (status != LAB_OK || !without->fitted)
      continue;
    s->n_pool = 0;
    status = extend(s, without, error);
    rank(s);
    if (s->n_pool > 0 && s->pool[0].bic < s->beam[0].bic) {
      lab_attempt_explain(&s->pool[0], without->chi2);
      note_alike_best(s->pool, s->n_pool);
      s->beam[0] = s->pool[0];
    } else
      note_alike(&s->beam[0], i, s->pool, s->n_pool);
  }
  free(without);
  return status;
}

static int verdict_of(const lab_attempt *a)
{
  int i, unlisted = 0;
  for (i = 0; i < a->n_found; i++)
    unlisted |= a->found[i].term >= 0;
  if (unlisted)
    return LAB_VERDICT_UNLISTED;
  if (!lab_any_is_noise(a, 1))
    return LAB_VERDICT_UNDECIDED;
  return a->n_found > 0 ? LAB_VERDICT_EFFECT : LAB_VERDICT_NONE;
}

/* A free term can bend to nearly anything, and says nothing beyond what it has seen: it must leave only noise, or far
 * less than what has a name does. */
static int is_better(const lab_attempt *nameless, const lab_attempt *named, double share)
{
  const double n = (double)named->u.n_values;
  return nameless->fitted && nameless->bic < named->bic &&
         (lab_any_is_noise(nameless, 1) || nameless->chi2 - n < share * (named->chi2 - n));
}

static int slot_passes(const search *s, const lab_slot *slot)
{
  return slot->degrees > 0 &&
         lab_slot_tests(&slot->term) * lab_chi2_tail(slot->statistic, slot->degrees) < s->result->level;
}

/* The best free term beside a model, if the best slot passes.  Out: best, fitted or not */
static int find_slot(const search *s, const lab_attempt *base, lab_attempt *best, lab_error *error)
{
  lab_attempt copy = *base;
  lab_slot slot[LAB_SLOT_MAX];
  lab_scan scan;
  int n, status = lab_scan_open(&copy.u, &scan, error);
  best->fitted = 0;
  if (status == LAB_OK)
    status = lab_slots_try(&scan, slot, &n, error);
  if (status == LAB_OK && n > 0 && slot_passes(s, slot))
    status = try_slots(s, base, slot, n, best, error);
  lab_scan_close(&scan);
  return status;
}

/* Nothing that has a name would do: a free term beside what was found, which may then be needless. */
static int last_resort(search *s, lab_error *error)
{
  lab_attempt *best = &s->beam[0], *longer = &s->pool[0];
  lab_errors before, after;
  if (find_slot(s, best, longer, error))
    return error->status;
  if (!is_better(longer, best, convincing))
    return LAB_OK;
  note_step(s->result, longer);
  if (lab_loop_errors(&best->u, &before, error) || lab_loop_errors(&longer->u, &after, error))
    return error->status;
  if (gain(best, longer, &before, &after) < s->options->min_gain) {
    s->result->small = longer->u.rig.term[longer->u.rig.n_terms - 1];
    s->result->has_small = 1;
    return LAB_OK;
  }
  *best = *longer;
  if (remove_needless(best, error))
    return error->status;
  note_way(s->result, best);
  return LAB_OK;
}

/* Whether it is time for a free term beside the declared model: when no single effect explains much, or when two leave
 * more than noise. */
static int wants_nameless(const search *s, int rounds)
{
  const lab_attempt *best = &s->beam[0];
  return !s->nameless->fitted && !lab_any_is_noise(best, 1) && (rounds > 0 || lab_refit_all_poor(s->declared, best, 1));
}

static int search_all(search *s, lab_error *error)
{
  lab_attempt *best = &s->beam[0];
  int rounds, better = 1;
  note_way(s->result, best);
  for (rounds = 0; better && rounds < s->options->max_effects; rounds++) {
    if (advance(s, &better, error))
      return error->status; /* NOLINT(clang-analyzer-unix.Malloc): the caller frees what it made */
    if (better)
      note_way(s->result, best);
    if (best->u.window && lab_any_is_noise(best, 1))
      return LAB_OK; /* a coarse view does not see fine differences */
    if (better && best->n_found > 1) {
      const double before = best->chi2;
      if (remove_needless(best, error))
        return error->status;
      if ((best->n_found == 2 || lab_any_is_noise(best, 1)) && exchange(s, error))
        return error->status;
      if (best->chi2 != before)
        note_way(s->result, best);
    }
    if (wants_nameless(s, rounds) && find_slot(s, s->declared, s->nameless, error))
      return error->status;
    if (!lab_any_is_noise(best, 1) &&
        (lab_any_is_noise(s->nameless, 1) || (best->n_found > 1 && is_better(s->nameless, best, compelling))))
      break;
  }
  if (s->nameless->fitted && !lab_any_is_noise(best, 1) &&
      is_better(s->nameless, best, best->n_found > 1 ? 1 : convincing)) {
    *best = *s->nameless;
    note_step(s->result, best);
    s->result->n_path = 1;
    note_way(s->result, best);
  }
  if (best->u.rig.n_terms == 0 && best->n_found < LAB_LOOP_EFFECTS && (best->n_found == 0 || leaves_something(best)))
    return last_resort(s, error);
  return LAB_OK;
}

/* The search from a declared model, fitted, in the view that the unknowns have.  Out: best, with what was added */
static int search_from(const lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result,
                       lab_attempt *best, lab_error *error)
{
  search s = {options, result, NULL, 1, NULL, 0, NULL, NULL};
  int status = LAB_OK;
  s.declared = calloc(1, sizeof *s.declared);
  s.nameless = calloc(1, sizeof *s.nameless);
  s.beam = calloc(BEAM, sizeof *s.beam);
  s.pool = malloc((size_t)BEAM * LAB_REFIT_MAX * sizeof *s.pool);
  if (!s.beam || !s.pool || !s.declared || !s.nameless)
    status = lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    s.declared->u = *u;
    status = lab_attempt_fit(s.declared, LAB_FIT_WHOLE, error);
    s.beam[0] = *s.declared;
  }
  if (status == LAB_OK) {
    note_step(result, &s.beam[0]);
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
                           lab_attempt *best, int *done, lab_error *error)
{
  lab_unknowns coarse = *u;
  *done = 0;
  if (lab_unknowns_rough(u, &result->window, error))
    return error->status;
  if (result->window == 0)
    return LAB_OK;
  lab_unknowns_view(&coarse, result->window);
  if (search_from(&coarse, options, result, best, error))
    return error->status;
  *done = best->n_found > 0 && lab_any_is_noise(best, 1);
  if (!*done) {
    result->trace.n = 0;
    result->n_steps = result->n_listed = result->n_path = 0;
    result->window = 0;
  }
  return LAB_OK;
}

int lab_loop_run(lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, lab_error *error)
{
  lab_attempt *best = malloc(sizeof *best);
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
