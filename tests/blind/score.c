#include "score.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../apps/lab/base/text.h"

/* ---- Right or not ---- */

enum level { NAME, STATED, FAMILY };

static int is_among(const blind_word *word, int n, const char *name)
{
  int i;
  for (i = 0; i < n; i++)
    if (blind_is(word[i], name))
      return 1;
  return 0;
}

/* Whether a finding stands for an effect; each level takes what the one before it takes. */
static int stands_for(const blind_found *f, const blind_effect *e, enum level level)
{
  const blind_effect *other = blind_effect_named(f->effect);
  if (blind_is(f->effect, e->name))
    return 1;
  if (level >= STATED && is_among(f->alike, f->n_alike, e->name))
    return 1;
  return level == FAMILY && other && blind_is(other->family, e->family);
}

int blind_stands_for(const blind_found *found, const blind_effect *effect)
{
  return stands_for(found, effect, STATED);
}

/* Whether an effect is listed as significant but too small to be added. */
static int is_listed(const blind_answer *a, const char *name)
{
  return is_among(a->small, a->n_small, name);
}

/* Every finding stands for one of the missing effects, and every missing effect has its own, or is at least listed. */
static int names_right(const blind_trial *t, const blind_answer *a, enum level level)
{
  int turn, i, k;
  if (!blind_is(a->verdict, a->n_found ? "effect" : "none") || a->n_found > t->n_missing)
    return 0;
  for (turn = 0; turn < t->n_missing; turn++) {
    int right = 1, n = 0;
    for (i = 0; i < t->n_missing; i++) {
      const blind_effect *missing = t->missing[(i + turn) % t->n_missing].effect;
      for (k = 0; k < a->n_found && !stands_for(&a->found[k], missing, level); k++)
        ;
      n += k < a->n_found;
      right &= k < a->n_found || (level >= STATED && is_listed(a, missing->name));
    }
    if (right && n >= a->n_found)
      return 1;
  }
  return 0;
}

static int any_listed(const blind_trial *t, const blind_answer *a)
{
  int i, any = 0;
  for (i = 0; i < t->n_missing; i++)
    any |= is_listed(a, t->missing[i].effect->name);
  return any;
}

static int equation_right(const blind_trial *t, const blind_answer *a)
{
  return blind_is(a->verdict, "unlisted") && a->n_unlisted > 0 &&
         blind_is(a->unlisted[0], t->missing[0].effect->equation);
}

int blind_is_small(const blind_answer *a, const blind_effect *e)
{
  blind_word word;
  snprintf(word, sizeof word, "unlisted:%s", e->equation);
  return is_listed(a, blind_is_listed(e) ? e->name : word);
}

/* Whether something without a name, in the right equation, is listed as significant but too small to be added. */
static int equation_listed(const blind_trial *t, const blind_answer *a)
{
  return blind_is(a->verdict, "none") && blind_is_small(a, t->missing[0].effect);
}

static int right(const blind_trial *t, const blind_answer *a, enum level level)
{
  if (t->kind == BLIND_NOTHING)
    return blind_is(a->verdict, "none");
  if (t->kind == BLIND_UNLISTED)
    return equation_right(t, a) || (level >= STATED && equation_listed(t, a));
  return names_right(t, a, level);
}

/* ---- Texts ---- */

#define append(text, ...) lab_append(text, BLIND_TEXT, __VA_ARGS__)

static void join(const blind_word *word, int n, char *text)
{
  int i;
  *text = '\0';
  for (i = 0; i < n; i++)
    append(text, "%s%s", i ? "+" : "", word[i]);
}

static void note_answer(const blind_answer *a, blind_record *r)
{
  char equation[BLIND_TEXT] = "";
  int i, k;
  snprintf(r->verdict, sizeof r->verdict, "%s", a->verdict);
  for (i = 0; i < a->n_found; i++) {
    append(r->found, "%s%s", i ? "+" : "", a->found[i].effect);
    append(equation, "%s%s", *equation ? "+" : "", a->found[i].equation);
    append(r->alike, "%s", i ? "+" : "");
    for (k = 0; k < a->found[i].n_alike; k++)
      append(r->alike, "%s%s", k ? "/" : "", a->found[i].alike[k]);
  }
  for (i = 0; i < a->n_unlisted; i++)
    append(equation, "%s%s", *equation ? "+" : "", a->unlisted[i]);
  snprintf(r->equation, sizeof r->equation, "%.60s", equation);
  join(a->small, a->n_small, r->small);
  r->before = a->before;
  r->after = a->after;
  r->holdout_before = a->holdout_before;
  r->holdout_after = a->holdout_after;
}

