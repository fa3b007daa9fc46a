#include "sides.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "../base/array.h"
#include "../trace/decide.h"
#include "repeat.h"

/* ---- The unknowns ---- */

int lab_sides_find(const lab_unknowns *u, int param)
{
  int j = u->n;
  while (--j >= 0 && (u->unknown[j].kind != LAB_UNKNOWN_CHANGE || u->unknown[j].index != param))
    ;
  return j;
}

int lab_sides_release(lab_unknowns *u, int first, const lab_score *score, double value, lab_error *error)
{
  int j = score->onset > 0 ? -1 : lab_sides_find(u, score->param);
  if (j < 0 && lab_unknowns_add_change(u, score->param, first, 0, error))
    return error->status;
  if (j < 0)
    j = u->n - 1;
  if (score->onset > 0)
    u->unknown[j].from = u->run[first].log->value[LAB_CHANNEL_TIME][u->run[first].first + score->onset];
  u->unknown[j].spread = 0;
  u->unknown[j].value = fmin(fmax(value, u->unknown[j].lower), u->unknown[j].upper);
  return LAB_OK;
}

static double longest_row(const lab_run *run, int n)
{
  double row = 0;
  int e;
  for (e = 0; e < n; e++) {
    const double *t = run[e].log->value[LAB_CHANNEL_TIME] + run[e].first;
    row = fmax(row, (t[run[e].n - 1] - t[0]) / (double)run[e].n);
  }
  return row;
}

/* What differs from day to day. */
static int add_repeats(lab_sides *c, lab_error *error)
{
  int i;
  for (i = 0; i < lab_repeat_count; i++) {
    const int param = lab_param_index(lab_repeats[i].name);
    const double spread =
        param < 0 ? 0 : sqrt(2) * lab_repeat_spread(&lab_repeats[i], &c->u.rig, c->row); /* two days */
    if (spread > 0 && lab_unknowns_add_change(&c->u, param, c->first, spread, error))
      return error->status;
  }
  return LAB_OK;
}

/* Noise of a channel in n runs, the largest; 0 if none has it. */
static double noise_of(const lab_run *run, int n, int channel)
{
  double sigma = 0;
  int e, k;
  for (e = 0; e < n; e++)
    for (k = 0; k < run[e].n_channels; k++)
      if (run[e].channel[k] == channel)
        sigma = fmax(sigma, run[e].sigma[k]);
  return sigma;
}

/* The set positions of n runs.  Returns: 0 if there are none */
static int set_range(const lab_run *run, int n, double *low, double *high)
{
  size_t i;
  int e;
  *low = HUGE_VAL;
  *high = -HUGE_VAL;
  for (e = 0; e < n; e++)
    for (i = run[e].first; lab_log_command(run[e].log) == LAB_CHANNEL_SP && i < run[e].first + run[e].n; i++) {
      *low = fmin(*low, run[e].log->value[LAB_CHANNEL_SP][i]);
      *high = fmax(*high, run[e].log->value[LAB_CHANNEL_SP][i]);
    }
  return *low <= *high;
}

/* Whether most of the new logs, half by judgement, is at set positions where the baseline has not been. The model,
 * fitted elsewhere, is then off by what the plant's forces do there, which comes and goes with the position. */
static int goes_beyond(const lab_sides *c)
{
  static const double margin = 0.1; /* of the range */
  double low, high, room;
  size_t i, n = 0, beyond = 0;
  int e;
  if (!set_range(c->run, c->first, &low, &high))
    return 0;
  room = margin * (high - low);
  for (e = c->first; e < c->u.n_runs; e++)
    for (i = c->run[e].first; lab_log_command(c->run[e].log) == LAB_CHANNEL_SP && i < c->run[e].first + c->run[e].n;
         i++, n++) {
      const double set = c->run[e].log->value[LAB_CHANNEL_SP][i];
      beyond += set < low - room || set > high + room;
    }
  return 2 * beyond > n;
}

/* What is left of one channel of the baseline counts as noise; where it is not white, with its memory from row to row.
 * A new log, which may stand still, has no less noise than the baseline. */
