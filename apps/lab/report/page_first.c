/* The first look: what is missing and how much, how sure that is, what to do. */
#include <math.h>

#include "../base/quantile.h"
#include "../base/format.h"
#include "../trace/freeterms.h"
#include "page_private.h"

static const char *size_heading(const lab_search_result *r)
{
  if (r->n_found == 0)
    return "Residual";
  return r->verdict == LAB_VERDICT_UNDECIDED ? "Best candidate, and its size" : "What is missing, and its size";
}

/* The size of each effect that was found, with its interval. */
static void put_main(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  int i;
  for (i = 0; i < r->n_found; i++) {
    cJSON *item = r->found[i].effect < 0 ? NULL : lab_page_put_size(t, r->found[i].param, list);
    if (item)
      lab_json_put(item, "name", "%s", lab_page_effect_name(r->found[i].effect));
  }
}

/* What is left, and where something without a name acts. */
static void put_remainder(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  char where[LAB_WHERE_TEXT], number[LAB_FORMAT_TEXT];
  cJSON *item;
  int i;
  for (i = 0; i < r->n_found; i++)
    if (r->found[i].effect < 0) {
      const pneu_term *term = &t->report->completed->rig.term[r->found[i].term];
      item = lab_json_append(list);
      lab_json_put(item, "value", "%s", lab_free_term_what(term));
      lab_json_put(item, "words", "%s", lab_free_term_where(term, where));
    }
  if (r->n_found > 0 || r->before.n == 0)
    return;
  item = lab_json_append(list);
  lab_json_put(item, "value", "%s × noise", lab_format_number(lab_report_in_noise(&r->after), 3, number));
  lab_json_put(item, "words", "is the error of the declared model, fitted");
}

/* How much more than chance one thing is that was added. */
static void say_chance(const lab_sources *t, const lab_found *found, cJSON *list)
{
  char p[LAB_FORMAT_TEXT], statistic[LAB_FORMAT_TEXT], threshold[LAB_FORMAT_TEXT];
  lab_format_p(lab_report_chance(t->report, found), p);
  lab_format_number(found->statistic, 3, statistic);
  if (found->effect < 0)
    lab_json_say(list, "The free term is significant: p-value %s (score %s over %d values).", p, statistic,
                 found->degrees);
  else
    lab_json_say(list, "The effect %s is significant: p-value %s (score %s, threshold %s).",
                 lab_page_effect_name(found->effect), p, statistic,
                 lab_format_number(lab_chi2_threshold(t->report->result->level), 3, threshold));
}

/* When it began, of whatever did not act from the start. */
static void say_onsets(const lab_sources *t, cJSON *list)
{
  const lab_rig *rig = &t->report->completed->rig;
  char name[LAB_PARAM_NAME_TEXT], since[LAB_SINCE_TEXT];
  int k;
  for (k = 0; k < rig->n_onsets; k++) {
    const lab_onset *onset = lab_report_onset(t->report, rig->onset[k].param);
    if (onset)
      lab_json_say(list, "It did not act from the start: %s has another value%s, the interval being that of 95 %%.",
                   lab_fit_name(rig->onset[k].param, name), lab_report_since(onset, since));
  }
}

static int count_alike(const lab_search_result *r)
{
  int i, n = 0;
  for (i = 0; i < r->n_found; i++)
    n += r->found[i].n_alike;
  return n;
}

/* The first effect that the log cannot tell from another, or the first that looks like it. */
static const char *alike_name(const lab_search_result *r, int other)
{
  int i = 0;
  while (r->found[i].n_alike == 0)
    i++;
  return lab_page_effect_name(other ? r->found[i].alike[0] : r->found[i].effect);
}

/* Whether anything else would do as well. */
static void say_alike(const lab_search_result *r, cJSON *list)
{
  int i, named = 0;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    named += found->effect >= 0;
    if (found->n_alike > 0)
      lab_json_say(list, "The log cannot tell %s from %s: each explains it equally well%s.",
                   lab_page_effect_name(found->effect), lab_page_effect_name(found->alike[0]),
                   found->n_alike > 1 ? ", and so do others, see below" : "");
  }
  if (named > 0 && count_alike(r) == 0)
    lab_json_say(list, "No other effect of the catalogue explains the log as well.");
}

static void say_held_out(const lab_report *report, cJSON *list)
{
  char before[LAB_FORMAT_TEXT], after[LAB_FORMAT_TEXT];
  if (!report->has_holdout)
    lab_json_say(list, "The model was not tested on a held-out log.");
  else if (report->result->n_found > 0)
    lab_json_say(list, "On a log that was not used for the fit, the error goes from %s to %s times the noise.",
                 lab_format_number(lab_report_in_noise(&report->holdout_before), 3, before),
                 lab_format_number(lab_report_in_noise(&report->holdout_after), 3, after));
  else
    lab_json_say(list, "On a log that was not used for the fit, the error is %s times the noise.",
                 lab_format_number(lab_report_in_noise(&report->holdout_before), 3, before));
}

