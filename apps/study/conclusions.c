#include "conclusions.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const double conclusion_words[CONCLUSION_WORDS] = {0.05, 0.1, 0.2, 0.3, 0.41421356};

enum { MARKED_WORDS = 4 }; /* of them that a verdict must outlast */

enum { VERDICT_TEXT = 2 * FINDING_TEXT + 32, EVIDENCE_TEXT = 4 * FINDING_TEXT };

void conclusion_limits(const conclusion *c, double word, double *low, double *high)
{
  *low = c->low + c->low_per * word;
  *high = c->high + c->high_per * word;
}

/* ---- Findings ---- */

void finding_add(finding *f, double value, const char *label, ...)
{
  va_list args;
  if (f->n >= FINDING_CASES)
    return;
  va_start(args, label);
  vsnprintf(f->at[f->n].label, FINDING_LABEL, label, args);
  va_end(args);
  f->at[f->n++].value = value;
}

void finding_add_conditioned(finding *f, double value)
{
  if (f->n_conditioned < FINDING_CASES)
    f->conditioned[f->n_conditioned++].value = value;
}

void finding_join(finding *all, const finding *one, const char *name)
{
  int i;
  if (*one->where)
    lab_append(all->where, FINDING_TEXT, "%s%s (%s)", *all->where ? ", " : "", one->where, name);
  if (*one->note)
    lab_append(all->note, FINDING_TEXT, "%s%s: %s", *all->note ? "; " : "", name, one->note);
  strcpy(all->condition, one->condition);
  for (i = 0; i < one->n; i++)
    finding_add(all, one->at[i].value, "%s%s%s", name, *one->at[i].label ? ", " : "", one->at[i].label);
  for (i = 0; i < one->n_conditioned; i++)
    finding_add_conditioned(all, one->conditioned[i].value);
}

static int all_within(const finding_case *at, int n, double low, double high)
{
  int i;
  for (i = 0; i < n; i++)
    if (!(at[i].value >= low && at[i].value <= high))
      return 0;
  return n > 0;
}

int finding_judge(const finding *f, double low, double high)
{
  if (all_within(f->at, f->n, low, high))
    return FINDING_HOLDS;
  return all_within(f->conditioned, f->n_conditioned, low, high) ? FINDING_HOLDS_WHEN : FINDING_CONTRADICTED;
}

/* Four digits after the point at most: what is left of a zero differs between machines. */
static double tidy(double value)
{
  return round(value * 1e4) / 1e4 + 0.0;
}

double finding_worst(const finding *f, double low, double high)
{
  double worst = f->at[0].value;
  int i;
  for (i = 1; i < f->n; i++) {
    if (isinf(low))
      worst = fmax(worst, f->at[i].value);
    if (isinf(high))
      worst = fmin(worst, f->at[i].value);
  }
  return tidy(worst);
}

const char *finding_word(int verdict)
{
  static const char *const words[] = {"holds", "holds when", "contradicted"};
  return words[verdict];
}

void finding_verdict_text(const finding *f, int verdict, char *text, size_t size)
{
  snprintf(text, size, "%s", finding_word(verdict));
  if (verdict == FINDING_HOLDS_WHEN)
    lab_append(text, size, " %s%s%s", f->condition, *f->where ? " " : "", f->where);
}

void finding_evidence(const finding *f, const char *what, double low, double high, char *text, size_t size)
{
  int i;
  snprintf(text, size, "%s:", what);
  for (i = 0; i < f->n; i++)
    lab_append(text, size, "%s %.3g%s%s%s", i ? "," : "", tidy(f->at[i].value), *f->at[i].label ? " (" : "",
               f->at[i].label, *f->at[i].label ? ")" : "");
  if (low > -HUGE_VAL && high < HUGE_VAL)
    lab_append(text, size, "; claimed %.4g..%.4g", low, high);
  else if (high < HUGE_VAL)
    lab_append(text, size, "; claimed <= %.4g", high);
  else
    lab_append(text, size, "; claimed >= %.4g", low);
  if (*f->note)
    lab_append(text, size, "; %s", f->note);
}

