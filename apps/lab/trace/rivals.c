#include "rivals.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "carry.h"
#include "refill.h"
#include "refit_private.h"

/* Those that stand for one effect: the first is the model that has it, last of what was found. */
typedef struct field {
  lab_candidate of[1 + LAB_RIVALS_MAX];
  int n;
  lab_unknowns base; /* the final model with its slopes, with which all others begin */
} field;

static void put_first_last(lab_candidate *c)
{
  const lab_found first = c->found[0];
  memmove(c->found, c->found + 1, (size_t)(c->n_found - 1) * sizeof *c->found);
  c->found[c->n_found - 1] = first;
}

static int is_listed(const lab_score *leader, int n, int effect)
{
  int i, any = 0;
  for (i = 0; i < n; i++)
    any |= leader[i].effect == effect;
  return any;
}

/* What scores nearly as high as the best in a model from which an effect was taken out.
 * In/out:  leader  room for LAB_RIVALS_MAX, n of them listed already
 * Returns: how many; -1: see error */
static int find_leaders(const field *f, const lab_candidate *without, const lab_found *taken_out, lab_score *leader,
                        int n, lab_error *error)
{
  lab_unknowns u = without->u;
  lab_projection p = {0};
  lab_scores scores = {0};
  int i, status = lab_unknowns_keep_slopes(&u, error);
  if (status == LAB_OK) {
    lab_unknowns_begin_with(&u, &f->base);
    status = lab_projection_open(&u, &p, error);
  }
  if (status == LAB_OK)
    status = lab_score_effects(&p, &scores, error);
  lab_projection_close(&p);
  lab_unknowns_forget_slopes(&u);
  for (i = 0; status == LAB_OK && i < scores.n && n < LAB_RIVALS_MAX; i++)
    if (scores.of[i].effect != taken_out->effect && !is_listed(leader, n, scores.of[i].effect) &&
        scores.of[i].statistic >= lab_constant(LAB_RIVAL_SHARE) * scores.of[0].statistic)
      leader[n++] = scores.of[i];
  return status == LAB_WORLD ? -1 : n;
}

/* The parameters of each leak: its size and, of some, its shape. Behind a positioner that makes up for a leak no slope
 * from none tells one from another. */
static const struct {
  const char *size, *shape;
} leaks[] = {{"leak_area", NULL}, {"laminar_leak", NULL}, {"porous_leak", "crossover_pressure"}};
enum { LEAKS = sizeof leaks / sizeof *leaks };

static int is_refilled(const lab_candidate *c, const lab_found *found)
{
  int i, any = 0;
  for (i = 0; i < LEAKS; i++)
    any |= found->param == pneu_param_find(leaks[i].size);
  return any && lab_refill_loops(&c->u);
}

/* The leaks that the model lacks, each with the flow of the one that was found.
 * In:      without  the model without that
 * Returns: how many */
static int find_leaks(const lab_candidate *c, const lab_candidate *without, const lab_found *found, lab_score *leader)
{
  const lab_rig with = lab_unknowns_expected(&c->u);
  const double flow = lab_rig_leak(&with, found->param);
  int i, n = 0;
  for (i = 0; i < LEAKS; i++) {
    const int param = pneu_param_find(leaks[i].size), shape = leaks[i].shape ? pneu_param_find(leaks[i].shape) : -1;
    lab_score *x = &leader[n];
    lab_rig rig = with;
    if (param < 0 || param == found->param || !lab_score_lacks(&without->u, pneu_effect_of(param)))
      continue;
    *x = (lab_score){.effect = pneu_effect_of(param), .param = param, .shape = shape};
    if (shape >= 0) {
      x->shape_value = lab_score_shape(&with.params, x, 1);
      *pneu_param_at(&rig.params, shape) = (pneu_real)x->shape_value;
    }
    *pneu_param_at(&rig.params, param) = lab_param_info(param).value;
    x->size = (double)lab_param_info(param).value * flow / lab_rig_leak(&rig, param);
    n += isfinite(x->size) && x->size > 0;
  }
  return n;
}