static void take_as_noise(const lab_unknowns *then, const double *z, int channel, lab_sides *c)
{
  static const double wanders = 0.95; /* memory from row to row of what a model leaves where it was not fitted */
  const double least = noise_of(then->run, then->n_runs, channel);
  const int beyond = goes_beyond(c);
  double sum = 0, sum1 = 0, n = 0, scale, memory;
  size_t i;
  int e, k;
  for (e = 0; e < then->n_runs; e++)
    for (k = 0; k < then->run[e].n_channels; k++, z += then->run[e].n)
      for (i = 0; i < then->run[e].n && then->run[e].channel[k] == channel; i++) {
        n += z[i] != 0;
        sum += z[i] * z[i];
        sum1 += i > 0 ? z[i] * z[i - 1] : 0;
      }
  if (!(sum > 0))
    return;
  scale = sqrt(sum / n);
  memory = fmin(fmax(sum1 / sum, 0), 0.98);
  for (e = 0; e < c->u.n_runs; e++)
    for (k = 0; k < c->run[e].n_channels; k++)
      if (c->run[e].channel[k] == channel) {
        if (e >= c->first)
          c->run[e].sigma[k] = fmax(c->run[e].sigma[k], least);
        c->run[e].sigma[k] *= c->decided ? fmax(scale, 1) : scale;
        if (!c->decided)
          c->run[e].colour[k] = (lab_colour){memory, 1};
        c->white[e].sigma[k] = c->run[e].sigma[k];
        c->white[e].colour[k] = (lab_colour){0, 0};
        if (beyond && c->run[e].colour[k].memory < wanders) { /* white noise is still of size 1 */
          c->run[e].sigma[k] *= sqrt((1 + wanders * wanders) / (1 - wanders * wanders));
          c->run[e].colour[k] = (lab_colour){wanders, 1};
        }
      }
}

static int take_rest_as_noise(const lab_unknowns *then, lab_sides *c, lab_error *error)
{
  double *z = malloc((then->n_rows + 1) * sizeof *z);
  int k, status = z ? lab_unknowns_errors(then, z, error) : lab_fail_memory(error, "residuals");
  for (k = 0; k < LAB_CHANNEL_COUNT && status == LAB_OK; k++)
    take_as_noise(then, z, k, c);
  free(z);
  return status;
}

int lab_sides_settle(lab_unknowns *u, double aim, double *chi2, lab_error *error)
{
  static const double still = 0.5; /* of chi-square */
  enum { FITS = 6 };
  double before, gain = HUGE_VAL;
  int i, status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, chi2, error);
  for (i = 1; i < FITS && status == LAB_OK && gain > still && (FITS - i) * gain > *chi2 - aim; i++) {
    before = *chi2;
    status = lab_unknowns_fit(u, LAB_ROUNDS_ALL, chi2, error);
    gain = before - *chi2;
  }
  return status;
}

int lab_sides_approach(lab_unknowns *u, double *chi2, lab_error *error)
{
  static const double share[] = {0.1, 0.3, 1}; /* of the spreads */
  double spread[LAB_FIT_MAX];
  int i, j, status = LAB_OK;
  for (j = 0; j < u->n; j++)
    spread[j] = u->unknown[j].spread;
  for (i = 0; i < 3 && status == LAB_OK; i++) {
    for (j = 0; j < u->n; j++)
      if (u->unknown[j].kind == LAB_UNKNOWN_CHANGE)
        u->unknown[j].spread = share[i] * spread[j];
    status = i < 2 ? lab_unknowns_fit(u, LAB_ROUNDS_ALL, chi2, error) : lab_sides_settle(u, HUGE_VAL, chi2, error);
  }
  return status;
}

/* Drop the instants of commands. */
static void drop_instants(lab_unknowns *u)
{
  int j, k;
  for (j = k = 0; j < u->n; j++)
    if (u->unknown[j].kind != LAB_UNKNOWN_INSTANT)
      u->unknown[k++] = u->unknown[j];
  u->n = k;
}

/* Follow the baseline to first order from here on: it tells its own values, and what is fitted here are the new logs.
 * Where its model lacks something, or sees it coarsely, it is simulated each time, with what was held on it as it is.
 */
static int follow_to_first_order(lab_sides *c, lab_error *error)
{
  if (!c->decided || c->base.window > 0) {
    lab_unknowns_settle(&c->u, NULL);
    return LAB_OK;
  }
  if (lab_linear_open(&c->base, &c->old, error))
    return error->status;
  c->u.linear = &c->old;
  drop_instants(&c->u);
  return LAB_OK;
}

void lab_sides_whole(const lab_sides *c, const lab_unknowns *u, lab_unknowns *whole)
{
  enum { ROOM = 2 }; /* for an effect and its shape */
  int j;
  *whole = *u;
  whole->linear = NULL;
  for (j = 0; u->linear && j < c->base.n && whole->n + ROOM < LAB_FIT_MAX; j++)
    if (c->base.unknown[j].kind == LAB_UNKNOWN_INSTANT)
      whole->unknown[whole->n++] = c->base.unknown[j];
  lab_unknowns_count(whole);
}