/* Whether what is left is noise: as the verdict has it. */
static void say_left(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  const lab_residual_stats *left = r->left[LAB_STAGE_AFTER];
  const int coloured = lab_residual_stats_coloured(left);
  if (coloured > 0 && r->window == 0 && (r->verdict == LAB_VERDICT_NONE || r->verdict == LAB_VERDICT_EFFECT))
    lab_json_say(list, "The residual is no larger than noise, but not white on %d of %d channels.", coloured,
                 t->table->n_channels);
  else if (coloured > 0)
    lab_json_say(list, "The residual is not white on %d of %d channels.", coloured, t->table->n_channels);
  else if (!lab_residual_stats_white(left))
    lab_json_say(list, "There are too few values to tell whether the residual is white.");
  else if (r->verdict == LAB_VERDICT_UNDECIDED && !lab_report_doubt(t->report))
    lab_json_say(list, "The residual is white on every channel, but its size differs from the declared noise.");
  else
    lab_json_say(list, "The residual is white on every channel.");
}

/* Of an undecided verdict: what is certain, and what is not. */
static void say_undecided(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  const lab_residual_stats *left = r->left[LAB_STAGE_AFTER];
  char text[LAB_FORMAT_TEXT];
  double p = 1;
  int c;
  for (c = 0; c < LAB_CHANNEL_COUNT; c++)
    if (left[c].whiteness.n > 0)
      p = fmin(p, left[c].whiteness.p_value);
  if (lab_report_doubt(t->report))
    lab_json_say(list, "No effect is named, because the log and the rig file contradict each other.");
  else if (lab_residual_stats_coloured(left) > 0)
    lab_json_say(
        list, "Something is missing: the residual is not white, p-value %s. Which effect it is, the log does not tell.",
        lab_format_p(p, text));
  else
    lab_json_say(list,
                 "Something is missing: the residual is %s times the noise. Which effect it is, the log does not tell.",
                 lab_format_number(lab_report_in_noise(&r->after), 3, text));
}

static void put_sure(const lab_sources *t, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  char statistic[LAB_FORMAT_TEXT], threshold[LAB_FORMAT_TEXT];
  int i;
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    say_undecided(t, list);
  for (i = 0; i < r->n_found; i++)
    say_chance(t, &r->found[i], list);
  if (r->n_found == 0 && r->scores.n > 0 && r->level > 0)
    lab_json_say(list, "The effect %s has the highest score: %s; the threshold is %s.",
                 lab_page_effect_name(r->scores.of[0].effect),
                 lab_format_number(r->scores.of[0].statistic, 3, statistic),
                 lab_format_number(lab_chi2_threshold(r->level), 3, threshold));
  say_onsets(t, list);
  say_alike(r, list);
  say_held_out(t->report, list);
  say_left(t, list);
}

static void put_todo(const lab_sources *t, const cJSON *next, cJSON *list)
{
  const lab_search_result *r = t->report->result;
  const cJSON *first = cJSON_GetArrayItem(next, 0);
  char where[LAB_WHERE_TEXT];
  int i;
  if (lab_report_doubt(t->report))
    lab_json_say(list, "Correct the log or the rig file first: no effect is named while they contradict each other.");
  for (i = 0; i < r->n_found && r->verdict != LAB_VERDICT_UNDECIDED; i++)
    if (r->found[i].effect >= 0)
      lab_json_say(list, "Check on the rig: %s", pneu_effect_at(r->found[i].effect)->what);
    else
      lab_json_say(list, "Check what acts there on the rig: %s.",
                   lab_free_term_where(&t->report->completed->rig.term[r->found[i].term], where));
  if (r->verdict == LAB_VERDICT_NONE)
    lab_json_say(list, "Nothing on the rig. The fitted model, model.cfg, can be used.");
  else if (r->n_found > 0 && r->verdict != LAB_VERDICT_UNDECIDED)
    lab_json_say(list, "If this is as intended, use model.cfg, which includes it.");
  if (first && t->report->next.kind == LAB_ADVICE_TEST)
    lab_json_say(list, "To know more, record: %s.", t->report->next.text);
  else if (count_alike(r) > 0)
    lab_json_say(list, "Record a test that separates %s from %s; see What to record next.", alike_name(r, 0),
                 alike_name(r, 1));
  else if (first && r->verdict != LAB_VERDICT_NONE)
    lab_json_say(list, "%s", first->valuestring);
}

void lab_page_first(const lab_sources *t, const cJSON *next, cJSON *page)
{
  lab_json_put(page, "size_heading", "%s", size_heading(t->report->result));
  put_main(t, cJSON_AddArrayToObject(page, "main"));
  put_remainder(t, cJSON_AddArrayToObject(page, "remainder"));
  put_sure(t, cJSON_AddArrayToObject(page, "sure"));
  put_todo(t, next, cJSON_AddArrayToObject(page, "todo"));
}
