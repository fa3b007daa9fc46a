/* The first look: what is missing and how much, how sure that is, what to do. */
#include <math.h>

#include "../base/quantile.h"
#include "../base/shown.h"
#include "../trace/unlisted.h"
#include "page_private.h"

static const char *size_heading(const lab_loop_result *r)
{
  if (r->n_found == 0)
    return "What is left";
  return r->verdict == LAB_VERDICT_UNDECIDED ? "What comes nearest, and how much" : "What is missing, and how much";
}

/* The size of each effect that was found, with its interval. */
static void put_main(const telling *t, cJSON *list)
{
  const lab_unknowns *u = t->story->completed;
  const lab_loop_result *r = t->story->result;
  int i;
  for (i = 0; i < r->n_found; i++) {
    const int j = r->found[i].effect < 0 ? -1 : lab_unknowns_find(u, r->found[i].param);
    pneu_param_info info;
    cJSON *item;
    if (j < 0)
      continue;
    pneu_param_describe(r->found[i].param, &info);
    item = page_append(list);
    page_put(item, "name", "%s", page_effect_name(r->found[i].effect));
    page_put(item, "meaning", "%s", info.meaning);
    page_put_quantity(item, "value", u->unknown[j].value, page_unit(&u->unknown[j]), page_digits(t, j));
    page_put(item, "unit", "%s", lab_shown_as(page_unit(&u->unknown[j])).unit);
    page_put_interval(t, j, item);
  }
}

static double in_noise(const lab_errors *errors)
{
  return sqrt(errors->chi2 / (double)errors->n);
}

/* What is left, and where something without a name acts. */
static void put_remainder(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  char where[LAB_WHERE_TEXT], number[LAB_SHOWN_TEXT];
  cJSON *item;
  int i;
  for (i = 0; i < r->n_found; i++)
    if (r->found[i].effect < 0) {
      const pneu_term *term = &t->story->completed->rig.term[r->found[i].term];
      item = page_append(list);
      page_put(item, "value", "%s", lab_unlisted_what(term));
      page_put(item, "words", "%s", lab_unlisted_where(term, where));
    }
  if (r->n_found > 0 || r->before.n == 0)
    return;
  item = page_append(list);
  page_put(item, "value", "%s × noise", lab_shown_number(in_noise(&r->before), 3, number));
  page_put(item, "words", "is the error of the declared model, fitted");
}

/* Channels whose residual is not white, the declared model's or the completed one's. */
static int count_coloured(const telling *t)
{
  int c, n = 0;
  for (c = 0; c < t->evidence->n_channels; c++)
    n += t->evidence->channel[c].whiteness[LAB_STAGE_AFTER].p_value < page_white_level;
  return n;
}

/* How much more than chance one thing is that was added. */
static void say_chance(const telling *t, const lab_found *found, cJSON *list)
{
  char p[LAB_SHOWN_TEXT], statistic[LAB_SHOWN_TEXT], threshold[LAB_SHOWN_TEXT];
  page_say(list, "%s is more than chance: p-value %s (score statistic %s, where %s would do).",
           found->effect < 0 ? "It" : page_effect_name(found->effect),
           lab_shown_p(found->effect < 0 ? lab_chi2_tail(found->statistic, found->degrees) : found->p_value, p),
           lab_shown_number(found->statistic, 3, statistic),
           lab_shown_number(lab_chi2_threshold(t->story->result->level), 3, threshold));
}

static int count_alike(const lab_loop_result *r)
{
  int i, n = 0;
  for (i = 0; i < r->n_found; i++)
    n += r->found[i].n_alike;
  return n;
}

/* The first effect that the log cannot tell from another, or the first that looks like it. */
static const char *alike_name(const lab_loop_result *r, int other)
{
  int i = 0;
  while (r->found[i].n_alike == 0)
    i++;
  return page_effect_name(other ? r->found[i].alike[0] : r->found[i].effect);
}

