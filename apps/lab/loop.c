#include "loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double alike_cosine = 0.95; /* directions nearer than this are alike */
static const double alike_chi2 = 6.0;    /* and refits that differ by less, about 95 % for two parameters */

void lab_loop_options_default(lab_loop_options *options)
{
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
  double *r = malloc((u->n_data + LAB_FIT_MAX) * sizeof *r);
  int c, status;
  clear_errors(errors);
  if (!r)
    return lab_fail_memory(error, "residuals");
  status = lab_unknowns_residuals((void *)u, NULL, r, error);
  for (c = 0; status == LAB_OK && c < LAB_CHANNEL_COUNT; c++)
    channel_error(u, r, c, errors);
  free(r);
  return status;
}

/* ---- Refits ---- */

/* The model with one candidate taken up and everything fitted again. */
typedef struct refit {
  lab_unknowns u;
  lab_fit_result fit;
  int candidate, tried;
} refit;

/* Take up a candidate at a size and fit, from where the unknowns are. */
static int fit_with(const lab_unknowns *u, const lab_candidate *c, double size, refit *r, lab_error *error)
{
  pneu_param_info info;
  r->u = *u;
  pneu_param_describe(c->param, &info);
  if (lab_unknowns_add(&r->u, c->param, (double)info.neutral + size, error))
    return error->status;
  if (c->shape >= 0 && lab_unknowns_add(&r->u, c->shape, c->shape_value, error))
    return error->status;
  return lab_unknowns_fit(&r->u, &r->fit, error);
}

/* Two starts, the better one counts: from the present fit, which may have bent its parameters to stand in for the
 * effect, and from before any fit with the effect at its usual size. */
static int refit_candidate(const lab_unknowns *u, const lab_candidate *c, refit *r, lab_error *error)
{
  refit *fresh = malloc(sizeof *fresh);
  pneu_param_info info;
  double usual;
  int j, first, second;
  if (!fresh)
    return lab_fail_memory(error, "a refit");
  pneu_param_describe(c->param, &info);
  usual = (double)(info.value - info.neutral);
  first = fit_with(u, c, c->size != 0 ? c->size : 0.02 * usual, r, error);
  fresh->u = *u;
  for (j = 0; j < u->n; j++)
    fresh->u.unknown[j].value = u->unknown[j].first;
  second = fit_with(&fresh->u, c, c->size * usual < 0 ? -usual : usual, fresh, error);
  if (second == LAB_OK && (first != LAB_OK || fresh->fit.chi2 < r->fit.chi2)) {
    r->u = fresh->u;
    r->fit = fresh->fit;
    first = LAB_OK;
  }
  free(fresh);
  return first;
}

/* Schwarz 1978: what a fit costs, its parameters counted. */
static double bic(const refit *r)
{
  return r->fit.chi2 + (double)r->u.n * log((double)r->u.n_data);
}

/* The candidates worth a refit: those that pass, one for each effect, down to a tenth of the best statistic. A slope
 * ranks large effects poorly, so that more than the first few get their chance. */
static int choose_leaders(const lab_trace_result *trace, double level, refit *leader)
{
  int i, k, n = 0;
  for (i = 0; i < trace->n && n < LAB_LOOP_LEADERS; i++) {
    const lab_candidate *c = &trace->candidate[i];
    int seen = 0;
    if (!(c->p_value < level) || c->statistic < 0.1 * trace->candidate[0].statistic)
      break;
    for (k = 0; k < n; k++)
      seen |= trace->candidate[leader[k].candidate].effect == c->effect;
    if (!seen)
      leader[n++].candidate = i;
  }
  return n;
}

/* Refit the leaders, in parallel; the best of them first.  Returns: their number. */
static int refit_leaders(const lab_unknowns *u, const lab_trace_result *trace, double level, refit *leader)
{
  int i, k = 0, best = 0;
  const int n = choose_leaders(trace, level, leader);
#pragma omp parallel for schedule(dynamic)
  for (i = 0; i < n; i++) {
    lab_error ignored;
    leader[i].tried = refit_candidate(u, &trace->candidate[leader[i].candidate], &leader[i], &ignored) == LAB_OK;
  }
  for (i = 0; i < n; i++)
    if (leader[i].tried) {
      if (i != k)
        leader[k] = leader[i];
      if (bic(&leader[k]) < bic(&leader[best]))
        best = k;
      k++;
    }
  if (best != 0) {
    const refit keep = leader[0];
    leader[0] = leader[best];
    leader[best] = keep;
  }
  return k;
}

/* Candidates whose direction and refit are as good as the winner's. */
static void note_alike(const lab_trace_result *trace, const refit *leader, int n, lab_found *found)
{
  int i;
  for (i = 1; i < n; i++) {
    const lab_candidate *c = &trace->candidate[leader[i].candidate];
    const double likeness = lab_trace_likeness(trace, leader[0].u.n_data, leader[0].candidate, leader[i].candidate);
    if (c->effect != found->effect && likeness > alike_cosine && bic(&leader[i]) - bic(&leader[0]) < alike_chi2)
      found->alike[found->n_alike++] = c->effect;
  }
}

