#include "preview.h"

#include <math.h>
#include <stdlib.h>

#include "../base/clock.h"
#include "../fit/beginning.h"
#include "contest.h"
#include "departure.h"
#include "early.h"
#include "refill.h"
#include "resume.h"

/* Of the time that is left, for what may be in vain: then the whole is searched.  By judgement. */
static const double most = 0.6;

/* What a simulation of a run costs, in rows of one whose command hardly changes: in a loop every row may switch. */
static double cost_of(const lab_unknowns *u)
{
  static const double of_change = 9, in_loop = 8; /* by judgement */
  const lab_run *x = u->run;
  return (lab_refill_loops(u) ? in_loop : 1) * (double)x->n + of_change * (double)x->n_instants;
}

int lab_preview_is_asked(const lab_unknowns *u)
{
  static const size_t fewest = 400; /* rows, of which the beginning is a third: by judgement */
  return u->n_runs == 1 && u->window == 0 && u->run->n >= fewest && cost_of(u) >= lab_constant(LAB_PREVIEW_ROWS);
}

/* Fit the first rows from the values of the whole run, and from the declared ones where that leaves plainly more than
 * noise: what begins after these rows has bent the others. */
static int fit_first(lab_unknowns *first, lab_error *error)
{
  lab_unknowns *afresh = malloc(sizeof *afresh);
  double bent = HUGE_VAL, chi2 = HUGE_VAL;
  int again, status = afresh ? LAB_OK : lab_fail_memory(error, "the search");
  if (status == LAB_OK)
    status = lab_unknowns_fit(first, LAB_ROUNDS_ALL, &bent, error);
  bent = status == LAB_OK ? bent : HUGE_VAL;
  if (status != LAB_WORLD && bent > lab_constant(LAB_NOISE_DOUBTFUL) * (double)first->n_values) {
    *afresh = *first;
    lab_unknowns_undo_fit(afresh);
    again = lab_unknowns_fit(afresh, LAB_ROUNDS_ALL, &chi2, error);
    if (again == LAB_OK && chi2 < bent)
      *first = *afresh;
    status = again == LAB_NUMERIC ? status : again;
  }
  free(afresh);
  return status;
}

/* The search of the first n rows.
 * Out:     f          what was found
 *          cut_short  whether its share of the time is spent
 * Returns: as lab_contest_run */
static int search_first(const lab_unknowns *u, size_t n, const lab_search_options *options, lab_finding *f,
                        int *cut_short, lab_error *error)
{
  lab_unknowns *first = malloc(sizeof *first);
  lab_run part = {0};
  int leaks = 0, status = first ? lab_beginning_open(u->run, n, &part, error) : lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    *first = *u;
    first->run = &part;
    first->until = lab_cpu_share(u->until, lab_constant(LAB_PREVIEW_TIME));
    lab_unknowns_view(first, 0);
    status = fit_first(first, error);
    if (status == LAB_OK && lab_refill_is_asked(first))
      status = lab_refill_search(first, options, f, &leaks, error);
    if (status == LAB_OK && !leaks)
      status = lab_contest_run(first, 1, options, f, error);
    *cut_short = lab_cpu_is_spent(first->until);
  }
  lab_beginning_close(&part);
  free(first);
  return status;
}

/* A model of the first rows becomes one of the whole run, not fitted. */
static void widen(const lab_unknowns *u, lab_candidate *c)
{
  c->u.run = u->run;
  c->u.until = u->until;
  lab_unknowns_view(&c->u, 0);
}

/* Nothing is missing from the first rows: they say what the values are when something begins after them.
 * In/out:  f  best: with the values of these rows; then fitted to the whole run, with what begins in it, or neither */
static int fit_further(lab_finding *f, size_t rows, double alpha, lab_error *error)
{
  const double until = f->best.u.until;
  lab_candidate *onset = malloc(sizeof *onset);
  size_t sound = 0;
  int status;
  f->best.u.until = lab_cpu_share(until, most);
  status = onset ? lab_early_fit(&f->best, rows, alpha, onset, &f->begins, &sound, error)
                 : lab_fail_memory(error, "what begins");
  if (status == LAB_OK && onset->quality.fitted)
    f->best = *onset;
  else {
    f->best.quality.fitted &= sound == f->best.u.run->n;
    f->sound = sound;
  }
  f->best.u.until = until;
  free(onset);
  return status;
}