/* Whether anything else would do as well. */
static void say_alike(const lab_loop_result *r, cJSON *list)
{
  int i, named = 0;
  for (i = 0; i < r->n_found; i++) {
    const lab_found *found = &r->found[i];
    named += found->effect >= 0;
    if (found->n_alike > 0)
      page_say(list, "But the log cannot tell it apart: %s explains it as well as %s%s.",
               page_effect_name(found->alike[0]), page_effect_name(found->effect),
               found->n_alike > 1 ? ", and so do others, see below" : "");
  }
  if (named > 0 && count_alike(r) == 0)
    page_say(list, "No other effect of the catalogue explains the log as well.");
}

static void say_held_out(const lab_story *story, cJSON *list)
{
  char before[LAB_SHOWN_TEXT], after[LAB_SHOWN_TEXT];
  if (!story->has_holdout)
    page_say(list, "Not tried on a log that was held out.");
  else if (story->result->n_found > 0)
    page_say(list, "On a log that was not used for the fit, the error goes from %s to %s times the noise.",
             lab_shown_number(in_noise(&story->holdout_before), 3, before),
             lab_shown_number(in_noise(&story->holdout_after), 3, after));
  else
    page_say(list, "On a log that was not used for the fit, the error is %s times the noise.",
             lab_shown_number(in_noise(&story->holdout_before), 3, before));
}

static void put_sure(const telling *t, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  char statistic[LAB_SHOWN_TEXT], threshold[LAB_SHOWN_TEXT];
  const int coloured = count_coloured(t);
  int i;
  if (r->verdict == LAB_VERDICT_UNDECIDED)
    page_say(list, "Not sure enough for a name.");
  for (i = 0; i < r->n_found; i++)
    say_chance(t, &r->found[i], list);
  if (r->n_found == 0 && r->trace.n > 0 && r->level > 0)
    page_say(list, "%s comes nearest of all effects: statistic %s, where it would take %s.",
             page_effect_name(r->trace.candidate[0].effect),
             lab_shown_number(r->trace.candidate[0].statistic, 3, statistic),
             lab_shown_number(lab_chi2_threshold(r->level), 3, threshold));
  say_alike(r, list);
  say_held_out(t->story, list);
  if (coloured == 0)
    page_say(list, "What is left is white noise, on every channel.");
  else
    page_say(list, "What is left is not white noise on %d of %d channels.", coloured, t->evidence->n_channels);
}

static void put_todo(const telling *t, const cJSON *next, cJSON *list)
{
  const lab_loop_result *r = t->story->result;
  const cJSON *first = cJSON_GetArrayItem(next, 0);
  char where[LAB_WHERE_TEXT];
  int i;
  if (t->story->remarks && t->story->remarks->doubt)
    page_say(list, "Correct the log or the rig file first: no effect is named while they contradict each other.");
  for (i = 0; i < r->n_found && r->verdict != LAB_VERDICT_UNDECIDED; i++)
    if (r->found[i].effect >= 0)
      page_say(list, "See on the rig whether it is so: %s", pneu_effect_at(r->found[i].effect)->what);
    else
      page_say(list, "See what the rig has there: %s.",
               lab_unlisted_where(&t->story->completed->rig.term[r->found[i].term], where));
  if (r->verdict == LAB_VERDICT_NONE)
    page_say(list, "Nothing on the rig. The fitted model, model.cfg, can be used.");
  else if (r->n_found > 0 && r->verdict != LAB_VERDICT_UNDECIDED)
    page_say(list, "Where it is meant to be so, go on with model.cfg, which has it.");
  if (first && t->story->next.kind == LAB_ADVICE_TRIAL)
    page_say(list, "To know more, record: %s.", t->story->next.text);
  else if (count_alike(r) > 0)
    page_say(list, "Record what tells %s from %s: see What to record next.", alike_name(r, 0), alike_name(r, 1));
  else if (first && r->verdict != LAB_VERDICT_NONE)
    page_say(list, "%s", first->valuestring);
}

void page_first(const telling *t, const cJSON *next, cJSON *page)
{
  page_put(page, "size_heading", "%s", size_heading(t->story->result));
  put_main(t, cJSON_AddArrayToObject(page, "main"));
  put_remainder(t, cJSON_AddArrayToObject(page, "remainder"));
  put_sure(t, cJSON_AddArrayToObject(page, "sure"));
  put_todo(t, next, cJSON_AddArrayToObject(page, "todo"));
}