int lab_sides_join(const lab_comparison *of, lab_sides *c, lab_error *error)
{
  const lab_unknowns *then = of->then;
  const int n_now = of->n_now;
  int e;
  if (then->n_runs + n_now > LAB_FIT_MAX)
    return lab_fail(error, LAB_DATA, "more than %d runs to compare", (int)LAB_FIT_MAX);
  memcpy(c->run, then->run, (size_t)then->n_runs * sizeof *c->run);
  memcpy(c->run + then->n_runs, of->now, (size_t)n_now * sizeof *c->run);
  for (e = 0; e < then->n_runs + n_now; e++)
    c->run[e].drift = NULL; /* from one day to the next a sensor is off by what add_repeats allows */
  memcpy(c->white, c->run, sizeof c->white);
  c->u = c->base = *then;
  c->first = then->n_runs;
  c->decided = of->decided;
  c->row = longest_row(c->run, then->n_runs + n_now);
  if (follow_to_first_order(c, error))
    return error->status;
  if (lab_unknowns_join(&c->u, c->run, then->n_runs + n_now, error) || add_repeats(c, error))
    return error->status;
  if (take_rest_as_noise(then, c, error))
    return error->status;
  c->u.m = c->u.n_data + (size_t)c->u.n;
  c->then = c->u;
  return LAB_OK;
}

/* ---- What is left ---- */

/* What is left of runs first .. end - 1, over what counts as noise.  Out: n  of values */
static double left_of(const lab_unknowns *u, const double *r, int first, int end, size_t *n)
{
  double sum = 0;
  int e, k;
  size_t i;
  *n = 0;
  for (e = 0; e < end; e++)
    for (k = 0; k < u->run[e].n_channels; k++)
      for (i = 0; i < u->run[e].n; i++, r++)
        if (e >= first && *r != 0) {
          sum += *r * *r;
          ++*n;
        }
  return *n > 0 ? sqrt(sum / (double)*n) : 0;
}

/* Deviations by which what differs from day to day does so, the largest. */
static double strain_of(const lab_unknowns *u)
{
  double strain = 0;
  int j;
  for (j = 0; j < u->n; j++)
    if (u->unknown[j].kind == LAB_UNKNOWN_CHANGE && u->unknown[j].spread > 0)
      strain = fmax(strain, fabs(u->unknown[j].value) / u->unknown[j].spread);
  return strain;
}

int lab_sides_rest(const lab_unknowns *u, int first, lab_rest *left, lab_error *error)
{
  double *r = malloc((u->m + 1) * sizeof *r);
  const int status = r ? lab_unknowns_residuals((void *)u, NULL, r, error) : lab_fail_memory(error, "residuals");
  if (status == LAB_OK) {
    left->then = left_of(u, r, 0, first, &left->n);
    left->now = left_of(u, r, first, u->n_runs, &left->n);
    left->chi2 = lab_dot(r, r, u->m);
    left->strain = strain_of(u);
  }
  free(r);
  return status;
}

int lab_sides_rest_of_all(const lab_sides *c, const lab_unknowns *u, const lab_run *run, lab_rest *left,
                          lab_error *error)
{
  lab_unknowns *all = malloc(sizeof *all);
  int status = all ? LAB_OK : lab_fail_memory(error, "a model of both sides");
  if (status == LAB_OK) {
    lab_sides_whole(c, u, all);
    all->run = run;
    status = lab_sides_rest(all, c->first, left, error);
  }
  free(all);
  return status;
}

int lab_rest_is_doubtful(const lab_rest *left)
{
  return left->now > sqrt(lab_constant(LAB_NOISE_DOUBTFUL)) * fmax(left->then, 1);
}

int lab_rest_spoils_baseline(const lab_rest *left)
{
  return left->then > sqrt(lab_constant(LAB_NOISE_DOUBTFUL));
}

int lab_rest_is_strained(const lab_rest *left)
{
  static const double most = 4; /* deviations, by judgement */
  return left->strain > most;
}

int lab_rest_is_as_before(const lab_rest *left)
{
  const double deviations = lab_constant(LAB_NOISE_DEVIATIONS) * sqrt(2 / (double)left->n),
               before = fmax(left->then, 1);
  return left->now * left->now <= before * before * (1 + deviations) && !lab_rest_is_strained(left);
}

int lab_rest_is_more_than_noise(const lab_rest *left)
{
  const double deviations = lab_constant(LAB_NOISE_DEVIATIONS) * sqrt(2 / (double)left->n);
  return left->now * left->now > fmax(1 + deviations, lab_constant(LAB_NOISE_SLIP));
}