/* Put values back to what is declared: beside what was found they are bent to make up for what it is not.
 * Returns: whether one was off by half a tolerance or more */
static int unbend(lab_unknowns *u)
{
  static const double bent = 0.5; /* by judgement */
  int j, any = 0;
  for (j = 0; j < u->n; j++) {
    lab_unknown *x = &u->unknown[j];
    if (x->kind != LAB_UNKNOWN_PARAM || !lab_unknown_is_held(x))
      continue;
    any |= fabs(x->value - x->prior) > bent * x->tolerance;
    x->value = x->prior;
  }
  lab_unknowns_take(u);
  return any;
}

/* Fit an effect in the place of what was found last: briefly, and to the end if it comes near.
 * In:      slopes  to begin with, or NULL
 * In/out:  c       the model without it
 * Returns: whether it came near */
static int fit_in_place(const field *f, const lab_score *score, const lab_unknowns *slopes, lab_candidate *c,
                        lab_error *all)
{
  const lab_quality *best = &f->of[0].quality;
  const double near = best->bic + lab_constant(LAB_RIVAL_NEAR), far = lab_constant(LAB_RIVAL) * best->chi2;
  const double bar = lab_carry_is_asked(&f->of[0]) ? fmax(near, far) : near;
  lab_error error;
  int comes_near;
  if (lab_candidate_add_effect(c, score, score->size, &error) != LAB_OK)
    return 0;
  if (lab_unknowns_keep_slopes(&c->u, &error))
    lab_fail_together(all, &error);
  if (slopes)
    lab_unknowns_begin_with(&c->u, slopes);
  lab_refit_one(c, lab_count(LAB_BRIEF_STEPS), all);
  comes_near = c->quality.fitted && c->quality.bic < bar;
  if (comes_near)
    lab_refit_one(c, LAB_ROUNDS_ALL, all);
  lab_unknowns_forget_slopes(&c->u);
  return comes_near;
}

/* The same from the values of the model and, if that leads nowhere near, from those that are declared. */
static void fit_rival(const field *f, const lab_score *score, lab_candidate *c, lab_error *all)
{
  lab_candidate *again = malloc(sizeof *again);
  lab_error error;
  if (!again) {
    lab_fail_memory(&error, "a candidate");
    lab_fail_together(all, &error);
    return;
  }
  *again = *c;
  if (!fit_in_place(f, score, &f->base, c, all) && unbend(&again->u) && fit_in_place(f, score, NULL, again, all))
    *c = *again;
  free(again);
}

/* All that may stand in the place of what was found last.  Returns: LAB_OK, LAB_WORLD */
static int line_up(field *f, lab_error *error)
{
  lab_score leader[LAB_RIVALS_MAX];
  lab_candidate *without = &f->of[1];
  const lab_found *last = &f->of[0].found[f->of[0].n_found - 1];
  int i, n;
  *without = f->of[0];
  without->quality.fitted = 0;
  lab_candidate_drop(without, without->n_found - 1);
  n = is_refilled(&f->of[0], last) ? find_leaks(&f->of[0], without, last, leader) : 0;
  n = find_leaders(f, without, last, leader, n, error);
  if (n < 0)
    return error->status;
  f->n = 1 + n;
  for (i = 1; i < n; i++)
    f->of[1 + i] = *without;
  error->status = LAB_OK;
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++)
    fit_rival(f, &leader[i], &f->of[1 + i], error);
  return error->status;
}

/* What of chi-square the last of what was found explains.  Returns: LAB_OK, LAB_WORLD */
static int explain(lab_candidate *c, lab_error *error)
{
  lab_candidate *without = malloc(sizeof *without);
  int status = without ? LAB_OK : lab_fail_memory(error, "a candidate");
  if (status == LAB_OK)
    status = lab_candidate_leave_out(c, c->n_found - 1, without, error);
  if (status == LAB_OK && without->quality.fitted)
    lab_candidate_explain(c, without->quality.chi2);
  free(without);
  return status;
}

