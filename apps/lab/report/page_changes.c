/* Then and now: what has changed since the baseline. */
#include <stdio.h>
#include <string.h>

#include "../base/format.h"
#include "../base/text.h"
#include "page_private.h"

static void put_change(const lab_change *change, cJSON *list)
{
  const lab_format shown = lab_format_as(lab_change_unit(change));
  char name[LAB_PARAM_NAME_TEXT], low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT];
  cJSON *item = lab_json_append(list);
  lab_json_put(item, "name", "%s", lab_change_name(change->param, name));
  lab_json_put(item, "unit", "%s", *shown.unit ? shown.unit : "1");
  lab_page_put_number(item, "then", shown.scale * change->then, 4);
  lab_page_put_number(item, "now", shown.scale * change->now, 4);
  lab_json_put(item, "interval", "%s .. %s", lab_format_number(shown.scale * change->low, 4, low),
               lab_format_number(shown.scale * change->high, 4, high));
  lab_page_put_p(item, "p_value", change->p_value);
}

/* "The logs are explained by laminar_leak, porous_leak as well as by chamber_leak." */
static void say_alike(const lab_change *change, cJSON *list)
{
  char name[LAB_PARAM_NAME_TEXT], names[LAB_CHANGE_LEADERS * LAB_PARAM_NAME_TEXT] = "";
  int i;
  for (i = 0; i < change->n_alike; i++)
    lab_append(names, sizeof names, "%s%s", i ? ", " : "", lab_change_name(change->alike[i], name));
  if (change->n_alike)
    lab_json_say(list, "The logs are explained by %s as well as by %s.", names, lab_change_name(change->param, name));
}

/* "chamber_leak acts since 14.2 s (95 %: 14.1 .. 14.3)." */
static void say_when(const lab_change *change, const lab_onset *onset, const char *word, cJSON *list)
{
  char name[LAB_PARAM_NAME_TEXT], at[LAB_FORMAT_TEXT], low[LAB_FORMAT_TEXT], high[LAB_FORMAT_TEXT];
  if (onset->known)
    lab_json_say(list, "%s acts %s %s s (95 %%: %s .. %s).", lab_change_name(change->param, name), word,
                 lab_format_number(onset->t, 5, at), lab_format_number(onset->low, 5, low),
                 lab_format_number(onset->high, 5, high));
}

void lab_page_changes(const lab_sources *t, cJSON *page)
{
  const lab_changes *changes = t->report->changes;
  cJSON *list;
  int i;
  lab_json_put(page, "has_baseline", "%s", changes ? "yes" : "");
  if (!changes)
    return;
  lab_json_put(page, "has_changes", "%s", changes->n ? "yes" : "");
  list = cJSON_AddArrayToObject(page, "changes");
  for (i = 0; i < changes->n; i++)
    put_change(&changes->change[i], list);
  list = cJSON_AddArrayToObject(page, "change_remarks");
  if (changes->condition == LAB_SINCE_UNCHANGED)
    lab_json_say(list, "Nothing has changed: %d differences were tried, and none passes.", changes->tests);
  for (i = 0; i < changes->n; i++) {
    say_alike(&changes->change[i], list);
    say_when(&changes->change[i], &changes->change[i].begin, "since", list);
    say_when(&changes->change[i], &changes->change[i].end, "until", list);
  }
  if (*changes->why)
    lab_json_say(list, "%s%s.",
                 changes->condition == LAB_SINCE_CANNOT_TELL ? "It cannot be told: " : "There is more: ", changes->why);
  if (changes->tests)
    lab_json_say(
        list,
        "What differs from day to day on a sound rig does not count: supply, weather, zeros and gains of sensors, "
        "a little of friction and spring.");
}
