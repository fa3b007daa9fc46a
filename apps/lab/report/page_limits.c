/* What the answer does not settle, and what to record next. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "page_private.h"

static const double rough = 0.1; /* half an interval over the value, from which on it is worth a word */

static void put_rough(const telling *t, cJSON *list)
{
  const lab_unknowns *u = t->story->completed;
  const lab_fit_result *fit = &t->story->result->fit;
  int j, knots = 0;
  for (j = 0; j < u->n; j++) {
    const double half = 0.5 * (fit->high[j] - fit->low[j]);
    if (u->unknown[j].kind == LAB_UNKNOWN_SWITCH || fit->state[j] != LAB_FIT_FREE ||
        !(half > rough * fabs(u->unknown[j].value)))
      continue;
    if (u->unknown[j].kind == LAB_UNKNOWN_KNOT)
      knots++;
    else
      page_say(list, "%s is known only within %.2g %% either way.", u->unknown[j].name,
               100 * half / fabs(u->unknown[j].value));
  }
  if (knots > 0)
    page_say(
        list,
        "%d values of the free term are known only within more than %g %% of themselves: those near 0, and those where "
        "the model hardly ever is.",
        knots, 100 * rough);
}

/* Effects none of whose candidates leaves a trace. */
static void put_invisible(const lab_trace_result *trace, cJSON *list)
{
  unsigned char tried[PNEU_EFFECT_COUNT + 1] = {0}, visible[PNEU_EFFECT_COUNT + 1] = {0};
  char names[512] = "";
  int i;
  for (i = 0; i < trace->n; i++) {
    tried[trace->candidate[i].effect] = 1;
    visible[trace->candidate[i].effect] |= trace->candidate[i].visible > 0;
  }
  for (i = 0; i < PNEU_EFFECT_COUNT; i++) {
    const size_t used = strlen(names);
    if (tried[i] && !visible[i])
      snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", page_effect_name(i));
  }
  if (*names)
    page_say(list, "With the declared laws this log could not show: %s.", names);
}

void page_limits(const telling *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "limits");
  const lab_loop_result *r = t->story->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      page_say(list, "%s from %s: both explain it equally well.", page_effect_name(r->found[i].effect),
               page_effect_name(r->found[i].alike[k]));
  lab_story_limits(t->story, list);
  put_rough(t, list);
  put_invisible(&r->trace, list);
  if (cJSON_GetArraySize(list) == 0)
    page_say(list, "Nothing to report: every parameter is determined, and no two effects are confused.");
}

const cJSON *page_next(const telling *t, cJSON *page)
{
  cJSON *list = cJSON_AddArrayToObject(page, "next");
  const lab_loop_result *r = t->story->result;
  int i, k;
  for (i = 0; i < r->n_found; i++)
    for (k = 0; k < r->found[i].n_alike; k++)
      if (k == 0 && t->story->separate[i].kind != LAB_ADVICE_NONE)
        page_say(list, "To tell %s from %s: %s. %s", page_effect_name(r->found[i].effect),
                 page_effect_name(r->found[i].alike[k]), t->story->separate[i].text, t->story->separate[i].why);
      else
        page_say(list, "To tell %s from %s, a test in which one of them shows alone. %s: %s. %s: %s.",
                 page_effect_name(r->found[i].effect), page_effect_name(r->found[i].alike[k]),
                 page_effect_name(r->found[i].effect), pneu_effect_at(r->found[i].effect)->footprint,
                 page_effect_name(r->found[i].alike[k]), pneu_effect_at(r->found[i].alike[k])->footprint);
  if (t->story->next.kind == LAB_ADVICE_TRIAL)
    page_say(list, "%s. %s", t->story->next.text, t->story->next.why);
  if (r->verdict == LAB_VERDICT_UNDECIDED || r->verdict == LAB_VERDICT_UNLISTED)
    page_say(list, "Tests that part the equations: hold with both orifices shut at several positions (mass), slow full "
                   "strokes both ways (forces), rest on either stop (sensors).");
  if (!t->story->has_holdout)
    page_say(list, "Another log with other commands, given by --holdout: the only test that a fit cannot flatter.");
  if (cJSON_GetArraySize(list) == 0)
    page_say(list, "Nothing is needed to settle this verdict.");
  return list;
}
