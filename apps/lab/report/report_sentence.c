/* The answer in words: what deviates, what is missing, and what that does to the error. */
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "../base/format.h"
#include "../trace/freeterms.h"
#include "report.h"

enum { DEVIATIONS_TOLD = 3 };

typedef struct words {
  char *text;
  size_t size;
} words;

static void add(const words *w, const char *format, ...) LAB_PRINTF(2, 3);

static void add(const words *w, const char *format, ...)
{
  const size_t used = strlen(w->text);
  va_list list;
  va_start(list, format);
  vsnprintf(w->text + used, w->size - used, format, list);
  va_end(list);
}

/* ", " or " and " before item i of n, nothing before the first. */
static const char *joint(int i, int n)
{
  return i == 0 ? "" : i + 1 < n ? ", " : " and ";
}

/* ---- What deviates ---- */

/* What a person calls a parameter, and by how much less or more of it there is; others are "the" and their name. */
static const struct {
  const char *name, *called, *less, *more;
} plain[] = {{"dry_friction", "friction", NULL, NULL},
             {"spring_rate", "the spring", "soft", "stiff"},
             {"orifice_area", "the area of both orifices", NULL, NULL}};

/* "3.7 times its sheet", "25 % soft", "12 % above its sheet", "0.5 kPa in place of 0 kPa" */
static void add_ratio(const words *w, const lab_deviation *d, const char *less, const char *more)
{
  const double percent = 100 * (d->ratio - 1);
  char found[LAB_FORMAT_TEXT], declared[LAB_FORMAT_TEXT];
  if (!isfinite(d->ratio))
    add(w, "%s in place of %s", lab_format_quantity(d->found, d->unit, 3, found),
        lab_format_quantity(d->declared, d->unit, 3, declared));
  else if (d->ratio >= 2 || d->ratio < 0.5)
    add(w, "%.2g times its sheet", d->ratio);
  else if (less)
    add(w, "%.2g %% %s", fabs(percent), percent < 0 ? less : more);
  else
    add(w, "%.2g %% %s its sheet", fabs(percent), percent < 0 ? "below" : "above");
}

static void add_ratio_of(const words *w, const lab_deviation *d, int first)
{
  const char *verb = first ? "is " : "";
  char name[LAB_PARAM_NAME_TEXT];
  size_t i;
  for (i = 0; i < sizeof plain / sizeof *plain; i++)
    if (!strcmp(plain[i].name, d->name)) {
      add(w, "%s %s", plain[i].called, verb);
      add_ratio(w, d, plain[i].less, plain[i].more);
      return;
    }
  snprintf(name, sizeof name, "%s", d->name);
  for (i = 0; name[i]; i++)
    if (name[i] == '_' || name[i] == '.')
      name[i] = ' ';
  add(w, "the %s %s", name, verb);
  add_ratio(w, d, NULL, NULL);
}

static void add_deviation(const words *w, const lab_report *report, const lab_deviation *d, int first)
{
  char since[LAB_SINCE_TEXT];
  add_ratio_of(w, d, first);
  add(w, "%s", lab_report_since(lab_report_onset(report, d->param), since));
}

/* Those beyond their tolerance.  Returns: their number */
static int add_deviations(const words *w, const lab_report *report)
{
  const lab_deviations *all = &report->deviations;
  char *begin = w->text + strlen(w->text);
  int i, n = 0, told = 0;
  for (i = 0; i < all->n; i++)
    n += all->of[i].beyond != 0;
  for (i = 0; i < all->n && told < DEVIATIONS_TOLD; i++)
    if (all->of[i].beyond) {
      add(w, "%s", told ? ", " : "");
      add_deviation(w, report, &all->of[i], told++ == 0);
    }
  if (n > told)
    add(w, ", and %d more", n - told);
  *begin = (char)toupper((unsigned char)*begin);
  return n;
}

/* ---- What is missing ---- */

void lab_report_found_sentence(const lab_report *report, const lab_found *found, char text[LAB_FOUND_SENTENCE])
{
  char sentence[LAB_EFFECT_SENTENCE], where[LAB_WHERE_TEXT], since[LAB_SINCE_TEXT];
  const lab_rig *rig = &report->completed->rig;
  lab_rig last;
  lab_rig_at(rig, INFINITY, &last);
  if (found->effect >= 0) {
    lab_effect_sentence(&last, found->effect, found->param, sentence);
    lab_report_since(lab_report_onset(report, found->param), since);
    snprintf(text, LAB_FOUND_SENTENCE, "%.*s%s%s.", (int)strlen(sentence) - 1, sentence, *since ? "," : "", since);
  } else
    snprintf(text, LAB_FOUND_SENTENCE, "Something that is not in the catalogue acts like %s: %s.",
             lab_free_term_what(lab_report_term(report, found)),
             lab_free_term_where(lab_report_term(report, found), where));
}