static int was_tried(const field *f, int effect)
{
  int i, any = 0;
  for (i = 0; i < f->n; i++)
    any |= f->of[i].found[f->of[i].n_found - 1].effect == effect;
  return any;
}

/* Note which rivals are as good as the best; what was as good before and was not tried is so still. */
static void note_alike(field *f, const lab_found *before)
{
  lab_found *found = &f->of[0].found[f->of[0].n_found - 1];
  int i;
  lab_candidate_note_alike(&f->of[0], f->of[0].n_found - 1, f->of + 1, f->n - 1);
  for (i = 0; found->effect == before->effect && i < before->n_alike && found->n_alike < LAB_LEADERS_MAX; i++)
    if (!was_tried(f, before->alike[i])) {
      found->alike_params[found->n_alike] = before->alike_params[i];
      found->alike[found->n_alike++] = before->alike[i];
    }
}

/* Which of those that come near carries over to runs that are left out: of two the one that fits better, unless the
 * other errs less there by more than chance.  Returns: LAB_OK, LAB_WORLD */
static int find_what_carries(const field *f, int *best, lab_error *error)
{
  const double bar = lab_constant(LAB_RIVAL) * f->of[0].quality.chi2;
  const int n = f->of[0].u.n_runs;
  double *present = malloc(2 * (size_t)n * sizeof *present), *other = present + n;
  int i, status = present ? lab_carry_over(&f->of[0], present, error) : lab_fail_memory(error, "errors of runs");
  *best = 0;
  for (i = 1; i < f->n && f->of[i].quality.chi2 < bar && status == LAB_OK && !lab_cpu_is_spent(f->base.until); i++) {
    status = lab_carry_over(&f->of[i], other, error);
    if (status == LAB_OK && lab_carry_is_better(other, present, n)) {
      *best = i;
      memcpy(present, other, (size_t)n * sizeof *present);
    }
  }
  free(present);
  return status;
}

/* Put what was found last to the test.  Out: changed */
static int try_last(lab_candidate *c, field *f, int *changed, lab_error *error)
{
  const lab_found before = c->found[c->n_found - 1];
  int status, best = 0;
  f->of[0] = *c;
  status = line_up(f, error);
  if (status != LAB_OK)
    return status;
  qsort(f->of, (size_t)f->n, sizeof *f->of, lab_candidate_by_bic);
  while (f->n > 1 && !f->of[f->n - 1].quality.fitted)
    f->n--;
  note_alike(f, &before);
  if (lab_carry_is_asked(c) && find_what_carries(f, &best, error))
    return error->status;
  *changed = f->of[best].found[c->n_found - 1].effect != before.effect;
  *c = f->of[best];
  return *changed ? explain(c, error) : LAB_OK;
}

/* Whether an effect can have rivals: a free term is what is left when none has a name for it, and what begins was
 * chosen among all that may begin then. */
static int has_rivals(const lab_candidate *c, const lab_found *found)
{
  return found->effect >= 0 && lab_unknowns_find_onset(&c->u, found->param) < 0;
}

int lab_rivals_try(lab_candidate *c, int *changed, lab_error *error)
{
  field *f = malloc(sizeof *f);
  int k, status = f ? LAB_OK : lab_fail_memory(error, "rivals");
  *changed = 0;
  if (f) {
    f->base = c->u;
    status = lab_unknowns_keep_slopes(&f->base, error);
    if (status == LAB_OK)
      status = lab_unknowns_find_slopes(&f->base, error);
  }
  for (k = c->n_found; status == LAB_OK && k > 0 && !lab_cpu_is_spent(c->u.until); k--) {
    int now = 0;
    put_first_last(c); /* in the end they are in their order again */
    if (has_rivals(c, &c->found[c->n_found - 1]))
      status = try_last(c, f, &now, error);
    *changed |= now;
  }
  if (f)
    lab_unknowns_forget_slopes(&f->base);
  free(f);
  return status == LAB_NUMERIC ? LAB_OK : status;
}