static void note_question(const blind_trial *t, const double *limit, blind_record *r)
{
  int i;
  r->trial = t->number;
  snprintf(r->kind, sizeof r->kind, "%s", blind_kind_text(t->kind));
  snprintf(r->channels, sizeof r->channels, "%s", blind_channels_text(t->channels));
  snprintf(r->actuator, sizeof r->actuator, "%s", t->actuator);
  snprintf(r->gas, sizeof r->gas, "%s", blind_gas_text(t->declared.gas));
  snprintf(r->flow, sizeof r->flow, "%s", blind_flow_text(t->declared.flow));
  r->pressure_noise = t->declared.pressure_noise;
  r->position_noise = t->declared.position_noise;
  r->ratio = r->size[0] = r->size[1] = r->limit[0] = r->limit[1] = NAN;
  for (i = 0; i < t->n_missing; i++) {
    snprintf(r->effect[i], sizeof r->effect[i], "%s", t->missing[i].effect->name);
    snprintf(r->unit[i], sizeof r->unit[i], "%s", t->missing[i].effect->unit);
    r->size[i] = t->missing[i].size;
    r->limit[i] = limit[i];
    r->ratio = fmin(isnan(r->ratio) ? HUGE_VAL : r->ratio, fabs(r->size[i]) / limit[i]);
  }
}

/* Rank of the first missing effect among the effects of the first scan, each at its best. */
static void note_own(const blind_trial *t, const blind_answer *a, blind_record *r)
{
  int i, k, rank = 0;
  r->own_statistic = NAN;
  for (i = 0; t->n_missing && i < a->n_candidates; i++) {
    int seen = 0;
    for (k = 0; k < i; k++)
      seen |= blind_is(a->candidate[k], a->candidate[i]);
    rank += !seen;
    if (!blind_is(a->candidate[i], t->missing[0].effect->name))
      continue;
    r->own_statistic = a->statistic[i];
    r->own_rank = rank;
    return;
  }
}

/* ---- Why not ---- */

static int has_found(const blind_answer *a, const char *name)
{
  int i;
  for (i = 0; i < a->n_found; i++)
    if (blind_is(a->found[i].effect, name))
      return 1;
  return 0;
}

/* How many of the missing effects are among the findings by name. */
static int hits(const blind_trial *t, const blind_answer *a)
{
  int i, n = 0;
  for (i = 0; i < t->n_missing; i++)
    n += has_found(a, t->missing[i].effect->name);
  return n;
}

static void why_not_named(const blind_trial *t, const blind_answer *a, const blind_record *r, char *why)
{
  const char *own = t->missing[0].effect->name;
  const double as_good = 1.05, passing = 25;
  if (is_listed(a, own))
    append(why, "listed as significant but too small; the rest of the answer is not right");
  else if (hits(t, a) == t->n_missing && a->n_found > t->n_missing)
    append(why, "right and another one besides");
  else if (hits(t, a) > 0 && hits(t, a) < t->n_missing)
    append(why, "one of the two");
  else if (hits(t, a) == t->n_missing)
    append(why, "right name but %.3g times the noise is left", a->after);
  else if (t->kind != BLIND_UNLISTED && r->own_rank == 0)
    append(why, "was no candidate");
  else if (t->kind != BLIND_UNLISTED && r->own_statistic < passing)
    append(why, "statistic %.3g at the first scan", r->own_statistic);
  else if (a->n_found > 0 && a->after < as_good)
    append(why, "what was found explains the log as well");
  else if (t->kind != BLIND_UNLISTED && r->own_rank > 1)
    append(why, "no. %d of the first scan; best was %s", r->own_rank, a->candidate[0]);
  else if (a->n_found > 0)
    append(why, "another refit was better though %.3g times the noise is left", a->after);
  else
    append(why, "not explained");
}

static void explain(const blind_trial *t, const blind_answer *a, blind_record *r)
{
  if (r->name)
    return;
  if (*a->words || blind_is(a->verdict, "timeout") || blind_is(a->verdict, "failed")) {
    append(r->why, "%s", *a->words ? a->words : "no answer in the time allowed");
    return;
  }
  if (t->kind == BLIND_NOTHING) {
    append(r->why, "false alarm; error %.4g to %.4g of the noise", a->before, a->after);
    return;
  }
  if (r->ratio < 2)
    append(r->why, "below %sthe information limit; ", r->ratio < 1 ? "" : "twice ");
  if (blind_is(a->verdict, "unlisted") && t->kind == BLIND_UNLISTED)
    append(r->why, "wrong equation");
  else if (r->stated && (t->kind == BLIND_UNLISTED || any_listed(t, a)))
    append(r->why, "listed as significant but too small to be added");
  else if (r->stated)
    append(r->why, "stated as indistinguishable from what was named");
  else
    why_not_named(t, a, r, r->why);
}

void blind_score(const blind_trial *t, const double *limit, const blind_answer *a, blind_record *r)
{
  memset(r, 0, sizeof *r);
  note_question(t, limit, r);
  note_answer(a, r);
  note_own(t, a, r);
  r->detected = blind_is(a->verdict, "effect") || blind_is(a->verdict, "unlisted") || blind_is(a->verdict, "undecided");
  r->name = right(t, a, NAME);
  r->stated = right(t, a, STATED);
  r->family = right(t, a, FAMILY);
  explain(t, a, r);
}