/* Whether the model of the first rows leaves only noise of the whole run after a few steps; else it is as it was. */
static int fit_at_once(lab_candidate *c, lab_error *error)
{
  lab_candidate *whole = malloc(sizeof *whole);
  int sound = 0;
  if (!whole)
    return 0;
  *whole = *c;
  sound = lab_candidate_fit(whole, LAB_STEPS_ONWARD, error) == LAB_OK && lab_is_noise(&whole->quality);
  if (sound)
    *c = *whole;
  free(whole);
  return sound;
}

/* What was found in the first n rows, fitted to the whole run.
 * In:      is_last  not 0: there is no time for a search of the whole */
static int fit_whole(const lab_unknowns *u, size_t n, int is_last, const lab_search_options *options, lab_finding *f,
                     lab_error *error)
{
  const int all = f->result.verdict == LAB_VERDICT_NONE && f->best.quality.fitted && lab_is_noise(&f->best.quality);
  widen(u, &f->best);
  if (all && fit_at_once(&f->best, error))
    return LAB_OK;
  if ((all || f->sound > 0) && lab_rounds_may_begin(&f->best.u, options)) {
    const int status = fit_further(f, all ? n : f->sound, options->alpha, error);
    if (status != LAB_OK || f->best.quality.fitted || !is_last)
      return status;
  }
  return lab_candidate_fit_held(&f->best, error);
}

/* Up to when the first rows of a run, of which nothing is missing, go on as they are [s]. */
static double sound_until(const lab_run *x, const lab_finding *first)
{
  const int none = first->result.verdict == LAB_VERDICT_NONE && first->sound > 0 && first->sound < x->n;
  return none ? x->log->value[LAB_CHANNEL_TIME][x->first + first->sound - 1] : 0;
}

/* What was tried on the first n rows is what is told of. */
static void keep_scores(const lab_run *x, size_t n, const lab_finding *first, lab_finding *whole)
{
  const double *t = &x->log->value[LAB_CHANNEL_TIME][x->first];
  if (first->result.scores.n == 0)
    return;
  whole->result.scores = first->result.scores;
  whole->result.level = first->result.level;
  whole->result.score_s = first->result.score_s;
  whole->result.preview = t[n - 1] - t[0];
}

int lab_preview_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                       lab_error *error)
{
  const size_t n = (size_t)(lab_constant(LAB_PREVIEW_SHARE) * (double)u->run->n);
  lab_finding *first = malloc(sizeof *first), *whole = malloc(sizeof *whole);
  lab_candidate *held = calloc(1, sizeof *held);
  int cut_short = 0, comes_near = 0, status = first && whole && held ? LAB_OK : lab_fail_memory(error, "the search");
  *done = 0;
  if (status == LAB_OK) {
    *first = *whole = *f;
    first->held = held;
    status = search_first(u, n, options, first, &cut_short, error);
  }
  if (status == LAB_OK && (first->result.verdict != LAB_VERDICT_UNDECIDED || first->sound > 0 || cut_short)) {
    status = fit_whole(u, n, cut_short, options, first, error);
    *done = status == LAB_OK && first->best.quality.fitted && (lab_is_noise(&first->best.quality) || cut_short);
    comes_near = status == LAB_OK && !*done && first->best.n_found > 0 && !lab_is_plainly_off(&first->best.quality);
    keep_scores(u->run, n, first, whole);
    if (comes_near)
      first->best.u.until = lab_cpu_share(u->until, most);
    if (*done || comes_near)
      status = lab_resume(u, options, first, whole, error);
    whole->best.u.until = u->until;
    *done = status == LAB_OK && (*done || (comes_near && whole->result.verdict == LAB_VERDICT_EFFECT));
    if (*done)
      *f = *whole;
    else
      f->result.sound_until = sound_until(u->run, first);
  }
  free(held);
  free(first);
  free(whole);
  return status == LAB_WORLD ? status : LAB_OK;
}
