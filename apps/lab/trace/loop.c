#include "loop.h"

#include <stdlib.h>
#include <string.h>

#include "loop_private.h"
#include "refit.h"

enum { BEAM = 2 };
static const double rival = 3; /* times the best chi-square: a poorer model is not extended */

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

/* Significant, but not worth adding: the best one, and what cannot be told from it. */
static void list_small(search *s)
{
  lab_loop_result *r = s->result;
  const lab_found *found = &s->pool[0].found[s->pool[0].n_found - 1];
  int i;
  loop_note_alike_best(s->pool, s->n_pool);
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
  int i, enough;
  *better = 0;
  s->n_pool = 0;
  for (i = 0; i < s->n_beam && (i == 0 || (!settled(s) && s->beam[i].chi2 < rival * s->beam[0].chi2)); i++)
    if (loop_extend(s, &s->beam[i], error))
      return error->status;
  loop_rank(s);
  if (s->n_pool == 0 || !(s->pool[0].bic < s->beam[0].bic))
    return LAB_OK;
  if (loop_is_gain(s, &s->beam[0], &s->pool[0], &enough, error))
    return error->status;
  if (!enough) {
    list_small(s);
    return LAB_OK;
  }
  loop_note_alike_best(s->pool, s->n_pool);
  for (i = 0; i < s->n_pool && i < BEAM; i++) {
    lab_attempt_explain(&s->pool[i], declared);
    s->beam[i] = s->pool[i];
  }
  s->n_beam = i;
  *better = 1;
  return LAB_OK;
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

static int search_all(search *s, lab_error *error)
{
  lab_attempt *best = &s->beam[0];
  int rounds, better = 1;
  loop_note_way(s->result, best);
  for (rounds = 0; better && rounds < s->options->max_effects; rounds++) {
    if (advance(s, &better, error))
      return error->status; /* NOLINT(clang-analyzer-unix.Malloc): the caller frees what it made */
    if (better)
      loop_note_way(s->result, best);
    if (best->u.window && lab_any_is_noise(best, 1))
      return LAB_OK; /* a coarse view does not see fine differences */
    if (better && best->n_found > 1) {
      const double before = best->chi2;
      if (loop_remove_needless(best, error))
        return error->status;
      if ((best->n_found == 2 || lab_any_is_noise(best, 1)) && loop_exchange(s, error))
        return error->status;
      if (best->chi2 != before)
        loop_note_way(s->result, best);
    }
    if (loop_wants_nameless(s, rounds) && loop_find_slot(s, s->declared, s->nameless, error))
      return error->status;
    if (loop_is_compelling(s))
      break;
  }
  if (loop_is_preferred(s)) {
    *best = *s->nameless;
    loop_note_step(s->result, best);
    s->result->n_path = 1;
    loop_note_way(s->result, best);
  }
  return loop_last_resort(s, error);
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
    loop_note_step(result, &s.beam[0]);
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
