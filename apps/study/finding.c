#include "finding.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void append(char *text, int size, const char *format, va_list args)
{
  const int used = (int)strlen(text);
  vsnprintf(text + used, (size_t)(size - used), format, args);
}

static void say(char *text, int size, const char *format, ...) LAB_PRINTF(3, 4);

static void say(char *text, int size, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  append(text, size, format, args);
  va_end(args);
}

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

void finding_condition(finding *f, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  append(f->condition, FINDING_TEXT, format, args);
  va_end(args);
}

void finding_note(finding *f, const char *format, ...)
{
  va_list args;
  va_start(args, format);
  append(f->note, FINDING_TEXT, format, args);
  va_end(args);
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

void finding_verdict_text(const finding *f, int verdict, char *text, int size)
{
  static const char *const words[] = {"holds", "holds when ", "contradicted"};
  snprintf(text, (size_t)size, "%s%s", words[verdict], verdict == FINDING_HOLDS_WHEN ? f->condition : "");
}

/* Four digits after the point at most: what is left of a zero differs between machines. */
static double tidy(double value)
{
  return round(value * 1e4) / 1e4 + 0.0;
}

void finding_evidence(const finding *f, const char *what, double low, double high, char *text, int size)
{
  int i;
  snprintf(text, (size_t)size, "%s:", what);
  for (i = 0; i < f->n; i++)
    say(text, size, "%s %.3g%s%s%s", i ? "," : "", tidy(f->at[i].value), *f->at[i].label ? " (" : "", f->at[i].label,
        *f->at[i].label ? ")" : "");
  if (low > -HUGE_VAL && high < HUGE_VAL)
    say(text, size, "; claimed %.4g..%.4g", low, high);
  else if (high < HUGE_VAL)
    say(text, size, "; claimed <= %.4g", high);
  else
    say(text, size, "; claimed >= %.4g", low);
  if (*f->note)
    say(text, size, "; %s", f->note);
}
