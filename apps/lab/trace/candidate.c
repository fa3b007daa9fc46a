#include "candidate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../base/clock.h"
#include "../base/quantile.h"
#include "../fit/beginning.h"
#include "../fit/nuisance.h"
#include "../rig/tolerance.h"

/* ---- Fits ---- */

/* Schwarz 1978: what a fit costs, with what it fits counted, and what has no name against what has. A declared value
 * that is held costs what its prior adds to chi-square. */
static double bic(const lab_unknowns *u, double chi2)
{
  int j, n = 0;
  for (j = 0; j < u->n; j++)
    n += !lab_unknown_is_known(&u->unknown[j]) && !lab_unknown_rests(&u->unknown[j]);
  n += u->rig.n_onsets; /* each has its time beside its value */
  return chi2 + n * log((double)u->n_values) + lab_constant(LAB_TERM_BIC) * u->rig.n_terms;
}

int lab_candidate_fit(lab_candidate *c, int steps, lab_error *error)
{
  lab_quality *q = &c->quality;
  lab_residual_stats left[LAB_CHANNEL_COUNT];
  int status = lab_unknowns_fit(&c->u, steps, &q->chi2, error);
  if (status == LAB_DATA) /* with its values a run begins in no state of the rig: no fault of the data */
    status = error->status = LAB_NUMERIC;
  q->values = (double)c->u.n_values;
  q->bic = bic(&c->u, q->chi2);
  q->white = q->of_sensors = q->whole = 0;
  q->fitted = status == LAB_OK;
  if (q->fitted && c->u.window == 0 && !lab_is_noise(q) && q->chi2 < lab_constant(LAB_NOISE_DOUBTFUL) * q->values) {
    status = lab_unknowns_residual_stats(&c->u, left, error);
    q->fitted = status == LAB_OK;
    q->white = q->fitted && lab_residual_stats_noise(left);
    q->of_sensors = q->fitted && lab_residual_stats_of_sensors(left);
  }
  if (q->fitted) {
    status = lab_nuisance_strain(&c->u, &q->strain, error);
    q->fitted = status == LAB_OK;
  }
  return status;
}

int lab_any(const lab_candidate *c, int n, int (*is)(const lab_quality *q))
{
  int i, any = 0;
  for (i = 0; i < n; i++)
    any |= is(&c[i].quality);
  return any;
}

double lab_least_chi2(const lab_candidate *c, int n)
{
  double least = INFINITY;
  int i;
  for (i = 0; i < n; i++)
    if (c[i].quality.fitted)
      least = fmin(least, c[i].quality.chi2);
  return least;
}

int lab_candidate_by_bic(const void *x, const void *y)
{
  const lab_quality *a = &((const lab_candidate *)x)->quality, *b = &((const lab_candidate *)y)->quality;
  if (a->fitted != b->fitted)
    return b->fitted - a->fitted;
  return a->bic < b->bic ? -1 : a->bic > b->bic;
}

