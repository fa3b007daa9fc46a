#include "preview.h"

#include <stdlib.h>

#include "../base/clock.h"
#include "../fit/beginning.h"
#include "contest.h"
#include "rivals.h"

int lab_preview_is_asked(const lab_unknowns *u)
{
  return u->n_runs == 1 && u->window == 0 && (double)u->run->n >= lab_constant(LAB_PREVIEW_ROWS);
}

/* The search of the first n rows.
 * Out:     f          what was found
 *          cut_short  whether its share of the time is spent
 * Returns: as lab_contest_run */
static int search_first(const lab_unknowns *u, size_t n, const lab_search_options *options, lab_finding *f,
                        int *cut_short, lab_error *error)
{
  const double now = lab_cpu_time();
  lab_unknowns *first = malloc(sizeof *first);
  lab_run part = {0};
  int status = first ? lab_beginning_open(u->run, n, &part, error) : lab_fail_memory(error, "the search");
  if (status == LAB_OK) {
    *first = *u;
    first->run = &part;
    first->until = u->until > 0 ? now + lab_constant(LAB_PREVIEW_TIME) * (u->until - now) : 0;
    lab_unknowns_view(first, 0);
    status = lab_unknowns_fit(first, LAB_ROUNDS_ALL, NULL, error);
    if (status == LAB_OK)
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

/* What the whole run does not ask for goes, and each effect is put against those that may stand in its place. */
static int put_to_test(lab_candidate *c, lab_error *error)
{
  int changed, status = lab_candidate_drop_needless(c, c->n_found, error);
  return status == LAB_OK && c->n_found > 0 ? lab_rivals_try(c, &changed, error) : status;
}

/* The search of the whole run from there.
 * In:      n      first rows, of which `first` is
 * Out:     whole  room, then what was found */
static int go_on(const lab_unknowns *u, size_t n, const lab_search_options *options, lab_finding *first,
                 lab_finding *whole, lab_error *error)
{
  const double *t = &u->run->log->value[LAB_CHANNEL_TIME][u->run->first];
  const int any = first->best.n_found > 0 || lab_candidate_begins(&first->best);
  whole->exact = NULL;
  whole->declared = any ? first->declared : first->best;
  if (first->result.scores.n > 0) {
    whole->result.scores = first->result.scores;
    whole->result.level = first->result.level;
    whole->result.score_s = first->result.score_s;
    whole->result.preview = t[n - 1] - t[0];
  }
  widen(u, &whole->declared);
  if (any && lab_candidate_fit(&whole->declared, 1, error))
    return error->status;
  return lab_rounds_run(whole, any ? first : NULL, NULL, options, error);
}

int lab_preview_search(const lab_unknowns *u, const lab_search_options *options, lab_finding *f, int *done,
                       lab_error *error)
{
  const size_t n = (size_t)(lab_constant(LAB_PREVIEW_SHARE) * (double)u->run->n);
  lab_finding *first = malloc(sizeof *first), *whole = malloc(sizeof *whole);
  int cut_short = 0, status = first && whole ? LAB_OK : lab_fail_memory(error, "the search");
  *done = 0;
  if (status == LAB_OK) {
    *first = *whole = *f;
    status = search_first(u, n, options, first, &cut_short, error);
  }
  if (status == LAB_OK && (first->result.verdict != LAB_VERDICT_UNDECIDED || cut_short)) {
    widen(u, &first->best);
    status = lab_candidate_fit_held(&first->best, error);
    *done = status == LAB_OK && first->best.quality.fitted && (lab_is_noise(&first->best.quality) || cut_short);
    if (*done)
      status = put_to_test(&first->best, error);
    if (*done && status == LAB_OK)
      status = go_on(u, n, options, first, whole, error);
    *done &= status == LAB_OK;
    if (*done)
      *f = *whole;
  }
  free(first);
  free(whole);
  return status == LAB_WORLD ? status : LAB_OK;
}
