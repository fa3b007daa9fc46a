#include "finding.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../lab/base/text.h"

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