/* ---- Trying ---- */

/* All conclusions on one actuator under one pair of laws. */
static int try_cell(const study_cell *c, void *context, lab_error *error)
{
  finding *found = (finding *)context + (size_t)c->index * CONCLUSIONS;
  conclusion_trial t;
  int i;
  if (conclusion_trial_run(c->rig, &c->laws, &t, error))
    return error->status;
  for (i = 0; i < CONCLUSIONS; i++) {
    double low;
    conclusion_limits(&conclusions[i], conclusions[i].word, &low, &t.limit);
    conclusions[i].measure(&t, &found[i]);
  }
  return LAB_OK;
}

int conclusions_try(const study *s, finding **found, lab_error *error)
{
  static const study_grid grid = {STUDY_ALL, STUDY_EVERY_LAW};
  *found = calloc((size_t)(s->n_actuators * s->n_gas * s->n_flow) * CONCLUSIONS, sizeof **found);
  return *found ? study_each(s, &grid, try_cell, *found, error) : lab_fail_memory(error, "the conclusions");
}

/* ---- Tables ---- */

static const finding *found_of(const study *s, const finding *found, int actuator, int law, int i)
{
  return &found[(size_t)(actuator * s->n_gas * s->n_flow + law) * CONCLUSIONS + (size_t)i];
}

static int verdict_at(const conclusion *c, double word, const finding *f)
{
  double low, high;
  conclusion_limits(c, word, &low, &high);
  return finding_judge(f, low, high);
}

static int verdict_of(const conclusion *c, const finding *f)
{
  return verdict_at(c, c->word, f);
}

static const char *gas_of(const study *s, int law)
{
  return pneu_gas_key(s->gas[law / s->n_flow]);
}

static const char *flow_of(const study *s, int law)
{
  return pneu_flow_key(s->flow[law % s->n_flow]);
}

static void evidence_of(const conclusion *c, const finding *f, char *text)
{
  double low, high;
  conclusion_limits(c, c->word, &low, &high);
  finding_evidence(f, c->what, low, high, text, EVIDENCE_TEXT);
}

/* One row over the printed actuators; where they differ the evidence says who says what. */
static void add_overall(const study *s, const finding *found, int i, int all_of_them, int law, table *t)
{
  const conclusion *c = &conclusions[i];
  char verdict[VERDICT_TEXT], evidence[EVIDENCE_TEXT], each[FINDING_TEXT] = "";
  finding all = {0};
  int a, first = 0, differ = 0;
  (void)all_of_them;
  for (a = 0; a < s->n_printed; a++) {
    const finding *one = found_of(s, found, a, law, i);
    const int mine = verdict_of(c, one);
    finding_join(&all, one, s->actuator[a].name);
    first = a ? first : mine;
    differ |= mine != first;
    lab_append(each, sizeof each, "%s%s %s", a ? ", " : "", s->actuator[a].name, finding_word(mine));
  }
  if (differ)
    lab_append(all.note, FINDING_TEXT, "; %s", each);
  finding_verdict_text(&all, verdict_of(c, &all), verdict, sizeof verdict);
  evidence_of(c, &all, evidence);
  table_row(t, "gssss", (double)c->number, gas_of(s, law), flow_of(s, law), verdict, evidence);
}

/* "printed", or "bench" where the springs follow from the bench set. */
static const char *set_of(const study *s, int actuator)
{
  return actuator < s->n_printed ? "printed" : "bench";
}

static double open_is_empty(double limit)
{
  return isinf(limit) ? (double)NAN : limit;
}