/* The sentence of each, with its name before the full stop. */
static void add_found(const words *w, const lab_report *report)
{
  const lab_search_result *r = report->result;
  int i;
  for (i = 0; i < r->n_found; i++) {
    char sentence[LAB_FOUND_SENTENCE];
    lab_report_found_sentence(report, &r->found[i], sentence);
    add(w, "%s%.*s", i ? " " : "", (int)strlen(sentence) - 1, sentence);
    if (r->found[i].effect >= 0)
      add(w, " (%s)", pneu_effect_at(r->found[i].effect)->name);
    add(w, ".");
  }
}

static int is_small(const lab_search_result *r)
{
  return r->n_listed > 0 || r->has_small;
}

/* In the words that follow deviations, or in those that stand alone. */
static const char *nothing(const lab_report *report, int deviates)
{
  if (is_small(report->result))
    return deviates ? "; nothing else is missing that is worth adding." : "Nothing is missing that is worth adding.";
  if (deviates)
    return "; nothing else is missing.";
  return report->deviations.condition == LAB_CONDITION_AS_DECLARED
             ? "Nothing is missing, and every declared value is within its tolerance."
             : "Nothing is missing.";
}

void lab_report_headline(const lab_report *report, char *text, size_t size)
{
  const words w = {text, size};
  const lab_search_result *r = report->result;
  int deviates;
  *text = '\0';
  if (report->changes)
    lab_report_change_sentence(report->changes, text, size);
  if (lab_report_doubt(report)) {
    add(&w, "Undecided: %s", lab_report_doubt(report));
    return;
  }
  deviates = add_deviations(&w, report) > 0;
  if (r->verdict == LAB_VERDICT_NONE) {
    add(&w, "%s", nothing(report, deviates));
    return;
  }
  add(&w, deviates ? ". " : "");
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    add(&w, "Something%s is missing, but the log does not say what.", deviates ? " else" : "");
  else
    add_found(&w, report);
}

/* ---- What that does to the error ---- */

/* "laminar_leak, heat_transfer and a free term" */
static void add_names(const words *w, const lab_search_result *r)
{
  int i;
  for (i = 0; i < r->n_found; i++)
    add(w, "%s%s", joint(i, r->n_found),
        r->found[i].effect >= 0 ? pneu_effect_at(r->found[i].effect)->name : "a free term");
}

static void add_undecided(const words *w, const lab_search_result *r)
{
  const double before = lab_report_in_noise(&r->before), after = lab_report_in_noise(&r->after);
  if (r->n_found == 0) {
    add(w, "The residual is %.2f times the noise, and no effect of the catalogue explains it.", after);
    return;
  }
  add(w, "With the best candidate%s, ", r->n_found > 1 ? "s" : "");
  add_names(w, r);
  add(w, ", the error falls from %.2f to %.2f times the noise, but what is left is not noise.", before, after);
}

static void add_small(const words *w, const lab_search_result *r)
{
  const int more = r->n_listed + r->has_small - 1;
  add(w, " Significant, but lowering the error by less than --min-gain: %s",
      r->n_listed ? pneu_effect_at(r->listed[0])->name : "a free term");
  add(w, more > 0 ? " and %d more." : ".", more);
}

void lab_report_evidence(const lab_report *report, char *text, size_t size)
{
  const words w = {text, size};
  const lab_search_result *r = report->result;
  const char *with = r->n_found > 1 ? "With them" : "With it";
  *text = '\0';
  if (lab_report_doubt(report))
    return;
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    add_undecided(&w, r);
  else if (r->window > 0 && r->n_found > 0)
    add(&w, "%s the stem sticks and slips as it does in the log; the instants of single slips cannot be predicted.",
        with);
  else if (r->n_found > 0)
    add(&w, "%s the error falls from %.2f to %.2f times the noise.", with, lab_report_in_noise(&r->before),
        lab_report_in_noise(&r->after));
  else
    add(&w, "The declared model leaves %.2f times the noise.", lab_report_in_noise(&r->after));
  if (r->verdict == LAB_VERDICT_NONE && is_small(r))
    add_small(&w, r);
  if (r->cut_short)
    add(&w, " The search was ended by --budget: this is the best answer so far.");
}

void lab_report_sentence(const lab_report *report, char *text, size_t size)
{
  size_t used;
  lab_report_headline(report, text, size);
  used = strlen(text);
  if (used + 1 < size) {
    text[used] = ' ';
    lab_report_evidence(report, text + used + 1, size - used - 1);
    if (!text[used + 1])
      text[used] = '\0';
  }
}