int lab_candidate_fit_held(lab_candidate *c, lab_error *error)
{
  double before;
  int status = lab_unknowns_weigh_held(&c->u, error);
  c->quality.fitted = 0;
  if (status == LAB_OK)
    status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  before = c->u.misfit;
  if (status == LAB_OK)
    status = lab_unknowns_weigh_held(&c->u, error);
  if (status == LAB_OK && lab_misfit_has_fallen(before, c->u.misfit))
    status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

int lab_candidate_fit_beginning(lab_candidate *c, size_t n, int steps, lab_error *error)
{
  const lab_run *whole = c->u.run;
  lab_run part = {0};
  int status = lab_beginning_open(whole, n, &part, error);
  if (status == LAB_OK) {
    c->u.run = &part;
    lab_unknowns_view(&c->u, 0);
    status = steps == LAB_ROUNDS_ALL ? lab_candidate_fit_held(c, error) : lab_candidate_fit(c, steps, error);
  }
  lab_beginning_close(&part);
  c->u.run = whole;
  lab_unknowns_view(&c->u, 0);
  return status == LAB_WORLD ? status : LAB_OK;
}

/* What the prior of something that is held adds to chi-square. */
static double cost_of_prior(const lab_unknowns *u, const lab_unknown *x)
{
  return pow((x->value - x->prior) / lab_unknown_reach(u, x), 2);
}

static int is_value_held(const lab_unknown *x)
{
  return x->kind == LAB_UNKNOWN_PARAM && x->index < PNEU_PARAM_BASE_COUNT && lab_unknown_is_held(x);
}

/* Let go the one value that takes most off BIC.  Out: any  whether one does */
static int let_one_go(lab_candidate *c, int *any, lab_error *error)
{
  const double price = log((double)c->u.n_values);
  lab_candidate *best = malloc(2 * sizeof *best), *trial = best + 1;
  int j, status = LAB_OK;
  if (!best)
    return lab_fail_memory(error, "a candidate");
  *best = *c;
  for (j = 0; j < c->u.n && status != LAB_WORLD && !lab_cpu_is_spent(c->u.until); j++) {
    if (!is_value_held(&c->u.unknown[j]) || !(cost_of_prior(&c->u, &c->u.unknown[j]) > price))
      continue;
    *trial = *c;
    lab_unknowns_let_go(&trial->u, j);
    status = lab_candidate_fit(trial, LAB_ROUNDS_ALL, error);
    if (status == LAB_OK && lab_candidate_by_bic(trial, best) < 0)
      *best = *trial;
  }
  *any = best->quality.bic < c->quality.bic;
  *c = *best;
  free(best);
  return status == LAB_WORLD ? status : LAB_OK;
}

int lab_candidate_let_go(lab_candidate *c, lab_error *error)
{
  int any = !lab_is_plainly_off(&c->quality), status = LAB_OK;
  while (any && status == LAB_OK)
    status = let_one_go(c, &any, error);
  return status;
}

int lab_candidate_hold(lab_candidate *c, lab_error *error)
{
  return lab_unknowns_hold(&c->u, error) ? error->status : lab_candidate_fit_held(c, error);
}

/* The parameters of what was found.  Out: count  0 of what is no effect */
static int params_of(const lab_found *found, int *count)
{
  *count = 0;
  return found->effect < 0 ? 0 : pneu_effect_params(found->effect, count);
}

/* The candidate with one form more of its last effect, or all of them, fitted.  In: option  which of its parameters;
 * -1: all.  Returns: whether it has a form that it had not */
static int add_options(lab_candidate *c, int option, lab_error *error)
{
  int i, count, any = 0;
  const int first = params_of(&c->found[c->n_found - 1], &count);
  c->u.slopes = NULL; /* those are of fewer unknowns */
  for (i = first; i < first + count; i++)
    if ((option < 0 || i == option) && lab_param_info(i).shape == PNEU_FORM_OPTION && lab_unknowns_find(&c->u, i) < 0 &&
        !lab_unknowns_add(&c->u, i, (double)lab_param_info(i).value, error))
      any++;
  lab_unknowns_take(&c->u);
  if (any > (option < 0)) /* all of one are that one */
    return lab_candidate_fit(c, LAB_ROUNDS_ALL, error) != LAB_WORLD;
  return 0;
}

int lab_candidate_try_options(lab_candidate *c, lab_error *error)
{
  lab_candidate *with, *best;
  int i, count;
  const int first = params_of(&c->found[c->n_found - 1], &count);
  error->status = LAB_OK;
  if (!c->quality.fitted || lab_is_noise(&c->quality) || lab_cpu_is_spent(c->u.until))
    return LAB_OK;
  with = malloc(2 * sizeof *with);
  if (!with)
    return lab_fail_memory(error, "a candidate");
  best = &with[1];
  *best = *c;
  for (i = first - 1; i < first + count && error->status != LAB_WORLD; i++) {
    *with = *c;
    if (add_options(with, i < first ? -1 : i, error) && lab_candidate_by_bic(with, best) < 0)
      *best = *with;
  }
  if (best->u.n > c->u.n) {
    lab_unknowns_forget_slopes(&c->u);
    *c = *best;
  }
  free(with);
  return error->status == LAB_WORLD ? LAB_WORLD : LAB_OK;
}

int lab_candidate_stage(const lab_candidate *c, const lab_unknowns *declared, lab_candidate *staged, lab_error *error)
{
  int i, k, count;
  *staged = *c;
  staged->u = *declared;
  staged->u.until = c->u.until;
  staged->quality.fitted = 0;
  for (i = 0; i < c->n_found; i++) {
    const int first = params_of(&c->found[i], &count);
    for (k = first; k < first + count; k++) {
      const int j = k == c->found[i].param || lab_param_info(k).shape ? lab_unknowns_find(&c->u, k) : -1;
      if (j >= 0 && lab_unknowns_add(&staged->u, k, c->u.unknown[j].value, error))
        return error->status;
    }
  }
  lab_unknowns_take(&staged->u);
  if (lab_candidate_fit(staged, LAB_ROUNDS_ALL, error))
    return error->status;
  return lab_candidate_hold(staged, error);
}

void lab_candidate_explain(lab_candidate *c, double chi2_before)
{
  lab_found *found = &c->found[c->n_found - 1];
  found->explained = (chi2_before - c->quality.chi2) / fmax(chi2_before - c->quality.values, 1);
}

void lab_candidate_name(const lab_candidate *c, char *text, size_t size)
{
  size_t used = 0;
  int i;
  snprintf(text, size, "declared model");
  for (i = 0; i < c->n_found && used < size; i++)
    used += (size_t)snprintf(text + used, size - used, "%s%s", i ? " + " : "",
                             c->found[i].effect < 0 ? "unlisted" : pneu_effect_at(c->found[i].effect)->name);
  for (i = 0; i < c->u.n && used < size; i++)
    if (c->u.unknown[i].kind == LAB_UNKNOWN_ONSET)
      used += (size_t)snprintf(text + used, size - used, "%s%s", used ? " + " : "", c->u.unknown[i].name);
  for (i = 0; i < c->u.n && used < size; i++)
    if (lab_unknown_is_absent(&c->u.unknown[i]))
      used += (size_t)snprintf(text + used, size - used, " less %s", c->u.unknown[i].name);
}

int lab_found_is_of_sensor(const lab_found *found)
{
  return found->effect >= 0 && lab_param_is_of_sensor(found->param);
}

int lab_candidate_has_cause(const lab_candidate *c)
{
  int i, any = 0;
  for (i = 0; i < c->n_found; i++)
    any |= c->found[i].effect >= 0 && !lab_found_is_of_sensor(&c->found[i]);
  return any;
}

/* Another spring has another preload as well, orifices of another make differ alike. */
static int cause_of(int param)
{
  return param == PNEU_PARAM_spring_preload ? PNEU_PARAM_spring_rate
         : param == PNEU_PARAM_vent_area    ? PNEU_PARAM_fill_area
                                            : param;
}

int lab_candidate_is_far(const lab_unknowns *u)
{
  unsigned char off[LAB_PARAM_COUNT] = {0};
  int j, n = 0, known = 0;
  for (j = 0; j < u->n; j++)
    if (lab_unknown_is_far(u, j, lab_constant(LAB_STRAINED))) {
      const lab_unknown *x = &u->unknown[j];
      n += !off[cause_of(x->index)];
      off[cause_of(x->index)] = 1;
      known |= lab_unknown_is_held(x) || lab_unknown_is_let_go(x);
    }
  return n > lab_count(LAB_FAR_VALUES) && known;
}

int lab_candidate_begins(const lab_candidate *c)
{
  const int n = c->u.rig.n_onsets;
  return n > 0 && c->begin[n - 1].known;
}

int lab_candidate_place_again(lab_candidate *c, lab_error *error)
{
  const int k = c->u.rig.n_onsets - 1;
  int j, status;
  if (!lab_candidate_begins(c))
    return LAB_OK;
  j = lab_unknowns_find_onset(&c->u, c->u.rig.onset[k].param);
  status = lab_onset_settle(&c->u, j, !lab_is_noise(&c->quality), &c->quality.chi2, &c->begin[k], error);
  if (status == LAB_OK)
    status = lab_candidate_fit(c, LAB_ROUNDS_ALL, error);
  return status == LAB_NUMERIC ? LAB_OK : status;
}

/* Whether an unknown is held that has the name of an effect: an instrument's, or the vent's share. */
static int is_effect_held(const lab_unknown *x)
{
  return x->kind == LAB_UNKNOWN_PARAM && lab_unknown_is_held(x) &&
         (lab_param_is_of_sensor(x->index) || lab_param_is_vents_share(x->index));
}

int lab_candidate_take_instruments(lab_candidate *c, int *any, lab_error *error)
{
  const double excess = c->quality.chi2 - c->quality.values;
  int j, status = LAB_OK;
  *any = 0;
  for (j = 0; j < c->u.n && c->n_found < LAB_EFFECTS_MAX && status == LAB_OK; j++) {
    const lab_unknown x = c->u.unknown[j];
    const double cost = is_effect_held(&x) ? cost_of_prior(&c->u, &x) : 0;
    lab_found *found;
    if (!(cost - log((double)c->u.n_values) > lab_constant(LAB_ALIKE_BIC)))
      continue;
    status = lab_unknowns_add(&c->u, x.index, x.value, error);
    found = lab_candidate_add_found(c);
    found->effect = pneu_effect_of(x.index);
    found->param = x.index;
    found->statistic = cost;
    found->p_value = lab_chi2_tail(found->statistic, 1);
    found->explained = found->statistic / fmax(found->statistic, excess);
    *any = 1;
  }
  return *any && status == LAB_OK ? lab_candidate_fit(c, LAB_ROUNDS_ALL, error) : status;
}

int lab_candidate_drop_needless(lab_candidate *c, int n, lab_error *error)
{
  lab_candidate *without = malloc(sizeof *without);
  int i, status = without ? LAB_OK : lab_fail_memory(error, "a candidate");
  for (i = 0; status == LAB_OK && c->n_found > 1 && i < n; i++) {
    if (c->found[i].term >= 0)
      continue;
    status = lab_candidate_leave_out(c, i, without, error);
    if (status == LAB_OK && without->quality.fitted && without->quality.bic <= c->quality.bic) {
      *c = *without;
      i = -1;
      n--;
    }
  }
  free(without);
  return status;
}

int lab_candidate_is_white(const lab_candidate *c, int *white, lab_error *error)
{
  lab_residual_stats left[LAB_CHANNEL_COUNT];
  *white = 0;
  if (c->u.window > 0)
    return LAB_OK;
  if (lab_unknowns_residual_stats(&c->u, left, error))
    return error->status;
  *white = lab_residual_stats_white(left);
  return LAB_OK;
}

/* ---- What was found ---- */

lab_found *lab_candidate_add_found(lab_candidate *c)
{
  lab_found *found = &c->found[c->n_found++];
  memset(found, 0, sizeof *found);
  found->effect = found->term = -1;
  found->degrees = 1;
  return found;
}

int lab_candidate_add_effect(lab_candidate *c, const lab_score *score, double size, lab_error *error)
{
  const pneu_param_info info = lab_param_info(score->param);
  lab_found *found;
  if (lab_unknowns_add(&c->u, score->param, (double)info.neutral + size, error) ||
      (score->shape >= 0 && lab_unknowns_add(&c->u, score->shape, score->shape_value, error)))
    return error->status;
  lab_unknowns_take(&c->u);
  found = lab_candidate_add_found(c);
  found->effect = score->effect;
  found->param = score->param;
  found->statistic = score->statistic;
  found->p_value = score->p_value;
  return LAB_OK;
}

int lab_candidate_is_alike_but(const lab_candidate *a, int which_a, const lab_candidate *b, int which_b)
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

void lab_candidate_note_alike(lab_candidate *c, int which, const lab_candidate *pool, int n)
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
    if (known || !is_as_good(&c->quality, &pool[i].quality) || !lab_candidate_is_alike_but(c, which, &pool[i], last))
      continue;
    if (found->n_alike < LAB_LEADERS_MAX) {
      lab_rig_at(&pool[i].u.rig, HUGE_VAL, &end);
      found->alike_params[found->n_alike] = end.params;
    }
    found->alike[found->n_alike++] = effect;
  }
}

