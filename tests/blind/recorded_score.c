#include "recorded_score.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../../apps/lab/base/text.h"

const char *blind_class_text(int class)
{
  static const char *const text[BLIND_CLASSES] = {"no answer", "undecided",  "false alarm", "right",
                                                  "partly",    "overlooked", "wrong"};
  return text[class];
}

/* ---- What is missing ---- */

/* Size over information limit. */
static double over_limit(const blind_visible *v, int effect)
{
  return sqrt(v->effect[effect] / BLIND_LIMIT_STATISTIC);
}

static int is_visible(const blind_visible *v, int effect)
{
  return over_limit(v, effect) >= 2;
}

/* What a sensor's filter may be called. */
static int is_filter(const blind_recorded *r, const blind_found *f)
{
  return (blind_is(f->effect, "pressure_lag") && r->filter[0] > 0) ||
         (blind_is(f->effect, "position_lag") && r->filter[1] > 0);
}

/* An error of an instrument is as well told among the deviations, where 0 is declared. */
static int is_deviation(const blind_answer *a, const char *effect, double size)
{
  int k, any = 0;
  for (k = 0; k < a->n_deviations; k++)
    any |= blind_is(a->deviation[k].parameter, effect) && a->deviation[k].ratio * size > 0;
  return any;
}

typedef struct tally {
  int right, filter, false_names; /* findings */
  int open;                       /* visible effects that nothing was said of */
} tally;

static tally tally_of(const blind_recorded *r, const blind_visible *v, const blind_answer *a)
{
  const blind_trial *t = &r->t;
  int i, k, taken[BLIND_FINDS] = {0};
  tally n = {0};
  for (i = 0; i < t->n_missing; i++) {
    const blind_effect *e = t->missing[i].effect;
    for (k = 0; k < a->n_found && (taken[k] || !blind_stands_for(&a->found[k], e)); k++)
      ;
    if (k < a->n_found)
      taken[k] = 1;
    n.right += k < a->n_found;
    n.open +=
        k == a->n_found && is_visible(v, i) && !blind_is_small(a, e) && !is_deviation(a, e->name, t->missing[i].size);
  }
  for (k = 0; k < a->n_found; k++) {
    n.filter += !taken[k] && is_filter(r, &a->found[k]);
    n.false_names += !taken[k] && !is_filter(r, &a->found[k]);
  }
  return n;
}

static int class_of_unlisted(const blind_trial *t, const blind_visible *v, const blind_answer *a)
{
  int i, class = t->n_missing == 0 ? BLIND_FALSE_ALARM : BLIND_WRONG;
  for (i = 0; i < t->n_missing; i++)
    if (a->n_unlisted > 0 && blind_is(a->unlisted[0], t->missing[i].effect->equation)) {
      if (t->kind == BLIND_UNLISTED)
        class = BLIND_RIGHT;
      else if (is_visible(v, i))
        class = BLIND_PARTLY;
    }
  return class;
}

static int class_of(const blind_recorded *r, const blind_visible *v, const blind_answer *a, const tally *n)
{
  if (blind_is(a->verdict, "timeout") || blind_is(a->verdict, "failed"))
    return BLIND_NO_ANSWER;
  if (blind_is(a->verdict, "undecided"))
    return BLIND_UNDECIDED;
  if (blind_is(a->verdict, "unlisted"))
    return class_of_unlisted(&r->t, v, a);
  if (n->false_names == 0 && n->open == 0)
    return BLIND_RIGHT;
  if (r->t.n_missing == 0)
    return BLIND_FALSE_ALARM;
  if (n->right > 0)
    return BLIND_PARTLY;
  return n->false_names > 0 ? BLIND_WRONG : BLIND_OVERLOOKED;
}

/* ---- Deviations ---- */

double blind_true_ratio(const blind_recorded *r, int value)
{
  const double declared = blind_value_of(&r->t.declared, value), off = r->off[value];
  const double rest = 1.0 / 3; /* of the viscous term, which is declared apart from damping */
  if (blind_values[value].absolute)
    return (declared + off) / declared;
  return blind_is(blind_values[value].name, "damping") ? (off - rest) / (1 - rest) : off;
}

/* A restriction is one value here, and one or two there. */
static int is_of(const blind_deviation *d, int value)
{
  const int orifice = blind_is(d->parameter, "fill_area") || blind_is(d->parameter, "vent_area");
  return blind_is(d->parameter, blind_values[value].name) ||
         (orifice && blind_is(blind_values[value].name, "orifice_area"));
}

/* The share by which the vent passes less than the fill orifice, beside what is declared of both. */
static double true_restriction(const blind_recorded *r)
{
  const second_rig g = blind_recorded_later(r, BLIND_ALL), *declared = &r->t.declared;
  return 1 - g.vent_area / g.fill_area * declared->fill_area / declared->vent_area;
}

static int is_restriction(const blind_deviation *d)
{
  return blind_is(d->parameter, "vent_restriction");
}

/* NaN of what is not judged, say of a sensor. */
static double truth_of(const blind_recorded *r, const blind_deviation *d)
{
  int i;
  for (i = 0; i < BLIND_VALUES; i++)
    if (is_of(d, i))
      return blind_true_ratio(r, i);
  return is_restriction(d) ? true_restriction(r) : (double)NAN;
}

static const blind_deviation *said_of(const blind_answer *a, int value)
{
  int k;
  for (k = 0; k < a->n_deviations; k++)
    if (is_of(&a->deviation[k], value))
      return &a->deviation[k];
  return NULL;
}