static void add_actuator(const study *s, const finding *found, int i, int a, int law, table *t)
{
  const conclusion *c = &conclusions[i];
  const finding *r = found_of(s, found, a, law, i);
  char verdict[VERDICT_TEXT], evidence[EVIDENCE_TEXT];
  double low, high;
  conclusion_limits(c, c->word, &low, &high);
  finding_verdict_text(r, verdict_of(c, r), verdict, sizeof verdict);
  evidence_of(c, r, evidence);
  table_row(t, "gssssgggss", (double)c->number, s->actuator[a].name, set_of(s, a), gas_of(s, law), flow_of(s, law),
            finding_worst(r, low, high), open_is_empty(low), open_is_empty(high), verdict, evidence);
}

/* The worst verdict of the actuators of a set with a number given to the word. */
static int worst_of_set(const study *s, const finding *found, int i, int set, int law, double word)
{
  const int last = set ? s->n_actuators : s->n_printed;
  int a, worst = FINDING_HOLDS;
  for (a = set ? s->n_printed : 0; a < last; a++) {
    const int mine = verdict_at(&conclusions[i], word, found_of(s, found, a, law, i));
    worst = mine > worst ? mine : worst;
  }
  return worst;
}

static void add_thresholds(const study *s, const finding *found, int i, int set, int law, table *t)
{
  const double usual = conclusions[i].word;
  const char *words[CONCLUSION_WORDS];
  const int verdict = worst_of_set(s, found, i, set, law, usual);
  const int by_set = s->n_printed < s->n_actuators && verdict != worst_of_set(s, found, i, !set, law, usual);
  int w, by_word = 0;
  for (w = 0; w < CONCLUSION_WORDS; w++) {
    const int other = worst_of_set(s, found, i, set, law, conclusion_words[w]);
    words[w] = finding_word(other);
    by_word |= w < MARKED_WORDS && other != worst_of_set(s, found, i, set, law, conclusion_words[0]);
  }
  table_row(t, "gssssssssss", (double)conclusions[i].number, set ? "bench" : "printed", gas_of(s, law), flow_of(s, law),
            finding_word(verdict), words[0], words[1], words[2], words[3], words[4],
            by_word && by_set ? "threshold, set"
            : by_word         ? "threshold"
            : by_set          ? "set"
                              : "");
}

/* By conclusion, then by one or each actuator or set, then by law. */
static const struct {
  const char *file, *header;
  void (*add)(const study *s, const finding *found, int i, int which, int law, table *t);
} tables[CONCLUSION_TABLES] = {
    [CONCLUSION_OVERALL] = {"conclusions.csv", "conclusion,gas,flow,verdict,evidence", add_overall},
    [CONCLUSION_ACTUATORS] = {"conclusions_actuators.csv",
                              "conclusion,actuator,set,gas,flow,value,low,high,verdict,evidence", add_actuator},
    [CONCLUSION_THRESHOLDS] = {"conclusions_thresholds.csv",
                               "conclusion,set,gas,flow,verdict,at_5,at_10,at_20,at_30,at_41,depends_on",
                               add_thresholds}};

void conclusions_table(const study *s, const finding *found, int which, table *t)
{
  const int count[CONCLUSION_TABLES] = {[CONCLUSION_OVERALL] = 1,
                                        [CONCLUSION_ACTUATORS] = s->n_actuators,
                                        [CONCLUSION_THRESHOLDS] = s->n_printed < s->n_actuators ? 2 : 1};
  int i, k, law;
  table_open(t, tables[which].header);
  for (i = 0; i < CONCLUSIONS; i++)
    for (k = 0; k < count[which]; k++)
      for (law = 0; law < s->n_gas * s->n_flow; law++)
        tables[which].add(s, found, i, k, law, t);
}

int conclusions_make(const study *s, lab_error *error)
{
  finding *found;
  int i, status = conclusions_try(s, &found, error);
  for (i = 0; i < CONCLUSION_TABLES && status == LAB_OK; i++) {
    table t;
    conclusions_table(s, found, i, &t);
    status = study_save(s, tables[i].file, &t, error);
    table_close(&t);
  }
  free(found);
  return status;
}
