/* The search from values exactly as declared and that from values within their tolerances, side by side. */
#include "contest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "early.h"

/* Whether a search has explained the logs. */
static int explains(const lab_finding *f)
{
  return (f->best.n_found > 0 || lab_candidate_begins(&f->best)) && lab_is_noise(&f->best.quality);
}

/* The search from the declared values as they stand; what it finds is then fitted with tolerances. */
static int search_exactly(const lab_unknowns *u, const lab_quality *within, const lab_search_options *options,
                          lab_finding *f, lab_error *error)
{
  static const double share = 0.35;
  f->declared.u = *u;
  f->declared.u.until = lab_cpu_share(u->until, share); /* most of it is for the other: no rig is just as declared */
  if (lab_rounds_run(f, NULL, within, options, error))
    return error->status;
  if (!explains(f))
    return LAB_OK;
  f->best.u.until = u->until;
  f->gain = f->best.quality.chi2;
  if (lab_unknowns_hold(&f->best.u, error) || lab_candidate_fit(&f->best, LAB_ROUNDS_ALL, error))
    return error->status;
  f->gain -= f->best.quality.chi2;
  return LAB_OK;
}

/* How many things were found: what begins, and effects that act throughout. */
static int count_causes(const lab_candidate *c)
{
  int i, n = 0;
  for (i = 0; i < c->u.rig.n_onsets; i++)
    n += c->begin[i].known != 0;
  for (i = 0; i < c->n_found; i++)
    n += lab_unknowns_find_onset(&c->u, c->found[i].param) < 0;
  return n;
}

static int has_held(const lab_unknowns *u)
{
  int j, any = 0;
  for (j = 0; j < u->n; j++)
    any |= lab_unknown_is_held(&u->unknown[j]);
  return any;
}

/* Whether a search that explains the logs by what acts or begins needs no deviations beside. Of two such things one may
 * stand for these.
 * In:      tolerant  the declared model within its tolerances */
static int is_enough(const lab_finding *f, const lab_unknowns *tolerant)
{
  const int explained = f->result.verdict == LAB_VERDICT_EFFECT ||
                        (f->result.verdict == LAB_VERDICT_NONE && lab_candidate_begins(&f->best));
  return explained && f->gain < lab_constant(LAB_DEVIATIONS_GAIN) &&
         (count_causes(&f->best) < 2 || !has_held(tolerant));
}

/* Whether of two searches that explain nothing the first is to be told for its candidates. */
static int comes_nearer(const lab_finding *exact, const lab_finding *tolerant)
{
  return exact->best.quality.fitted && exact->result.verdict == LAB_VERDICT_UNDECIDED &&
         tolerant->result.verdict == LAB_VERDICT_UNDECIDED && exact->best.quality.bic < tolerant->best.quality.bic;
}

int lab_contest_is_better(const lab_finding *exact, const lab_finding *tolerant)
{
  const lab_quality *of_exact = &exact->best.quality, *of_tolerant = &tolerant->best.quality;
  const int strains = lab_is_strained(of_tolerant) && !lab_is_strained(of_exact);
  const double odds = strains && lab_candidate_has_cause(&exact->best) ? -lab_constant(LAB_ALIKE_BIC)
                      : tolerant->best.n_found < exact->best.n_found && lab_is_noise(of_tolerant)
                          ? lab_constant(LAB_ALIKE_BIC)
                          : 0;
  return of_exact->bic + odds < of_tolerant->bic;
}

/* Whether something that begins is to be told and not what acts throughout, which may show late and is simpler. */
static int is_plainly_later(const lab_finding *early, const lab_finding *throughout)
{
  const double odds = lab_candidate_begins(&throughout->best) ? 0 : lab_constant(LAB_ALIKE_BIC);
  return early->best.quality.bic + odds < throughout->best.quality.bic;
}

/* When to stop where there is an answer already: after four times as long again, and a second; never where time does
 * not count, so that an answer is the same each time. */
static double enough(double until, double start)
{
  const double now = lab_cpu_time();
  return until > 0 ? fmin(until, now + 4 * (now - start) + 1) : 0;
}

/* What a search from exact values says begins, with values within their tolerances.
 * In:      tolerant  the declared model with these, without anything that begins
 * In/out:  c         fitted
 * Out:     begins    whether it convinces
 * Returns: LAB_OK, LAB_WORLD */