static int is_found(const blind_recorded *r, const blind_answer *a, int value)
{
  const blind_deviation *d = said_of(a, value);
  return d && (d->ratio - 1) * (blind_true_ratio(r, value) - 1) > 0;
}

#define append(text, ...) lab_append(text, BLIND_TEXT, __VA_ARGS__)

static void count_due(const blind_recorded *r, const blind_visible *v, const blind_answer *a, blind_record *record)
{
  int i;
  for (i = 0; i < BLIND_VALUES; i++) {
    const int found = is_found(r, a, i);
    if (!(v->value[i] >= BLIND_DUE))
      continue;
    record->n_due++;
    record->n_found += found;
    record->far_due += i == r->beyond;
    record->far_found += i == r->beyond && found;
    append(record->due, "%s%s%s x%.3g", *record->due ? "; " : "", found ? "" : "NOT ", blind_values[i].name,
           blind_true_ratio(r, i));
  }
}

/* The vent is off by itself in every rig; where an effect narrows it, that is judged by its name. */
static void count_vent_due(const blind_recorded *r, const blind_visible *v, const blind_answer *a, blind_record *record)
{
  const double restriction = true_restriction(r);
  int i, k, found = 0;
  for (i = 0; i < r->t.n_missing; i++)
    if (blind_is(r->t.missing[i].effect->name, "vent_restriction"))
      return;
  if (!(v->vent >= BLIND_DUE))
    return;
  for (k = 0; k < a->n_deviations; k++)
    found |= is_restriction(&a->deviation[k]) && a->deviation[k].ratio * restriction > 0;
  record->n_due++;
  record->n_found += found;
  append(record->due, "%s%svent_restriction %.3g", *record->due ? "; " : "", found ? "" : "NOT ", restriction);
}

/* What is not judged counts as said all the same. */
static void count_said(const blind_recorded *r, const blind_answer *a, blind_record *record)
{
  int k;
  for (k = 0; k < a->n_deviations; k++) {
    const blind_deviation *d = &a->deviation[k];
    append(record->deviations, "%s%s %s%.3g [%.3g..%.3g]%s", k ? "; " : "", d->parameter, d->absolute ? "" : "x",
           d->ratio, d->low, d->high, d->beyond ? " beyond" : "");
    record->n_said++;
    record->n_wrong += fabs(d->ratio - truth_of(r, d)) > d->high - d->low;
  }
}

/* ---- Onset ---- */

/* What was said of when that which begins began.  Returns: 0 if it was not named or found */
static int since_of(const blind_recorded *r, const blind_answer *a, blind_since *since)
{
  int k;
  if (r->onset_value >= 0) {
    if (is_found(r, a, r->onset_value))
      *since = said_of(a, r->onset_value)->since;
    return is_found(r, a, r->onset_value);
  }
  for (k = 0; k < a->n_found; k++)
    if (blind_stands_for(&a->found[k], r->t.missing[0].effect)) {
      *since = a->found[k].since;
      return 1;
    }
  return 0;
}

static void any_onset(const blind_answer *a, blind_record *record)
{
  int k;
  for (k = 0; k < a->n_found; k++)
    record->onset_said |= isfinite(a->found[k].since.t);
  for (k = 0; k < a->n_deviations; k++)
    record->onset_said |= isfinite(a->deviation[k].since.t);
}

static void score_onset(const blind_recorded *r, const blind_answer *a, blind_record *record)
{
  blind_since since = {NAN, NAN, NAN};
  record->onset = r->onset;
  if (isnan(r->onset)) {
    any_onset(a, record);
    return;
  }
  snprintf(record->begins, sizeof record->begins, "%s",
           r->onset_value >= 0 ? blind_values[r->onset_value].name : r->t.missing[0].effect->name);
  record->onset_due = since_of(r, a, &since);
  if (!record->onset_due || !isfinite(since.t))
    return;
  record->onset_said = 1;
  record->onset_within = since.low <= r->onset && r->onset <= since.high;
  snprintf(record->since, sizeof record->since, "%.5g [%.5g..%.5g]", since.t, since.low, since.high);
}

/* ---- The whole ---- */

static void note_log(const blind_recorded *r, size_t n_rows, blind_record *record)
{
  snprintf(record->log, sizeof record->log, "%s", blind_loop_text(r->loop));
  blind_imperfection_text(r, record->imperfections, sizeof record->imperfections);
  snprintf(record->beyond, sizeof record->beyond, "%s", r->beyond >= 0 ? blind_values[r->beyond].name : "");
  record->rate = 1 / r->spacing;
  record->rows = (double)n_rows;
}

void blind_score_recorded(const blind_recorded *r, const blind_visible *v, const blind_answer *a, size_t n_rows,
                          blind_record *record)
{
  const tally n = tally_of(r, v, a);
  double limit[BLIND_AT_ONCE];
  int i;
  for (i = 0; i < r->t.n_missing; i++)
    limit[i] = fabs(r->t.missing[i].size) / over_limit(v, i);
  blind_score(&r->t, limit, a, record);
  note_log(r, n_rows, record);
  record->second_ratio = r->t.n_missing > 1 ? over_limit(v, 1) : (double)NAN;
  snprintf(record->class, sizeof record->class, "%s", blind_class_text(class_of(r, v, a, &n)));
  snprintf(record->condition, sizeof record->condition, "%.20s", a->condition);
  record->instrument = n.filter;
  record->cpu = a->cpu;
  count_due(r, v, a, record);
  count_vent_due(r, v, a, record);
  count_said(r, a, record);
  score_onset(r, a, record);
}