static void note_found(const lab_trace_result *trace, const refit *leader, int n, double chi2_before, double chi2_after,
                       lab_found *found)
{
  const lab_candidate *c = &trace->candidate[leader[0].candidate];
  memset(found, 0, sizeof *found);
  found->effect = c->effect;
  found->param = c->param;
  found->shape = c->shape;
  found->statistic = c->statistic;
  found->p_value = c->p_value;
  found->explained = (chi2_before - chi2_after) / fmax(chi2_before - (double)leader[0].u.n_data, 1);
  found->chi2_before = chi2_before;
  found->chi2_after = chi2_after;
  note_alike(trace, leader, n, found);
}

/* Trace the residual of the present model and add the best effect.  Out: added, 0 when nothing passes. */
static int add_one(lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, int *added,
                   lab_error *error)
{
  lab_trace_result trace;
  refit *leader = malloc(LAB_LOOP_LEADERS * sizeof *leader);
  lab_errors before, after;
  int n, status;
  *added = 0;
  if (!leader)
    return lab_fail_memory(error, "refits");
  status = lab_trace_effects(u, &trace, error);
  if (status == LAB_OK)
    status = lab_loop_errors(u, &before, error);
  if (status == LAB_OK) {
    result->level = options->alpha / (trace.tests > 0 ? trace.tests : 1);
    n = refit_leaders(u, &trace, result->level, leader);
    if (n > 0 && lab_loop_errors(&leader[0].u, &after, error) == LAB_OK) {
      if (sqrt(after.chi2 / before.chi2) < 1 - options->min_gain) {
        note_found(&trace, leader, n, before.chi2, after.chi2, &result->found[result->n_found++]);
        *u = leader[0].u;
        result->fit = leader[0].fit;
        *added = 1;
      } else {
        result->listed[result->n_listed++] = trace.candidate[leader[0].candidate].effect;
      }
    }
  }
  free(leader);
  if (result->trace.n == 0)
    result->trace = trace;
  else
    lab_trace_close(&trace);
  return status;
}

/* Without one of the found effects, refitted: does its absence cost more than it saves in parameters? */
static int is_needed(const lab_unknowns *u, const lab_loop_result *result, int which, lab_unknowns *without,
                     lab_fit_result *fit)
{
  const lab_found *found = &result->found[which];
  const int fewer = found->shape >= 0 ? 2 : 1;
  lab_error ignored;
  *without = *u;
  if (found->shape >= 0)
    lab_unknowns_drop(without, found->shape);
  lab_unknowns_drop(without, found->param);
  if (lab_unknowns_fit(without, fit, &ignored))
    return 1;
  return fit->chi2 - result->fit.chi2 > fewer * log((double)u->n_data);
}

/* Try the model without each effect that was added before the last. */
static void remove_needless(lab_unknowns *u, lab_loop_result *result)
{
  lab_unknowns *without = malloc(sizeof *without);
  lab_fit_result *fit = malloc(sizeof *fit);
  int i, k;
  for (i = 0; without && fit && result->n_found > 1 && i < result->n_found - 1; i++) {
    if (is_needed(u, result, i, without, fit))
      continue;
    *u = *without;
    result->fit = *fit;
    for (k = i; k + 1 < result->n_found; k++)
      result->found[k] = result->found[k + 1];
    result->n_found--;
    i--;
  }
  free(without);
  free(fit);
}

/* What is left is noise: chi-square within six standard deviations of its expectation, or the error within a twentieth
 * of the noise, as far as a declared noise can be trusted. */
static int is_noise(const lab_errors *errors)
{
  const double n = (double)errors->n;
  return errors->chi2 < n + 6 * sqrt(2 * n) || errors->chi2 < 1.1025 * n;
}

int lab_loop_run(lab_unknowns *u, const lab_loop_options *options, lab_loop_result *result, lab_error *error)
{
  const lab_fit_result fit = result->fit;
  int added = 1;
  memset(result, 0, sizeof *result);
  result->fit = fit;
  if (lab_loop_errors(u, &result->before, error))
    return error->status;
  while (added && result->n_found < options->max_effects) {
    if (add_one(u, options, result, &added, error))
      return error->status;
    remove_needless(u, result);
  }
  if (lab_loop_errors(u, &result->after, error))
    return error->status;
  result->verdict = !is_noise(&result->after) ? LAB_VERDICT_UNDECIDED
                    : result->n_found > 0     ? LAB_VERDICT_EFFECT
                                              : LAB_VERDICT_NONE;
  return LAB_OK;
}

void lab_loop_close(lab_loop_result *result)
{
  lab_trace_close(&result->trace);
}