static void drop_effect(lab_candidate *c, const lab_found *found)
{
  int i, count;
  const int first = params_of(found, &count);
  if (lab_unknowns_find_onset(&c->u, found->param) >= 0)
    lab_unknowns_drop_onset(&c->u);
  for (i = first; i < first + count; i++)
    if (lab_param_info(i).shape && lab_unknowns_find(&c->u, i) >= 0)
      lab_unknowns_drop(&c->u, i);
  lab_unknowns_drop(&c->u, found->param);
}

void lab_candidate_drop(lab_candidate *c, int which)
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

void lab_candidate_drop_neutral(lab_candidate *c)
{
  int i = c->n_found;
  lab_rig last;
  lab_rig_at(&c->u.rig, HUGE_VAL, &last);
  while (i-- > 0) {
    const int param = c->found[i].param;
    if (c->found[i].effect >= 0 && *pneu_param_at(&last.params, param) == lab_param_info(param).neutral)
      lab_candidate_drop(c, i);
  }
}

int lab_candidate_leave_out(const lab_candidate *c, int which, lab_candidate *without, lab_error *error)
{
  *without = *c;
  lab_candidate_drop(without, which);
  return lab_candidate_fit(without, LAB_ROUNDS_ALL, error) == LAB_WORLD ? LAB_WORLD : LAB_OK;
}