static int tolerate_onset(lab_candidate *c, const lab_quality *tolerant, int *begins, lab_error *error)
{
  int status;
  *begins = 0;
  if (!lab_candidate_begins(c) || lab_cpu_is_spent(c->u.until))
    return LAB_OK;
  status = lab_candidate_hold(c, error);
  if (status == LAB_OK)
    status = lab_candidate_place_again(c, error);
  *begins = status == LAB_OK && lab_onset_convinces(&c->quality, tolerant);
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_contest_hold(const lab_unknowns *u, lab_finding *f, lab_error *error)
{
  const double start = lab_cpu_time();
  int status;
  if (f->held->u.run == u->run)
    return LAB_OK;
  memset(f->held, 0, sizeof *f->held);
  f->held->u = *u;
  status = lab_candidate_hold(f->held, error);
  if (status != LAB_OK)
    f->held->u.run = NULL; /* not to be taken for one that is fitted */
  f->held_s = lab_cpu_time() - start;
  return status;
}

/* `within` becomes the declared model held to its tolerances, fitted; its time stays. */
static int take_held(lab_finding *f, lab_candidate *within, lab_error *error)
{
  const double until = within->u.until;
  const int status = lab_contest_hold(&within->u, f, error);
  if (status == LAB_OK) {
    within->u = f->held->u;
    within->u.until = until;
    within->quality = f->held->quality;
  }
  return status;
}

/* The declared model within its tolerances, or what begins within the logs where that explains them, unless a preview
 * has looked for that in vain.
 * In:      u       the declared model, fitted
 * In/out:  begun   with the errors of the declared model; then what begins
 * Out:     within  with what is held, fitted; where something begins as u
 *          begins  whether anything does
 *          sound   rows of the run, from its beginning, that leave only noise, as far as that was asked
 * Returns: LAB_OK, LAB_DATA, LAB_NUMERIC, LAB_WORLD */
static int fit_within(const lab_unknowns *u, const lab_search_options *options, lab_candidate *within,
                      lab_finding *begun, int *begins, size_t *sound, lab_error *error)
{
  static const double most = 0.8; /* of the time: if nothing begins the rest has to do */
  const lab_errors *declared = &begun->result.before;
  const lab_quality left = {.fitted = 1, .chi2 = declared->chi2, .values = (double)declared->n};
  int status;
  within->u = *u;
  within->u.until = lab_cpu_share(u->until, most);
  *sound = 0;
  *begins = within->quality.fitted = 0;
  status = begun->held ? take_held(begun, within, error) : lab_candidate_hold(within, error);
  if (status == LAB_OK && lab_is_plainly_off(&left) && lab_is_plainly_off(&within->quality) &&
      !(begun->result.sound_until > 0) && lab_rounds_may_begin(&within->u, options)) {
    status = lab_early_fit(within, 0, options->alpha, &begun->best, &begun->begins, sound, error);
    begun->best.u.until = u->until;
    *begins = status == LAB_OK && begun->best.quality.fitted;
  }
  within->u.until = u->until;
  if (*begins) {
    within->u = *u;
    return lab_candidate_fit(within, 1, error);
  }
  return status == LAB_OK ? lab_candidate_let_go(within, error) : status;
}

/* A search holds what varies unseen to straight lines. If the declared model, fitted without them, is the better one
 * after all, it was only these that asked for more. */
static void forget_what_was_in_vain(lab_finding *f)
{
  if (f->best.n_found == 0 || !f->declared.quality.fitted || !(f->best.quality.bic > f->declared.quality.bic))
    return;
  f->best = f->declared;
  f->result.n_path = 1;
  f->result.verdict = lab_is_noise(&f->best.quality) ? LAB_VERDICT_NONE : LAB_VERDICT_UNDECIDED;
}

/* When a search ends [s]: what follows it takes about as long as the first fit with tolerances, and a quarter of the
 * search's time is kept for that already (for_search in answer.c).
 * In:      start  [s] when that fit began */
static double before_the_end(double until, double start)
{
  static const double kept = 0.25;
  return until > 0 ? until - fmax(lab_cpu_time() - start - kept * (until - start), 0) : 0;
}

typedef struct contest {
  lab_finding exact, begun, early; /* begun: what begins in `exact`, alone;  early: what begins where the run leaves the
                                      model that explains its beginning */
  int is_exact;                    /* whether `exact` is the answer so far */
  int begins;                      /* whether something was found to begin */
  double start, until;             /* [s] of CPU time */
} contest;

/* What is found beside values exactly as declared, and whether that explains the logs. Once the time is spent, nothing.
 * In:      u         the declared model, fitted
 * In/out:  tolerant  it within its tolerances, fitted */
static int search_beside(const lab_unknowns *u, const lab_search_options *options, contest *c, lab_finding *tolerant,
                         lab_error *error)
{
  lab_candidate *within = &tolerant->best;
  int status = LAB_OK;
  if (!lab_cpu_is_spent(u->until))
    status = search_exactly(u, c->begins ? &c->early.best.quality : &within->quality, options, &c->exact, error);
  c->is_exact = status == LAB_OK && explains(&c->exact) && !(c->begins && is_plainly_later(&c->early, &c->exact));
  if (c->begins && c->is_exact) {
    c->begins = 0;
    within->u.until = u->until;
    status = lab_candidate_hold(within, error);
    within->u.until = c->until;
    tolerant->declared = *within;
  } else if (c->begins && status != LAB_WORLD) {
    c->exact = c->early;
    status = LAB_OK;
  } else if (status == LAB_OK && !c->is_exact)
    status = tolerate_onset(&c->exact.best, &within->quality, &c->begins, error);
  return status;
}

/* What begins, without what was found beside it: that has to be found again. */
static int keep_onset(lab_candidate *c, double until, lab_error *error)
{
  int i = c->n_found;
  while (i-- > 0)
    if (c->found[i].term >= 0 || lab_unknowns_find_onset(&c->u, c->found[i].param) < 0)
      lab_candidate_drop(c, i);
  c->u.until = until;
  return lab_candidate_hold(c, error);
}

/* The rounds from values within their tolerances, and whether their answer is the better one. */
static int search_within(const lab_search_options *options, contest *c, lab_finding *tolerant, lab_error *error)
{
  const int begins = c->begins || (c->is_exact && lab_candidate_begins(&c->exact.best));
  int status = LAB_OK;
  if (c->is_exact)
    tolerant->declared.u.until = enough(c->until, c->start);
  if (begins) {
    c->begun = c->exact;
    status = keep_onset(&c->begun.best, tolerant->declared.u.until, error);
  }
  if (status == LAB_OK)
    status = lab_rounds_run(tolerant, begins ? &c->begun : NULL, NULL, options, error);
  if (status == LAB_OK)
    forget_what_was_in_vain(tolerant);
  if (status == LAB_NUMERIC)
    c->is_exact = c->exact.result.n_path > 0 && c->exact.best.quality.fitted;
  else if (c->is_exact)
    c->is_exact = status != LAB_OK || lab_contest_is_better(&c->exact, tolerant);
  else
    c->is_exact = status == LAB_OK && comes_nearer(&c->exact, tolerant);
  return status;
}

/* Whether the declared model within its tolerances leaves nothing to explain. */
static int is_explained(const contest *c, const lab_candidate *within)
{
  return !c->begins && lab_is_noise(&within->quality) && !lab_is_strained(&within->quality);
}

/* Both searches, as far as they are needed.
 * In:      status  of the fit within tolerances: where there is none, only the second is made */
static int search_both(const lab_unknowns *u, const lab_search_options *options, contest *c, int status,
                       lab_finding *tolerant, lab_error *error)
{
  if (status == LAB_OK && !is_explained(c, &tolerant->best))
    status = search_beside(u, options, c, tolerant, error);
  if (status != LAB_WORLD && !(c->is_exact && is_enough(&c->exact, &tolerant->declared.u)))
    status = search_within(options, c, tolerant, error);
  if (c->is_exact) {
    *tolerant = c->exact;
    status = LAB_OK;
  }
  return status;
}

int lab_contest_run(const lab_unknowns *u, int is_brief, const lab_search_options *options, lab_finding *f,
                    lab_error *error)
{
  static const double nearly_all = 0.8; /* by judgement: what begins after that shows too little before the end */
  contest *c = malloc(sizeof *c);
  size_t sound;
  int status;
  if (!c)
    return lab_fail_memory(error, "the search");
  c->exact = c->early = *f;
  c->is_exact = c->begins = 0;
  f->sound = 0;
  c->start = lab_cpu_time() - (f->held && f->held->u.run == u->run ? f->held_s : 0);
  f->exact = u;
  status = fit_within(u, options, &f->best, &c->early, &c->begins, &sound, error);
  c->until = before_the_end(u->until, c->start);
  f->best.u.until = c->until;
  f->declared = f->best;
  if (status == LAB_OK && is_brief && is_explained(c, &f->best))
    f->result.verdict = LAB_VERDICT_NONE;
  else if (status == LAB_OK && is_brief && !c->begins && sound < u->run->n &&
           (double)sound > nearly_all * (double)u->run->n) {
    f->result.verdict = LAB_VERDICT_UNDECIDED;
    f->best = c->early.best;
    f->sound = sound;
  } else
    status = search_both(u, options, c, status, f, error);
  f->best.u.until = c->until;
  free(c);
  return status;
}
