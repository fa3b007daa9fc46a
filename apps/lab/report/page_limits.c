/* What the answer does not settle, and what to record next. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "../base/text.h"
#include "page_private.h"

static const double rough = 0.1; /* half an interval over the value, from which on it is worth a word */

static void put_rough(const lab_sources *t, cJSON *list)
{
  const lab_unknowns *u = t->report->completed;
  const lab_fit_result *fit = &t->report->result->fit;
  int j, knots = 0;
  for (j = 0; j < u->n; j++) {
    const double half = 0.5 * (fit->high[j] - fit->low[j]);
    if (u->unknown[j].kind == LAB_UNKNOWN_INSTANT || fit->state[j] != LAB_STATE_FREE ||
        !(half > rough * fabs(u->unknown[j].value)))
      continue;
    if (u->unknown[j].kind == LAB_UNKNOWN_KNOT)
      knots++;
    else
      lab_json_say(list, "The parameter %s is known to within ±%.2g %%.", u->unknown[j].name,
                   100 * half / fabs(u->unknown[j].value));
  }
  if (knots > 0)
    lab_json_say(
        list,
        "%d values of the free term have an uncertainty of more than %g %%: those near 0, and those that the model "
        "hardly reaches.",
        knots, 100 * rough);
}

/* Effects none of whose candidates leaves a trace. */
static void put_invisible(const lab_scores *scores, cJSON *list)
{
  unsigned char tried[PNEU_EFFECT_COUNT + 1] = {0}, visible[PNEU_EFFECT_COUNT + 1] = {0};
  char names[512] = "";
  int i;
  for (i = 0; i < scores->n; i++) {
    tried[scores->of[i].effect] = 1;
    visible[scores->of[i].effect] |= scores->of[i].visible > 0;
  }
  for (i = 0; i < PNEU_EFFECT_COUNT; i++)
    if (tried[i] && !visible[i])
      lab_append(names, sizeof names, "%s%s", *names ? ", " : "", lab_page_effect_name(i));
  if (*names)
    lab_json_say(list, "With the declared laws this log cannot show these effects: %s.", names);
}

void lab_page_limits(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "limits");
  const lab_search_result *r = t->report->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      lab_json_say(list, "The effects %s and %s explain the log equally well.",
                   lab_page_effect_name(r->found[i].effect), lab_page_effect_name(r->found[i].alike[k]));
  lab_report_limits(t->report, list);
  put_rough(t, list);
  put_invisible(&r->scores, list);
  if (cJSON_GetArraySize(list) == 0)
    lab_json_say(list, "There is no limitation: every parameter is determined, and no two effects look alike.");
}

const cJSON *lab_page_next(const lab_sources *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "next");
  const lab_search_result *r = t->report->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      if (k == 0 && t->report->separate[i].kind != LAB_ADVICE_NONE)
        lab_json_say(list, "To tell %s from %s: %s. %s", lab_page_effect_name(r->found[i].effect),
                     lab_page_effect_name(r->found[i].alike[k]), t->report->separate[i].text,
                     t->report->separate[i].why);
      else
        lab_json_say(list, "To tell %s from %s, record a test in which only one of them acts. %s: %s. %s: %s.",
                     lab_page_effect_name(r->found[i].effect), lab_page_effect_name(r->found[i].alike[k]),
                     lab_page_effect_name(r->found[i].effect), pneu_effect_at(r->found[i].effect)->footprint,
                     lab_page_effect_name(r->found[i].alike[k]), pneu_effect_at(r->found[i].alike[k])->footprint);
  if (t->report->next.kind == LAB_ADVICE_TEST)
    lab_json_say(list, "Record this: %s. %s", t->report->next.text, t->report->next.why);
  if (r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED)
    lab_json_say(
        list,
        "These tests separate the equations: a hold with both orifices shut at several positions (mass), slow full "
        "strokes both ways (forces), rest on either stop (sensors).");
  if (!t->report->has_holdout)
    lab_json_say(list,
                 "Record another log with other commands and give it by --holdout: a fit cannot adapt to a log that "
                 "it does not see.");
  if (cJSON_GetArraySize(list) == 0)
    lab_json_say(list, "No further test is needed for this verdict.");
  return list;
}
